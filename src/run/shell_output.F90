!> The foils of a bearing as surfaces, and their contacts at every point of a sweep.
module gfb_shell_output
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, count_quantity
  use gfb_substructures, only: kind_count
  use gfb_bearing_system, only: bearing_system_type
  use gfb_shell_foil, only: shell_foil_type
  use gfb_foil_structure, only: foil_structure_type
  use gfb_case_file, only: case_array_type
  use gfb_result_set, only: result_grid_type
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_node_field, add_stress
  use gfb_contact_output, only: contact_record_type, record_contacts, contact_arrays, contact_field
  implicit none (type, external)
  private
  public :: add_shell_grids, record_shell_contacts, shell_contact_arrays, shell_quantities

  integer, parameter :: node_unknowns = 5

contains

  !> Adds top foil and bump foil with displacements, stresses and contacts; nothing without shells.
  subroutine add_shell_grids(bearing, grids)
    type(bearing_system_type), intent(in) :: bearing
    type(result_grid_type), allocatable, intent(inout) :: grids(:)

    type(result_grid_type) :: grid
    real(wp) :: unknown(bearing%local_size())
    real(wp), allocatable :: top(:, :), bumps(:, :), force(:, :), state(:, :)

    call bearing%get_unknowns(unknown)
    select type (foil => bearing%foil)
    type is (shell_foil_type)
      call foil%split_displacements(unknown, top, bumps)
      call surface(foil%top, 'top_foil', top, grid)
      grids = [grids, grid]
      call surface(foil%bumps, 'bump_foil', bumps, grid)
      call contact_field(foil%contacts, foil%bumps, force, state)
      call add_node_field(foil%bumps, 'contact_force', 'N/m', &
                          'on the foil, per length of contact line', force, grid)
      call add_node_field(foil%bumps, 'contact_state', '1', '0 open, 1 sticks, 2 slips', state, grid)
      grids = [grids, grid]
    end select
  end subroutine add_shell_grids

  !> One foil with displacements and stresses.
  subroutine surface(structure, name, moved, grid)
    type(foil_structure_type), intent(in) :: structure
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes)
    type(result_grid_type), intent(out) :: grid

    call create_foil_grid(structure, name, grid)
    call add_displacement(structure, 'displacement', 'of the mid-surface', moved, grid)
    call add_stress(structure, moved, grid)
  end subroutine surface

  !> Keeps the contacts of the present point.
  subroutine record_shell_contacts(bearing, point, points, record)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: point, points !! this one and their number
    type(contact_record_type), intent(inout) :: record

    select type (foil => bearing%foil)
    type is (shell_foil_type)
      call record_contacts(foil%contacts, point, points, record)
    end select
  end subroutine record_shell_contacts

  !> The contacts of all points; none without shells.
  function shell_contact_arrays(bearing, record, points) result(arrays)
    type(bearing_system_type), intent(in) :: bearing
    type(contact_record_type), intent(in) :: record
    integer, intent(in) :: points !! recorded
    type(case_array_type), allocatable :: arrays(:)

    select type (foil => bearing%foil)
    type is (shell_foil_type)
      arrays = contact_arrays(foil%contacts, foil%bumps, record, points)
    class default
      allocate (arrays(0))
    end select
  end function shell_contact_arrays

  !> Sizes of the bump foil; none without shells.
  function shell_quantities(bearing) result(list)
    type(bearing_system_type), intent(in) :: bearing
    type(quantity_type), allocatable :: list(:)
    integer :: rows, stations

    allocate (list(0))
    select type (foil => bearing%foil)
    type is (shell_foil_type)
      associate (mesh => foil%bumps%mesh)
        rows = merge(2*mesh%rows - 1, mesh%rows, mesh%half)
        stations = size(mesh%position, 2)/mesh%rows
      end associate
      list = [count_quantity('foil_unknowns_full', node_unknowns*stations*rows, &
                             'of the bump foil, whole width, before constraints'), &
              count_quantity('foil_unknowns_retained', &
                             node_unknowns*(size(foil%bumps%substructure) + 1)*rows, &
                             'of its retained lines, whole width, before constraints'), &
              count_quantity('distinct_super_elements', kind_count(foil%bumps%substructure), &
                             'condensed once each')]
    end select
  end function shell_quantities
end module gfb_shell_output
