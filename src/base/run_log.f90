!> The log of a run: the only place that prints.
module gfb_run_log
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  use gfb_c_library, only: is_terminal
  use gfb_kinds, only: wp, long
  implicit none (type, external)
  private
  public :: run_log_type, warnings_type

  character(len=*), parameter :: escape = achar(27)//'['
  character(len=*), parameter :: bold = '1', yellow = '33', red = '31'

  !> The warnings of a run, to be told again at its end.
  type :: warnings_type
    character(len=:), allocatable :: lines !! each with its end
  end type warnings_type

  !> Where the lines of a run go; silent on all ranks but one.
  type :: run_log_type
    logical :: active = .true.   !! this rank prints
    logical :: verbose = .false. !! iterations too, not only events
    logical :: quiet = .false.   !! stages alone, with the time so far
    integer :: unit = output_unit !! where to; what is no terminal takes the complaints too
    logical :: colours = .false. !! the lines go to a terminal that shows them
    integer(long) :: begun = 0   !! count of the clock when the run began
    type(warnings_type), pointer :: warnings => null() !! told so far; null: they are not collected
  contains
    procedure :: begin => run_log_begin
    procedure :: line => run_log_line
    procedure :: tell => run_log_tell
    procedure :: stage => run_log_stage
    procedure :: progress => run_log_progress
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
    allocate (self%warnings)
    self%warnings%lines = ''
    call get_environment_variable('NO_COLOR', word, length, status)
    self%colours = is_terminal(1)
    if (self%unit /= output_unit .or. length > 0) self%colours = .false.
  end subroutine run_log_begin

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

    if (self%active) call put(self%unit, words)
  end subroutine run_log_tell

  !> Writes a line; a log that cannot be written does not end the run.
  subroutine put(unit, words)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: words
    integer :: status

    write (unit, '(a)', iostat=status) words
    if (status == 0) flush (unit, iostat=status)
    if (status /= 0) return
  end subroutine put

  !> A stage of the run begins; quiet: with the time so far.
  subroutine run_log_stage(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

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
    if (.not. (self%active .and. associated(self%warnings))) return
    if (index(self%warnings%lines, words//next) > 0) return
    self%warnings%lines = self%warnings%lines//words//next
  end subroutine run_log_warned

  !> Tells all warnings again, where the answer stands, and forgets them.
  subroutine run_log_repeat_warnings(self)
    class(run_log_type), intent(in) :: self !! the log

    if (.not. associated(self%warnings)) return
    associate (lines => self%warnings%lines)
      if (len(lines) > 0) call self%tell(coloured(self%colours, yellow, lines(:len(lines) - 1)))
      self%warnings%lines = ''
    end associate
  end subroutine run_log_repeat_warnings

  !> What ends the run, on the error stream.
  subroutine run_log_complaint(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (.not. self%active) return
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
