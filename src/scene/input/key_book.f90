!> The groups and keys there are, against the names that stand in a file.
module gfb_key_book
  use gfb_complaints, only: complaints_type, shown
  use gfb_foreign_characters, only: is_spoilt
  use gfb_key_notes, only: key_type, real_words, list_words
  use gfb_namelist_file, only: namelist_file_type, namelist_group_type
  use gfb_text, only: join, lower_case, nearest_word, text
  implicit none (type, external)
  private
  public :: key_book_type

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
    procedure :: group_line
    procedure :: look_up_real
  end type key_book_type

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
    associate (n => self%count)
      unread = any(self%key_groups(:n) == group .and. self%key_names(:n) == key .and. &
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
  pure function group_line(self, group) result(line)
    class(key_book_type), intent(in) :: self !! the known groups and keys
    character(len=*), intent(in) :: group !! of the file
    integer :: line
    integer :: i

    line = 0
    i = findloc(self%group_names == group, .true., dim=1)
    if (i > 0) line = self%groups(i)%line
  end function group_line

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
    i = findloc(is_key .and. self%key_groups == group, .true., dim=1)
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
    meant = any(self%key_groups == group .and. self%key_names == key .and. &
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

    group = file%group_name(file%entries(i)%group)
    if (.not. any(self%group_names == group)) return
    key = file%key_name(i)
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
end module gfb_key_book
