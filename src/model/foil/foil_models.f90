!> The list of foil models: what each word of `&model foil` builds.
!>
!> The words and what they mean are the rows of `gfb_model_case`. A new model is a row there, a type
!> of its own that extends `foil_model_type`, which is the rigid one, and a case here.
module gfb_foil_models
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_foil_model, only: foil_model_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_rigid, foil_elastic_foundation, foil_shell, foil_beam
  use gfb_film_mesh, only: film_mesh_type
  use gfb_partition, only: division_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_foundation_foil, only: foundation_foil_type, build_foundation
  use gfb_shell_foil, only: shell_foil_type, create_shell_foil
  use gfb_beam_foil, only: beam_foil_type, create_beam_foil
  implicit none (type, external)
  private
  public :: create_rigid_foil, build_foil

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

  !> The foil model that a scene asks for, under its film.
  !>
  !> Fails where an element of a foil is degenerate.
  subroutine build_foil(scene, film, mesh, element_nodes, division, foil, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh   !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)  !! (nodes, elements) its elements, local nodes
    type(division_type), intent(in) :: division !! of film and bumps
    !> of the model asked for, ready for the bearing
    class(foil_model_type), allocatable, intent(out) :: foil
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    type(foil_model_type), allocatable :: rigid
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
