#include "gfb_petsc.h"
!> Film, foil and shaft as one set of equations.
!>
!> Local unknowns of a rank, in this order: the pressures of its film nodes (its own and its
!> neighbours'), the foil's unknowns, and \( (e_x, e_y) \) where the shaft floats. Newton sees them
!> divided by their sizes (ambient pressure, clearance), and the equations by the sizes of their
!> terms.
module gfb_bearing_system
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type, distribute_mesh
  use gfb_gas_film, only: gas_film_type, create_gas_film
  use gfb_solid_contact, only: solid_contact_type, contact_pressure
  use gfb_solid_rows, only: add_solid_rows
  use gfb_film_matrix, only: no_shaft, make_film_room, add_film_rows, add_shaft_rows
  use gfb_film_load, only: film_forces
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks, any_rank, rank_count, fetch_entries
  use gfb_partition, only: division_type, divide, no_chain
  use gfb_part_chains, only: film_chain, film_columns
  use gfb_foil_model, only: foil_model_type
  use gfb_free_edge, only: free_edge_type, find_free_edge
  use gfb_cost_events, only: cost_events_type, register_cost_events
  use gfb_operating_point, only: operating_point_type
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_shaft_motion, only: shaft_unknowns
  use gfb_blocks, only: blocks_type, block_type, create_blocks
  use gfb_local_exchange, only: local_exchange_type, create_exchange
  use gfb_matrix_rows, only: copy_row
  implicit none (type)
  private
  public :: create_film_part, create_bearing_system, film_values

  !> The bearing at one operating point.
  type, extends(nonlinear_system_type), public :: bearing_system_type
    type(operating_point_type) :: point    !! what it is asked to bear now
    logical :: floats = .false.            !! (e_x, e_y) are unknowns
    logical :: held = .false.              !! they are, but kept at the point's eccentricity
    type(film_mesh_type) :: whole          !! the film's mesh
    type(local_mesh_type) :: mesh          !! this rank's part of it
    type(gas_film_type) :: film
    type(solid_contact_type) :: contact    !! of the shaft with the foil
    class(foil_model_type), allocatable :: foil
    type(free_edge_type) :: edge           !! of the top foil
    type(blocks_type) :: blocks            !! of unknowns: film, foil; the shaft's are scalars
    integer :: unknowns = 0                !! of the bearing, on all ranks
    integer :: first_shaft = 0             !! local unknowns before e_x
    logical :: last_rank = .false.         !! this rank owns the shaft's equations
    real(wp), allocatable :: unknown_scale(:)  !! of the local unknowns, in SI
    Mat, private :: constant    !! what of the matrix never changes, in SI
    Vec, private :: left, right !! work space: sizes of equations, inverted; sizes of unknowns
    type(local_exchange_type) :: exchange
    type(cost_events_type), private :: events !! of PETSc's log
  contains
    procedure :: evaluate => evaluate_bearing
    procedure :: linearise => linearise_bearing
    procedure :: evaluate_at
    procedure :: linearise_at
    procedure :: settle => settle_bearing
    procedure :: begin_step => begin_bearing_step
    procedure :: virtual_work => work_on_foil
    procedure :: commit => commit_bearing
    procedure :: get_unknowns
    procedure :: set_unknowns
    procedure :: add_up => add_up_unknowns
    procedure :: local_size
    procedure :: gap => bearing_gap
    procedure :: solid_pressure
    procedure :: position => bearing_position
    procedure :: eccentricity => bearing_eccentricity
    procedure :: smallest_gap
    procedure :: reaction
    procedure :: force_scale
    procedure :: equation_scale
    procedure :: destroy => destroy_bearing
  end type bearing_system_type

contains

  !> Distributes the film's mesh and sets up this rank's part of the film.
  !>
  !> Fails when the mesh cannot be cut, or an element is folded over.
  subroutine create_film_part(whole, clearance, ambient_pressure, viscosity, upwind, bearing, error, column_part)
    type(film_mesh_type), intent(in) :: whole
    real(wp), intent(in) :: clearance        !! C [m]
    real(wp), intent(in) :: ambient_pressure !! p_a [Pa]
    real(wp), intent(in) :: viscosity        !! of the gas [Pa s]
    logical, intent(in) :: upwind            !! SUPG instead of Galerkin
    type(bearing_system_type), intent(out) :: bearing
    type(error_type), allocatable, intent(out) :: error
    !> rank, from 1, of every column of elements; default: the film is cut by itself
    integer, intent(in), optional :: column_part(:)

    type(division_type) :: division

    bearing%whole = whole
    if (present(column_part)) then
      division%film = column_part
    else
      call divide(film_chain(whole, .false.), no_chain(), rank_count(), division, error)
      if (allocated(error)) return
      division%film = film_columns(whole, division%film)
    end if
    call distribute_mesh(PETSC_COMM_WORLD, whole%stations(), whole%rows(), whole%periodic, division%film, bearing%mesh)
    call create_gas_film(whole, bearing%mesh%mesh_node, bearing%mesh%element_nodes, clearance, &
                         ambient_pressure, viscosity, upwind, bearing%film, error)
  end subroutine create_film_part

  !> Puts film, foil and shaft together; the foil moves into the system.
  subroutine create_bearing_system(bearing, foil, floats)
    type(bearing_system_type), intent(inout) :: bearing !! with its film
    class(foil_model_type), allocatable, intent(inout) :: foil
    logical, intent(in) :: floats !! (e_x, e_y) are unknowns

    PetscErrorCode :: ierr

    call move_alloc(foil, bearing%foil)
    call register_cost_events(bearing%events)
    bearing%foil%events = bearing%events
    call bearing%foil%place(size(bearing%mesh%mesh_node))
    call find_free_edge(bearing%whole, bearing%mesh, bearing%foil, bearing%edge)
    bearing%floats = floats
    bearing%dense_rows = floats
    call create_blocks([block_type(bearing%mesh%owned_unknowns, bearing%mesh%first_unknown), &
                        block_type(bearing%foil%owned, bearing%foil%global_unknown)], &
                       merge(shaft_unknowns, 0, floats), bearing%blocks)
    bearing%unknowns = bearing%blocks%border%unknowns
    bearing%last_rank = bearing%blocks%border%last_rank
    bearing%first_shaft = bearing%blocks%first(size(bearing%blocks%first))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(bearing%blocks%border%owned, pint), PETSC_DETERMINE, bearing%state, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%left, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%right, ierr))
    call create_exchange(bearing%blocks%global, bearing%state, bearing%exchange)
    call create_bearing_matrix(bearing)
    call scale_unknowns(bearing)
    if (bearing%foil%is_meshed()) call fill_constant(bearing)
  end subroutine create_bearing_system

  !> Matrix with room for what each row couples: film nodes around, foil, shaft.
  subroutine create_bearing_matrix(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    PetscInt, allocatable :: entries(:)

    associate (film_row => (2*bearing%whole%order + 1)**2, foil => bearing%foil) ! elements around a node
      entries = [spread(int(film_row + foil%couplings, pint), 1, bearing%mesh%owned_unknowns), int(foil%row_entries, pint)]
    end associate
    call bearing%blocks%create_matrix(entries, bearing%jacobian)
  end subroutine create_bearing_matrix

  !> Fills in what never changes in the matrix, with room for everything else, and keeps a copy.
  subroutine fill_constant(bearing)
    type(bearing_system_type), intent(inout) :: bearing

    PetscInt :: first, last, row, entries, number(maxval([0, bearing%foil%row_entries]))
    PetscInt, allocatable :: renumbered(:)
    PetscScalar :: value(size(number))
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(MatGetOwnershipRange(bearing%foil%elastic, first, last, ierr))
    do row = first, last - 1
      call copy_row(bearing%foil%elastic, row, entries, number, value)
      renumbered = [(int(bearing%blocks%global_number(2, int(number(i)) + 1), pint), i=1, int(entries))]
      PetscCallA(MatSetValues(bearing%jacobian, 1_pint, [int(bearing%blocks%global_number(2, int(row) + 1), pint)], entries, renumbered, value, ADD_VALUES, ierr))
    end do
    call bearing%foil%add_constant(bearing%jacobian)
    call make_film_room(bearing%film, bearing%foil, shaft_place(bearing), bearing%mesh%owned, bearing%jacobian)
    if (bearing%floats) then
      call add_shaft_rows(bearing%film, bearing%first_shaft, bearing%last_rank, &
                          hold_stiffness(bearing, bearing%point, bearing%held), 0.0_wp, bearing%jacobian)
    end if
    call add_solid_rows(bearing%contact, bearing%film, bearing%foil, shaft_place(bearing), .true., &
                        spread(bearing%film%clearance, 1, size(bearing%film%angle)), 0.0_wp, bearing%jacobian)
    PetscCallA(MatAssemblyBegin(bearing%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(bearing%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, bearing%constant, ierr))
  end subroutine fill_constant

  !> Local unknowns before e_x, where the shaft has any.
  pure function shaft_place(bearing) result(place)
    class(bearing_system_type), intent(in) :: bearing
    integer :: place
    place = merge(bearing%first_shaft, no_shaft, bearing%floats)
  end function shaft_place

  !> Force over displacement that keeps a fixed shaft at its position, 0 where it floats [N/m].
  pure function hold_stiffness(bearing, point, held) result(stiffness)
    class(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point !! whose load counts
    logical, intent(in) :: held                     !! the shaft is fixed
    real(wp) :: stiffness
    stiffness = merge(bearing%force_scale(point)/bearing%film%clearance, 0.0_wp, held)
  end function hold_stiffness

  !> Sizes of the unknowns.
  subroutine scale_unknowns(bearing)
    type(bearing_system_type), intent(inout) :: bearing

    allocate (bearing%unknown_scale(bearing%local_size()))
    associate (foil => bearing%foil)
      bearing%unknown_scale(:foil%first) = bearing%film%ambient_pressure
      bearing%unknown_scale(foil%first + 1:foil%first + foil%local_unknowns()) = foil%unknown_scale
    end associate
    bearing%unknown_scale(bearing%first_shaft + 1:) = bearing%film%clearance
    call bearing%exchange%put(bearing%unknown_scale, bearing%right)
  end subroutine scale_unknowns

  !> Sizes of the local equations at an operating point, in SI: a film equation is measured by the
  !> flow through a cell.
  pure function equation_scale(self, point) result(scale)
    class(bearing_system_type), intent(in) :: self
    type(operating_point_type), intent(in) :: point !! whose speed and load count
    real(wp) :: scale(self%local_size())

    associate (foil => self%foil, film => self%film)
      scale(:foil%first) = merge(film%ambient_pressure, film%cell_flow(point), film%fixed)
      scale(foil%first + 1:foil%first + foil%local_unknowns()) = foil%equation_scale
    end associate
    scale(self%first_shaft + 1:) = self%force_scale(point)
  end function equation_scale

  !> Size of a force: the load, and ambient pressure on the bearing's shadow [N].
  pure function force_scale(self, point) result(force)
    class(bearing_system_type), intent(in) :: self
    type(operating_point_type), intent(in), optional :: point !! default: the present one
    real(wp) :: force

    if (present(point)) then
      force = norm2(point%load) + self%film%shadow()
    else
      force = norm2(self%point%load) + self%film%shadow()
    end if
  end function force_scale

  !> Residual of all equations at the present operating point.
  subroutine evaluate_bearing(self, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state    !! scaled
    Vec, intent(in) :: residual !! scaled
    logical, intent(out) :: valid !! gap and pressure are positive
    call self%evaluate_at(self%point, state, residual, valid)
  end subroutine evaluate_bearing

  !> Residual of all equations at an operating point.
  subroutine evaluate_at(self, asked, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self
    type(operating_point_type), intent(in) :: asked !! operating point
    Vec, intent(in) :: state    !! scaled
    Vec, intent(in) :: residual !! scaled
    logical, intent(out) :: valid !! gap and pressure are positive

    real(wp) :: unknown(self%local_size()), value(self%local_size())
    real(wp) :: loading(self%local_size()) ! the unknowns, with all pressure that loads foil and shaft
    real(wp) :: gap(size(self%mesh%mesh_node)), force(film_forces)
    type(operating_point_type) :: point
    integer :: nodes, shaft
    PetscErrorCode :: ierr

    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    nodes = size(gap)
    shaft = self%first_shaft
    call self%get_unknowns(unknown, state)
    gap = self%gap(unknown, asked)
    value = 0.0_wp
    point = self%position(unknown, asked)
    PetscCallA(PetscLogEventBegin(self%events%film, ierr))
    valid = self%film%is_open(unknown(:nodes), gap, point)
    PetscCallA(PetscLogEventEnd(self%events%film, ierr))
    if (self%foil%is_meshed()) valid = .not. any_rank(.not. valid) ! its matrix is spread over the ranks
    if (valid) then
      PetscCallA(PetscLogEventBegin(self%events%film, ierr))
      call self%film%add_residual(unknown(:nodes), gap, point, value)
      where (self%film%fixed .and. self%mesh%owned)
        value(:nodes) = unknown(:nodes) - self%film%ambient_pressure
      end where
      PetscCallA(PetscLogEventEnd(self%events%film, ierr))
      PetscCallA(PetscLogEventBegin(self%events%foil, ierr))
      loading = unknown
      if (self%contact%present) loading(:nodes) = loading(:nodes) + contact_pressure(self%contact, gap)
      call self%foil%add_residual(loading, value)
      call self%edge%add_pull(point%edge_pull, value)
      call self%edge%add_tension(point%edge_tension, unknown, value)
      call self%edge%add_hold(point%edge_hold, point%edge_height, unknown, value)
      PetscCallA(PetscLogEventEnd(self%events%foil, ierr))
      if (self%floats .and. .not. self%held) then
        force = self%film%force(loading(:nodes))
        value(shaft + 1:) = force(1:2)
      end if
      if (self%floats .and. self%last_rank) then
        if (self%held) then
          value(shaft + 1:) = (unknown(shaft + 1:) - asked%eccentricity)*hold_stiffness(self, asked, .true.)
        else
          value(shaft + 1:) = value(shaft + 1:) - asked%load
        end if
      end if
      value = value/self%equation_scale(asked)
    end if
    PetscCallA(VecSet(residual, 0.0_wp, ierr))
    call self%exchange%add(value, residual)
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
  end subroutine evaluate_at

  !> Derivative of all equations at the present operating point.
  subroutine linearise_bearing(self, state)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state !! scaled
    call self%linearise_at(self%point, self%held, state)
  end subroutine linearise_bearing

  !> Derivative of all equations at an operating point.
  subroutine linearise_at(self, point, held, state)
    class(bearing_system_type), intent(inout) :: self
    type(operating_point_type), intent(in) :: point
    logical, intent(in) :: held !! the shaft is fixed
    Vec, intent(in) :: state    !! scaled

    real(wp) :: unknown(self%local_size()), gap(size(self%mesh%mesh_node))
    PetscErrorCode :: ierr

    self%times_filled = self%times_filled + 1
    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    call self%get_unknowns(unknown, state)
    gap = self%gap(unknown, point)
    if (self%foil%is_meshed()) then
      PetscCallA(MatCopy(self%constant, self%jacobian, SAME_NONZERO_PATTERN, ierr))
    else
      PetscCallA(MatZeroEntries(self%jacobian, ierr))
    end if
    PetscCallA(PetscLogEventBegin(self%events%film, ierr))
    call add_film_rows(self%film, self%foil, shaft_place(self), self%mesh%owned, unknown(:size(gap)), gap, &
                       self%position(unknown, point), self%jacobian)
    if (self%floats) then
      call add_shaft_rows(self%film, self%first_shaft, self%last_rank, hold_stiffness(self, point, held), 1.0_wp, self%jacobian)
    end if
    call add_solid_rows(self%contact, self%film, self%foil, shaft_place(self), held, gap, 1.0_wp, self%jacobian)
    PetscCallA(PetscLogEventEnd(self%events%film, ierr))
    PetscCallA(PetscLogEventBegin(self%events%foil, ierr))
    call self%foil%add_jacobian(unknown, self%jacobian)
    if (abs(point%edge_tension) > 0.0_wp) call add_tension(self%edge, point%edge_tension, self%jacobian)
    if (point%edge_hold > 0.0_wp) call add_hold(self%edge, point%edge_hold, self%jacobian)
    PetscCallA(PetscLogEventEnd(self%events%foil, ierr))
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    call self%exchange%put(1.0_wp/self%equation_scale(point), self%left)
    PetscCallA(MatDiagonalScale(self%jacobian, self%left, self%right, ierr))
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
  end subroutine linearise_at

  !> Adds the stiffness of the string along the free edge.
  subroutine add_tension(edge, tension, jacobian)
    type(free_edge_type), intent(in) :: edge
    real(wp), intent(in) :: tension !! [N]
    Mat, intent(in) :: jacobian
    integer :: pair, place(2)
    real(wp) :: block(2, 2)
    PetscErrorCode :: ierr

    do pair = 1, edge%pairs()
      call edge%tension_block(pair, tension, place, block)
      PetscCallA(MatSetValuesLocal(jacobian, 2_pint, int(place - 1, pint), 2_pint, int(place - 1, pint), [block], ADD_VALUES, ierr))
    end do
  end subroutine add_tension

  !> Adds the stiffness of the springs that hold the free edge.
  subroutine add_hold(edge, stiffness, jacobian)
    type(free_edge_type), intent(in) :: edge
    real(wp), intent(in) :: stiffness !! of the whole width [N/m]
    Mat, intent(in) :: jacobian
    PetscInt :: place(1)
    integer :: i
    PetscErrorCode :: ierr

    do i = 1, size(edge%unknown)
      place = int(edge%unknown(i) - 1, pint)
      PetscCallA(MatSetValuesLocal(jacobian, 1_pint, place, 1_pint, place, [stiffness*edge%hold_stiffness(i)], ADD_VALUES, ierr))
    end do
  end subroutine add_hold

  !> Moves the foil's contacts on their laws to where the foils have gone.
  subroutine settle_bearing(self, state, moved)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state
    logical, intent(out) :: moved
    real(wp) :: unknown(self%local_size())
    logical :: settled
    PetscErrorCode :: ierr

    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    call self%exchange%get(state, unknown)
    PetscCallA(PetscLogEventBegin(self%events%foil, ierr))
    call self%foil%settle(unknown*self%unknown_scale, moved, settled)
    PetscCallA(PetscLogEventEnd(self%events%foil, ierr))
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
    self%settled = settled
    if (moved) self%settled = .not. any_rank(.not. settled)
  end subroutine settle_bearing

  !> A new Newton step begins where the foil's contacts are.
  subroutine begin_bearing_step(self)
    class(bearing_system_type), intent(inout) :: self
    call self%foil%begin_step()
  end subroutine begin_bearing_step

  !> Work of the residual forces on the foil along a step, scaled.
  function work_on_foil(self, residual, step) result(work)
    class(bearing_system_type), intent(in) :: self
    Vec, intent(in) :: residual, step
    real(wp) :: work
    real(wp) :: total(1)
    PetscScalar, pointer :: force(:), way(:)
    PetscErrorCode :: ierr

    work = 0.0_wp
    if (.not. self%foil%is_meshed()) return
    PetscCallA(GFB_VecGetArrayRead(residual, force, ierr))
    PetscCallA(GFB_VecGetArrayRead(step, way, ierr))
    associate (first => self%blocks%first_owned(2) + 1, last => self%blocks%first_owned(3))
      total = sum_over_ranks([dot_product(force(first:last), way(first:last))])
    end associate
    PetscCallA(GFB_VecRestoreArrayRead(step, way, ierr))
    PetscCallA(GFB_VecRestoreArrayRead(residual, force, ierr))
    work = total(1)
  end function work_on_foil

  !> Ends a load step of the scene: friction carries its slip along.
  subroutine commit_bearing(self)
    class(bearing_system_type), intent(inout) :: self
    real(wp) :: unknown(self%local_size())

    call self%get_unknowns(unknown)
    call self%foil%commit(unknown)
  end subroutine commit_bearing

  !> Gap at this rank's nodes for local unknowns [m].
  function bearing_gap(self, unknown, point) result(gap)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: point !! default: the present one
    real(wp) :: gap(size(self%mesh%mesh_node))

    gap = self%film%gap(self%position(unknown, point), self%foil%deflection(unknown))
  end function bearing_gap

  !> Pressure of the shaft's asperities at this rank's nodes [Pa].
  function solid_pressure(self, unknown) result(pressure)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: pressure(size(self%mesh%mesh_node))
    pressure = contact_pressure(self%contact, self%gap(unknown))
  end function solid_pressure

  !> The operating point with the eccentricity that is found or held.
  pure function bearing_position(self, unknown, asked) result(point)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: asked !! default: the present one
    type(operating_point_type) :: point

    point = self%point
    if (present(asked)) point = asked
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

  !> Force and torque of film and asperities at the present state, over all ranks [N], [N m].
  function reaction(self) result(force)
    class(bearing_system_type), intent(in) :: self
    real(wp) :: force(film_forces)
    real(wp) :: unknown(self%local_size())

    call self%get_unknowns(unknown)
    force = sum_over_ranks(self%film%force(unknown(:size(self%mesh%mesh_node)) + self%solid_pressure(unknown)))
  end function reaction

  !> A film field, known at each rank's nodes, at any nodes of the whole mesh.
  function film_values(bearing, value, wanted) result(found)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: value(:)     !! at the local nodes
    integer, intent(in) :: wanted(:)     !! nodes of the whole mesh
    real(wp) :: found(size(wanted))
    real(wp) :: own(1, count(bearing%mesh%owned))

    own(1, :) = pack(value, bearing%mesh%owned)
    found = pack(fetch_entries(bearing%whole%nodes(), pack(bearing%mesh%mesh_node, bearing%mesh%owned), own, wanted), .true.)
  end function film_values

  !> Local unknowns at a state, in SI.
  subroutine get_unknowns(self, unknown, state)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(out) :: unknown(:)
    Vec, intent(in), optional :: state !! scaled; default: the present one

    if (present(state)) then
      call self%exchange%get(state, unknown)
    else
      call self%exchange%get(self%state, unknown)
    end if
    unknown = unknown*self%unknown_scale
  end subroutine get_unknowns

  !> Makes local unknowns, in SI, the present state.
  subroutine set_unknowns(self, unknown)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    call self%exchange%put(unknown/self%unknown_scale, self%state)
  end subroutine set_unknowns

  !> Adds every rank's local unknowns, in SI, up in a scaled vector.
  subroutine add_up_unknowns(self, unknown, vector)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    Vec, intent(in) :: vector
    PetscErrorCode :: ierr

    PetscCallA(VecSet(vector, 0.0_wp, ierr))
    call self%exchange%add(unknown/self%unknown_scale, vector)
  end subroutine add_up_unknowns

  !> Local unknowns of this rank.
  pure function local_size(self) result(unknowns)
    class(bearing_system_type), intent(in) :: self
    integer :: unknowns
    unknowns = self%first_shaft + merge(shaft_unknowns, 0, self%floats)
  end function local_size

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_bearing(self)
    class(bearing_system_type), intent(inout) :: self
    PetscErrorCode :: ierr

    if (.not. allocated(self%foil)) return
    PetscCallA(MatDestroy(self%jacobian, ierr))
    if (self%foil%is_meshed()) then
      PetscCallA(MatDestroy(self%constant, ierr))
    end if
    call self%foil%destroy()
    call self%exchange%destroy()
    PetscCallA(VecDestroy(self%right, ierr))
    PetscCallA(VecDestroy(self%left, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
    deallocate (self%foil)
  end subroutine destroy_bearing
end module gfb_bearing_system
