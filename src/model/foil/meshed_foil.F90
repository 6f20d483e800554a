#include "gfb_petsc.h"
!> What foils with meshes of their own have in common: shells and beams under the film.
!>
!> Equations: elastic forces of both foils, the film's pressure on the top foil ([Gu2020] eq. 2),
!> and the contacts of crests with the top foil and of corners with the sleeve. The top foil has the
!> film's nodes; its deflection is \( h_f = -v \).
module gfb_meshed_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_surface, only: foil_surface_type, nodal_values_type, surface_motion_type
  implicit none (type)
  private
  public :: both_surfaces, split_motion, from_rest

  integer, parameter, public :: top_surface = 1, bump_surface = 2 !! of a foil's surfaces

  !> Both foils' equations, this rank's part of them; what they are made of is the models' own.
  type, abstract, extends(foil_model_type), public :: meshed_foil_type
    real(wp) :: ambient_pressure = 0.0_wp     !! p_a [Pa]
    integer, allocatable :: pressed(:, :)     !! (nodes, elements) film nodes of an element, local
    integer, allocatable :: pushed(:, :)      !! (nodes, elements) local foil unknown v there, 0: fixed
    real(wp), allocatable :: weight(:, :, :)  !! (nodes, nodes, elements) of p - p_a in the force on v [m2]
    logical :: has_room = .false.             !! in the matrix, between all unknowns that an element pushes
    integer, allocatable :: own_place(:)      !! local foil unknown of each owned one
    logical :: has_matrix = .false.           !! `elastic` and the vectors are there
    real(wp) :: initial_curvature = 0.0_wp    !! of the top foil before it is put in, over the bore's [1/m]
    !> forces of a moment 1 N around and along the bearing, one a local foil unknown; none: the foil was rolled as it lies
    real(wp), allocatable :: initial_shape(:, :)
    real(wp), allocatable :: initial_load(:)  !! of its initial moment, one a local foil unknown [N], [N m]
    Vec :: state, force                       !! of the owned unknowns, in SI
  contains
    procedure :: add_residual => meshed_residual
    procedure :: add_jacobian => meshed_jacobian
    procedure :: add_constant => meshed_constant
    procedure :: add_load_rates => meshed_load_rates
    procedure :: estimate => meshed_estimate
    procedure :: is_meshed => meshed_is_meshed
    procedure :: moves_against_mirror => meshed_moves_against_mirror
    procedure :: motions => meshed_motions
    procedure :: add_modulus_rates => meshed_modulus_rates
    procedure :: free_matrix
    procedure(split_displacements), deferred :: split_displacements
    procedure(gather_forces), deferred :: gather_forces
    procedure(stresses), deferred :: stresses
    procedure(corner_stresses), deferred :: corner_stresses
    procedure(find_work), deferred :: find_work
  end type meshed_foil_type

  abstract interface
    !> Displacements of all this rank's nodes of each of `surfaces`, condensed ones recovered. All ranks ask.
    subroutine split_displacements(self, unknown, moved)
      import :: meshed_foil_type, nodal_values_type, wp
      class(meshed_foil_type), intent(in) :: self !! the foil
      real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
      type(nodal_values_type), allocatable, intent(out) :: moved(:) !! one a surface
    end subroutine split_displacements

    !> Forces on this rank's nodes as forces on the unknowns: what `split_displacements` does, transposed. All ranks ask.
    subroutine gather_forces(self, nodal, force)
      import :: meshed_foil_type, nodal_values_type, wp
      class(meshed_foil_type), intent(in) :: self !! the foil
      type(nodal_values_type), intent(in) :: nodal(:) !! on each surface
      real(wp), intent(out) :: force(:) !! one a local unknown of the foil, 0 where another rank owns it [N], [N m]
    end subroutine gather_forces

    !> Stresses of a surface's elements on this rank.
    function stresses(self, surface, moved) result(value)
      import :: meshed_foil_type, foil_surface_type, wp
      class(meshed_foil_type), intent(in) :: self !! the foil
      type(foil_surface_type), intent(in) :: surface !! one of the foil's two
      real(wp), intent(in) :: moved(:, :)            !! (5, local nodes) [m], [rad]
      real(wp), allocatable :: value(:, :)           !! (8, elements of this rank) [Pa]
    end function stresses

    !> Stresses at the corners of a surface's elements on this rank.
    function corner_stresses(self, surface, moved) result(value)
      import :: meshed_foil_type, foil_surface_type, wp
      class(meshed_foil_type), intent(in) :: self !! the foil
      type(foil_surface_type), intent(in) :: surface !! one of the foil's two
      real(wp), intent(in) :: moved(:, :)            !! (5, local nodes) [m], [rad]
      real(wp), allocatable :: value(:, :, :) !! (6, corners, elements of this rank), see `gfb_foil_stress` [Pa]
    end function corner_stresses

    !> Work of the elastic forces of a motion in a surface's elements on this rank.
    subroutine find_work(self, surface, moved, work, error)
      import :: meshed_foil_type, foil_surface_type, error_type, wp
      class(meshed_foil_type), intent(in) :: self !! the foil
      type(foil_surface_type), intent(in) :: surface !! one of the foil's two, whose numbers may differ
      real(wp), intent(in) :: moved(:, :, 0:) !! (5, local nodes, motions) first that whose forces work [m], [rad]
      real(wp), intent(out) :: work(:) !! on each of the others [J]
      type(error_type), allocatable, intent(out) :: error !! an element is degenerate
    end subroutine find_work
  end interface

