!> What is written down of each key: its line of the echo, and its row of the table of keys.
module gfb_key_notes
  use gfb_kinds, only: wp
  use gfb_text, only: exact_text, join
  implicit none (type, external)
  private
  public :: key_type, key_notes_type, noted_key_type, quoted, choices, &
            chosen_word, chosen_words

  character(len=*), parameter, public :: real_words = 'real' !! a key that is one real number
  character(len=*), parameter, public :: list_words = 'list of reals'
  character(len=*), parameter, public :: no_default = 'none' !! nothing holds without the key

  integer, parameter :: values_a_line = 8 !! of a long list in the echo
  integer, parameter :: first_room = 1024 !! characters of a growing text

  !> What is known of a key.
  type :: key_type
    character(len=:), allocatable :: name, type_words
    character(len=:), allocatable :: unit           !! '1' for a pure number, empty for words
    character(len=:), allocatable :: meaning
    character(len=:), allocatable :: default        !! in words; empty: the value it came with
    logical :: required = .false.
    logical :: given = .false.                      !! it stands in the file
  end type key_type

  !> A key as it was met.
  type :: noted_key_type
    character(len=:), allocatable :: group
    type(key_type) :: key
    character(len=:), allocatable :: default !! in words
    character(len=:), allocatable :: value   !! as it is shown
    logical :: is_set = .false.    !! the value is more than a placeholder
    logical :: is_echoed = .false. !! its group is there
  end type noted_key_type

  !> A text that grows: it has more room than it fills, for copies of long texts take time.
  type :: growing_text_type
    character(len=:), allocatable :: room
    integer :: length = 0 !! filled
  contains
    procedure :: append
    procedure :: add
    procedure :: words
  end type growing_text_type

  !> The echo and the table of keys.
  type :: key_notes_type
    type(noted_key_type), allocatable :: met(:) !! all keys, in their order; `count` of them
    integer :: count = 0
    character(len=:), allocatable :: group  !! the one that is open
    type(growing_text_type), private :: echoed  !! a case file with every value used
    type(growing_text_type), private :: tabled  !! rows of a Markdown table
    logical, private :: is_echoed = .true.  !! an optional group that is absent is not
    logical :: kept = .true. !! else the file is read for its values alone
  contains
    procedure :: start_group
    procedure :: finish_group
    procedure :: add_row
    procedure :: add_line
    procedure :: numbers_shown
    procedure :: echo
    procedure :: table
  end type key_notes_type

