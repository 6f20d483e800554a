#include "gfb_petsc.h"
!> Film, foil and shaft as one set of equations.
!>
!> Local unknowns of a rank, in this order: the pressures of its film nodes (its own and its
!> neighbours'), the foil's unknowns, and \( (e_x, e_y) \) where the shaft floats. Newton sees them
!> divided by their sizes (ambient pressure, clearance), and the equations by the sizes of their terms.
module gfb_bearing_system
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_film_mesh, only: film_mesh_type, film_elements
  use gfb_mesh_dm, only: local_mesh_type, distribute_mesh
  use gfb_gas_film, only: gas_film_type, create_gas_film
  use gfb_film_geometry, only: film_nodes
  use gfb_film_load, only: film_forces
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks, share_failure
  use gfb_partition, only: partition_elements
  use gfb_foil_model, only: foil_model_type
  use gfb_operating_point, only: operating_point_type
  use gfb_nonlinear_system, only: nonlinear_system_type
  implicit none (type)
  private
  public :: create_film_part, create_bearing_system, film_on_all_ranks

  integer, parameter :: shaft_unknowns = 2

  !> The bearing at one operating point.
  type, extends(nonlinear_system_type), public :: bearing_system_type
    type(operating_point_type) :: point    !! what it is asked to bear now
    logical :: floats = .false.            !! (e_x, e_y) are unknowns
    logical :: held = .false.              !! they are, but kept at the point's eccentricity
    type(film_mesh_type) :: whole          !! the film's mesh
    type(local_mesh_type) :: mesh          !! this rank's part of it
    type(gas_film_type) :: film
    class(foil_model_type), allocatable :: foil
    integer :: unknowns = 0                !! of the bearing, on all ranks
    integer :: first_shaft = 0             !! local unknowns before e_x
    logical :: last_rank = .false.         !! this rank owns the shaft's equations
    real(wp) :: force_scale = 1.0_wp       !! size of a force [N]
    integer, private :: owned = 0          !! unknowns this rank owns
    real(wp), allocatable, private :: unknown_scale(:)  !! of the local unknowns, in SI
    real(wp), allocatable, private :: equation_scale(:) !! of the local equations, in SI
    Vec, private :: local
    Vec, private :: left, right
    VecScatter, private :: ghosts
  contains
    procedure :: evaluate => evaluate_bearing
    procedure :: linearise => linearise_bearing
    procedure :: get_unknowns
    procedure :: set_unknowns
    procedure :: local_size
    procedure :: gap => bearing_gap
    procedure :: position => bearing_position
    procedure :: eccentricity => bearing_eccentricity
    procedure :: smallest_gap
    procedure :: reaction
    procedure :: apply_point
    procedure :: destroy => destroy_bearing
  end type bearing_system_type

contains

  !> Distributes the film's mesh and sets up this rank's part of the film.
  !>
  !> Fails when the mesh cannot be cut, or an element is folded over.
  subroutine create_film_part(whole, clearance, ambient_pressure, viscosity, upwind, bearing, error)
    type(film_mesh_type), intent(in) :: whole
    real(wp), intent(in) :: clearance        !! C [m]
    real(wp), intent(in) :: ambient_pressure !! p_a [Pa]
    real(wp), intent(in) :: viscosity        !! of the gas [Pa s]
    logical, intent(in) :: upwind            !! SUPG instead of Galerkin
    type(bearing_system_type), intent(out) :: bearing
    type(error_type), allocatable, intent(out) :: error

    real(wp), allocatable :: position(:, :)
    integer, allocatable :: element_nodes(:, :), part(:)
    integer :: rank, ranks, i, j
    PetscErrorCode :: ierr

    bearing%whole = whole
    call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
    call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
    if (rank == 0) then
      element_nodes = film_elements(whole)
      call partition_elements(element_nodes, whole%nodes(), ranks, part, error)
      position = reshape([((whole%radius*whole%station_angle(i), whole%row_axial(j), &
                            j=1, whole%rows()), i=1, whole%stations())], [2, whole%nodes()])
    else
      allocate (element_nodes(4, 0), part(0), position(2, 0))
    end if
    call share_failure(error)
    if (allocated(error)) return
    call distribute_mesh(PETSC_COMM_WORLD, element_nodes, part, position, [(1, i=1, whole%nodes())], &
                         bearing%mesh)
    call create_gas_film(whole, bearing%mesh%mesh_node, bearing%mesh%element_nodes, clearance, &
                         ambient_pressure, viscosity, upwind, bearing%film, error)
  end subroutine create_film_part

  !> Puts film, foil and shaft together; the foil moves into the system.
  subroutine create_bearing_system(bearing, foil, floats)
    type(bearing_system_type), intent(inout) :: bearing !! with its film
    class(foil_model_type), allocatable, intent(inout) :: foil
    logical, intent(in) :: floats !! (e_x, e_y) are unknowns

    PetscInt, allocatable :: global(:)

    call move_alloc(foil, bearing%foil)
    call bearing%foil%place(size(bearing%mesh%mesh_node))
    bearing%floats = floats
    bearing%dense_rows = floats
    bearing%first_shaft = size(bearing%mesh%mesh_node) + bearing%foil%local_unknowns()
    call number_unknowns(bearing, global)
    call create_vectors(bearing, global)
    call create_matrix(bearing, global)
    call scale_unknowns(bearing)
  end subroutine create_bearing_system

  !> Global number, from 0, of every local unknown: on each rank film, foil, and last the shaft.
  subroutine number_unknowns(bearing, global)
    type(bearing_system_type), intent(inout) :: bearing
    PetscInt, allocatable, intent(out) :: global(:)

    integer, allocatable :: film_end(:), foil_end(:), all_end(:), both(:, :)
    integer :: ranks, rank, owner, i
    PetscErrorCode :: ierr

    call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
    call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
    bearing%last_rank = rank == ranks - 1
    bearing%owned = bearing%mesh%owned_unknowns + bearing%foil%owned
    if (bearing%floats .and. bearing%last_rank) bearing%owned = bearing%owned + shaft_unknowns
    allocate (both(2, ranks))
    call MPI_Allgather([bearing%mesh%owned_unknowns, bearing%foil%owned], 2, MPI_INTEGER, both, 2, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    film_end = [(sum(both(1, :i)), i=0, ranks)]
    foil_end = [(sum(both(2, :i)), i=0, ranks)]
    all_end = film_end + foil_end
    bearing%unknowns = all_end(ranks + 1) + merge(shaft_unknowns, 0, bearing%floats)

    allocate (global(bearing%local_size()))
    owner = 1
    do i = 1, size(bearing%mesh%first_unknown)
      call find_owner(film_end, bearing%mesh%first_unknown(i), owner)
      global(i) = all_end(owner) + bearing%mesh%first_unknown(i) - film_end(owner) - 1
    end do
    do i = 1, bearing%foil%local_unknowns()
      call find_owner(foil_end, bearing%foil%global_unknown(i), owner)
      global(bearing%foil%first + i) = film_end(owner + 1) + bearing%foil%global_unknown(i) - 1
    end do
    if (bearing%floats) then
      global(bearing%first_shaft + 1:) = [(int(all_end(ranks + 1) + i - 1, pint), i=1, shaft_unknowns)]
    end if
  end subroutine number_unknowns

  !> Moves `owner` to the rank, from 1, in whose range a number lies.
  pure subroutine find_owner(range_end, number, owner)
    integer, intent(in) :: range_end(0:)
    integer, intent(in) :: number   !! from 1
    integer, intent(inout) :: owner !! where the search begins

    if (number <= range_end(owner - 1)) owner = 1
    do while (number > range_end(owner))
      owner = owner + 1
    end do
  end subroutine find_owner

  !> State, ghost exchange and scaling vectors.
  subroutine create_vectors(bearing, global)
    type(bearing_system_type), intent(inout) :: bearing
    PetscInt, intent(in) :: global(:)
    IS :: from
    PetscErrorCode :: ierr

    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(bearing%owned, pint), PETSC_DETERMINE, bearing%state, ierr))
    PetscCallA(VecCreateSeq(PETSC_COMM_SELF, int(size(global), pint), bearing%local, ierr))
    PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, int(size(global), pint), global, PETSC_COPY_VALUES, from, ierr))
    PetscCallA(VecScatterCreate(bearing%state, from, bearing%local, PETSC_NULL_IS, bearing%ghosts, ierr))
    PetscCallA(ISDestroy(from, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%left, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%right, ierr))
  end subroutine create_vectors

  !> Matrix with room for what each row couples: film nodes around, foil, shaft.
  subroutine create_matrix(bearing, global)
    type(bearing_system_type), intent(inout) :: bearing
    PetscInt, intent(in) :: global(:)

    integer, parameter :: film_row = 9 ! a node and its neighbours
    ISLocalToGlobalMapping :: map
    PetscInt, allocatable :: inside(:), outside(:)
    PetscErrorCode :: ierr
    integer :: film, foil, shaft

    shaft = merge(shaft_unknowns, 0, bearing%floats)
    film = film_row + bearing%foil%couplings + shaft
    foil = bearing%foil%row_entries
    allocate (inside(bearing%owned), source=int(film, pint))
    inside(bearing%mesh%owned_unknowns + 1:bearing%mesh%owned_unknowns + bearing%foil%owned) = foil
    if (bearing%floats .and. bearing%last_rank) inside(bearing%owned - shaft_unknowns + 1:) = bearing%owned
    outside = inside
    inside = min(inside, int(bearing%owned, pint))
    if (bearing%floats .and. bearing%last_rank) then
      outside(bearing%owned - shaft_unknowns + 1:) = bearing%unknowns - bearing%owned
    end if
    outside = min(outside, int(bearing%unknowns - bearing%owned, pint))

    PetscCallA(MatCreate(PETSC_COMM_WORLD, bearing%jacobian, ierr))
    PetscCallA(MatSetSizes(bearing%jacobian, int(bearing%owned, pint), int(bearing%owned, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(bearing%jacobian, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(bearing%jacobian, 0_pint, inside, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(bearing%jacobian, 0_pint, inside, 0_pint, outside, ierr))
    PetscCallA(ISLocalToGlobalMappingCreate(PETSC_COMM_WORLD, 1_pint, int(size(global), pint), global, PETSC_COPY_VALUES, map, ierr))
    PetscCallA(MatSetLocalToGlobalMapping(bearing%jacobian, map, map, ierr))
    PetscCallA(ISLocalToGlobalMappingDestroy(map, ierr))
  end subroutine create_matrix

  !> Sizes of unknowns and equations.
  subroutine scale_unknowns(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    integer :: nodes

    nodes = size(bearing%mesh%mesh_node)
    allocate (bearing%unknown_scale(bearing%local_size()), bearing%equation_scale(bearing%local_size()))
    associate (foil => bearing%foil)
      bearing%unknown_scale(:nodes) = bearing%film%ambient_pressure
      bearing%unknown_scale(foil%first + 1:foil%first + foil%local_unknowns()) = foil%unknown_scale
      bearing%equation_scale(foil%first + 1:foil%first + foil%local_unknowns()) = foil%equation_scale
    end associate
    bearing%unknown_scale(bearing%first_shaft + 1:) = bearing%film%clearance
    call bearing%apply_point()
  end subroutine scale_unknowns

  !> Takes over the present operating point: speed of the film, sizes of its and the shaft's equations.
  !>
  !> A film equation is measured by the flow through a cell, that of the pressure and that of the
  !> motion; a force by the load and by ambient pressure on the bearing's shadow.
  subroutine apply_point(self)
    class(bearing_system_type), intent(inout) :: self
    real(wp) :: along, across, cell_flow
    integer :: nodes

    nodes = size(self%mesh%mesh_node)
    self%film%flow%entraining_speed = 0.5_wp*self%point%speed*self%whole%radius
    associate (film => self%film, whole => self%whole)
      along = whole%radius*abs(whole%station_angle(2) - whole%station_angle(1))
      across = whole%row_axial(2) - whole%row_axial(1)
      cell_flow = film%ambient_pressure**2*film%clearance**3/(12.0_wp*film%flow%viscosity)* &
        (along/across + across/along) &
        + abs(film%flow%entraining_speed)*film%ambient_pressure*film%clearance*across
      self%equation_scale(:nodes) = merge(film%ambient_pressure, cell_flow, film%fixed)
      self%force_scale = norm2(self%point%load) + film%ambient_pressure*whole%radius* &
        film%copies*(whole%row_axial(whole%rows()) - whole%row_axial(1))
    end associate
    self%equation_scale(self%first_shaft + 1:) = self%force_scale
    call put_owned(self, 1.0_wp/self%equation_scale, self%left)
    call put_owned(self, self%unknown_scale, self%right)
  end subroutine apply_point

  !> Residual of all equations.
  subroutine evaluate_bearing(self, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state
    Vec, intent(in) :: residual
    logical, intent(out) :: valid

    real(wp) :: unknown(self%local_size()), value(self%local_size())
    real(wp) :: gap(size(self%mesh%mesh_node)), force(film_forces)
    type(operating_point_type) :: point
    integer :: nodes, shaft
    PetscErrorCode :: ierr

    nodes = size(gap)
    shaft = self%first_shaft
    call get_local(self, state, unknown)
    gap = self%gap(unknown)
    value = 0.0_wp
    point = self%position(unknown)
    valid = self%film%is_open(unknown(:nodes), gap, point)
    if (valid) then
      call self%film%add_residual(unknown(:nodes), gap, point, value)
      where (self%film%fixed .and. self%mesh%owned)
        value(:nodes) = unknown(:nodes) - self%film%ambient_pressure
      end where
      call self%foil%add_residual(unknown, value)
      if (self%floats .and. .not. self%held) then
        force = self%film%force(unknown(:nodes))
        value(shaft + 1:) = force(1:2)
      end if
      if (self%floats .and. self%last_rank) then
        if (self%held) then
          value(shaft + 1:) = (unknown(shaft + 1:) - self%point%eccentricity)* &
            self%force_scale/self%film%clearance
        else
          value(shaft + 1:) = value(shaft + 1:) - self%point%load
        end if
      end if
      value = value/self%equation_scale
    end if
    PetscCallA(VecSet(residual, 0.0_wp, ierr))
    call add_local(self, value, residual)
  end subroutine evaluate_bearing

  !> Derivative of all equations.
  subroutine linearise_bearing(self, state)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state

    real(wp) :: unknown(self%local_size()), gap(size(self%mesh%mesh_node))
    PetscErrorCode :: ierr

    call get_local(self, state, unknown)
    gap = self%gap(unknown)
    PetscCallA(MatZeroEntries(self%jacobian, ierr))
    call add_film_jacobian(self, unknown(:size(gap)), gap, self%position(unknown))
    call self%foil%add_jacobian(unknown, self%jacobian)
    if (self%floats) call add_shaft_jacobian(self)
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDiagonalScale(self%jacobian, self%left, self%right, ierr))
  end subroutine linearise_bearing

  !> Film rows: pressures, what moves the foil, and the shaft.
  subroutine add_film_jacobian(self, pressure, gap, point)
    class(bearing_system_type), intent(inout) :: self
    real(wp), intent(in) :: pressure(:) !! at this rank's nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at this rank's nodes [m]
    type(operating_point_type), intent(in) :: point

    integer, parameter :: columns = 2*film_nodes + shaft_unknowns
    real(wp) :: by_pressure(film_nodes, film_nodes), by_gap(film_nodes, film_nodes)
    real(wp) :: by_eccentricity(film_nodes, shaft_unknowns)
    real(wp) :: block(columns, film_nodes) ! a row of the matrix in each column, as PETSc reads it
    PetscInt :: row(film_nodes), column(columns)
    integer :: element, b, node

    column = -1 ! PETSc skips negative numbers
    if (self%floats) column(2*film_nodes + 1:) = [(int(self%first_shaft + b, pint), b=0, 1)]
    do element = 1, size(self%film%element_nodes, 2)
      associate (nodes => self%film%element_nodes(:, element))
        call self%film%element_jacobian(element, pressure, gap, point, by_pressure, by_gap, &
                                        by_eccentricity)
        block = 0.0_wp
        do b = 1, film_nodes
          node = nodes(b)
          row(b) = int(merge(-1, node - 1, self%film%fixed(node)), pint)
          column(b) = node - 1
          block(b, :) = by_pressure(:, b)
          if (self%foil%source(node) == node) then
            block(b, :) = block(b, :) + self%foil%rate(node)*by_gap(:, b)
          else
            column(film_nodes + b) = self%foil%source(node) - 1
            block(film_nodes + b, :) = self%foil%rate(node)*by_gap(:, b)
          end if
        end do
        block(2*film_nodes + 1:, :) = transpose(by_eccentricity)
      end associate
      call add_block(self%jacobian, row, column, block)
    end do
    do node = 1, size(gap)
      if (.not. (self%film%fixed(node) .and. self%mesh%owned(node))) cycle
      row(1) = node - 1
      call add_block(self%jacobian, row(1:1), row(1:1), [1.0_wp])
    end do
  end subroutine add_film_jacobian

  !> Shaft rows: weights of the pressures in the force, or the position where it is held.
  subroutine add_shaft_jacobian(self)
    class(bearing_system_type), intent(inout) :: self

    PetscInt :: row(shaft_unknowns)
    PetscInt, allocatable :: column(:)
    real(wp) :: diagonal(shaft_unknowns, shaft_unknowns)
    real(wp), allocatable :: weight(:, :)
    integer :: i

    row = [(int(self%first_shaft + i - 1, pint), i=1, shaft_unknowns)]
    column = [(int(i - 1, pint), i=1, size(self%mesh%mesh_node))]
    allocate (weight(size(column), shaft_unknowns), source=0.0_wp)
    if (.not. self%held) weight = transpose(self%film%force_weight(1:2, :))
    call add_block(self%jacobian, row, column, weight)
    diagonal = 0.0_wp ! the pattern stays the same when the shaft is let go
    if (self%last_rank) then
      if (self%held) then
        diagonal(1, 1) = self%force_scale/self%film%clearance
        diagonal(2, 2) = diagonal(1, 1)
      end if
      call add_block(self%jacobian, row, row, diagonal)
    end if
  end subroutine add_shaft_jacobian

  !> Adds a block to the matrix by local numbers, from 0; negative ones are skipped.
  subroutine add_block(matrix, row, column, block)
    Mat, intent(in) :: matrix
    PetscInt, intent(in) :: row(:), column(:)
    real(wp), intent(in) :: block(size(column)*size(row)) !! one row after the other
    PetscErrorCode :: ierr

    PetscCallA(MatSetValuesLocal(matrix, int(size(row), pint), row, int(size(column), pint), column, block, ADD_VALUES, ierr))
  end subroutine add_block

  !> Gap at this rank's nodes for local unknowns [m].
  function bearing_gap(self, unknown) result(gap)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: gap(size(self%mesh%mesh_node))

    gap = self%film%gap(self%position(unknown), self%foil%deflection(unknown))
  end function bearing_gap

  !> The operating point with the eccentricity that is found or held.
  pure function bearing_position(self, unknown) result(point)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type) :: point

    point = self%point
    if (self%floats) point%eccentricity = unknown(self%first_shaft + 1:self%first_shaft + 2)
  end function bearing_position

  !> Eccentricity at the present state, found or held [m].
  function bearing_eccentricity(self) result(eccentricity)
    class(bearing_system_type), intent(in) :: self
    real(wp) :: eccentricity(2)
    real(wp) :: unknown(self%local_size())

    eccentricity = self%point%eccentricity
    if (.not. self%floats) return
    call self%get_unknowns(unknown)
    eccentricity = unknown(self%first_shaft + 1:self%first_shaft + 2)
  end function bearing_eccentricity

  !> Smallest gap at the present state, over all ranks [m].
  function smallest_gap(self) result(gap)
    class(bearing_system_type), intent(in) :: self
    real(wp) :: gap
    real(wp) :: unknown(self%local_size()), depth(1)

    call self%get_unknowns(unknown)
    depth = largest_over_ranks([-minval(self%gap(unknown))])
    gap = -depth(1)
  end function smallest_gap

  !> Force and torque of the film at the present state, over all ranks [N], [N m].
  function reaction(self) result(force)
    class(bearing_system_type), intent(in) :: self
    real(wp) :: force(film_forces)
    real(wp) :: unknown(self%local_size())

    call self%get_unknowns(unknown)
    force = sum_over_ranks(self%film%force(unknown(:size(self%mesh%mesh_node))))
  end function reaction

  !> A film field, known at each rank's nodes, by the whole mesh's numbers on all ranks.
  function film_on_all_ranks(bearing, value) result(whole)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: value(:) !! at the local nodes
    real(wp) :: whole(bearing%whole%nodes())
    integer :: node

    whole = 0.0_wp
    do node = 1, size(bearing%mesh%mesh_node)
      if (bearing%mesh%owned(node)) whole(bearing%mesh%mesh_node(node)) = value(node)
    end do
    whole = sum_over_ranks(whole)
  end function film_on_all_ranks

  !> Local unknowns at the present state, in SI.
  subroutine get_unknowns(self, unknown)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(out) :: unknown(:)
    call get_local(self, self%state, unknown)
  end subroutine get_unknowns

  !> Makes local unknowns, in SI, the present state.
  subroutine set_unknowns(self, unknown)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    call put_owned(self, unknown/self%unknown_scale, self%state)
  end subroutine set_unknowns

  !> Local unknowns of this rank.
  pure function local_size(self) result(unknowns)
    class(bearing_system_type), intent(in) :: self
    integer :: unknowns
    unknowns = self%first_shaft + merge(shaft_unknowns, 0, self%floats)
  end function local_size

  !> Local unknowns, in SI, of a scaled vector.
  subroutine get_local(self, state, unknown)
    class(bearing_system_type), intent(in) :: self
    Vec, intent(in) :: state
    real(wp), intent(out) :: unknown(:)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(VecScatterBegin(self%ghosts, state, self%local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(VecScatterEnd(self%ghosts, state, self%local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(GFB_VecGetArrayRead(self%local, values, ierr))
    unknown = values*self%unknown_scale
    PetscCallA(GFB_VecRestoreArrayRead(self%local, values, ierr))
  end subroutine get_local

  !> Writes local values into a vector; where ranks share an unknown their values must agree.
  subroutine put_owned(self, value, vector)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: value(:)
    Vec, intent(in) :: vector
    PetscErrorCode :: ierr

    call fill_local(self, value)
    PetscCallA(VecScatterBegin(self%ghosts, self%local, vector, INSERT_VALUES, SCATTER_REVERSE, ierr))
    PetscCallA(VecScatterEnd(self%ghosts, self%local, vector, INSERT_VALUES, SCATTER_REVERSE, ierr))
  end subroutine put_owned

  !> Adds every rank's local values to a vector.
  subroutine add_local(self, value, vector)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: value(:)
    Vec, intent(in) :: vector
    PetscErrorCode :: ierr

    call fill_local(self, value)
    PetscCallA(VecScatterBegin(self%ghosts, self%local, vector, ADD_VALUES, SCATTER_REVERSE, ierr))
    PetscCallA(VecScatterEnd(self%ghosts, self%local, vector, ADD_VALUES, SCATTER_REVERSE, ierr))
  end subroutine add_local

  !> Fills the local vector.
  subroutine fill_local(self, value)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: value(:)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(self%local, values, ierr))
    values = value
    PetscCallA(GFB_VecRestoreArray(self%local, values, ierr))
  end subroutine fill_local

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_bearing(self)
    class(bearing_system_type), intent(inout) :: self
    PetscErrorCode :: ierr

    if (.not. allocated(self%foil)) return
    PetscCallA(MatDestroy(self%jacobian, ierr))
    PetscCallA(VecScatterDestroy(self%ghosts, ierr))
    PetscCallA(VecDestroy(self%right, ierr))
    PetscCallA(VecDestroy(self%left, ierr))
    PetscCallA(VecDestroy(self%local, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
    deallocate (self%foil)
  end subroutine destroy_bearing
end module gfb_bearing_system
