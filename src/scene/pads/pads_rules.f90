!> What a scene must have that gives something pad by pad.
module gfb_pads_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_operation_case, only: operation_case_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_pads

contains

  !> Complains about lists that have neither one value for all pads nor one for each.
  subroutine check_pads(keys, bearing, operation)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&pads` ask for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for

    call check_length('leading_edge_lift', operation%leading_edge_lift)
    call check_length('leading_edge_lift_edge', operation%leading_edge_lift_edge)

  contains

    !> Checks the length of a list.
    subroutine check_length(key, list)
      character(len=*), intent(in) :: key !! in `&operation`
      real(wp), intent(in) :: list(:)     !! its values [m]

      if (any(size(list) == [0, 1, bearing%pads])) return
      call keys%complain('operation', key, 'has '//text(size(list))//' values, must have one '// &
                         'for all pads or one for each of '//text(bearing%pads))
    end subroutine check_length
  end subroutine check_pads
end module gfb_pads_rules
