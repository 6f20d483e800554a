#include "gfb_petsc.h"
!> Top foil and bump strip as shells under the film.
!>
!> Equations: elastic forces of both foils, the film's pressure on the top foil ([Gu2020] eq. 2),
!> and the contacts of crests with the top foil and of corners with the sleeve. The top foil has the
!> film's nodes; its deflection is \( h_f = -v \).
module gfb_shell_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_bump_contacts, only: contact_top
  use gfb_contact_law, only: state_open
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  implicit none (type)
  private


  !> Both foils and this rank's part of their equations.
  type, extends(foil_model_type), public :: shell_foil_type
    type(foil_structure_type) :: top, bumps
    type(contact_set_type) :: contacts        !! its unknowns are the local foil unknowns
    real(wp) :: ambient_pressure = 0.0_wp     !! p_a [Pa]
    integer, allocatable :: pressed(:, :)     !! (nodes, elements) film nodes of an element, local
    integer, allocatable :: pushed(:, :)      !! (nodes, elements) local foil unknown v there, 0: held
    real(wp), allocatable :: weight(:, :, :)  !! (nodes, nodes, elements) of p - p_a in the force on v [m2]
    logical :: has_room = .false.             !! in the matrix, between all unknowns that an element pushes
    integer, allocatable :: own_place(:)      !! local foil unknown of each owned one
    real(wp) :: first_hardness = 1.0_wp       !! of contacts that are little harder than the bumps
    Vec :: state, force                       !! of the owned unknowns, in SI
  contains
    procedure :: add_residual => shell_residual
    procedure :: add_jacobian => shell_jacobian
    procedure :: estimate => shell_estimate
    procedure :: add_constant => shell_constant
    procedure :: add_load_rates => shell_load_rates
    procedure :: settle => shell_settle
    procedure :: begin_step => shell_begin_step
    procedure :: set_hardness => shell_set_hardness
    procedure :: set_adhesion => shell_set_adhesion
    procedure :: softest => shell_softest
    procedure :: crest_lengths => shell_crest_lengths
    procedure :: next_contact_change => shell_next_change
    procedure :: add_penetration_rates => shell_penetration_rates
    procedure :: split_displacements => shell_displacements
    procedure :: nodal_contacts => shell_contacts
    procedure :: own_unknown => shell_own_unknown
    procedure :: commit => shell_commit
    procedure :: destroy => shell_destroy
  end type shell_foil_type

