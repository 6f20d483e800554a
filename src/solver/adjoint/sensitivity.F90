#include "gfb_petsc.h"
!> How numbers of an answer follow keys of the case file, by the adjoint.
!>
!> At an answer \( J(u, a) = 0 \) a number \( g(u, a) \) follows a key a by
!>
!> $$ \frac{dg}{da} = \frac{\partial g}{\partial a} - \lambda^T \frac{\partial J}{\partial a}, \qquad
!>    J_u^T \lambda = g_u: $$
!>
!> one transposed solve a number, with the factors that the answer has. The derivatives by a at a fixed state are
!> differences of residual and number, of bearings with a little more and a little less of the key.
!> Contacts stay open, stick or slide as they do at the answer.
module gfb_sensitivity
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use petscmat
  use gfb_kinds, only: wp
  use gfb_units, only: degrees
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_study_cases, only: parameter_type, quantity_words, quantities_of, of_runner, of_whirl, of_coefficients, derives_stress
  use gfb_sweep_case, only: swept_key_type
  use gfb_operating_point, only: operating_point_type
  use gfb_pad_contacts, only: linearise_exactly
  use gfb_bearing_system, only: bearing_system_type
  use gfb_foil_surface, only: nodal_values_type, named_surface
  use gfb_meshed_foil, only: split_motion
  use gfb_newton, only: newton_type
  use gfb_corrected_solve, only: solve_corrected
  use gfb_key_effect, only: moves_point, acts_on_film
  use gfb_key_differences, only: difference_type, difference_of, present_value, step_of, changed_point, keeps_meshes, changes_foils
  use gfb_answer_numbers, only: extreme_nodes_type, known_answer_type, find_extremes, measure, measure_gradient, numbers, &
                                numbers_of, place_e, place_force, place_torque, place_speed, place_extremes
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: any_rank, sum_over_ranks, share_failure
  use gfb_scene_reading, only: scene_with_key
  use gfb_foil_builder, only: keep_elements
  use gfb_changed_foil, only: elastic_work
  use gfb_bearing_builder, only: take_numbers, build_changed
  implicit none (type)
  private
  public :: keep_tangent, find_sensitivities, evaluate_changed

  !> What is found of an answer.
  type, public :: sensitivity_type
    real(wp), allocatable :: value(:)         !! of each of `quantity_words` [its unit]
    real(wp), allocatable :: derivative(:, :) !! (quantities, parameters) not a number where there is none
    character(len=:), allocatable :: problem  !! why there are none by some parameter
  end type sensitivity_type

