!> The surfaces of the benchmark problems, smooth, with exact normals.
module shell_surfaces
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: cross
  use shell_model, only: surface_type
  implicit none (type, external)
  private

  real(wp), parameter :: pi = acos(-1.0_wp)

  !> Part of a cylinder about y, s along the arc from the top, t along the axis.
  type, extends(surface_type), public :: cylinder_type
    real(wp) :: radius, angle, length
  contains
    procedure :: point => cylinder_point
  end type cylinder_type

  !> Half of a bump's arc and half of its width, t along the arc from the crest to the corner.
  type, extends(surface_type), public :: bump_type
    real(wp) :: half_length, height, half_width
  contains
    procedure :: point => bump_point
  end type bump_type

  !> Quarter of a sphere about z from the equator up, s along the circles of latitude.
  type, extends(surface_type), public :: sphere_type
    real(wp) :: radius, latitude
  contains
    procedure :: point => sphere_point
  end type sphere_type

  !> Strip along x twisted by a quarter turn, s across.
  type, extends(surface_type), public :: twisted_type
    real(wp) :: length, width
  contains
    procedure :: point => twisted_point
  end type twisted_type

  !> Flat quarter ring about z, s along the radius.
  type, extends(surface_type), public :: ring_type
    real(wp) :: inner, outer
  contains
    procedure :: point => ring_point
  end type ring_type

  !> Flat parallelogram.
  type, extends(surface_type), public :: plate_type
    real(wp) :: side, angle
  contains
    procedure :: point => plate_point
  end type plate_type

contains

  !> Position and unit normal.
  pure subroutine bump_point(self, s, t, position, normal)
    class(bump_type), intent(in) :: self
    real(wp), intent(in) :: s, t
    real(wp), intent(out) :: position(3), normal(3)
    real(wp) :: radius, angle

    radius = (self%half_length**2 + self%height**2)/(2.0_wp*self%height)
    angle = t*asin(self%half_length/radius)
    normal = [sin(angle), cos(angle), 0.0_wp]
    position = radius*(normal - [0.0_wp, 1.0_wp, 0.0_wp]) + [0.0_wp, self%height, s*self%half_width]
  end subroutine bump_point

  !> Position and unit normal.
  pure subroutine cylinder_point(self, s, t, position, normal)
    class(cylinder_type), intent(in) :: self
    real(wp), intent(in) :: s, t
    real(wp), intent(out) :: position(3), normal(3)

    normal = [sin(s*self%angle), 0.0_wp, cos(s*self%angle)]
    position = self%radius*normal + [0.0_wp, t*self%length, 0.0_wp]
  end subroutine cylinder_point

  !> Position and unit normal.
  pure subroutine sphere_point(self, s, t, position, normal)
    class(sphere_type), intent(in) :: self
    real(wp), intent(in) :: s, t
    real(wp), intent(out) :: position(3), normal(3)

    normal = [cos(t*self%latitude)*cos(0.5_wp*pi*s), cos(t*self%latitude)*sin(0.5_wp*pi*s), &
              sin(t*self%latitude)]
    position = self%radius*normal
  end subroutine sphere_point

  !> Position and unit normal.
  pure subroutine twisted_point(self, s, t, position, normal)
    class(twisted_type), intent(in) :: self
    real(wp), intent(in) :: s, t
    real(wp), intent(out) :: position(3), normal(3)
    real(wp) :: across(3), along(3), turn, offset

    turn = 0.5_wp*pi*t
    offset = self%width*(s - 0.5_wp)
    across = [0.0_wp, cos(turn), sin(turn)]
    along = [self%length, -0.5_wp*pi*offset*sin(turn), 0.5_wp*pi*offset*cos(turn)]
    position = [self%length*t, 0.0_wp, 0.0_wp] + offset*across
    normal = cross(across, along)
    normal = normal/norm2(normal)
  end subroutine twisted_point

  !> Position and unit normal.
  pure subroutine ring_point(self, s, t, position, normal)
    class(ring_type), intent(in) :: self
    real(wp), intent(in) :: s, t
    real(wp), intent(out) :: position(3), normal(3)

    position = (self%inner + s*(self%outer - self%inner))* &
      [cos(0.5_wp*pi*t), sin(0.5_wp*pi*t), 0.0_wp]
    normal = [0.0_wp, 0.0_wp, 1.0_wp]
  end subroutine ring_point

  !> Position and unit normal.
  pure subroutine plate_point(self, s, t, position, normal)
    class(plate_type), intent(in) :: self
    real(wp), intent(in) :: s, t
    real(wp), intent(out) :: position(3), normal(3)

    position = self%side*[s + t*cos(self%angle), t*sin(self%angle), 0.0_wp]
    normal = [0.0_wp, 0.0_wp, 1.0_wp]
  end subroutine plate_point
end module shell_surfaces
