!> Exact beam stiffnesses of a bump strip's pieces: half an arc, and a flat.
!>
!> Per metre of width. At each end of a piece stand three displacements: along x, along v (away from
!> the sleeve), and the turn from x towards v.
module gfb_arch_beam
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_positive
  implicit none (type, external)
  private
  public :: arch_flexibility, left_arch_stiffness, right_arch_stiffness, flat_stiffness

  !> What a foil's section answers, per metre of width.
  type, public :: section_type
    real(wp) :: bending = 0.0_wp  !! curvature over moment, 1/D [1/(N m)]
    real(wp) :: membrane = 0.0_wp !! stretch over tension [m/N]; 0: inextensible
    real(wp) :: shear = 0.0_wp    !! shear strain over shear force [m/N]; 0: none
  end type section_type

contains

  !> Displacements of the crest of half an arc, its corner clamped, under forces on the crest.
  !>
  !> $$ F = \int_0^{t_0} \Bigl( \frac{b b^T}{D} + \frac{n n^T}{A} + \frac{q q^T}{S} \Bigr)
  !>    R_b \, d\varphi, \quad
  !>    b = \begin{pmatrix} -R_b (1 - \cos\varphi) \\ R_b \sin\varphi \\ 1 \end{pmatrix}, \
  !>    n = \begin{pmatrix} \cos\varphi \\ \sin\varphi \\ 0 \end{pmatrix}, \
  !>    q = \begin{pmatrix} -\sin\varphi \\ \cos\varphi \\ 0 \end{pmatrix} $$
  !>
  !> with the angle \(\varphi\) from the crest: moment, tension and shear force of unit forces along
  !> x and v and of a unit moment. Exact for a thin circular beam; the differences of sines are
  !> summed as series, so that flat arcs keep their digits.
  pure function arch_flexibility(radius, angle, section) result(flexibility)
    real(wp), intent(in) :: radius            !! R_b [m]
    real(wp), intent(in) :: angle             !! t_0, of half the arc [rad]
    type(section_type), intent(in) :: section !! of the foil
    real(wp) :: flexibility(3, 3)             !! x, v, turn, of a metre of width
    real(wp) :: sine, versine, sines, cosines, bending, stretch, shear

    sine = sin(angle)
    versine = 2.0_wp*sin(0.5_wp*angle)**2
    ! Integrals of the squared sine and cosine.
    sines = (8.0_wp*angle**3/6.0_wp - fifth_order(2.0_wp*angle))/4.0_wp
    cosines = angle - sines
    bending = section%bending*radius
    stretch = section%membrane*radius
    shear = section%shear*radius
    flexibility(1, 1) = stretch*cosines + shear*sines + &
      bending*radius**2*(fifth_order(2.0_wp*angle)/4.0_wp - 2.0_wp*fifth_order(angle))
    flexibility(1, 2) = -bending*radius**2*0.5_wp*versine**2 + (stretch - shear)*0.5_wp*sine**2
    flexibility(1, 3) = -bending*radius*(angle**3/6.0_wp - fifth_order(angle))
    flexibility(2, 2) = (bending*radius**2 + stretch)*sines + shear*cosines
    flexibility(2, 3) = bending*radius*versine
    flexibility(3, 3) = bending*angle
    flexibility(2, 1) = flexibility(1, 2)
    flexibility(3, 1) = flexibility(1, 3)
    flexibility(3, 2) = flexibility(2, 3)
  end function arch_flexibility

  !> The sine without its first two terms, sin x - x + x^3/6, to the last digit.
  elemental real(wp) function fifth_order(x) result(remainder)
    real(wp), intent(in) :: x !! at most pi [1]
    real(wp) :: term
    integer :: k

    term = -x**3/6.0_wp
    remainder = 0.0_wp
    do k = 4, 30, 2
      term = -term*x**2/real(k*(k + 1), wp)
      remainder = remainder + term
    end do
  end function fifth_order

  !> Stiffness of the half arc from a left corner (first three displacements) to the crest (last
  !> three).
  !>
  !> $$ K = B^T F^{-1} B, \qquad B = (-T \ \ 1) $$
  !>
  !> where T moves the crest with the corner as a rigid body.
  pure function left_arch_stiffness(half_length, height, radius, angle, section) result(stiffness)
    real(wp), intent(in) :: half_length, height !! l, h_b [m]
    real(wp), intent(in) :: radius, angle       !! R_b [m], t_0 [rad]
    type(section_type), intent(in) :: section   !! of the foil
    real(wp) :: stiffness(6, 6)                 !! [N/m^2, N/m, N]
    real(wp) :: bending(3, 6), forces(3, 6)
    integer :: i
    logical :: solved

    bending = 0.0_wp
    do i = 1, 3
      bending(i, i) = -1.0_wp
      bending(i, i + 3) = 1.0_wp
    end do
    bending(1, 3) = height
    bending(2, 3) = -half_length
    forces = bending
    call solve_positive(arch_flexibility(radius, angle, section), forces, solved)
    if (.not. solved) error stop 'the flexibility of an arc is not positive definite'
    stiffness = matmul(transpose(bending), forces)
  end function left_arch_stiffness

  !> Stiffness of the half arc from a right corner to the crest: the mirror image of the left one.
  pure function right_arch_stiffness(left) result(stiffness)
    real(wp), intent(in) :: left(6, 6) !! [N/m], [N], [N m] of the left half arc
    real(wp) :: stiffness(6, 6)
    real(wp), parameter :: mirror(6) = [-1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp]
    integer :: i, j

    do j = 1, 6
      do i = 1, 6
        stiffness(i, j) = mirror(i)*left(i, j)*mirror(j)
      end do
    end do
  end function right_arch_stiffness

  !> Stiffness of a flat as a straight beam: v and turn of its left end, v and turn of its right
  !> end.
  pure function flat_stiffness(length, section) result(stiffness)
    real(wp), intent(in) :: length            !! from corner to corner [m]
    type(section_type), intent(in) :: section !! of the foil
    real(wp) :: stiffness(4, 4)               !! [N/m^2, N/m, N]
    real(wp) :: a, b, c, d, softening

    softening = 12.0_wp*section%shear/(section%bending*length**2)
    d = 1.0_wp/(section%bending*length*(1.0_wp + softening))
    a = 12.0_wp*d/length**2
    b = 6.0_wp*d/length
    c = (2.0_wp - softening)*d
    d = (4.0_wp + softening)*d
    stiffness = reshape([a, b, -a, b, b, d, -b, c, -a, -b, a, -b, b, c, -b, d], [4, 4])
  end function flat_stiffness
end module gfb_arch_beam
