#include "gfb_petsc.h"
!> The list of foil models: what each word of `&model foil` builds.
!>
!> The words and what they mean are the rows of `gfb_model_case`. A new model is a row there, a type
!> of its own that extends `foil_model_type`, and a case here.
module gfb_foil_models
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_surface, only: foil_surface_type, surface_motion_type
  use gfb_condensed_piece, only: condensed_piece_type
  use gfb_foil_model, only: foil_model_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_rigid, foil_elastic_foundation, foil_shell, foil_beam
  use gfb_film_mesh, only: film_mesh_type
  use gfb_partition, only: division_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_foundation_foil, only: foundation_foil_type, build_foundation
  use gfb_shell_foil, only: shell_foil_type, create_shell_foil
  use gfb_beam_foil, only: beam_foil_type, create_beam_foil
  implicit none (type)
  private
  public :: create_rigid_foil, build_foil

  !> The foil that does not move.
  type, extends(foil_model_type), public :: rigid_foil_type
  contains
    procedure :: add_residual => rigid_residual
    procedure :: add_jacobian => rigid_jacobian
    procedure :: estimate => rigid_estimate
    procedure :: add_load_rates => rigid_load_rates
    procedure :: add_constant => rigid_constant
    procedure :: is_meshed => rigid_is_meshed
    procedure :: add_mass => rigid_mass
    procedure :: natural_numbers => rigid_natural_numbers
    procedure :: surfaces => rigid_surfaces
    procedure :: own_unknown => rigid_own_unknown
    procedure :: motions => rigid_motions
    procedure :: nodal_contacts => rigid_contacts
    procedure :: sizes => rigid_sizes
    procedure :: destroy => rigid_destroy
  end type rigid_foil_type

contains

  !> A rigid surface under a film.
  subroutine create_rigid_foil(nodes, foil)
    integer, intent(in) :: nodes !! film nodes of this rank
    type(rigid_foil_type), intent(out) :: foil !! without unknowns

    allocate (foil%global_unknown(0), foil%unknown_scale(0), foil%equation_scale(0))
    allocate (foil%row_entries(0))
    allocate (foil%source(nodes), source=0)
    allocate (foil%rate(nodes), foil%origin(nodes), source=0.0_wp)
  end subroutine create_rigid_foil

  !> Nothing to add: the surface has no equations.
  subroutine rigid_residual(self, unknown, residual)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
  end subroutine rigid_residual

  !> Nothing to add: the surface has no equations.
  subroutine rigid_jacobian(self, unknown, jacobian)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
  end subroutine rigid_jacobian

  !> Nothing to estimate: the surface has no unknowns.
  subroutine rigid_estimate(self, unknown)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    real(wp), intent(inout) :: unknown(:) !! local unknowns of the bearing [SI]
  end subroutine rigid_estimate

  !> Nothing to add: the surface has no equations.
  subroutine rigid_load_rates(self, column, slope, jacobian)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    integer, intent(in) :: column(:, :) !! (3, film nodes) local numbers from 0; negative: none
    real(wp), intent(in) :: slope(:, :) !! (3, film nodes) of the pressure by these unknowns [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
  end subroutine rigid_load_rates

  !> Nothing of the matrix is constant and elastic.
  subroutine rigid_constant(self, jacobian)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
  end subroutine rigid_constant

  !> No mesh of its own.
  pure function rigid_is_meshed(self) result(meshed)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    logical :: meshed
    meshed = .false.
  end function rigid_is_meshed

  !> Nothing weighs: the surface does not move.
  subroutine rigid_mass(self, mass, piece, error)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    Mat, intent(in) :: mass !! of the foil [kg]
    type(condensed_piece_type), allocatable, intent(out) :: piece(:) !! none
    type(error_type), allocatable, intent(out) :: error !! never
    allocate (piece(0))
  end subroutine rigid_mass

  !> No unknowns, no numbers.
  function rigid_natural_numbers(self) result(number)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    integer, allocatable :: number(:)
    allocate (number(0))
  end function rigid_natural_numbers

  !> No surfaces.
  function rigid_surfaces(self) result(list)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    type(foil_surface_type), allocatable :: list(:)
    allocate (list(0))
  end function rigid_surfaces

  !> No surface has an unknown.
  pure function rigid_own_unknown(self, surface, component, node) result(number)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    integer, intent(in) :: surface !! which of `surfaces`
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node !! of the surface's whole mesh
    integer :: number
    number = 0
  end function rigid_own_unknown

  !> No surfaces, no motions.
  function rigid_motions(self, unknown) result(list)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    type(surface_motion_type), allocatable :: list(:)
    allocate (list(0))
  end function rigid_motions

  !> No contacts.
  function rigid_contacts(self) result(contacts)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    type(contact_set_type) :: contacts
    contacts = self%contacts
  end function rigid_contacts

  !> No sizes to show.
  function rigid_sizes(self) result(list)
    class(rigid_foil_type), intent(in) :: self !! the rigid foil
    type(quantity_type), allocatable :: list(:)
    allocate (list(0))
  end function rigid_sizes

  !> Nothing to free.
  subroutine rigid_destroy(self)
    class(rigid_foil_type), intent(inout) :: self !! the rigid foil
  end subroutine rigid_destroy

  !> The foil model that a scene asks for, under its film.
  !>
  !> Fails where an element of a foil is degenerate.
  subroutine build_foil(scene, film, mesh, element_nodes, division, foil, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh   !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)  !! (nodes, elements) its elements, local nodes
    type(division_type), intent(in) :: division !! of film and bumps
    class(foil_model_type), allocatable, intent(out) :: foil !! of the model asked for, ready for the bearing
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    type(rigid_foil_type), allocatable :: rigid
    type(foundation_foil_type), allocatable :: foundation
    type(shell_foil_type), allocatable :: shells
    type(beam_foil_type), allocatable :: beams

    select case (scene%model%foil)
    case (foil_rigid)
      allocate (rigid)
      call create_rigid_foil(size(mesh%mesh_node), rigid)
      call move_alloc(rigid, foil)
    case (foil_elastic_foundation)
      allocate (foundation)
      call build_foundation(scene, film, mesh, foundation)
      call move_alloc(foundation, foil)
    case (foil_shell)
      allocate (shells)
      call create_shell_foil(scene, film, mesh, element_nodes, division, shells, error)
      if (.not. allocated(error)) call move_alloc(shells, foil)
    case (foil_beam)
      allocate (beams)
      call create_beam_foil(scene, film, mesh, element_nodes, beams)
      call move_alloc(beams, foil)
    case default
      error stop 'a foil model that nothing builds'
    end select
  end subroutine build_foil
end module gfb_foil_models
