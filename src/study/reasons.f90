!> Why a study has no answer, as a value that can be handed on: to who asked for the study, and
!> from one group of ranks to another.
module gfb_reasons
  use gfb_text, only: text
  implicit none (type, external)
  private

  integer, parameter, public :: reason_none = 0           !! there is an answer
  integer, parameter, public :: reason_no_equilibrium = 1 !! of a bearing under a load
  integer, parameter, public :: reason_no_answer = 2      !! of a bearing at a given position
  integer, parameter, public :: reason_fixed_shaft = 3    !! of one whose shaft had been fixed
  integer, parameter, public :: reason_load_step = 4      !! of a strip: step `at` of `of`
  integer, parameter, public :: reason_few_modes = 5      !! `at` of them were found
  integer, parameter, public :: reason_inaccurate = 6     !! the number's error is too large
  integer, parameter, public :: reason_failed = 7         !! an error, which `detail` tells
  integer, parameter, public :: reason_stopped = 8        !! by a signal, which `detail` tells
  integer, parameter, public :: reason_no_limit = 9       !! of load, speed or tilt
  integer, parameter, public :: reason_not_reached = 10   !! by a motion; `detail` says what

  integer, parameter, public :: status_unconverged = 2 !! of the program where there is no answer

  !> Why there is no answer.
  type, public :: reason_type
    integer :: code = reason_none
    integer :: at = 0, of = 0               !! what is counted, where the code says so
    character(len=:), allocatable :: detail !! what the solver adds
  contains
    procedure :: is_given, words
  end type reason_type

contains

  !> Whether there is a reason, and so no answer.
  pure function is_given(self)
    class(reason_type), intent(in) :: self !! the reason
    logical :: is_given
    is_given = self%code /= reason_none
  end function is_given

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
