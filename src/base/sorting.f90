!> Numbers in rising order.
module gfb_sorting
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: sort_by, sorted

contains

  !> Puts places into the order of their keys, equal keys by place: halves are ordered and merged.
  pure recursive subroutine sort_by(key, place)
    real(wp), intent(in) :: key(:)     !! [any unit]
    integer, intent(inout) :: place(:) !! in `key`, each once
    integer :: merged(size(place)), left, right, half, i
    logical :: take_left

    half = size(place)/2
    if (half == 0) return
    call sort_by(key, place(:half))
    call sort_by(key, place(half + 1:))
    left = 1
    right = half + 1
    do i = 1, size(place)
      take_left = right > size(place)
      if (left <= half .and. .not. take_left) then
        take_left = comes_first(key, place(left), place(right))
      end if
      if (take_left) then
        merged(i) = place(left)
        left = left + 1
      else
        merged(i) = place(right)
        right = right + 1
      end if
    end do
    place = merged
  end subroutine sort_by

  !> Whether one place stands before another.
  pure logical function comes_first(key, one, other) result(before)
    real(wp), intent(in) :: key(:)
    integer, intent(in) :: one, other
    before = key(one) < key(other) .or. (key(one) <= key(other) .and. one < other)
  end function comes_first

  !> The numbers, the smallest first.
  pure function sorted(numbers)
    real(wp), intent(in) :: numbers(:) !! [any unit]
    real(wp) :: sorted(size(numbers))
    integer :: place(size(numbers)), i

    place = [(i, i=1, size(numbers))]
    call sort_by(numbers, place)
    sorted = numbers(place)
  end function sorted
end module gfb_sorting
