#include "gfb_petsc.h"
!> What the film needs to know of the foil under it, whatever the foil is.
!>
!> A foil has unknowns of its own, or none. Its deflection at each film node follows from one
!> unknown of the bearing: \( h_f = r (x - x_0) \). It adds its equations to those of the film.
!>
!> By itself it is the foil that does not move: it has no unknowns, equations or surfaces. A model that has some
!> replaces what is said of them; a new one reads the list of procedures. Contacts are the same in every model.
module gfb_foil_model
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_cost_events, only: cost_events_type
  use gfb_bump_contacts, only: contact_top
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_surface, only: foil_surface_type, surface_motion_type
  use gfb_condensed_piece, only: condensed_piece_type
  implicit none (type)
  private
  public :: create_rigid_foil

  !> A foil model: deflection at the film nodes, equations, their derivatives. A rigid one.
  type, public :: foil_model_type
    integer :: owned = 0      !! unknowns of the foil this rank owns
    integer :: owned_top = 0  !! of these the top foil's, where both are meshed: the first ones
    integer :: first = 0      !! local unknowns of the bearing before the foil's first
    integer :: couplings = 0  !! entries a film node's row needs for the foil, at most
    integer, allocatable :: row_entries(:) !! entries that the row of each owned unknown needs, at most
    logical :: elastic_loses = .true. !! its loss factor is that of `elastic`, too, not of springs alone
    Mat :: elastic            !! matrix of its linear equations, where it is meshed; the foil's own numbers [SI]
    type(cost_events_type) :: events !! of PETSc's log
    integer, allocatable :: global_unknown(:)  !! foil's own number of each local unknown, by owners
    real(wp), allocatable :: unknown_scale(:)  !! size of each local unknown, in its unit
    real(wp), allocatable :: equation_scale(:) !! size of each local equation, in its unit
    !> Local unknown of the bearing that moves a film node, 0 where none does; until the foil's
    !> unknowns are placed, those of its own stand as negative numbers.
    integer, allocatable :: source(:)
    real(wp), allocatable :: rate(:)           !! r, deflection over that unknown
    real(wp), allocatable :: origin(:)         !! x_0, the unknown's value without deflection
    type(contact_set_type) :: contacts         !! this rank's; their unknowns are the local foil unknowns
    real(wp) :: first_hardness = 1.0_wp        !! factor of their stiffness that a first answer begins with
    integer :: crests = 0                      !! of the pad whose forces are counted
    real(wp) :: modulus(2) = 1.0_wp            !! Young's, of top foil and bumps, over those that the foil was built with [1]
  contains
    procedure :: add_residual, add_jacobian, add_constant, add_load_rates, estimate, is_meshed, soften, add_modulus_rates
    procedure, non_overridable :: has_local_springs
    procedure :: create_coarse_motions, add_mass, natural_numbers, surfaces, own_unknown, motions, nodal_contacts, sizes
    procedure :: destroy, place, local_unknowns, own_part, deflection, has_contacts, settle
    procedure :: begin_step, settle_at, commit, add_springs, put_damping, softest, crest_lengths
    procedure :: next_contact_change, add_penetration_rates, line_forces, moves_against_mirror
  end type foil_model_type

