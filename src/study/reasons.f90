!> Why a study has no answer, as a value that can be handed on: to who asked for the study, and
!> from one group of ranks to another.
module gfb_reasons
  use gfb_text, only: text
  use gfb_signals, only: stop_words, out_of_time
  implicit none (type, external)
  private

  integer, parameter, public :: reason_none = 0           !! there is an answer
  integer, parameter, public :: reason_no_equilibrium = 1 !! of a bearing under a load
  integer, parameter, public :: reason_no_answer = 2      !! of a bearing at a given position
  integer, parameter, public :: reason_fixed_shaft = 3    !! of one whose shaft had been fixed
  integer, parameter, public :: reason_load_step = 4      !! of a strip: step `at` of `of`
  integer, parameter, public :: reason_few_modes = 5      !! `at` of them were found
  integer, parameter, public :: reason_inaccurate = 6     !! the number's error is too large
  integer, parameter, public :: reason_failed = 7         !! an error, which `detail` describes
  integer, parameter, public :: reason_stopped = 8        !! by a signal, which `detail` names
  integer, parameter, public :: reason_out_of_time = 11   !! the time limit stopped it
  integer, parameter, public :: reason_members = 12       !! of a sample without an answer
  integer, parameter, public :: reason_no_limit = 9       !! of load, speed or tilt
  integer, parameter, public :: reason_not_reached = 10   !! by a motion; `detail` says what

  integer, parameter, public :: status_unconverged = 2 !! of the program where there is no answer

  !> Why there is no answer.
  type, public :: reason_type
    integer :: code = reason_none
    integer :: at = 0, of = 0               !! what is counted, where the code says so
    logical :: shown = .false.              !! that there is none
    logical :: gave_up = .false.            !! all work that is allowed was done
    character(len=:), allocatable :: detail !! what the solver adds
  contains
    procedure :: is_given, is_stop, stopped, words, outcome
  end type reason_type

contains

  !> Whether there is a reason, and so no answer.
  pure function is_given(self)
    class(reason_type), intent(in) :: self !! the reason
    logical :: is_given
    is_given = self%code /= reason_none
  end function is_given

  !> Whether the run was stopped before it could know: another one may find an answer.
  elemental logical function is_stop(self)
    class(reason_type), intent(in) :: self !! the reason
    is_stop = any(self%code == [reason_stopped, reason_out_of_time])
  end function is_stop

  !> The reason of a run that is stopped by what all ranks have agreed on.
  subroutine stopped(self, place)
    class(reason_type), intent(inout) :: self !! becomes it
    character(len=*), intent(in), optional :: place !! behind the words: where the run is
    self%code = merge(reason_out_of_time, reason_stopped, out_of_time())
    self%detail = stop_words()
    if (present(place)) self%detail = self%detail//place
  end subroutine stopped

  !> How a run without an answer ended, as the one word that its summary has.
  pure function outcome(self) result(word)
    class(reason_type), intent(in) :: self !! the reason
    character(len=:), allocatable :: word

    select case (self%code)
    case (reason_stopped)
      word = 'stopped'
    case (reason_out_of_time)
      word = 'out_of_time'
    case (reason_few_modes, reason_inaccurate, reason_not_reached, reason_members)
      word = 'not_reached'
    case (reason_failed)
      word = 'failed'
    case default
      word = 'lost'
      if (self%gave_up) word = 'gave_up'
      if (self%shown) word = 'refused'
    end select
  end function outcome

  !> The reason as a line for the user; empty where there is none.
  pure function words(self)
    class(reason_type), intent(in) :: self !! the reason
    character(len=:), allocatable :: words

    select case (self%code)
    case (reason_none)
      words = ''
    case (reason_no_equilibrium)
      words = 'no equilibrium found'
    case (reason_no_answer)
      words = 'no answer found'
    case (reason_no_limit)
      words = 'no limit found'
    case (reason_fixed_shaft)
      words = 'no answer found with the shaft fixed'
    case (reason_load_step)
      words = 'no equilibrium found in step '//text(self%at)//' of '//text(self%of)
    case (reason_few_modes)
      words = 'only '//text(self%at)//' modes found'
    case default
      words = ''
    end select
    if (.not. allocated(self%detail)) return
    if (words /= '') words = words//': '
    words = words//self%detail
  end function words
end module gfb_reasons
