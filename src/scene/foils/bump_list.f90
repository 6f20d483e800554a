!> Keys of `&bump_foil` that have one value a bump, or one for all.
module gfb_bump_list
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_text, only: text
  use gfb_value_rules, only: rule_type
  implicit none (type, external)
  private
  public :: bump_list_key, complain_of_bumps

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
end module gfb_bump_list
