!> What the user typed after the program's name.
module gfb_command_line
  use, intrinsic :: iso_c_binding, only: c_null_char
  use gfb_errors, only: error_type, fail
  use gfb_run_log, only: run_log_type
  use gfb_text, only: nearest_word, did_you_mean
  use gfb_petsc_session, only: given_petsc_options, wall_time
  use gfb_run_context, only: run_context_type
  implicit none (type, external)
  private
  public :: read_command_line, help_text

  !> A file's name.
  type, public :: file_name_type
    character(len=:), allocatable :: path
  end type file_name_type

  !> The command line.
  type, public :: command_line_type
    character(len=:), allocatable :: case_file !! the first one
    type(file_name_type), allocatable :: case_files(:) !! all of them
    integer :: groups = 0 !! of ranks; 0: not asked for
    character(len=:), allocatable :: table !! name of the result file of several cases
    character(len=:), allocatable :: folder !! where results go
    logical :: check = .false.   !! read, validate, print what the scene needs, stop
    logical :: strict = .false.  !! warnings about a case file are mistakes
    logical :: branches = .false. !! look for all equilibria
    !> ranks whose shares to show instead of solving; 0: those of the job
    integer :: shares = -1
    logical :: restart = .false. !! resume from the restart file
    integer :: time_limit = 0    !! after which the run stops [s]; 0: none
    logical :: help = .false.
    logical :: version = .false.
    logical :: keys = .false.    !! print the table of all keys
    logical :: results = .false. !! print the table of all names of results
    character(len=:), allocatable :: template !! analysis whose template to print; empty: none
    logical :: short = .false.   !! of a template only what the case needs
    character(len=:), allocatable :: explain  !! key, result, ... to explain; empty: none
    logical :: csv = .false.     !! history, motion or orbits as comma-separated values, too
    logical :: decimal_comma = .false. !! in these tables, between semicolons
    logical :: quiet = .false.   !! a line a stage and no more
    logical :: verbose = .false. !! a line per iteration
    character(len=:), allocatable :: words !! the whole line
    !> the program's name and what is for PETSc, a zero character behind each
    character(len=:), allocatable :: petsc
  contains
    procedure :: context => run_context, informs
  end type command_line_type

  character(len=20), parameter :: options(22) = [character(len=20) :: &
    '--branches', '--check', '--output', '--restart', '--help', '--partition', '--version', &
    '--keys', '--quiet', '--petsc', '--petsc-options-file', '--groups', '--name', '--results', &
    '--strict', '--time-limit', '--template', '--explain', '--csv', '--verbose', '--short', &
    '--decimal-comma']

