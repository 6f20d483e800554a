#include "gfb_petsc.h"
!> Pads and shaft as one set of equations: the terms of each pad, and the list of blocks beside them.
module gfb_bearing_system
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_foil_model, only: foil_model_type
  use gfb_film_surface, only: translations
  use gfb_cost_events, only: cost_events_type, register_cost_events
  use gfb_operating_point, only: operating_point_type, visit_point
  use gfb_pad, only: pad_place_type, complete_pad, place_pads
  use gfb_pad_terms, only: growth_unknowns_type, pad_state_type, term_type, pad_terms
  use gfb_archive, only: archive_type
  use gfb_text, only: text
  use gfb_petsc_session, only: sum_over_ranks, any_rank, largest_number
  use gfb_natural_order, only: natural_order_type, visit_vector
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_contact_memory, only: visit_contacts
  use gfb_local_exchange, only: create_exchange
  use gfb_film_heat, only: shaft_places
  use gfb_bearing, only: bearing_type, bearing_block_type, bearing_state_type, places_of
  use gfb_bearing_layers, only: layers_of
  use gfb_bearing_numbering, only: number_unknowns, scale_unknowns, create_numbers, number_by
  use gfb_bearing_motion, only: momentum_block, losses_block, dampers_block, end_motion
  use gfb_heat_block, only: heat_block
  use gfb_feed_block, only: feed_block
  use gfb_shaft_block, only: shaft_block, shaft_of
  use gfb_softness_block, only: softness_block
  use gfb_foil_rows, only: add_of_foil, create_bearing_motions
  implicit none (type)
  private
  public :: create_bearing_system, set_up_equations, free_equations, bearing_order, path_order, visit_bearing, visit_switches

  !> A bearing and its equations.
  type, extends(bearing_type), public :: bearing_system_type
    type(term_type), allocatable, private :: term(:) !! of each pad's equations
    type(tMat), private :: constant    !! what of the matrix never changes, in SI
    type(cost_events_type), private :: events !! of PETSc's log
  contains
    procedure :: evaluate => evaluate_bearing
    procedure :: linearise => linearise_bearing
    procedure, non_overridable :: evaluate_at, linearise_at, is_open_at, shaft_column
    procedure :: settle => settle_bearing
    procedure :: begin_step => begin_bearing_step
    procedure :: virtual_work => work_on_foils
    procedure, non_overridable :: commit => commit_bearing
    procedure, non_overridable :: return_to, find_motions, drop_matrices
    procedure, non_overridable :: destroy => destroy_bearing
  end type bearing_system_type

