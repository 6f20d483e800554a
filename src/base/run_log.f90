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

  !> What all copies of a run's log know together.
  type :: log_memory_type
    character(len=:), allocatable :: warnings !! told so far, each with its end
    character(len=:), allocatable :: place    !! where a long computation is, for its waiting line
    logical :: waits = .false.                !! a waiting line stands on the terminal
    integer(long) :: told = 0                 !! count of the clock when the last line was told
  end type log_memory_type

  !> Where the lines of a run go; silent on all ranks but one.
  type :: run_log_type
    logical :: active = .true.   !! this rank prints
    logical :: verbose = .false. !! iterations too, not only events
    logical :: quiet = .false.   !! stages alone, with the time so far
    integer :: unit = output_unit !! where to; what is no terminal takes the complaints too
    logical :: colours = .false. !! the lines go to a terminal that shows them
    logical :: terminal = .false. !! the lines go to one, where a waiting line stays where it is
    integer(long) :: begun = 0   !! count of the clock when the run began
    real(wp) :: patience = 10.0_wp !! time without a line, before one that waits [s]
    type(log_memory_type), pointer :: memory => null() !! null: nothing is collected
  contains
    procedure :: begin => run_log_begin
    procedure :: remember => run_log_remember
    procedure :: line => run_log_line
    procedure :: tell => run_log_tell
    procedure :: stage => run_log_stage
    procedure :: progress => run_log_progress
    procedure :: is_at => run_log_is_at
    procedure :: waiting => run_log_waiting
    procedure :: detail => run_log_detail
    procedure :: heading => run_log_heading
    procedure :: warning => run_log_warning
    procedure :: warned => run_log_warned
    procedure :: repeat_warnings => run_log_repeat_warnings
    procedure :: complaint => run_log_complaint
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

  !> A memory of its own for a log: warnings, and since when nothing has been told.
  subroutine run_log_remember(self)
    class(run_log_type), intent(inout) :: self !! the log

    allocate (self%memory)
    self%memory%warnings = ''
    self%memory%place = ''
    call system_clock(self%memory%told)
  end subroutine run_log_remember

  !> One event.
  subroutine run_log_line(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (.not. self%quiet) call self%tell(words)
  end subroutine run_log_line

  !> What is told however quiet the log is.
  subroutine run_log_tell(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (.not. self%active) return
    call clear_waiting(self)
    call put(self%unit, words)
    if (associated(self%memory)) call system_clock(self%memory%told)
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

  !> Where a long computation is, for the waiting lines to come; the next stage forgets it.
  subroutine run_log_is_at(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the place, such as how much of the way is behind

    if (associated(self%memory)) self%memory%place = words
  end subroutine run_log_is_at

  !> The last step of a long computation: told where nothing else was for a while, with the time.
  !>
  !> On a terminal it is one line that stays where it is, renewed every second; elsewhere lines.
  !> A verbose log tells every iteration, a quiet one its stages alone.
  subroutine run_log_waiting(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the step that is done
    real(wp), parameter :: renewed = 1.0_wp !! [s]
    character(len=16) :: time
    character(len=:), allocatable :: line
    integer(long) :: now, rate
    real(wp) :: silence

    if (self%quiet .or. self%verbose .or. .not. (self%active .and. associated(self%memory))) return
    call system_clock(now, rate)
    rate = max(1_long, rate)
    associate (memory => self%memory)
      silence = real(now - memory%told, wp)/real(rate, wp)
      if (silence < merge(renewed, self%patience, memory%waits)) return
      write (time, '(i0)') (now - self%begun)/rate
      line = '... '//trim(time)//' s: '
      if (len(memory%place) > 0) line = line//memory%place//', '
      line = line//words
      if (self%terminal) then
        call put(self%unit, clear_line//line, stays=.true.)
        memory%waits = .true.
        memory%told = now
      else
        call self%tell(line)
      end if
    end associate
  end subroutine run_log_waiting

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

  !> Tells warnings, and keeps those that are new for the end.
  subroutine run_log_warned(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! lines that say that they are warnings
    character(len=1), parameter :: next = new_line('a')

    call self%tell(coloured(self%colours, yellow, words))
    if (.not. (self%active .and. associated(self%memory))) return
    if (index(self%memory%warnings, words//next) > 0) return
    self%memory%warnings = self%memory%warnings//words//next
  end subroutine run_log_warned

  !> Tells all warnings again, where the answer stands, and forgets them.
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

    if (.not. self%active) return
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
