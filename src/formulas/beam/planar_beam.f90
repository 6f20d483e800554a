!> Planar Timoshenko beams in plane strain: straight elements of two nodes.
!>
!> Per metre of width. At each node stand three displacements: along x, along v (away from the
!> sleeve), and the turn from x towards v. Displacements and turn are linear in a linear element,
!> its shear strain is that of its middle (one-point integration), so thin beams do not lock:
!>
!> $$ \epsilon = \frac{\Delta u_s}{L}, \quad
!>    \kappa = \frac{\Delta \vartheta}{L}, \quad
!>    \gamma = \frac{\Delta u_n}{L} - \bar\vartheta, \quad
!>    K = L (A\, b_\epsilon b_\epsilon^T + D\, b_\kappa b_\kappa^T + S\, b_\gamma b_\gamma^T) $$
!>
!> A bent element has what the straight line between its ends hides of the bending as a softer shear
!> (residual bending flexibility), which makes it exact for forces and moments at its ends:
!>
!> $$ \frac{1}{S^*} = \frac{1}{S} + \frac{L^2}{12 D} $$
module gfb_planar_beam
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: plane_strain_section, linear_beam_stiffness, bent_beam_stiffness, beam_mass, &
            beam_resultants, beam_end_moments

  integer, parameter, public :: beam_unknowns = 3 !! at a node: along x, along v, turn

  !> What a beam's section resists, per metre of width.
  type, public :: beam_section_type
    real(wp) :: membrane = 0.0_wp !! A, tension over stretch [N/m]
    real(wp) :: bending = 0.0_wp  !! D, moment over curvature [N m]
    real(wp) :: shear = 0.0_wp    !! S, shear force over shear strain [N/m]
  end type beam_section_type

contains

  !> Section of a wide foil: it keeps its width.
  !>
  !> $$ A = \frac{E t}{1 - \nu^2}, \quad
  !>    D = \frac{E t^3}{12 (1 - \nu^2)}, \quad
  !>    S = \frac{5}{6} \frac{E t}{2 (1 + \nu)} $$
  elemental function plane_strain_section(thickness, youngs_modulus, poissons_ratio) result(section)
    real(wp), intent(in) :: thickness      !! t [m]
    real(wp), intent(in) :: youngs_modulus !! E [Pa]
    real(wp), intent(in) :: poissons_ratio !! nu [1]
    type(beam_section_type) :: section
    real(wp), parameter :: shear_factor = 5.0_wp/6.0_wp !! as the shells'

    section%membrane = youngs_modulus*thickness/(1.0_wp - poissons_ratio**2)
    section%bending = section%membrane*thickness**2/12.0_wp
    section%shear = shear_factor*youngs_modulus*thickness/(2.0_wp*(1.0_wp + poissons_ratio))
  end function plane_strain_section

  !> Stiffness of a linear element: forces along x and v and moments of both ends, first and second.
  pure function linear_beam_stiffness(section, ends) result(stiffness)
    type(beam_section_type), intent(in) :: section !! thickness and material of the beam
    real(wp), intent(in) :: ends(2, 2)     !! (x, v) of the first and of the second end [m]
    real(wp) :: stiffness(2*beam_unknowns, 2*beam_unknowns), length, tangent(2), normal(2)
    real(wp), dimension(2*beam_unknowns) :: stretch, curvature, shear

    length = norm2(ends(:, 2) - ends(:, 1))
    tangent = (ends(:, 2) - ends(:, 1))/length
    normal = [-tangent(2), tangent(1)]
    stretch = [-tangent, 0.0_wp, tangent, 0.0_wp]/length
    curvature = [0.0_wp, 0.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]/length
    shear = [-normal/length, -0.5_wp, normal/length, -0.5_wp]
    stiffness = length*(section%membrane*square(stretch) + section%bending*square(curvature) + &
                        section%shear*square(shear))
  end function linear_beam_stiffness

  !> Stiffness of a bent element, in the same order.
  pure function bent_beam_stiffness(section, ends) result(stiffness)
    type(beam_section_type), intent(in) :: section !! thickness and material of the beam
    real(wp), intent(in) :: ends(2, 2)     !! (x, v) of the first and of the second end [m]
    real(wp) :: stiffness(2*beam_unknowns, 2*beam_unknowns)
    type(beam_section_type) :: softer

    softer = section
    softer%shear = 1.0_wp/(1.0_wp/section%shear + &
                           sum((ends(:, 2) - ends(:, 1))**2)/(12.0_wp*section%bending))
    stiffness = linear_beam_stiffness(softer, ends)
  end function bent_beam_stiffness

  !> Consistent mass of an element, linear or bent, in the same order, with rotary inertia:
  !> displacements and turn are linear along it.
  !>
  !> $$ M = \frac{\rho t L}{6} \begin{bmatrix} 2 & 1 \\ 1 & 2 \end{bmatrix} \otimes
  !>    diag(1, 1, t^2/12) $$
  pure function beam_mass(density, thickness, ends) result(mass)
    real(wp), intent(in) :: density    !! rho [kg/m3]
    real(wp), intent(in) :: thickness  !! t [m]
    real(wp), intent(in) :: ends(2, 2) !! (x, v) of the first and of the second end [m]
    real(wp) :: mass(2*beam_unknowns, 2*beam_unknowns), third
    integer :: i, k

    mass = 0.0_wp
    do i = 1, beam_unknowns
      third = density*thickness*norm2(ends(:, 2) - ends(:, 1))/3.0_wp
      if (i == beam_unknowns) third = third*thickness**2/12.0_wp
      k = i + beam_unknowns
      mass(i, i) = third
      mass(k, k) = third
      mass(i, k) = 0.5_wp*third
      mass(k, i) = 0.5_wp*third
    end do
  end function beam_mass

  !> Tension and bending moment in the middle of an element, linear or bent, per metre of width
  !> [N/m], [N]. The moment is positive where it stretches the upper face.
  pure function beam_resultants(section, ends, displacement) result(force)
    type(beam_section_type), intent(in) :: section !! thickness and material of the beam
    real(wp), intent(in) :: ends(2, 2)         !! (x, v) of the first and of the second end [m]
    real(wp), intent(in) :: displacement(beam_unknowns, 2) !! of the ends [m], [rad]
    real(wp) :: force(2), length, change(beam_unknowns)

    length = norm2(ends(:, 2) - ends(:, 1))
    change = displacement(:, 2) - displacement(:, 1)
    force(1) = section%membrane*dot_product(change(:2), ends(:, 2) - ends(:, 1))/length**2
    force(2) = -section%bending*change(3)/length
  end function beam_resultants

  !> Bending moments at both ends of an element, per metre of width [N], positive as in
  !> `beam_resultants`: what balances its forces. In a linear element they differ from those in its
  !> middle by the shear force times half the length, and are of second order as these are.
  pure function beam_end_moments(stiffness, displacement) result(moment)
    real(wp), intent(in) :: stiffness(2*beam_unknowns, 2*beam_unknowns) !! of the element [SI]
    real(wp), intent(in) :: displacement(beam_unknowns, 2) !! of the ends [m], [rad]
    real(wp) :: moment(2), force(2*beam_unknowns)

    force = matmul(stiffness, [displacement])
    moment = [force(beam_unknowns), -force(2*beam_unknowns)]
  end function beam_end_moments

  !> Products of a vector's components.
  pure function square(vector) result(products)
    real(wp), intent(in) :: vector(:)
    real(wp) :: products(size(vector), size(vector))
    products = spread(vector, 2, size(vector))*spread(vector, 1, size(vector))
  end function square
end module gfb_planar_beam
