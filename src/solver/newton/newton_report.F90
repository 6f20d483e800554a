#include "gfb_petsc.h"
!> How Newton's method ended, in numbers and in words, and its lines of the log.
module gfb_newton_report
  use petscsnes
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  implicit none (type)
  private
  public :: reason_in_words, show_iteration, show_enlargements

  !> How a solve ended.
  type, public :: newton_report_type
    logical :: converged = .false.
    character(len=:), allocatable :: reason !! in words
    integer :: iterations = 0
    real(wp) :: residual = 0.0_wp !! root mean square of the scaled residual [1]
    logical :: at_round_off = .false. !! the residual is above its tolerance, but all of it is rounding
    real(wp) :: round_off = 0.0_wp !! then: the last relative step [1]
  end type newton_report_type

contains

  !> SNES' reason as a sentence; empty where the linear solver knows more.
  function reason_in_words(reason, impossible, maximum_iterations) result(words)
    integer, intent(in) :: reason             !! SNES' number
    logical, intent(in) :: impossible         !! no trial along the last step could be evaluated
    integer, intent(in) :: maximum_iterations !! that were allowed
    character(len=:), allocatable :: words

    if (reason > 0) then
      words = 'converged'
    else if (impossible) then
      words = 'every trial along the step closed the gap or emptied the film'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_FUNCTION_DOMAIN))) then
      words = 'the gap or the pressure was not positive at the start'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_LINEAR_SOLVE))) then
      words = ''
    else if (reason == int(GFB_REASON(SNES_DIVERGED_MAX_IT))) then
      words = 'no convergence in '//text(maximum_iterations)//' iterations'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_LINE_SEARCH)) .or. &
             reason == int(GFB_REASON(SNES_DIVERGED_LOCAL_MIN))) then
      words = 'no step made the residual smaller'
    else
      words = 'SNES stopped with reason '//text(reason)
    end if
  end function reason_in_words

  !> A line of the table of iterations.
  subroutine show_iteration(log, iteration, residual, step, length, new_factors)
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    integer, intent(in) :: iteration  !! 0: the start, whose line has no step
    real(wp), intent(in) :: residual  !! root mean square of the scaled residual [1]
    real(wp), intent(in) :: step      !! largest change of an unknown by the full step, relative [1]
    real(wp), intent(in) :: length    !! share of the step that was taken [1]
    logical, intent(in) :: new_factors !! the step's factors belong to its own matrix
    character(len=80) :: line

    if (iteration == 0) then
      call log%detail('iteration    residual        step      length  factors')
      write (line, '(i9, es12.3)') iteration, residual
    else
      write (line, '(i9, 2es12.3, f12.6, a9)') iteration, residual, step, length, &
        merge('new   ', 'lagged', new_factors)
    end if
    call log%detail(trim(line))
    call log%waiting('Newton iteration '//text(iteration)//', residual '//text(residual, 2))
  end subroutine show_iteration

  !> Says that MUMPS found its workspace too small, and how often so far.
  subroutine show_enlargements(log, enlargements)
    type(run_log_type), intent(in) :: log   !! gets the line
    integer, intent(in) :: enlargements !! of the workspace, since the solver's creation

    call log%line('the factors'' workspace was too small (MUMPS'' INFOG(1) = -9): enlarged, '//text(enlargements)// &
                  ' time(s) so far')
  end subroutine show_enlargements
end module gfb_newton_report
