!> What shells and beams under a film have in common when they are built: meshes, laws of the
!> contacts, places of the unknowns, pressure, sizes.
module gfb_foil_places
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: bump_stiffness
  use gfb_bearing_case, only: pad_length
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_foil_mesh, only: top_foil_mesh
  use gfb_bump_contacts, only: set_contact_laws
  use gfb_shell_foil, only: shell_foil_type
  implicit none (type, external)
  private
  public :: top_mesh, set_laws, list_wanted, place_unknowns, add_pressure, size_unknowns

  integer, parameter :: radial = 2, axial = 3 !! components of a displacement
  integer, parameter :: corners = 4
  real(wp), parameter :: soft_contact = 20.0_wp !! stiffness to begin with, over a bump's

contains

  !> The top foil on the film's nodes; its mid-surface lies above the crests' by half of both
  !> thicknesses.
  pure function top_mesh(scene, film) result(mesh)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(quad_mesh_type) :: mesh

    mesh = top_foil_mesh(film%radius*(film%station_angle - film%station_angle(1)), scene%bump_foil%height + &
                         0.5_wp*(scene%bump_foil%thickness + scene%top_foil%thickness), film%row_axial, film%half)
  end function top_mesh

  !> Laws of the contacts, and how soft they begin.
  subroutine set_laws(scene, foil)
    type(scene_type), intent(in) :: scene
    class(shell_foil_type), intent(inout) :: foil
    real(wp) :: stiffness !! of a bump, per length of line [N/m2]

    stiffness = bump_stiffness(scene%bump_foil)*scene%bump_foil%pitch
    call set_contact_laws(scene, scene%bearing%clearance, foil%contacts)
    foil%first_hardness = min(1.0_wp, soft_contact*stiffness/(scene%contact%normal_stiffness* &
                              foil%contacts%secant_penetration**(scene%contact%exponent - 1.0_wp)))
  end subroutine set_laws

  !> Marks the foil's unknowns that this rank needs.
  subroutine list_wanted(foil, mesh, first, wanted)
    class(shell_foil_type), intent(in) :: foil
    type(local_mesh_type), intent(in) :: mesh
    integer, intent(in) :: first !! foil's unknowns of the ranks before this one
    logical, allocatable, intent(out) :: wanted(:) !! by the foil's own numbers
    integer :: i

    allocate (wanted(0:foil%top%unknowns + foil%bumps%unknowns), source=.false.)
    wanted(first + 1:first + foil%owned) = .true.
    call mark(foil%top_number(radial, mesh%mesh_node), wanted)
    do i = 1, size(foil%contacts%point)
      call mark(foil%contacts%point_unknowns(i), wanted)
    end do
    wanted(0) = .false.
  end subroutine list_wanted

  !> Marks numbers in a list.
  pure subroutine mark(number, marked)
    integer, intent(in) :: number(:)
    logical, intent(inout) :: marked(0:)
    integer :: i

    do i = 1, size(number)
      marked(number(i)) = .true.
    end do
  end subroutine mark

  !> Gives the needed unknowns their places, and the contacts and film nodes theirs.
  subroutine place_unknowns(foil, mesh, first, wanted)
    class(shell_foil_type), intent(inout) :: foil
    type(local_mesh_type), intent(in) :: mesh
    integer, intent(in) :: first
    logical, intent(in) :: wanted(0:)
    integer :: place(0:ubound(wanted, 1)), i, k

    foil%global_unknown = pack([(i, i=0, ubound(wanted, 1))], wanted)
    place = 0
    do i = 1, size(foil%global_unknown)
      place(foil%global_unknown(i)) = i
    end do
    foil%own_place = place(first + 1:first + foil%owned)
    foil%source = -place(foil%top_number(radial, mesh%mesh_node))
    allocate (foil%rate(size(foil%source)), source=-1.0_wp)
    allocate (foil%origin(size(foil%source)), source=0.0_wp)
    do i = 1, size(foil%contacts%point)
      associate (point => foil%contacts%point(i))
        point%slave = place(point%slave)
        do k = 1, size(point%share)
          point%master(:, k) = place(point%master(:, k))
        end do
      end associate
    end do
    foil%contacts%global = foil%global_unknown
  end subroutine place_unknowns

  !> Weights of the nodal pressures in the forces on the top foil, [Gu2020] eq. 2.
  subroutine add_pressure(film, mesh, element_nodes, foil)
    type(film_mesh_type), intent(in) :: film
    type(local_mesh_type), intent(in) :: mesh
    integer, intent(in) :: element_nodes(:, :) !! (4, elements), local nodes
    class(shell_foil_type), intent(inout) :: foil

    real(wp), parameter :: bilinear(corners, corners) = reshape([ &
      4.0_wp, 2.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 4.0_wp, 2.0_wp, 1.0_wp, &
      1.0_wp, 2.0_wp, 4.0_wp, 2.0_wp, 2.0_wp, 1.0_wp, 2.0_wp, 4.0_wp], [corners, corners])/36.0_wp
    integer :: i, station(corners), row(corners)
    real(wp) :: area

    foil%pressed = element_nodes
    allocate (foil%pushed(corners, size(element_nodes, 2)))
    allocate (foil%weight(corners, corners, size(element_nodes, 2)))
    do i = 1, size(element_nodes, 2)
      foil%pushed(:, i) = -foil%source(element_nodes(:, i))
      station = (mesh%mesh_node(element_nodes(:, i)) - 1)/film%rows() + 1
      row = modulo(mesh%mesh_node(element_nodes(:, i)) - 1, film%rows()) + 1
      area = film%radius*(maxval(film%station_angle(station)) - minval(film%station_angle(station)))* &
             (maxval(film%row_axial(row)) - minval(film%row_axial(row)))
      foil%weight(:, :, i) = area*bilinear
    end do
  end subroutine add_pressure

  !> Sizes of displacements and forces.
  subroutine size_unknowns(scene, film, foil, wanted)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    class(shell_foil_type), intent(inout) :: foil
    logical, intent(in) :: wanted(0:)
    logical :: turns(0:ubound(wanted, 1))
    real(wp) :: force, scale(0:ubound(wanted, 1))

    turns = .false.
    call mark(pack(foil%top_number(axial + 1:, :), .true.), turns)
    call mark(pack(foil%bump_number(axial + 1:, :), .true.), turns)
    scale = merge(scene%bump_foil%half_length, 1.0_wp, turns)
    force = scene%gas%ambient_pressure*pad_length(scene%bearing)/film%circumferential()* &
            scene%bearing%length/scene%mesh%axial_elements
    foil%unknown_scale = scene%bearing%clearance/scale(foil%global_unknown)
    foil%equation_scale = force*scale(foil%global_unknown)
  end subroutine size_unknowns
end module gfb_foil_places
