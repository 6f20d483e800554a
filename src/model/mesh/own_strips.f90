!> Strips side by side with bumps of their own, as one mesh.
!>
!> All strips have as many bumps, and as many stations: a station is the same place of a bump on
!> every strip, at an x of the strip's own. So what counts stations and rows alone holds for all of
!> them: node sets, substructures, and how ranks share them.
module gfb_own_strips
  use gfb_quad_mesh, only: quad_mesh_type
  implicit none (type, external)
  private
  public :: put_strip, join_kinds

contains

  !> Gives the rows of a strip the shape that they have on another mesh of as many stations.
  pure subroutine put_strip(mesh, other, strip)
    type(quad_mesh_type), intent(inout) :: mesh !! of all strips, with `row_strip`
    type(quad_mesh_type), intent(in) :: other !! the same stretch, as if all rows were the strip's
    integer, intent(in) :: strip !! its number
    integer :: node, element, row

    do node = lbound(mesh%position, 2), ubound(mesh%position, 2)
      if (mesh%row_strip(modulo(node - 1, mesh%rows) + 1) /= strip) cycle
      mesh%position(:, node) = other%position(:, node)
      mesh%axis_1(:, node) = other%axis_1(:, node)
      mesh%axis_2(:, node) = other%axis_2(:, node)
      mesh%face(:, node) = other%face(:, node)
    end do
    do element = lbound(mesh%element_nodes, 2), ubound(mesh%element_nodes, 2)
      row = modulo(element - 1, mesh%rows - 1) + 1 ! over a cut nothing asks for it
      if (mesh%row_strip(row) == strip) mesh%director(:, :, element) = other%director(:, :, element)
    end do
  end subroutine put_strip

  !> Tells pieces apart that differ on one more strip.
  pure subroutine join_kinds(kind, other)
    integer, intent(inout) :: kind(:) !! of the pieces, numbered in order of their first
    integer, intent(in) :: other(:)   !! their kinds on the other strip
    integer :: joined(size(kind)), i, k, kinds

    kinds = 0
    do i = 1, size(kind)
      do k = 1, i - 1
        if (kind(k) == kind(i) .and. other(k) == other(i)) exit
      end do
      if (k < i) then
        joined(i) = joined(k)
      else
        kinds = kinds + 1
        joined(i) = kinds
      end if
    end do
    kind = joined
  end subroutine join_kinds
end module gfb_own_strips
