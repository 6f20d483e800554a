!> Reads the keys of the groups: one call a key reads it, checks it, complains, and notes what the
!> echo and the table of keys show of it.
!>
!> A key that is not given keeps the value it came with. `default` says in words what holds then,
!> where that value is not fixed; the value is then echoed unless it is zero, which means unset.
module gfb_case_keys
  use gfb_kinds, only: wp
  use gfb_case_reader, only: case_reader_type
  use gfb_key_book, only: real_words, list_words, no_default, quoted, choices, chosen_word, &
                          chosen_words
  use gfb_namelist_file, only: longest_list
  use gfb_namelist_values, only: read_integer, read_logical, value_string
  use gfb_text, only: lower_case, text
  use gfb_value_rules, only: rule_type, any_value, positive, not_negative, at_least, from_to, &
                             from_below, between, broken_rule
  implicit none (type, external)
  private
  public :: case_keys_type, longest_list, no_default, unless
  public :: rule_type, any_value, positive, not_negative, at_least, from_to, from_below, between

  integer, parameter :: single = 0            !! values of a key that takes no list
  integer, parameter, public :: longest_string = 500  !! characters
  integer, parameter :: most_words = 100      !! in a list of words

  !> The keys of a case file, kind by kind.
  type, extends(case_reader_type) :: case_keys_type
  contains
    procedure, non_overridable :: real_key, real_vector_key, real_list_key, follow
    procedure, non_overridable :: integer_key, logical_key, string_key
    procedure, non_overridable :: choice_key, choice_or_keys_key, words_key, word_list_key
    procedure, non_overridable :: names_key, strings_key
    procedure, non_overridable, private :: take_numbers, has_no_use
  end type case_keys_type

