!> The shapes of a pad's rigid gap that a case file asks for: film, mesh and rules go through this
!> one list.
module gfb_gap_shapes
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, bore_case_type, ramp_of
  use gfb_gap_shape, only: gap_shape_item_type, add_shape
  implicit none (type, external)
  private
  public :: find_shapes, peak_of

contains

  !> The shapes in the order in which they are taken off the gap.
  pure subroutine find_shapes(bearing, bore, leading_edge, facing, list)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing`, `&pads` and `&ramp` ask for
    type(bore_case_type), intent(in) :: bore !! what `&bore` asks for
    real(wp), intent(in) :: leading_edge !! where the pad begins [rad]
    real(wp), intent(in) :: facing !! -1: the pad is on the runner's other side [1]
    type(gap_shape_item_type), allocatable, intent(out) :: list(:)

    allocate (list(0))
    if (bore%present) call add_shape('bore', bore%profile, list)
    if (bearing%ramp_part > 0.0_wp .or. bearing%play > 0.0_wp) then
      call add_shape('ramp', ramp_of(bearing, leading_edge, facing), list)
    end if
  end subroutine find_shapes

  !> What shapes take off the gap at most: all their peaks together [m].
  pure real(wp) function peak_of(list) result(peak)
    type(gap_shape_item_type), intent(in) :: list(:) !! shapes
    integer :: i

    peak = 0.0_wp
    do i = 1, size(list)
      peak = peak + list(i)%shape%peak()
    end do
  end function peak_of
end module gfb_gap_shapes
