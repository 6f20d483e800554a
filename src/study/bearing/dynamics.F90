#include "gfb_petsc.h"
!> Small vibrations of the shaft about an answer: stiffness and damping, and the mass that whirls.
module gfb_dynamics
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_rigid, foil_shell, meshes_foils
  use gfb_dynamics_case, only: tangent_stick
  use gfb_strip_load_case, only: bump_stiffness
  use gfb_petsc_session, only: this_rank, share_failure
  use gfb_shaft_motion, only: shaft_coordinates
  use gfb_foundation_foil, only: foundation_stiffness
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: build_opposite
  use gfb_newton, only: newton_type
  use gfb_dynamic_response, only: dynamic_response_type, vibration_type, create_response, find_coefficients, &
                                  destroy_response
  use gfb_whirl, only: whirl_type, find_critical_mass
  use gfb_dynamics_record, only: dynamics_record_type, stiffness_of, damping_of, dynamics_arrays, dynamics_table
  use gfb_case_file, only: case_array_type, add_arrays
  use gfb_text_file, only: write_text_file
  use gfb_run_context, only: run_context_type
  implicit none (type)
  private

  !> The coefficients of a bearing's answer; none without one.
  type, public :: dynamics_type
    type(dynamics_record_type), private :: record
  contains
    procedure :: find => find_dynamics
    procedure :: add_arrays => add_dynamics_arrays
    procedure :: write => write_dynamics
  end type dynamics_type

