#include "gfb_petsc.h"
!> Pads and shaft as one set of equations.
!>
!> Local unknowns of a rank, in this order: of each pad the pressures of its film nodes and the foil's
!> unknowns, and \( (e_x, e_y) \) where the shaft floats. Newton sees them divided by their sizes
!> (ambient pressure, clearance), and the equations by the sizes of their terms.
module gfb_bearing_system
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks, any_rank, fetch_entries
  use gfb_film_mesh, only: film_mesh_type
  use gfb_solid_contact, only: contact_pressure
  use gfb_film_load, only: film_forces
  use gfb_shaft_motion, only: shaft_unknowns
  use gfb_foil_model, only: foil_model_type
  use gfb_cost_events, only: cost_events_type, register_cost_events
  use gfb_operating_point, only: operating_point_type
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_blocks, only: blocks_type, block_type, create_blocks
  use gfb_local_exchange, only: local_exchange_type, create_exchange
  use gfb_film_matrix, only: no_shaft, add_shaft_stiffness
  use gfb_pad, only: pad_type, create_pad_film, complete_pad
  use gfb_pad_matrix, only: fill_pad_constant, fill_pad
  implicit none (type)
  private
  public :: create_film_part, create_bearing_system, film_values

  !> The bearing at one operating point.
  type, extends(nonlinear_system_type), public :: bearing_system_type
    type(operating_point_type) :: point    !! what it is asked to bear now
    logical :: floats = .false.            !! (e_x, e_y) are unknowns
    logical :: held = .false.              !! they are, but fixed at the point's eccentricity
    type(pad_type), allocatable :: pad(:)  !! today one
    type(blocks_type) :: blocks            !! of unknowns: film and foil of each pad; the shaft's are scalars
    integer :: unknowns = 0                !! of the bearing, on all ranks
    integer :: first_shaft = 0             !! local unknowns before e_x
    logical :: last_rank = .false.         !! this rank owns the shaft's equations
    real(wp), allocatable :: unknown_scale(:) !! of the local unknowns, in SI
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
    procedure :: virtual_work => work_on_foils
    procedure :: commit => commit_bearing
    procedure :: get_unknowns
    procedure :: set_unknowns
    procedure :: add_up => add_up_unknowns
    procedure :: local_size
    procedure :: film_nodes
    procedure :: is_meshed
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

  !> Distributes the film's mesh and sets up this rank's share of the film, that of the only pad.
  !>
  !> Fails when the mesh cannot be cut, or an element is folded over.
  subroutine create_film_part(whole, clearance, ambient_pressure, viscosity, upwind, bearing, error, column_part)
    type(film_mesh_type), intent(in) :: whole !! the film's mesh
    real(wp), intent(in) :: clearance        !! C [m]
    real(wp), intent(in) :: ambient_pressure !! p_a [Pa]
    real(wp), intent(in) :: viscosity        !! of the gas [Pa s]
    logical, intent(in) :: upwind            !! SUPG instead of Galerkin
    type(bearing_system_type), intent(out) :: bearing
    type(error_type), allocatable, intent(out) :: error
    !> rank, from 1, of every column of elements; default: the film is cut by itself
    integer, intent(in), optional :: column_part(:)

    allocate (bearing%pad(1))
    call create_pad_film(whole, clearance, ambient_pressure, viscosity, upwind, bearing%pad(1), error, column_part)
  end subroutine create_film_part

  !> Puts film, foil and shaft together; the foil moves into the system.
  subroutine create_bearing_system(bearing, foil, floats)
    type(bearing_system_type), intent(inout) :: bearing !! with its film
    class(foil_model_type), allocatable, intent(inout) :: foil
    logical, intent(in) :: floats !! (e_x, e_y) are unknowns
    PetscErrorCode :: ierr

    call register_cost_events(bearing%events)
    call complete_pad(foil, bearing%events, bearing%pad(1))
    bearing%floats = floats
    bearing%dense_rows = floats
    call number_unknowns(bearing)
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(bearing%blocks%border%owned, pint), PETSC_DETERMINE, bearing%state, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%left, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%right, ierr))
    call create_exchange(bearing%blocks%global, bearing%state, bearing%exchange)
    call create_bearing_matrix(bearing)
    call scale_unknowns(bearing)
    if (bearing%is_meshed()) call fill_constant(bearing)
  end subroutine create_bearing_system

  !> Where each pad's film and foil and the shaft stand among all unknowns.
  subroutine number_unknowns(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    type(block_type) :: block(2*size(bearing%pad))
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        block(2*i - 1) = block_type(pad%mesh%owned_unknowns, pad%mesh%first_unknown)
        block(2*i) = block_type(pad%foil%owned, pad%foil%global_unknown)
      end associate
    end do
    call create_blocks(block, merge(shaft_unknowns, 0, bearing%floats), bearing%blocks)
    bearing%unknowns = bearing%blocks%border%unknowns
    bearing%last_rank = bearing%blocks%border%last_rank
    bearing%first_shaft = bearing%blocks%first(size(block) + 1)
  end subroutine number_unknowns

  !> Matrix with room for what each row couples.
  subroutine create_bearing_matrix(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    PetscInt, allocatable :: entries(:)
    integer :: i

    allocate (entries(0))
    do i = 1, size(bearing%pad)
      entries = [entries, bearing%pad(i)%row_entries()]
    end do
    call bearing%blocks%create_matrix(entries, bearing%jacobian)
  end subroutine create_bearing_matrix

  !> Fills in what never changes in the matrix, with room for everything else, and keeps a copy.
  subroutine fill_constant(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(bearing%pad)
      call fill_pad_constant(bearing%pad(i), bearing%blocks, 2*i, shaft_number(bearing), bearing%jacobian)
    end do
    if (bearing%floats .and. bearing%last_rank) call add_shaft_stiffness(bearing%first_shaft, 0.0_wp, bearing%jacobian)
    PetscCallA(MatAssemblyBegin(bearing%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(bearing%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, bearing%constant, ierr))
  end subroutine fill_constant

  !> Local unknowns before e_x, where the shaft has any.
  pure function shaft_number(bearing) result(number)
    class(bearing_system_type), intent(in) :: bearing
    integer :: number
    number = merge(bearing%first_shaft, no_shaft, bearing%floats)
  end function shaft_number

  !> Force over displacement that keeps a fixed shaft at its position, 0 where it floats [N/m].
  pure function hold_stiffness(bearing, point, held) result(stiffness)
    class(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point !! whose load counts
    logical, intent(in) :: held                     !! the shaft is fixed
    real(wp) :: stiffness
    stiffness = merge(bearing%force_scale(point)/bearing%pad(1)%film%clearance, 0.0_wp, held)
  end function hold_stiffness

  !> Sizes of the unknowns.
  subroutine scale_unknowns(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    integer :: i

    allocate (bearing%unknown_scale(bearing%local_size()))
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        bearing%unknown_scale(pad%first + 1:pad%last) = pad%unknown_scale()
      end associate
    end do
    bearing%unknown_scale(bearing%first_shaft + 1:) = bearing%pad(1)%film%clearance
    call bearing%exchange%put(bearing%unknown_scale, bearing%right)
  end subroutine scale_unknowns

  !> Sizes of the local equations at an operating point, in SI.
  pure function equation_scale(self, point) result(scale)
    class(bearing_system_type), intent(in) :: self
    type(operating_point_type), intent(in) :: point !! whose speed and load count
    real(wp) :: scale(self%local_size())
    integer :: i

    do i = 1, size(self%pad)
      scale(self%pad(i)%first + 1:self%pad(i)%last) = self%pad(i)%equation_scale(point)
    end do
    scale(self%first_shaft + 1:) = self%force_scale(point)
  end function equation_scale

  !> Size of a force: the load, and ambient pressure on the bearing's shadow [N].
  pure function force_scale(self, point) result(force)
    class(bearing_system_type), intent(in) :: self
    type(operating_point_type), intent(in), optional :: point !! default: the present one
    real(wp) :: force

    if (present(point)) then
      force = norm2(point%load) + self%pad(1)%film%shadow()
    else
      force = norm2(self%point%load) + self%pad(1)%film%shadow()
    end if
  end function force_scale

  !> Residual of all equations at the present operating point.
  subroutine evaluate_bearing(self, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state      !! scaled
    Vec, intent(in) :: residual   !! scaled
    logical, intent(out) :: valid !! gap and pressure are positive
    call self%evaluate_at(self%point, state, residual, valid)
  end subroutine evaluate_bearing

  !> Residual of all equations at an operating point.
  subroutine evaluate_at(self, point, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self
    type(operating_point_type), intent(in) :: point
    Vec, intent(in) :: state      !! scaled
    Vec, intent(in) :: residual   !! scaled
    logical, intent(out) :: valid !! gap and pressure are positive

    real(wp) :: unknown(self%local_size()), value(self%local_size()), gap(self%film_nodes())
    type(operating_point_type) :: here
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    call self%get_unknowns(unknown, state)
    here = self%position(unknown, point)
    gap = self%gap(unknown, point)
    value = 0.0_wp
    valid = is_open(self, here, unknown, gap)
    if (self%is_meshed()) valid = .not. any_rank(.not. valid) ! a foil's matrix is spread over the ranks
    if (valid) then
      do i = 1, size(self%pad)
        associate (pad => self%pad(i))
          call pad%add_residual(here, unknown(pad%first + 1:pad%last), gap(pad%first_node + 1:pad%last_node), &
                                self%events, value(pad%first + 1:pad%last))
        end associate
      end do
      if (self%floats) call add_shaft_residual(self, point, unknown, gap, value(self%first_shaft + 1:))
      value = value/self%equation_scale(point)
    end if
    PetscCallA(VecSet(residual, 0.0_wp, ierr))
    call self%exchange%add(value, residual)
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
  end subroutine evaluate_at

  !> Whether gap and pressure are positive on this rank.
  function is_open(bearing, point, unknown, gap) result(open)
    class(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    logical :: open
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(PetscLogEventBegin(bearing%events%film, ierr))
    open = .true.
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), h => gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node))
        open = open .and. pad%film%is_open(unknown(pad%first + 1:pad%first + size(h)), h, point)
      end associate
    end do
    PetscCallA(PetscLogEventEnd(bearing%events%film, ierr))
  end function is_open

  !> Adds the shaft's equations: all forces, or its position where it is fixed.
  pure subroutine add_shaft_residual(bearing, point, unknown, gap, value)
    class(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in) :: unknown(:)  !! local, in SI
    real(wp), intent(in) :: gap(:)      !! at all film nodes [m]
    real(wp), intent(inout) :: value(:) !! of (e_x, e_y), in SI
    real(wp) :: force(film_forces)

    if (bearing%held) then
      if (bearing%last_rank) then
        value = (unknown(bearing%first_shaft + 1:) - point%eccentricity)*hold_stiffness(bearing, point, .true.)
      end if
      return
    end if
    force = local_force(bearing, unknown, gap)
    value = force(:shaft_unknowns)
    if (bearing%last_rank) value = value - point%load
  end subroutine add_shaft_residual

  !> This rank's share of the pads' force on the sleeve and torque on the shaft [N], [N m].
  pure function local_force(bearing, unknown, gap) result(force)
    class(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp) :: force(film_forces), share(film_forces, size(bearing%pad))
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        share(:, i) = pad%force(unknown(pad%first + 1:pad%last), gap(pad%first_node + 1:pad%last_node))
      end associate
    end do
    force = share(:, 1)
    do i = 2, size(bearing%pad)
      force = force + share(:, i)
    end do
  end function local_force

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

    real(wp) :: unknown(self%local_size()), gap(self%film_nodes())
    PetscErrorCode :: ierr
    integer :: i

    self%times_filled = self%times_filled + 1
    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    call self%get_unknowns(unknown, state)
    gap = self%gap(unknown, point)
    if (self%is_meshed()) then
      PetscCallA(MatCopy(self%constant, self%jacobian, SAME_NONZERO_PATTERN, ierr))
    else
      PetscCallA(MatZeroEntries(self%jacobian, ierr))
    end if
    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        call fill_pad(pad, self%position(unknown, point), unknown(pad%first + 1:pad%last), &
                      gap(pad%first_node + 1:pad%last_node), shaft_number(self), held, self%events, self%jacobian)
      end associate
    end do
    if (self%floats .and. self%last_rank) then
      call add_shaft_stiffness(self%first_shaft, hold_stiffness(self, point, held), self%jacobian)
    end if
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    call self%exchange%put(1.0_wp/self%equation_scale(point), self%left)
    PetscCallA(MatDiagonalScale(self%jacobian, self%left, self%right, ierr))
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
  end subroutine linearise_at

  !> Moves the linearisation points of the foils' contacts to where the foils have gone.
  subroutine settle_bearing(self, state, moved)
    class(bearing_system_type), intent(inout) :: self
    Vec, intent(in) :: state !! scaled
    logical, intent(out) :: moved
    real(wp) :: unknown(self%local_size())
    logical :: settled, pad_moved, pad_settled
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    call self%get_unknowns(unknown, state)
    PetscCallA(PetscLogEventBegin(self%events%foil, ierr))
    moved = .false.
    settled = .true.
    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        call pad%foil%settle(unknown(pad%first + 1:pad%last), pad_moved, pad_settled)
      end associate
      moved = moved .or. pad_moved
      settled = settled .and. pad_settled
    end do
    PetscCallA(PetscLogEventEnd(self%events%foil, ierr))
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
    self%settled = settled
    if (moved) self%settled = .not. any_rank(.not. settled)
  end subroutine settle_bearing

  !> A new Newton step begins where the foils' contacts are.
  subroutine begin_bearing_step(self)
    class(bearing_system_type), intent(inout) :: self
    integer :: i

    do i = 1, size(self%pad)
      call self%pad(i)%foil%begin_step()
    end do
  end subroutine begin_bearing_step

  !> Work of the residual forces on the foils along a step, scaled.
  function work_on_foils(self, residual, step) result(work)
    class(bearing_system_type), intent(in) :: self
    Vec, intent(in) :: residual, step !! scaled
    real(wp) :: work
    real(wp) :: share(size(self%pad))
    PetscScalar, pointer :: force(:), change(:)
    PetscErrorCode :: ierr
    integer :: i

    work = 0.0_wp
    if (.not. self%is_meshed()) return
    PetscCallA(GFB_VecGetArrayRead(residual, force, ierr))
    PetscCallA(GFB_VecGetArrayRead(step, change, ierr))
    do i = 1, size(self%pad)
      associate (first => self%blocks%first_owned(2*i) + 1, last => self%blocks%first_owned(2*i + 1))
        share(i) = dot_product(force(first:last), change(first:last))
      end associate
    end do
    PetscCallA(GFB_VecRestoreArrayRead(step, change, ierr))
    PetscCallA(GFB_VecRestoreArrayRead(residual, force, ierr))
    work = sum(sum_over_ranks(share))
  end function work_on_foils

  !> Ends a load step of the scene: friction carries its slip along.
  subroutine commit_bearing(self)
    class(bearing_system_type), intent(inout) :: self
    real(wp) :: unknown(self%local_size())
    integer :: i

    call self%get_unknowns(unknown)
    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        call pad%foil%commit(unknown(pad%first + 1:pad%last))
      end associate
    end do
  end subroutine commit_bearing

  !> Gap at this rank's film nodes, pad by pad, for local unknowns [m].
  function bearing_gap(self, unknown, point) result(gap)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: point !! default: the present one
    real(wp) :: gap(self%film_nodes())
    integer :: i

    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        gap(pad%first_node + 1:pad%last_node) = pad%gap(self%position(unknown, point), unknown(pad%first + 1:pad%last))
      end associate
    end do
  end function bearing_gap

  !> Pressure of the shaft's asperities at this rank's film nodes, pad by pad [Pa].
  function solid_pressure(self, unknown) result(pressure)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: pressure(self%film_nodes()), gap(self%film_nodes())
    integer :: i

    gap = self%gap(unknown)
    do i = 1, size(self%pad)
      associate (first => self%pad(i)%first_node + 1, last => self%pad(i)%last_node)
        pressure(first:last) = contact_pressure(self%pad(i)%contact, gap(first:last))
      end associate
    end do
  end function solid_pressure

  !> The operating point with the eccentricity that is found or fixed.
  pure function bearing_position(self, unknown, asked) result(point)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: asked !! default: the present one
    type(operating_point_type) :: point

    point = self%point
    if (present(asked)) point = asked
    if (self%floats) point%eccentricity = unknown(self%first_shaft + 1:self%first_shaft + 2)
  end function bearing_position

  !> Eccentricity at the present state, found or fixed [m].
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

  !> Force and torque of films and asperities at the present state, over all ranks [N], [N m].
  function reaction(self) result(force)
    class(bearing_system_type), intent(in) :: self
    real(wp) :: force(film_forces)
    real(wp) :: unknown(self%local_size())

    call self%get_unknowns(unknown)
    force = sum_over_ranks(local_force(self, unknown, self%gap(unknown)))
  end function reaction

  !> A field of the first pad's film, known at each rank's nodes, at any nodes of the whole mesh.
  function film_values(bearing, value, wanted) result(found)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: value(:)     !! at the local nodes
    integer, intent(in) :: wanted(:)     !! nodes of the whole mesh
    real(wp) :: found(size(wanted))
    real(wp) :: own(1, count(bearing%pad(1)%mesh%owned))

    associate (mesh => bearing%pad(1)%mesh)
      own(1, :) = pack(value, mesh%owned)
      found = pack(fetch_entries(bearing%pad(1)%whole%nodes(), pack(mesh%mesh_node, mesh%owned), own, wanted), .true.)
    end associate
  end function film_values

  !> Local unknowns at a state, in SI.
  subroutine get_unknowns(self, unknown, state)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(out) :: unknown(:) !! in SI
    Vec, intent(in), optional :: state  !! scaled; default: the present one

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
    real(wp), intent(in) :: unknown(:) !! in SI
    call self%exchange%put(unknown/self%unknown_scale, self%state)
  end subroutine set_unknowns

  !> Adds every rank's local unknowns, in SI, up in a scaled vector.
  subroutine add_up_unknowns(self, unknown, vector)
    class(bearing_system_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! in SI
    Vec, intent(in) :: vector          !! scaled
    PetscErrorCode :: ierr

    PetscCallA(VecSet(vector, 0.0_wp, ierr))
    call self%exchange%add(unknown/self%unknown_scale, vector)
  end subroutine add_up_unknowns

  !> Local unknowns of this rank.
  pure function local_size(self) result(unknowns)
    class(bearing_system_type), intent(in) :: self
    integer :: unknowns
    unknowns = self%blocks%local_unknowns()
  end function local_size

  !> Film nodes of this rank on all pads.
  pure function film_nodes(self) result(nodes)
    class(bearing_system_type), intent(in) :: self
    integer :: nodes
    nodes = self%pad(size(self%pad))%last_node
  end function film_nodes

  !> Whether foils have meshes of their own.
  pure function is_meshed(self) result(meshed)
    class(bearing_system_type), intent(in) :: self
    logical :: meshed
    integer :: i

    meshed = .false.
    do i = 1, size(self%pad)
      meshed = meshed .or. self%pad(i)%foil%is_meshed()
    end do
  end function is_meshed

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_bearing(self)
    class(bearing_system_type), intent(inout) :: self
    PetscErrorCode :: ierr
    integer :: i

    if (.not. allocated(self%pad)) return
    if (.not. allocated(self%pad(1)%foil)) return
    PetscCallA(MatDestroy(self%jacobian, ierr))
    if (self%is_meshed()) then
      PetscCallA(MatDestroy(self%constant, ierr))
    end if
    do i = 1, size(self%pad)
      call self%pad(i)%foil%destroy()
      deallocate (self%pad(i)%foil)
    end do
    call self%exchange%destroy()
    PetscCallA(VecDestroy(self%right, ierr))
    PetscCallA(VecDestroy(self%left, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
  end subroutine destroy_bearing
end module gfb_bearing_system