contains

  !> A rigid surface under a film.
  subroutine create_rigid_foil(nodes, foil)
    integer, intent(in) :: nodes !! film nodes of this rank
    type(foil_model_type), intent(out) :: foil !! without unknowns

    allocate (foil%global_unknown(0), foil%unknown_scale(0), foil%equation_scale(0))
    allocate (foil%row_entries(0))
    allocate (foil%source(nodes), source=0)
    allocate (foil%rate(nodes), foil%origin(nodes), source=0.0_wp)
  end subroutine create_rigid_foil

  !> Adds the foil's equations to the local residual of the bearing.
  subroutine add_residual(self, unknown, residual)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:)     !! local unknowns of the bearing, in SI
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
  end subroutine add_residual

  !> Adds the derivatives of the foil's equations to the bearing's matrix, by local numbers.
  subroutine add_jacobian(self, unknown, jacobian)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
  end subroutine add_jacobian

  !> Adds what never changes in the foil's part of the matrix, beside `elastic`, and makes room for
  !> what does.
  subroutine add_constant(self, jacobian)
    class(foil_model_type), intent(in) :: self !! the foil
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
  end subroutine add_constant

  !> Adds what the foil's equations gain where more than the film loads it: a pressure at each film
  !> node that depends on some unknowns of the bearing.
  subroutine add_load_rates(self, column, slope, jacobian)
    class(foil_model_type), intent(in) :: self !! the foil
    integer, intent(in) :: column(:, :) !! (3 or 5, film nodes) local numbers from 0; negative: none
    real(wp), intent(in) :: slope(:, :) !! (3 or 5, film nodes) of the pressure by these unknowns [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
  end subroutine add_load_rates

  !> Gives the foils other moduli; `elastic` stays that of those that they were built with.
  subroutine soften(self, modulus)
    class(foil_model_type), intent(inout) :: self !! the foil
    real(wp), intent(in) :: modulus(2) !! of top foil and bumps, over those they were built with [1]
    self%modulus = modulus
  end subroutine soften

  !> Adds the derivatives of the foil's equations by the moduli of top foil and bumps. All ranks ask.
  subroutine add_modulus_rates(self, unknown, rate)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), intent(inout) :: rate(:, :) !! (local unknowns of the bearing, 2) [SI]
  end subroutine add_modulus_rates

  !> Sets the foil's local unknowns to what suits the film's pressures, as a start value.
  subroutine estimate(self, unknown)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(inout) :: unknown(:) !! local unknowns of the bearing, in SI
  end subroutine estimate

  !> Whether top foil and bumps have meshes of their own: the matrix `elastic`, spread over all
  !> ranks, equations that are forces, and edges that can lift.
  pure logical function is_meshed(self) result(meshed)
    class(foil_model_type), intent(in) :: self !! the foil
    meshed = .false.
  end function is_meshed

  !> Whether a node's pressure moves the foil there, as springs do that have no unknowns.
  pure logical function has_local_springs(self) result(has)
    class(foil_model_type), intent(in) :: self !! the foil, placed
    integer :: node
    has = any(self%source == [(node, node=1, size(self%source))])
  end function has_local_springs

  !> Whether unknowns of the foil move where the pressures of one half of the width change against those of the other: not
  !> springs that have none, and not what feels the mean pressure across the width. On half the width such a motion has
  !> supports of its own at z = 0, so it takes a foil of its own.
  pure logical function moves_against_mirror(self) result(moves)
    class(foil_model_type), intent(in) :: self !! the foil
    moves = .false.
  end function moves_against_mirror

  !> The coarse space of an iterative solver, in the foil's own numbers and scaled unknowns; says whether there is one.
  subroutine create_coarse_motions(self, motions, has)
    class(foil_model_type), intent(in) :: self !! the foil
    Mat, intent(out) :: motions !! (unknowns, motions)
    logical, intent(out) :: has !! the foil is of shells, none of them condensed
    has = .false.
  end subroutine create_coarse_motions

  !> Adds the consistent mass of all that is not condensed, in the foil's own numbers, and lists the
  !> condensed pieces of this rank. The scene gives densities.
  !>
  !> Fails where an element is degenerate.
  subroutine add_mass(self, mass, piece, error)
    class(foil_model_type), intent(in) :: self !! the foil
    Mat, intent(in) :: mass !! like `elastic`, not assembled yet [kg] between displacements
    type(condensed_piece_type), allocatable, intent(out) :: piece(:) !! one a kind
    type(error_type), allocatable, intent(out) :: error !! why it failed
    allocate (piece(0))
  end subroutine add_mass

  !> Natural numbers, from 1, of the foil's unknowns this rank owns, in the order of the vectors:
  !> they do not depend on how many ranks there are. All ranks ask.
  function natural_numbers(self) result(number)
    class(foil_model_type), intent(in) :: self !! the foil
    integer, allocatable :: number(:)
    allocate (number(0))
  end function natural_numbers

  !> The surfaces that are meshed, this rank's part of each; none where nothing is.
  function surfaces(self) result(list)
    class(foil_model_type), intent(in) :: self !! the foil
    type(foil_surface_type), allocatable :: list(:)
    allocate (list(0))
  end function surfaces

  !> Local foil unknown of a degree of freedom at one of this rank's own nodes; 0: fixed, or
  !> condensed.
  pure integer function own_unknown(self, surface, component, node) result(number)
    class(foil_model_type), intent(in) :: self !! the foil
    integer, intent(in) :: surface   !! which of `surfaces`
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node      !! of the surface's whole mesh
    number = 0
  end function own_unknown

  !> Displacements and stresses of each of `surfaces`. All ranks ask.
  function motions(self, unknown, modulus) result(list)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), intent(in) :: modulus(2) !! see `soften`
    type(surface_motion_type), allocatable :: list(:)
    allocate (list(0))
  end function motions

  !> This rank's contacts, each of one node of the surface that has them.
  function nodal_contacts(self) result(contacts)
    class(foil_model_type), intent(in) :: self !! the foil
    type(contact_set_type) :: contacts
    contacts = self%contacts
  end function nodal_contacts

  !> Sizes that the summary shows.
  function sizes(self) result(list)
    class(foil_model_type), intent(in) :: self !! the foil
    type(quantity_type), allocatable :: list(:)
    allocate (list(0))
  end function sizes

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy(self)
    class(foil_model_type), intent(inout) :: self !! the foil
  end subroutine destroy

  !> Gives the foil the places of its unknowns among those of the bearing.
  pure subroutine place(self, first)
    class(foil_model_type), intent(inout) :: self !! the foil
    integer, intent(in) :: first !! local unknowns before the foil's first

    self%first = first
    if (.not. allocated(self%contacts%point)) allocate (self%contacts%point(0)) ! none
    where (self%source < 0) self%source = first - self%source
  end subroutine place

  !> Unknowns of the foil that this rank's nodes and equations need.
  pure integer function local_unknowns(self) result(unknowns)
    class(foil_model_type), intent(in) :: self !! the foil
    unknowns = size(self%global_unknown)
  end function local_unknowns

  !> The foil's part of the bearing's local unknowns.
  pure function own_part(self, unknown) result(part)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), allocatable :: part(:)
    part = unknown(self%first + 1:self%first + self%local_unknowns())
  end function own_part

  !> Deflection at the local film nodes, positive away from the shaft [m].
  pure function deflection(self, unknown, modulus) result(moved)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), intent(in), optional :: modulus(2) !! default: those that it has, see `soften`
    real(wp) :: moved(size(self%source))
    integer :: node

    moved = 0.0_wp
    do node = 1, size(moved)
      if (self%source(node) == 0) cycle
      moved(node) = self%rate(node)*(unknown(self%source(node)) - self%origin(node))
    end do
  end function deflection

  !> Whether the foil has contacts, on whatever rank: they open, close and rub.
  pure logical function has_contacts(self) result(has)
    class(foil_model_type), intent(in) :: self !! the foil
    has = allocated(self%contacts%law)
  end function has_contacts

  !> Moves every contact's linearisation point to where the foils are now.
  subroutine settle(self, unknown, moved, settled)
    class(foil_model_type), intent(inout) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    logical, intent(out) :: moved      !! there are contacts
    logical, intent(out) :: settled    !! each of this rank is linearised where it is
    PetscErrorCode :: ierr

    moved = self%has_contacts()
    settled = .true.
    if (.not. moved) return
    PetscCallA(PetscLogEventBegin(self%events%contact, ierr))
    call self%contacts%settle(self%own_part(unknown))
    PetscCallA(PetscLogEventEnd(self%events%contact, ierr))
    settled = self%contacts%settled
  end subroutine settle

  !> A new Newton step begins where the contacts are.
  subroutine begin_step(self)
    class(foil_model_type), intent(inout) :: self !! the foil
    call self%contacts%drop_anchor()
  end subroutine begin_step

  !> Linearises the contacts at a state that was an answer, whatever was tried since.
  subroutine settle_at(self, unknown)
    class(foil_model_type), intent(inout) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    call self%contacts%settle_at(self%own_part(unknown))
  end subroutine settle_at

  !> Ends a load step of the scene: friction carries its slip along.
  subroutine commit(self, unknown)
    class(foil_model_type), intent(inout) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    call self%contacts%commit(self%own_part(unknown))
  end subroutine commit

  !> Adds the stiffness of springs that have unknowns of their own, and no mesh: here none.
  subroutine add_springs(self, matrix)
    class(foil_model_type), intent(in) :: self !! the foil
    Mat, intent(in) :: matrix !! of the bearing, by local numbers
  end subroutine add_springs

  !> Over a step of time dampers add a drag times h_f, and a pull, to the pressure of springs: here there are none.
  subroutine put_damping(self, drag, pull)
    class(foil_model_type), intent(inout) :: self !! the foil
    real(wp), intent(in) :: drag !! [N/m3]
    real(wp), intent(in) :: pull(:) !! what earlier deflections add, at the local unknown that moves a spring [Pa]
  end subroutine put_damping

  !> The hardness to begin with: bumps that float between open and closed find their state at once; 1
  !> where there is nothing to soften.
  pure function softest(self) result(hardness)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp) :: hardness !! [1]
    hardness = self%first_hardness
  end function softest

  !> Length of this rank's crest lines that touches nothing, and of all of them [m].
  pure function crest_lengths(self) result(length)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp) :: length(2)
    integer :: i

    length = 0.0_wp
    do i = 1, size(self%contacts%point)
      associate (point => self%contacts%point(i))
        if (point%law /= contact_top) cycle
        length(2) = length(2) + point%length
        if (self%contacts%is_open(i)) length(1) = length(1) + point%length
      end associate
    end do
  end function crest_lengths

  !> This rank's share of the forces with which the crests of one number push the top foil, those of all strips together; none
  !> where they are not counted.
  function line_forces(self, unknown) result(force)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the pad, in SI
    real(wp), allocatable :: force(:) !! [N]
    real(wp), allocatable :: own(:)
    integer :: i

    allocate (force(self%crests), source=0.0_wp)
    if (self%crests == 0) return
    own = self%own_part(unknown)
    do i = 1, size(self%contacts%point)
      associate (point => self%contacts%point(i))
        if (point%law /= contact_top) cycle
        force(point%line) = force(point%line) + self%contacts%pressing_force(i, own)
      end associate
    end do
  end function line_forces

  !> The fraction of the path between two states, or on beyond, after which the first of this rank's
  !> contacts opens or closes; huge where none does.
  pure function next_contact_change(self, here, ahead) result(fraction)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: here(:), ahead(:) !! local unknowns of the bearing, in SI
    real(wp) :: fraction                      !! [1]
    integer :: i

    fraction = huge(fraction)
    associate (now => self%own_part(here), next => self%own_part(ahead))
      do i = 1, size(self%contacts%point)
        fraction = min(fraction, self%contacts%next_change(i, now, next))
      end do
    end associate
  end function next_contact_change

  !> Adds up, for those contacts that change after that fraction of the path, all those of a symmetric
  !> foil at once, the derivatives of their penetrations by the bearing's local unknowns, with the sign
  !> of their change; and how far they move before they change state.
  pure subroutine add_penetration_rates(self, here, ahead, fraction, rate, distance, closes)
    class(foil_model_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: here(:), ahead(:) !! local unknowns of the bearing, in SI
    real(wp), intent(in) :: fraction               !! of the path, to the first change [1]
    real(wp), intent(inout) :: rate(:)        !! by each local unknown [1]
    real(wp), intent(inout) :: distance       !! sum of the penetrations' sizes [m]
    logical, intent(inout) :: closes          !! one of them closes
    real(wp), parameter :: together = 1.0e-6_wp !! relative
    real(wp) :: first(3)
    integer :: i, last

    last = self%first + self%local_unknowns()
    associate (mine => rate(self%first + 1:last), now => self%own_part(here), &
               next => self%own_part(ahead))
      do i = 1, size(self%contacts%point)
        if (self%contacts%next_change(i, now, next) > (1.0_wp + together)*fraction) cycle
        first = self%contacts%approach(i, now)
        call self%contacts%add_penetration_rate(i, -sign(1.0_wp, first(3)), mine)
        distance = distance + abs(first(3))
        closes = closes .or. first(3) < 0.0_wp
      end do
    end associate
  end subroutine add_penetration_rates
end module gfb_foil_model
