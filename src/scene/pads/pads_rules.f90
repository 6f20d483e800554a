!> What a scene of several pads cannot ask for.
module gfb_pads_rules
  use gfb_bearing_case, only: bearing_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: model_case_type, coupling_partitioned
  use gfb_operation_case, only: operation_case_type
  implicit none (type, external)
  private
  public :: check_pads

  character(len=*), parameter :: one_pad = 'needs a bearing of one pad: count = 1 in &pads'

contains

  !> Complains about what is known of one pad alone.
  subroutine check_pads(keys, bearing, operation, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&pads` ask for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for

    if (bearing%pads == 1) return
    if (operation%lift_given(1)) then
      call keys%complain('operation', 'leading_edge_lift', one_pad//': each pad has a free edge')
    end if
    if (operation%lift_given(2)) then
      call keys%complain('operation', 'leading_edge_lift_edge', &
                         one_pad//': each pad has a free edge')
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "'partitioned' "//one_pad)
    end if
  end subroutine check_pads
end module gfb_pads_rules
