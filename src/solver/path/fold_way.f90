!> How far a sweep that goes round folds has come.
module gfb_fold_way
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_arc, only: arc_type
  use gfb_operating_point, only: operating_point_type, visit_point
  implicit none (type, external)
  private
  public :: visit_way

  !> The path along the branch. Keep it where it is.
  type, public :: fold_way_type
    type(arc_type) :: arc
    type(operating_point_type) :: first, last !! of the sweep
    real(wp), allocatable :: lambda(:)        !! of the sweep's values between them [1]
    integer :: kept = 1                       !! value whose answer was kept last
    real(wp) :: kept_heading = 1.0_wp         !! and in which sense it was passed
  end type fold_way_type

contains

  !> Saves or restores all but the arc; the sweep knows its last point and its values.
  pure subroutine visit_way(archive, branch)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(fold_way_type), intent(inout) :: branch !! written where the archive restores

    call archive%part('first')
    call visit_point(archive, branch%first)
    call archive%visit('kept', branch%kept)
    call archive%visit('kept_heading', branch%kept_heading)
  end subroutine visit_way
end module gfb_fold_way
