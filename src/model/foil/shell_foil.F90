#include "gfb_petsc.h"
!> Top foil and bump strip as shells under the film.
module gfb_shell_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: largest_number
  use gfb_shell_geometry, only: node_unknowns, shell_unknowns
  use gfb_shell_mass, only: shell_mass
  use gfb_substructures, only: kind_count
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_foil_pieces, only: element_geometry, element_section, assemble_piece, retained_in_piece
  use gfb_foil_assembly, only: element_unknowns, retained_unknowns
  use gfb_foil_ranges, only: foil_ranges_type, ranges_of
  use gfb_condensed_piece, only: condensed_piece_type
  use gfb_foil_stress, only: shell_stresses
  use gfb_meshed_foil, only: meshed_foil_type, both_surfaces, bump_surface
  implicit none (type)
  private

  !> Both foils, each a structure of shells, full or condensed.
  type, extends(meshed_foil_type), public :: shell_foil_type
    type(foil_structure_type) :: top, bumps
  contains
    procedure :: add_mass => add_shell_mass
    procedure :: natural_numbers => shell_natural_numbers
    procedure :: surfaces => shell_surfaces
    procedure :: own_unknown => shell_own_unknown
    procedure :: split_displacements => shell_displacements
    procedure :: stresses => stresses_of_shells
    procedure :: nodal_contacts => shell_contacts
    procedure :: sizes => shell_sizes
    procedure :: destroy => shell_destroy
  end type shell_foil_type

