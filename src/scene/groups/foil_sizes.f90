!> Keys of `&bump_foil` that have one value a bump, one a strip side by side, or one for all.
module gfb_foil_sizes
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_text, only: text
  use gfb_value_rules, only: rule_type, positive, not_negative
  implicit none (type, external)
  private
  public :: bump_list_key, complain_of_bumps, read_strip_sizes, refuse_strip_sizes, gives_strips, &
            sizes_differ, sizes_mirror

  character(len=*), parameter :: group = 'bump_foil'
  character(len=*), parameter :: names(*) = [character(len=11) :: 'pitch', 'half_length', &
                                             'height', 'thickness', 'offset']
  character(len=*), parameter :: meanings(*) = [character(len=46) :: &
                                                'from bump to bump, arc plus flat', &
                                                'half the chord of a bump''s arc', &
                                                'height of a bump', 'thickness of the foil', &
                                                'of the fixed edge, from the edge of the pad']

  !> Sizes that differ from strip to strip, from the smallest z on; not allocated: all have one.
  type, public :: strip_sizes_type
    real(wp), allocatable :: pitch(:)       !! arc plus flat [m]
    real(wp), allocatable :: half_length(:) !! half the chord of a bump's arc [m]
    real(wp), allocatable :: height(:)      !! of a bump [m]
    real(wp), allocatable :: thickness(:)   !! of the foil [m]
    real(wp), allocatable :: offset(:)      !! of the fixed edge from the pad's [m]
  end type strip_sizes_type

