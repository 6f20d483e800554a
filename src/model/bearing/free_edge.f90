!> The free edge of the top foil, and fictitious forces on it: one that lifts it, and the
!> tension of a string along it that keeps it straight.
!>
!> They lead from one equilibrium of a bearing to others: where both are zero again, the bearing is
!> in equilibrium by itself.
module gfb_free_edge
  use gfb_kinds, only: wp
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_foil_model, only: foil_model_type
  implicit none (type, external)
  private
  public :: find_free_edge

  !> This rank's nodes of the free edge; none where the top foil has none.
  type, public :: free_edge_type
    integer, allocatable :: unknown(:)        !! local unknowns of the bearing that move the nodes
    integer, allocatable :: node(:)           !! of the film, on this rank
    real(wp), allocatable :: share(:)         !! of the solved width that belongs to a node [1]
    real(wp), allocatable, private :: rate(:) !! displacement towards the shaft over the unknown [1]
    real(wp), allocatable, private :: origin(:) !! the unknown's value at rest
    integer, allocatable, private :: neighbours(:, :) !! (2, pairs) unknowns of nodes side by side
    real(wp), allocatable, private :: pair_rate(:, :) !! (2, pairs) the same of these [1]
    real(wp), allocatable, private :: distance(:)     !! (pairs) between them [m]
    real(wp), private :: solved = 1.0_wp      !! part of the width that is solved [1]
  contains
    procedure :: add_pull
    procedure :: add_hold
    procedure :: hold_stiffness
    procedure :: add_tension
    procedure :: tension_block
    procedure :: lift
    procedure :: lift_rates
    procedure :: pairs
  end type free_edge_type

