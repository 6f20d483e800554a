#include "gfb_petsc.h"
!> How the critical mass of an answer, the frequency of its whirl, and stiffness and damping follow keys of the case file.
!>
!> The coefficients at a frequency are stationary in the motions \( A y = b \) that give them and in their adjoints,
!> \( A^T z_j = w_j \) with the weights w of the forces:
!>
!> $$ Z_{jk} = w_j^T y_k + z_j^T (b_k - A y_k). $$
!>
!> So with y and z held their change is that of w, b and A alone, which depend on the key and on the answer. The answer
!> follows the key by \( J u_a = -J_a \), one solve with the factors there are; both parts are central differences of
!> this form, of bearings with a little more and less of the key, and of states a little on along \( u_a \). A gap of
!> contacts is changed with the state in one: by itself it would open contacts that are pressed by far less.
!> `gfb_whirl` has how the whirl follows Z. Nothing is factored but the equations at the whirl's frequency, and at that of the
!> coefficients, once.
!>
!> Heat is slow against a whirl: motions are those of a bearing whose temperatures stay as they are, while the answer, from which
!> these are taken, follows the key with them.
module gfb_whirl_sensitivity
  use petscmat
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: any_rank, largest_over_ranks
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: scene_with_key
  use gfb_study_cases, only: parameter_type
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: mass_on, mass_off, frequencies_at
  use gfb_sweep_case, only: swept_key_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_heat_switch, only: held_bearing_type, hold_heat
  use gfb_foil_builder, only: keep_elements
  use gfb_bearing_builder, only: take_numbers, build_changed
  use gfb_newton, only: newton_type
  use gfb_vibration_equations, only: combine
  use gfb_scene_vibration, only: vibration_of
  use gfb_complex_solver, only: keep_entries
  use gfb_dynamic_response, only: dynamic_response_type, create_response, find_sample, forces_of, force_gradient, &
                                  response_failure, destroy_response
  use gfb_foil_weighing, only: give_mass
  use gfb_whirl, only: whirl_type
  use gfb_planar_eigenvalues, only: whirl_rates
  use gfb_corrected_solve, only: solve_corrected
  use gfb_key_effect, only: moves_point
  use gfb_key_differences, only: difference_type, vibration_difference_of, present_value, step_of, changed_point, keeps_meshes, changes_foils, by_answer
  implicit none (type)
  private
  public :: derive_whirl, derive_coefficients

  integer, parameter :: planar = 2 !! motions, and forces

  !> of a key that may be 0 and not less: forward differences of second order
  type(difference_type), parameter :: of_gap = &
    difference_type(1.0e-4_wp, [0.0_wp, 0.0_wp, -1.5_wp, 2.0_wp, -0.5_wp])
  character(len=*), parameter :: flips = 'a contact opens or closes at a value close by'

  !> The motions at a frequency, at the answer.
  type :: whirl_form_type
    logical :: weighs !! the foil has its mass
    complex(wp) :: rate !! lambda [1/s]
    complex(wp) :: matrix(planar, planar)       !! Z [N/m]
    complex(wp) :: by_frequency(planar, planar) !! its derivative by the frequency [N s/m]
    real(wp), allocatable :: unknown(:)      !! of the answer, local, in SI
    real(wp), allocatable :: motion(:, :, :) !! (local unknowns, real and imaginary part, motions) y, in SI
    logical, allocatable :: closed(:)        !! this rank's contacts
    type(tVec) :: adjoint(2, planar)         !! (real and imaginary part, forces) z, scaled
  end type whirl_form_type

