#include "gfb_petsc.h"
!> A shaft that moves, from an equilibrium on: over time, or on orbits that close.
module gfb_motions
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: build_like
  use gfb_newton, only: newton_type, newton_settings_type, create_newton, forget_factors, destroy_newton
  use gfb_run_log, only: run_log_type
  use gfb_bearing_record, only: bearing_record_type
  use gfb_quantity, only: quantity_type
  use gfb_case_file, only: case_array_type
  use gfb_reasons, only: reason_type
  use gfb_run_context, only: run_context_type
  use gfb_transient, only: transient_type
  use gfb_periodic, only: periodic_type
  implicit none (type)
  private
  public :: moves

  !> What was found of the motion asked for.
  type, public :: motion_type
    type(transient_type), allocatable :: transient
    type(periodic_type), allocatable :: periodic
  contains
    procedure :: run
    procedure :: results
    procedure :: add_arrays
  end type motion_type

contains

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
    type(newton_settings_type) :: settings
    integer :: counts(4), steps, i

    settings = newton%settings
    counts = [newton%iterations, newton%factorizations, newton%factorizations_before, newton%enlargements]
    call forget_factors(newton)
    call destroy_newton(newton)
    call build_like(scene, bearing, both, error, scene%rotor%distance_in_time)
    if (allocated(error)) return
    call take_state(bearing, both)
    call bearing%destroy()
    bearing = both
    call create_newton(newton, bearing, 'bearing_', settings, log)
    newton%iterations = counts(1)
    newton%factorizations = counts(2)
    newton%factorizations_before = counts(3)
    newton%enlargements = counts(4)
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

  !> Whether a scene asks for a motion.
  pure function moves(scene)
    type(scene_type), intent(in) :: scene !! what is asked for
    logical :: moves
    moves = scene%transient%present .or. scene%periodic%present
  end function moves

  !> Follows the shaft; one that tilts on two bearings.
  !>
  !> Fails when a restart file is damaged.
  subroutine run(self, scene, context, bearing, newton, record, reason, error)
    class(motion_type), intent(inout) :: self !! gets what is found
    type(scene_type), intent(in) :: scene !! that asks for a motion
    type(run_context_type), intent(in) :: context !! of the run
    type(bearing_system_type), target, intent(inout) :: bearing !! where the shaft begins; left at its end
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(bearing_record_type), intent(inout) :: record !! of where the shaft begins
    type(reason_type), intent(inout) :: reason !! why there is no answer
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (scene%transient%present) then
      allocate (self%transient)
      if (scene%rotor%distance_in_time > 0.0_wp .and. .not. context%restart%goes_on) then
        call stand_on_two(scene, context%log, bearing, newton, record, error)
      end if
      if (allocated(error)) return
      call self%transient%run(scene, context, bearing, newton, record, reason, error)
    else
      allocate (self%periodic)
      call self%periodic%run(scene, context, bearing, newton, reason)
    end if
  end subroutine run

  !> What the summary says of it.
  function results(self) result(found)
    class(motion_type), intent(in) :: self !! what was found
    type(quantity_type), allocatable :: found(:)

    if (allocated(self%transient)) then
      found = self%transient%results()
    else
      found = self%periodic%results()
    end if
  end function results

  !> Adds it to what the result file gets.
  subroutine add_arrays(self, arrays)
    class(motion_type), intent(in) :: self !! what was found
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name

    if (allocated(self%transient)) call self%transient%add_arrays(arrays)
    if (allocated(self%periodic)) call self%periodic%add_arrays(arrays)
  end subroutine add_arrays
end module gfb_motions