contains

  !> Begins a group.
  pure subroutine start_group(self, name, is_echoed)
    class(key_notes_type), intent(inout) :: self !! the echo and the table of keys
    character(len=*), intent(in) :: name !! of the key
    logical, intent(in) :: is_echoed !! false for an optional group that is absent

    if (.not. allocated(self%met)) then
      call self%echoed%append('! Every key with the value used; those not given are marked '// &
                              '''(default)''.')
      allocate (self%met(64))
      call self%tabled%append('| group | key | type | unit | default | meaning |')
      call self%tabled%append('| --- | --- | --- | --- | --- | --- |')
    end if
    self%group = name
    self%is_echoed = is_echoed
    call self%echoed%append('')
    if (is_echoed) then
      call self%echoed%append('&'//name)
    else
      call self%echoed%append('! &'//name//' is not given')
    end if
  end subroutine start_group

  !> Ends a group.
  pure subroutine finish_group(self)
    class(key_notes_type), intent(inout) :: self !! the echo and the table of keys
    if (self%is_echoed) call self%echoed%append('/')
  end subroutine finish_group

  !> Numbers as a note shows them: they read back exactly. Nothing where notes are not kept.
  pure function numbers_shown(self, values) result(words)
    class(key_notes_type), intent(in) :: self !! the echo and the table of keys
    real(wp), intent(in) :: values(:) !! [their unit] of a key
    character(len=:), allocatable :: words

    words = ''
    if (self%kept) words = value_list(values)
  end function numbers_shown

  !> A case file with every value used.
  pure function echo(self) result(words)
    class(key_notes_type), intent(in) :: self !! the echo and the table of keys
    character(len=:), allocatable :: words
    words = self%echoed%words()
  end function echo

  !> All keys as a Markdown table.
  pure function table(self) result(words)
    class(key_notes_type), intent(in) :: self !! the echo and the table of keys
    character(len=:), allocatable :: words
    words = self%tabled%words()
  end function table

  !> Adds a line.
  pure subroutine append(self, line)
    class(growing_text_type), intent(inout) :: self !! the text
    character(len=*), intent(in) :: line !! without its end
    call self%add(line//new_line('a'))
  end subroutine append

  !> Adds words.
  pure subroutine add(self, words)
    class(growing_text_type), intent(inout) :: self !! the text
    character(len=*), intent(in) :: words !! as they shall stand there
    character(len=:), allocatable :: longer

    if (.not. allocated(self%room)) self%room = repeat(' ', first_room)
    associate (needed => self%length + len(words))
      if (needed > len(self%room)) then
        longer = self%room(:self%length)//repeat(' ', 2*needed - self%length)
        call move_alloc(longer, self%room)
      end if
      self%room(self%length + 1:needed) = words
    end associate
    self%length = self%length + len(words)
  end subroutine add

  !> What was added so far.
  pure function words(self)
    class(growing_text_type), intent(in) :: self !! the text
    character(len=:), allocatable :: words

    words = ''
    if (self%length > 0) words = self%room(:self%length)
  end function words

  !> Adds the row of a key.
  pure subroutine add_row(self, key, value_words)
    class(key_notes_type), intent(inout) :: self !! the echo and the table of keys
    type(key_type), intent(in) :: key !! of the group
    character(len=*), intent(in) :: value_words !! default in figures
    character(len=:), allocatable :: default

    if (.not. self%kept) return
    default = '`'//value_words//'`'
    if (key%required) default = 'required'
    if (key%default /= '') default = key%default
    call self%tabled%append('| `&'//self%group//'` | `'//key%name//'` | '//key%type_words//' | '// &
                            key%unit//' | '//default//' | '//key%meaning//' |')
    call grow(self)
    associate (one => self%met(self%count))
      one%group = self%group
      one%key = key
      one%default = default
      one%value = value_words
      one%is_echoed = self%is_echoed
    end associate
  end subroutine add_row

  !> Makes room for another key.
  pure subroutine grow(self)
    type(key_notes_type), intent(inout) :: self
    type(noted_key_type), allocatable :: longer(:)

    self%count = self%count + 1
    if (self%count <= size(self%met)) return
    allocate (longer(2*size(self%met)))
    longer(:size(self%met)) = self%met
    call move_alloc(longer, self%met)
  end subroutine grow

  !> Adds the line of a key, which `add_row` has noted.
  pure subroutine add_line(self, key, value_words, is_set)
    class(key_notes_type), intent(inout) :: self !! the echo and the table of keys
    type(key_type), intent(in) :: key !! of the group
    character(len=*), intent(in) :: value_words !! the value, as it is shown
    logical, intent(in) :: is_set !! a value with a default in words is more than a placeholder
    character(len=:), allocatable :: line

    if (.not. self%kept) return
    self%met(self%count)%value = value_words
    self%met(self%count)%is_set = is_set
    if (.not. self%is_echoed) return
    if (key%given .or. is_set .or. (key%default == '' .and. .not. key%required)) then
      line = '  '//key%name//' = '//value_words//' !'
      if (key%unit /= '') line = line//' ['//key%unit//']'
      line = line//' '//key%meaning
      if (.not. key%given) line = line//' (default)'
    else
      line = '  ! '//key%name//' is not given: '//key%meaning
      if (key%default /= '' .and. key%default /= no_default) line = line//' ('//key%default//')'
    end if
    call self%echoed%append(line)
  end subroutine add_line

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

  !> Numbers that read back exactly, separated by commas.
  pure function value_list(values) result(words)
    real(wp), intent(in) :: values(:) !! [their unit] of a key
    character(len=:), allocatable :: words
    type(growing_text_type) :: list
    integer :: i

    do i = 1, size(values)
      if (i > 1) call list%add(', ')
      if (i > 1 .and. mod(i - 1, values_a_line) == 0) call list%add(new_line('a')//'    ')
      call list%add(exact_text(values(i)))
    end do
    words = list%words()
  end function value_list

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
end module gfb_key_notes
