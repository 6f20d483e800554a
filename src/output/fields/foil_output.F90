!> The foils of a bearing as surfaces, and their contacts at every point of a sweep.
module gfb_foil_output
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, count_quantity, add_quantity
  use gfb_substructures, only: kind_count
  use gfb_bearing_system, only: bearing_system_type
  use gfb_beam_foil, only: beam_foil_type
  use gfb_planar_beam, only: beam_unknowns
  use gfb_shell_foil, only: shell_foil_type
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_structure, only: foil_structure_type
  use gfb_case_file, only: case_array_type
  use gfb_result_set, only: result_grid_type
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_node_field, add_stress
  use gfb_foil_stress, only: shell_stresses, beam_stresses
  use gfb_contact_output, only: contact_record_type, record_contacts, contact_arrays, contact_field
  implicit none (type, external)
  private
  public :: add_foil_grids, record_foil_contacts, foil_contact_arrays, foil_quantities

contains

  !> Adds top foil and bump foil with displacements, stresses and contacts; nothing without foils
  !> that are meshed.
  subroutine add_foil_grids(bearing, grids)
    type(bearing_system_type), intent(in) :: bearing
    type(result_grid_type), allocatable, intent(inout) :: grids(:)

    type(result_grid_type) :: grid
    real(wp) :: unknown(bearing%local_size())
    real(wp), allocatable :: top(:, :), bumps(:, :), force(:, :), state(:, :)

    call bearing%get_unknowns(unknown)
    select type (foil => bearing%foil)
    class is (shell_foil_type)
      call foil%split_displacements(unknown, top, bumps)
      call surface(foil%top, 'top_foil', top, stresses(foil, foil%top, top), grid)
      grids = [grids, grid]
      call surface(foil%bumps, 'bump_foil', bumps, stresses(foil, foil%bumps, bumps), grid)
      call contact_field(foil%nodal_contacts(), foil%bumps, force, state)
      call add_node_field(foil%bumps, 'contact_force', 'N/m', &
                          'on the foil, per length of contact line', force, grid)
      call add_node_field(foil%bumps, 'contact_state', '1', '0 open, 1 sticks, 2 slips', state, grid)
      grids = [grids, grid]
    end select
  end subroutine add_foil_grids

  !> One foil with displacements and stresses.
  subroutine surface(structure, name, moved, stress, grid)
    type(foil_structure_type), intent(in) :: structure
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: moved(:, :)  !! (5, local nodes) [m], [rad]
    real(wp), intent(in) :: stress(:, :) !! (8, elements of this rank) [Pa]
    type(result_grid_type), intent(out) :: grid

    call create_foil_grid(structure, name, grid)
    call add_displacement(structure, 'displacement', 'of the mid-surface', moved, grid)
    call add_stress(structure, stress, grid)
  end subroutine surface

  !> Stresses of a foil's elements on this rank.
  function stresses(foil, structure, moved) result(value)
    class(shell_foil_type), intent(in) :: foil
    type(foil_structure_type), intent(in) :: structure !! one of its two
    real(wp), intent(in) :: moved(:, :)                !! (5, local nodes) [m], [rad]
    real(wp), allocatable :: value(:, :)               !! (8, elements of this rank) [Pa]

    select type (foil)
    type is (beam_foil_type)
      value = beam_stresses(structure, moved)
    class default
      value = shell_stresses(structure, moved)
    end select
  end function stresses

  !> Keeps the contacts of the present point.
  subroutine record_foil_contacts(bearing, point, points, record)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: point, points !! this one and their number
    type(contact_record_type), intent(inout) :: record

    select type (foil => bearing%foil)
    class is (shell_foil_type)
      call record_contacts(foil%nodal_contacts(), point, points, record)
    end select
  end subroutine record_foil_contacts

  !> The contacts of all points; none without foils that are meshed.
  function foil_contact_arrays(bearing, record, points) result(arrays)
    type(bearing_system_type), intent(in) :: bearing
    type(contact_record_type), intent(in) :: record
    integer, intent(in) :: points !! recorded
    type(case_array_type), allocatable :: arrays(:)

    select type (foil => bearing%foil)
    class is (shell_foil_type)
      arrays = contact_arrays(foil%nodal_contacts(), foil%bumps, record, points)
    class default
      allocate (arrays(0))
    end select
  end function foil_contact_arrays

  !> Sizes of the bump foil; none without foils that are meshed.
  function foil_quantities(bearing) result(list)
    type(bearing_system_type), intent(in) :: bearing
    type(quantity_type), allocatable :: list(:)
    integer :: rows

    allocate (list(0))
    select type (foil => bearing%foil)
    type is (shell_foil_type)
      rows = foil%bumps%mesh%rows
      if (foil%bumps%mesh%half) rows = 2*rows - 1
      call add_quantity(list, unknowns_full(node_unknowns*rows*foil%bumps%mesh%stations))
      call add_quantity(list, count_quantity('foil_unknowns_retained', &
        node_unknowns*(size(foil%bumps%substructure) + 1)*rows, &
        'of its retained lines, whole width, before constraints'))
      call add_quantity(list, count_quantity('distinct_super_elements', kind_count(foil%bumps%substructure), &
        'condensed once each'))
    type is (beam_foil_type)
      call add_quantity(list, unknowns_full(beam_unknowns*foil%bumps%mesh%stations))
    end select
  end function foil_quantities

  !> Unknowns of the bump foil.
  function unknowns_full(number) result(quantity)
    integer, intent(in) :: number
    type(quantity_type) :: quantity
    quantity = count_quantity('foil_unknowns_full', number, &
                              'of the bump foil, whole width, before constraints')
  end function unknowns_full
end module gfb_foil_output
