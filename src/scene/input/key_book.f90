!> The groups and keys there are, as they are met: what each is, and what the file gives it. From
!> them follow the echo, the table of keys, and what is wrong with the names in the file.
module gfb_key_book
  use gfb_kinds, only: wp
  use gfb_complaints, only: complaints_type, shown
  use gfb_key_effect, only: acts_on_nothing
  use gfb_foreign_characters, only: is_spoilt
  use gfb_moved_keys, only: home_of
  use gfb_namelist_file, only: namelist_file_type
  use gfb_text, only: did_you_mean, exact_text, join, lower_case, nearest_word, text
  implicit none (type, external)
  private
  public :: group_type, key_type, key_book_type, quoted, choices, chosen_word, chosen_words

  character(len=*), parameter, public :: real_words = 'real' !! a key that is one real number
  character(len=*), parameter, public :: list_words = 'list of reals'
  character(len=*), parameter, public :: no_default = 'none' !! nothing holds without the key

  character(len=1), parameter :: next = new_line('a')
  integer, parameter :: name_length = 40 !! no group and no key is longer
  integer, parameter :: most_keys = 500  !! of the program
  integer, parameter :: values_a_line = 8, longest_value = 32 !! in the echo, with comma and blanks

  !> A group.
  type :: group_type
    character(len=name_length) :: name = ''
    integer :: line = 0            !! of the file, 0 where it is absent
    logical :: required = .false.
    logical :: is_echoed = .true.  !! an optional group that is absent is not
    logical :: given = .false.     !! a group of the file has been found to be this one
    logical :: misspelt = .false.  !! the file has an unknown name that is nearest to this one
    character(len=:), allocatable :: misplaced !! why it has no use in this case; empty: it has
  end type group_type

  !> A key.
  type :: key_type
    character(len=name_length) :: group = '', name = ''
    character(len=:), allocatable :: type_words     !! kind of value
    character(len=:), allocatable :: unit           !! '1' for a pure number, empty for words
    character(len=:), allocatable :: meaning
    character(len=:), allocatable :: default        !! in words; empty: the value it came with
    character(len=:), allocatable :: shown_default  !! the same, or that value
    character(len=:), allocatable :: value          !! as it is shown
    real(wp), allocatable :: numbers(:)             !! the same, of real keys [unit]
    logical :: required = .false.
    logical :: given = .false.      !! it stands in the file
    logical :: unread = .false.     !! so that its values could not be distinguished
    logical :: missing = .false.    !! required, its group is there, and it is not
    logical :: misspelt = .false.   !! the file has an unknown name that is nearest to this one
    logical :: is_default = .false. !! it is given the value that holds without it
    logical :: is_set = .false.     !! the value is more than a placeholder
    logical :: is_echoed = .false.  !! its group is
    integer :: acts_on = acts_on_nothing         !! `acts_on_film`, ...
    character(len=:), allocatable :: why_useless !! in words, where it has no use in this case
    character(len=:), allocatable :: why_refused !! in words, where it must not be given here
    character(len=:), allocatable :: idle        !! why no answer follows it here; empty: one does
  end type key_type

  !> All groups and keys.
  type :: key_book_type
    type(group_type), allocatable :: groups(:)
    type(key_type), allocatable :: keys(:) !! in their order; `count` of them, and room for more
    integer :: count = 0
    logical :: kept = .true. !! what is shown; else the file is read for its values alone
  contains
    procedure, non_overridable :: add_group, add_key, place_of, group_line
    procedure, non_overridable :: look_up_real, check_names, numbers_shown
    procedure, non_overridable :: echo, table, why_no_use
  end type key_book_type

