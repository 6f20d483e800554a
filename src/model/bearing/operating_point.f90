!> Speed, load and position of the shaft.
module gfb_operating_point
  use gfb_kinds, only: wp, most_pads
  use gfb_archive, only: archive_type
  use gfb_film_surface, only: shaft_coordinates
  implicit none (type, external)
  private
  public :: point_between, visit_point

  !> What the bearing is asked to bear; every value may change along a path.
  type, public :: operating_point_type
    real(wp) :: speed = 0.0_wp           !! of the shaft, in +theta [rad/s]
    !> External forces and torques on the shaft, where it floats; see `shaft_coordinates`
    !> [N], [N m].
    real(wp) :: load(shaft_coordinates) = 0.0_wp
    !> Of the sleeve relative to the shaft, where it is fixed; over a step of time, where a shaft
    !> that floats would be without forces [m], [rad].
    real(wp) :: place(shaft_coordinates) = 0.0_wp
    !> Of a shaft that floats, over a step of time, with the gyroscopic torque of a tilt by the
    !> other's rate [N/m], [N m/rad].
    real(wp) :: inertia(shaft_coordinates, shaft_coordinates) = 0.0_wp
    real(wp) :: growth = 1.0_wp !! part that counts of what temperatures do to radii and gas [1]
    real(wp) :: supply = 1.0_wp !! part that counts of what a supply has above ambient pressure [1]
    real(wp) :: edge_pull(most_pads) = 0.0_wp !! fictitious, lifts a free edge of the top foils [N]
    real(wp) :: edge_tension(most_pads) = 0.0_wp !! fictitious, keeps that edge straight [N]
    real(wp) :: edge_hold(most_pads) = 0.0_wp !! fictitious, keeps a pad's edge at a height [N/m]
    real(wp) :: edge_height(most_pads) = 0.0_wp !! it, above the edge at rest [m]
  contains
    procedure :: add_other_forces
  end type operating_point_type

contains

  !> Adds the forces on the sleeve that balance the film's: those of the load, and of inertia.
  pure subroutine add_other_forces(self, coordinate, place, force)
    class(operating_point_type), intent(in) :: self !! the point
    integer, intent(in) :: coordinate(:) !! those that are unknowns
    real(wp), intent(in) :: place(:)     !! their values [m], [rad]
    real(wp), intent(inout) :: force(:)  !! conjugate to them [N], [N m]

    force = force - self%load(coordinate)
    if (.not. maxval(abs(self%inertia)) > 0.0_wp) return
    force = force - matmul(self%inertia(coordinate, coordinate), place - self%place(coordinate))
  end subroutine add_other_forces

  !> The point at a fraction of the straight path from one to another, or on beyond either.
  elemental function point_between(first, last, fraction) result(point)
    type(operating_point_type), intent(in) :: first, last !! the ends of the path
    real(wp), intent(in) :: fraction !! 0 at the first, 1 at the last [1]
    type(operating_point_type) :: point

    if (abs(fraction - 1.0_wp) <= 0.0_wp) then ! exactly the last one, not to round-off
      point = last
      return
    end if
    point%speed = first%speed + fraction*(last%speed - first%speed)
    point%load = first%load + fraction*(last%load - first%load)
    point%place = first%place + fraction*(last%place - first%place)
    point%growth = first%growth + fraction*(last%growth - first%growth)
    point%supply = first%supply + fraction*(last%supply - first%supply)
    point%edge_pull = first%edge_pull + fraction*(last%edge_pull - first%edge_pull)
    point%edge_tension = first%edge_tension + fraction*(last%edge_tension - first%edge_tension)
    point%edge_hold = first%edge_hold + fraction*(last%edge_hold - first%edge_hold)
    point%edge_height = first%edge_height + fraction*(last%edge_height - first%edge_height)
  end function point_between

  !> Saves or restores a point.
  pure subroutine visit_point(archive, point)
    type(archive_type), intent(inout) :: archive !! saves or restores
    type(operating_point_type), intent(inout) :: point !! written where the archive restores

    call archive%visit('speed', point%speed)
    call archive%visit('load', point%load)
    call archive%visit('place', point%place)
    call archive%visit('inertia', point%inertia)
    call archive%visit('growth', point%growth)
    call archive%visit('supply', point%supply)
    call archive%visit('edge_pull', point%edge_pull)
    call archive%visit('edge_tension', point%edge_tension)
    call archive%visit('edge_hold', point%edge_hold)
    call archive%visit('edge_height', point%edge_height)
  end subroutine visit_point
end module gfb_operating_point
