#include "gfb_petsc.h"
!> A bearing whose shaft moves, from its equilibrium on: over time, or on orbits that close.
module gfb_motion_study
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type, free_equations
  use gfb_heat_switch, only: freeze_heat
  use gfb_bearing_solution, only: bearing_solution_type
  use gfb_bearing_builder, only: build_like
  use gfb_newton, only: newton_type, renew_newton, forget_factors
  use gfb_run_log, only: run_log_type
  use gfb_bearing_record, only: bearing_record_type
  use gfb_case_file, only: case_array_type
  use gfb_run_context, only: run_context_type
  use gfb_transient, only: transient_type
  use gfb_period_map, only: period_map_type
  use gfb_bearing_orbits, only: map_of_bearing
  use gfb_periodic, only: periodic_type
  use gfb_bearing_study, only: bearing_study_type
  use gfb_onset, only: judge_first_point
  implicit none (type)
  private
  public :: stop_heat

  !> The bearing, and its shaft over time.
  type, extends(bearing_study_type), public :: transient_study_type
    type(transient_type), allocatable, private :: motion !! once there is the equilibrium
  contains
    procedure :: find_answers => find_transient, add_arrays => add_transient
  end type transient_study_type

  !> The bearing, and its shaft's orbits.
  type, extends(bearing_study_type), public :: periodic_study_type
    type(periodic_type), allocatable, private :: motion !! once there is the equilibrium
  contains
    procedure :: find_answers => find_orbits, add_arrays => add_orbits
  end type periodic_study_type

contains

  !> Finds where the shaft begins, and follows it; one that tilts on two bearings.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine find_transient(self, scene, context, error)
    class(transient_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type) :: first

    first = scene
    first%operation%load = scene%transient%start_load
    call self%bearing_study_type%find_answers(first, context, error)
    if (allocated(error) .or. self%reason%is_given()) return
    allocate (self%motion)
    associate (bearing => self%solution%bearing, newton => self%solution%newton, record => self%solution%record)
      if (.not. context%restart%continues) then
        call judge_first_point(self%solution)
        call stop_heat(self%solution)
        if (scene%rotor%distance_in_time > 0.0_wp) call stand_on_two(scene, context%log, bearing, newton, record, error)
        if (allocated(error)) return
      end if
      call self%motion%run(scene, context, bearing, newton, record, self%reason, error)
      if (.not. allocated(error)) call record%move_on(self%motion%results())
    end associate
  end subroutine find_transient

  !> Finds where the shaft begins, and its orbits.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine find_orbits(self, scene, context, error)
    class(periodic_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! with `&periodic`
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    class(period_map_type), allocatable :: map
    real(wp) :: bounds(2)

    call self%bearing_study_type%find_answers(scene, context, error)
    if (allocated(error) .or. self%reason%is_given()) return
    allocate (self%motion)
    call stop_heat(self%solution)
    call map_of_bearing(scene, self%solution%bearing, self%solution%newton, map, bounds)
    call self%motion%run(scene%periodic, context, map, bounds, self%reason)
    call self%solution%record%move_on(self%motion%results())
  end subroutine find_orbits

  !> Adds the history of the time.
  subroutine add_transient(self, arrays)
    class(transient_study_type), intent(in) :: self !! the study
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name
    if (allocated(self%motion)) call self%motion%add_arrays(arrays)
  end subroutine add_transient

  !> Adds the table of orbits.
  subroutine add_orbits(self, arrays)
    class(periodic_study_type), intent(in) :: self !! the study
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name
    if (allocated(self%motion)) call self%motion%add_arrays(arrays)
  end subroutine add_orbits

  !> From an equilibrium on all temperatures stay as they are.
  subroutine stop_heat(solution)
    type(bearing_solution_type), target, intent(inout) :: solution !! at its equilibrium
    type(bearing_system_type) :: frozen

    associate (bearing => solution%bearing, newton => solution%newton)
      if (.not. bearing%has_slow_unknowns()) return
      call forget_factors(newton)
      call freeze_heat(bearing, frozen)
      call free_equations(bearing)
      bearing = frozen
      call renew_newton(newton, bearing, 'bearing_')
    end associate
    call solution%context%log%line('heat: temperatures stay as they are here, with the clearance they leave: they change in seconds, '// &
                                   'the shaft moves in milliseconds')
  end subroutine stop_heat

  !> Puts a second bearing beside the first one, and the rotor on both.
  !>
  !> Their pads are those of one system of equations, with the rotor's displacement and its tilts as unknowns; forces, and
  !> what the films hold, are those of both. Fails when the mesh cannot be cut into parts.
  subroutine stand_on_two(scene, log, bearing, newton, record, error)
    type(scene_type), intent(in) :: scene !! with such a rotor
    type(run_log_type), intent(in) :: log !! where a line goes
    type(bearing_system_type), target, intent(inout) :: bearing !! at its equilibrium, aligned; then both
    type(newton_type), target, intent(inout) :: newton !! its solver; then theirs
    type(bearing_record_type), intent(inout) :: record !! of the equilibrium; gets the contacts of the second one
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(bearing_system_type) :: both
    integer :: steps, i

    call forget_factors(newton)
    call build_like(scene, bearing, both, error, scene%rotor%distance_in_time)
    if (allocated(error)) return
    call take_state(bearing, both)
    call bearing%destroy()
    bearing = both
    call renew_newton(newton, bearing, 'bearing_')
    if (allocated(record%contacts%value)) then
      steps = size(record%contacts%value, 3)
      record%contacts%value = reshape([(record%contacts%value(:, :, i), record%contacts%value(:, :, i), i=1, steps)], &
                                      shape(record%contacts%value)*[1, 2, 1])
    end if
    call log%line('rotor: on two equal bearings, '//text(scene%rotor%distance_in_time)//' m apart, with its tilts; forces, torques and gas are those '// &
                  'of both')
  end subroutine stand_on_two

  !> Gives both bearings the state of the one, with the memory of its contacts; equal meshes are divided alike.
  subroutine take_state(bearing, both)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_system_type), intent(inout) :: both
    real(wp) :: from(bearing%local_size()), unknown(both%local_size())
    integer :: i

    call bearing%get_unknowns(from)
    unknown = 0.0_wp
    do i = 1, size(both%pad)
      associate (pad => both%pad(i), one => bearing%pad(modulo(i - 1, size(bearing%pad)) + 1))
        unknown(pad%first + 1:pad%last) = from(one%first + 1:one%last)
        pad%foil%contacts = one%foil%contacts
        if (allocated(one%held)) pad%held = one%held
      end associate
    end do
    unknown(both%first_shaft + 1:both%first_shaft + 2) = bearing%eccentricity()
    call both%set_unknowns(unknown)
    both%settled = bearing%settled
  end subroutine take_state
end module gfb_motion_study