contains

  !> Puts film, foil and shaft together; the foil moves into the system.
  subroutine create_bearing_system(bearing, foil, floats, tilts, place)
    type(bearing_system_type), intent(inout) :: bearing !! with the film of its first pad
    class(foil_model_type), allocatable, intent(inout) :: foil !! under the film
    logical, intent(in) :: floats !! the shaft's translations are unknowns, tilts with a rotor of two bearings
    logical, intent(in) :: tilts !! the tilts of one bearing are unknowns, too
    type(pad_place_type), intent(in), optional :: place(:) !! of the pads, which are equal; default: one

    call register_cost_events(bearing%events)
    call complete_pad(foil, bearing%events, bearing%pad(1))
    if (present(place)) call place_pads(place, bearing%pad)
    associate (pad => bearing%pad(1))
      bearing%clearance = pad%film%clearance
      bearing%ambient_pressure = pad%film%ambient_pressure
      bearing%asperities = pad%contact
      bearing%mesh = pad%whole
    end associate
    bearing%floats = floats
    associate (surface => bearing%mesh%surface, motions => bearing%mesh%surface%motions())
      bearing%coordinate = pack(motions, floats .and. (motions <= translations .or. tilts .or. abs(surface%offset) > 0.0_wp))
    end associate
    call set_up_equations(bearing)
  end subroutine create_bearing_system

  !> Numbers the unknowns, and makes vectors and matrix; what the bearing holds of another, that it is a copy of, stays there.
  subroutine set_up_equations(bearing)
    type(bearing_system_type), intent(inout) :: bearing !! pads, and heat where it is solved for
    PetscErrorCode :: ierr

    if (allocated(bearing%unknown_scale)) deallocate (bearing%unknown_scale)
    if (allocated(bearing%numbers)) deallocate (bearing%numbers)
    call list_blocks(bearing)
    bearing%term = pad_terms(.not. any(bearing%block%has_film))
    bearing%dense_rows = bearing%floats .or. any(bearing%block%scalars > 0)
    bearing%low_fill = bearing%plane .and. .not. any(bearing%block%fields > 0)
    call number_unknowns(bearing)
    if (allocated(bearing%layer)) deallocate (bearing%layer)
    if (any(bearing%block%fields > 0)) bearing%layer = layers_of(bearing)
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(bearing%blocks%border%owned, pint), PETSC_DETERMINE, bearing%state, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%left, ierr))
    PetscCallA(VecDuplicate(bearing%state, bearing%right, ierr))
    call create_exchange(bearing%blocks%global, bearing%state, bearing%exchange)
    call create_bearing_matrix(bearing)
    call create_numbers(bearing)
    call scale_unknowns(bearing)
    call bearing%exchange%put(bearing%unknown_scale, bearing%right)
    if (bearing%is_meshed()) call fill_constant(bearing)
  end subroutine set_up_equations

  !> The blocks of equations that a bearing has beside those of its pads, in the order in which they are added: forces on foils
  !> before heat, whose walls stand behind its fields so; then what feeds the films, the shaft's last.
  !>
  !> Contacts, the free edge and asperities are no blocks: contacts are a foil's own, edge and asperities act within a pad, on its
  !> film and foil and through its pressures on the shaft. They are terms of `pad_terms`.
  subroutine list_blocks(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    type(bearing_block_type) :: one
    integer :: k

    if (allocated(bearing%block)) deallocate (bearing%block)
    allocate (bearing%block(4 + count([allocated(bearing%feed), bearing%heat%present, bearing%floats])))
    call softness_block(bearing%block(1))
    call momentum_block(bearing%block(2))
    call losses_block(bearing%block(3))
    call dampers_block(bearing%block(4))
    k = 4
    if (bearing%heat%present) then
      k = k + 1
      call heat_block(bearing, one)
      bearing%block(k) = one
    end if
    if (allocated(bearing%feed)) then
      k = k + 1
      call feed_block(bearing, one)
      bearing%block(k) = one
    end if
    if (bearing%floats) call shaft_block(bearing%block(k + 1))
  end subroutine list_blocks

  !> Matrix with room for what each row couples.
  subroutine create_bearing_matrix(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    PetscInt, allocatable :: entries(:)
    integer :: i

    allocate (entries(0))
    do i = 1, size(bearing%pad)
      entries = [entries, bearing%pad(i)%row_entries()]
    end do
    do i = 1, size(bearing%block)
      call make_room(bearing, bearing%block(i), entries)
    end do
    call bearing%blocks%create_matrix(entries, bearing%jacobian)
  end subroutine create_bearing_matrix

  !> Entries that rows need with a block: as many more fields at nodes around, and all scalars; a scalar's row may be full.
  subroutine make_room(bearing, block, entries)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_block_type), intent(in) :: block !! of its list
    PetscInt, allocatable, intent(inout) :: entries(:)
    integer :: i, around, other

    other = sum(bearing%block%scalars) - block%scalars
    around = block%fields*(2*bearing%mesh%order + 1)**2 + block%scalars
    entries = entries + int(around, pint)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        entries = [entries, spread(int(2*around + pad%foil%couplings + other, pint), 1, block%fields*pad%mesh%owned_unknowns)]
      end associate
    end do
    if (bearing%last_rank) entries = [entries, spread(int(bearing%unknowns, pint), 1, block%scalars)]
  end subroutine make_room

  !> Finds the motions that an iterative solver needs.
  subroutine find_motions(self)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    call create_bearing_motions(self%blocks, self%pad, self%jacobian, self%motions, self%has_motions)
  end subroutine find_motions

  !> Fills in what never changes in the matrix, with room for everything else, and keeps a copy.
  subroutine fill_constant(bearing)
    type(bearing_system_type), intent(inout) :: bearing
    type(pad_state_type) :: state
    real(wp) :: nothing(bearing%local_size())
    PetscErrorCode :: ierr
    integer :: i, k

    nothing = 0.0_wp
    do i = 1, size(bearing%pad)
      call number_by(bearing, i, bearing%jacobian)
      state%shaft = shaft_of(bearing, i)
      state%growth = growth_of(bearing, i, bearing%point)
      call add_of_foil(bearing%blocks, bearing%pad(i)%foil, i, bearing%pad(i)%foil%elastic, [1.0_wp, 1.0_wp], .true., bearing%jacobian)
      do k = 1, size(bearing%term)
        if (associated(bearing%term(k)%add_constant)) call bearing%term(k)%add_constant(bearing%pad(i), state, bearing%jacobian)
      end do
    end do
    call number_by(bearing, 0, bearing%jacobian)
    do k = 1, size(bearing%block)
      if (.not. associated(bearing%block(k)%add_jacobian)) cycle
      call bearing%block(k)%add_jacobian(bearing, bearing_state_type(bearing%point, bearing%point, nothing, nothing), .true., bearing%jacobian)
    end do
    PetscCallA(MatAssemblyBegin(bearing%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(bearing%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, bearing%constant, ierr))
    ! Rows have room for contacts that most of them never get: a copy holds what is used alone.
    PetscCallA(MatDestroy(bearing%jacobian, ierr))
    PetscCallA(MatDuplicate(bearing%constant, MAT_SHARE_NONZERO_PATTERN, bearing%jacobian, ierr))
    PetscCallA(MatSetOption(bearing%jacobian, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE, ierr))
  end subroutine fill_constant

  !> A pad's part of a state.
  pure function part_of(bearing, i, whole) result(state)
    class(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: i !! of the pad
    type(bearing_state_type), intent(in) :: whole
    type(pad_state_type) :: state

    associate (pad => bearing%pad(i))
      state = pad_state_type(whole%point, whole%unknown(pad%first + 1:pad%last), whole%gap(pad%first_node + 1:pad%last_node), &
                             shaft_of(bearing, i), growth_of(bearing, i, whole%point), whole%fixed)
    end associate
  end function part_of

  !> Temperatures that move a pad's gap, among the numbers by which it fills the matrix.
  pure function growth_of(bearing, i, point) result(growth)
    class(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: i !! of the pad
    type(operating_point_type), intent(in) :: point
    type(growth_unknowns_type) :: growth
    integer :: node

    associate (heat => bearing%heat, pad => bearing%pad(i))
      if (.not. (heat%grows() .and. pad%contact%present)) then
        allocate (growth%number(0, size(pad%film%angle)), growth%rate(0))
        return
      end if
      growth%rate = point%growth*[-heat%shaft%growth, heat%sleeve%growth]
      allocate (growth%number(2, size(pad%film%angle)))
      growth%number(1, :) = pad%last - pad%first - 1 + shaft_places(heat, pad, [(node, node=1, size(growth%number, 2))]) - bearing%first_scalar
      growth%number(2, :) = pad%last - pad%first - 1 + heat%place_of_sleeve() - bearing%first_scalar
    end associate
  end function growth_of

  !> Residual of all equations at the present operating point.
  subroutine evaluate_bearing(self, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    Vec, intent(in) :: state      !! scaled
    Vec, intent(in) :: residual   !! scaled
    logical, intent(out) :: valid !! gap and pressure are positive
    call self%evaluate_at(self%point, state, residual, valid)
  end subroutine evaluate_bearing

  !> Residual of all equations at an operating point.
  subroutine evaluate_at(self, point, state, residual, valid)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    type(operating_point_type), intent(in) :: point !! operating point
    Vec, intent(in) :: state      !! scaled
    Vec, intent(in) :: residual   !! scaled
    logical, intent(out) :: valid !! gap and pressure are positive

    real(wp) :: value(self%local_size())
    type(bearing_state_type) :: here
    type(pad_state_type) :: of_pad
    PetscErrorCode :: ierr
    integer :: i, k

    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    here = state_at(self, point, state, self%shaft_fixed)
    value = 0.0_wp
    valid = is_open(self, here)
    if (self%is_meshed()) valid = .not. any_rank(.not. valid) ! a foil's matrix is spread over the ranks
    if (valid) then
      do i = 1, size(self%pad)
        of_pad = part_of(self, i, here)
        do k = 1, size(self%term)
          if (.not. associated(self%term(k)%add_residual)) cycle
          PetscCallA(PetscLogEventBegin(event_of(self, k), ierr))
          call self%term(k)%add_residual(self%pad(i), of_pad, value(self%pad(i)%first + 1:self%pad(i)%last))
          PetscCallA(PetscLogEventEnd(event_of(self, k), ierr))
        end do
      end do
      do k = 1, size(self%block)
        if (associated(self%block(k)%add_residual)) call self%block(k)%add_residual(self, here, value)
      end do
      value = value/self%equation_scale(point)
    end if
    PetscCallA(VecSet(residual, 0.0_wp, ierr))
    call self%exchange%add(value, residual)
    do k = 1, size(self%block)
      if (associated(self%block(k)%add_force)) call self%block(k)%add_force(self, state, residual)
    end do
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
  end subroutine evaluate_at

  !> A state at an operating point; foils get the moduli that they have there.
  function state_at(bearing, point, vector, fixed) result(state)
    class(bearing_system_type), intent(inout) :: bearing
    type(operating_point_type), intent(in) :: point !! as it is asked for
    Vec, intent(in) :: vector !! scaled
    logical, intent(in) :: fixed !! the shaft is
    type(bearing_state_type) :: state
    integer :: k

    allocate (state%unknown(bearing%local_size()))
    call bearing%get_unknowns(state%unknown, vector)
    state%point = bearing%position(state%unknown, point)
    state%asked = point
    state%fixed = fixed
    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%take_state)) call bearing%block(k)%take_state(bearing, point, state%unknown)
    end do
    state%gap = bearing%gap(state%unknown, point)
  end function state_at

  !> Whether gap and pressure are positive on all ranks.
  logical function is_open_at(self, unknown)
    class(bearing_system_type), intent(in) :: self !! the bearing's equations
    real(wp), intent(in) :: unknown(:) !! local, in SI
    is_open_at = .not. any_rank(.not. is_open(self, bearing_state_type(self%position(unknown), self%point, unknown, self%gap(unknown))))
  end function is_open_at

  !> Whether gap, pressure and what else must be are positive on this rank.
  logical function is_open(bearing, state) result(open)
    class(bearing_system_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(PetscLogEventBegin(bearing%events%film, ierr))
    open = .true.
    do i = 1, size(bearing%block)
      if (bearing%block(i)%positive) open = open .and. all(state%unknown(places_of(bearing, bearing%block(i))) > 0.0_wp)
    end do
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), h => state%gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node))
        open = open .and. pad%film%is_open(state%unknown(pad%first + 1:pad%first + size(h)), h, state%point)
      end associate
    end do
    PetscCallA(PetscLogEventEnd(bearing%events%film, ierr))
  end function is_open

  !> Derivative of all equations at the present operating point.
  subroutine linearise_bearing(self, state)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    Vec, intent(in) :: state !! scaled
    call self%linearise_at(self%point, self%shaft_fixed, state)
  end subroutine linearise_bearing

  !> Derivative of all equations at an operating point.
  subroutine linearise_at(self, point, fixed, state)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    type(operating_point_type), intent(in) :: point !! operating point
    logical, intent(in) :: fixed !! the shaft is fixed
    Vec, intent(in) :: state    !! scaled

    type(bearing_state_type) :: here
    type(pad_state_type) :: of_pad
    PetscErrorCode :: ierr
    integer :: i, k

    self%times_filled = self%times_filled + 1
    PetscCallA(PetscLogEventBegin(self%events%assembly, ierr))
    here = state_at(self, point, state, fixed)
    if (self%is_meshed()) then
      PetscCallA(MatCopy(self%constant, self%jacobian, SAME_NONZERO_PATTERN, ierr))
    else
      PetscCallA(MatZeroEntries(self%jacobian, ierr))
    end if
    do i = 1, size(self%pad)
      call number_by(self, i, self%jacobian)
      of_pad = part_of(self, i, here)
      do k = 1, size(self%term)
        PetscCallA(PetscLogEventBegin(event_of(self, k), ierr))
        if (associated(self%term(k)%add_jacobian)) call self%term(k)%add_jacobian(self%pad(i), of_pad, self%jacobian)
        PetscCallA(PetscLogEventEnd(event_of(self, k), ierr))
      end do
    end do
    call number_by(self, 0, self%jacobian)
    do k = 1, size(self%block)
      if (associated(self%block(k)%add_jacobian)) call self%block(k)%add_jacobian(self, here, .false., self%jacobian)
    end do
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    call self%exchange%put(1.0_wp/self%equation_scale(point), self%left)
    PetscCallA(MatDiagonalScale(self%jacobian, self%left, self%right, ierr))
    do k = 1, size(self%block)
      if (associated(self%block(k)%add_stiffness)) call self%block(k)%add_stiffness(self, self%jacobian)
    end do
    PetscCallA(PetscLogEventEnd(self%events%assembly, ierr))
  end subroutine linearise_at

  !> Event of PETSc's log that a term belongs to.
  pure function event_of(bearing, k) result(event)
    class(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: k !! of the terms
    PetscLogEvent :: event
    event = merge(bearing%events%film, bearing%events%foil, bearing%term(k)%of_film)
  end function event_of

  !> Derivative of all equations by one of the shaft's coordinates at the present point and state, the unknowns staying.
  !>
  !> They are the right sides of a linear response: with \( f(x, q) = 0 \) the unknowns answer a motion of the shaft by
  !> \( f_x x' = -f_q \), where the shaft is fixed in that coordinate.
  subroutine shaft_column(self, coordinate, column)
    class(bearing_system_type), intent(in) :: self !! the bearing's equations
    integer, intent(in) :: coordinate !! see `shaft_coordinates`
    Vec, intent(in) :: column         !! like the residual, scaled, by that unit
    real(wp) :: unknown(self%local_size()), value(self%local_size())
    type(bearing_state_type) :: here
    type(pad_state_type) :: of_pad
    PetscErrorCode :: ierr
    integer :: i, k

    call self%get_unknowns(unknown)
    here = bearing_state_type(self%position(unknown), self%point, unknown, self%gap(unknown), self%shaft_fixed)
    value = 0.0_wp
    do i = 1, size(self%pad)
      of_pad = part_of(self, i, here)
      do k = 1, size(self%term)
        if (associated(self%term(k)%add_column)) call self%term(k)%add_column(self%pad(i), of_pad, coordinate, value(self%pad(i)%first + 1:self%pad(i)%last), value(self%first_shaft + 1:))
      end do
    end do
    do k = 1, size(self%block)
      if (associated(self%block(k)%add_column)) call self%block(k)%add_column(self, here, coordinate, value)
    end do
    PetscCallA(VecSet(column, 0.0_wp, ierr))
    call self%exchange%add(value/self%equation_scale(self%point), column)
  end subroutine shaft_column

  !> Moves the linearisation points of the foils' contacts to where the foils are now.
  subroutine settle_bearing(self, state, moved)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    Vec, intent(in) :: state !! scaled
    logical, intent(out) :: moved !! some contact was
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
      call self%pad(i)%foil%settle(unknown(self%pad(i)%first + 1:self%pad(i)%last), pad_moved, pad_settled)
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
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    integer :: i

    do i = 1, size(self%pad)
      call self%pad(i)%foil%begin_step()
    end do
  end subroutine begin_bearing_step

  !> Work of the residual forces on the foils along a step, scaled.
  real(wp) function work_on_foils(self, residual, step) result(work)
    class(bearing_system_type), intent(in) :: self !! the bearing's equations
    Vec, intent(in) :: residual, step !! scaled
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

  !> Makes an earlier answer the present state: contacts are linearised there again, whatever was tried since.
  subroutine return_to(self, state)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    Vec, intent(in) :: state !! the earlier answer, scaled
    real(wp) :: unknown(self%local_size())
    integer :: i
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(state, self%state, ierr))
    if (.not. self%has_contacts()) return
    call self%get_unknowns(unknown)
    do i = 1, size(self%pad)
      call self%pad(i)%foil%settle_at(unknown(self%pad(i)%first + 1:self%pad(i)%last))
    end do
    self%settled = .true.
  end subroutine return_to

  !> Ends a load step of the scene: friction carries its slip along.
  subroutine commit_bearing(self)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations
    real(wp) :: unknown(self%local_size())
    integer :: i

    call self%get_unknowns(unknown)
    do i = 1, size(self%pad)
      call self%pad(i)%foil%commit(unknown(self%pad(i)%first + 1:self%pad(i)%last))
    end do
  end subroutine commit_bearing

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_bearing(self)
    class(bearing_system_type), intent(inout) :: self !! the bearing's equations

    if (.not. allocated(self%unknown_scale)) return
    call free_equations(self)
    call self%pad(1)%foil%destroy() ! the others' is the same
    call end_motion(self)
    deallocate (self%pad)
  end subroutine destroy_bearing

  !> Frees the matrix where it is not filled any more.
  subroutine drop_matrices(self)
    class(bearing_system_type), intent(inout) :: self !! keeps its state, pads and foils
    PetscErrorCode :: ierr

    PetscCallA(MatDestroy(self%jacobian, ierr))
    if (self%is_meshed()) then
      PetscCallA(MatDestroy(self%constant, ierr))
    end if
  end subroutine drop_matrices

  !> Frees vectors and matrix.
  subroutine free_equations(bearing)
    type(bearing_system_type), intent(inout) :: bearing !! keeps pads and foils
    PetscErrorCode :: ierr
    integer :: i

    call bearing%drop_matrices()
    if (bearing%has_motions) then
      PetscCallA(MatDestroy(bearing%motions, ierr))
      bearing%has_motions = .false.
    end if
    if (allocated(bearing%numbers)) then
      do i = 0, size(bearing%pad)
        PetscCallA(ISLocalToGlobalMappingDestroy(bearing%numbers(i), ierr))
      end do
      deallocate (bearing%numbers)
    end if
    call bearing%exchange%destroy()
    PetscCallA(VecDestroy(bearing%right, ierr))
    PetscCallA(VecDestroy(bearing%left, ierr))
    PetscCallA(VecDestroy(bearing%state, ierr))
    deallocate (bearing%unknown_scale)
  end subroutine free_equations

  !> Order of a bearing's state: of each pad film node by node, foil; fields and scalars of blocks; shaft. All ranks ask.
  function bearing_order(bearing) result(order)
    type(bearing_system_type), intent(in) :: bearing !! with its numbering
    type(natural_order_type) :: order
    integer, allocatable :: film(:), foil(:)
    integer :: k

    associate (pad => bearing%pad(1))
      film = film_numbers(pad%mesh)
      foil = pad%foil%natural_numbers()
    end associate
    order%number = [film, largest_number(film) + foil]
    order%total = largest_number(order%number)
    order%number = [((k - 1)*order%total + order%number, k=1, size(bearing%pad))] ! pad by pad
    order%total = largest_number(order%number)
    do k = 1, size(bearing%block)
      call add_fields(bearing, bearing%block(k)%fields, film, order)
    end do
    call add_scalars(bearing, sum(bearing%block%scalars), order)
    if (bearing%floats) call add_scalars(bearing, size(bearing%coordinate), order)
  end function bearing_order

  !> Adds unknowns of each film node, side by side.
  pure subroutine add_fields(bearing, fields, film, order)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: fields !! of a node
    integer, intent(in) :: film(:) !! numbers of the nodes, see `film_numbers`
    type(natural_order_type), intent(inout) :: order
    integer :: number(fields, size(film), size(bearing%pad)), i, k

    associate (nodes => bearing%mesh%nodes())
      do i = 1, size(number, 3)
        do k = 1, fields
          number(k, :, i) = order%total + fields*(film - 1 + (i - 1)*nodes) + k
        end do
      end do
      order%number = [order%number, number]
      order%total = order%total + fields*size(number, 3)*nodes
    end associate
  end subroutine add_fields

  !> Adds unknowns that the last rank owns.
  pure subroutine add_scalars(bearing, scalars, order)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: scalars
    type(natural_order_type), intent(inout) :: order
    integer :: i

    if (bearing%last_rank) order%number = [order%number, (order%total + i, i=1, scalars)]
    order%total = order%total + scalars
  end subroutine add_scalars

  !> Order of a bearing's state with its path parameter behind it. All ranks ask.
  function path_order(bearing) result(order)
    type(bearing_system_type), intent(in) :: bearing !! with its numbering
    type(natural_order_type) :: order

    order = bearing_order(bearing)
    order%total = order%total + 1
    if (bearing%last_rank) order%number = [order%number, order%total]
  end function path_order

  !> Numbers of the film nodes this rank owns, in the order of the vectors.
  pure function film_numbers(mesh) result(number)
    type(local_mesh_type), intent(in) :: mesh
    integer, allocatable :: number(:)
    integer :: node, first

    allocate (number(mesh%owned_unknowns), source=0)
    first = minval(mesh%first_unknown, mesh%owned)
    do node = 1, size(mesh%mesh_node)
      if (mesh%owned(node)) number(mesh%first_unknown(node) - first + 1) = mesh%mesh_node(node)
    end do
  end function film_numbers

  !> Saves or restores switches, operating point, state and what the contacts remember. All ranks ask.
  subroutine visit_bearing(archive, bearing)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_system_type), intent(inout) :: bearing !! at an answer; put there where the archive restores
    integer :: i

    call visit_switches(archive, bearing)
    call visit_vector(archive, 'state', bearing_order(bearing), bearing%state)
    do i = 1, size(bearing%pad)
      associate (contacts => bearing%pad(i)%foil%contacts)
        call visit_contacts(archive, 'contacts_'//text(i), contacts%rows, contacts)
      end associate
    end do
  end subroutine visit_bearing

  !> Of these all that is no field.
  pure subroutine visit_switches(archive, bearing)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_system_type), intent(inout) :: bearing !! written where the archive restores
    integer :: i

    call archive%visit('shaft_fixed', bearing%shaft_fixed)
    do i = 1, size(bearing%pad)
      call archive%visit('upwind', bearing%pad(i)%film%flow%upwind)
    end do
    call visit_point(archive, bearing%point)
  end subroutine visit_switches
end module gfb_bearing_system
