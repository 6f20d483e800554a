!> How much a search for an answer may cost.
!>
!> It is bounded by work that no machine's speed changes: unknowns that are factored, which the time
!> of a search follows, where one factorization costs from 1 ms to 1 s by its mesh; and by a plain
!> count, which the user may set.
module gfb_work_bound
  use gfb_kinds, only: wp
  use gfb_signals, only: stop_agreed
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: count_factorization, is_spent, gives_up, share_words

  character(len=*), parameter, public :: gave_up_words = 'the search gave up' !! as a reason

  !> Factorizations that all solvers of a search share, one mesh after the other.
  type, public :: work_bound_type
    private
    integer :: most = huge(1)            !! that the search may take
    integer :: spent = 0                 !! so far
    real(wp) :: most_work = huge(1.0_wp) !! unknowns that it may factor, each time counted
    real(wp) :: work = 0.0_wp            !! so far
  contains
    procedure, non_overridable :: begin, lift, is_reached, share, words
  end type work_bound_type

contains

  !> Begins to count, as a search begins.
  pure subroutine begin(self, most, most_work)
    class(work_bound_type), intent(inout) :: self !! of the search
    integer, intent(in) :: most !! factorizations it may take
    !> unknowns that it may factor, each time counted; absent: any number
    real(wp), intent(in), optional :: most_work

    self%most = most
    self%most_work = huge(1.0_wp)
    if (present(most_work)) self%most_work = most_work
    self%spent = 0
    self%work = 0.0_wp
  end subroutine begin

  !> Bounds nothing more, as a search has ended.
  pure subroutine lift(self)
    class(work_bound_type), intent(inout) :: self !! of the search
    self%most = huge(1)
    self%most_work = huge(1.0_wp)
  end subroutine lift

  !> Whether all factorizations, or all work, are spent.
  pure logical function is_reached(self) result(reached)
    class(work_bound_type), intent(in) :: self !! of the search
    reached = self%spent >= self%most .or. self%work >= self%most_work
  end function is_reached

  !> How much of what it may cost is spent, 0 where it is not bounded [1].
  pure real(wp) function share(self)
    class(work_bound_type), intent(in) :: self !! of the search
    share = max(real(self%spent, wp)/self%most, self%work/self%most_work)
  end function share

  !> What a search that gave up says.
  function words(self)
    class(work_bound_type), intent(in) :: self !! of the search
    character(len=:), allocatable :: words
    words = 'after '//text(self%spent)//' factorizations (maximum_factorizations in &solver)'
  end function words

  !> Counts a factorization.
  subroutine count_factorization(bound, unknowns)
    type(work_bound_type), pointer, intent(in) :: bound !! of the search; null: there is none
    real(wp), intent(in) :: unknowns !! of the system, on all ranks

    if (.not. associated(bound)) return
    bound%spent = bound%spent + 1
    bound%work = bound%work + unknowns
  end subroutine count_factorization

  !> How much of what it may cost a search has spent, for lines of progress; empty below 1 %.
  function share_words(bound) result(words)
    type(work_bound_type), pointer, intent(in) :: bound !! of the search; null: there is none
    character(len=:), allocatable :: words

    words = ''
    if (.not. associated(bound)) return
    if (bound%share() < 0.01_wp) return
    words = text(floor(100.0_wp*bound%share()))//' % of the work allowed, '
  end function share_words

  !> Whether a search has spent what it may.
  pure logical function is_spent(bound) result(spent)
    type(work_bound_type), pointer, intent(in) :: bound !! of the search; null: there is none

    spent = .false.
    if (associated(bound)) spent = bound%is_reached()
  end function is_spent

  !> Whether a search has to end: a signal asks for it, or it has spent what it may.
  !>
  !> No solve converges then, and one that does not says nothing of the bearing.
  logical function gives_up(bound) result(ends)
    type(work_bound_type), pointer, intent(in) :: bound !! of the search; null: there is none
    ends = stop_agreed() .or. is_spent(bound)
  end function gives_up
end module gfb_work_bound
