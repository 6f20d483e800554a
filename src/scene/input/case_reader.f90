!> A case file while its keys are read: finds a key's values, complains, and notes what there is.
module gfb_case_reader
  use gfb_kinds, only: wp
  use gfb_complaints, only: complaints_type
  use gfb_errors, only: error_type, fail, status_input
  use gfb_key_effect, only: acts_on_nothing
  use gfb_key_book, only: group_type, key_type, key_book_type, no_default, choices
  use gfb_namelist_file, only: entry_at, find_elements, is_entry_of, longest_list, moves_to, &
                               namelist_file_type, stands_in
  use gfb_namelist_scanner, only: scan_namelist
  use gfb_namelist_values, only: read_real, value_string, value_number
  use gfb_text, only: lower_case, nearest_word, text
  use gfb_value_rules, only: rule_type, broken_rule
  implicit none (type, external)
  private
  public :: case_reader_type

  !> A case file while its keys are read.
  type :: case_reader_type
    type(namelist_file_type) :: file
    type(complaints_type) :: complaints
    type(complaints_type) :: warnings       !! what need not be a mistake
    type(complaints_type) :: hints          !! what is no mistake, and will be one
    type(key_book_type) :: book             !! the groups and keys there are
    type(key_type) :: key                   !! the one that is being read
    integer, private :: mistakes_before = 0 !! the key that is being read
    integer, private :: keys_scanned_wrong = 0 !! whose mistakes the scanner has reported
    logical, private :: strict = .false.    !! warnings are mistakes
    integer, private :: group_acts_on = acts_on_nothing !! where its keys do not say otherwise
    character(len=:), allocatable, private :: why_idle  !! no answer follows the next keys
  contains
    procedure, non_overridable :: open_text, start_group, finish, report
    procedure, non_overridable :: complain, rule, refuse, warn, warn_of_line
    procedure, non_overridable :: hint_lines, warning_lines, add_new, meant
    procedure, non_overridable :: holds, last_key_is_right, mistakes
    procedure, non_overridable :: line_of_group, idle, act_on
    procedure, non_overridable :: describe, begin_key, end_key, end_numbers
    procedure, non_overridable :: take_real, take_choice, complain_value
  end type case_reader_type

