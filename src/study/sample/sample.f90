!> A scene with many draws of its random heights: the members one after another, and their
!> statistics.
!>
!> Every member begins cold, as the scene alone with its seed does: so its answer is that one's to
!> the last digit, whichever members went before and whichever group of ranks computes it. A start
!> from the answer without deviations would be another path of loads, and with friction another
!> answer.
module gfb_sample
  use gfb_errors, only: error_type
  use gfb_bearing_summary, only: cost_type
  use gfb_c_library, only: peak_memory
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: rank_count, stop_is_asked, sum_over_ranks, wall_time
  use gfb_quantity, only: quantity_type, quantity_word, add_quantity
  use gfb_reasons, only: reason_failed, reason_stopped
  use gfb_results, only: add_result
  use gfb_run_context, only: run_context_type
  use gfb_run_log, only: run_log_type
  use gfb_study_rules, only: sample_member
  use gfb_sample_writing, only: write_sample
  use gfb_scene, only: scene_type
  use gfb_signals, only: stop_words
  use gfb_study, only: study_type
  use gfb_table_file, only: table_member_type
  use gfb_text, only: text
  implicit none (type, external)
  private

  integer, parameter :: status_unconverged = 2

  !> The members and what they found.
  type, extends(study_type), public :: sample_type
    class(study_type), allocatable :: pattern !! like the studies of the members, without an answer
    class(study_type), allocatable, private :: plan !! of the scene's own draw
    type(table_member_type), allocatable :: member(:)
  contains
    procedure :: prepare => prepare_sample
    procedure :: solve => solve_all
    procedure :: solve_member
    procedure :: judge
    procedure :: write => write_study
    procedure :: left_out => left_out_of_members
    procedure :: discard => discard_sample
  end type sample_type

contains

  !> Says what the scene needs; all members need the same.
  subroutine prepare_sample(self, scene, log)
    class(sample_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    self%heading = 'members'
    allocate (self%plan, mold=self%pattern)
    call self%plan%prepare(scene, log)
    self%memory = self%plan%memory
    associate (first => scene%bump_foil%random%seed)
      call log%line('sample: '//text(scene%sample%count)//' members, seeds '//text(first)// &
                    ' to '//text(first + scene%sample%count - 1)//', each from a cold start')
    end associate
    allocate (self%member(scene%sample%count))
  end subroutine prepare_sample

  !> Finds the answers of all members.
  subroutine solve_all(self, scene, context, error)
    class(sample_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! none: what fails is a member
    integer :: number

    do number = 1, size(self%member)
      call context%log%is_within('member '//text(number)//' of '//text(size(self%member)), &
                                 real(number - 1, wp)/real(size(self%member), wp))
      call self%solve_member(scene, context, number)
    end do
    call context%log%is_within('')
    call self%judge()
  end subroutine solve_all

  !> Finds the answer of one member, and tells the log.
  subroutine solve_member(self, scene, context, number)
    class(sample_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    integer, intent(in) :: number !! of the member, from 1
    class(study_type), allocatable, target :: study
    type(scene_type) :: there
    type(run_context_type) :: quiet
    type(error_type), allocatable :: error

    there = sample_member(scene, number)
    quiet = context
    quiet%log%silent = .true.
    nullify (quiet%listener)
    associate (member => self%member(number))
      member%name = 'seed '//text(there%bump_foil%random%seed)
      member%reason = ''
      if (stop_is_asked()) then
        member%status = status_unconverged
        member%reason = 'not computed, '//stop_words()
      else
        allocate (study, mold=self%pattern)
        call study%prepare(there, quiet%log)
        call study%check(there, error)
        if (.not. allocated(error)) call study%solve(there, quiet, error)
        if (allocated(error)) then
          member%status = error%status
          member%reason = error%message
        else if (.not. study%converged) then
          member%status = status_unconverged
          member%reason = study%reason%words()
        end if
        self%unknowns = max(self%unknowns, study%unknowns)
        self%iterations = self%iterations + study%iterations
        self%factorizations = self%factorizations + study%factorizations
        self%factorizations_finest = self%factorizations_finest + study%factorizations_finest
      end if
      call add_result(member%row%quantity, 'seed', there%bump_foil%random%seed)
      call add_result(member%row%quantity, 'exit_status', member%status)
      if (member%status == 0) call add_numbers(study%found, member%row%quantity)
      call show_member(context, member, number, size(self%member))
    end associate
    if (allocated(study)) call study%discard()
  end subroutine solve_member

  !> Adds what is a number.
  subroutine add_numbers(found, list)
    type(quantity_type), intent(in) :: found(:)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i

    do i = 1, size(found)
      if (found(i)%kind == quantity_word .or. found(i)%name == 'converged') cycle
      call add_quantity(list, found(i))
    end do
  end subroutine add_numbers

  !> A line for a member.
  subroutine show_member(context, member, number, members)
    type(run_context_type), intent(in) :: context
    type(table_member_type), intent(in) :: member
    integer, intent(in) :: number, members !! of the member; in all
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    if (member%status /= 0) words = ': no answer: '//member%reason
    associate (found => member%row%quantity)
      do i = 1, size(found)
        if (all(found(i)%name /= [character(len=17) :: 'minimum_gap', 'loading_stiffness'])) cycle
        words = ': '//found(i)%name//' '//text(found(i)%number, 5)//' '//found(i)%unit
      end do
    end associate
    words = member%name//', member '//text(number)//' of '//text(members)//words
    call context%log%line(words)
    call context%point_done(words)
  end subroutine show_member

  !> Whether all members have an answer, and why not.
  subroutine judge(self)
    class(sample_type), intent(inout) :: self !! the study, with all members

    self%converged = all(self%member%status == 0)
    if (self%converged) return
    self%reason%code = reason_failed
    self%reason%detail = text(count(self%member%status /= 0))//' of '//text(size(self%member))// &
                         ' members have no answer'
    if (.not. stop_is_asked()) return
    self%reason%code = reason_stopped
    self%reason%detail = stop_words()
  end subroutine judge

  !> Writes the members and their statistics.
  !>
  !> Fails when a file cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(sample_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    call write_sample(scene, context, self%member, context%origin(), rank_count(), &
                      cost_type(self%unknowns, self%iterations, self%factorizations, &
                                self%factorizations_finest, wall_time() - context%start_time, &
                                memory(1)), summary, error)
  end subroutine write_study

  !> What the model leaves out, and why.
  function left_out_of_members(self, scene) result(words)
    class(sample_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    words = self%plan%left_out(scene)
  end function left_out_of_members

  !> Every member was discarded when it had its answer.
  subroutine discard_sample(self)
    class(sample_type), intent(inout) :: self !! the study

    if (allocated(self%plan)) deallocate (self%plan)
  end subroutine discard_sample
end module gfb_sample