contains

  !> Coefficients at the frequencies of the scene, and the critical mass; none where there is no answer.
  !>
  !> Fails when a matrix cannot be factorized.
  subroutine find_dynamics(self, scene, log, converged, bearing, newton, found, error)
    class(dynamics_type), intent(inout) :: self !! the coefficients
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    logical, intent(in) :: converged !! the bearing is at its answer
    type(bearing_system_type), intent(inout) :: bearing !! left as it is
    type(newton_type), intent(inout) :: newton !! its factorizations are counted
    type(quantity_type), allocatable, intent(out) :: found(:) !! what the summary says of them
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(dynamic_response_type) :: response
    integer :: i
    logical :: made

    allocate (found(0))
    if (.not. converged) then
      call log%line('no stiffness and damping: they are those of an answer, and there is none')
      return
    end if
    call log%heading('small vibrations')
    call describe(scene, log)
    call start_response(scene, bearing, response, error)
    if (allocated(error)) return
    associate (record => self%record, frequency => scene%dynamics%frequencies)
      allocate (record%coefficient(shaft_coordinates, shaft_coordinates, size(frequency)))
      do i = 1, size(frequency)
        call find_coefficients(bearing, response, frequency(i), record%coefficient(:, :, i), made)
        if (.not. made) call fail(error, 'the matrix of the vibration at '//text(frequency(i))// &
                                  ' rad/s cannot be factorized', status_machine)
        if (allocated(error)) exit
      end do
      record%frequency = frequency
    end associate
    if (.not. allocated(error)) then
      call show_coefficients(log, bearing%point%speed, self%record)
      call add_whirl(log, bearing, response, found)
    end if
    newton%factorizations = newton%factorizations + response%factorizations
    newton%enlargements = newton%enlargements + response%enlargements
    call destroy_response(response)
  end subroutine find_dynamics

  !> The bearing linearised at its answer, with that of tilts where shells are solved on half the width.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine start_response(scene, bearing, response, error)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(inout) :: bearing
    type(dynamic_response_type), intent(out) :: response
    type(error_type), allocatable, intent(out) :: error
    type(bearing_system_type), allocatable :: opposite

    if (scene%model%foil == foil_shell .and. bearing%pad(1)%whole%half) then
      allocate (opposite)
      call build_opposite(scene, bearing, opposite, error)
      if (allocated(error)) return
    end if
    call create_response(bearing, vibration_of(scene), response, opposite)
  end subroutine start_response

  !> What the foil does under vibration.
  pure function vibration_of(scene) result(vibration)
    type(scene_type), intent(in) :: scene
    type(vibration_type) :: vibration

    vibration%stick = scene%dynamics%contact_tangent == tangent_stick
    vibration%loss_factor = scene%dynamics%loss_factor
    if (scene%dynamics%foundation_damping > 0.0_wp) then
      vibration%damping_time = scene%dynamics%foundation_damping/foundation_stiffness(scene%model, scene%bump_foil)
    end if
  end function vibration_of

  !> What is modelled of the foil, and what is not.
  subroutine describe(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
    real(wp) :: mass !! of both foils [kg/m2]

    associate (dynamics => scene%dynamics, foil => scene%model%foil)
      if (meshes_foils(foil)) then
        call log%line('contacts: closed ones stay closed, and if they rub '// &
                      trim(merge('stick   ', 'slide on', dynamics%contact_tangent == tangent_stick)))
        if (dynamics%loss_factor > 0.0_wp) then
          call log%line('losses: loss_factor acts on the stiffness of top foil and bumps, in the place of friction')
        end if
        mass = scene%top_foil%density*scene%top_foil%thickness &
          + scene%bump_foil%density*scene%bump_foil%thickness
        if (mass > 0.0_wp) then
          call log%line('foil mass: left out; on bumps as single springs it is resonant near '// &
                        text(sqrt(bump_stiffness(scene%bump_foil)/mass)/turn, 2)//' Hz, lifted edges lower')
        else
          call log%line('foil mass: left out')
        end if
      else if (foil /= foil_rigid) then
        call log%line('foil mass: left out')
      end if
    end associate
  end subroutine describe

  !> A line a frequency.
  subroutine show_coefficients(log, speed, record)
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    type(dynamics_record_type), intent(in) :: record
    integer, parameter :: digits = 4
    character(len=:), allocatable :: line
    real(wp) :: k(shaft_coordinates, shaft_coordinates), c(shaft_coordinates, shaft_coordinates)
    integer :: i, row

    call log%line('frequency [rad/s] (over speed)   Kxx Kxy Kyx Kyy [N/m]   Cxx Cxy Cyx Cyy [N s/m]')
    do i = 1, size(record%frequency)
      k = stiffness_of(record, i)
      c = damping_of(record, i)
      line = text(record%frequency(i), digits)
      if (speed > 0.0_wp) line = line//' ('//text(record%frequency(i)/speed, digits)//')'
      line = line//'  '
      do row = 1, 2
        line = line//' '//text(k(row, 1), digits)//' '//text(k(row, 2), digits)
      end do
      line = line//'  '
      do row = 1, 2
        line = line//' '//text(c(row, 1), digits)//' '//text(c(row, 2), digits)
      end do
      call log%line(line)
    end do
  end subroutine show_coefficients

  !> Looks for the mass that whirls, where the shaft turns.
  subroutine add_whirl(log, bearing, response, found)
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(quantity_type), allocatable, intent(inout) :: found(:)
    type(whirl_type) :: whirl

    if (.not. bearing%point%speed > 0.0_wp) return
    call find_critical_mass(bearing, response, whirl)
    if (whirl%found) then
      call log%line('critical mass '//text(whirl%critical_mass, 5)//' kg on this bearing: heavier rigid shafts whirl, at '// &
                    text(whirl%ratio, 5)//' of the speed')
      call add_result(found, 'critical_mass', whirl%critical_mass)
      call add_result(found, 'whirl_ratio', whirl%ratio)
    else if (whirl%searched) then
      call log%line('no critical mass: no rigid shaft whirls between 0.05 and 1.2 times the speed')
    else
      call log%line('no critical mass: a matrix of the search could not be factorized')
    end if
  end subroutine add_whirl

  !> Puts the coefficients behind other arrays of the result file.
  subroutine add_dynamics_arrays(self, arrays)
    class(dynamics_type), intent(in) :: self !! the coefficients
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file

    call add_arrays(arrays, dynamics_arrays(self%record))
  end subroutine add_dynamics_arrays

  !> Writes the table of coefficients, `<case>.coefficients.csv`; nothing where there is no answer.
  !>
  !> Fails when the file cannot be written.
  subroutine write_dynamics(self, scene, context, error)
    class(dynamics_type), intent(in) :: self !! the coefficients
    type(scene_type), intent(in) :: scene !! whose name the file has
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (.not. allocated(self%record%frequency)) return
    if (this_rank() == 0) then
      call write_text_file(context%folder//'/'//scene%name//'.coefficients.csv', dynamics_table(self%record), error)
    end if
    call share_failure(error)
    if (.not. allocated(error)) call context%log%line('table of coefficients: '//scene%name//'.coefficients.csv')
  end subroutine write_dynamics
end module gfb_dynamics
