!> Places cut into patches of neighbours.
module gfb_node_patches
  use gfb_kinds, only: wp
  use gfb_sorting, only: sort_by
  implicit none (type, external)
  private
  public :: cut_into_patches

contains

  !> Number of the patch of each node, from 1, and how many there are.
  !>
  !> Halves the nodes across their longest extent until no part holds more than asked for.
  pure subroutine cut_into_patches(position, most, patch, patches)
    real(wp), intent(in) :: position(:, :)       !! (3, nodes) [m]
    integer, intent(in) :: most                  !! nodes in a patch
    integer, allocatable, intent(out) :: patch(:) !! (nodes)
    integer, intent(out) :: patches !! how many there are
    integer, allocatable :: order(:), first(:)
    integer :: i, parts, part, axis, middle
    real(wp) :: extent(size(position, 1))

    allocate (patch(size(position, 2)), source=0)
    order = [(i, i=1, size(patch))]
    patches = 0
    if (size(order) == 0) return
    ! A stack of parts that wait: part k is order(first(k):first(k + 1) - 1).
    first = [1, size(order) + 1]
    do while (size(first) > 1)
      parts = size(first) - 1
      associate (begin => first(parts), finish => first(parts + 1) - 1)
        if (finish - begin + 1 <= most) then
          patches = patches + 1
          patch(order(begin:finish)) = patches
          middle = 0
        else
          extent = maxval(position(:, order(begin:finish)), 2) - &
                   minval(position(:, order(begin:finish)), 2)
          axis = maxloc(extent, 1)
          middle = (begin + finish + 1)/2
          call sort_by(position(axis, :), order(begin:finish))
        end if
      end associate
      part = first(parts + 1)
      first = first(:parts)
      if (middle > 0) first = [first, middle, part]
    end do
  end subroutine cut_into_patches
end module gfb_node_patches