contains

  !> The list of both surfaces, named.
  function both_surfaces(top, bumps) result(list)
    type(foil_surface_type), intent(in) :: top   !! the top foil
    type(foil_surface_type), intent(in) :: bumps !! the bump foil, whose nodes are the contacts' slaves
    type(foil_surface_type), allocatable :: list(:)

    allocate (list(bump_surface))
    list(top_surface) = top
    list(bump_surface) = bumps
    list(top_surface)%name = 'top_foil'
    list(top_surface)%lies_on_film = .true.
    list(bump_surface)%name = 'bump_foil'
    list(bump_surface)%has_contacts = .true.
  end function both_surfaces

  !> Displacements of all this rank's nodes of each surface, condensed ones recovered. All ranks ask.
  subroutine split_motion(foil, unknown, moved)
    class(foil_model_type), intent(in) :: foil !! with meshes of its own
    real(wp), intent(in) :: unknown(:) !! local ones of the pad, in SI
    type(nodal_values_type), allocatable, intent(out) :: moved(:) !! one a surface

    select type (foil)
    class is (meshed_foil_type)
      call foil%split_displacements(unknown, moved)
    end select
  end subroutine split_motion

  !> Elastic forces, pressure and contacts.
  subroutine meshed_residual(self, unknown, residual)
    class(meshed_foil_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]

    real(wp) :: load(size(self%pressed, 1))
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: element, i

    call find_elastic_force(self, unknown)
    PetscCallA(GFB_VecGetArrayRead(self%force, values, ierr))
    associate (top => self%owned_top, own => self%first + self%own_place)
      residual(own(:top)) = residual(own(:top)) + self%modulus(top_surface)*values(:top)
      residual(own(top + 1:)) = residual(own(top + 1:)) + self%modulus(bump_surface)*values(top + 1:)
    end associate
    PetscCallA(GFB_VecRestoreArrayRead(self%force, values, ierr))

    do element = 1, size(self%pressed, 2)
      load = matmul(self%weight(:, :, element), unknown(self%pressed(:, element)) - self%ambient_pressure)
      do i = 1, size(load)
        if (self%pushed(i, element) == 0) cycle
        associate (row => self%first + self%pushed(i, element))
          residual(row) = residual(row) + load(i) ! pressure pushes against v
        end associate
      end do
    end do

    call add_contact_forces(self, unknown, residual)
  end subroutine meshed_residual

  !> Elastic forces of the foils as they were built, in their vector.
  subroutine find_elastic_force(foil, unknown)
    class(meshed_foil_type), intent(in) :: foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(foil%state, values, ierr))
    values = unknown(foil%first + foil%own_place)
    PetscCallA(GFB_VecRestoreArray(foil%state, values, ierr))
    PetscCallA(MatMult(foil%elastic, foil%state, foil%force, ierr))
  end subroutine find_elastic_force

  !> Elastic forces, and that of the top foil's initial moment, over the moduli.
  subroutine meshed_modulus_rates(self, unknown, rate)
    class(meshed_foil_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(inout) :: rate(:, :) !! (local unknowns of the bearing, 2) [SI]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    call find_elastic_force(self, unknown)
    PetscCallA(GFB_VecGetArrayRead(self%force, values, ierr))
    associate (top => self%owned_top, own => self%first + self%own_place)
      rate(own(:top), top_surface) = rate(own(:top), top_surface) + values(:top)
      rate(own(top + 1:), bump_surface) = rate(own(top + 1:), bump_surface) + values(top + 1:)
    end associate
    PetscCallA(GFB_VecRestoreArrayRead(self%force, values, ierr))
    if (.not. allocated(self%initial_load)) return
    associate (mine => rate(self%first + 1:self%first + size(self%initial_load), top_surface))
      mine = mine - self%initial_load
    end associate
  end subroutine meshed_modulus_rates

  !> Forces of the contacts, and of the top foil's initial moment.
  subroutine add_contact_forces(self, unknown, residual)
    class(meshed_foil_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
    real(wp), allocatable :: contact(:)
    PetscErrorCode :: ierr

    allocate (contact(self%local_unknowns()), source=0.0_wp)
    if (allocated(self%initial_load)) then
      associate (mine => residual(self%first + 1:self%first + size(contact)))
        mine = mine - self%modulus(top_surface)*self%initial_load
      end associate
    end if

    PetscCallA(PetscLogEventBegin(self%events%contact, ierr))
    call self%contacts%add_forces(self%own_part(unknown), contact)
    associate (mine => residual(self%first + 1:self%first + size(contact)))
      mine = mine - contact
    end associate
    PetscCallA(PetscLogEventEnd(self%events%contact, ierr))
  end subroutine add_contact_forces

  !> Stiffness of the contacts as they are linearised.
  subroutine meshed_jacobian(self, unknown, jacobian)
    class(meshed_foil_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(PetscLogEventBegin(self%events%contact, ierr))
    do i = 1, size(self%contacts%point)
      call add_contact(self, i, 1.0_wp, jacobian)
    end do
    PetscCallA(PetscLogEventEnd(self%events%contact, ierr))
  end subroutine meshed_jacobian

  !> Adds a contact's stiffness times a factor by local numbers.
  subroutine add_contact(foil, i, factor, matrix)
    class(meshed_foil_type), intent(in) :: foil
    integer, intent(in) :: i
    real(wp), intent(in) :: factor !! 0: makes room
    Mat, intent(in) :: matrix
    integer, allocatable :: unknown(:)
    PetscInt, allocatable :: number(:)
    PetscErrorCode :: ierr

    unknown = foil%contacts%point_unknowns(i)
    number = int(merge(foil%first + unknown - 1, -1, unknown > 0), pint)
    PetscCallA(MatSetValuesLocal(matrix, int(size(number), pint), number, int(size(number), pint), number, [factor*transpose(foil%contacts%point_block(i))], ADD_VALUES, ierr))
  end subroutine add_contact

  !> Pressure on the top foil, and room for the contacts.
  subroutine meshed_constant(self, jacobian)
    class(meshed_foil_type), intent(in) :: self !! the foil
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
    PetscInt :: row(size(self%pressed, 1)), column(size(self%pressed, 1))
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(self%pressed, 2)
      row = int(merge(self%first + self%pushed(:, i) - 1, -1, self%pushed(:, i) > 0), pint)
      column = int(self%pressed(:, i) - 1, pint)
      PetscCallA(MatSetValuesLocal(jacobian, int(size(row), pint), row, int(size(column), pint), column, [transpose(self%weight(:, :, i))], ADD_VALUES, ierr))
      if (.not. self%has_room) cycle
      PetscCallA(MatSetValuesLocal(jacobian, int(size(row), pint), row, int(size(row), pint), row, [0.0_wp*self%weight(:, :, i)], ADD_VALUES, ierr))
    end do
    do i = 1, size(self%contacts%point)
      call add_contact(self, i, 0.0_wp, jacobian)
    end do
  end subroutine meshed_constant

  !> Load of a pressure that depends on other unknowns.
  subroutine meshed_load_rates(self, column, slope, jacobian)
    class(meshed_foil_type), intent(in) :: self !! the foil
    integer, intent(in) :: column(:, :) !! (3 or 5, film nodes) local numbers from 0; negative: none
    real(wp), intent(in) :: slope(:, :) !! (3 or 5, film nodes) of the pressure by these unknowns [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(size(column, 1), size(self%pressed, 1), size(self%pressed, 1))
    PetscInt :: row(size(self%pressed, 1)), numbers(size(column, 1), size(self%pressed, 1))
    PetscErrorCode :: ierr
    integer :: element, i, j

    do element = 1, size(self%pressed, 2)
      associate (nodes => self%pressed(:, element), number => self%pushed(:, element))
        row = int(merge(self%first + number - 1, -1, number > 0), pint)
        numbers = int(column(:, nodes), pint)
        do i = 1, size(row)
          do j = 1, size(nodes)
            block(:, j, i) = self%weight(i, j, element)*slope(:, nodes(j))
          end do
        end do
      end associate
      PetscCallA(MatSetValuesLocal(jacobian, int(size(row), pint), row, int(size(numbers), pint), [numbers], [block], ADD_VALUES, ierr))
    end do
  end subroutine meshed_load_rates

  !> The foils stay where they are: Newton's method finds the contacts from there.
  subroutine meshed_estimate(self, unknown)
    class(meshed_foil_type), intent(in) :: self !! the foil
    real(wp), intent(inout) :: unknown(:) !! local unknowns of the bearing [SI]
  end subroutine meshed_estimate

  !> Both foils have meshes.
  pure logical function meshed_is_meshed(self) result(meshed)
    class(meshed_foil_type), intent(in) :: self !! the foil
    meshed = .true.
  end function meshed_is_meshed

  !> Foils with meshes across the width move with the pressures there.
  pure logical function meshed_moves_against_mirror(self) result(moves)
    class(meshed_foil_type), intent(in) :: self !! the foil
    moves = .true.
  end function meshed_moves_against_mirror

  !> Displacements and stresses of all surfaces.
  function meshed_motions(self, unknown, modulus) result(list)
    class(meshed_foil_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(in) :: modulus(2) !! see `soften`
    type(surface_motion_type), allocatable :: list(:)
    type(foil_surface_type), allocatable :: surface(:)
    type(nodal_values_type), allocatable :: moved(:)
    integer :: i

    surface = self%surfaces()
    allocate (list(size(surface)))
    call self%split_displacements(unknown, moved)
    do i = 1, size(list)
      call move_alloc(moved(i)%value, list(i)%displacement)
      list(i)%stress = modulus(i)*self%stresses(surface(i), from_rest(self, surface(i), list(i)%displacement))
    end do
  end function meshed_motions

  !> Displacements of a surface from where it is free of stress.
  function from_rest(foil, surface, displacement) result(moved)
    class(meshed_foil_type), intent(in) :: foil !! whose surface it is
    type(foil_surface_type), intent(in) :: surface !! that
    real(wp), intent(in) :: displacement(:, :) !! (5, local nodes) [m], [rad]
    real(wp) :: moved(size(displacement, 1), size(displacement, 2)) !! [m], [rad]

    moved = displacement
    if (surface%lies_on_film .and. allocated(foil%initial_load)) moved = moved - free_shape(surface, foil%initial_curvature)
  end function from_rest

  !> Displacements that take the initial bending off a foil that was unrolled: of a cylinder.
  !>
  !> $$ v = \tfrac{1}{2} \kappa_0 x^2, \quad \alpha = \kappa_0 x $$
  pure function free_shape(surface, curvature) result(moved)
    type(foil_surface_type), intent(in) :: surface
    real(wp), intent(in) :: curvature !! [1/m]
    real(wp) :: moved(5, size(surface%part%mesh_node)) ! [m], [rad]

    moved = 0.0_wp
    associate (x => surface%mesh%position(1, surface%part%mesh_node))
      moved(2, :) = 0.5_wp*curvature*x**2
      moved(4, :) = curvature*x
    end associate
  end function free_shape

  !> Frees the matrix and its vectors; may be called twice.
  subroutine free_matrix(self)
    class(meshed_foil_type), intent(inout) :: self !! the foil
    PetscErrorCode :: ierr

    if (.not. self%has_matrix) return
    PetscCallA(MatDestroy(self%elastic, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
    PetscCallA(VecDestroy(self%force, ierr))
    self%has_matrix = .false.
  end subroutine free_matrix
end module gfb_meshed_foil