contains

  !> One value a bump from the smallest x on, or one that stands for all.
  subroutine bump_list_key(keys, name, list, bumps, unit, meaning, rule, default)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: name !! of the key
    !> [its unit] one a bump; not allocated where none is right
    real(wp), allocatable, intent(out) :: list(:)
    integer, intent(in) :: bumps !! of the strip, 0 where not known
    character(len=*), intent(in) :: unit, meaning !! of the value; what the key means
    type(rule_type), intent(in) :: rule !! that each value keeps
    character(len=*), intent(in) :: default !! in words
    real(wp), allocatable :: values(:)

    call keys%real_list_key(name, values, longest_list, unit, meaning//', one value a bump '// &
                            'from the leading end on, or one for all', rule, .false., default)
    if (.not. keys%last_key_is_right() .or. bumps < 1) return
    if (size(values) /= 1 .and. size(values) /= bumps) then
      call keys%complain('bump_foil', name, 'must have one value, or one a bump: '// &
                         text(bumps)//', not '//text(size(values)))
      return
    end if
    list = values
    if (size(values) == 1) list = spread(values(1), 1, bumps)
  end subroutine bump_list_key

  !> Complains about sizes of single bumps, the first few by their numbers.
  subroutine complain_of_bumps(keys, key, wrong, value, rule, other, limit, what)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: key      !! that is wrong
    logical, intent(in) :: wrong(:)          !! at which bumps
    real(wp), intent(in) :: value(:)         !! of the bumps [m]
    character(len=*), intent(in) :: rule, other !! what holds; what it is compared with
    real(wp), intent(in) :: limit(:)         !! of the bumps [m]
    character(len=*), intent(in), optional :: what !! they are; default: bump
    integer, parameter :: most = 3           !! bumps that are named
    character(len=:), allocatable :: words, one
    integer :: bump

    if (.not. any(wrong)) return
    one = 'bump '
    if (present(what)) one = what//' '
    words = rule
    do bump = 1, size(wrong)
      if (.not. wrong(bump)) cycle
      if (count(wrong(:bump)) > most) exit
      words = words//merge('; ', ', ', count(wrong(:bump)) == 1)//one//text(bump)//' has '// &
              text(value(bump))//' m with '//other//' = '//text(limit(bump))//' m'
    end do
    if (count(wrong) > most) words = words//', and '//text(count(wrong) - most)//' more'
    call keys%complain('bump_foil', key, words)
  end subroutine complain_of_bumps

  !> Reads the sizes strip by strip. A size that differs is a list, and the single one the mean of
  !> it, that of the heights the largest one; one that is the same for all is the single one.
  subroutine read_strip_sizes(keys, strips, pitch, half_length, height, thickness, offset, sizes)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    integer, intent(in) :: strips !! side by side, 0 where not known
    real(wp), intent(inout) :: pitch, half_length, height, thickness !! of all strips [m]
    real(wp), intent(inout) :: offset !! of all strips [m]
    type(strip_sizes_type), intent(out) :: sizes !! that differ

    call read_list(1, positive, pitch, sizes%pitch)
    call read_list(2, positive, half_length, sizes%half_length)
    call read_list(3, positive, height, sizes%height)
    if (allocated(sizes%height)) height = maxval(sizes%height)
    call read_list(4, positive, thickness, sizes%thickness)
    call read_list(5, not_negative, offset, sizes%offset)

  contains

    !> One list, which stands for the single size.
    subroutine read_list(i, rule, single, list)
      integer, intent(in) :: i !! number of the name
      type(rule_type), intent(in) :: rule
      real(wp), intent(inout) :: single !! [m]
      real(wp), allocatable, intent(out) :: list(:) !! [m]
      character(len=*), parameter :: each = ', one value a strip from the smallest z on, or '// &
                                     'one for all'
      character(len=:), allocatable :: default, name
      real(wp), allocatable :: values(:)

      name = 'strip_'//trim(names(i))
      default = '`'//trim(names(i))//'` of all strips'
      if (names(i) == 'offset') default = '0: strips begin at the edge of the pad'
      call keys%real_list_key(name, values, longest_list, 'm', trim(meanings(i))//each, rule, &
                              .false., default)
      if (.not. keys%key%given) return
      call refuse_both(keys, name, trim(names(i)))
      call refuse_both(keys, name, 'bump_'//trim(names(i)))
      if (.not. keys%last_key_is_right() .or. strips < 1) return
      if (size(values) /= 1 .and. size(values) /= strips) then
        call keys%complain(group, name, 'must have one value, or one a strip: '//text(strips)// &
                           ', not '//text(size(values)))
        return
      end if
      single = values(1) + sum(values - values(1))/size(values)
      if (any(abs(values - values(1)) > 0.0_wp)) list = values
    end subroutine read_list
  end subroutine read_strip_sizes

  !> Complains where a size is given twice.
  subroutine refuse_both(keys, name, other)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, other !! keys

    call keys%rule(group, name, keys%holds(group, other), 'contradicts '//other// &
                   ': give one of them')
  end subroutine refuse_both

  !> Reads the same keys where there is one strip: they have no use.
  subroutine refuse_strip_sizes(keys, why)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: why !! they must not be given
    integer :: i

    do i = 1, size(names)
      call keys%useless_key('strip_'//trim(names(i)), trim(meanings(i))//', strip by strip', why)
    end do
  end subroutine refuse_strip_sizes

  !> Whether a size is given strip by strip.
  function gives_strips(keys, name) result(gives)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file
    character(len=*), intent(in) :: name !! of the single size
    logical :: gives
    gives = keys%holds(group, 'strip_'//name)
  end function gives_strips

  !> Whether strips have different bumps, or begin at different places.
  elemental function sizes_differ(sizes) result(differ)
    type(strip_sizes_type), intent(in) :: sizes !! of the strips
    logical :: differ

    differ = allocated(sizes%pitch) .or. allocated(sizes%half_length) .or. &
             allocated(sizes%height) .or. allocated(sizes%thickness) .or. allocated(sizes%offset)
  end function sizes_differ

  !> Whether the strips mirror each other about the midplane.
  elemental function sizes_mirror(sizes) result(mirror)
    type(strip_sizes_type), intent(in) :: sizes !! of the strips
    logical :: mirror

    mirror = is_mirrored(sizes%pitch) .and. is_mirrored(sizes%half_length) .and. &
             is_mirrored(sizes%height) .and. is_mirrored(sizes%thickness) .and. &
             is_mirrored(sizes%offset)
  end function sizes_mirror

  !> Whether a list reads the same from both ends; true where there is none.
  pure function is_mirrored(list) result(mirrored)
    real(wp), intent(in), optional :: list(:) !! absent where it is not allocated [m]
    logical :: mirrored

    mirrored = .true.
    if (present(list)) mirrored = all(abs(list - list(size(list):1:-1)) <= 0.0_wp)
  end function is_mirrored
end module gfb_foil_sizes
