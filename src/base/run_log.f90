!> The log of a run: the only place that prints.
module gfb_run_log
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  use gfb_c_library, only: is_terminal
  use gfb_kinds, only: wp, long
  implicit none (type, external)
  private
  public :: run_log_type, log_memory_type

  character(len=*), parameter :: escape = achar(27)//'['
  character(len=*), parameter :: clear_line = achar(13)//escape//'K'
  character(len=*), parameter :: bold = '1', yellow = '33', red = '31'

  integer, parameter :: widest_waiting = 79       !! a longer line breaks, and could not be renewed
  real(wp), parameter :: least_share = 0.02_wp    !! of a way that shows how long the rest takes [1]

  !> How much of something long is behind.
  type :: way_type
    character(len=:), allocatable :: words  !! where on the way; empty: there is none
    real(wp) :: share = 0.0_wp              !! that is behind [1]
    real(wp) :: share_before = 0.0_wp       !! the last smaller one [1]
    integer(long) :: begun = 0, reached = 0 !! counts of the clock, at its begin and at this share
    integer(long) :: reached_before = 0     !! the same at the one before
  end type way_type

  !> What all copies of a run's log know together.
  type :: log_memory_type
    character(len=:), allocatable :: warnings !! said so far, each with its end
    type(way_type) :: task !! of many points, members or times, for waiting lines
    type(way_type) :: step !! the way from one of them to the next
    character(len=:), allocatable :: mesh !! of several, on which it lies; empty: there is one
    logical :: waits = .false.                !! a waiting line stands on the terminal
    integer(long) :: last_line = 0            !! count of the clock when the last one was written
  end type log_memory_type

  !> Where the lines of a run go; silent on all ranks but one.
  type :: run_log_type
    logical :: active = .true.   !! this rank prints
    logical :: silent = .false.  !! says what waits alone, such as a sample's member
    logical :: verbose = .false. !! iterations too, not only events
    logical :: quiet = .false.   !! stages alone, with the time so far
    integer :: unit = output_unit !! where to; what is no terminal takes the complaints too
    logical :: colours = .false. !! the lines go to a terminal that shows them
    logical :: terminal = .false. !! the lines go to one, where a waiting line stays where it is
    integer(long) :: begun = 0   !! count of the clock when the run began
    real(wp) :: patience = 10.0_wp !! time without a line, before one that waits [s]
    type(log_memory_type), pointer :: memory => null() !! null: nothing is collected
  contains
    procedure, non_overridable :: begin => run_log_begin
    procedure, non_overridable :: remember => run_log_remember, line => run_log_line
    procedure, non_overridable :: tell => run_log_tell, stage => run_log_stage
    procedure, non_overridable :: progress => run_log_progress
    procedure, non_overridable :: is_at => run_log_is_at, is_within => run_log_is_within
    procedure, non_overridable :: is_on => run_log_is_on, waiting => run_log_waiting
    procedure, non_overridable :: detail => run_log_detail, heading => run_log_heading
    procedure, non_overridable :: warning => run_log_warning
    procedure, non_overridable :: warned => run_log_warned
    procedure, non_overridable :: repeat_warnings => run_log_repeat_warnings
    procedure, non_overridable :: complaint => run_log_complaint, judged => run_log_judged
  end type run_log_type

