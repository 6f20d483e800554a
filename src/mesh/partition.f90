!> Cuts a mesh into parts of equal weight with few shared nodes, by METIS.
module gfb_partition
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_null_ptr
  use gfb_errors, only: error_type, fail, status_machine
  implicit none (type, external)
  private
  public :: partition_elements

  integer(c_int), parameter :: metis_ok = 1
  integer(c_int), parameter :: common_nodes = 2 !! elements that share an edge are neighbours

  interface
    function c_part_mesh_dual(elements, nodes, pointer, node, weight, node_size, common, parts, &
                              part_weight, options, cut, element_part, node_part) result(status) &
      bind(c, name='METIS_PartMeshDual')
      import :: c_int, c_ptr
      implicit none (type, external)
      integer(c_int), intent(in) :: elements, nodes, common, parts
      integer(c_int), intent(in) :: pointer(*), node(*)
      type(c_ptr), value :: weight, node_size, part_weight, options
      integer(c_int), intent(out) :: cut, element_part(*), node_part(*)
      integer(c_int) :: status
    end function c_part_mesh_dual
  end interface

contains

  !> Part of every element, from 1.
  !>
  !> Fails when METIS does.
  subroutine partition_elements(element_nodes, nodes, parts, element_part, error)
    integer, intent(in) :: element_nodes(:, :)            !! (4, elements), from 1
    integer, intent(in) :: nodes                          !! nodes of the mesh
    integer, intent(in) :: parts                          !! parts wanted
    integer, allocatable, intent(out) :: element_part(:)  !! (elements)
    type(error_type), allocatable, intent(out) :: error

    integer(c_int), allocatable :: pointer(:), node_part(:), part(:)
    integer(c_int) :: cut
    integer :: i, corners

    corners = size(element_nodes, 1)
    allocate (element_part(size(element_nodes, 2)), source=1)
    if (parts == 1) return
    allocate (part(size(element_part)), node_part(nodes))
    pointer = [(int(i*corners, c_int), i=0, size(element_part))]
    if (c_part_mesh_dual(int(size(element_part), c_int), int(nodes, c_int), pointer, &
                         int(reshape(element_nodes, [size(element_nodes)]) - 1, c_int), &
                         c_null_ptr, c_null_ptr, common_nodes, int(parts, c_int), c_null_ptr, &
                         c_null_ptr, cut, part, node_part) /= metis_ok) then
      call fail(error, 'METIS could not cut the mesh into parts', status_machine)
      return
    end if
    element_part = part + 1
  end subroutine partition_elements
end module gfb_partition
