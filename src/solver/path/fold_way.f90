!> How far a sweep that goes round folds has come.
module gfb_fold_way
  use gfb_kinds, only: wp
  use gfb_arc_length, only: arc_type
  use gfb_operating_point, only: operating_point_type
  implicit none (type, external)
  private

  !> The way along the branch. Keep it where it is.
  type, public :: fold_way_type
    type(arc_type) :: arc
    type(operating_point_type) :: first, last !! of the sweep
    real(wp), allocatable :: place(:)         !! of the sweep's values between them [1]
    integer :: kept = 1                       !! value whose answer was kept last
    real(wp) :: kept_heading = 1.0_wp         !! and in which sense it was passed
  end type fold_way_type
end module gfb_fold_way
