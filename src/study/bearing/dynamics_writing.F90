#include "gfb_petsc.h"
!> The arrays of a record, and the table of coefficients under small vibrations as a file for other programs.
module gfb_dynamics_writing
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_petsc_session, only: this_rank, share_failure
  use gfb_sweep_case, only: sweep_keys
  use gfb_bearing_record, only: bearing_record_type, sweep_name
  use gfb_case_file, only: case_array_type, add_arrays
  use gfb_contact_record, only: foil_contact_arrays
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamics_record, only: dynamics_arrays, dynamics_table
  use gfb_text_file, only: write_text_file
  use gfb_run_context, only: run_context_type
  implicit none (type, external)
  private
  public :: record_arrays, write_coefficients

contains

  !> What a record has beside its history: contacts, coefficients, modes.
  function record_arrays(scene, bearing, record, points) result(arrays)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(in) :: bearing !! whose contacts were recorded
    type(bearing_record_type), intent(in) :: record !! of all points
    integer, intent(in) :: points !! of it, from the first
    type(case_array_type), allocatable :: arrays(:)

    arrays = foil_contact_arrays(bearing, record%contacts, points)
    call add_arrays(arrays, dynamics_arrays(record%dynamics, scene%sweep%present, points))
  end function record_arrays

  !> Writes `<case>.coefficients.csv`; nothing where there is no answer.
  !>
  !> Fails when the file cannot be written.
  subroutine write_coefficients(record, scene, context, error)
    type(bearing_record_type), intent(in) :: record !! of all answers
    type(scene_type), intent(in) :: scene !! whose name the file has
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: name
    real(wp), allocatable :: values(:)
    integer :: i, k

    if (.not. allocated(record%dynamics%point)) return
    if (size(record%dynamics%point) == 0) return ! as a restart file leaves it
    name = ''
    allocate (values(size(record%history)), source=0.0_wp)
    if (scene%sweep%present) then
      name = 'key_value'
      if (scene%sweep%parameter /= sweep_keys) name = sweep_name(scene%sweep)
    end if
    do i = 1, size(values)
      do k = 1, size(record%history(i)%quantity)
        if (record%history(i)%quantity(k)%name == name) values(i) = record%history(i)%quantity(k)%number
      end do
    end do
    if (this_rank() == 0) then
      call write_text_file(context%folder//'/'//scene%name//'.coefficients.csv', dynamics_table(record%dynamics, name, values), error)
    end if
    call share_failure(error)
    if (.not. allocated(error)) call context%log%line('table of coefficients: '//scene%name//'.coefficients.csv')
  end subroutine write_coefficients
end module gfb_dynamics_writing
