!> What is written of a machine's shaft: moments, shear and stress along it, its matrices, its
!> bearings, and `<case>.shaft.vtkhdf`.
!>
!> Each element has two points of its own, so that what jumps at a disc or a bearing does so there.
module gfb_shaft_results
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_machine_case, only: machine_case_type
  use gfb_shaft, only: motions, journal_places
  use gfb_machine, only: machine_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_grid, only: result_grid_type, block_bounds, add_grid_field
  implicit none (type, external)
  private
  public :: add_shaft_results, add_bearing_places

  integer, parameter :: ends = 2 !! of an element
  character(len=*), parameter :: sections_meaning = 'both ends of each element: z [m], outer '// &
    'diameter [m], bending moment about x and y [N m], shear force along x and y [N], bending '// &
    'stress of the outer fibre [Pa]'

  !> The shaft at both ends of each element, in its equilibrium.
  type :: section_row_type
    real(wp) :: z = 0.0_wp               !! [m]
    real(wp) :: outer_diameter = 0.0_wp  !! [m]
    real(wp) :: place(motions) = 0.0_wp  !! x, y, rotation about x and y [m], [rad]
    real(wp) :: moment(2) = 0.0_wp       !! about x and y [N m]
    real(wp) :: shear(2) = 0.0_wp        !! along x and y [N]
    real(wp) :: stress = 0.0_wp          !! of the outer fibre [Pa]
  end type section_row_type

