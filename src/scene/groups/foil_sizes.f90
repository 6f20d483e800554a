!> Sizes of a bump strip: each has one value for all bumps, one a bump, or one a strip of those that
!> lie side by side.
module gfb_foil_sizes
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list, no_default, positive, rule_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: size_type, of_bump, of_strip, bump_list_key, complain_of_sizes

  character(len=*), parameter :: group = 'bump_foil'

  !> A size.
  type :: size_type
    character(len=11) :: name = ''       !! of the key that has it for all bumps
    character(len=43) :: meaning = ''    !! of the size
    real(wp) :: value = 0.0_wp           !! of all bumps, or the mean; 0: not known [m]
    logical :: largest = .false.         !! of those that differ the value is the largest, no mean
    real(wp), allocatable :: by_bump(:)  !! from the smallest x on; not allocated: all have one [m]
    real(wp), allocatable :: by_strip(:) !! from the smallest z on; the same [m]
  contains
    procedure :: read_value
    procedure :: read_by_bump
    procedure :: read_by_strip
    procedure :: each
    procedure :: smallest
    procedure :: mirrors
    procedure :: bump_key
    procedure :: key_in
  end type size_type

contains

  !> Reads the value of all bumps, which need not be given where a list is.
  subroutine read_value(self, keys, needed, default)
    class(size_type), intent(inout) :: self !! the size
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    logical, intent(in) :: needed !! the size must be known
    character(len=*), intent(in), optional :: default !! in words
    character(len=:), allocatable :: words

    words = no_default
    if (present(default)) words = default
    call keys%real_key(trim(self%name), self%value, 'm', trim(self%meaning), positive, &
                       needed .and. self%key_in(keys) == self%name, default=words)
  end subroutine read_value

  !> Reads the size bump by bump.
  subroutine read_by_bump(self, keys, bumps)
    class(size_type), intent(inout) :: self !! the size
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    integer, intent(in) :: bumps !! of the strip, 0 where not known
    real(wp), allocatable :: values(:)

    call bump_list_key(keys, 'bump_'//trim(self%name), values, bumps, trim(self%meaning), &
                       positive, '`'//trim(self%name)//'` of all bumps')
    if (keys%key%given) call refuse_both(keys, 'bump_'//trim(self%name), trim(self%name))
    if (.not. allocated(values)) return
    self%value = value_of(self, values)
    self%by_bump = values
  end subroutine read_by_bump

  !> Reads the size strip by strip. Values that are the same for all are the single one.
  subroutine read_by_strip(self, keys, strips, rule, useless, default)
    class(size_type), intent(inout) :: self !! the size
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    integer, intent(in) :: strips !! side by side, 0 where not known
    type(rule_type), intent(in) :: rule !! that each value keeps
    character(len=*), intent(in) :: useless !! why it has no use; empty where it has one
    character(len=*), intent(in), optional :: default !! in words
    character(len=:), allocatable :: name, words
    real(wp), allocatable :: values(:)

    name = 'strip_'//trim(self%name)
    words = '`'//trim(self%name)//'` of all strips'
    if (present(default)) words = default
    call shared_list_key(keys, name, values, 'strip', strips, 'smallest z', trim(self%meaning), &
                         rule, words, useless)
    if (useless /= '') return
    if (keys%key%given) then
      call refuse_both(keys, name, trim(self%name))
      call refuse_both(keys, name, 'bump_'//trim(self%name))
    end if
    if (.not. allocated(values)) return
    self%value = value_of(self, values)
    if (any(abs(values - values(1)) > 0.0_wp)) self%by_strip = values
  end subroutine read_by_strip

  !> Complains where a size is given twice.
  subroutine refuse_both(keys, name, other)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, other !! keys

    call keys%rule(group, name, keys%holds(group, other), 'contradicts '//other// &
                   ': give one of them')
  end subroutine refuse_both

  !> The value that stands for a list: its mean, to the last digit where all values are one, or the
  !> largest [m].
  pure function value_of(self, list) result(value)
    class(size_type), intent(in) :: self
    real(wp), intent(in) :: list(:)
    real(wp) :: value

    value = list(1) + sum(list - list(1))/size(list)
    if (self%largest) value = maxval(list)
  end function value_of

  !> One value a bump from the smallest x on, or one that stands for all.
  subroutine bump_list_key(keys, name, list, bumps, meaning, rule, default)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: name !! of the key
    real(wp), allocatable, intent(out) :: list(:) !! not allocated where none is right [m]
    integer, intent(in) :: bumps !! of the strip, 0 where not known
    character(len=*), intent(in) :: meaning !! of the key
    type(rule_type), intent(in) :: rule !! that each value keeps
    character(len=*), intent(in) :: default !! in words
    call shared_list_key(keys, name, list, 'bump', bumps, 'leading end', meaning, rule, default, '')
  end subroutine bump_list_key

  !> One value a bump or strip, or one that stands for all.
  subroutine shared_list_key(keys, name, list, what, number, from, meaning, rule, default, useless)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name
    real(wp), allocatable, intent(out) :: list(:) !! not allocated where none is right [m]
    character(len=*), intent(in) :: what !! has a value: 'bump' or 'strip'
    integer, intent(in) :: number !! of them, 0 where not known
    character(len=*), intent(in) :: from !! where the first is
    character(len=*), intent(in) :: meaning, default, useless
    type(rule_type), intent(in) :: rule
    real(wp), allocatable :: values(:)

    call keys%real_list_key(name, values, longest_list, 'm', meaning//', one value a '//what// &
                            ' from the '//from//' on, or one for all', rule, .false., default, &
                            useless)
    if (.not. keys%last_key_is_right() .or. number < 1) return
    if (size(values) == 1) values = spread(values(1), 1, number)
    call keys%rule(group, name, size(values) /= number, 'must have one value, or one a '// &
                   what//': '//text(number)//', not '//text(size(values)))
    if (size(values) == number) list = values
  end subroutine shared_list_key

  !> The size of each bump [m].
  pure function each(self, bumps) result(values)
    class(size_type), intent(in) :: self !! the size
    integer, intent(in) :: bumps !! of the strip
    real(wp) :: values(bumps)

    values = self%value
    if (allocated(self%by_bump)) values = self%by_bump
  end function each

  !> The smallest of all bumps and strips [m].
  elemental function smallest(self) result(value)
    class(size_type), intent(in) :: self !! the size
    real(wp) :: value

    value = self%value
    if (allocated(self%by_bump)) value = minval(self%by_bump)
    if (allocated(self%by_strip)) value = minval(self%by_strip)
  end function smallest

  !> The size of one of the bumps alone.
  elemental function of_bump(size, bump) result(one)
    type(size_type), intent(in) :: size !! of all
    integer, intent(in) :: bump !! its number, from the smallest x on
    type(size_type) :: one

    one = size
    if (.not. allocated(one%by_bump)) return
    one%value = one%by_bump(bump)
    deallocate (one%by_bump)
  end function of_bump

  !> The size on one of the strips side by side alone.
  elemental function of_strip(size, strip) result(one)
    type(size_type), intent(in) :: size !! of all
    integer, intent(in) :: strip !! its number, from the smallest z on
    type(size_type) :: one

    one = size
    if (.not. allocated(one%by_strip)) return
    one%value = one%by_strip(strip)
    deallocate (one%by_strip)
  end function of_strip

  !> Whether the strips mirror each other about the midplane.
  elemental function mirrors(self) result(mirror)
    class(size_type), intent(in) :: self !! the size
    logical :: mirror

    mirror = .true.
    if (.not. allocated(self%by_strip)) return
    mirror = all(abs(self%by_strip - self%by_strip(size(self%by_strip):1:-1)) <= 0.0_wp)
  end function mirrors

  !> The key that gives the size of the bumps.
  pure function bump_key(self) result(key)
    class(size_type), intent(in) :: self !! the size
    character(len=:), allocatable :: key

    key = trim(self%name)
    if (allocated(self%by_bump)) key = 'bump_'//key
  end function bump_key

  !> The key that stands in the file for the size: of strips, of bumps, or of all.
  pure function key_in(self, keys) result(key)
    class(size_type), intent(in) :: self !! the size
    type(case_keys_type), intent(in) :: keys !! the keys of the case file
    character(len=:), allocatable :: key

    key = trim(self%name)
    if (keys%holds(group, 'bump_'//trim(self%name))) key = 'bump_'//trim(self%name)
    if (keys%holds(group, 'strip_'//trim(self%name))) key = 'strip_'//trim(self%name)
  end function key_in

  !> Complains about sizes of single bumps or strips, the first few by their numbers.
  subroutine complain_of_sizes(keys, key, wrong, value, rule, other, limit, what)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: key      !! that is wrong
    logical, intent(in) :: wrong(:)          !! at which bumps or strips
    real(wp), intent(in) :: value(:)         !! of them [m]
    character(len=*), intent(in) :: rule, other !! what holds; what it is compared with
    real(wp), intent(in) :: limit(:)         !! of them [m]
    character(len=*), intent(in) :: what     !! they are: 'bump' or 'strip'
    integer, parameter :: most = 3           !! that are named
    character(len=:), allocatable :: words
    integer :: i

    if (.not. any(wrong)) return
    words = rule
    do i = 1, size(wrong)
      if (.not. wrong(i)) cycle
      if (count(wrong(:i)) > most) exit
      words = words//merge('; ', ', ', count(wrong(:i)) == 1)//what//' '//text(i)//' has '// &
              text(value(i))//' m with '//other//' = '//text(limit(i))//' m'
    end do
    if (count(wrong) > most) words = words//', and '//text(count(wrong) - most)//' more'
    call keys%complain(group, key, words)
  end subroutine complain_of_sizes
end module gfb_foil_sizes