contains

  !> Scans the text of a case file.
  subroutine open_text(self, words, file, strict, noted)
    class(case_reader_type), intent(out) :: self !! the keys being read
    character(len=*), intent(in) :: words !! the whole file
    character(len=*), intent(in) :: file  !! its name, for complaints
    logical, intent(in), optional :: strict !! warnings are mistakes
    logical, intent(in), optional :: noted !! what is shown of keys is kept; default: yes

    self%complaints%file = trim(file)
    self%warnings%file = trim(file)
    self%hints%file = trim(file)
    if (present(strict)) self%strict = strict
    if (present(noted)) self%book%kept = noted
    call scan_namelist(words, self%file, self%complaints)
  end subroutine open_text

  !> Begins a group. The keys of an optional group that is absent are neither read nor asked for.
  subroutine start_group(self, name, required, optional, present_in_file, misplaced, acts_on)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the group
    logical, intent(in), optional :: required !! its absence is a mistake
    logical, intent(in), optional :: optional !! without it, what it describes is not there
    logical, intent(out), optional :: present_in_file !! the file has the group
    character(len=*), intent(in), optional :: misplaced !! why it does not fit; empty where it does
    integer, intent(in), optional :: acts_on !! what its keys act on: `acts_on_film`, ...
    type(group_type) :: group

    self%group_acts_on = acts_on_nothing
    if (present(acts_on)) self%group_acts_on = acts_on
    self%why_idle = ''
    group%name = name
    group%line = self%line_of_group(name)
    if (present(required)) group%required = required
    if (present(optional)) group%is_echoed = group%line > 0 .or. .not. optional
    if (present(misplaced)) group%misplaced = misplaced
    call self%book%add_group(group)
    self%key%group = name
    if (present(present_in_file)) present_in_file = group%line > 0
    if (.not. present(misplaced)) return
    if (misplaced /= '' .and. group%line > 0) then
      call self%complaints%add(group%line, '&'//name//': the group '//misplaced)
    end if
  end subroutine start_group

  !> Says why no answer follows the next keys of the group, or one that has been read, be it of
  !> another group.
  subroutine idle(self, why, name, group)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: why !! empty: answers follow them
    character(len=*), intent(in), optional :: name !! of the key that has been read
    character(len=*), intent(in), optional :: group !! of that key; default: the present one
    integer :: place

    if (present(name)) then
      place = self%book%place_of(self%key%group, name)
      if (present(group)) place = self%book%place_of(group, name)
      self%book%keys(place)%idle = why
    else
      self%why_idle = why
    end if
  end subroutine idle

  !> Says what a key of the group acts on, where what has been read behind it decides that.
  subroutine act_on(self, name, acts_on)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    integer, intent(in) :: acts_on !! `acts_on_film`, ...
    integer :: place

    place = self%book%place_of(self%key%group, name)
    self%book%keys(place)%acts_on = acts_on
  end subroutine act_on

  !> Where a group begins, be it not read yet; 0 where the file does not have it.
  pure integer function line_of_group(self, name) result(line)
    class(case_reader_type), intent(in) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the group
    integer :: i

    line = 0
    do i = size(self%file%groups), 1, -1
      if (self%file%group_name(i) == name) line = self%file%groups(i)%line
    end do
  end function line_of_group

  !> After the last group: complains about names that do not exist, and about what is missing.
  subroutine finish(self)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=:), allocatable :: group
    integer :: entry

    call self%book%check_names(self%file, self%complaints)
    do entry = 1, size(self%file%entries)
      group = moves_to(self%file, entry)
      if (group == '') cycle
      associate (item => self%file%entries(entry))
        call self%hints%add(item%line, '&'//self%file%group_name(item%group)//': '// &
                            self%file%key_name(entry)//' belongs into &'//group// &
                            ' now; where it stands it is read by this version for the last time')
      end associate
    end do
  end subroutine finish

  !> All mistakes as one error, with the warnings, which may show why; none where the file is right.
  subroutine report(self, error)
    class(case_reader_type), intent(in) :: self !! the keys being read
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    character(len=:), allocatable :: words

    if (self%complaints%count == 0) return
    words = self%complaints%report()
    if (self%warnings%count > 0) words = words//new_line('a')//self%warning_lines()
    call fail(error, words, status_input)
  end subroutine report

  !> All hints, one a line; empty where there are none.
  pure function hint_lines(self) result(words)
    class(case_reader_type), intent(in) :: self !! the keys being read
    character(len=:), allocatable :: words
    words = self%hints%report('note: ')
  end function hint_lines

  !> All warnings, one a line; empty where there are none.
  pure function warning_lines(self) result(words)
    class(case_reader_type), intent(in) :: self !! the keys being read
    character(len=:), allocatable :: words
    words = self%warnings%report('warning: ')
  end function warning_lines

  !> Complains about a key whose value does not fit the rest of the scene; one that was wrong when
  !> it was read is not judged again.
  subroutine complain(self, group, key, rule, element)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: group, key !! names in the case file
    character(len=*), intent(in) :: rule      !! what it should be
    integer, intent(in), optional :: element  !! of a list
    character(len=:), allocatable :: place
    integer :: line

    if (is_known_wrong(self, group, key, element)) return
    call find_place(self, group, key, line, place, element)
    call self%complaints%add(line, place//': '//rule)
  end subroutine complain

  !> A rule between keys: complains of a key, or of an element of its list, where it is broken.
  subroutine rule(self, group, key, broken, words, element)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: group, key !! names in the case file
    logical, intent(in) :: broken !! the rule
    character(len=*), intent(in) :: words !! what the key should be
    integer, intent(in), optional :: element !! of a list
    if (broken) call self%complain(group, key, words, element)
  end subroutine rule

  !> The same of those keys of a group that stand in the file: they have no use, or lack something.
  !> The table of the case's keys says so of all that are named.
  subroutine refuse(self, group, names, broken, words)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: group
    character(len=*), intent(in) :: names !! of keys, with commas between them
    logical, intent(in) :: broken !! the rule
    character(len=*), intent(in) :: words !! why they must not be given
    character(len=:), allocatable :: left, key
    integer :: comma, place

    if (.not. broken) return
    left = names//','
    do while (left /= '')
      comma = index(left, ',')
      key = trim(adjustl(left(:comma - 1)))
      left = left(comma + 1:)
      place = self%book%place_of(group, key)
      if (place > 0) self%book%keys(place)%why_refused = words
      if (self%meant(group, key)) call self%complain(group, key, words)
    end do
  end subroutine refuse

  !> Warns of a key whose value is allowed but improbable; a mistake where the reader is strict.
  subroutine warn(self, group, key, words, element)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: group, key !! names in the case file
    character(len=*), intent(in) :: words     !! what is odd
    integer, intent(in), optional :: element  !! of a list
    character(len=:), allocatable :: place
    integer :: line

    call find_place(self, group, key, line, place, element)
    call self%warn_of_line(line, place//': '//words)
  end subroutine warn

  !> Warns of a line; a mistake where the reader is strict.
  subroutine warn_of_line(self, line, words)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    integer, intent(in) :: line           !! of the file, 0 where it has no place
    character(len=*), intent(in) :: words !! what is odd

    if (self%strict) then
      call self%complaints%add(line, words)
    else
      call self%warnings%add(line, words)
    end if
  end subroutine warn_of_line

  !> Adds the mistakes and warnings that another reading of the file has and one has not, as those
  !> of a key's element.
  subroutine add_new(self, other, known, group, key, element)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    class(case_reader_type), intent(in) :: other !! with what is new
    class(case_reader_type), intent(in) :: known !! with what is not
    character(len=*), intent(in) :: group, key !! names in the case file
    integer, intent(in) :: element !! of the key's list
    character(len=:), allocatable :: place
    integer :: line

    call find_place(self, group, key, line, place, element)
    call self%complaints%add_new(other%complaints, known%complaints, line, place//': ')
    call self%warnings%add_new(other%warnings, known%warnings, line, place//': ')
  end subroutine add_new

  !> Whether a value, or all values of a key, were wrong when they were read.
  logical function is_known_wrong(self, group, key, element) result(wrong)
    class(case_reader_type), intent(in) :: self
    character(len=*), intent(in) :: group, key
    integer, intent(in), optional :: element !! of a list
    integer, allocatable :: elements(:)

    wrong = .false.
    associate (known => self%book%place_of(group, key))
      if (known > 0) wrong = self%book%keys(known)%unread
    end associate
    if (wrong) return
    call find_elements(self%file, group, key, longest_list, elements)
    if (present(element)) then
      if (element <= size(elements)) wrong = self%file%values(elements(element))%wrong
    else if (size(elements) > 0) then
      wrong = all(self%file%values(elements)%wrong)
    end if
  end function is_known_wrong

  !> Where a key stands in the file, with its values; without it, where its group begins.
  subroutine find_place(self, group, key, line, place, element)
    class(case_reader_type), intent(in) :: self
    character(len=*), intent(in) :: group, key
    integer, intent(out) :: line !! of the file, 0 where the group is not there
    character(len=:), allocatable, intent(out) :: place !! in words
    integer, intent(in), optional :: element !! of a list
    integer, allocatable :: elements(:)
    integer :: value, entry

    place = '&'//group//': '//key
    do entry = 1, size(self%file%entries)
      if (.not. is_entry_of(self%file, entry, group, key)) cycle
      associate (item => self%file%entries(entry))
        place = '&'//self%file%group_name(item%group)//': '//key
        if (present(element)) then
          call find_elements(self%file, group, key, longest_list, elements)
          value = 0
          if (size(elements) >= element) value = elements(element)
          if (value > 0) then
            line = self%file%values(value)%line
            place = place//'('//text(element)//') = '//self%file%value_shown(value)
            return
          end if
        end if
        line = item%line
        place = place//' = '//self%file%values_shown(item%first_value, item%last_value)
        return
      end associate
    end do
    line = self%book%group_line(group)
  end subroutine find_place

  !> Whether a key stands in the file, rightly spelt, be it not read yet.
  pure function holds(self, group, key)
    class(case_reader_type), intent(in) :: self !! the keys being read
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: holds
    holds = stands_in(self%file, group, key)
  end function holds

  !> Whether a key stands in the file with another value than its default, be it misspelt; not
  !> before `finish`.
  pure function meant(self, group, key)
    class(case_reader_type), intent(in) :: self !! the keys being read
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: meant
    integer :: place

    meant = .false.
    place = self%book%place_of(group, key)
    if (place == 0) return
    associate (known => self%book%keys(place))
      meant = (known%given .and. .not. known%is_default) .or. known%misspelt
    end associate
  end function meant

  !> Whether the key read last stands in the file without a mistake.
  pure logical function last_key_is_right(self) result(right)
    class(case_reader_type), intent(in) :: self !! the keys being read
    right = self%key%given .and. self%mistakes() == self%mistakes_before
  end function last_key_is_right

  !> A count that grows with every mistake that is met, be it one that was reported before.
  pure function mistakes(self)
    class(case_reader_type), intent(in) :: self !! the keys being read
    integer :: mistakes
    mistakes = self%complaints%count + self%keys_scanned_wrong
  end function mistakes

  !> Notes what a key is.
  subroutine describe(self, name, type_words, unit, meaning, acts_on)
    class(case_reader_type), intent(inout) :: self
    character(len=*), intent(in) :: name, type_words !! of the key; kind of value, in words
    character(len=*), intent(in) :: unit    !! '1' for a pure number, empty for words
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    integer, intent(in), optional :: acts_on !! default: what its group acts on

    self%key%idle = self%why_idle
    self%key%acts_on = self%group_acts_on
    if (present(acts_on)) self%key%acts_on = acts_on
    self%key%name = name
    self%key%type_words = type_words
    self%key%unit = unit
    self%key%meaning = meaning
    self%key%numbers = [real(wp) ::]
    if (allocated(self%key%why_useless)) deallocate (self%key%why_useless)
    if (allocated(self%key%why_refused)) deallocate (self%key%why_refused)
  end subroutine describe

  !> Finds a key's values, and notes what the table says of it.
  subroutine begin_key(self, value_words, most, elements, required, default, given)
    class(case_reader_type), intent(inout) :: self
    character(len=*), intent(in) :: value_words      !! the default in figures
    integer, intent(in) :: most                      !! values at most, or `single`
    integer, allocatable, intent(out) :: elements(:) !! number of each value in the file
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    logical, intent(out), optional :: given !! the file has it
    logical :: wrong

    self%mistakes_before = self%mistakes()
    associate (key => self%key)
      key%required = .false.
      if (present(required)) key%required = required
      key%default = ''
      if (present(default)) key%default = default
      key%shown_default = '`'//value_words//'`'
      if (key%required) key%shown_default = 'required'
      if (key%default /= '') key%shown_default = key%default
      call find_elements(self%file, trim(key%group), trim(key%name), most, elements, key%given, &
                         self%complaints, wrong)
      if (wrong) self%keys_scanned_wrong = self%keys_scanned_wrong + 1
      key%missing = key%required .and. .not. key%given .and. self%book%group_line(key%group) > 0
      key%unread = key%given .and. size(elements) == 0
      if (present(given)) given = key%given
    end associate
  end subroutine begin_key

  !> Notes the value of the key.
  subroutine end_key(self, value_words, is_set, same)
    class(case_reader_type), intent(inout) :: self
    character(len=*), intent(in) :: value_words !! the value, as it is shown
    logical, intent(in) :: is_set  !! a value that is a default is more than a placeholder
    logical, intent(in) :: same    !! the value is the one that it came with

    self%key%value = value_words
    self%key%is_set = is_set
    ! An echo that is read again gives all defaults: they ask for nothing.
    self%key%is_default = self%last_key_is_right() .and. same .and. .not. self%key%required .and. &
                          self%key%default /= no_default
    call self%book%add_key(self%key)
  end subroutine end_key

  !> The same of real numbers.
  subroutine end_numbers(self, values, same)
    class(case_reader_type), intent(inout) :: self
    real(wp), intent(in) :: values(:) !! [their unit]
    logical, intent(in) :: same !! they are those that it came with

    self%key%numbers = values
    call self%end_key(self%book%numbers_shown(values), any(abs(values) > 0.0_wp), same)
  end subroutine end_numbers

  !> Reads and checks one real number.
  subroutine take_real(self, item, element, value, rule)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    integer, intent(in) :: item                !! the value's number in the file
    integer, intent(in) :: element             !! of a list, 0 for a single value
    real(wp), intent(inout) :: value !! [its unit] unchanged where a rule is broken
    type(rule_type), intent(in), optional :: rule !! that the value keeps
    character(len=:), allocatable :: problem
    real(wp) :: number

    call read_real(self%file%value_text(item), number, problem)
    if (self%file%values(item)%kind == value_string) problem = 'must be a number, without quotes'
    if (problem == '' .and. present(rule)) problem = broken_rule(rule, number)
    if (problem == '') value = number
    ! Minus zero would not come back from the echo.
    if (.not. abs(value) > 0.0_wp) value = 0.0_wp
    call self%complain_value(item, element, problem)
  end subroutine take_real

  !> Reads one word of a list of choices.
  subroutine take_choice(self, item, element, words, value, others)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    integer, intent(in) :: item             !! the value's number in the file
    integer, intent(in) :: element          !! of a list, 0 for a single value
    character(len=*), intent(in) :: words(:) !! that may be chosen
    integer, intent(inout) :: value         !! unchanged where the word is none of the list
    character(len=*), intent(in), optional :: others !! what may stand there too, in words
    character(len=:), allocatable :: word, near, problem
    integer :: i

    word = lower_case(trim(self%file%value_text(item)))
    problem = 'must be one of '//choices(words)
    if (present(others)) problem = problem//', or '//others
    near = nearest_word(word, words)
    if (near /= '') problem = 'did you mean '''//near//'''? It '//problem
    do i = 1, size(words)
      if (word /= words(i)) cycle
      problem = 'must be in quotes: '''//word//''''
      if (self%file%values(item)%kind == value_string) then
        value = i
        problem = ''
      end if
    end do
    if (self%file%values(item)%kind == value_number) problem = 'must be one of '//choices(words)
    call self%complain_value(item, element, problem)
  end subroutine take_choice

  !> Complains about one value of the key; nothing where there is no problem, or one was reported.
  subroutine complain_value(self, item, element, problem)
    class(case_reader_type), intent(inout) :: self !! the keys being read
    integer, intent(in) :: item               !! the value's number in the file
    integer, intent(in) :: element            !! of a list, 0 for a single value
    character(len=*), intent(in) :: problem   !! the rule that is broken
    character(len=:), allocatable :: words

    if (problem == '' .or. self%file%values(item)%wrong) return
    self%file%values(item)%wrong = .true.
    associate (entry => self%file%entries(entry_at(self%file, self%file%values(item)%first)))
      words = '&'//self%file%group_name(entry%group)//': '//trim(self%key%name)
    end associate
    if (element > 0) words = words//'('//text(element)//')'
    words = words//' = '//self%file%value_shown(item)//': '//problem
    if (self%key%unit /= '' .and. self%key%unit /= '1') words = words//' ['//self%key%unit//']'
    call self%complaints%add(self%file%values(item)%line, words)
  end subroutine complain_value
end module gfb_case_reader
