!> Strips of shells in plane strain: nothing moves along the axis, nothing turns about the tangent.
module planar_strips
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set
  use gfb_film_mesh, only: axial_rows
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_foil_mesh, only: strip_shape_type, bump_type, bump_strip_mesh, strip_substructures
  use gfb_substructures, only: substructure_type, find_kinds
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_assembly, only: create_foil_structure
  use gfb_contact_law, only: contact_law_type, law_coulomb
  use gfb_contact_point, only: contact_point_type
  use gfb_strip_system, only: strip_system_type
  use gfb_bump_contacts, only: contact_sleeve, contact_top, crest_name, line_shares
  use gfb_bump_chain, only: bump_chain_type, bump_chain_solution_type, solve_bump_chain
  use vibrating_strips, only: half_length, height, pitch, section
  implicit none (type, external)
  private
  public :: build_planar_strip, chain_of, solve_chain, flat_ends

  integer, parameter :: tangential = 1, radial = 2, axial = 3 !! components of a displacement
  integer, parameter :: about_tangent = 5                     !! rotation

  integer, parameter :: axial_elements = 2
  real(wp), parameter :: width = 1.0e-3_wp !! [m]

  ! So hard and so short that neither shows in the digits that are compared.
  real(wp), parameter :: normal_stiffness = 1.0e13_wp !! per metre of line [N/m^2]
  real(wp), parameter :: stick_length = 1.0e-10_wp    !! [m]

  !> A planar strip: bump 1's first corner is clamped, the last flat is free.
  type, public :: planar_case_type
    real(wp), allocatable :: pressure(:)     !! (bumps) on crests, times pitch and width [Pa]
    integer :: refinement = 1                !! of 12 elements an arc and 3 a flat
    logical :: held = .true.                 !! corners cannot leave the sleeve, and do not rub
    logical :: rigid_flats = .false.         !! flats between bumps do not stretch, as the chain's
    real(wp) :: friction_sleeve = 0.0_wp     !! mu, where they are not held [1]
    real(wp) :: friction_top = 0.0_wp        !! mu, of crests on an immobile plate [1]
  end type planar_case_type

