!> Cuts film and foils into parts of equal weight, by METIS.
!>
!> What is cut is a graph, not the meshes: its vertices are the film's columns of elements, with the
!> top foil's below them, and the bump foil's super-elements, or its columns where it is not
!> condensed. Neighbours along a foil are joined, and so are a column and what lies below it: what
!> touches comes to the same rank. Lists have an entry a column, not an entry a node.
module gfb_partition
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_null_ptr
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail, status_machine
  implicit none (type, external)
  private
  public :: divide, chain, no_chain

  integer(c_int), parameter :: metis_ok = 1
  !> weight of all vertices, as METIS counts in whole numbers
  integer, parameter :: heaviest = 1000000

  !> Pieces that follow each other along x: columns of elements, or super-elements.
  type, public :: chain_type
    real(wp), allocatable :: bound(:)  !! (pieces + 1) where they begin and end, rising [m]
    real(wp), allocatable :: weight(:) !! (pieces) unknowns
    logical :: closed = .false.        !! the last piece's neighbour is the first
  end type chain_type

  !> Which part each piece of film and bump foil belongs to.
  type, public :: division_type
    integer :: parts = 1
    integer, allocatable :: film(:)  !! (pieces of the film's chain) part, from 1
    integer, allocatable :: bumps(:) !! (pieces of the bump foil's chain)
    integer, allocatable :: load(:)  !! (parts) unknowns
    integer :: cut = 0               !! joints between pieces of different parts
    integer :: joints = 0            !! all joints
  contains
    procedure :: balance
  end type division_type

  interface
    function c_part_graph(vertices, constraints, first, neighbour, weight, vertex_size, &
                          edge_weight, parts, part_weight, imbalance, options, cut, part) &
      result(status) bind(c, name='METIS_PartGraphRecursive')
      import :: c_int, c_ptr
      implicit none (type, external)
      integer(c_int), intent(in) :: vertices, constraints, parts
      integer(c_int), intent(in) :: first(*), neighbour(*), weight(*), edge_weight(*)
      type(c_ptr), value :: vertex_size, part_weight, imbalance, options
      integer(c_int), intent(out) :: cut, part(*)
      integer(c_int) :: status
    end function c_part_graph
  end interface

contains

  !> Pieces with given bounds, and as many unknowns each as given.
  pure function chain(bound, weight, closed) result(made)
    real(wp), intent(in) :: bound(:)  !! rising [m]
    real(wp), intent(in) :: weight(:) !! unknowns of each link [1]
    logical, intent(in) :: closed     !! a ring
    type(chain_type) :: made

    made%bound = bound
    made%weight = weight
    made%closed = closed
  end function chain

  !> No pieces at all.
  pure function no_chain() result(made)
    type(chain_type) :: made
    allocate (made%bound(0), made%weight(0))
  end function no_chain

  !> Parts of film and bump foil together.
  !>
  !> Fails when METIS does.
  subroutine divide(film, bumps, parts, division, error)
    type(chain_type), intent(in) :: film  !! no pieces: a strip alone
    type(chain_type), intent(in) :: bumps !! no pieces: a film alone
    integer, intent(in) :: parts !! ranks
    type(division_type), intent(out) :: division !! the rank of every link
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    integer, allocatable :: joint(:, :), part(:)
    integer :: i, pieces, wanted

    pieces = size(film%weight)
    division%parts = parts
    joint = joints_of(film, bumps)
    allocate (part(pieces + size(bumps%weight)), source=1)
    ! METIS wants a piece for every part; ranks beyond that have nothing.
    wanted = min(parts, size(part))
    if (wanted > 1) call cut_graph([film%weight, bumps%weight], joint, wanted, part, error)
    if (allocated(error)) return
    division%film = part(:pieces)
    division%bumps = part(pieces + 1:)
    division%joints = size(joint, 2)
    division%cut = count([(part(joint(1, i)) /= part(joint(2, i)), i=1, size(joint, 2))])
    allocate (division%load(parts), source=0)
    do i = 1, size(part)
      associate (load => division%load(part(i)))
        if (i <= pieces) load = load + nint(film%weight(i))
        if (i > pieces) load = load + nint(bumps%weight(i - pieces))
      end associate
    end do
  end subroutine divide

  !> Largest load over the mean one [1].
  pure function balance(self)
    class(division_type), intent(in) :: self !! the division
    real(wp) :: balance
    balance = real(maxval(self%load), wp)*self%parts/real(max(1, sum(self%load)), wp)
  end function balance

  !> Neighbours along either chain, and pieces above each other; pairs of vertices, film first.
  pure function joints_of(film, bumps) result(joint)
    type(chain_type), intent(in) :: film, bumps
    integer, allocatable :: joint(:, :) !! (2, joints)
    integer, allocatable :: list(:)
    integer :: i, k, m, pieces, below

    pieces = size(film%weight)
    below = size(bumps%weight)
    list = [(i, i + 1, i=1, pieces - 1), (pieces + i, pieces + i + 1, i=1, below - 1)]
    if (film%closed .and. pieces > 2) list = [list, 1, pieces]
    k = 1
    do i = 1, pieces
      do while (k < below)
        if (bumps%bound(k + 1) > film%bound(i)) exit
        k = k + 1
      end do
      do m = k, below
        if (bumps%bound(m) >= film%bound(i + 1)) exit
        if (bumps%bound(m + 1) > film%bound(i)) list = [list, i, pieces + m]
      end do
    end do
    joint = reshape(list, [2, size(list)/2])
  end function joints_of

  !> Parts of a graph's vertices.
  !>
  !> Fails when METIS does.
  subroutine cut_graph(weight, joint, parts, part, error)
    real(wp), intent(in) :: weight(:)  !! of the vertices
    integer, intent(in) :: joint(:, :) !! (2, joints)
    integer, intent(in) :: parts
    integer, intent(out) :: part(:)    !! of the vertices, from 1
    type(error_type), allocatable, intent(out) :: error

    integer(c_int) :: first(size(weight) + 1), neighbour(2*size(joint, 2)), next(size(weight))
    integer(c_int) :: ones(2*size(joint, 2)), rounded(size(weight)), found(size(weight)), cut
    integer :: i, k

    first = 0
    do i = 1, size(joint, 2)
      first(joint(:, i) + 1) = first(joint(:, i) + 1) + 1
    end do
    do i = 1, size(weight)
      first(i + 1) = first(i + 1) + first(i)
    end do
    next = first(:size(weight))
    do i = 1, size(joint, 2)
      do k = 1, 2
        next(joint(k, i)) = next(joint(k, i)) + 1
        neighbour(next(joint(k, i))) = int(joint(3 - k, i) - 1, c_int)
      end do
    end do
    ones = 1
    rounded = max(1, nint(weight*heaviest/sum(weight)))
    if (c_part_graph(int(size(weight), c_int), 1_c_int, first, neighbour, rounded, c_null_ptr, &
                     ones, int(parts, c_int), c_null_ptr, c_null_ptr, c_null_ptr, cut, &
                     found) /= metis_ok) then
      call fail(error, 'METIS could not cut the meshes into parts', status_machine)
      return
    end if
    part = found + 1
  end subroutine cut_graph
end module gfb_partition