contains

  !> Reads the command line.
  !>
  !> Fails on an unknown option, a missing or a second case file.
  subroutine read_command_line(line, error)
    type(command_line_type), intent(out) :: line !! what was typed
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: word
    integer :: i
    logical :: known

    line%folder = '.'
    line%table = ''
    line%template = ''
    line%explain = ''
    allocate (line%case_files(0))
    line%words = argument(0)
    line%petsc = line%words//c_null_char
    do i = 1, command_argument_count()
      line%words = line%words//' '//argument(i)
    end do
    i = 0
    do while (i < command_argument_count() .and. .not. allocated(error))
      i = i + 1
      word = argument(i)
      call take_switch(word, line, known)
      if (known) cycle
      select case (word)
      case ('help') ! help, or help WORD
        line%explain = argument(i + 1)
        line%help = line%explain == ''
        i = i + 1
      case ('-')
        call take_file(word, line, error)
      case ('--template')
        i = i + 1
        line%template = argument(i)
        if (line%template == '') call fail(error, 'gfb: --template needs an analysis, '// &
                                           'such as equilibrium')
      case ('--explain')
        i = i + 1
        line%explain = argument(i)
        if (line%explain == '') call fail(error, 'gfb: --explain needs a key, or the name of '// &
                                          'a result')
      case ('--petsc') ! the rest is for PETSc
        do i = i + 1, command_argument_count()
          line%petsc = line%petsc//argument(i)//c_null_char
        end do
      case ('--') ! the rest are case files
        do i = i + 1, command_argument_count()
          call take_file(argument(i), line, error)
        end do
      case ('--output')
        i = i + 1
        line%folder = argument(i)
        if (line%folder == '') call fail(error, 'gfb: --output needs a folder')
      case ('--groups', '--time-limit', '--petsc-options-file')
        i = i + 1
        call take_other(word//'='//argument(i), line, error)
      case ('--name')
        i = i + 1
        line%table = argument(i)
        if (line%table == '') call fail(error, 'gfb: --name needs a name')
      case default
        call take_other(word, line, error)
      end select
    end do
    if (line%quiet .and. line%verbose) then
      call fail(error, 'gfb: --quiet or --verbose, not both')
    end if
    if (line%short .and. line%template == '') then
      call fail(error, 'gfb: --short is of --template')
    end if
    if (allocated(error) .or. line%informs()) return
    if (.not. allocated(line%case_file)) then
      call fail(error, 'gfb: no case file given; gfb --help shows how')
    else if (line%restart .and. line%branches) then
      call fail(error, 'gfb: --restart resumes a sweep or a strip''s load steps, '// &
                'not a search with --branches')
    else
      call check_groups(line, error)
    end if
  end subroutine read_command_line

  !> A word that is an option without a value; nothing is known of others.
  subroutine take_switch(word, line, known)
    character(len=*), intent(in) :: word
    type(command_line_type), intent(inout) :: line
    logical, intent(out) :: known

    known = .true.
    select case (word)
    case ('--check')
      line%check = .true.
    case ('--strict')
      line%strict = .true.
    case ('--branches')
      line%branches = .true.
    case ('--partition')
      line%shares = 0
    case ('--restart')
      line%restart = .true.
    case ('--help', '-h')
      line%help = .true.
    case ('--version')
      line%version = .true.
    case ('--keys')
      line%keys = .true.
    case ('--results')
      line%results = .true.
    case ('--csv')
      line%csv = .true.
    case ('--short')
      line%short = .true.
    case ('--decimal-comma')
      line%decimal_comma = .true.
    case ('--quiet')
      line%quiet = .true.
    case ('--verbose')
      line%verbose = .true.
    case default
      known = .false.
    end select
  end subroutine take_switch

  !> Whether the line asks about the program and for no computation.
  pure function informs(self)
    class(command_line_type), intent(in) :: self !! the command line
    logical :: informs

    informs = self%help .or. self%version .or. self%keys .or. self%results .or. &
              self%template /= '' .or. self%explain /= ''
  end function informs

  !> Several case files need groups, and groups are not for everything.
  subroutine check_groups(line, error)
    type(command_line_type), intent(inout) :: line
    type(error_type), allocatable, intent(out) :: error

    if (line%groups > 0 .and. any_is_input(line%case_files)) then
      call fail(error, 'gfb: --groups reads case files, not the standard input')
    else if (line%groups == 0 .and. size(line%case_files) > 1) then
      call fail(error, 'gfb: one case file at a time, not '//line%case_file//' and '// &
                line%case_files(2)%path//'; --groups N computes several in N groups of ranks')
    else if (line%table /= '' .and. size(line%case_files) < 2) then
      call fail(error, 'gfb: --name is that of the table of several case files')
    else if (index(line%table, '/') > 0) then
      call fail(error, 'gfb: --name is a name without a folder; --output DIR says where it goes')
    else if (line%groups > 0 .and. line%branches) then
      call fail(error, 'gfb: --branches looks at one case on all ranks; it has no use for --groups')
    end if
    if (line%table == '') line%table = 'ensemble'
  end subroutine check_groups

  !> Whether the standard input is among the case files.
  pure logical function any_is_input(files) result(is)
    type(file_name_type), intent(in) :: files(:)
    integer :: i

    is = .false.
    do i = 1, size(files)
      is = is .or. files(i)%path == '-'
    end do
  end function any_is_input

  !> Reads how many groups are wanted.
  subroutine take_groups(word, line, error)
    character(len=*), intent(in) :: word
    type(command_line_type), intent(inout) :: line
    type(error_type), allocatable, intent(out) :: error
    integer :: status

    status = 1
    if (word /= '' .and. len(word) < 8 .and. verify(word, '0123456789') == 0) then
      read (word, *, iostat=status) line%groups
    end if
    if (status /= 0 .or. line%groups < 1) then
      line%groups = 0
      call fail(error, 'gfb: --groups needs the number of groups, a whole number from 1')
    end if
  end subroutine take_groups

  !> Reads a time limit: seconds, minutes:seconds or hours:minutes:seconds.
  subroutine take_time_limit(word, line, error)
    character(len=*), intent(in) :: word
    type(command_line_type), intent(inout) :: line
    type(error_type), allocatable, intent(out) :: error
    character(len=:), allocatable :: left
    integer :: colon, number, status, total

    left = word
    total = 0
    do
      colon = index(left//':', ':')
      status = 1
      if (colon > 1 .and. colon < 8 .and. verify(left(:colon - 1), '0123456789') == 0) then
        read (left(:colon - 1), *, iostat=status) number
      end if
      if (status /= 0 .or. total > 100000) exit
      total = 60*total + number
      if (colon > len(left)) exit
      left = left(colon + 1:)
    end do
    line%time_limit = total
    if (status /= 0 .or. total < 1) then
      call fail(error, 'gfb: --time-limit '//word//': needs seconds, or minutes:seconds, or '// &
                'hours:minutes:seconds')
    end if
  end subroutine take_time_limit

  !> A file of options for PETSc: it reads those that were named, and that of the home.
  subroutine take_options_file(word, line, error)
    character(len=*), intent(in) :: word
    type(command_line_type), intent(inout) :: line
    type(error_type), allocatable, intent(out) :: error

    if (word == '') then
      call fail(error, 'gfb: --petsc-options-file needs a file')
    else
      line%petsc = line%petsc//'-options_file'//c_null_char//word//c_null_char
    end if
  end subroutine take_options_file

  !> A word that is no known option: the case file, or a mistake.
  subroutine take_other(word, line, error)
    character(len=*), intent(in) :: word
    type(command_line_type), intent(inout) :: line
    type(error_type), allocatable, intent(out) :: error
    integer :: status

    if (index(word, '--output=') == 1 .and. len(word) > 9) then
      line%folder = word(10:)
    else if (index(word, '--partition=') == 1) then
      read (word(13:), *, iostat=status) line%shares
      if (status /= 0 .or. verify(word(13:), '0123456789') /= 0 .or. line%shares < 1) then
        call fail(error, 'gfb: '//word//': the number of ranks is a whole number above zero')
      end if
    else if (index(word, '--groups=') == 1) then
      call take_groups(word(10:), line, error)
    else if (index(word, '--time-limit=') == 1) then
      call take_time_limit(word(14:), line, error)
    else if (index(word, '--template=') == 1 .and. len(word) > 11) then
      line%template = word(12:)
    else if (index(word, '--explain=') == 1 .and. len(word) > 10) then
      line%explain = word(11:)
    else if (index(word, '--petsc-options-file=') == 1) then
      call take_options_file(word(22:), line, error)
    else if (index(word, '--name=') == 1 .and. len(word) > 7) then
      line%table = word(8:)
    else if (index(word, '-') == 1) then
      call fail(error, 'gfb: unknown option '//word//did_you_mean(nearest_word(word, options))// &
                ' (gfb --help shows all)')
    else
      call take_file(word, line, error)
    end if
  end subroutine take_other

  !> A case file.
  subroutine take_file(word, line, error)
    character(len=*), intent(in) :: word
    type(command_line_type), intent(inout) :: line
    type(error_type), allocatable, intent(inout) :: error
    type(file_name_type) :: file

    if (word == '') then
      call fail(error, 'gfb: the name of the case file is empty')
      return
    end if
    if (.not. allocated(line%case_file)) line%case_file = word
    file%path = word
    line%case_files = [line%case_files, file]
  end subroutine take_file

  !> One word of the command line, empty where there is none.
  function argument(number) result(word)
    integer, intent(in) :: number
    character(len=:), allocatable :: word
    integer :: length

    word = ''
    if (number > command_argument_count()) return
    call get_command_argument(number, length=length)
    deallocate (word)
    allocate (character(len=length) :: word)
    call get_command_argument(number, word)
  end function argument

  !> What a run is given, which begins now.
  function run_context(self, log) result(context)
    class(command_line_type), intent(in) :: self !! the command line
    type(run_log_type), intent(in) :: log !! the terminal
    type(run_context_type) :: context

    context%folder = self%folder
    context%command = self%words
    context%petsc_options = given_petsc_options()
    context%csv%wanted = self%csv
    context%csv%decimal_comma = self%decimal_comma
    context%resumes = self%restart
    context%start_time = wall_time()
    context%log = log
  end function run_context

  !> What `--help` prints.
  pure function help_text() result(words)
    character(len=:), allocatable :: words
    character(len=1), parameter :: next = new_line('a')

    words = 'usage: gfb [options] CASE.nml   (or: mpiexec -n RANKS gfb ...)'//next// &
      '       gfb [options] -          reads the case from the standard input'//next// &
      '       gfb --template ANALYSIS > CASE.nml'//next// &
      next// &
      'Computes bump-type gas foil bearings, and their foils as structures.'//next// &
      next// &
      '  --check         read and check the case, print what it needs, stop'//next// &
      '  --strict        a warning about a value of the case is a mistake: status 1'//next// &
      '  --partition     how film and foils are shared out over the ranks of the job, '// &
      'stop;'//next// &
      '                  --partition=N: over N ranks'//next// &
      '  --branches      look for all equilibria of a bearing, and tabulate them'//next// &
      '  --output DIR    where the results go; made if it is not there; default: here'//next// &
      '  --restart       resume from CASE.restart.h5, which a killed run left behind'//next// &
      '  --time-limit T  stop after T seconds (or M:S, or H:M:S) as by a signal'//next// &
      '  --quiet         a line a stage, with the time so far, and warnings'//next// &
      '  --verbose       a line per iteration, too'//next// &
      '  --csv           write history, motion or orbits as CASE.csv, too (a sweep does '// &
      'anyway)'//next// &
      '  --decimal-comma  these tables with 1,5 for one and a half, and ; between columns'//next// &
      '  --groups N      divide the ranks into N groups, and among them the points of'//next// &
      '                  the case''s sweep, or several cases: CASE1.nml CASE2.nml ...'//next// &
      '  --name NAME     of the table of several cases; default: ensemble'//next// &
      '  --template A    a case file to begin with, all keys with unit, default and'//next// &
      '                  meaning; A: equilibrium, fixed_position, strip, modes,'//next// &
      '                  linear_dynamics, load_capacity, lift_off,'//next// &
      '                  misalignment_allowance, transient, periodic, thrust, machine'//next// &
      '  --short         of --template only what the case needs, 25 lines; A may be a'//next// &
      '                  topic of --explain, too'//next// &
      '  --explain NAME  a key (or group%key), a group, the name of a result, a value of'//next// &
      '                  a key, or a word of the field; --explain topics lists these;'//next// &
      '                  of any other word, all whose meanings have it; gfb help NAME'//next// &
      '                  does the same'//next// &
      '  --keys          table of all keys of a case file; of CASE.nml with why a key has'// &
      next//'                  no use in it'//next// &
      '  --results       table of the names of all results'//next// &
      '  --version       version of the program and its libraries'//next// &
      '  --help          this text'//next// &
      '  --              case files follow, also such as begin with -'//next// &
      '  --petsc-options-file FILE  options for PETSc, a line each, beside those of'//next// &
      '                  .petscrc in the home and of PETSC_OPTIONS'//next// &
      '  --petsc ...     all that follows is for PETSc, such as -bearing_ksp_view'//next// &
      next// &
      'results: CASE.summary, .h5, .used.nml, .csv of sweeps, and surfaces as '// &
      '.<part>.vtkhdf;'//next// &
      'CASE.unconverged.* where no answer was found, CASE.branches.* of --branches'//next// &
      'exit status: 0 done, 1 the input is wrong, 2 did not converge,'//next// &
      '             3 a file or the machine failed, 124 stopped by the time limit,'//next// &
      '             128 + N stopped by signal N (130 by Ctrl-C, 143 by SIGTERM)'
  end function help_text
end module gfb_command_line