contains

  !> Why something has no use; empty where it has one.
  pure function unless(has_use, why) result(words)
    logical, intent(in) :: has_use !! a key, or a group
    character(len=*), intent(in) :: why !! it has none else
    character(len=:), allocatable :: words

    words = ''
    if (.not. has_use) words = why
  end function unless

  !> Reads a key that has no use, where a reason says so: its echo must not show a value.
  logical function has_no_use(self, name, why) result(useless)
    class(case_keys_type), intent(inout) :: self
    character(len=*), intent(in) :: name !! of the key, which was described
    character(len=*), intent(in), optional :: why !! it must not be given; empty where it may
    integer, allocatable :: elements(:)

    useless = .false.
    if (present(why)) useless = why /= ''
    if (.not. useless) return
    self%key%why_useless = why
    call self%begin_key('', longest_list, elements, default=no_default)
    call self%end_key('', .false., .false.)
    if (self%key%given) call self%complain(trim(self%key%group), name, why)
  end function has_no_use

  !> One real number.
  subroutine real_key(self, name, value, unit, meaning, rule, required, default, given, useless, &
                      acts_on)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    real(wp), intent(inout) :: value !! [its unit] the default on entry
    character(len=*), intent(in) :: unit, meaning !! of the value; what the key means
    type(rule_type), intent(in), optional :: rule !! that the value keeps
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    logical, intent(out), optional :: given !! the file has it
    character(len=*), intent(in), optional :: useless !! why it has no use; empty where it has one
    integer, intent(in), optional :: acts_on !! `acts_on_film`, ...; default: as its group
    real(wp) :: values(1)

    if (present(given)) given = .false.
    call self%describe(name, real_words, unit, meaning, acts_on)
    if (self%has_no_use(name, useless)) return
    values = value
    call self%take_numbers(single, values, rule, required, default, given)
    value = values(1)
  end subroutine real_key

  !> A real key that has been read and is not given gets what another group says, read since.
  subroutine follow(self, group, name, value)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: group, name !! of the key
    real(wp), intent(in) :: value !! [its unit]

    associate (key => self%book%keys(self%book%place_of(group, name)))
      if (key%given) return
      key%value = self%book%numbers_shown([value])
      key%numbers = [value]
    end associate
  end subroutine follow

  !> A fixed number of real numbers; all of them must be given.
  subroutine real_vector_key(self, name, values, unit, meaning, rule, required, default, given, &
                             useless)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    real(wp), intent(inout) :: values(:) !! [their unit] the defaults on entry
    character(len=*), intent(in) :: unit, meaning !! of the value; what the key means
    type(rule_type), intent(in), optional :: rule !! that the value keeps
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    logical, intent(out), optional :: given !! the file has it
    character(len=*), intent(in), optional :: useless !! why it has no use; empty where it has one

    if (present(given)) given = .false.
    call self%describe(name, 'real('//text(size(values))//')', unit, meaning)
    if (self%has_no_use(name, useless)) return
    call self%take_numbers(size(values), values, rule, required, default, given)
  end subroutine real_vector_key

  !> Reads as many real numbers as there are.
  subroutine take_numbers(self, most, values, rule, required, default, given)
    class(case_keys_type), intent(inout) :: self
    integer, intent(in) :: most !! size of the values, or `single`
    real(wp), intent(inout) :: values(:) !! [their unit]
    type(rule_type), intent(in), optional :: rule
    logical, intent(in), optional :: required
    character(len=*), intent(in), optional :: default
    logical, intent(out), optional :: given
    integer, allocatable :: elements(:)
    real(wp) :: before(size(values))
    integer :: i

    before = values
    call self%begin_key(self%book%numbers_shown(values), most, elements, required, default, given)
    if (size(elements) > 0 .and. size(elements) < size(values)) then
      call self%complain(trim(self%key%group), trim(self%key%name), 'needs '// &
                         text(size(values))//' values, not '//text(size(elements)))
    else if (size(elements) == size(values)) then
      do i = 1, size(values)
        call self%take_real(elements(i), merge(0, i, most == single), values(i), rule)
      end do
    end if
    call self%end_numbers(values, .not. any(abs(values - before) > 0.0_wp))
  end subroutine take_numbers

  !> A list of real numbers that must be given, unless said otherwise; empty where it is not.
  subroutine real_list_key(self, name, values, most, unit, meaning, rule, required, default, &
                           useless, acts_on)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    real(wp), allocatable, intent(out) :: values(:) !! [their unit] as many as the file gives
    integer, intent(in) :: most                 !! values at most
    character(len=*), intent(in) :: unit, meaning !! of the value; what the key means
    type(rule_type), intent(in), optional :: rule !! that the value keeps
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    character(len=*), intent(in), optional :: useless !! why it has no use; empty where it has one
    integer, intent(in), optional :: acts_on !! `acts_on_film`, ...; default: as its group
    integer, allocatable :: elements(:)
    integer :: i
    logical :: must

    allocate (values(0))
    call self%describe(name, list_words, unit, meaning, acts_on)
    if (self%has_no_use(name, useless)) return
    must = .true.
    if (present(required)) must = required
    call self%begin_key('', most, elements, required=must, default=default)
    values = spread(0.0_wp, 1, size(elements))
    do i = 1, size(values)
      call self%take_real(elements(i), i, values(i), rule)
    end do
    call self%end_numbers(values, .false.)
  end subroutine real_list_key

  !> One whole number.
  subroutine integer_key(self, name, value, meaning, rule, required, default, given, useless)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    integer, intent(inout) :: value             !! the default on entry
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    type(rule_type), intent(in) :: rule !! that the value keeps
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    logical, intent(out), optional :: given !! the file has it
    character(len=*), intent(in), optional :: useless !! why it has no use; empty where it has one
    integer, allocatable :: elements(:)
    character(len=:), allocatable :: problem
    integer :: number, before

    if (present(given)) given = .false.
    call self%describe(name, 'integer', '1', meaning)
    if (self%has_no_use(name, useless)) return
    before = value
    call self%begin_key(text(value), single, elements, required, default, given)
    if (size(elements) == 1) then
      call read_integer(self%file%value_text(elements(1)), number, problem)
      if (self%file%values(elements(1))%kind == value_string) then
        problem = 'must be a whole number, without quotes'
      end if
      if (problem == '') problem = broken_rule(rule, real(number, wp))
      if (problem == '') value = number
      call self%complain_value(elements(1), 0, problem)
    end if
    call self%end_key(text(value), value /= 0, value == before)
  end subroutine integer_key

  !> Yes or no.
  subroutine logical_key(self, name, value, meaning, default)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    logical, intent(inout) :: value             !! the default on entry
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    character(len=*), intent(in), optional :: default !! shown where the default is no plain number
    integer, allocatable :: elements(:)
    character(len=:), allocatable :: problem
    logical :: truth, before

    before = value
    call self%describe(name, 'logical', '', meaning)
    call self%begin_key(text(value), single, elements, default=default)
    if (size(elements) == 1) then
      call read_logical(self%file%value_text(elements(1)), truth, problem)
      if (self%file%values(elements(1))%kind == value_string) then
        problem = 'must be .true. or .false., without quotes'
      end if
      if (problem == '') value = truth
      call self%complain_value(elements(1), 0, problem)
    end if
    call self%end_key(text(value), .true., value .eqv. before)
  end subroutine logical_key

  !> Free text.
  subroutine string_key(self, name, value, meaning)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    character(len=:), allocatable, intent(inout) :: value !! the default on entry
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    integer, allocatable :: elements(:)
    character(len=:), allocatable :: problem, words, before

    before = value
    call self%describe(name, 'string', '', meaning)
    call self%begin_key(quoted(value), single, elements)
    if (size(elements) == 1) then
      problem = ''
      words = self%file%value_text(elements(1))
      if (self%file%values(elements(1))%kind /= value_string) then
        problem = 'must be in quotes'
      else if (len(words) > longest_string) then
        problem = 'must not be longer than '//text(longest_string)//' characters'
      else
        value = words
      end if
      call self%complain_value(elements(1), 0, problem)
    end if
    call self%end_key(quoted(value), .true., value == before)
  end subroutine string_key

  !> One of several words, as its number in their list.
  subroutine choice_key(self, name, value, words, meaning, required, useless)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    integer, intent(inout) :: value             !! the default on entry; 0 where none was read
    character(len=*), intent(in) :: words(:)    !! blank-padded
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    logical, intent(in), optional :: required !! a case without it is wrong
    character(len=*), intent(in), optional :: useless !! why it has no use; empty where it has one
    integer, allocatable :: elements(:)
    integer :: before

    call self%describe(name, '`'//choices(words)//'`', '', meaning)
    if (self%has_no_use(name, useless)) return
    before = value
    call self%begin_key(chosen_word(words, value), single, elements, required)
    if (self%key%given) value = 0
    if (size(elements) == 1) call self%take_choice(elements(1), 0, words, value)
    call self%end_key(chosen_word(words, value), value > 0, value == before)
  end subroutine choice_key

  !> One of several words, or the names of keys of the case file.
  subroutine choice_or_keys_key(self, name, value, words, keys, meaning)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    integer, intent(out) :: value !! number of the word; one more than there are: keys; 0: none
    character(len=*), intent(in) :: words(:)    !! blank-padded
    character(len=:), allocatable, intent(out) :: keys !! as typed, in lower case
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    character(len=*), parameter :: others = 'keys such as ''bearing%clearance'''
    character(len=:), allocatable :: chosen
    integer, allocatable :: elements(:)

    call self%describe(name, '`'//choices(words)//'`, or real keys `''group%key, ...''` '// &
                       'that take one value', '', meaning)
    value = 0
    keys = ''
    call self%begin_key('', single, elements, .true.)
    if (size(elements) == 1) then
      associate (item => elements(1))
        if (self%file%values(item)%kind == value_string) then
          keys = lower_case(trim(self%file%value_text(item)))
        end if
        if (index(keys, '%') > 0) then
          value = size(words) + 1
        else
          keys = ''
          call self%take_choice(item, 0, words, value, others)
        end if
      end associate
    end if
    chosen = quoted(keys)
    if (keys == '') chosen = chosen_word(words, value)
    call self%end_key(chosen, value > 0, .false.)
  end subroutine choice_or_keys_key

  !> Several of several words.
  subroutine words_key(self, name, chosen, words, meaning)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    logical, intent(inout) :: chosen(:)         !! one a word; the default on entry
    character(len=*), intent(in) :: words(:)    !! blank-padded
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    integer, allocatable :: elements(:)
    logical :: before(size(chosen))
    integer :: i, choice

    before = chosen
    call self%describe(name, 'list of `'//choices(words)//'`', '', meaning)
    call self%begin_key(chosen_words(words, chosen), most_words, elements)
    if (size(elements) > 0) chosen = .false.
    do i = 1, size(elements)
      choice = 0
      call self%take_choice(elements(i), i, words, choice)
      if (choice > 0) chosen(choice) = .true.
    end do
    call self%end_key(chosen_words(words, chosen), any(chosen), all(chosen .eqv. before))
  end subroutine words_key

  !> A list of words, each as its number in a list of them; none where one is wrong.
  subroutine word_list_key(self, name, values, words, most, meaning, required)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    integer, allocatable, intent(out) :: values(:) !! numbers of the words, as many as given
    character(len=*), intent(in) :: words(:) !! blank-padded
    integer, intent(in) :: most !! values at most
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    logical, intent(in) :: required !! where its group is there
    character(len=:), allocatable :: shown
    integer, allocatable :: elements(:)
    integer :: i

    call self%describe(name, 'list of `'//choices(words)//'`', '', meaning)
    call self%begin_key('', most, elements, required)
    allocate (values(size(elements)), source=0)
    shown = ''
    do i = 1, size(elements)
      call self%take_choice(elements(i), i, words, values(i))
      if (i > 1) shown = shown//', '
      shown = shown//chosen_word(words, values(i))
    end do
    if (any(values == 0)) values = [integer ::]
    call self%end_key(shown, size(values) > 0, .false.)
  end subroutine word_list_key

  !> Names of real keys of the case file, which may stand in one string or in several.
  subroutine names_key(self, name, names, strings, meaning, required, default)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    character(len=:), allocatable, intent(out) :: names !! in lower case, with commas between them
    integer, intent(out) :: strings !! in which they stand
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    logical, intent(in) :: required !! where its group is there
    character(len=*), intent(in), optional :: default !! in words
    character(len=:), allocatable :: problem
    integer, allocatable :: elements(:)
    integer :: i

    call self%describe(name, 'list of real keys `''group%key''`', '', meaning)
    call self%begin_key('', most_words, elements, required, default)
    names = ''
    strings = size(elements)
    do i = 1, strings
      problem = ''
      if (self%file%values(elements(i))%kind /= value_string) problem = 'must be in quotes'
      call self%complain_value(elements(i), i, problem)
      if (i > 1) names = names//', '
      names = names//lower_case(trim(self%file%value_text(elements(i))))
    end do
    call self%end_key(quoted(names), names /= '', .false.)
  end subroutine names_key

  !> A list of free texts, such as names of files.
  subroutine strings_key(self, name, values, most, meaning, required)
    class(case_keys_type), intent(inout) :: self !! the keys being read
    character(len=*), intent(in) :: name !! of the key
    character(len=longest_string), allocatable, intent(out) :: values(:) !! as many as given
    integer, intent(in) :: most !! values at most
    character(len=*), intent(in) :: meaning !! of the key, a sentence
    logical, intent(in) :: required !! where its group is there
    character(len=:), allocatable :: problem, shown, words
    integer, allocatable :: elements(:)
    integer :: i

    call self%describe(name, 'list of strings', '', meaning)
    call self%begin_key('', most, elements, required)
    allocate (values(size(elements)))
    shown = ''
    do i = 1, size(elements)
      problem = ''
      values(i) = ''
      words = self%file%value_text(elements(i))
      if (self%file%values(elements(i))%kind /= value_string) then
        problem = 'must be in quotes'
      else if (len(words) > len(values)) then
        problem = 'must not be longer than '//text(len(values))//' characters'
      else if (words == '') then
        problem = 'must not be empty'
      else
        values(i) = words
      end if
      call self%complain_value(elements(i), i, problem)
      if (i > 1) shown = shown//', '
      shown = shown//quoted(trim(values(i)))
    end do
    call self%end_key(shown, size(values) > 0, .false.)
  end subroutine strings_key
end module gfb_case_keys