contains

  !> Mass of both foils, or of the top foil and, piece by piece, what the condensed bumps are.
  !>
  !> Fails where an element is degenerate.
  subroutine add_shell_mass(self, mass, piece, error)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    Mat, intent(in) :: mass !! like `elastic`, not assembled yet [kg] between displacements
    type(condensed_piece_type), allocatable, intent(out) :: piece(:) !! one a kind
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(foil_ranges_type) :: ranges
    real(wp) :: block(shell_unknowns, shell_unknowns)
    integer :: i

    ranges = ranges_of(self%top, self%bumps)
    allocate (piece(0))
    associate (top => self%top)
      do i = 1, size(top%my_elements)
        call shell_mass(element_geometry(top%mesh, top%my_elements(i)), top%section, block, error)
        if (allocated(error)) return
        call add_block(mass, ranges%of_top(element_unknowns(top, top%my_elements(i))), block)
      end do
    end associate
    if (self%bumps%reduced) then
      call list_pieces(self%bumps, ranges, piece, error)
      return
    end if
    associate (bumps => self%bumps)
      do i = 1, size(bumps%my_elements)
        call shell_mass(element_geometry(bumps%mesh, bumps%my_elements(i)), &
                        element_section(bumps%mesh, bumps%section, bumps%my_elements(i)), block, error)
        if (allocated(error)) return
        call add_block(mass, ranges%of_bumps(element_unknowns(bumps, bumps%my_elements(i))), block)
      end do
    end associate
  end subroutine add_shell_mass

  !> Adds an element's mass.
  subroutine add_block(mass, number, block)
    Mat, intent(in) :: mass
    integer, intent(in) :: number(:) !! foil's, from 1; 0: fixed
    real(wp), intent(in) :: block(:, :)
    PetscErrorCode :: ierr

    PetscCallA(MatSetValues(mass, int(size(number), pint), int(number - 1, pint), int(size(number), pint), int(number - 1, pint), [block], ADD_VALUES, ierr))
  end subroutine add_block

  !> The kinds of condensed pieces that this rank has.
  !>
  !> Fails where an element is degenerate.
  subroutine list_pieces(bumps, ranges, piece, error)
    type(foil_structure_type), intent(in) :: bumps
    type(foil_ranges_type), intent(in) :: ranges
    type(condensed_piece_type), allocatable, intent(out) :: piece(:)
    type(error_type), allocatable, intent(out) :: error
    type(condensed_piece_type) :: one
    integer, allocatable :: mine(:)
    integer :: kind, i

    allocate (piece(0))
    do kind = 1, kind_count(bumps%substructure)
      mine = pack(bumps%mine, bumps%substructure(bumps%mine)%kind == kind)
      if (size(mine) == 0) cycle
      associate (first => bumps%substructure(mine(1)))
        associate (free => bumps%free(:, first%nodes))
          call assemble_piece(bumps%mesh, bumps%section, free, first, .false., one%stiffness, error)
          if (.not. allocated(error)) call assemble_piece(bumps%mesh, bumps%section, free, first, .true., one%mass, error)
          if (allocated(error)) return
          one%is_retained = retained_in_piece(free, first)
        end associate
      end associate
      one%place = mine
      if (allocated(one%number)) deallocate (one%number)
      allocate (one%number(count(one%is_retained), size(mine)))
      do i = 1, size(mine)
        one%number(:, i) = ranges%of_bumps(retained_unknowns(bumps, bumps%substructure(mine(i))))
      end do
      piece = [piece, one]
    end do
  end subroutine list_pieces

  !> The top foil's numbers, then those of the bumps.
  function shell_natural_numbers(self) result(number)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    integer, allocatable :: number(:), top(:), bumps(:)

    top = self%top%natural_numbers()
    bumps = self%bumps%natural_numbers()
    number = [top, largest_number(top) + bumps]
  end function shell_natural_numbers

  !> Top foil and bump foil.
  function shell_surfaces(self) result(list)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(foil_surface_type), allocatable :: list(:)
    list = both_surfaces(self%top%foil_surface_type, self%bumps%foil_surface_type)
  end function shell_surfaces

  !> The structure's number, among those of both.
  pure function shell_own_unknown(self, surface, component, node) result(number)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    integer, intent(in) :: surface !! which of `surfaces`
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node !! of the surface's whole mesh
    integer :: number

    if (surface == bump_surface) then
      number = self%bumps%unknown(component, node) + 1
      if (number > 0) number = self%own_place(self%top%part%owned_unknowns + number - self%bumps%first)
    else
      number = self%top%unknown(component, node) + 1
      if (number > 0) number = self%own_place(number - self%top%first)
    end if
  end function shell_own_unknown

  !> Displacements of all this rank's nodes of both foils, condensed ones recovered.
  subroutine shell_displacements(self, unknown, top, bumps)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), allocatable, intent(out) :: top(:, :), bumps(:, :) !! (5, local nodes) of top foil and bumps [m], [rad]
    integer :: mine

    mine = self%top%part%owned_unknowns
    call expand(self%top, unknown(self%first + self%own_place(:mine)), top)
    call expand(self%bumps, unknown(self%first + self%own_place(mine + 1:)), bumps)
  end subroutine shell_displacements

  !> Displacements of one structure's nodes from its owned unknowns.
  subroutine expand(structure, owned, moved)
    type(foil_structure_type), intent(in) :: structure
    real(wp), intent(in) :: owned(:) !! in SI
    real(wp), allocatable, intent(out) :: moved(:, :)
    Vec :: solution
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    allocate (moved(size(structure%slot, 1), size(structure%part%mesh_node)))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(size(owned), pint), PETSC_DETERMINE, solution, ierr))
    PetscCallA(GFB_VecGetArray(solution, values, ierr))
    values = owned
    PetscCallA(GFB_VecRestoreArray(solution, values, ierr))
    call structure%displacements(solution, moved)
    PetscCallA(VecDestroy(solution, ierr))
  end subroutine expand

  !> Stresses of shells.
  function stresses_of_shells(self, surface, moved) result(value)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's two
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :)
    value = shell_stresses(surface, moved)
  end function stresses_of_shells

  !> The contacts as they are: each is of one node of the bumps.
  function shell_contacts(self) result(contacts)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(contact_set_type) :: contacts
    contacts = self%contacts
  end function shell_contacts

  !> Unknowns of the bump foil, full and retained, and its super-elements.
  function shell_sizes(self) result(list)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(quantity_type), allocatable :: list(:)
    integer :: rows

    allocate (list(0))
    rows = self%bumps%mesh%rows
    if (self%bumps%mesh%half) rows = 2*rows - 1
    call add_result(list, 'foil_unknowns_full', node_unknowns*rows*self%bumps%mesh%stations)
    call add_result(list, 'foil_unknowns_retained', node_unknowns*(size(self%bumps%substructure) + 1)*rows)
    call add_result(list, 'distinct_super_elements', kind_count(self%bumps%substructure))
  end function shell_sizes

  !> Frees what PETSc holds.
  subroutine shell_destroy(self)
    class(shell_foil_type), intent(inout) :: self !! the shell foil

    call self%free_matrix()
    call destroy_foil_structure(self%top)
    call destroy_foil_structure(self%bumps)
  end subroutine shell_destroy
end module gfb_shell_foil
