!> Strips for the tests of foils as structures.
module strip_samples
  use gfb_kinds, only: wp
  use gfb_quad_mesh, only: quad_mesh_type, node_set
  use gfb_film_mesh, only: axial_rows
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_foil_mesh, only: strip_shape_type, bump_type, bump_strip_mesh, strip_substructures
  use gfb_substructures, only: substructure_type, find_kinds
  use gfb_shell_geometry, only: shell_section_type
  implicit none (type, external)
  private
  public :: plain_strip, varied_strip, mirrored_strip, mesh_strip, rigid_motion

  ! [Gu2020] table 1, case 1.
  real(wp), parameter, public :: half_length = 1.778e-3_wp, height = 0.508e-3_wp, &
    pitch = 4.572e-3_wp
  real(wp), parameter, public :: width = 38.1e-3_wp
  type(shell_section_type), parameter, public :: &
    section = shell_section_type(0.102e-3_wp, 214.0e9_wp, 0.29_wp, 8440.0_wp)

  !> What holds a strip.
  integer, parameter, public :: held = 1 !! corners in v, the fixed edge clamped
  integer, parameter, public :: free = 2 !! nothing but symmetry

contains

  !> Equal bumps on a coarse mesh.
  pure function plain_strip(bumps) result(shape)
    integer, intent(in) :: bumps
    type(strip_shape_type) :: shape
    integer :: i

    shape%bump = [(bump_type(half_length, height, pitch), i=1, bumps)]
    shape%begins = fixed_line_corner
    shape%arc_elements = 6
    shape%flat_elements = 2
  end function plain_strip

  !> Bumps no part of which is like another.
  pure function varied_strip(bumps) result(shape)
    integer, intent(in) :: bumps
    type(strip_shape_type) :: shape
    integer :: i

    shape = plain_strip(bumps)
    do i = 1, bumps
      shape%bump(i) = bump_type(half_length*(1.0_wp - 0.03_wp*i), height*(1.0_wp + 0.02_wp*i), &
                                pitch*(1.0_wp + 0.01_wp*i**2))
    end do
  end function varied_strip

  !> A strip from the other end, over the same stretch of x.
  pure function mirrored_strip(shape) result(other)
    type(strip_shape_type), intent(in) :: shape
    type(strip_shape_type) :: other

    other = shape
    other%mirrored = .true.
    other%edge = sum(shape%bump%pitch)
  end function mirrored_strip

  !> Mesh, supports and pieces of a strip.
  subroutine mesh_strip(shape, support, axial, half, mesh, fixed, pieces)
    type(strip_shape_type), intent(in) :: shape
    integer, intent(in) :: support !! `held`, `free`
    integer, intent(in) :: axial   !! elements of the whole width
    logical, intent(in) :: half
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)
    type(substructure_type), allocatable, intent(out) :: pieces(:)

    mesh = bump_strip_mesh(shape, axial_rows(width, axial, half, 1.0_wp), half)
    pieces = strip_substructures(shape, mesh)
    allocate (fixed(5, size(mesh%position, 2)), source=.false.)
    if (half) fixed([3, 5], node_set(mesh, 'midplane')) = .true.
    if (support == held) then
      fixed(2, node_set(mesh, 'corners')) = .true.
      fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    end if
    call find_kinds(mesh, fixed, pieces)
  end subroutine mesh_strip

  !> Displacements of a node when the strip moves as a rigid body: three shifts, then three small
  !> turns.
  pure function rigid_motion(mesh, motion, node) result(moved)
    type(quad_mesh_type), intent(in) :: mesh
    integer, intent(in) :: motion !! 1 to 6
    integer, intent(in) :: node
    real(wp) :: moved(5)
    real(wp) :: turn(3)

    moved = 0.0_wp
    if (motion <= 3) then
      moved(motion) = 1.0_wp
      return
    end if
    turn = 0.0_wp
    turn(motion - 3) = 1.0_wp
    associate (p => mesh%position(:, node))
      moved(:3) = [turn(2)*p(3) - turn(3)*p(2), turn(3)*p(1) - turn(1)*p(3), turn(1)*p(2) &
        - turn(2)*p(1)]
    end associate
    moved(4) = dot_product(turn, mesh%axis_1(:, node))
    moved(5) = dot_product(turn, mesh%axis_2(:, node))
  end function rigid_motion
end module strip_samples
