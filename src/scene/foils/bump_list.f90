!> Keys of `&bump_foil` that have one value a bump, or one for all.
module gfb_bump_list
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_text, only: text
  use gfb_value_rules, only: rule_type
  implicit none (type, external)
  private
  public :: bump_list_key

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
end module gfb_bump_list
