!> Rows of a foil's nodes along the axis.
module gfb_axial_rows
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: axial_rows

contains

  !> Rows of equal elements along the axis, symmetric about z = 0 to the last digit.
  pure function axial_rows(width, axial, half) result(rows)
    real(wp), intent(in) :: width   !! whole width [m]
    integer, intent(in) :: axial    !! elements over the whole width
    logical, intent(in) :: half     !! z >= 0 only; axial is even then
    real(wp), allocatable :: rows(:)
    integer :: i

    rows = [(0.5_wp*width*real(2*i - axial, wp)/real(axial, wp), i=merge(axial/2, 0, half), axial)]
  end function axial_rows
end module gfb_axial_rows
