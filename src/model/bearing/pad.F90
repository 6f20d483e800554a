#include "gfb_petsc.h"
!> One pad of a bearing: its film, the foil under it, asperities, the free edge of its top foil.
!>
!> Its local unknowns on a rank are the pressures of its film nodes (the rank's own and its neighbours')
!> and the foil's unknowns, one after the other; all arrays here are the pad's part of the bearing's.
!>
!> The free edge of the top foil, and fictitious forces on it: one that lifts it, and the
!> tension of a string along it that keeps it straight.
!>
!> They lead from one equilibrium of a bearing to others: where both are zero again, the bearing is
!> in equilibrium by itself.
module gfb_pad
  use petscmat
  use gfb_kinds, only: wp
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type, distribute_mesh
  use gfb_foil_model, only: foil_model_type
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: rank_count
  use gfb_partition, only: division_type, divide, no_chain
  use gfb_part_chains, only: film_chain, film_columns
  use gfb_film_load, only: film_forces
  use gfb_solid_contact, only: solid_contact_type, contact_pressure, contact_pressure_rate
  use gfb_bump_contacts, only: contact_top
  use gfb_cost_events, only: cost_events_type
  use gfb_operating_point, only: operating_point_type
  use gfb_gap_part, only: gap_part_type
  use gfb_gas_film, only: gas_film_type, create_gas_film
  implicit none (type)
  private
  public :: create_pad_film, complete_pad, place_pads, shift_pad, move_crests

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
    procedure, non_overridable :: add_pull, add_hold, hold_stiffness, add_tension, tension_block, lift, lift_rates
    procedure, non_overridable :: pairs
  end type free_edge_type

  !> Where a pad stands.
  type, public :: pad_place_type
    real(wp) :: turn = 0.0_wp     !! from the first pad [rad]
    real(wp) :: shift(2) = 0.0_wp !! of its centre of curvature relative to the bearing's, seen as an eccentricity [m]
    real(wp) :: offset = 0.0_wp   !! of its midplane along the axis from the rotor's centre of mass [m]
    real(wp) :: facing = 1.0_wp   !! -1: it faces the runner's other side, and stands at the play, its offset [1]
    real(wp), allocatable :: further_gap(:, :) !! (bumps, strips) of its crests, over those of the first pad; none: the same [m]
  end type pad_place_type

  !> A pad on this rank.
  type, public :: pad_type
    type(film_mesh_type) :: whole          !! the film's mesh
    type(local_mesh_type) :: mesh          !! this rank's share of it
    type(gas_film_type) :: film
    type(solid_contact_type) :: contact    !! of the shaft with the foil
    !> what grooves leave of the asperities' pressure at its nodes; none: all of it [1]
    real(wp), allocatable :: contact_share(:)
    class(foil_model_type), allocatable :: foil
    type(free_edge_type) :: edge           !! of the top foil
    real(wp), allocatable :: held(:)       !! at its nodes, a deflection that no unknown moves [m]
    real(wp) :: pressure_below = 0.0_wp    !! of the gas under its top foil above p_a, with all of the supply [Pa]
    integer :: number = 1                  !! of the bearing's pads
    integer :: first = 0, last = 0         !! local unknown of the bearing before the pad's, and their last
    integer :: first_node = 0, last_node = 0 !! the same of the film nodes of all pads
  contains
    procedure, non_overridable :: gap => pad_gap
    procedure, non_overridable :: loading, solid_pressure, solid_rate
    procedure, non_overridable :: force => pad_force
    procedure, non_overridable :: unknown_scale, equation_scale, row_entries
  end type pad_type

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
  pure real(wp) function row_share(axial, row) result(share)
    real(wp), intent(in) :: axial(:) !! z of the rows [m]
    integer, intent(in) :: row

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
  elemental real(wp) function hold_stiffness(self, i) result(stiffness)
    class(free_edge_type), intent(in) :: self !! the free edge
    integer, intent(in) :: i !! node of the edge
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

  !> Distributes the film's mesh and sets up this rank's share of the film.
  !>
  !> Fails when the mesh cannot be cut, or an element is folded over.
  subroutine create_pad_film(whole, clearance, ambient_pressure, viscosity, upwind, pad, error, column_part)
    type(film_mesh_type), intent(in) :: whole !! the film's mesh
    real(wp), intent(in) :: clearance        !! C [m]
    real(wp), intent(in) :: ambient_pressure !! p_a [Pa]
    real(wp), intent(in) :: viscosity        !! of the gas [Pa s]
    logical, intent(in) :: upwind            !! SUPG instead of Galerkin
    type(pad_type), intent(inout) :: pad !! film and foil
    type(error_type), allocatable, intent(out) :: error !! why it failed
    !> rank, from 1, of every column of elements; default: the film is cut by itself
    integer, intent(in), optional :: column_part(:)

    type(division_type) :: division

    pad%whole = whole
    if (present(column_part)) then
      division%film = column_part
    else
      call divide(film_chain(whole, .false.), no_chain(), rank_count(), division, error)
      if (allocated(error)) return
      division%film = film_columns(whole, division%film)
    end if
    call distribute_mesh(PETSC_COMM_WORLD, whole%stations(), whole%rows(), whole%periodic, division%film, pad%mesh)
    call create_gas_film(whole, pad%mesh%mesh_node, pad%mesh%element_nodes, clearance, ambient_pressure, viscosity, &
                         upwind, pad%film, error)
  end subroutine create_pad_film

  !> Puts the foil under the film; it moves into the pad.
  subroutine complete_pad(foil, events, pad)
    class(foil_model_type), allocatable, intent(inout) :: foil !! under the film
    type(cost_events_type), intent(in) :: events !! of PETSc's log
    type(pad_type), intent(inout) :: pad         !! with its film
    integer :: nodes

    nodes = size(pad%mesh%mesh_node)
    call move_alloc(foil, pad%foil)
    pad%foil%events = events
    call pad%foil%place(nodes)
    call find_free_edge(pad%whole, pad%mesh, pad%foil, pad%edge)
    pad%last = pad%first + nodes + pad%foil%local_unknowns()
    pad%last_node = pad%first_node + nodes
  end subroutine complete_pad

  !> Adds the pads that are equal to the first one.
  subroutine place_pads(place, pads)
    type(pad_place_type), intent(in) :: place(:) !! of all pads
    type(pad_type), allocatable, intent(inout) :: pads(:) !! the first one, complete
    type(pad_type), allocatable :: all_pads(:)
    integer :: i

    call shift_pad(place(1), pads(1))
    if (size(place) == 1) return
    allocate (all_pads(size(place)))
    all_pads(1) = pads(1)
    do i = 2, size(place)
      call create_equal_pad(all_pads(1), place(i), all_pads(i - 1), all_pads(i))
    end do
    call move_alloc(all_pads, pads)
  end subroutine place_pads

  !> A further pad, equal to the first one but for its place. What PETSc holds of their foils is one and the same: the
  !> first pad's, which frees it.
  subroutine create_equal_pad(first, place, before, pad)
    type(pad_type), intent(in) :: first  !! complete
    type(pad_place_type), intent(in) :: place
    type(pad_type), intent(in) :: before !! whose unknowns stand before the new one's
    type(pad_type), intent(out) :: pad
    type(error_type), allocatable :: error
    integer :: unknowns, nodes

    unknowns = first%last - first%first
    nodes = first%last_node - first%first_node
    pad = first
    pad%number = before%number + 1
    pad%first = before%last
    pad%last = pad%first + unknowns
    pad%first_node = before%last_node
    pad%last_node = pad%first_node + nodes
    pad%whole%station_angle = first%whole%station_angle + place%turn
    pad%whole%surface%offset = place%offset
    pad%whole%surface%facing = place%facing
    associate (film => first%film)
      call create_gas_film(pad%whole, pad%mesh%mesh_node, pad%mesh%element_nodes, film%clearance, film%ambient_pressure, &
                           film%flow%viscosity, film%flow%upwind, pad%film, error)
    end associate
    if (allocated(error)) error stop 'a pad that is equal to a good one is not'
    call shift_pad(place, pad)
    call move_crests(place, pad)
  end subroutine create_equal_pad

  !> Shifts the centre of a pad's film to its place.
  pure subroutine shift_pad(place, pad)
    type(pad_place_type), intent(in) :: place !! of the pad
    type(pad_type), intent(inout) :: pad !! with a film
    call pad%film%put(gap_part_type(name='shift', shift=place%shift))
  end subroutine shift_pad

  !> Gives the crests of a pad, which has the first one's gaps, its own.
  subroutine move_crests(place, pad)
    type(pad_place_type), intent(in) :: place !! of the pad
    type(pad_type), intent(inout) :: pad !! whose contacts stay linearised where they are
    integer :: i

    if (.not. allocated(place%further_gap)) return
    do i = 1, size(pad%foil%contacts%point)
      associate (point => pad%foil%contacts%point(i))
        if (point%law == contact_top) point%gap = point%gap + place%further_gap(point%line, point%strip)
      end associate
    end do
    call pad%foil%contacts%linearise_again()
  end subroutine move_crests

  !> Gap at this rank's nodes [m].
  pure function pad_gap(self, point, unknown, modulus) result(gap)
    class(pad_type), intent(in) :: self !! the pad
    type(operating_point_type), intent(in) :: point !! the shaft's position
    real(wp), intent(in) :: unknown(:)              !! the pad's, in SI
    real(wp), intent(in) :: modulus(2)              !! of its foils, see `soften`
    real(wp) :: gap(size(self%mesh%mesh_node))

    gap = self%foil%deflection(unknown, modulus)
    if (allocated(self%held)) gap = gap + self%held
    gap = self%film%gap(point, gap)
  end function pad_gap

  !> All pressure that loads shaft and foil, the film's and the asperities', at this rank's nodes [Pa].
  pure function loading(self, unknown, gap) result(pressure)
    class(pad_type), intent(in) :: self !! the pad
    real(wp), intent(in) :: unknown(:) !! the pad's, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes [m]
    real(wp) :: pressure(size(gap))

    pressure = unknown(:size(gap))
    if (self%contact%present) pressure = pressure + self%solid_pressure(gap)
  end function loading

  !> Pressure of the asperities at this rank's nodes [Pa].
  pure function solid_pressure(self, gap) result(pressure)
    class(pad_type), intent(in) :: self !! the pad
    real(wp), intent(in) :: gap(:) !! at this rank's nodes, of ridges [m]
    real(wp) :: pressure(size(gap))

    pressure = contact_pressure(self%contact, gap)
    if (allocated(self%contact_share)) pressure = self%contact_share*pressure
  end function solid_pressure

  !> Its derivative by the gap [Pa/m].
  pure function solid_rate(self, gap) result(rate)
    class(pad_type), intent(in) :: self !! the pad
    real(wp), intent(in) :: gap(:) !! at this rank's nodes, of ridges [m]
    real(wp) :: rate(size(gap))

    rate = contact_pressure_rate(self%contact, gap)
    if (allocated(self%contact_share)) rate = self%contact_share*rate
  end function solid_rate

  !> This rank's share of the force on the sleeve and the torque on the shaft [N], [N m].
  pure function pad_force(self, unknown, gap) result(force)
    class(pad_type), intent(in) :: self !! the pad
    real(wp), intent(in) :: unknown(:) !! the pad's, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes [m]
    real(wp) :: force(film_forces)
    force = self%film%force(self%loading(unknown, gap))
  end function pad_force

  !> Sizes of the unknowns, in SI.
  pure function unknown_scale(self) result(scale)
    class(pad_type), intent(in) :: self !! the pad
    real(wp) :: scale(self%last - self%first)

    scale(:self%foil%first) = self%film%ambient_pressure
    scale(self%foil%first + 1:) = self%foil%unknown_scale
  end function unknown_scale

  !> Sizes of the equations at an operating point, in SI: a film equation is measured by the flow
  !> through a cell.
  pure function equation_scale(self, point) result(scale)
    class(pad_type), intent(in) :: self !! the pad
    type(operating_point_type), intent(in) :: point !! whose speed counts
    real(wp) :: scale(self%last - self%first)

    associate (film => self%film)
      scale(:self%foil%first) = merge(film%ambient_pressure, film%cell_flow(point), film%fixed)
      scale(self%foil%first + 1:) = self%foil%equation_scale
    end associate
  end function equation_scale

  !> Entries that the rows this rank owns need at most: film nodes around, and the foil.
  pure function row_entries(self) result(entries)
    class(pad_type), intent(in) :: self !! the pad
    PetscInt :: entries(self%mesh%owned_unknowns + self%foil%owned)

    entries(:self%mesh%owned_unknowns) = int((2*self%whole%order + 1)**2 + self%foil%couplings, pint)
    entries(self%mesh%owned_unknowns + 1:) = int(self%foil%row_entries, pint)
  end function row_entries
end module gfb_pad