contains

  !> Adds a group.
  pure subroutine add_group(self, group)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    type(group_type), intent(in) :: group !! the next one

    if (.not. allocated(self%groups)) allocate (self%groups(0), self%keys(most_keys))
    self%groups = [self%groups, group]
  end subroutine add_group

  !> Adds a key of the last group.
  subroutine add_key(self, key)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    type(key_type), intent(in) :: key !! the next one

    if (self%count == most_keys) error stop 'gfb: more keys than gfb_key_book has room for'
    self%count = self%count + 1
    self%keys(self%count) = key
    self%keys(self%count)%is_echoed = self%groups(size(self%groups))%is_echoed
  end subroutine add_key

  !> Number of a key, be it named by the group that had it before; 0 where there is none.
  pure integer function place_of(self, group, key) result(place)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group, key !! names in the case file
    place = findloc(self%keys%name == key .and. self%keys%group == home_of(group, key), .true., 1)
  end function place_of

  !> Line of a group in the file, 0 where it is absent.
  pure integer function group_line(self, group) result(line)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group !! of the file
    integer :: i

    line = 0
    i = findloc(self%groups%name == group, .true., dim=1)
    if (i > 0) line = self%groups(i)%line
  end function group_line

  !> Looks up a key whose value is to be one real number, or a value of a list.
  pure subroutine look_up_real(self, group, key, in_list, unit, problem)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group, key !! names as they were typed, in lower case
    logical, intent(in) :: in_list !! a value of a list is meant
    character(len=:), allocatable, intent(out) :: unit !! of the key; empty where there is a problem
    character(len=:), allocatable, intent(out) :: problem !! in words; empty where there is none
    character(len=2*name_length) :: known(self%count)
    character(len=:), allocatable :: near
    logical, dimension(self%count) :: is_real, is_list, is_key
    integer :: i

    unit = ''
    problem = ''
    do i = 1, self%count
      known(i) = trim(self%keys(i)%group)//'%'//trim(self%keys(i)%name)
      is_real(i) = self%keys(i)%type_words == real_words
      is_list(i) = self%keys(i)%type_words == list_words
    end do
    i = self%place_of(group, key)
    if (i == 0) then
      near = nearest_word(group//'%'//key, pack(known, is_real .or. is_list))
      is_key = self%keys(:self%count)%name == key .and. is_real
      if (any(is_key)) near = join(pack(known, is_key), ''' or ''')
      problem = 'there is no key '//shown(group//'%'//key)//did_you_mean(near, '''')
    else if (allocated(self%keys(i)%why_useless)) then
      problem = group//'%'//key//' '//self%keys(i)%why_useless
    else if (is_list(i) .and. .not. in_list) then
      problem = group//'%'//key//' is a list: name one of its values, such as '//key//'(2)'
    else if (is_real(i) .and. in_list) then
      problem = group//'%'//key//' is a single value and takes no index'
    else if (.not. (is_real(i) .or. is_list(i))) then
      problem = group//'%'//key//' is not one real number'
    else
      unit = self%keys(i)%unit
    end if
  end subroutine look_up_real

  !> Complains about unknown groups and keys, and about missing ones that no misspelling explains.
  subroutine check_names(self, file, complaints)
    class(key_book_type), intent(inout) :: self !! the known groups and keys
    type(namelist_file_type), intent(in) :: file !! the case file, scanned
    type(complaints_type), intent(inout) :: complaints !! the mistakes found so far
    integer :: i

    do i = 1, size(file%groups)
      call check_group(self, file, i, complaints)
    end do
    do i = 1, size(file%strays)
      associate (stray => file%strays(i))
        call excuse_group(self, lower_case(file%words(stray%first:stray%last)))
      end associate
    end do
    do i = 1, size(file%entries)
      call check_key(self, file, i, complaints)
    end do
    do i = 1, size(self%groups)
      associate (group => self%groups(i))
        if (.not. group%required .or. group%line > 0 .or. group%misspelt) cycle
        call complaints%add(0, 'the group &'//trim(group%name)//' is missing')
      end associate
    end do
    do i = 1, self%count
      associate (key => self%keys(i))
        if (.not. key%missing .or. key%misspelt) cycle
        call complaints%add(self%group_line(key%group), '&'//trim(key%group)// &
                            ": the required key '"//trim(key%name)//"' is missing ("// &
                            key%meaning//')')
      end associate
    end do
  end subroutine check_names

  !> Complains about a group that does not exist or stands in the file before.
  subroutine check_group(self, file, i, complaints)
    class(key_book_type), intent(inout) :: self
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: i !! its number in the file
    type(complaints_type), intent(inout) :: complaints
    character(len=:), allocatable :: name, near
    integer :: line, known

    name = file%group_name(i)
    if (name == '') return
    line = file%groups(i)%line
    known = findloc(self%groups%name == name, .true., dim=1)
    if (known > 0) then
      if (self%groups(known)%given) then
        call complaints%add(line, '&'//name//': the group is given twice, first in line '// &
                            text(self%groups(known)%line))
      end if
      self%groups(known)%given = .true.
      return
    end if
    near = nearest_word(name, self%groups%name)
    if (is_spoilt(name)) then
      call excuse_group(self, near) ! its characters outside ASCII have been complained about
    else if (near /= '') then
      call complaints%add(line, "unknown group '&"//shown(name)//"'"//did_you_mean('&'//near, "'"))
      call excuse_group(self, near)
    else
      call complaints%add(line, "unknown group '&"//shown(name)//"'; the groups are &"// &
                          join(self%groups%name, ', &'))
    end if
  end subroutine check_group

  !> Complains about a key that does not exist.
  subroutine check_key(self, file, i, complaints)
    class(key_book_type), intent(inout) :: self
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: i !! number of its entry in the file
    type(complaints_type), intent(inout) :: complaints
    character(len=:), allocatable :: group, key, near, words
    logical :: in_group(self%count)
    integer :: j

    key = file%key_name(i)
    group = home_of(file%group_name(file%entries(i)%group), key)
    if (all(self%groups%name /= group)) return
    associate (keys => self%keys(:self%count))
      in_group = keys%group == group
      if (any(in_group .and. keys%name == key)) return
      near = nearest_word(key, pack(keys%name, in_group))
      words = '&'//group//": unknown key '"//shown(key)//"'"
      if (is_spoilt(key)) then ! its characters outside ASCII have been complained about
        where (in_group .and. keys%name == near) keys%misspelt = .true.
        return
      else if (any(keys%name == key)) then
        j = findloc(keys%name == key .and. keys%missing, .true., dim=1)
        if (j == 0) j = findloc(keys%name == key, .true., dim=1)
        words = words//'; it belongs into &'//trim(keys(j)%group)
        keys(j)%misspelt = .true.
      else if (near /= '') then
        words = words//did_you_mean(near, "'")
        where (in_group .and. keys%name == near) keys%misspelt = .true.
      else
        words = words//'; the keys of &'//group//' are '//join(pack(keys%name, in_group), ', ')
      end if
    end associate
    call complaints%add(file%entries(i)%line, words)
  end subroutine check_key

  !> Notes that the file means to have a group.
  subroutine excuse_group(self, name)
    class(key_book_type), intent(inout) :: self
    character(len=*), intent(in) :: name
    where (self%groups%name == name) self%groups%misspelt = .true.
  end subroutine excuse_group

  !> A case file with every value used.
  pure function echo(self) result(words)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=:), allocatable :: words
    integer :: i, k

    words = '! Every key with the value used; those not given are marked ''(default)''.'//next
    do i = 1, size(self%groups)
      associate (group => self%groups(i))
        if (.not. group%is_echoed) then
          words = words//next//'! &'//trim(group%name)//' is not given'//next
          cycle
        end if
        words = words//next//'&'//trim(group%name)//next
        do k = 1, self%count
          if (self%keys(k)%group == group%name) words = words//key_line(self%keys(k))//next
        end do
        words = words//'/'//next
      end associate
    end do
  end function echo

  !> A key's line of the echo.
  pure function key_line(key) result(line)
    type(key_type), intent(in) :: key
    character(len=:), allocatable :: line

    if (key%given .or. key%is_set .or. (key%default == '' .and. .not. key%required)) then
      line = '  '//trim(key%name)//' = '//key%value//' !'
      if (key%unit /= '') line = line//' ['//key%unit//']'
      line = line//' '//key%meaning
      if (.not. key%given) line = line//' (default)'
    else
      line = '  ! '//trim(key%name)//' is not given: '//key%meaning
      if (key%default /= '' .and. key%default /= no_default) line = line//' ('//key%default//')'
    end if
  end function key_line

  !> All keys as a Markdown table.
  pure function table(self, of_case) result(words)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    logical, intent(in) :: of_case !! with a column that says why a key has no use in the case read
    character(len=:), allocatable :: words
    integer :: i

    words = '| group | key | type | unit | default | meaning |'
    if (of_case) words = words//' no use here |'
    words = words//next//'| --- | --- | --- | --- | --- | --- |'
    if (of_case) words = words//' --- |'
    words = words//next
    do i = 1, self%count
      associate (key => self%keys(i))
        words = words//'| `&'//trim(key%group)//'` | `'//trim(key%name)//'` | '//key%type_words// &
                ' | '//key%unit//' | '//key%shown_default//' | '//key%meaning//' |'
        if (of_case) words = words//' '//self%why_no_use(key)//' |'
        words = words//next
      end associate
    end do
  end function table

  !> Why a key must not be given in the case read; empty where it may.
  pure function why_no_use(self, key) result(why)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    type(key_type), intent(in) :: key !! one of them
    character(len=:), allocatable :: why
    integer :: i

    why = ''
    i = findloc(self%groups%name == key%group, .true., dim=1)
    if (allocated(self%groups(i)%misplaced)) why = self%groups(i)%misplaced
    if (why /= '') return
    if (allocated(key%why_useless)) then
      why = key%why_useless
    else if (allocated(key%why_refused)) then
      why = key%why_refused
    end if
  end function why_no_use

  !> Numbers that read back exactly, separated by commas. Nothing where what is shown is not kept.
  pure function numbers_shown(self, values) result(words)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    real(wp), intent(in) :: values(:) !! [their unit] of a key
    character(len=:), allocatable :: words
    character(len=:), allocatable :: room, one
    integer :: i, n

    allocate (character(len=longest_value*size(values)) :: room)
    n = 0
    if (self%kept) then
      do i = 1, size(values)
        one = exact_text(values(i))
        if (i > 1 .and. mod(i - 1, values_a_line) == 0) one = next//'    '//one
        if (i > 1) one = ', '//one
        room(n + 1:n + len(one)) = one
        n = n + len(one)
      end do
    end if
    words = room(:n)
  end function numbers_shown

  !> Words as a namelist string.
  pure function quoted(words)
    character(len=*), intent(in) :: words !! to stand in quotes
    character(len=:), allocatable :: quoted
    integer :: i

    quoted = ''''
    do i = 1, len(words)
      quoted = quoted//words(i:i)
      if (words(i:i) == '''') quoted = quoted//''''
    end do
    quoted = quoted//''''
  end function quoted

  !> Words to choose from.
  pure function choices(words) result(list)
    character(len=*), intent(in) :: words(:) !! blank-padded
    character(len=:), allocatable :: list
    list = ''''//join(words, ''', ''')//''''
  end function choices

  !> A word of a list as a namelist string; empty where none is chosen.
  pure function chosen_word(words, choice) result(word)
    character(len=*), intent(in) :: words(:) !! blank-padded
    integer, intent(in) :: choice            !! its number, 0 for none
    character(len=:), allocatable :: word

    word = ''
    if (choice > 0) word = ''''//trim(words(choice))//''''
  end function chosen_word

  !> The chosen words of a list as namelist strings.
  pure function chosen_words(words, chosen) result(list)
    character(len=*), intent(in) :: words(:) !! blank-padded
    logical, intent(in) :: chosen(:)         !! one a word
    character(len=:), allocatable :: list
    list = choices(pack(words, chosen))
  end function chosen_words
end module gfb_key_book
