#include "gfb_petsc.h"
!> From a scene to its equations on a mesh.
module gfb_bearing_builder
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_bearing_case, only: pad_angle, leading_edge_periodic
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_model_case, only: model_case_type, foil_rigid, foil_elastic_foundation, foil_shell, &
                            foil_beam, meshes_foils, foundation_pressure_axial_mean, reduction_guyan
  use gfb_bump_stiffness, only: walowit_anno_stiffness
  use gfb_film_mesh, only: film_mesh_type, uniform_film_mesh, film_mesh_at
  use gfb_foil_builder, only: plate_stations, shape_on_pad
  use gfb_partition, only: division_type, divide, no_chain
  use gfb_part_chains, only: film_chain, film_columns, strip_chain
  use gfb_petsc_session, only: rank_count
  use gfb_solid_contact, only: solid_contact_type
  use gfb_shell_foil, only: shell_foil_type
  use gfb_shell_foil_builder, only: create_shell_foil
  use gfb_beam_foil, only: beam_foil_type
  use gfb_beam_foil_builder, only: create_beam_foil
  use gfb_foil_model, only: foil_model_type
  use gfb_rigid_foil, only: rigid_foil_type, create_rigid_foil
  use gfb_foundation_foil, only: foundation_foil_type, create_local_foundation, &
                                 create_mean_foundation
  use gfb_operating_point, only: operating_point_type
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_bearing_system, only: bearing_system_type, create_film_part, create_bearing_system
  implicit none (type)
  private
  public :: build_bearing, divide_bearing, film_mesh_of, operating_point, foundation_stiffness

  !> What the program decided about a scene, and the mesh it asks for.
  type, public :: bearing_plan_type
    integer :: circumferential = 0 !! film elements along the motion
    integer :: axial = 0           !! film elements along the whole width
    logical :: half = .false.      !! half the width is solved
    logical :: upwind = .false.    !! SUPG instead of Galerkin
    logical :: may_upwind = .false. !! SUPG is allowed where Galerkin finds no answer
    logical :: floats = .false.    !! the shaft's position is unknown
    logical :: may_coarsen = .true. !! coarser meshes may find the way
    integer :: order = 1           !! of film elements: bilinear, biquadratic
    real(wp) :: memory = 0.0_wp    !! that the equations take, about [B]
  end type bearing_plan_type

