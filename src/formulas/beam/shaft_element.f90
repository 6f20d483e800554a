!> A piece of a shaft that bends: Timoshenko's beam between two nodes, in a plane through its axis.
!>
!> At each end stand the displacement w and the slope \(\psi\) of the section, which is \(w'\) where
!> nothing shears. Both planes of a round shaft are alike; what couples them is the gyroscopic
!> matrix, which is asked for once and stands with opposite signs in both.
module gfb_shaft_element
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  implicit none (type, external)
  private
  public :: cowper_coefficient, shaft_section, element_matrices, section_forces, strain_product

  integer, parameter, public :: element_size = 4 !! w and psi of both ends

  !> A length of shaft with one section.
  type, public :: shaft_section_type
    real(wp) :: bending = 0.0_wp         !! E I [N m2]
    real(wp) :: shear = 0.0_wp           !! kappa G A [N]
    real(wp) :: mass = 0.0_wp            !! rho A [kg/m]
    real(wp) :: rotary_inertia = 0.0_wp  !! rho I [kg m]
  end type shaft_section_type

  !> Of an element; the polar one is that of both planes.
  type, public :: element_matrices_type
    real(wp) :: stiffness(element_size, element_size) = 0.0_wp
    real(wp) :: mass(element_size, element_size) = 0.0_wp      !! with rotary inertia
    real(wp) :: gyroscopic(element_size, element_size) = 0.0_wp !! polar inertia [kg m2]
    real(wp) :: weight(element_size) = 0.0_wp !! of an acceleration of 1 [kg], [kg m]
  end type element_matrices_type

  ! Gauss's rule of four points: exact for the product of two cubics.
  real(wp), parameter :: inner = sqrt((3.0_wp - 2.0_wp*sqrt(1.2_wp))/7.0_wp)
  real(wp), parameter :: outer = sqrt((3.0_wp + 2.0_wp*sqrt(1.2_wp))/7.0_wp)
  real(wp), parameter :: place(4) = 0.5_wp*(1.0_wp + [-outer, -inner, inner, outer])
  real(wp), parameter :: share(4) = 0.25_wp*(1.0_wp + sqrt(30.0_wp)/18.0_wp*[-1, 1, 1, -1])

contains

  !> The part of a round section that shears.
  !>
  !> $$ \kappa = \frac{6 (1 + \nu) (1 + m^2)^2}{(7 + 6 \nu) (1 + m^2)^2 + (20 + 12 \nu) m^2} $$
  !>
  !> with m, the inner diameter over the outer one [Cowper1966].
  elemental real(wp) function cowper_coefficient(poissons_ratio, ratio) result(kappa)
    real(wp), intent(in) :: poissons_ratio !! nu [1]
    real(wp), intent(in) :: ratio !! m, 0 where the shaft is solid [1]
    real(wp) :: squared

    squared = (1.0_wp + ratio**2)**2
    kappa = 6.0_wp*(1.0_wp + poissons_ratio)*squared/ &
      ((7.0_wp + 6.0_wp*poissons_ratio)*squared + (20.0_wp + 12.0_wp*poissons_ratio)*ratio**2)
  end function cowper_coefficient

  !> The section of a round shaft.
  elemental function shaft_section(outer_diameter, inner_diameter, youngs_modulus, shear_modulus, &
                                   density, shear_coefficient) result(section)
    real(wp), intent(in) :: outer_diameter, inner_diameter !! [m]
    real(wp), intent(in) :: youngs_modulus, shear_modulus  !! E, G [Pa]
    real(wp), intent(in) :: density           !! rho [kg/m3]
    real(wp), intent(in) :: shear_coefficient !! kappa [1]
    type(shaft_section_type) :: section
    real(wp) :: area, second_moment

    area = 0.25_wp*pi*(outer_diameter**2 - inner_diameter**2)
    second_moment = pi/64.0_wp*(outer_diameter**4 - inner_diameter**4)
    section%bending = youngs_modulus*second_moment
    section%shear = shear_coefficient*shear_modulus*area
    section%mass = density*area
    section%rotary_inertia = density*second_moment
  end function shaft_section

  !> Displacement and slope that forces and moments on the ends of an element alone make, of unit
  !> ends: cubics with the shear number \( \Phi = 12 E I/(\kappa G A L^2) \) [Friswell2010] ch. 5.
  pure subroutine shapes(section, length, at, displacement, slope, curvature)
    type(shaft_section_type), intent(in) :: section
    real(wp), intent(in) :: length !! L [m]
    real(wp), intent(in) :: at     !! from the first end, over the length [1]
    real(wp), intent(out) :: displacement(element_size) !! [1], [m]
    real(wp), intent(out) :: slope(element_size)        !! [1/m], [1]
    real(wp), intent(out) :: curvature(element_size)    !! of the slope along the axis [1/m2], [1/m]
    real(wp) :: phi, x, whole

    phi = shear_number(section, length)
    x = at
    whole = 1.0_wp + phi
    displacement = [1.0_wp - 3.0_wp*x**2 + 2.0_wp*x**3 + phi*(1.0_wp - x), &
                    length*(x - 2.0_wp*x**2 + x**3 + 0.5_wp*phi*(x - x**2)), &
                    3.0_wp*x**2 - 2.0_wp*x**3 + phi*x, &
                    length*(x**3 - x**2 + 0.5_wp*phi*(x**2 - x))]/whole
    slope = [6.0_wp*(x**2 - x)/length, 1.0_wp - 4.0_wp*x + 3.0_wp*x**2 + phi*(1.0_wp - x), &
             6.0_wp*(x - x**2)/length, 3.0_wp*x**2 - 2.0_wp*x + phi*x]/whole
    curvature = [6.0_wp*(2.0_wp*x - 1.0_wp)/length, 6.0_wp*x - 4.0_wp - phi, &
                 6.0_wp*(1.0_wp - 2.0_wp*x)/length, 6.0_wp*x - 2.0_wp + phi]/(whole*length)
  end subroutine shapes

  !> How far an element shears beside how it bends [1].
  pure real(wp) function shear_number(section, length) result(phi)
    type(shaft_section_type), intent(in) :: section
    real(wp), intent(in) :: length !! [m]
    phi = 12.0_wp*section%bending/(section%shear*length**2)
  end function shear_number

  !> Shear strain of unit ends, the same all along: \( w' - \psi = E I \psi''/(\kappa G A) \).
  pure function shear_strain(section, length) result(strain)
    type(shaft_section_type), intent(in) :: section
    real(wp), intent(in) :: length !! [m]
    real(wp) :: strain(element_size) !! [1/m], [1]
    real(wp) :: phi

    phi = shear_number(section, length)
    strain = phi/(1.0_wp + phi)*[-1.0_wp/length, -0.5_wp, 1.0_wp/length, -0.5_wp]
  end function shear_strain

  !> Stiffness, mass with rotary inertia, polar inertia and weight, all of the same shapes.
  !>
  !> $$ K = \int E I \psi' \psi'^T + \kappa G A \gamma \gamma^T, \quad
  !>    M = \int \rho A w w^T + \rho I \psi \psi^T, \quad G = \int 2 \rho I \psi \psi^T $$
  pure function element_matrices(section, length) result(element)
    type(shaft_section_type), intent(in) :: section !! of the element
    real(wp), intent(in) :: length !! L [m]
    type(element_matrices_type) :: element
    real(wp) :: displacement(element_size), slope(element_size), curvature(element_size)
    real(wp) :: strain(element_size), turned(element_size, element_size)
    integer :: i

    strain = shear_strain(section, length)
    element%stiffness = section%shear*length*square(strain)
    do i = 1, size(place)
      call shapes(section, length, place(i), displacement, slope, curvature)
      turned = share(i)*length*section%rotary_inertia*square(slope)
      element%stiffness = element%stiffness + share(i)*length*section%bending*square(curvature)
      element%mass = element%mass + share(i)*length*section%mass*square(displacement) + turned
      element%gyroscopic = element%gyroscopic + 2.0_wp*turned
      element%weight = element%weight + share(i)*length*section%mass*displacement
    end do
  end function element_matrices

  !> \( U^T K V \) by how the ends are turned against the chord, which rigid motions leave to the
  !> last digit: those of an element that is short cancel in K by as many digits as its stiffness
  !> has more than the shaft's.
  pure function strain_product(section, length, left, right) result(product)
    type(shaft_section_type), intent(in) :: section !! of the element
    real(wp), intent(in) :: length !! [m]
    real(wp), intent(in) :: left(:, :), right(:, :) !! U, V (end's motion, column) [m], [1]
    real(wp) :: product(size(left, 2), size(right, 2)) !! [J] where columns are motions
    real(wp) :: phi, turned(2, size(left, 2)), moment(2, size(right, 2))

    phi = shear_number(section, length)
    turned = against_chord(length, left)
    moment = against_chord(length, right)
    moment = section%bending/(length*(1.0_wp + phi))* &
             matmul(reshape([4.0_wp + phi, 2.0_wp - phi, 2.0_wp - phi, 4.0_wp + phi], [2, 2]), &
                    moment)
    product = matmul(transpose(turned), moment)
  end function strain_product

  !> Slopes of both ends against the chord between them.
  pure function against_chord(length, ends) result(turned)
    real(wp), intent(in) :: length !! [m]
    real(wp), intent(in) :: ends(:, :) !! w and psi of both (end's motion, column) [m], [1]
    real(wp) :: turned(2, size(ends, 2)) !! [1]

    turned(1, :) = ends(2, :) - (ends(3, :) - ends(1, :))/length
    turned(2, :) = ends(4, :) - (ends(3, :) - ends(1, :))/length
  end function against_chord

  !> A column times itself as a row.
  pure function square(column)
    real(wp), intent(in) :: column(element_size) !! in any unit [SI]
    real(wp) :: square(element_size, element_size)
    square = spread(column, 2, element_size)*spread(column, 1, element_size)
  end function square

  !> Bending moment \( E I \psi' \) and shear force \( \kappa G A (w' - \psi) \) at both ends, from
  !> the balance of the element: exact at rest, whatever its length, where shapes are not.
  pure function section_forces(section, length, ends, acceleration) result(force)
    type(shaft_section_type), intent(in) :: section !! of the element
    real(wp), intent(in) :: length !! L [m]
    real(wp), intent(in) :: ends(element_size) !! w and psi of both [m], [1]
    real(wp), intent(in) :: acceleration !! of free fall, along w [m/s2]
    real(wp) :: force(2, 2) !! (moment and shear, first and second end) [N m], [N]
    type(element_matrices_type) :: element
    real(wp) :: held(element_size)

    element = element_matrices(section, length)
    held = matmul(element%stiffness, ends) - acceleration*element%weight
    force = reshape([-held(2), -held(1), held(4), held(3)], shape(force))
  end function section_forces
end module gfb_shaft_element