contains

  !> The matrix of the bearing's equations at its answer, without artificial stiffness of open contacts.
  subroutine keep_tangent(bearing, tangent)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer
    Mat, intent(out) :: tangent !! its copy
    PetscErrorCode :: ierr
    logical :: moved

    call bearing%settle(bearing%state, moved)
    call linearise_exactly(bearing, bearing%shaft_fixed)
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, tangent, ierr))
  end subroutine keep_tangent

  !> Derivatives of all quantities that the scene asks for by all its parameters, but for those of whirl.
  subroutine find_sensitivities(scene, bearing, newton, tangent, found, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    Mat, intent(in) :: tangent !! of `keep_tangent`
    type(sensitivity_type), intent(out) :: found !! values and derivatives
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]

    Vec :: adjoint(size(quantity_words))
    type(known_answer_type) :: answer
    real(wp) :: number(numbers), combined(size(quantity_words), numbers)
    character(len=:), allocatable :: problem
    logical :: asked(size(quantity_words)), solved(size(quantity_words))
    PetscErrorCode :: ierr
    integer :: i, k

    allocate (answer%unknown(bearing%local_size()), answer%motion(0, 0))
    call bearing%get_unknowns(answer%unknown)
    call find_extremes(bearing, derives_stress(scene%sensitivity), answer%nodes)
    number = measure(bearing, answer%unknown, bearing%point, answer%nodes)
    call combine(number, found%value, combined)
    ! What vibrations tell is no number of the answer.
    asked = scene%sensitivity%quantity .and. .not. (quantities_of(of_whirl) .or. quantities_of(of_coefficients))
    call find_adjoints(asked, bearing, newton, tangent, answer%nodes, combined, adjoint, solved)
    if (scene%model%foil%has_bumps) call find_motions(bearing, adjoint, solved, answer)
    associate (parameter => scene%sensitivity%parameter)
      allocate (found%derivative(size(quantity_words), size(parameter)), source=ieee_value(1.0_wp, ieee_quiet_nan))
      found%problem = ''
      do i = 1, merge(size(parameter), 0, any(asked))
        call newton%log%is_at('derivative by '//parameter(i)%key%label()//', '//text(i)//' of '//text(size(parameter)), &
                              real(i - 1, wp)/size(parameter))
        call newton%log%waiting('')
        call find_derivatives(scene, parameter(i), bearing, answer, combined, adjoint, solved, found%derivative(:, i), &
                              problem, at)
        if (problem /= '') found%problem = parameter(i)%key%label()//': '//problem
      end do
      call newton%log%is_at('')
    end associate
    if (any(asked .and. .not. solved)) found%problem = 'the transposed equations were not solved'
    do k = 1, size(quantity_words)
      if (asked(k)) then
        PetscCallA(VecDestroy(adjoint(k), ierr))
      end if
    end do
  end subroutine find_sensitivities

  !> The quantities in the order of `quantity_words` from the numbers that are measured, and their derivatives.
  pure subroutine combine(number, value, rate)
    real(wp), intent(in) :: number(:)              !! measured
    real(wp), allocatable, intent(out) :: value(:) !! of the quantities
    real(wp), intent(out) :: rate(:, :)            !! (quantities, numbers)
    real(wp) :: square
    integer :: attitude, power, extremes, axial, k

    allocate (value(size(rate, 1)), source=0.0_wp) ! those of whirl are not measured
    attitude = findloc(quantity_words, 'attitude_angle', 1)
    power = findloc(quantity_words, 'power_loss', 1)
    extremes = findloc(quantity_words, 'minimum_gap', 1)
    axial = findloc(quantities_of(of_runner), .true., 1)
    rate = 0.0_wp
    value(:2) = number(place_e:place_e + 1)
    value(attitude + 1:power - 1) = number(place_force:place_torque)
    value(extremes:axial - 1) = number(place_extremes:)
    value(axial:axial + 1) = [-number(place_e), number(place_force)] ! of a ring
    rate(axial, place_e) = -1.0_wp
    rate(axial + 1, place_force) = 1.0_wp
    do k = 1, 2
      rate(k, place_e + k - 1) = 1.0_wp
    end do
    do k = place_force, place_torque
      rate(attitude + 1 + k - place_force, k) = 1.0_wp
    end do
    do k = place_extremes, size(number)
      rate(extremes + k - place_extremes, k) = 1.0_wp
    end do
    value(power) = number(place_torque)*number(place_speed)
    rate(power, place_torque) = number(place_speed)
    rate(power, place_speed) = number(place_torque)
    ! from the load's direction to that of the shaft's centre, -e
    associate (e => number(place_e:place_e + 1), f => number(place_force:place_force + 1))
      value(attitude) = degrees*atan2(f(2)*e(1) - f(1)*e(2), -f(1)*e(1) - f(2)*e(2))
      square = dot_product(e, e)
      if (square > 0.0_wp) rate(attitude, place_e:place_e + 1) = degrees*[-e(2), e(1)]/square
      square = dot_product(f, f)
      if (square > 0.0_wp) rate(attitude, place_force:place_force + 1) = -degrees*[-f(2), f(1)]/square
    end associate
  end subroutine combine

  !> An adjoint for every quantity that is asked for; vectors of the others are not created.
  subroutine find_adjoints(asked, bearing, newton, tangent, nodes, combined, adjoint, solved)
    logical, intent(in) :: asked(:) !! for each quantity
    type(bearing_system_type), intent(in) :: bearing
    type(newton_type), intent(in) :: newton
    Mat, intent(in) :: tangent
    type(extreme_nodes_type), intent(in) :: nodes
    real(wp), intent(in) :: combined(:, :) !! (quantities, numbers)
    Vec, intent(inout) :: adjoint(:)
    logical, intent(out) :: solved(:)
    real(wp) :: gradient(bearing%local_size(), numbers_of(bearing))
    Vec :: right
    PetscErrorCode :: ierr
    integer :: k

    solved = .false.
    call measure_gradient(bearing, nodes, gradient)
    PetscCallA(VecDuplicate(bearing%state, right, ierr))
    do k = 1, size(adjoint)
      if (.not. asked(k)) cycle
      PetscCallA(VecDuplicate(bearing%state, adjoint(k), ierr))
      PetscCallA(VecSet(right, 0.0_wp, ierr))
      call bearing%exchange%add(matmul(gradient, combined(k, :size(gradient, 2)))*bearing%unknown_scale, right)
      call solve_corrected(newton, bearing, tangent, right, adjoint(k), .true., solved(k))
    end do
    PetscCallA(VecDestroy(right, ierr))
  end subroutine find_adjoints

  !> How the foils move at the answer, and in the adjoints of all quantities.
  subroutine find_motions(bearing, adjoint, solved, answer)
    type(bearing_system_type), intent(in) :: bearing !! with meshed foils
    Vec, intent(in) :: adjoint(:) !! one a quantity
    logical, intent(in) :: solved(:) !! else there is none
    type(known_answer_type), intent(inout) :: answer !! with its unknowns; gets the motions
    real(wp) :: value(bearing%local_size())
    integer :: k

    deallocate (answer%motion)
    allocate (answer%motion(size(bearing%foil_surfaces()), size(bearing%pad)))
    call add_motion(0, answer%unknown)
    do k = 1, size(adjoint)
      if (.not. solved(k)) cycle
      call bearing%exchange%get(adjoint(k), value)
      call add_motion(k, value/bearing%equation_scale(bearing%point))
    end do

  contains

    !> Displacements of a state, or of an adjoint.
    subroutine add_motion(number, value)
      integer, intent(in) :: number !! 0: the state
      real(wp), intent(in) :: value(:) !! local unknowns
      type(nodal_values_type), allocatable :: moved(:)
      integer :: i, surface

      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i))
          call split_motion(pad%foil, value(pad%first + 1:pad%last), moved)
        end associate
        do surface = 1, size(moved)
          associate (motion => answer%motion(surface, i), now => moved(surface)%value)
            if (number == 0) allocate (motion%moved(size(now, 1), size(now, 2), 0:size(adjoint)), source=0.0_wp)
            motion%moved(:, :, number) = now
          end associate
        end do
      end do
    end subroutine add_motion
  end subroutine find_motions

  !> Derivatives of all quantities by a key: by differences of residual and numbers at the state of the answer.
  subroutine find_derivatives(scene, parameter, bearing, answer, combined, adjoint, solved, derivative, problem, at)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    real(wp), intent(in) :: combined(:, :) !! (quantities, numbers)
    Vec, intent(in) :: adjoint(:)     !! one a quantity
    logical, intent(in) :: solved(:)  !! else there is none
    real(wp), intent(inout) :: derivative(:) !! stays where there is none
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    Vec :: change, residual
    real(wp) :: number(numbers), slope(numbers), work(size(adjoint)), elastic(size(adjoint)), value, step, along
    PetscErrorCode :: ierr
    type(difference_type) :: difference
    integer :: steps, k

    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, residual, ierr))
    PetscCallA(VecSet(change, 0.0_wp, ierr))
    slope = 0.0_wp
    elastic = 0.0_wp
    value = present_value(scene, parameter, bearing%point, at)
    difference = difference_of(parameter%key)
    step = step_of(scene, parameter%key, difference, value)
    problem = ''
    if (.not. step > 0.0_wp) problem = 'it is 0 here'
    do steps = -2, 2
      if (problem /= '') exit
      if (.not. abs(difference%weight(steps)) > 0.0_wp) cycle
      call evaluate_changed(scene, parameter, value + steps*step, bearing, answer, residual, number, work, problem, at)
      PetscCallA(VecAXPY(change, difference%weight(steps)/step, residual, ierr))
      slope = slope + difference%weight(steps)/step*number
      elastic = elastic + difference%weight(steps)/step*work
    end do
    do k = 1, merge(size(adjoint), 0, problem == '')
      if (.not. solved(k)) cycle
      PetscCallA(VecDot(adjoint(k), change, along, ierr))
      derivative(k) = dot_product(combined(k, :), slope) - along - elastic(k)
    end do
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine find_derivatives

  !> Residual and numbers at an answer's state with another value of a key; the bearing is as before on return.
  subroutine evaluate_changed(scene, parameter, value, bearing, answer, residual, number, work, problem, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(parameter_type), intent(in) :: parameter !! the key
    real(wp), intent(in) :: value !! of it [its unit]
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(known_answer_type), intent(in) :: answer !! what is known of it
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:) !! as `measure` has them [SI]
    real(wp), intent(out) :: work(:) !! of elastic forces that are not in the residual, on each adjoint
    character(len=:), allocatable, intent(out) :: problem !! why there are none; empty where there is none
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(scene_type) :: there
    type(error_type), allocatable :: error
    logical :: valid

    number = 0.0_wp
    work = 0.0_wp
    problem = ''
    valid = .true.
    if (moves_point(parameter%key%acts_on)) then
      call evaluate_operation(parameter, value, bearing, answer, residual, number, valid)
    else
      call scene_with_key(scene, parameter%key, value, there, error, at)
      if (allocated(error)) then
        problem = error%message
        return
      end if
      call keep_elements(scene, there)
      ! Stresses of changed foils, condensed parts with them, are those of foils built anew.
      if (scene%model%foil%has_bumps .and. keeps_meshes(parameter%key) .and. &
          .not. (derives_stress(scene%sensitivity) .and. changes_foils(parameter%key))) then
        call evaluate_in_place(scene, there, parameter%key, bearing, answer, residual, number, work, valid, error)
      else
        call evaluate_rebuilt(there, bearing, answer, residual, number, valid, problem, error)
      end if
      if (allocated(error)) problem = error%message
    end if
    if (any_rank(.not. valid)) problem = 'the film is closed at a value close by'
  end subroutine evaluate_changed

  !> The same bearing at another load, the direction kept, at another gap that is held, or at another speed.
  subroutine evaluate_operation(parameter, value, bearing, answer, residual, number, valid)
    type(parameter_type), intent(in) :: parameter
    real(wp), intent(in) :: value !! [its unit]
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    logical, intent(out) :: valid !! gap and pressure are positive
    type(operating_point_type) :: point

    point = changed_point(parameter, value, bearing%point)
    call bearing%evaluate_at(point, bearing%state, residual, valid)
    number = measure(bearing, answer%unknown, point, answer%nodes)
  end subroutine evaluate_operation

  !> The same bearing with other numbers. Its matrix of the foils stays; what changes in it is in the work.
  subroutine evaluate_in_place(scene, there, key, bearing, answer, residual, number, work, valid, error)
    type(scene_type), intent(in) :: scene, there !! as it is; with the key changed
    type(swept_key_type), intent(in) :: key !! that is changed
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    real(wp), intent(inout) :: work(:) !! 0 where no foil is another
    logical, intent(out) :: valid !! gap and pressure are positive
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: of_pad(size(work))
    integer :: i, surface

    call take_numbers(there, bearing)
    call bearing%evaluate_at(bearing%point, bearing%state, residual, valid)
    number = 0.0_wp ! they stay where the foils alone are others
    if (key%acts_on == acts_on_film .or. any(bearing%block%numbers > 0)) number = measure(bearing, answer%unknown, bearing%point, answer%nodes)
    call take_numbers(scene, bearing)
    if (.not. changes_foils(key)) return
    surface = named_surface(bearing%foil_surfaces(), key%group)
    do i = 1, size(answer%motion, 2)
      associate (pad => bearing%pad(i))
        call elastic_work(pad%foil, there, pad%whole, surface, answer%motion(surface, i)%moved, of_pad, error)
        if (allocated(error)) exit
        work = work + pad%foil%modulus(surface)*of_pad
      end associate
    end do
    call share_failure(error)
    work = sum_over_ranks(work)
  end subroutine evaluate_in_place

  !> Another bearing on a mesh like this one's.
  subroutine evaluate_rebuilt(there, bearing, answer, residual, number, valid, problem, error)
    type(scene_type), intent(in) :: there
    type(bearing_system_type), intent(in) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    logical, intent(out) :: valid !! gap and pressure are positive
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(error_type), allocatable, intent(out) :: error
    type(bearing_system_type) :: other

    number = 0.0_wp
    valid = .true.
    call build_changed(there, bearing, answer%unknown, other, problem, error)
    if (allocated(error) .or. problem /= '') return
    call other%evaluate(other%state, residual, valid)
    number = measure(other, answer%unknown, other%point, answer%nodes)
    call other%destroy()
  end subroutine evaluate_rebuilt
end module gfb_sensitivity