contains

  !> The nodes at either end of the pad that can move, with their shares of the width.
  subroutine find_free_edge(whole, mesh, foil, edge)
    type(film_mesh_type), intent(in) :: whole !! the film's mesh
    type(local_mesh_type), intent(in) :: mesh !! this rank's share of it
    class(foil_model_type), intent(in) :: foil !! with its unknowns placed
    type(free_edge_type), intent(out) :: edge !! of the top foil
    integer :: node, station, row
    logical :: taken(size(mesh%mesh_node))
    real(wp) :: share(size(mesh%mesh_node))

    taken = .false.
    share = 0.0_wp
    do node = 1, size(taken)
      station = (mesh%mesh_node(node) - 1)/whole%rows() + 1
      row = mesh%mesh_node(node) - (station - 1)*whole%rows()
      taken(node) = foil%is_meshed() .and. mesh%owned(node) .and. foil%source(node) /= 0 .and. &
        (station == 1 .or. station == whole%stations())
      share(node) = row_share(whole%row_axial, row)
    end do
    edge%unknown = pack(foil%source, taken)
    edge%node = pack([(node, node=1, size(taken))], taken)
    edge%share = pack(share, taken)
    edge%solved = merge(0.5_wp, 1.0_wp, whole%half)
    edge%rate = -pack(foil%rate, taken)
    edge%origin = pack(foil%origin, taken)
    call find_neighbours(whole, mesh, foil, edge)
  end subroutine find_free_edge

  !> Sides of this rank's elements that lie on the edge.
  subroutine find_neighbours(whole, mesh, foil, edge)
    type(film_mesh_type), intent(in) :: whole
    type(local_mesh_type), intent(in) :: mesh
    class(foil_model_type), intent(in) :: foil
    type(free_edge_type), intent(inout) :: edge
    integer :: element, corner, next, node(2), station(2), row(2), pairs, pass

    pairs = 0
    do pass = 1, 2
      if (pass == 2) then
        allocate (edge%neighbours(2, pairs), edge%pair_rate(2, pairs), edge%distance(pairs))
      end if
      pairs = 0
      do element = 1, merge(size(mesh%element_nodes, 2), 0, foil%is_meshed())
        do corner = 1, size(mesh%element_nodes, 1)
          next = modulo(corner, size(mesh%element_nodes, 1)) + 1
          node = mesh%element_nodes([corner, next], element)
          station = (mesh%mesh_node(node) - 1)/whole%rows() + 1
          row = mesh%mesh_node(node) - (station - 1)*whole%rows()
          if (station(1) /= station(2) .or. any(foil%source(node) == 0)) cycle
          if (station(1) /= 1 .and. station(1) /= whole%stations()) cycle
          if (foil%source(node(1)) == foil%source(node(2))) cycle ! beams move as one
          pairs = pairs + 1
          if (pass == 1) cycle
          edge%neighbours(:, pairs) = foil%source(node)
          edge%pair_rate(:, pairs) = -foil%rate(node)
          edge%distance(pairs) = abs(whole%row_axial(row(2)) - whole%row_axial(row(1)))
        end do
      end do
    end do
  end subroutine find_neighbours

  !> Part of the solved width that is nearest to a row.
  pure function row_share(axial, row) result(share)
    real(wp), intent(in) :: axial(:) !! z of the rows [m]
    integer, intent(in) :: row
    real(wp) :: share

    share = 0.5_wp*(axial(min(row + 1, size(axial))) - axial(max(row - 1, 1)))/ &
      (axial(size(axial)) - axial(1))
  end function row_share

  !> Adds a force that lifts the whole width of the edge evenly to the local residual.
  pure subroutine add_pull(self, pull, residual)
    class(free_edge_type), intent(in) :: self !! the free edge
    real(wp), intent(in) :: pull           !! on the whole width, towards the shaft [N]
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
    integer :: i

    do i = 1, size(self%unknown)
      associate (equation => residual(self%unknown(i)))
        equation = equation - pull*self%solved*self%share(i)*self%rate(i)
      end associate
    end do
  end subroutine add_pull

  !> Adds the forces of springs that keep every node of the edge at a height to the local residual.
  pure subroutine add_hold(self, stiffness, height, unknown, residual)
    class(free_edge_type), intent(in) :: self !! the free edge
    real(wp), intent(in) :: stiffness      !! of the whole width [N/m]
    real(wp), intent(in) :: height         !! above the edge at rest [m]
    real(wp), intent(in) :: unknown(:)     !! local unknowns of the bearing, in SI
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
    real(wp) :: lift
    integer :: i

    if (.not. stiffness > 0.0_wp) return
    do i = 1, size(self%unknown)
      associate (number => self%unknown(i), rate => self%rate(i))
        lift = rate*(unknown(number) - self%origin(i))
        residual(number) = residual(number) &
          + stiffness*self%solved*self%share(i)*rate*(lift - height)
      end associate
    end do
  end subroutine add_hold

  !> Derivative of those forces after the unknown of one node, for a stiffness of one [1].
  elemental function hold_stiffness(self, i) result(stiffness)
    class(free_edge_type), intent(in) :: self !! the free edge
    integer, intent(in) :: i !! node of the edge
    real(wp) :: stiffness
    stiffness = self%solved*self%share(i)*self%rate(i)**2
  end function hold_stiffness

  !> Neighbours on this rank that move on their own; none where the edge cannot bend along the axis.
  pure function pairs(self)
    class(free_edge_type), intent(in) :: self !! the free edge
    integer :: pairs
    pairs = size(self%distance)
  end function pairs

  !> Adds the forces of a string along the edge, \( T (v_a - v_b)/d \) between neighbours.
  pure subroutine add_tension(self, tension, unknown, residual)
    class(free_edge_type), intent(in) :: self !! the free edge
    real(wp), intent(in) :: tension        !! T [N]
    real(wp), intent(in) :: unknown(:)     !! local unknowns of the bearing, in SI
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
    real(wp) :: force
    integer :: i

    if (.not. abs(tension) > 0.0_wp) return
    do i = 1, size(self%distance)
      associate (number => self%neighbours(:, i), rate => self%pair_rate(:, i))
        force = tension*(rate(1)*unknown(number(1)) - rate(2)*unknown(number(2)))/self%distance(i)
        residual(number) = residual(number) + [force, -force]*rate
      end associate
    end do
  end subroutine add_tension

  !> Derivatives of these forces, for one pair of neighbours, and where they stand.
  pure subroutine tension_block(self, i, tension, number, block)
    class(free_edge_type), intent(in) :: self !! the free edge
    integer, intent(in) :: i           !! pair
    real(wp), intent(in) :: tension    !! T [N]
    integer, intent(out) :: number(2)   !! local unknowns of the bearing
    real(wp), intent(out) :: block(2, 2) !! in the order of `number` [N/m]

    number = self%neighbours(:, i)
    associate (rate => self%pair_rate(:, i), stiffness => tension/self%distance(i))
      block(:, 1) = stiffness*[rate(1)*rate(1), -rate(1)*rate(2)]
      block(:, 2) = stiffness*[-rate(1)*rate(2), rate(2)*rate(2)]
    end associate
  end subroutine tension_block

  !> This rank's part of the mean displacement of the edge towards the shaft [m].
  pure function lift(self, unknown)
    class(free_edge_type), intent(in) :: self !! the free edge
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp) :: lift
    lift = sum(self%share*self%rate*(unknown(self%unknown) - self%origin))
  end function lift

  !> Derivatives of the mean lift after the local unknowns of the bearing.
  pure function lift_rates(self, unknowns) result(rates)
    class(free_edge_type), intent(in) :: self !! the free edge
    integer, intent(in) :: unknowns !! local ones
    real(wp) :: rates(unknowns)
    integer :: i

    rates = 0.0_wp
    do i = 1, size(self%unknown)
      rates(self%unknown(i)) = rates(self%unknown(i)) + self%share(i)*self%rate(i)
    end do
  end function lift_rates
end module gfb_free_edge
