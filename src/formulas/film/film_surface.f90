!> The surface that a film lies on, and how a motion of the shaft opens the gap there: the one place
!> that knows whether a bearing is a journal's, a thrust bearing or a cone.
!>
!> A line of the surface makes the angle \( \beta \) with the axis. With the distance s along it a
!> point has radius and height
!>
!> $$ r = r_0 + s \sin\beta, \quad z = z_0 + s \cos\beta, $$
!>
!> so s is z on a cylinder (\( \beta = 0 \)), r on a ring (\( \beta = \pi/2, r_0 = 0 \)). The gap of
!> a rigid sleeve is \( h_r = C + b(\theta, s) \cdot q \) with the sleeve's coordinates relative to
!> the shaft, \( q = (e_x, e_y, e_z, \phi_x, \phi_y) \), and
!>
!> $$ b = \frac{\partial h}{\partial q} = [\cos\beta \cos\theta, \cos\beta \sin\theta, -\sin\beta,
!>    -l \sin\theta, l \cos\theta], \quad l = z \cos\beta + r \sin\beta $$
!>
!> Source of the journal's: [Gu2020] eq. 12. As printed there \( \phi_x \) stands with the cosine;
!> the text of its section 4.3 fits only with the two exchanged, as here. Forces and torques on the
!> sleeve are conjugate to q: a pressure p has the power \( p \, b \cdot \dot q \) an area.
!>
!> A film on the other side of a runner faces the other way: its b has the other sign.
!>
!> Arcs of a mesh are measured at one radius R, where the shaft's surface has the speed
!> \( \Omega R \). Elsewhere arc and speed are \( r/R \) times that, the stretch: 1 on a cylinder.
module gfb_film_surface
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: cylinder, cone, ring, entraining_speed

  integer, parameter, public :: shaft_coordinates = 5 !! e_x, e_y, e_z [m], phi_x, phi_y [rad]
  integer, parameter, public :: translations = 3      !! those of them before the tilts
  integer, parameter, public :: axial_coordinate = 3  !! of them
  integer, parameter, public :: journal_motions = 4   !! that change the gap of a journal
  !> Which these are.
  integer, parameter, public :: journal_coordinates(journal_motions) = [1, 2, 4, 5]

  !> A cylinder, a cone, or a ring.
  type, public :: film_surface_type
    real(wp) :: radius = 0.0_wp !! R, at which arcs are measured [m]
    real(wp) :: origin = 0.0_wp !! r_0 [m]
    real(wp) :: offset = 0.0_wp !! z_0, of the midplane from the rotor's centre [m]
    real(wp) :: cosine = 1.0_wp, sine = 0.0_wp !! of beta [1]
    real(wp) :: facing = 1.0_wp !! -1: on the runner's other side
  contains
    procedure, non_overridable :: is_ring, motions, radius_at, stretch
    procedure, non_overridable :: lever, tilt_arm, position, motion
    procedure, non_overridable :: point_motions, motion_excess, rest_gap, gap
  end type film_surface_type

