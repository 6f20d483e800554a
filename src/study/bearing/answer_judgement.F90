#include "gfb_petsc.h"
!> What is judged of an answer, and derived of it, with the factors of its equations: stability, and derivatives of its numbers by
!> keys.
module gfb_answer_judgement
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
  use petscmat
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, add_quantity, number_quantity, number_in
  use gfb_result_names, only: add_result, result_unit, result_meaning, quotient_unit
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_study_cases, only: quantity_words, parameter_type, quantities_of, of_whirl, of_coefficients
  use gfb_sweep_case, only: swept_key_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_heat_switch, only: held_bearing_type, hold_heat
  use gfb_newton, only: newton_type, find_determinant_sign, tell_determinant_sign
  use gfb_static_stiffness, only: find_edge_stiffness
  use gfb_whirl, only: whirl_type
  use gfb_stability, only: stability_type, find_stability
  use gfb_sensitivity, only: sensitivity_type, find_sensitivities, keep_tangent
  use gfb_whirl_sensitivity, only: derive_whirl, derive_coefficients
  implicit none (type)
  private
  public :: judge_and_derive, judge_answer

  integer, parameter :: digits = 5     !! of a derivative in the log
  integer, parameter :: few_digits = 3 !! of a part
  real(wp), parameter :: percent = 100.0_wp

