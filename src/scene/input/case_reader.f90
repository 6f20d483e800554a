!> A case file while its keys are read: finds a key's values, complains, keeps the notes, and knows
!> the groups and keys there are, against the names that stand in the file.
module gfb_case_reader
  use gfb_kinds, only: wp
  use gfb_complaints, only: complaints_type, shown
  use gfb_errors, only: error_type, fail, status_input
  use gfb_foreign_characters, only: is_spoilt
  use gfb_key_notes, only: key_type, real_words, list_words, key_notes_type, no_default, choices
  use gfb_moved_keys, only: home_of
  use gfb_namelist_file, only: entry_at, find_elements, is_entry_of, moves_to, namelist_file_type
  use gfb_namelist_scanner, only: scan_namelist
  use gfb_namelist_values, only: read_real, value_string, value_number
  use gfb_text, only: join, lower_case, nearest_word, text
  use gfb_value_rules, only: rule_type, broken_rule
  implicit none (type, external)
  private
  public :: case_reader_type

  integer, parameter :: name_length = 40 !! no group and no key is longer
  integer, parameter :: first_room = 64  !! for keys

  !> What is known of a group or a key.
  type :: name_type
    integer :: line = 0              !! of a group in the file, 0 where it is absent
    logical :: missing = .false.     !! required and absent
    logical :: given = .false.       !! it stands in the file
    logical :: is_default = .false.  !! of a key: it is given the value that holds without it
    logical :: misspelt = .false.    !! the file has an unknown name that is nearest to this one
    logical :: unread = .false.      !! of a key: its values could not be told apart
    logical :: is_real = .false.     !! of a key: its value is one real number
    logical :: is_list = .false.     !! of a key: its values are a list of real numbers
    character(len=:), allocatable :: unit    !! of a key
    character(len=:), allocatable :: meaning
  end type name_type

  !> All groups and keys.
  type :: key_book_type
    private
    character(len=name_length), allocatable :: group_names(:)
    type(name_type), allocatable :: groups(:)
    character(len=name_length), allocatable :: key_groups(:), key_names(:)
    type(name_type), allocatable :: keys(:) !! `count` of them, and room for more
    integer :: count = 0
  contains
    procedure :: add_group
    procedure :: add_key
    procedure :: take_for_default
    procedure :: is_unread
    procedure :: check_names
    procedure :: is_meant
    procedure :: group_line => line_of_group
    procedure :: look_up_real
  end type key_book_type

  integer, parameter, public :: longest_list = 10000 !! values one key can have

  !> A case file while its keys are read.
  type :: case_reader_type
    type(namelist_file_type) :: file
    type(complaints_type) :: complaints
    type(complaints_type) :: warnings      !! what need not be a mistake
    type(complaints_type) :: hints         !! what is no mistake, and will be one
    type(key_notes_type) :: notes          !! the echo and the table of keys
    type(key_type) :: key                  !! the one that is being read
    type(key_book_type) :: book            !! the groups and keys there are
    integer, private :: mistakes_before = 0 !! the key that is being read
    integer, private :: keys_scanned_wrong = 0 !! whose mistakes the scanner has told
    integer, private :: group_line = 0     !! of the open group, 0 where the file has none
    logical, private :: strict = .false.   !! warnings are mistakes
  contains
    procedure :: open_text
    procedure :: start_group
    procedure :: finish_group
    procedure :: finish
    procedure :: report
    procedure :: complain
    procedure :: warn
    procedure :: warn_of_line
    procedure :: warning_lines
    procedure :: hint_lines
    procedure :: add_new
    procedure :: meant
    procedure :: holds
    procedure :: last_key_is_right
    procedure :: mistakes
    procedure :: describe
    procedure :: begin_key
    procedure :: take_real
    procedure :: take_choice
    procedure :: end_key
    procedure :: complain_value
  end type case_reader_type