contains

  !> A journal's surface.
  pure function cylinder(radius, offset) result(surface)
    real(wp), intent(in) :: radius !! of the bearing [m]
    !> of its midplane from the rotor's centre; default: 0 [m]
    real(wp), intent(in), optional :: offset
    type(film_surface_type) :: surface

    surface = film_surface_type(radius=radius, origin=radius)
    if (present(offset)) surface%offset = offset
  end function cylinder

  !> A cone's surface, wider towards +z; a cylinder where its half angle is 0.
  pure function cone(radius, half_angle, offset) result(surface)
    real(wp), intent(in) :: radius     !! of the bearing in the middle of its length [m]
    real(wp), intent(in) :: half_angle !! beta, of its lines with the axis [rad]
    real(wp), intent(in) :: offset     !! of its middle from the rotor's centre [m]
    type(film_surface_type) :: surface
    surface = film_surface_type(radius=radius, origin=radius, offset=offset, &
                                cosine=cos(half_angle), sine=sin(half_angle))
  end function cone

  !> A thrust bearing's surface in the plane z = 0, its runner above; rows are its radii.
  pure function ring(outer_radius) result(surface)
    real(wp), intent(in) :: outer_radius !! at which arcs are measured [m]
    type(film_surface_type) :: surface
    surface = film_surface_type(radius=outer_radius, cosine=0.0_wp, sine=1.0_wp)
  end function ring

  !> Whether the film lies across the axis: a thrust bearing's.
  pure logical function is_ring(self) result(ring)
    class(film_surface_type), intent(in) :: self !! the surface
    ring = .not. abs(self%cosine) > 0.0_wp
  end function is_ring

  !> The shaft's coordinates that change the gap.
  pure function motions(self) result(coordinate)
    class(film_surface_type), intent(in) :: self !! the surface
    integer, allocatable :: coordinate(:)
    integer :: i

    associate (across => abs(self%cosine) > 0.0_wp, along => abs(self%sine) > 0.0_wp)
      coordinate = pack([(i, i=1, shaft_coordinates)], [across, across, along, .true., .true.])
    end associate
  end function motions

  !> Distance from the axis [m].
  elemental real(wp) function radius_at(self, along) result(radius)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: along !! s [m]
    radius = self%origin + along*self%sine
  end function radius_at

  !> Arc and speed over those at the radius where the mesh is measured [1].
  elemental function stretch(self, along)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: along !! s [m]
    real(wp) :: stretch
    stretch = self%radius_at(along)/self%radius
  end function stretch

  !> By which a tilt moves the surface against the shaft's: l [m].
  elemental function lever(self, along)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: along !! s [m]
    real(wp) :: lever
    lever = (along*self%cosine + self%offset)*self%cosine + self%radius_at(along)*self%sine
  end function lever

  !> The size of that lever, by which tilts and torques are made comparable [m].
  pure real(wp) function tilt_arm(self) result(arm)
    class(film_surface_type), intent(in) :: self !! the surface
    arm = abs(self%offset)*self%cosine + self%radius*self%sine
  end function tilt_arm

  !> Where a point lies in space.
  pure function position(self, angle, along) result(place)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! s [m]
    real(wp) :: place(3) !! x, y, z [m]
    place = [self%radius_at(along)*[cos(angle), sin(angle)], along*self%cosine + self%offset]
  end function position

  !> The gap's derivatives by the shaft's coordinates at one place.
  pure function motion(self, angle, along) result(b)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! s [m]
    real(wp) :: b(shaft_coordinates) !! [1], [m]
    b = motion_of(self, angle, self%lever(along))
  end function motion

  !> The same where the lever is known.
  pure function motion_of(surface, angle, lever) result(b)
    class(film_surface_type), intent(in) :: surface
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: lever !! l [m]
    real(wp) :: b(shaft_coordinates)
    b = [surface%cosine*[cos(angle), sin(angle)], -surface%sine, lever*[-sin(angle), cos(angle)]]
    if (surface%facing < 0.0_wp) b = -b
  end function motion_of

  !> The same at the Gauss points of an element.
  pure function point_motions(self, shapes, angle, along) result(b)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: shapes(:, :) !! (nodes, points) shape functions [1]
    real(wp), intent(in) :: angle(:)           !! theta of the nodes, unwound [rad]
    real(wp), intent(in) :: along(size(angle)) !! s of the nodes [m]
    real(wp) :: b(shaft_coordinates, size(angle)) !! (coordinates, points) [1], [m]
    integer :: point

    do point = 1, size(angle)
      associate (shape => shapes(:, point))
        b(:, point) = motion_of(self, dot_product(shape, angle), &
                                dot_product(shape, self%lever(along)))
      end associate
    end do
  end function point_motions

  !> What these have beyond those that the shape functions make of the nodes' values: a rigid gap is
  !> taken where it is, at the points.
  pure function motion_excess(self, shapes, angle, along) result(excess)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: shapes(:, :) !! (nodes, points) shape functions [1]
    real(wp), intent(in) :: angle(:)           !! theta of the nodes, unwound [rad]
    real(wp), intent(in) :: along(size(angle)) !! s of the nodes [m]
    real(wp) :: excess(shaft_coordinates, size(angle)) !! (coordinates, points) [1], [m]
    real(wp) :: nodal(shaft_coordinates, size(angle))
    integer :: i

    do i = 1, size(angle)
      nodal(:, i) = self%motion(angle(i), along(i))
    end do
    excess = self%point_motions(shapes, angle, along)
    do i = 1, size(angle)
      excess(:, i) = excess(:, i) - matmul(nodal, shapes(:, i))
    end do
  end function motion_excess

  !> Gap of a shaft that is not moved: a runner's gap is its place.
  elemental real(wp) function rest_gap(self, clearance) result(h)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: clearance !! C, or the size of a runner's gap [m]
    h = merge(0.0_wp, clearance, self%is_ring())
  end function rest_gap

  !> Gap of the rigid sleeve, without a foil's deflection, where cosine and sine of the angle are
  !> known.
  elemental function gap(self, cosine, sine, along, clearance, e_x, e_y, e_z, phi_x, phi_y) &
    result(h)
    class(film_surface_type), intent(in) :: self !! the surface
    real(wp), intent(in) :: cosine, sine !! of theta [1]
    real(wp), intent(in) :: along        !! s [m]
    real(wp), intent(in) :: clearance    !! C, the gap at q = 0 [m]
    real(wp), intent(in) :: e_x, e_y, e_z !! of the sleeve relative to the shaft [m]
    real(wp), intent(in) :: phi_x, phi_y  !! the same about x, about y [rad]
    real(wp) :: h !! h_r [m]

    associate (lever => self%lever(along))
      h = clearance + (self%cosine*e_x + lever*phi_y)*cosine &
          + (self%cosine*e_y - lever*phi_x)*sine - self%sine*e_z
      if (self%facing < 0.0_wp) h = 2.0_wp*clearance - h
    end associate
  end function gap

  !> Mean speed U of the shaft's surface and the sleeve's, which rests: it drags the gas along.
  elemental function entraining_speed(speed, radius) result(entraining)
    real(wp), intent(in) :: speed  !! of the shaft [rad/s]
    real(wp), intent(in) :: radius !! of its surface [m]
    real(wp) :: entraining         !! U [m/s]
    entraining = 0.5_wp*speed*radius
  end function entraining_speed
end module gfb_film_surface
