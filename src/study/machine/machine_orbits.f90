!> The map over a period of a machine in equilibrium, by what its case file asks for.
module gfb_machine_orbits
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: transient_case_type
  use gfb_shaft, only: body_type
  use gfb_held_shaft, only: free_motions
  use gfb_machine, only: machine_type
  use gfb_machine_drive, only: machine_drive
  use gfb_machine_equilibrium, only: machine_bearing_type, machine_equilibrium_type
  use gfb_machine_map, only: machine_map_type, create_machine_map
  use gfb_machine_parts, only: part_type
  use gfb_machine_places, only: shown_places, nodes_of_places
  use gfb_time_march, only: begin_rubbing
  use gfb_transient, only: settings_of
  use gfb_period_map, only: period_map_type
  use gfb_bearing_orbits, only: set_parameter, make_tight
  implicit none (type, external)
  private
  public :: map_of_machine

contains

  !> The map of a scene, and the bounds of its parameter.
  subroutine map_of_machine(scene, part, machine, answer, bearing, map, bounds)
    type(scene_type), intent(in) :: scene !! of the machine, with `&periodic`
    type(part_type), intent(in) :: part(:) !! its bearings
    type(machine_type), target, intent(in) :: machine
    type(machine_equilibrium_type), intent(in) :: answer !! where it rests
    !> of the parts, there; their journals become held
    type(machine_bearing_type), target, intent(inout) :: bearing(:)
    class(period_map_type), allocatable, intent(out) :: map !! created
    real(wp), intent(out) :: bounds(2) !! of the parameter of a point: begin, end [1]
    type(machine_map_type), allocatable :: own
    type(transient_case_type) :: steady
    type(body_type) :: body
    integer :: i

    allocate (own)
    do i = 1, size(part)
      call make_tight(bearing(i)%newton)
      bearing(i)%bearing%shaft_fixed = .true.
      call begin_rubbing(bearing(i)%bearing, .false.)
    end do
    steady%final_speed_rpm = scene%operation%speed_rpm
    steady%ramp_time = 1.0_wp
    allocate (steady%base_time(0), steady%base_acceleration_x(0), steady%base_acceleration_y(0))
    own%drive = machine_drive(machine, scene%unbalance, steady, scene%operation)
    body = machine%shaft%body()
    own%driven = [angular_speed(scene%operation%speed_rpm), own%drive%first_unbalance(), body%mass]
    own%settings = [(settings_of(part(i)%scene), i=1, size(part))]
    own%motion = free_motions(answer%held, answer%motion)
    own%place = shown_places(scene%machine)
    own%node = nodes_of_places(machine)
    own%touch_down_gap = [(merge(0.0_wp, part(i)%scene%solver%touch_down_gap, &
          part(i)%scene%shaft_contact%present), i=1, size(part))]
    call set_parameter(scene%periodic, own, bounds)
    call create_machine_map(machine, bearing, own)
    call move_alloc(own, map)
  end subroutine map_of_machine
end module gfb_machine_orbits