contains

  !> Adds a group.
  pure subroutine add_group(self, group, line, required)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    character(len=*), intent(in) :: group !! of the file
    integer, intent(in) :: line      !! of the file, 0 where it is absent
    logical, intent(in) :: required !! a case without it is wrong
    type(name_type) :: name

    if (.not. allocated(self%groups)) then
      allocate (self%group_names(0), self%groups(0))
      call set_room(self, first_room)
    end if
    name%line = line
    name%missing = required .and. line == 0
    self%group_names = [character(len=name_length) :: self%group_names, group]
    self%groups = [self%groups, name]
  end subroutine add_group

  !> Adds a key.
  pure subroutine add_key(self, group, key, given, required, unread)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    character(len=*), intent(in) :: group !! of the file
    type(key_type), intent(in) :: key !! what is known of it
    logical, intent(in) :: given     !! it stands in the file
    logical, intent(in) :: required !! a case without it is wrong
    logical, intent(in) :: unread !! its values could not be told apart
    type(name_type) :: name

    name%unread = unread
    name%given = given
    name%missing = required .and. .not. given
    name%is_real = key%type_words == real_words
    name%is_list = key%type_words == list_words
    name%unit = key%unit
    name%meaning = key%meaning
    if (self%count == size(self%keys)) call set_room(self, 2*self%count)
    self%count = self%count + 1
    self%key_groups(self%count) = group
    self%key_names(self%count) = key%name
    self%keys(self%count) = name
  end subroutine add_key

  !> Whether a key stands in the file so that its values could not be told apart.
  pure function is_unread(self, group, key) result(unread)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: unread
    character(len=:), allocatable :: home

    home = home_of(group, key)
    associate (n => self%count)
      unread = any(self%key_groups(:n) == home .and. self%key_names(:n) == key .and. &
                   self%keys(:n)%unread)
    end associate
  end function is_unread

  !> Gives the keys another number of places: many at once, for copies take time.
  pure subroutine set_room(self, places)
    type(key_book_type), intent(inout) :: self
    integer, intent(in) :: places !! `count` at least
    character(len=name_length), allocatable :: groups(:), names(:)
    type(name_type), allocatable :: keys(:)

    allocate (groups(places), names(places), keys(places))
    groups = ''
    names = ''
    if (self%count > 0) then
      groups(:self%count) = self%key_groups(:self%count)
      names(:self%count) = self%key_names(:self%count)
      keys(:self%count) = self%keys(:self%count)
    end if
    call move_alloc(groups, self%key_groups)
    call move_alloc(names, self%key_names)
    call move_alloc(keys, self%keys)
  end subroutine set_room

  !> Line of a group in the file, 0 where it is absent.
  pure function line_of_group(self, group) result(line)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group !! of the file
    integer :: line
    integer :: i

    line = 0
    i = findloc(self%group_names == group, .true., dim=1)
    if (i > 0) line = self%groups(i)%line
  end function line_of_group

  !> Looks up a key whose value is to be one real number, or a value of a list.
  pure subroutine look_up_real(self, group, key, in_list, unit, problem)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group, key !! names as they were typed, in lower case
    logical, intent(in) :: in_list !! a value of a list is meant
    character(len=:), allocatable, intent(out) :: unit !! of the key; empty where there is a problem
    character(len=:), allocatable, intent(out) :: problem !! in words; empty where there is none
    character(len=2*name_length) :: known(size(self%keys))
    character(len=:), allocatable :: near
    logical :: is_key(size(self%keys))
    integer :: i

    unit = ''
    problem = ''
    is_key = self%key_names == key
    i = findloc(is_key .and. self%key_groups == home_of(group, key), .true., dim=1)
    if (i == 0) then
      do i = 1, size(known)
        known(i) = trim(self%key_groups(i))//'%'//trim(self%key_names(i))
      end do
      near = nearest_word(group//'%'//key, pack(known, self%keys%is_real .or. self%keys%is_list))
      is_key = is_key .and. self%keys%is_real
      if (any(is_key)) near = join(pack(known, is_key), ''' or ''')
      problem = 'there is no key '//shown(group//'%'//key)
      if (near /= '') problem = problem//', did you mean '''//near//'''?'
    else if (self%keys(i)%is_list .and. .not. in_list) then
      problem = group//'%'//key//' is a list: name one of its values, such as '//key//'(2)'
    else if (self%keys(i)%is_real .and. in_list) then
      problem = group//'%'//key//' is a single value and takes no index'
    else if (.not. (self%keys(i)%is_real .or. self%keys(i)%is_list)) then
      problem = group//'%'//key//' is not one real number'
    else
      unit = self%keys(i)%unit
    end if
  end subroutine look_up_real

  !> The key added last has the value that holds without it.
  pure subroutine take_for_default(self)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    self%keys(self%count)%is_default = .true.
  end subroutine take_for_default

  !> Whether a key stands in the file with another value than its default, be it misspelt.
  pure function is_meant(self, group, key) result(meant)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: meant
    meant = any(self%key_groups == home_of(group, key) .and. self%key_names == key .and. &
                ((self%keys%given .and. .not. self%keys%is_default) .or. self%keys%misspelt))
  end function is_meant

  !> Complains about unknown groups and keys, and about missing ones that no misspelling explains.
  subroutine check_names(self, file, complaints)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    type(namelist_file_type), intent(in) :: file !! the case file, scanned
    type(complaints_type), intent(inout) :: complaints !! the mistakes found so far
    character(len=:), allocatable :: group_name
    integer :: i

    call set_room(self, self%count)
    do i = 1, size(file%groups)
      call check_group(self, file, i, complaints)
    end do
    do i = 1, size(file%strays)
      call excuse_group(self, stray_word(file, i))
    end do
    do i = 1, size(file%entries)
      call check_key(self, file, i, complaints)
    end do
    do i = 1, size(self%groups)
      associate (group => self%groups(i))
        if (.not. group%missing .or. group%misspelt) cycle
        call complaints%add(0, 'the group &'//trim(self%group_names(i))//' is missing')
      end associate
    end do
    do i = 1, size(self%keys)
      associate (key => self%keys(i))
        if (.not. key%missing .or. key%misspelt) cycle
        group_name = trim(self%key_groups(i))
        call complaints%add(self%group_line(group_name), '&'//group_name// &
                            ": the required key '"//trim(self%key_names(i))//"' is missing ("// &
                            key%meaning//')')
      end associate
    end do
  end subroutine check_names

  !> Complains about a group that does not exist or stands in the file before.
  subroutine check_group(self, file, i, complaints)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: i
    type(complaints_type), intent(inout) :: complaints
    character(len=:), allocatable :: name, near
    integer :: line, known

    name = file%group_name(i)
    if (name == '') return
    line = file%groups(i)%line
    known = findloc(self%group_names == name, .true., dim=1)
    if (known > 0) then
      if (self%groups(known)%given) then
        call complaints%add(line, '&'//name//': the group is given twice, first in line '// &
                            text(self%groups(known)%line))
      end if
      self%groups(known)%given = .true.
      return
    end if
    near = nearest_word(name, self%group_names)
    if (is_spoilt(name)) then
      call excuse_group(self, near) ! its characters outside ASCII have been complained about
    else if (near /= '') then
      call complaints%add(line, "unknown group '&"//shown(name)//"', did you mean '&"//near//"'?")
      call excuse_group(self, near)
    else
      call complaints%add(line, "unknown group '&"//shown(name)//"'; the groups are &"// &
                          join(self%group_names, ', &'))
    end if
  end subroutine check_group

  !> Complains about a key that does not exist.
  subroutine check_key(self, file, i, complaints)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: i
    type(complaints_type), intent(inout) :: complaints
    character(len=:), allocatable :: group, key, near, words
    logical :: in_group(size(self%keys))
    integer :: j

    key = file%key_name(i)
    group = home_of(file%group_name(file%entries(i)%group), key)
    if (.not. any(self%group_names == group)) return
    in_group = self%key_groups == group
    if (any(in_group .and. self%key_names == key)) return
    if (is_spoilt(key)) then ! its characters outside ASCII have been complained about
      near = nearest_word(key, pack(self%key_names, in_group))
      where (in_group .and. self%key_names == near) self%keys%misspelt = .true.
      return
    end if
    words = '&'//group//": unknown key '"//shown(key)//"'"
    near = nearest_word(key, pack(self%key_names, in_group))
    if (any(self%key_names == key)) then
      j = findloc(self%key_names == key .and. self%keys%missing, .true., dim=1)
      if (j == 0) j = findloc(self%key_names == key, .true., dim=1)
      words = words//'; it belongs into &'//trim(self%key_groups(j))
      self%keys(j)%misspelt = .true.
    else if (near /= '') then
      words = words//", did you mean '"//near//"'?"
      where (in_group .and. self%key_names == near) self%keys%misspelt = .true.
    else
      words = words//'; the keys of &'//group//' are '//join(pack(self%key_names, in_group), ', ')
    end if
    call complaints%add(file%entries(i)%line, words)
  end subroutine check_key

  !> Notes that the file means to have a group.
  subroutine excuse_group(self, name)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    character(len=*), intent(in) :: name
    where (self%group_names == name) self%groups%misspelt = .true.
  end subroutine excuse_group

  !> A word that stands outside of all groups.
  pure function stray_word(file, i) result(word)
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: i
    character(len=:), allocatable :: word
    word = lower_case(file%words(file%strays(i)%first:file%strays(i)%last))
  end function stray_word

  !> Scans the text of a case file.
  subroutine open_text(self, words, file, strict, noted)
    class(case_reader_type), intent(out) :: self !! the case file being read
    character(len=*), intent(in) :: words !! the whole file
    character(len=*), intent(in) :: file  !! its name, for complaints
    logical, intent(in), optional :: strict !! warnings are mistakes
    logical, intent(in), optional :: noted !! echo and table of keys are kept; default: yes

    self%complaints%file = trim(file)
    self%warnings%file = trim(file)
    self%hints%file = trim(file)
    if (present(strict)) self%strict = strict
    if (present(noted)) self%notes%kept = noted
    call scan_namelist(words, self%file, self%complaints)
  end subroutine open_text

  !> Begins a group. The keys of an optional group that is absent are neither read nor asked for.
  subroutine start_group(self, name, required, optional, present_in_file, misplaced)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    character(len=*), intent(in) :: name !! of the key
    logical, intent(in), optional :: required !! its absence is a mistake
    logical, intent(in), optional :: optional !! without it, what it describes is not there
    logical, intent(out), optional :: present_in_file !! the file has the group
    character(len=*), intent(in), optional :: misplaced !! why it does not fit; empty where it does
    integer :: group
    logical :: is_required, is_optional

    is_required = .false.
    if (present(required)) is_required = required
    is_optional = .false.
    if (present(optional)) is_optional = optional
    self%group_line = 0
    do group = size(self%file%groups), 1, -1
      if (self%file%group_name(group) == name) self%group_line = self%file%groups(group)%line
    end do
    call self%book%add_group(name, self%group_line, is_required)
    call self%notes%start_group(name, self%group_line > 0 .or. .not. is_optional)
    if (present(present_in_file)) present_in_file = self%group_line > 0
    if (.not. present(misplaced)) return
    if (misplaced /= '' .and. self%group_line > 0) then
      call self%complaints%add(self%group_line, '&'//name//': the group '//misplaced)
    end if
  end subroutine start_group

  !> Ends a group.
  subroutine finish_group(self)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    call self%notes%finish_group()
  end subroutine finish_group

  !> After the last group: complains about names that do not exist, and about what is missing.
  subroutine finish(self)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    character(len=:), allocatable :: home
    integer :: entry

    call self%book%check_names(self%file, self%complaints)
    do entry = 1, size(self%file%entries)
      home = moves_to(self%file, entry)
      if (home == '') cycle
      associate (item => self%file%entries(entry))
        call self%hints%add(item%line, '&'//self%file%group_name(item%group)//': '// &
                            self%file%key_name(entry)//' belongs into &'//home// &
                            ' now; where it stands it is read by this version for the last time')
      end associate
    end do
  end subroutine finish

  !> All mistakes as one error, with the warnings, which may tell why; none where the file is right.
  subroutine report(self, error)
    class(case_reader_type), intent(in) :: self !! the case file being read
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    character(len=:), allocatable :: words

    if (self%complaints%count == 0) return
    words = self%complaints%report()
    if (self%warnings%count > 0) words = words//new_line('a')//self%warning_lines()
    call fail(error, words, status_input)
  end subroutine report

  !> All hints, one a line; empty where there are none.
  pure function hint_lines(self) result(words)
    class(case_reader_type), intent(in) :: self !! the case file being read
    character(len=:), allocatable :: words
    words = self%hints%report('note: ')
  end function hint_lines

  !> All warnings, one a line; empty where there are none.
  pure function warning_lines(self) result(words)
    class(case_reader_type), intent(in) :: self !! the case file being read
    character(len=:), allocatable :: words
    words = self%warnings%report('warning: ')
  end function warning_lines

  !> Complains about a key whose value does not fit the rest of the scene; one that was wrong when
  !> it was read is not judged again.
  subroutine complain(self, group, key, rule, element)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    character(len=*), intent(in) :: group, key !! names in the case file
    character(len=*), intent(in) :: rule      !! what it should be
    integer, intent(in), optional :: element  !! of a list
    character(len=:), allocatable :: place
    integer :: line

    if (is_known_wrong(self, group, key, element)) return
    call find_place(self, group, key, line, place, element)
    call self%complaints%add(line, place//': '//rule)
  end subroutine complain

  !> Warns of a key whose value is allowed and hardly meant; a mistake where the reader is strict.
  subroutine warn(self, group, key, words, element)
    class(case_reader_type), intent(inout) :: self !! the case file being read
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
    class(case_reader_type), intent(inout) :: self !! the case file being read
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
    class(case_reader_type), intent(inout) :: self !! the case file being read
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
  function is_known_wrong(self, group, key, element) result(wrong)
    class(case_reader_type), intent(in) :: self
    character(len=*), intent(in) :: group, key
    integer, intent(in), optional :: element !! of a list
    logical :: wrong
    integer, allocatable :: elements(:)

    wrong = self%book%is_unread(group, key)
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

  !> Whether a key stands in the file with another value than its default, be it misspelt; not
  !> before `finish`.
  function meant(self, group, key)
    class(case_reader_type), intent(in) :: self !! the case file being read
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: meant
    meant = self%book%is_meant(group, key)
  end function meant

  !> Whether a key stands in the file, rightly spelt, be it not read yet.
  pure function holds(self, group, key)
    class(case_reader_type), intent(in) :: self !! the case file being read
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: holds
    integer :: entry

    holds = .false.
    do entry = 1, size(self%file%entries)
      holds = holds .or. is_entry_of(self%file, entry, group, key)
    end do
  end function holds

  !> Whether the key read last stands in the file without a mistake.
  pure function last_key_is_right(self) result(right)
    class(case_reader_type), intent(in) :: self !! the case file being read
    logical :: right
    right = self%key%given .and. self%mistakes() == self%mistakes_before
  end function last_key_is_right

  !> A count that grows with every mistake that is met, be it one that was told before.
  pure function mistakes(self)
    class(case_reader_type), intent(in) :: self !! the case file being read
    integer :: mistakes
    mistakes = self%complaints%count + self%keys_scanned_wrong
  end function mistakes

  !> Notes what a key is.
  subroutine describe(self, name, type_words, unit, meaning)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    character(len=*), intent(in) :: name, type_words !! of the key; kind of value, in words
    character(len=*), intent(in) :: unit    !! '1' for a pure number, empty for words
    character(len=*), intent(in) :: meaning !! of the key, a sentence

    self%key%name = name
    self%key%type_words = type_words
    self%key%unit = unit
    self%key%meaning = meaning
  end subroutine describe

  !> Finds a key's values and notes what the table says of it.
  subroutine begin_key(self, value_words, most, elements, required, default, given)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    character(len=*), intent(in) :: value_words      !! the default in figures
    integer, intent(in) :: most                      !! values at most, or `single`
    integer, allocatable, intent(out) :: elements(:) !! number of each value in the file
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    logical, intent(out), optional :: given !! the file has it
    logical :: wrong

    self%mistakes_before = self%mistakes()
    self%key%required = .false.
    if (present(required)) self%key%required = required
    self%key%default = ''
    if (present(default)) self%key%default = default
    call find_elements(self%file, self%notes%group, self%key%name, most, elements, self%key%given, &
                       self%complaints, wrong)
    if (wrong) self%keys_scanned_wrong = self%keys_scanned_wrong + 1
    call self%notes%add_row(self%key, value_words)
    call self%book%add_key(self%notes%group, self%key, self%key%given, &
                           self%key%required .and. self%group_line > 0, &
                           self%key%given .and. size(elements) == 0)
    if (present(given)) given = self%key%given
  end subroutine begin_key

  !> Writes the echo of the key.
  subroutine end_key(self, value_words, is_set, same)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    character(len=*), intent(in) :: value_words !! the value, as it is shown
    logical, intent(in) :: is_set  !! a value that is a default is more than a placeholder
    logical, intent(in) :: same    !! the value is the one that it came with

    ! An echo that is read again gives all defaults: they ask for nothing.
    if (self%last_key_is_right() .and. same .and. .not. self%key%required .and. &
        self%key%default /= no_default) call self%book%take_for_default()
    call self%notes%add_line(self%key, value_words, is_set)
  end subroutine end_key

  !> Reads and checks one real number.
  subroutine take_real(self, item, element, value, rule)
    class(case_reader_type), intent(inout) :: self !! the case file being read
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
    class(case_reader_type), intent(inout) :: self !! the case file being read
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

  !> Complains about one value of the key; nothing where there is no problem, or one was told.
  subroutine complain_value(self, item, element, problem)
    class(case_reader_type), intent(inout) :: self !! the case file being read
    integer, intent(in) :: item               !! the value's number in the file
    integer, intent(in) :: element            !! of a list, 0 for a single value
    character(len=*), intent(in) :: problem   !! the rule that is broken
    character(len=:), allocatable :: words

    if (problem == '' .or. self%file%values(item)%wrong) return
    self%file%values(item)%wrong = .true.
    associate (entry => self%file%entries(entry_at(self%file, self%file%values(item)%first)))
      words = '&'//self%file%group_name(entry%group)//': '//self%key%name
    end associate
    if (element > 0) words = words//'('//text(element)//')'
    words = words//' = '//self%file%value_shown(item)//': '//problem
    if (self%key%unit /= '' .and. self%key%unit /= '1') words = words//' ['//self%key%unit//']'
    call self%complaints%add(self%file%values(item)%line, words)
  end subroutine complain_value
end module gfb_case_reader