contains

  !> The equations of a scene on a mesh of given size.
  !>
  !> Fails when the mesh cannot be cut into parts.
  subroutine build_bearing(scene, plan, bearing, error)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_system_type), intent(inout) :: bearing
    type(error_type), allocatable, intent(out) :: error

    class(foil_model_type), allocatable :: foil
    type(division_type) :: division

    call enter_stage('set-up')
    call divide_bearing(scene, film_mesh_of(scene, plan), rank_count(), division, error)
    if (allocated(error)) return
    call create_film_part(film_mesh_of(scene, plan), scene%bearing%clearance, scene%gas%ambient_pressure, &
                          scene%gas%viscosity, plan%upwind, bearing, error, division%film)
    if (allocated(error)) return
    bearing%point = operating_point(scene%operation)
    associate (contact => scene%shaft_contact)
      bearing%contact = solid_contact_type(contact%present, contact%roughness, contact%pressure, contact%friction)
    end associate
    call create_foil(scene, bearing, division, foil, error)
    if (allocated(error)) return
    call create_bearing_system(bearing, foil, plan%floats)
    call leave_stage()
  end subroutine build_bearing

  !> The parts of film and foils: what touches belongs to one part.
  !>
  !> Fails when METIS does.
  subroutine divide_bearing(scene, film, parts, division, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    integer, intent(in) :: parts
    type(division_type), intent(out) :: division
    type(error_type), allocatable, intent(out) :: error

    if (scene%model%foil == foil_shell) then
      call divide(film_chain(film, .true.), strip_chain(shape_on_pad(scene), film%rows(), &
                                                        scene%model%reduction == reduction_guyan), parts, division, error)
    else
      call divide(film_chain(film, .false.), no_chain(), parts, division, error)
    end if
    if (.not. allocated(error)) division%film = film_columns(film, division%film)
  end subroutine divide_bearing

  !> The film's mesh: equal elements, or stations above the crests.
  function film_mesh_of(scene, plan) result(mesh)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(film_mesh_type) :: mesh

    associate (bearing => scene%bearing)
      if (meshes_foils(scene%model%foil) .and. scene%mesh%align_crests) then
        mesh = film_mesh_at(bearing%leading_edge_angle + plate_stations(scene)/bearing%radius, bearing%radius, &
                            bearing%length, plan%axial, plan%half, plan%order)
      else
        mesh = uniform_film_mesh(bearing%radius, bearing%length, bearing%leading_edge_angle, &
                                 pad_angle(bearing), plan%circumferential, plan%axial, &
                                 bearing%leading_edge_condition == leading_edge_periodic, plan%half, plan%order)
      end if
    end associate
  end function film_mesh_of

  !> The foil model the scene asks for.
  !>
  !> Fails where an element of a foil is degenerate.
  subroutine create_foil(scene, bearing, division, foil, error)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing !! with its film
    type(division_type), intent(in) :: division      !! of film and bumps
    class(foil_model_type), allocatable, intent(out) :: foil
    type(error_type), allocatable, intent(out) :: error

    type(shell_foil_type), allocatable :: shells
    type(beam_foil_type), allocatable :: beams
    type(rigid_foil_type), allocatable :: rigid
    type(foundation_foil_type), allocatable :: foundation
    integer :: rank, ranks
    PetscErrorCode :: ierr

    select case (scene%model%foil)
    case (foil_rigid)
      allocate (rigid)
      call create_rigid_foil(size(bearing%mesh%mesh_node), rigid)
      call move_alloc(rigid, foil)
    case (foil_elastic_foundation)
      allocate (foundation)
      if (scene%model%foundation_pressure == foundation_pressure_axial_mean) then
        call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
        call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
        call create_mean_foundation(bearing%whole, bearing%mesh, rank, ranks, &
                                    foundation_stiffness(scene%model, scene%bump_foil), &
                                    scene%gas%ambient_pressure, scene%bearing%clearance, foundation)
      else
        call create_local_foundation(size(bearing%mesh%mesh_node), &
                                     foundation_stiffness(scene%model, scene%bump_foil), &
                                     scene%gas%ambient_pressure, foundation)
      end if
      call move_alloc(foundation, foil)
    case (foil_shell)
      allocate (shells)
      call create_shell_foil(scene, bearing%whole, bearing%mesh, bearing%film%element_nodes, division, &
                             scene%model%reduction == reduction_guyan, shells, error)
      if (allocated(error)) return
      call move_alloc(shells, foil)
    case (foil_beam)
      allocate (beams)
      call create_beam_foil(scene, bearing%whole, bearing%mesh, bearing%film%element_nodes, beams)
      call move_alloc(beams, foil)
    case default
      error stop 'a foil model without equations'
    end select
  end subroutine create_foil

  !> Stiffness of the foundation, as given or by Walowit and Anno [N/m3].
  pure function foundation_stiffness(model, bump_foil) result(stiffness)
    type(model_case_type), intent(in) :: model
    type(bump_foil_case_type), intent(in) :: bump_foil
    real(wp) :: stiffness

    stiffness = model%foundation_stiffness
    if (stiffness > 0.0_wp) return
    stiffness = walowit_anno_stiffness(bump_foil%youngs_modulus, bump_foil%poissons_ratio, &
                                       bump_foil%thickness, bump_foil%half_length, bump_foil%pitch)
  end function foundation_stiffness

  !> Where the scene puts the shaft, in SI.
  pure function operating_point(operation) result(point)
    type(operation_case_type), intent(in) :: operation
    type(operating_point_type) :: point

    point%speed = angular_speed(operation%speed_rpm)
    point%load = operation%load
    point%eccentricity = operation%eccentricity
    point%tilt = operation%tilt
  end function operating_point
end module gfb_bearing_builder