contains

  !> Adds what is known along the shaft, its matrices, and the line for ParaView.
  subroutine add_shaft_results(asked, machine, line, arrays, grids)
    type(machine_case_type), intent(in) :: asked !! what the case file asks for
    type(machine_type), intent(in) :: machine !! that it describes
    real(wp), intent(in) :: line(:) !! all motions of the shaft in its equilibrium [m], [1]
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get those of the shaft
    type(result_grid_type), allocatable, intent(inout) :: grids(:) !! get its line
    type(section_row_type), allocatable :: row(:)
    integer :: i

    row = section_rows(asked, machine, line)
    call add_array(arrays, '/shaft/sections', 'mixed SI', sections_meaning, &
                   reshape([(row(i)%z, row(i)%outer_diameter, row(i)%moment, row(i)%shear, &
                             row(i)%stress, i=1, size(row))], [7, size(row)]))
    associate (shaft => machine%shaft)
      call add_array(arrays, '/shaft/mass', 'mixed SI', 'of one plane: x and slope at each '// &
                     'node of /shaft/line, with discs [kg], [kg m], [kg m^2]', shaft%mass)
      call add_array(arrays, '/shaft/stiffness', 'mixed SI', 'the same: stiffness [N/m], [N], '// &
                     '[N m]', shaft%stiffness)
      call add_array(arrays, '/shaft/polar_inertia', 'mixed SI', 'the same: what couples both '// &
                     'planes where the shaft turns, over the speed [kg m^2]', shaft%polar)
    end associate
    grids = [grids, line_grid(row)]
  end subroutine add_shaft_results

  !> Adds where the bearings are and how large.
  subroutine add_bearing_places(position, length, radius, clearance, smallest_gap, arrays)
    real(wp), intent(in) :: position(:) !! z of their middles [m]
    real(wp), intent(in) :: length(:)   !! along z [m]
    real(wp), intent(in) :: radius(:), clearance(:) !! [m]
    real(wp), intent(in) :: smallest_gap(:) !! that each is to have; 0: none is given [m]
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get the table
    integer :: i

    call add_array(arrays, '/shaft/bearings', 'm', 'a row a bearing: z of its middle, length, '// &
                   'radius, clearance, film that its file wants or 0', &
                   reshape([(position(i), length(i), radius(i), clearance(i), smallest_gap(i), &
                             i=1, size(position))], [5, size(position)]))
  end subroutine add_bearing_places

  !> Both ends of each element.
  pure function section_rows(asked, machine, line) result(row)
    type(machine_case_type), intent(in) :: asked
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: line(:) !! [m], [1]
    type(section_row_type), allocatable :: row(:)
    real(wp), allocatable :: force(:, :, :, :) !! (moment and shear, end, element, plane)
    real(wp) :: sign(motions)
    integer :: place(motions), i, k, n, segment

    n = size(line)/2
    associate (shaft => machine%shaft)
      allocate (force(2, ends, size(shaft%section), 2))
      force(:, :, :, 1) = shaft%bending(line(:n), asked%gravity(1))
      force(:, :, :, 2) = shaft%bending(line(n + 1:), asked%gravity(2))
      allocate (row(ends*size(shaft%section)))
      do i = 1, size(shaft%section)
        segment = segment_at(asked, 0.5_wp*(shaft%z(i) + shaft%z(i + 1)))
        do k = 1, ends
          associate (here => row(ends*(i - 1) + k))
            call journal_places(shaft, i + k - 1, place, sign)
            here%z = shaft%z(i + k - 1)
            here%outer_diameter = asked%outer_diameter(segment)
            here%place = sign*line(place)
            ! The slope along y is minus the rotation about x.
            here%moment = [-force(1, k, i, 2), force(1, k, i, 1)]
            here%shear = force(2, k, i, :)
            here%stress = 0.5_wp*here%outer_diameter*norm2(here%moment)* &
              asked%youngs_modulus(segment)/shaft%section(i)%bending
          end associate
        end do
      end do
    end associate
  end function section_rows

  !> The segment in which a place is.
  pure integer function segment_at(asked, position) result(segment)
    type(machine_case_type), intent(in) :: asked
    real(wp), intent(in) :: position !! between two nodes [m]

    do segment = 1, size(asked%length) - 1
      if (position < sum(asked%length(:segment))) return
    end do
  end function segment_at

  !> The shaft as a line with fields, of which each rank has its part.
  function line_grid(row) result(grid)
    type(section_row_type), intent(in) :: row(:)
    type(result_grid_type) :: grid
    integer :: first, last, i

    grid%name = 'shaft'
    grid%grid%points = size(row)
    grid%grid%cells = size(row)/ends
    call block_bounds(grid%grid%cells, this_rank(), rank_count(), first, last)
    grid%grid%cell = reshape([(i, i=ends*first - 1, ends*last)], [ends, last - first + 1])
    call block_bounds(grid%grid%points, this_rank(), rank_count(), first, last)
    allocate (grid%cell_field(0))
    associate (mine => row(first:last), n => last - first + 1)
      grid%grid%point = reshape([(0.0_wp, 0.0_wp, mine(i)%z, i=1, n)], [3, n])
      call add_grid_field(grid%point_field, 'displacement', 'm', 'of the axis', &
                          reshape([(mine(i)%place(:2), 0.0_wp, i=1, n)], [3, n]))
      call add_grid_field(grid%point_field, 'rotation', 'rad', 'of the section', &
                          reshape([(mine(i)%place(3:), 0.0_wp, i=1, n)], [3, n]))
      call add_grid_field(grid%point_field, 'bending_moment', 'N m', &
                          'of what is beyond the section, about x and y', &
                          reshape([(mine(i)%moment, 0.0_wp, i=1, n)], [3, n]))
      call add_grid_field(grid%point_field, 'shear_force', 'N', &
                          'of what is beyond the section', &
                          reshape([(mine(i)%shear, 0.0_wp, i=1, n)], [3, n]))
      call add_grid_field(grid%point_field, 'bending_stress', 'Pa', 'of the outer fibre', &
                          reshape(mine%stress, [1, n]))
      call add_grid_field(grid%point_field, 'outer_radius', 'm', 'of the shaft', &
                          reshape(0.5_wp*mine%outer_diameter, [1, n]))
    end associate
  end function line_grid
end module gfb_shaft_results