contains

  !> Begins the log of a run: its clock, its warnings, and colours where the user has them.
  subroutine run_log_begin(self)
    class(run_log_type), intent(inout) :: self !! the log
    character(len=1) :: word
    integer :: length, status

    call system_clock(self%begun)
    call self%remember()
    call get_environment_variable('NO_COLOR', word, length, status)
    self%terminal = is_terminal(1)
    if (self%unit /= output_unit) self%terminal = .false.
    self%colours = self%terminal .and. length == 0
  end subroutine run_log_begin

  !> A memory of its own for a log: warnings, and since when nothing has been said.
  subroutine run_log_remember(self)
    class(run_log_type), intent(inout) :: self !! the log

    allocate (self%memory)
    self%memory%warnings = ''
    self%memory%task%words = ''
    self%memory%step%words = ''
    self%memory%mesh = ''
    call system_clock(self%memory%last_line)
  end subroutine run_log_remember

  !> One event.
  subroutine run_log_line(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line
    if (.not. self%quiet) call self%tell(words)
  end subroutine run_log_line

  !> What is found of a state: a quiet log says it where the state does not stay.
  subroutine run_log_judged(self, words, stays)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line
    logical, intent(in) :: stays !! the state is stable

    if (stays) call self%line(words)
    if (.not. stays) call self%tell(words)
  end subroutine run_log_judged

  !> What is said however quiet the log is.
  subroutine run_log_tell(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (self%silent .or. .not. self%active) return
    call clear_waiting(self)
    call put(self%unit, words)
    if (associated(self%memory)) call system_clock(self%memory%last_line)
  end subroutine run_log_tell

  !> Takes a waiting line off the terminal.
  subroutine clear_waiting(self)
    class(run_log_type), intent(in) :: self

    if (.not. associated(self%memory)) return
    if (self%memory%waits) call put(self%unit, clear_line, stays=.true.)
    self%memory%waits = .false.
  end subroutine clear_waiting

  !> Writes a line, or what stays on the line; a log that cannot be written ends no run.
  subroutine put(unit, words, stays)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: words
    logical, intent(in), optional :: stays
    character(len=3) :: advance
    integer :: status

    advance = 'yes'
    if (present(stays)) advance = merge('no ', 'yes', stays)
    write (unit, '(a)', advance=trim(advance), iostat=status) words
    if (status == 0) flush (unit, iostat=status)
    if (status /= 0) return
  end subroutine put

  !> A stage of the run begins; quiet: with the time so far.
  subroutine run_log_stage(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    call self%is_at('')
    call self%line(words)
    call self%progress(words)
  end subroutine run_log_stage

  !> What a quiet log says of a stage, for which others have lines of their own.
  subroutine run_log_progress(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line
    character(len=16) :: time
    integer(long) :: now, rate

    if (.not. self%quiet) return
    call system_clock(now, rate)
    write (time, '(f10.1, a)') real(now - self%begun, wp)/real(max(1_long, rate), wp), ' s  '
    call self%tell(time(:14)//words)
  end subroutine run_log_progress

  !> Where the way from one answer to the next is, for the waiting lines to come.
  !>
  !> The next stage forgets it.
  subroutine run_log_is_at(self, words, share)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the place; empty: there is none
    real(wp), intent(in), optional :: share !! behind, 0 at the begin [1]; none: not known
    if (associated(self%memory)) call advance(self%memory%step, words, share)
  end subroutine run_log_is_at

  !> Which of many answers is looked for, for the waiting lines to come.
  subroutine run_log_is_within(self, words, share)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! which one; empty: there are none any more
    real(wp), intent(in), optional :: share !! behind, 0 at the first [1]; none: not known
    if (associated(self%memory)) call advance(self%memory%task, words, share)
  end subroutine run_log_is_within

  !> On which of several meshes the search is, for the waiting lines to come.
  subroutine run_log_is_on(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! which one, of how many; empty: there is one
    if (associated(self%memory)) self%memory%mesh = words
  end subroutine run_log_is_on

  !> A way at its begin, or further on.
  subroutine advance(way, words, share)
    type(way_type), intent(inout) :: way
    character(len=*), intent(in) :: words
    real(wp), intent(in), optional :: share
    real(wp) :: now
    logical :: same

    same = words == way%words
    way%words = words
    now = 0.0_wp
    if (present(share)) now = share
    ! Tried once more from there.
    if ((now > 0.0_wp .or. same) .and. abs(now - way%share) <= 0.0_wp) return
    way%share_before = merge(way%share, 0.0_wp, now > way%share)
    way%reached_before = way%reached
    way%share = now
    call system_clock(way%reached)
    if (.not. way%share > 0.0_wp) then
      way%begun = way%reached
      way%reached_before = way%reached
    else if (.not. way%share_before > 0.0_wp) then
      way%reached_before = way%begun
    end if
  end subroutine advance

  !> The last step of a long computation: said where nothing else was for a while, with the time.
  !>
  !> On a terminal it is one line that stays where it is, renewed every second; elsewhere lines.
  !> A verbose log shows every iteration, a quiet one its stages alone.
  subroutine run_log_waiting(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the step that is done; empty: where it is says all
    real(wp), parameter :: renewed = 1.0_wp !! [s]
    character(len=16) :: time
    character(len=:), allocatable :: line
    integer(long) :: now, rate
    real(wp) :: silence

    if (self%quiet .or. self%verbose .or. .not. (self%active .and. associated(self%memory))) return
    call system_clock(now, rate)
    rate = max(1_long, rate)
    associate (memory => self%memory)
      silence = real(now - memory%last_line, wp)/real(rate, wp)
      if (silence < merge(renewed, self%patience, memory%waits)) return
      write (time, '(i0)') (now - self%begun)/rate
      line = ''
      call add_part(line, place_on(memory%task, now, rate, ' s left'))
      call add_part(line, memory%mesh)
      call add_part(line, place_on(memory%step, now, rate, ' s to its end'))
      call add_part(line, words)
      line = '... '//trim(time)//' s: '//line
      if (self%terminal) then
        call put(self%unit, clear_line//line(:min(len(line), widest_waiting)), stays=.true.)
        memory%waits = .true.
      else
        call put(self%unit, line)
      end if
      memory%last_line = now
    end associate
  end subroutine run_log_waiting

  !> Adds to a line what is not empty, after a comma.
  pure subroutine add_part(line, part)
    character(len=:), allocatable, intent(inout) :: line
    character(len=*), intent(in) :: part

    if (len(line) > 0 .and. len(part) > 0) line = line//', '
    line = line//part
  end subroutine add_part

  !> Where on a way, and about how long the rest takes if it goes on as slowly as on the whole, or
  !> on its last piece where that was slower: steps that are cut count. Where it has not come on for
  !> longer than that, or no step shows yet how long the rest takes, how long it has been there.
  function place_on(way, now, rate, ending) result(words)
    type(way_type), intent(in) :: way
    integer(long), intent(in) :: now, rate !! count of the clock, and counts a second
    character(len=*), intent(in) :: ending !! of the time that is left
    character(len=:), allocatable :: words
    character(len=24) :: seconds
    real(wp) :: left, there

    words = way%words
    if (words == '') return
    left = 0.0_wp
    if (.not. way%share < least_share) then
      associate (piece => max(way%share - way%share_before, tiny(1.0_wp)))
        left = max(real(way%reached - way%begun, wp)/way%share, &
                   real(way%reached - way%reached_before, wp)/piece)
      end associate
      left = left*(1.0_wp - way%share)/real(rate, wp)
    end if
    there = real(now - way%reached, wp)/real(rate, wp)
    if (left - there >= 1.0_wp) then
      write (seconds, '(i0)') nint(left - there, long)
      words = words//', about '//trim(seconds)//ending
    else if (there >= 1.0_wp .and. way%share < 1.0_wp) then
      write (seconds, '(i0)') nint(there, long)
      words = words//' for '//trim(seconds)//' s'
    end if
  end function place_on

  !> One line of a table of iterations.
  subroutine run_log_detail(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line
    if (self%verbose) call self%line('    '//words)
  end subroutine run_log_detail

  !> Begins a part of the log, which is a stage.
  subroutine run_log_heading(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    call self%line('')
    call self%line(coloured(self%colours, bold, words))
    call self%line(repeat('-', len(words)))
    call self%progress(words)
  end subroutine run_log_heading

  !> What the user should know although the run goes on.
  subroutine run_log_warning(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line
    call self%warned('warning: '//words)
  end subroutine run_log_warning

  !> Says warnings that are new, such as one that every point of a sweep has, and keeps them for
  !> the end.
  subroutine run_log_warned(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! lines that say that they are warnings
    character(len=1), parameter :: next = new_line('a')

    if (self%active .and. associated(self%memory) .and. .not. self%silent) then
      if (index(self%memory%warnings, words//next) > 0) return
      self%memory%warnings = self%memory%warnings//words//next
    end if
    call self%tell(coloured(self%colours, yellow, words))
  end subroutine run_log_warned

  !> Says all warnings again, where the answer stands, and forgets them.
  subroutine run_log_repeat_warnings(self)
    class(run_log_type), intent(in) :: self !! the log

    if (.not. associated(self%memory)) return
    associate (lines => self%memory%warnings)
      if (len(lines) > 0) call self%tell(coloured(self%colours, yellow, lines(:len(lines) - 1)))
      lines = ''
    end associate
  end subroutine run_log_repeat_warnings

  !> What ends the run, on the error stream.
  subroutine run_log_complaint(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (self%silent .or. .not. self%active) return
    call clear_waiting(self)
    if (self%unit /= output_unit) then
      call self%tell(words)
    else if (self%colours) then
      call put(error_unit, coloured(is_terminal(2), red, words))
    else
      call put(error_unit, words)
    end if
  end subroutine run_log_complaint

  !> A text in a colour of the terminal.
  pure function coloured(wanted, colour, words) result(shown)
    logical, intent(in) :: wanted !! the terminal shows colours
    character(len=*), intent(in) :: colour, words
    character(len=:), allocatable :: shown

    shown = words
    if (wanted) shown = escape//colour//'m'//words//escape//'0m'
  end function coloured
end module gfb_run_log
