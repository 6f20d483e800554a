!> Pieces of a mesh that are condensed onto the nodes where they can be loaded or joined.
module gfb_substructures
  use gfb_kinds, only: wp
  use gfb_quad_mesh, only: quad_mesh_type, own_thickness
  implicit none (type, external)
  private
  public :: substructure, find_kinds, kind_count, places_in

  real(wp), parameter :: congruence = 1.0e-9_wp !! of positions, over the piece's size [1]

  !> A piece of a mesh with any retained nodes.
  type, public :: substructure_type
    integer, allocatable :: elements(:)  !! of the whole mesh; none known where it is another rank's
    integer, allocatable :: nodes(:)     !! of the whole mesh, rising
    logical, allocatable :: retained(:)  !! which of them are kept
    integer :: column = 0                !! of the whole mesh's columns of elements, its first
    integer :: kind = 0                  !! congruent pieces have the same
  end type substructure_type

contains

  !> The piece that some elements make.
  pure function substructure(mesh, elements, is_retained) result(piece)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    integer, intent(in) :: elements(:) !! of the mesh, that belong to it
    logical, intent(in) :: is_retained(:) !! one a node of the whole mesh
    type(substructure_type) :: piece
    logical :: used(size(mesh%position, 2))
    integer :: i

    used = .false.
    do i = 1, size(elements)
      used(mesh%element_nodes(:, elements(i))) = .true.
    end do
    piece%elements = elements
    piece%column = (minval(elements) - 1)/max(1, mesh%rows - 1) + 1
    piece%nodes = pack([(i, i=1, size(used))], used)
    piece%retained = is_retained(piece%nodes)
  end function substructure

  !> Numbers the kinds of pieces: those that a translation makes the same, with the same supports
  !> inside. Supports at retained nodes do not count.
  pure subroutine find_kinds(mesh, fixed, pieces)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    logical, intent(in) :: fixed(:, :) !! (5, nodes) unknowns fixed by supports
    type(substructure_type), intent(inout) :: pieces(:) !! a substructure
    integer :: first(size(pieces)), i, kind, kinds

    kinds = 0
    do i = 1, size(pieces)
      do kind = 1, kinds
        if (are_congruent(mesh, fixed, pieces(first(kind)), pieces(i))) exit
      end do
      pieces(i)%kind = kind
      if (kind <= kinds) cycle
      kinds = kinds + 1
      first(kinds) = i
    end do
  end subroutine find_kinds

  !> Kinds among pieces.
  pure integer function kind_count(pieces) result(kinds)
    type(substructure_type), intent(in) :: pieces(:) !! a substructure
    integer :: i

    kinds = 0
    do i = 1, size(pieces)
      kinds = max(kinds, pieces(i)%kind)
    end do
  end function kind_count

  !> Whether one piece is a translated copy of another.
  pure logical function are_congruent(mesh, fixed, one, other) result(congruent)
    type(quad_mesh_type), intent(in) :: mesh
    logical, intent(in) :: fixed(:, :)
    type(substructure_type), intent(in) :: one, other
    real(wp) :: shift(3), extent
    integer :: i

    congruent = size(one%nodes) == size(other%nodes) .and. &
                size(one%elements) == size(other%elements)
    if (.not. congruent) return
    congruent = all(one%retained .eqv. other%retained)
    if (.not. congruent) return
    congruent = all(fixed(:, pack(one%nodes, .not. one%retained)) .eqv. &
                    fixed(:, pack(other%nodes, .not. one%retained)))
    if (.not. congruent) return
    shift = mesh%position(:, other%nodes(1)) - mesh%position(:, one%nodes(1))
    extent = maxval(maxval(mesh%position(:, one%nodes), 2) - minval(mesh%position(:, one%nodes), 2))
    do i = 1, size(one%nodes)
      congruent = all(abs(mesh%position(:, other%nodes(i)) - mesh%position(:, one%nodes(i)) - &
                          shift) <= congruence*extent) .and. &
                  all(abs(mesh%axis_1(:, other%nodes(i)) - mesh%axis_1(:, one%nodes(i))) &
                      <= congruence) .and. &
                  all(abs(mesh%axis_2(:, other%nodes(i)) - mesh%axis_2(:, one%nodes(i))) &
                      <= congruence)
      if (.not. congruent) return
    end do
    do i = 1, size(one%elements)
      congruent = all(places_in(one, mesh%element_nodes(:, one%elements(i))) == &
                      places_in(other, mesh%element_nodes(:, other%elements(i)))) .and. &
                  all(abs(mesh%director(:, :, one%elements(i)) - &
                          mesh%director(:, :, other%elements(i))) <= congruence) .and. &
                  abs(own_thickness(mesh, one%elements(i)) - &
                      own_thickness(mesh, other%elements(i))) <= 0.0_wp
      if (.not. congruent) return
    end do
  end function are_congruent

  !> Where nodes stand in the list of a piece's.
  pure function places_in(piece, nodes) result(places)
    type(substructure_type), intent(in) :: piece !! a substructure
    integer, intent(in) :: nodes(:) !! of the mesh, rising
    integer :: places(size(nodes)), i, low, high, middle

    do i = 1, size(nodes)
      low = 1
      high = size(piece%nodes)
      do while (low < high)
        middle = (low + high)/2
        if (piece%nodes(middle) < nodes(i)) then
          low = middle + 1
        else
          high = middle
        end if
      end do
      places(i) = low
    end do
  end function places_in
end module gfb_substructures
