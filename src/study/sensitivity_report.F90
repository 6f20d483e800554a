#include "gfb_petsc.h"
!> The derivatives of an answer as results and as a table of the log.
module gfb_sensitivity_report
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use petscmat
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, add_quantity, number_quantity
  use gfb_result_names, only: result_unit, result_meaning, quotient_unit
  use gfb_results, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_sensitivity_case, only: quantity_words, parameter_type
  use gfb_sweep_case, only: swept_key_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, find_determinant_sign
  use gfb_sensitivity, only: sensitivity_type, find_sensitivities, changed_evaluation
  implicit none (type)
  private
  public :: add_sensitivities

  integer, parameter :: digits = 5     !! of a derivative in the log
  integer, parameter :: few_digits = 3 !! of a part
  real(wp), parameter :: percent = 100.0_wp

contains

  !> Finds the derivatives that a scene asks for, and adds them to what is known of the answer.
  subroutine add_sensitivities(scene, log, bearing, newton, tangent, evaluate, list, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(tMat), intent(inout) :: tangent !! of `keep_tangent`; is destroyed
    procedure(changed_evaluation) :: evaluate !! of the equations with other values of the keys
    type(quantity_type), allocatable, intent(inout) :: list(:) !! has `determinant_sign` where the factors are there
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(sensitivity_type) :: found
    PetscErrorCode :: ierr
    integer :: sign_of_determinant, i

    sign_of_determinant = 0
    do i = 1, size(list)
      if (list(i)%name == 'determinant_sign') sign_of_determinant = nint(list(i)%number)
    end do
    if (sign_of_determinant == 0) call find_determinant_sign(newton, sign_of_determinant)
    call find_sensitivities(scene, bearing, newton, tangent, evaluate, found, at)
    PetscCallA(MatDestroy(tangent, ierr))
    if (found%problem /= '') call log%warning('no derivative by '//found%problem)
    do i = 1, size(quantity_words)
      if (scene%sensitivity%quantity(i)) call add_results(scene, trim(quantity_words(i)), found%derivative(i, :), list)
    end do
    if (.not. scene%sweep%present) call show(scene, found, log)
  end subroutine add_sensitivities

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
        if (ieee_is_nan(derivative(i))) cycle ! there is none, which was told
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
  pure function variance_of(scene, derivative) result(variance)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: derivative(:) !! of a quantity, one a parameter
    real(wp) :: variance

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
end module gfb_sensitivity_report