contains

  !> Judges an answer and, where that is asked for, derives its numbers by keys, with the factors of the judgement.
  subroutine judge_and_derive(scene, log, bearing, newton, judged, whirl, value)
    type(scene_type), intent(in) :: scene !! what is asked for, with the sweep's value in its keys
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at the answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: judged(:) !! what is known of the answer
    type(whirl_type), intent(in) :: whirl !! of it, where its derivatives are asked for
    real(wp), intent(in), optional :: value !! of the sweep, in its unit
    type(sensitivity_type) :: found
    real(wp), allocatable :: rates(:, :) !! of what vibrations tell, by each parameter
    real(wp), allocatable :: coefficient(:)
    character(len=:), allocatable :: problem
    integer :: sign_of_determinant, i
    Mat :: tangent
    PetscErrorCode :: ierr

    if (scene%sensitivity%present) call keep_tangent(bearing, tangent)
    call judge_answer(scene, log, bearing, newton, judged)
    if (.not. scene%sensitivity%present) return
    sign_of_determinant = nint(number_in(judged, 'determinant_sign'))
    if (sign_of_determinant == 0) call find_determinant_sign(newton, sign_of_determinant) ! makes the factors
    call find_sensitivities(scene, bearing, newton, tangent, found, value)
    if (found%problem /= '') call log%warning('no derivative by '//found%problem)
    if (scene%sensitivity%asks(of_whirl)) then
      call begin(of_whirl)
      found%value = unpack([whirl%critical_mass, whirl%ratio], quantities_of(of_whirl), found%value)
      call derive_whirl(scene, bearing, newton, tangent, whirl, rates, problem, value)
      call take(of_whirl)
    end if
    if (scene%sensitivity%asks(of_coefficients)) then
      call begin(of_coefficients)
      call derive_coefficients(scene, bearing, newton, tangent, whirl%weighs, coefficient, rates, problem, value)
      found%value = unpack(coefficient, quantities_of(of_coefficients), found%value)
      call take(of_coefficients)
    end if
    PetscCallA(MatDestroy(tangent, ierr))
    do i = 1, size(quantity_words)
      if (scene%sensitivity%quantity(i)) call add_results(scene, trim(quantity_words(i)), found%derivative(i, :), judged)
    end do
    if (.not. scene%sweep%present) call show(scene, found, log)

  contains

    !> No derivatives yet of results of something.
    subroutine begin(what)
      integer, intent(in) :: what

      allocate (coefficient(count(quantities_of(what))))
      allocate (rates(size(coefficient), size(found%derivative, 2)), source=ieee_value(1.0_wp, ieee_quiet_nan))
    end subroutine begin

    !> Takes them among all, and says where there are none.
    subroutine take(what)
      integer, intent(in) :: what
      integer :: k

      do k = 1, size(rates, 2)
        found%derivative(:, k) = unpack(rates(:, k), quantities_of(what), found%derivative(:, k))
      end do
      if (problem /= '') call log%warning('no derivative of '//trim(merge('whirl       ', 'coefficients', what == of_whirl))//' by '//problem)
      deallocate (rates, coefficient)
    end subroutine take
  end subroutine judge_and_derive

  !> Judges the bearing's present state, which must be an answer; state and point stay as they are.
  subroutine judge_answer(scene, log, bearing, newton, list)
    type(scene_type), intent(in) :: scene !! whether stability is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), target, intent(inout) :: bearing !! at an answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: list(:) !! what is known of it
    type(stability_type) :: stability
    type(held_bearing_type) :: held
    integer :: sign_of_determinant, i
    real(wp), allocatable :: stiffness(:)
    logical, allocatable :: known(:)

    allocate (list(0))
    if (scene%solver%stability) then
      call hold_heat(bearing, held)
      call find_stability(held%bearing, stability)
      newton%factorizations = newton%factorizations + stability%factorizations
      newton%enlargements = newton%enlargements + stability%enlargements
      call log%judged('stability: '//stability_words(stability, &
                      bearing%has_mirror_motions()), &
                      stability%found .and. stability%negative + stability%growing == 0)
      if (stability%counted) call add_result(list, 'stability', stability%negative)
      if (stability%found) then
        call add_result(list, 'growing_modes', stability%growing)
        call add_result(list, 'stability_margin', real(stability%nearest, wp))
      end if
    end if
    if (.not. bearing%floats .or. bearing%shaft_fixed) return
    ! The last of the factors, so that the next solve can begin with them.
    if (bearing%has_contacts() .or. scene%sensitivity%present) then
      call find_determinant_sign(newton, sign_of_determinant) ! its factors are needed
    else
      call tell_determinant_sign(newton, sign_of_determinant)
    end if
    if (sign_of_determinant == 0) return
    ! A runner's gap and tilts are one or three unknowns, whose stiffness enters with the opposite sign.
    if (modulo(size(bearing%coordinate), 2) == 1) sign_of_determinant = -sign_of_determinant
    call add_result(list, 'determinant_sign', sign_of_determinant)
    if (.not. bearing%has_contacts()) return
    call find_edge_stiffness(bearing, newton, known, stiffness)
    if (any(known)) call add_result(list, 'edge_stiffness', minval(stiffness, known))
    do i = 1, merge(size(known), 0, size(known) > 1)
      if (known(i)) call add_result(list, 'edge_stiffness_'//text(i), stiffness(i))
    end do
  end subroutine judge_answer

  !> The stability as a sentence.
  function stability_words(stability, symmetric) result(words)
    type(stability_type), intent(in) :: stability
    logical, intent(in) :: symmetric !! no others were looked for
    character(len=:), allocatable :: words

    if (.not. stability%found) then
      words = 'the eigenvalues of the foils were not found'
      return
    end if
    words = 'an unknown number of'
    if (stability%counted) words = text(stability%negative)
    words = words//' negative eigenvalue(s) of the foils'' stiffness, '// &
      text(stability%growing)//' growing mode(s) ('// &
      trim(merge('stable  ', 'unstable', stability%negative + stability%growing == 0))
    if (stability%nearly_neutral) words = words//', one nearly neutral'
    words = words//') while the shaft is fixed; nearest to a change: ('// &
            text(real(stability%nearest, wp), 3)
    if (aimag(stability%nearest) > 0.0_wp) then
      words = words//' +- '//text(aimag(stability%nearest), 3)//' i'
    end if
    words = words//') p_a/C'
    if (symmetric) words = words//'; of modes symmetric about z = 0'
  end function stability_words

  !> Adds a quantity's derivatives, and what the tolerances make of them.
  subroutine add_results(scene, name, derivative, list)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: derivative(:) !! one a parameter
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=:), allocatable :: full
    integer :: i

    associate (asked => scene%sensitivity)
      do i = 1, size(derivative)
        if (ieee_is_nan(derivative(i))) cycle ! there is none, which was reported
        associate (key => asked%parameter(i))
          full = 'd_'//name//'_d_'//result_part(key%key)
          call add_quantity(list, number_quantity(full, derivative(i), quotient_unit(result_unit(name), key%unit), &
                                                  result_meaning(full, name//' by '//key%key%label())))
        end associate
      end do
      if (size(asked%tolerances) == 0 .or. any(ieee_is_nan(derivative))) return
      associate (variance => variance_of(scene, derivative))
        call add_result(list, 'standard_deviation_'//name, sqrt(variance))
        call add_result(list, 'variance_'//name, variance)
      end associate
    end associate
  end subroutine add_results

  !> A key as part of a result's name.
  pure function result_part(key) result(words)
    type(swept_key_type), intent(in) :: key
    character(len=:), allocatable :: words

    words = key%group//'_'//key%name
    if (key%element > 0) words = words//'_'//text(key%element)
  end function result_part

  !> Variance that independent deviations of the parameters cause, to first order.
  pure real(wp) function variance_of(scene, derivative) result(variance)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: derivative(:) !! of a quantity, one a parameter
    variance = sum((derivative*scene%sensitivity%parameter%tolerance)**2)
  end function variance_of

  !> A table: a line a quantity and a parameter.
  subroutine show(scene, found, log)
    type(scene_type), intent(in) :: scene
    type(sensitivity_type), intent(in) :: found
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: unit
    integer :: i, k

    call log%heading('sensitivities')
    associate (asked => scene%sensitivity)
      do i = 1, size(quantity_words)
        if (.not. asked%quantity(i)) cycle
        unit = result_unit(trim(quantity_words(i)))
        call log%line(trim(quantity_words(i))//' = '//text(found%value(i), digits)//' '//unit)
        do k = 1, size(asked%parameter)
          call log%line('  '//parameter_line(asked%parameter(k), found%value(i), found%derivative(i, k), unit, &
                                             size(asked%tolerances) > 0))
        end do
        if (size(asked%tolerances) == 0 .or. any(ieee_is_nan(found%derivative(i, :)))) cycle
        associate (deviation => sqrt(variance_of(scene, found%derivative(i, :))))
          call log%line('  standard deviation by all tolerances: '//text(deviation, digits)//' '//unit)
        end associate
      end do
    end associate
  end subroutine show

  !> A derivative in words.
  function parameter_line(key, value, derivative, unit, tolerated) result(words)
    type(parameter_type), intent(in) :: key
    real(wp), intent(in) :: value      !! of the quantity
    real(wp), intent(in) :: derivative !! of it by the key
    character(len=*), intent(in) :: unit !! of the quantity
    logical, intent(in) :: tolerated !! tolerances are given
    character(len=:), allocatable :: words

    words = 'by '//key%key%label()
    words = words//repeat(' ', max(0, 32 - len(words)))
    if (ieee_is_nan(derivative)) then
      words = words//'none'
      return
    end if
    words = words//text(derivative, digits)//' '//quotient_unit(unit, key%unit)
    if (abs(value) > 0.0_wp .and. abs(key%value) > 0.0_wp) then
      words = words//'; by 1 % of it: '//text(percent*derivative*(key%value/percent)/value, few_digits)//' %'
    end if
    if (tolerated) words = words//'; by its tolerance: '//text(abs(derivative)*key%tolerance, few_digits)//' '//unit
  end function parameter_line
end module gfb_answer_judgement