contains

  !> Elastic forces, pressure and contacts.
  subroutine shell_residual(self, unknown, residual)
    class(shell_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    real(wp), intent(inout) :: residual(:)

    real(wp) :: contact(self%local_unknowns()), load(size(self%pressed, 1))
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: element, i

    PetscCallA(GFB_VecGetArray(self%state, values, ierr))
    values = unknown(self%first + self%own_place)
    PetscCallA(GFB_VecRestoreArray(self%state, values, ierr))
    PetscCallA(MatMult(self%elastic, self%state, self%force, ierr))
    PetscCallA(GFB_VecGetArrayRead(self%force, values, ierr))
    residual(self%first + self%own_place) = residual(self%first + self%own_place) + values
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

    PetscCallA(PetscLogEventBegin(self%events%contact, ierr))
    contact = 0.0_wp
    call self%contacts%add_forces(own_part(self, unknown), contact)
    associate (mine => residual(self%first + 1:self%first + size(contact)))
      mine = mine - contact
    end associate
    PetscCallA(PetscLogEventEnd(self%events%contact, ierr))
  end subroutine shell_residual

  !> The foil's part of the bearing's local unknowns.
  pure function own_part(foil, unknown) result(part)
    class(shell_foil_type), intent(in) :: foil
    real(wp), intent(in) :: unknown(:)
    real(wp) :: part(foil%local_unknowns())
    part = unknown(foil%first + 1:foil%first + size(part))
  end function own_part

  !> Stiffness of the contacts as they are linearised.
  subroutine shell_jacobian(self, unknown, jacobian)
    class(shell_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    Mat, intent(in) :: jacobian
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(PetscLogEventBegin(self%events%contact, ierr))
    do i = 1, size(self%contacts%point)
      call add_contact(self, i, 1.0_wp, jacobian)
    end do
    PetscCallA(PetscLogEventEnd(self%events%contact, ierr))
  end subroutine shell_jacobian

  !> Adds a contact's stiffness times a factor by local numbers.
  subroutine add_contact(foil, i, factor, matrix)
    class(shell_foil_type), intent(in) :: foil
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
  subroutine shell_constant(self, jacobian)
    class(shell_foil_type), intent(in) :: self
    Mat, intent(in) :: jacobian
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
  end subroutine shell_constant

  !> Load of a pressure that depends on other unknowns.
  subroutine shell_load_rates(self, column, slope, jacobian)
    class(shell_foil_type), intent(in) :: self
    integer, intent(in) :: column(:, :)
    real(wp), intent(in) :: slope(:, :)
    Mat, intent(in) :: jacobian
    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(size(column, 1), size(self%pressed, 1), size(self%pressed, 1))
    PetscInt :: row(size(self%pressed, 1)), place(size(column, 1), size(self%pressed, 1))
    PetscErrorCode :: ierr
    integer :: element, i, j

    do element = 1, size(self%pressed, 2)
      associate (nodes => self%pressed(:, element), number => self%pushed(:, element))
        row = int(merge(self%first + number - 1, -1, number > 0), pint)
        place = int(column(:, nodes), pint)
        do i = 1, size(row)
          do j = 1, size(nodes)
            block(:, j, i) = self%weight(i, j, element)*slope(:, nodes(j))
          end do
        end do
      end associate
      PetscCallA(MatSetValuesLocal(jacobian, int(size(row), pint), row, int(size(place), pint), [place], [block], ADD_VALUES, ierr))
    end do
  end subroutine shell_load_rates

  !> The foils stay where they are: contacts find their way from there.
  subroutine shell_estimate(self, unknown)
    class(shell_foil_type), intent(in) :: self
    real(wp), intent(inout) :: unknown(:)
  end subroutine shell_estimate

  !> Linearises every contact where the foils have gone.
  subroutine shell_settle(self, unknown, moved, settled)
    class(shell_foil_type), intent(inout) :: self
    real(wp), intent(in) :: unknown(:)
    logical, intent(out) :: moved, settled
    PetscErrorCode :: ierr

    PetscCallA(PetscLogEventBegin(self%events%contact, ierr))
    call self%contacts%settle(own_part(self, unknown))
    PetscCallA(PetscLogEventEnd(self%events%contact, ierr))
    moved = .true.
    settled = self%contacts%settled
  end subroutine shell_settle

  !> Makes the contacts softer than the scene has them.
  subroutine shell_set_hardness(self, hardness)
    class(shell_foil_type), intent(inout) :: self
    real(wp), intent(in) :: hardness
    self%contacts%hardness = hardness
  end subroutine shell_set_hardness

  !> Makes the contacts hold what they touch.
  subroutine shell_set_adhesion(self, adhesion)
    class(shell_foil_type), intent(inout) :: self
    real(wp), intent(in) :: adhesion
    self%contacts%adhesion = adhesion
  end subroutine shell_set_adhesion

  !> The hardness to begin with: bumps that float between open and closed find their state at once.
  pure function shell_softest(self) result(hardness)
    class(shell_foil_type), intent(in) :: self
    real(wp) :: hardness
    hardness = self%first_hardness
  end function shell_softest

  !> Length of this rank's crest lines that touches nothing, and of all of them [m].
  pure function shell_crest_lengths(self) result(length)
    class(shell_foil_type), intent(in) :: self
    real(wp) :: length(2)
    integer :: i

    length = 0.0_wp
    do i = 1, size(self%contacts%point)
      associate (point => self%contacts%point(i))
        if (point%law /= contact_top) cycle
        length(2) = length(2) + point%length
        if (self%contacts%state_of(i) == state_open) length(1) = length(1) + point%length
      end associate
    end do
  end function shell_crest_lengths

  !> Where on a way the first of this rank's contacts opens or closes.
  pure function shell_next_change(self, here, ahead) result(way)
    class(shell_foil_type), intent(in) :: self
    real(wp), intent(in) :: here(:), ahead(:)
    real(wp) :: way
    integer :: i

    way = huge(way)
    do i = 1, size(self%contacts%point)
      way = min(way, self%contacts%next_change(i, own_part(self, here), own_part(self, ahead)))
    end do
  end function shell_next_change

  !> The contacts that open or close there, all those of a symmetric foil at once.
  pure subroutine shell_penetration_rates(self, here, ahead, way, rate, distance, closes)
    class(shell_foil_type), intent(in) :: self
    real(wp), intent(in) :: here(:), ahead(:)
    real(wp), intent(in) :: way
    real(wp), intent(inout) :: rate(:)
    real(wp), intent(inout) :: distance
    logical, intent(inout) :: closes
    real(wp), parameter :: together = 1.0e-6_wp !! relative
    real(wp) :: first(3)
    integer :: i

    associate (mine => rate(self%first + 1:self%first + self%local_unknowns()), now => own_part(self, here), &
               next => own_part(self, ahead))
      do i = 1, size(self%contacts%point)
        if (self%contacts%next_change(i, now, next) > (1.0_wp + together)*way) cycle
        first = self%contacts%approach(i, now)
        call self%contacts%add_penetration_rate(i, -sign(1.0_wp, first(3)), mine)
        distance = distance + abs(first(3))
        closes = closes .or. first(3) < 0.0_wp
      end do
    end associate
  end subroutine shell_penetration_rates

  !> Displacements of all this rank's nodes of both foils, condensed ones recovered.
  subroutine shell_displacements(self, unknown, top, bumps)
    class(shell_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), allocatable, intent(out) :: top(:, :), bumps(:, :) !! (5, local nodes) [m], [1]
    integer :: mine

    mine = self%top%part%owned_unknowns
    call expand(self%top, unknown(self%first + self%own_place(:mine)), top)
    call expand(self%bumps, unknown(self%first + self%own_place(mine + 1:)), bumps)
  end subroutine shell_displacements

  !> This rank's contacts, each of one node of the bumps.
  function shell_contacts(self) result(contacts)
    class(shell_foil_type), intent(in) :: self
    type(contact_set_type) :: contacts
    contacts = self%contacts
  end function shell_contacts

  !> Local foil unknown of a component at one of this rank's own nodes; 0: held or condensed.
  pure function shell_own_unknown(self, of_bumps, component, node) result(place)
    class(shell_foil_type), intent(in) :: self
    logical, intent(in) :: of_bumps  !! instead of the top foil
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node      !! of the whole mesh
    integer :: place

    if (of_bumps) then
      place = self%bumps%unknown(component, node) + 1
      if (place > 0) place = self%own_place(self%top%part%owned_unknowns + place - self%bumps%first)
    else
      place = self%top%unknown(component, node) + 1
      if (place > 0) place = self%own_place(place - self%top%first)
    end if
  end function shell_own_unknown

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

  !> A new Newton step begins where the contacts are.
  subroutine shell_begin_step(self)
    class(shell_foil_type), intent(inout) :: self
    call self%contacts%drop_anchor()
  end subroutine shell_begin_step

  !> Friction carries its slip along.
  subroutine shell_commit(self, unknown)
    class(shell_foil_type), intent(inout) :: self
    real(wp), intent(in) :: unknown(:)
    call self%contacts%commit(own_part(self, unknown))
  end subroutine shell_commit

  !> Frees what PETSc holds.
  subroutine shell_destroy(self)
    class(shell_foil_type), intent(inout) :: self
    PetscErrorCode :: ierr

    if (.not. self%has_elastic) return
    PetscCallA(MatDestroy(self%elastic, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
    PetscCallA(VecDestroy(self%force, ierr))
    call destroy_foil_structure(self%top)
    call destroy_foil_structure(self%bumps)
    self%has_elastic = .false.
  end subroutine shell_destroy
end module gfb_shell_foil