contains

  !> The chain that is the same strip, and its crest forces.
  pure subroutine chain_of(planar, chain, force)
    type(planar_case_type), intent(in) :: planar
    type(bump_chain_type), intent(out) :: chain
    real(wp), allocatable, intent(out) :: force(:) !! (bumps) [N]

    chain = bump_chain_type(half_length=half_length, height=height, thickness=section%thickness, &
                            youngs_modulus=section%youngs_modulus, &
                            poissons_ratio=section%poissons_ratio, pitch=pitch, width=width, &
                            bumps=size(planar%pressure), &
                            friction_sleeve=planar%friction_sleeve, &
                            friction_top=planar%friction_top)
    force = planar%pressure*pitch*width
  end subroutine chain_of

  !> What the chain says of a strip.
  pure subroutine solve_chain(planar, answer)
    type(planar_case_type), intent(in) :: planar
    type(bump_chain_solution_type), intent(out) :: answer
    type(bump_chain_type) :: chain
    real(wp), allocatable :: force(:)

    call chain_of(planar, chain, force)
    call solve_bump_chain(chain, force, answer)
    if (.not. answer%converged) error stop 'a chain does not converge in a test'
  end subroutine solve_chain

  !> The strip without its equations and its load.
  subroutine build_planar_strip(planar, strip)
    type(planar_case_type), intent(in) :: planar
    type(strip_system_type), intent(out) :: strip
    real(wp), parameter :: interior_stiffness = 51.0e6_wp !! of a bump, about, per width [N/m^2]
    type(quad_mesh_type) :: mesh
    type(strip_shape_type) :: shape
    type(substructure_type), allocatable :: pieces(:)
    type(error_type), allocatable :: error
    logical, allocatable :: fixed(:, :)
    integer :: i

    shape%bump = [(bump_type(half_length, height, pitch), i=1, size(planar%pressure))]
    shape%begins = fixed_line_corner
    shape%arc_elements = 12*planar%refinement
    shape%flat_elements = 3*planar%refinement
    mesh = bump_strip_mesh(shape, axial_rows(width, axial_elements, .false., 1.0_wp), .false.)
    pieces = strip_substructures(shape, mesh)
    allocate (fixed(node_unknowns, size(mesh%position, 2)), source=.false.)
    fixed([axial, about_tangent], :) = .true.
    if (planar%held) fixed(radial, node_set(mesh, 'corners')) = .true.
    fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    call find_kinds(mesh, fixed, pieces)
    call create_foil_structure(mesh, section, fixed, pieces, .true., strip%foil, error)
    if (allocated(error)) error stop 'a wrong strip in a test'

    strip%scale%force = maxval(planar%pressure)*pitch*width/axial_elements
    strip%scale%length = maxval(planar%pressure)*pitch/interior_stiffness
    strip%scale%angle = strip%scale%length/half_length
    allocate (strip%contacts%law(contact_top), &
              source=contact_law_type(normal_stiffness=normal_stiffness, exponent=1.0_wp, &
                                      stick_length=stick_length, friction_law=law_coulomb, &
                                      one_way=.true.))
    strip%contacts%law(contact_sleeve)%friction = planar%friction_sleeve
    strip%contacts%law(contact_top)%friction = planar%friction_top
    strip%contacts%secant_penetration = 1.0e-4_wp*strip%scale%length
    strip%contacts%artificial_normal = 1.0e-7_wp*interior_stiffness
    call add_contacts(planar, strip)
  end subroutine build_planar_strip

  !> Nodes at both ends of the flats between bumps.
  pure function flat_ends(mesh) result(ends)
    type(quad_mesh_type), intent(in) :: mesh
    integer, allocatable :: ends(:, :, :) !! (rows, 2, flats)
    integer, allocatable :: corners(:)

    corners = node_set(mesh, 'corners')
    corners = corners(mesh%rows + 1:size(corners) - mesh%rows)
    ends = reshape(corners, [mesh%rows, 2, size(corners)/(2*mesh%rows)])
  end function flat_ends

  !> Contacts of corners and crests.
  subroutine add_contacts(planar, strip)
    type(planar_case_type), intent(in) :: planar
    type(strip_system_type), intent(inout) :: strip
    integer, allocatable :: corners(:)
    integer :: i, rows

    allocate (strip%contacts%point(0), strip%contacts%global(0), strip%crest_press(0))
    rows = strip%foil%mesh%rows
    corners = node_set(strip%foil%mesh, 'corners')
    if (planar%held) corners = corners(:0)
    do i = 2, size(corners)/rows ! the first is clamped
      call add_line(strip, corners((i - 1)*rows + 1:i*rows), contact_sleeve, i, 0.0_wp)
    end do
    if (.not. planar%friction_top > 0.0_wp) return
    do i = 1, size(planar%pressure)
      call add_line(strip, node_set(strip%foil%mesh, crest_name(i)), contact_top, i, &
                    planar%pressure(i)*pitch)
    end do
  end subroutine add_contacts

  !> Contacts of a line's nodes with the sleeve, or with the plate that presses them.
  subroutine add_line(strip, line, law, number, pressing)
    type(strip_system_type), intent(inout) :: strip
    integer, intent(in) :: line(:)     !! nodes in order of z
    integer, intent(in) :: law         !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: number      !! of the line
    real(wp), intent(in) :: pressing   !! of the plate, per length [N/m]
    type(contact_point_type) :: one
    real(wp) :: length(size(line))
    integer :: i, k

    length = width*line_shares(strip%foil%mesh, line)
    do i = 1, size(line)
      one = contact_point_type(law=law, node=line(i), line=number, length=length(i), &
                               pressed=law == contact_top)
      do k = tangential, radial
        strip%contacts%global = [strip%contacts%global, strip%foil%unknown(k, line(i))]
        one%slave(k) = size(strip%contacts%global)
      end do
      one%frame(tangential, 1) = 1.0_wp
      one%frame(axial, 2) = 1.0_wp
      one%frame(radial, 3) = merge(1.0_wp, -1.0_wp, law == contact_sleeve)
      allocate (one%master(axial, 0), one%share(0))
      strip%contacts%point = [strip%contacts%point, one]
      strip%crest_press = [strip%crest_press, pressing*length(i)]
    end do
  end subroutine add_line
end module planar_strips