contains

  !> Derivatives of critical mass and whirl ratio by all parameters.
  subroutine derive_whirl(scene, bearing, newton, tangent, whirl, derivative, problem, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(inout) :: bearing !! at its answer, and at the same one after
    type(newton_type), intent(inout) :: newton !! with the factors of `find_determinant_sign`; what is factored is counted
    Mat, intent(in) :: tangent !! the equations' matrix at the answer
    type(whirl_type), intent(in) :: whirl !! of the answer
    real(wp), intent(inout) :: derivative(:, :) !! ([kg] and [1] over the key's unit, parameter), stays where there is none
    character(len=:), allocatable, intent(out) :: problem !! why there are none by some parameter
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(whirl_form_type) :: form
    complex(wp) :: change(planar, planar, size(derivative, 2))
    real(wp) :: rates(2), turning
    logical :: found(size(derivative, 2))
    integer :: i

    problem = ''
    if (.not. whirl%found) problem = 'any key: no rigid shaft whirls'
    if (whirl%found .and. .not. whirl%critical_mass > 0.0_wp) problem = 'any key: every mass whirls, the critical one is 0'
    if (problem /= '') return
    form%weighs = whirl%weighs
    form%rate = cmplx(0.0_wp, whirl%ratio*bearing%point%speed, wp)
    call derive_form(scene, bearing, newton, tangent, form, change, found, problem, at)
    do i = 1, size(found)
      if (.not. found(i)) cycle
      rates = whirl_rates(form%matrix, form%by_frequency, change(:, :, i), aimag(form%rate))
      turning = speed_by(scene%sensitivity%parameter(i))
      derivative(:, i) = [rates(1), (rates(2) - whirl%ratio*turning)/bearing%point%speed]
    end do
  end subroutine derive_whirl

  !> Derivatives of stiffness and damping at the first frequency by all parameters. Of a frequency over the speed the speed moves it:
  !>
  !> $$ Z_a + Z_\omega \omega_a = K_a + i (\omega C_a + \omega_a C). $$
  subroutine derive_coefficients(scene, bearing, newton, tangent, weighs, coefficient, derivative, problem, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(inout) :: bearing !! at its answer, and at the same one after
    type(newton_type), intent(inout) :: newton !! with the factors of `find_determinant_sign`; what is factored is counted
    Mat, intent(in) :: tangent !! the equations' matrix at the answer
    logical, intent(in) :: weighs !! the foil has its mass
    real(wp), intent(out) :: coefficient(:) !! entries of K [N/m] and C [N s/m], row by row
    real(wp), intent(inout) :: derivative(:, :) !! (entries, parameter) over the key's unit, stays where there is none
    character(len=:), allocatable, intent(out) :: problem !! why there are none by some parameter
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(whirl_form_type) :: form
    complex(wp) :: change(planar, planar, size(derivative, 2)), whole(planar, planar)
    real(wp), allocatable :: frequency(:)
    real(wp) :: damping(planar, planar), frequency_by
    logical :: found(size(derivative, 2))
    integer :: i

    frequency = frequencies_at(scene%dynamics, bearing%point%speed)
    form%weighs = weighs
    form%rate = cmplx(0.0_wp, frequency(1), wp)
    problem = ''
    form%matrix = 0.0_wp
    call derive_form(scene, bearing, newton, tangent, form, change, found, problem, at)
    damping = aimag(form%matrix)/frequency(1)
    coefficient = [transpose(real(form%matrix, wp)), transpose(damping)]
    do i = 1, size(found)
      if (.not. found(i)) cycle
      frequency_by = 0.0_wp
      if (size(scene%dynamics%ratios) > 0) frequency_by = scene%dynamics%ratios(1)*speed_by(scene%sensitivity%parameter(i))
      whole = change(:, :, i) + form%by_frequency*frequency_by
      derivative(:, i) = [transpose(real(whole, wp)), transpose((aimag(whole) - damping*frequency_by)/frequency(1))]
    end do
  end subroutine derive_coefficients

  !> How the angular speed follows a key [rad/s over its unit].
  pure real(wp) function speed_by(parameter)
    type(parameter_type), intent(in) :: parameter

    speed_by = 0.0_wp
    if (parameter%key%label() == 'operation%speed_rpm') speed_by = angular_speed(1.0_wp)
  end function speed_by

  !> The coefficients at a frequency, and how they follow all parameters while it stays.
  subroutine derive_form(scene, bearing, newton, tangent, form, change, found, problem, at)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    Mat, intent(in) :: tangent
    type(whirl_form_type), intent(inout) :: form !! with its frequency
    complex(wp), intent(out) :: change(:, :, :) !! of Z by each parameter [N/m over its unit]
    logical, intent(out) :: found(:) !! there is one
    character(len=:), allocatable, intent(inout) :: problem !! why there are none by some parameter
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(tMat) :: of_newton
    character(len=:), allocatable :: words
    PetscErrorCode :: ierr
    integer :: i

    found = .false.
    allocate (form%unknown(bearing%local_size()))
    call bearing%get_unknowns(form%unknown)
    ! The matrix that has the factors is left alone.
    of_newton = bearing%jacobian
    PetscCallA(MatDuplicate(of_newton, MAT_COPY_VALUES, bearing%jacobian, ierr))
    call find_motions(scene, bearing, newton, form, words)
    if (words /= '') problem = 'any key: '//words
    associate (parameter => scene%sensitivity%parameter)
      do i = 1, merge(size(parameter), 0, words == '')
        call newton%log%is_at('derivative by '//parameter(i)%key%label()//', '//text(i)//' of '//text(size(parameter)), &
                              real(i - 1, wp)/size(parameter))
        call newton%log%waiting('')
        call derive_by(scene, parameter(i), bearing, newton, tangent, form, change(:, :, i), words, at)
        found(i) = words == ''
        if (.not. found(i)) problem = parameter(i)%key%label()//': '//words
      end do
      call newton%log%is_at('')
    end associate
    PetscCallA(MatDestroy(bearing%jacobian, ierr))
    bearing%jacobian = of_newton
    do i = 1, planar
      PetscCallA(VecDestroy(form%adjoint(1, i), ierr))
      PetscCallA(VecDestroy(form%adjoint(2, i), ierr))
    end do
  end subroutine derive_form

  !> Coefficients at the frequency, motions and adjoints, with one factorization.
  subroutine find_motions(scene, bearing, newton, form, problem)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(whirl_form_type), intent(inout) :: form
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(dynamic_response_type) :: response
    type(held_bearing_type) :: held
    complex(wp), allocatable :: z(:, :), slope(:, :)
    real(wp), allocatable :: gradient(:, :)
    PetscErrorCode :: ierr
    logical :: all_found
    integer :: k

    call hold_heat(bearing, held)
    call respond(scene, held%bearing, form, response, newton%log)
    form%closed = closed_contacts(held%bearing)
    allocate (form%motion(held%bearing%local_size(), 2, planar))
    associate (part => response%part(1), change => response%change, rate => form%rate)
      allocate (z(size(part%coordinate), size(part%coordinate)), source=(0.0_wp, 0.0_wp))
      slope = z
      call find_sample(held%bearing, response, 1, rate, z, slope, all_found)
      form%matrix = z(:planar, :planar)
      form%by_frequency = (0.0_wp, 1.0_wp)*slope(:planar, :planar)
      gradient = force_gradient(held%bearing, response, part)
      do k = 1, planar
        PetscCallA(VecDuplicate(held%bearing%state, form%adjoint(1, k), ierr))
        PetscCallA(VecDuplicate(held%bearing%state, form%adjoint(2, k), ierr))
        if (.not. all_found) cycle
        call held%bearing%get_unknowns(form%motion(:, 1, k), change%re(k))
        call held%bearing%get_unknowns(form%motion(:, 2, k), change%im(k))
        PetscCallA(VecSet(form%adjoint(1, k), 0.0_wp, ierr))
        PetscCallA(VecSet(form%adjoint(2, k), 0.0_wp, ierr))
        call held%bearing%exchange%add(gradient(:, k)*held%bearing%unknown_scale, form%adjoint(1, k))
        call keep_entries(form%adjoint(1, k), part%kept)
      end do
      if (all_found) call part%solver%solve(form%adjoint(1, :), form%adjoint(2, :), all_found, transposed=.true.)
    end associate
    problem = ''
    if (.not. all_found) problem = response_failure(response)
    newton%factorizations = newton%factorizations + response%factorizations
    newton%enlargements = newton%enlargements + response%enlargements
    call destroy_response(response)
  end subroutine find_motions

  !> A bearing's response to vibrations, its foil weighed or not as at the answer.
  subroutine respond(scene, bearing, form, response, log)
    type(scene_type), intent(in) :: scene !! of the bearing
    type(bearing_system_type), intent(inout) :: bearing
    type(whirl_form_type), intent(in) :: form
    type(dynamic_response_type), intent(out) :: response !! to be destroyed
    type(run_log_type), optional, intent(in) :: log !! where something is factored

    call create_response(bearing, vibration_of(scene), response, log=log)
    call give_mass(bearing, response, merge(mass_on, mass_off, form%weighs), scene%foil_damping%foil_modes, &
                   aimag(form%rate))
  end subroutine respond

  !> Whether this rank's contacts are closed, as they are linearised.
  function closed_contacts(bearing) result(closed)
    type(bearing_system_type), intent(in) :: bearing
    logical, allocatable :: closed(:)
    integer :: i

    allocate (closed(0))
    do i = 1, size(bearing%pad)
      if (bearing%pad(i)%foil%has_contacts()) closed = [closed, bearing%pad(i)%foil%contacts%point%place(3) > 0.0_wp]
    end do
  end function closed_contacts

  !> The form of the coefficients in a bearing close by, with the answer's motions and adjoints.
  subroutine evaluate_form(scene, bearing, form, matrix, problem)
    type(scene_type), intent(in) :: scene !! of the bearing
    type(bearing_system_type), target, intent(inout) :: bearing !! in its state
    type(whirl_form_type), intent(in) :: form
    complex(wp), intent(out) :: matrix(:, :) !! Z [N/m]
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(dynamic_response_type) :: response
    type(held_bearing_type) :: held
    complex(wp), allocatable :: force(:)
    PetscErrorCode :: ierr
    PetscScalar :: along(2, 2)
    integer :: i, j, k

    call hold_heat(bearing, held)
    call respond(scene, held%bearing, form, response)
    problem = ''
    if (any_rank(any(closed_contacts(held%bearing) .neqv. form%closed))) problem = flips
    call combine(response%equations, form%rate)
    associate (part => response%part(1), one => response%one, other => response%other, rise => response%rise)
      do k = 1, planar
        call held%bearing%exchange%put(form%motion(:, 1, k)/held%bearing%unknown_scale, one)
        call held%bearing%exchange%put(form%motion(:, 2, k)/held%bearing%unknown_scale, other)
        force = cmplx(forces_of(held%bearing, response, part, k, 1.0_wp, one), &
                      forces_of(held%bearing, response, part, k, 0.0_wp, other), wp)
        call find_rest(response, form%rate, k)
        call keep_entries(rise%re(k), part%kept)
        call keep_entries(rise%im(k), part%kept)
        do j = 1, planar
          do i = 1, 2
            PetscCallA(VecDot(form%adjoint(i, j), rise%re(k), along(i, 1), ierr))
            PetscCallA(VecDot(form%adjoint(i, j), rise%im(k), along(i, 2), ierr))
          end do
          matrix(j, k) = force(j) + cmplx(along(1, 1) - along(2, 2), along(1, 2) + along(2, 1), wp)
        end do
      end do
    end associate
    call destroy_response(response)
  end subroutine evaluate_form

  !> What the motion in `one` and `other` leaves of the equations, \( b - A y \), into that of `rise`.
  subroutine find_rest(response, rate, coordinate)
    type(dynamic_response_type), intent(in) :: response !! with A combined
    complex(wp), intent(in) :: rate !! lambda [1/s]
    integer, intent(in) :: coordinate !! that moves
    PetscErrorCode :: ierr

    associate (re => response%equations%real_part, im => response%equations%imaginary_part, one => response%one, &
               other => response%other, rest_re => response%rise%re(coordinate), rest_im => response%rise%im(coordinate), &
               product => response%change%re(coordinate), steady => response%steady_column(coordinate), &
               squeeze => response%squeeze_column(coordinate))
      PetscCallA(MatMult(re, one, rest_re, ierr))
      PetscCallA(MatMult(im, other, product, ierr))
      PetscCallA(VecAYPX(rest_re, -1.0_wp, product, ierr))
      PetscCallA(VecAXPY(rest_re, 1.0_wp, steady, ierr))
      PetscCallA(VecAXPY(rest_re, real(rate, wp), squeeze, ierr))
      PetscCallA(MatMult(re, other, rest_im, ierr))
      PetscCallA(MatMult(im, one, product, ierr))
      PetscCallA(VecAXPY(rest_im, 1.0_wp, product, ierr))
      PetscCallA(VecScale(rest_im, -1.0_wp, ierr))
      PetscCallA(VecAXPY(rest_im, aimag(rate), squeeze, ierr))
    end associate
  end subroutine find_rest

  !> How the coefficients follow a key, with the answer, while the frequency stays.
  subroutine derive_by(scene, parameter, bearing, newton, tangent, form, change, problem, at)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(in) :: newton
    Mat, intent(in) :: tangent
    type(whirl_form_type), intent(in) :: form
    complex(wp), intent(out) :: change(:, :) !! of Z
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    complex(wp) :: along_answer(planar, planar)
    real(wp) :: direction(bearing%local_size())
    Vec :: of_residual, of_answer
    PetscErrorCode :: ierr
    logical :: solved

    PetscCallA(VecDuplicate(bearing%state, of_residual, ierr))
    PetscCallA(VecDuplicate(bearing%state, of_answer, ierr))
    call differ_by_key(scene, parameter, bearing, form, of_residual, change, problem, at)
    if (problem == '') then
      call solve_corrected(newton, bearing, tangent, of_residual, of_answer, .false., solved)
      if (.not. solved) problem = 'the linearised equations were not solved'
    end if
    if (problem == '') then
      call bearing%get_unknowns(direction, of_answer) ! minus the change
      along_answer = 0.0_wp
      if (parameter%key%is_gap()) then
        call differ_by_key(scene, parameter, bearing, form, of_residual, change, problem, at, along=-direction)
      else
        call differ_by_answer(scene, bearing, form, direction, along_answer, problem)
      end if
    end if
    if (problem == '') change = change - along_answer
    PetscCallA(VecDestroy(of_residual, ierr))
    PetscCallA(VecDestroy(of_answer, ierr))
  end subroutine derive_by

  !> Derivatives of residual and coefficients by a key, the answer's unknowns held; of the coefficients alone where
  !> these change as well.
  subroutine differ_by_key(scene, parameter, bearing, form, of_residual, change, problem, at, along)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    type(bearing_system_type), intent(inout) :: bearing
    type(whirl_form_type), intent(in) :: form
    Vec, intent(in) :: of_residual !! scaled
    complex(wp), intent(out) :: change(:, :) !! of Z; of a gap, the unknowns held, it is 0
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    real(wp), intent(in), optional :: along(:) !! how local unknowns follow the key, in SI over its unit
    type(difference_type) :: difference
    complex(wp) :: matrix(planar, planar)
    real(wp) :: value, step
    Vec :: residual
    PetscErrorCode :: ierr
    integer :: steps

    value = present_value(scene, parameter, bearing%point, at)
    difference = vibration_difference_of(parameter%key)
    if (parameter%key%is_gap()) difference = of_gap
    step = step_of(scene, parameter%key, difference, value)
    problem = ''
    if (.not. step > 0.0_wp) problem = 'it is 0 here'
    change = 0.0_wp
    PetscCallA(VecDuplicate(bearing%state, residual, ierr))
    PetscCallA(VecSet(of_residual, 0.0_wp, ierr))
    do steps = -2, 2
      if (problem /= '') exit
      if (.not. abs(difference%weight(steps)) > 0.0_wp) cycle
      if (present(along)) then
        call evaluate_with(scene, parameter, value + steps*step, bearing, form, residual, matrix, problem, at, &
                           form%unknown + steps*step*along)
      else
        call evaluate_with(scene, parameter, value + steps*step, bearing, form, residual, matrix, problem, at)
      end if
      PetscCallA(VecAXPY(of_residual, difference%weight(steps)/step, residual, ierr))
      change = change + difference%weight(steps)/step*matrix
    end do
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine differ_by_key

  !> Residual and coefficients at the answer's state with another value of a key, or in another state; the bearing is as
  !> before on return.
  subroutine evaluate_with(scene, parameter, value, bearing, form, residual, matrix, problem, at, state)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    real(wp), intent(in) :: value !! of the key [its unit]
    type(bearing_system_type), intent(inout) :: bearing
    type(whirl_form_type), intent(in) :: form
    Vec, intent(in) :: residual !! scaled
    complex(wp), intent(out) :: matrix(:, :) !! Z [N/m]
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    real(wp), intent(in), optional :: state(:) !! local unknowns, in SI
    type(operating_point_type) :: before
    type(bearing_system_type) :: other
    type(scene_type), allocatable :: there ! large
    type(error_type), allocatable :: error
    logical :: moved

    matrix = 0.0_wp
    if (moves_point(parameter%key%acts_on)) then
      before = bearing%point
      bearing%point = changed_point(parameter, value, before)
      call evaluate(scene, bearing)
      bearing%point = before
      return
    end if
    allocate (there)
    call scene_with_key(scene, parameter%key, value, there, error, at)
    if (.not. allocated(error)) then
      call keep_elements(scene, there)
      if (keeps_foils(scene, parameter%key)) then
        call take_numbers(there, bearing)
        call evaluate(there, bearing)
        call take_numbers(scene, bearing)
        call bearing%set_unknowns(form%unknown)
        call bearing%settle(bearing%state, moved)
        return
      end if
      call build_changed(there, bearing, form%unknown, other, problem, error)
    end if
    if (allocated(error)) problem = error%message
    if (problem /= '') return
    call evaluate(there, other)
    call other%destroy()

  contains

    subroutine evaluate(of, changed)
      type(scene_type), intent(in) :: of
      type(bearing_system_type), intent(inout) :: changed
      logical :: valid

      if (present(state)) call changed%set_unknowns(state)
      call changed%evaluate(changed%state, residual, valid)
      if (any_rank(.not. valid)) then
        problem = 'the film is closed at a value close by'
      else if (present(state) .or. .not. parameter%key%is_gap()) then
        call evaluate_form(of, changed, form, matrix, problem)
      end if
    end subroutine evaluate
  end subroutine evaluate_with

  !> Whether a key moves no mesh, and leaves what is assembled of the foils as it is.
  pure logical function keeps_foils(scene, key) result(keeps)
    type(scene_type), intent(in) :: scene
    type(swept_key_type), intent(in) :: key

    keeps = scene%model%foil%has_bumps .and. keeps_meshes(key) .and. .not. changes_foils(key)
  end function keeps_foils

  !> Derivative of the coefficients along a change of the answer.
  subroutine differ_by_answer(scene, bearing, form, direction, change, problem)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(inout) :: bearing !! on return at its answer again
    type(whirl_form_type), intent(in) :: form
    real(wp), intent(in) :: direction(:) !! the change of local unknowns, in SI
    complex(wp), intent(out) :: change(:, :) !! of Z
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    complex(wp) :: matrix(planar, planar)
    real(wp) :: largest(1), step
    integer :: i, side
    logical :: moved

    change = 0.0_wp
    problem = ''
    largest = largest_over_ranks([maxval(abs(direction/bearing%unknown_scale))])
    if (.not. largest(1) > 0.0_wp) return
    do i = 1, size(by_answer)
      change = 0.0_wp
      problem = ''
      step = by_answer(i)%part/largest(1)
      do side = -2, 2
        if (problem /= '' .or. .not. abs(by_answer(i)%weight(side)) > 0.0_wp) cycle
        call bearing%set_unknowns(form%unknown + side*step*direction)
        call evaluate_form(scene, bearing, form, matrix, problem)
        change = change + by_answer(i)%weight(side)/step*matrix
      end do
      if (problem /= flips) exit
    end do
    call bearing%set_unknowns(form%unknown)
    call bearing%settle(bearing%state, moved)
  end subroutine differ_by_answer
end module gfb_whirl_sensitivity
