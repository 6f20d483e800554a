#include "gfb_petsc.h"
!> Pads and shaft: their unknowns, and what a state of them says. Their equations are another module's.
!>
!> Local unknowns of a rank, in this order: of each pad the pressures of its film nodes and the foil's
!> unknowns, fields and scalars of further blocks of equations, and those of the shaft's coordinates that are unknowns: \( (e_x, e_y) \) where it floats, with its tilts
!> where a rotor has two bearings. Newton sees them divided by their sizes (ambient pressure, clearance), and the
!> equations by the sizes of their terms.
module gfb_bearing
  use petscmat
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_natural_order, only: natural_order_type
  use gfb_contact_path, only: begin_contact_path, next_contact, switch_contact, never
  use gfb_petsc_session, only: this_rank, rank_count, sum_over_ranks, largest_over_ranks
  use gfb_solid_contact, only: solid_contact_type
  use gfb_film_load, only: film_forces
  use gfb_film_mesh, only: film_mesh_type
  use gfb_film_surface, only: shaft_coordinates, translations
  use gfb_foil_surface, only: foil_surface_type
  use gfb_operating_point, only: operating_point_type
  use gfb_nonlinear_system, only: nonlinear_system_type, contact_name
  use gfb_blocks, only: blocks_type
  use gfb_local_exchange, only: local_exchange_type
  use gfb_pad, only: pad_type
  use gfb_bearing_heat, only: film_heat_type, moduli_at
  use gfb_film_feed, only: film_feed_type, mouth_unknowns
  use gfb_foil_momentum, only: foil_momentum_type, foil_losses_type
  use gfb_spring_history, only: foil_dampers_type
  use gfb_vibration_equations, only: vibration_equations_type
  implicit none (type)
  private
  public :: places_of

  !> A state of a bearing, as its equations ask for it.
  type, public :: bearing_state_type
    type(operating_point_type) :: point  !! with the shaft's position
    type(operating_point_type) :: asked  !! as it is asked for: with the place where a shaft is held
    real(wp), allocatable :: unknown(:)  !! local, in SI
    real(wp), allocatable :: gap(:)      !! at this rank's nodes of all films [m]
    logical :: fixed = .false.           !! the shaft's equations are its place's
  end type bearing_state_type

  !> A field of a block at the nodes of all films, as result files have it.
  type, public :: shown_field_type
    character(len=24) :: name = ''
    character(len=12) :: unit = ''    !! SI
    character(len=40) :: meaning = ''
  end type shown_field_type

  !> A block of a bearing's equations beside those of its pads: unknowns of its own, what it adds to the residual and to the matrix,
  !> what it remembers over a step of time.
  !>
  !> The unknowns are fields at the nodes of all films, or scalars of all pads together, which the last rank owns; what a block leaves
  !> out it does not have. None of its procedures is a function: gfortran 12 frees a pointer to one whose result is allocatable.
  !>
  !> What a block writes follows from what it is:
  !>
  !>     any with unknowns       fields or scalars, unknown_size, take_numbers, equation_sizes, add_residual, add_jacobian
  !>     ... that move the gap   add_gap, and follow_gap where numbers are derived
  !>     ... shown or measured   shown and show; numbers, extremes, extreme_field, measure and add_number_rates
  !>     of what pads are        take_state, add_jacobian: softness
  !>     a force over time       prepare_step, add_force, add_stiffness, end_motion: losses
  !>     ... with a memory       end_step and visit, too: momentum; recall_step where pads hold it: dampers
  !>     ... by the frequency    add_vibration, the same force in a small vibration: losses, dampers
  !>     gas beside the films    add_column, where the shaft moves it, and add_rates: feed
  type, public :: bearing_block_type
    character(len=8) :: name = ''
    ! its unknowns: asked by the numbering, scales, searches and transfers to a finer mesh
    integer :: fields = 0              !! unknowns of each film node
    integer :: scalars = 0             !! unknowns of all pads together
    real(wp) :: unknown_size = 1.0_wp  !! of each unknown, in SI
    real(wp) :: start = 0.0_wp         !! value of each where nothing is known of it, in SI
    logical :: positive = .false.      !! no state has others
    logical :: has_film = .false.      !! its equations are those of the films, too: pads have no term for them
    logical :: is_slow = .false.       !! its unknowns change in seconds: where a shaft moves, in milliseconds, they are held
    integer, allocatable :: first(:)   !! (pads) local unknowns of the bearing before the fields of each pad
    integer :: first_scalar = 0        !! the same of the scalars
    procedure(take_numbers), pointer, nopass :: take_numbers => null()
    procedure(scalar_groups), pointer, nopass :: groups => null()
    ! asked by the assembly, in SI
    procedure(equation_sizes), pointer, nopass :: equation_sizes => null()
    procedure(take_state), pointer, nopass :: take_state => null()
    procedure(block_gap), pointer, nopass :: add_gap => null()
    procedure(residual_block), pointer, nopass :: add_residual => null()
    procedure(matrix_block), pointer, nopass :: add_jacobian => null()
    procedure(shaft_column), pointer, nopass :: add_column => null()
    ! asked by a march through time: the first two by the assembly of its steps, in vectors and matrices that are scaled
    procedure(scaled_force), pointer, nopass :: add_force => null()
    procedure(scaled_stiffness), pointer, nopass :: add_stiffness => null()
    procedure(time_step), pointer, nopass :: prepare_step => null()
    procedure(time_step), pointer, nopass :: end_step => null()
    procedure(block_end), pointer, nopass :: end_motion => null()
    ! asked by small vibrations: what depends on the frequency
    procedure(vibration_parts), pointer, nopass :: add_vibration => null()
    procedure(film_rates), pointer, nopass :: add_rates => null()
    ! asked by restart files
    procedure(block_visit), pointer, nopass :: visit => null()
    procedure(recalled_step), pointer, nopass :: recall_step => null()
    ! asked by a path that may turn back
    character(len=32) :: mover = ''    !! what of it may make answers along a path turn back
    procedure(runaway_gauge), pointer, nopass :: gauge => null()
    ! asked by result files
    type(shown_field_type), allocatable :: shown(:) !! fields
    procedure(shown_field), pointer, nopass :: show => null()
    ! asked by sensitivities: numbers of an answer and their derivatives
    integer :: numbers = 0             !! that it adds to those of every bearing
    integer :: extremes = 0            !! fields whose largest values are among them
    procedure(shown_field), pointer, nopass :: extreme_field => null()
    procedure(block_numbers), pointer, nopass :: measure => null()
    procedure(number_rates), pointer, nopass :: add_number_rates => null()
    procedure(gap_rates), pointer, nopass :: follow_gap => null()
  end type bearing_block_type

  !> Scalars of a block that belong together: one each row of the film's mesh, or one for whatever else.
  type, public :: scalar_group_type
    integer :: first = 0        !! local unknowns of the bearing before them
    integer :: count = 0
    logical :: is_row = .false. !! they stand along the axis, in the order of the rows
  end type scalar_group_type

  !> The bearing at one operating point.
  type, abstract, extends(nonlinear_system_type), public :: bearing_type
    type(operating_point_type) :: point    !! what it is asked to bear now
    real(wp) :: clearance = 0.0_wp         !! C, by which lengths are measured [m]
    real(wp) :: ambient_pressure = 0.0_wp  !! p_a [Pa]
    type(solid_contact_type) :: asperities !! of the shaft
    type(film_mesh_type) :: mesh           !! of the first pad's film; others are turned, offset, or face the other way
    integer, allocatable :: coordinate(:)  !! of the shaft, those that are unknowns
    logical :: floats = .false.            !! there are some
    logical :: shaft_fixed = .false.       !! there are, but fixed at the point's place
    type(pad_type), allocatable :: pad(:)  !! equal ones
    type(film_heat_type) :: heat           !! of film, foils and walls, where it is asked for
    type(film_feed_type), allocatable :: feed !! what feeds the films, where something does
    type(foil_momentum_type) :: momentum   !! inertia of the foils over a step of time, where they have a mass
    type(foil_losses_type) :: losses       !! viscous ones of meshed foils over a step of time, where there are any
    type(foil_dampers_type) :: dampers     !! beside the springs of a foundation over a step of time, where there are any
    type(bearing_block_type), allocatable :: block(:) !! of equations beside those of the pads
    type(blocks_type) :: blocks            !! of unknowns: film and foil of each pad, fields, scalars; the shaft's are the border
    integer :: unknowns = 0                !! of the bearing, on all ranks
    integer :: first_scalar = 0            !! local unknowns before the scalars of all blocks
    integer :: first_shaft = 0             !! the same of the shaft's, which are the last ones
    logical :: last_rank = .false.         !! this rank owns the shaft's equations
    real(wp), allocatable :: unknown_scale(:) !! of the local unknowns, in SI
    type(local_exchange_type) :: exchange  !! between local unknowns and vectors
    !> numbers of a pad's local unknowns and of the shaft, where there are several pads; 0: of the bearing's
    ISLocalToGlobalMapping, allocatable :: numbers(:)
    type(tVec) :: left, right              !! work space: sizes of equations, inverted; sizes of unknowns
    integer, private :: changing(contact_name) = 0 !! contact that changes next: its rank from 1, its pad, its number there
  contains
    procedure, non_overridable :: get_unknowns, set_unknowns
    procedure, non_overridable :: add_up => add_up_unknowns
    procedure, non_overridable :: summed => summed_values
    procedure, non_overridable :: field => block_field
    procedure, non_overridable :: upwinds, foil_surfaces, has_mirror_motions, mesh_nodes
    procedure, non_overridable :: has_slow_unknowns
    procedure, non_overridable :: local_size, film_nodes, film_pressure, put_pressure, film_force, is_meshed
    procedure, non_overridable :: put_gas_at_rest
    procedure, non_overridable :: has_contacts
    procedure, non_overridable :: gap => bearing_gap
    procedure, non_overridable :: modulus => bearing_modulus
    procedure, non_overridable :: solid_pressure, solid_rate
    procedure, non_overridable :: position => bearing_position
    procedure, non_overridable :: eccentricity => bearing_eccentricity
    procedure, non_overridable :: shaft_place
    procedure, non_overridable :: smallest_gap, local_force, reaction, force_scale, levers, equation_scale
    procedure :: begin_path => begin_bearing_path
    procedure :: next_change => next_bearing_change
    procedure :: cross_change => cross_bearing_change
  end type bearing_type

  abstract interface
    !> The bearing's unknowns are numbered: puts where a block's own stand where its formulas ask.
    pure subroutine take_numbers(bearing, block)
      import :: bearing_type, bearing_block_type
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
      type(bearing_block_type), intent(in) :: block !! with its numbers
    end subroutine take_numbers

    !> Sizes of a block's local equations, fields before scalars, in SI.
    pure subroutine equation_sizes(bearing, scale)
      import :: bearing_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      real(wp), intent(out) :: scale(:)
    end subroutine equation_sizes

    !> Adds to the residual; all films are open.
    subroutine residual_block(bearing, state, residual)
      import :: bearing_type, bearing_state_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      type(bearing_state_type), intent(in) :: state
      real(wp), intent(inout) :: residual(:) !! of the local equations [SI]
    end subroutine residual_block

    !> Adds to the matrix, by the bearing's local numbers.
    subroutine matrix_block(bearing, state, room, matrix)
      import :: bearing_type, bearing_state_type, tMat
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      type(bearing_state_type), intent(in) :: state
      logical, intent(in) :: room !! zeros alone, where they stand; the state has no values then
      Mat, intent(in) :: matrix !! of the bearing, not scaled yet
    end subroutine matrix_block

    !> Adds to the derivative by one of the shaft's coordinates, the unknowns staying.
    subroutine shaft_column(bearing, state, coordinate, column)
      import :: bearing_type, bearing_state_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      type(bearing_state_type), intent(in) :: state
      integer, intent(in) :: coordinate !! see `shaft_coordinates`
      real(wp), intent(inout) :: column(:) !! of the local equations [SI]
    end subroutine shaft_column

    !> Adds to a derivative that films have in time, see `gfb_film_rates`, by the bearing's local numbers.
    subroutine film_rates(bearing, kind, state, matrix)
      import :: bearing_type, bearing_state_type, tMat
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      integer, intent(in) :: kind !! `squeeze`, `squeeze_by_gap` or `flow_by_gap`
      type(bearing_state_type), intent(in) :: state
      Mat, intent(in) :: matrix !! not scaled yet
    end subroutine film_rates

    !> Its scalars in groups, always the same ones in the same order.
    pure subroutine scalar_groups(bearing, group)
      import :: bearing_type, scalar_group_type
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      type(scalar_group_type), allocatable, intent(out) :: group(:)
    end subroutine scalar_groups

    !> Pads become what they are at a state: called before its gap is asked for.
    subroutine take_state(bearing, point, unknown)
      import :: bearing_type, operating_point_type, wp
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
      type(operating_point_type), intent(in) :: point !! as it is asked for
      real(wp), intent(in) :: unknown(:) !! local, in SI
    end subroutine take_state

    !> Adds what its unknowns do to the gap.
    pure subroutine block_gap(bearing, point, unknown, gap)
      import :: bearing_type, operating_point_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      type(operating_point_type), intent(in) :: point !! with the shaft's position
      real(wp), intent(in) :: unknown(:) !! local, in SI
      real(wp), intent(inout) :: gap(:)  !! at this rank's nodes of all films [m]
    end subroutine block_gap

    !> Adds to the residual of a step of time.
    subroutine scaled_force(bearing, state, residual)
      import :: bearing_type, tVec
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
      Vec, intent(in) :: state    !! scaled
      Vec, intent(in) :: residual !! of the bearing, scaled
    end subroutine scaled_force

    !> Adds to the matrix of a step of time.
    subroutine scaled_stiffness(bearing, matrix)
      import :: bearing_type, tMat
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
      Mat, intent(in) :: matrix !! of the bearing, scaled
    end subroutine scaled_stiffness

    !> A step of time is prepared, or has led to the present state.
    subroutine time_step(bearing, weight, now, before)
      import :: bearing_type, wp, tVec
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
      real(wp), intent(in) :: weight(0:2) !! a_0, a_1, a_2 of `gfb_backward_difference` [1/s]
      Vec, intent(in) :: now, before !! scaled states at its beginning and one step earlier
    end subroutine time_step

    !> Pads are put where a step has left them, of what was saved of it.
    subroutine recalled_step(bearing, step, unknown)
      import :: bearing_type, wp
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
      integer, intent(in) :: step !! 1: the newest, 2: the one before
      real(wp), intent(in) :: unknown(:) !! local ones then, in SI
    end subroutine recalled_step

    !> Saves or restores what it remembers. All ranks ask.
    subroutine block_visit(archive, bearing, order)
      import :: bearing_type, archive_type, natural_order_type
      implicit none (type, external)
      type(archive_type), intent(inout) :: archive !! that saves or restores
      class(bearing_type), intent(inout) :: bearing
      type(natural_order_type), intent(in) :: order !! of its state
    end subroutine block_visit

    !> Adds to the parts of a linearised bearing that the frequency weights.
    subroutine vibration_parts(bearing, equations)
      import :: bearing_type, vibration_equations_type
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing !! at its answer
      type(vibration_equations_type), intent(inout) :: equations !! that know what foils do under vibration
    end subroutine vibration_parts

    !> The motion is over: its equations are those of a steady state again; may be called twice.
    subroutine block_end(bearing)
      import :: bearing_type
      implicit none (type, external)
      class(bearing_type), intent(inout) :: bearing
    end subroutine block_end

    !> A number of the present state that runs away before answers along a path turn back.
    subroutine runaway_gauge(bearing, value)
      import :: bearing_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      real(wp), intent(out) :: value
    end subroutine runaway_gauge

    !> One of its fields.
    subroutine shown_field(bearing, unknown, which, value)
      import :: bearing_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: unknown(:) !! local, in SI
      integer, intent(in) :: which !! of the fields
      real(wp), intent(out) :: value(:) !! at this rank's nodes of all films, in SI
    end subroutine shown_field

    !> Its numbers, the friction torque of the films behind them where it has their equations. All ranks ask.
    subroutine block_numbers(bearing, here, unknown, gap, number)
      import :: bearing_type, operating_point_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      type(operating_point_type), intent(in) :: here !! with the shaft's position
      real(wp), intent(in) :: unknown(:) !! local, in SI
      real(wp), intent(in) :: gap(:)     !! at this rank's nodes of all films [m]
      real(wp), intent(out) :: number(:) !! (numbers + 1) in SI, on all ranks
    end subroutine block_numbers

    !> This rank's shares of the derivatives of these numbers at the present state and point.
    subroutine number_rates(bearing, node, unknown, gap, by_unknown, by_gap)
      import :: bearing_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      integer, intent(in) :: node(:) !! (extremes) local film node of each largest value; 0: on another rank
      real(wp), intent(in) :: unknown(:) !! local, in SI
      real(wp), intent(in) :: gap(:)     !! at this rank's nodes of all films [m]
      real(wp), intent(out) :: by_unknown(:, :) !! (local unknowns, numbers + 1) the gap staying
      real(wp), intent(out) :: by_gap(:, :)     !! (nodes, numbers + 1)
    end subroutine number_rates

    !> Adds what follows from its unknowns moving the gap.
    subroutine gap_rates(bearing, unknown, by_gap, gradient)
      import :: bearing_type, wp
      implicit none (type, external)
      class(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: unknown(:) !! local, in SI
      real(wp), intent(in) :: by_gap(:, :) !! (this rank's nodes of all films, numbers) derivatives by the gap
      real(wp), intent(inout) :: gradient(:, :) !! (local unknowns, numbers)
    end subroutine gap_rates
  end interface

contains

  !> Local unknowns of a block: fields, pad by pad, and scalars.
  pure function places_of(bearing, block) result(place)
    class(bearing_type), intent(in) :: bearing !! numbered
    type(bearing_block_type), intent(in) :: block !! of its list
    integer, allocatable :: place(:)
    integer :: i

    place = [(block%first_scalar + i, i=1, block%scalars)]
    if (block%fields > 0) place = [(block%first(1) + i, i=1, block%fields*bearing%film_nodes()), place]
  end function places_of

  !> Sizes of the local equations at an operating point, in SI.
  pure function equation_scale(self, point) result(scale)
    class(bearing_type), intent(in) :: self !! the bearing
    type(operating_point_type), intent(in) :: point !! whose speed and load count
    real(wp) :: scale(self%local_size())
    real(wp), allocatable :: own(:)
    integer :: i

    do i = 1, size(self%pad)
      scale(self%pad(i)%first + 1:self%pad(i)%last) = self%pad(i)%equation_scale(point)
    end do
    do i = 1, size(self%block)
      if (.not. associated(self%block(i)%equation_sizes)) cycle
      associate (place => places_of(self, self%block(i)))
        allocate (own(size(place)))
        call self%block(i)%equation_sizes(self, own)
        scale(place) = own
        deallocate (own)
      end associate
    end do
    scale(self%first_shaft + 1:) = self%force_scale(point)*self%levers()
  end function equation_scale

  !> By which a tilt moves the film, and a force makes a torque, of the shaft's unknowns; translations: 1 [m].
  pure function levers(self) result(lever)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp) :: lever(size(self%coordinate))
    lever = merge(1.0_wp, self%mesh%surface%tilt_arm(), self%coordinate <= translations)
  end function levers

  !> Size of a force: the load, and ambient pressure on the bearing's shadow [N].
  pure real(wp) function force_scale(self, point) result(force)
    class(bearing_type), intent(in) :: self !! the bearing
    type(operating_point_type), intent(in), optional :: point !! default: the present one

    force = self%pad(1)%film%shadow()
    if (present(point)) then
      force = force + norm2(point%load(:translations))
    else
      force = force + norm2(self%point%load(:translations))
    end if
  end function force_scale

  !> Gap at this rank's film nodes, pad by pad, for local unknowns [m].
  function bearing_gap(self, unknown, point) result(gap)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: point !! default: the present one
    real(wp) :: gap(self%film_nodes())
    integer :: i

    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        associate (h => gap(pad%first_node + 1:pad%last_node))
          h = pad%gap(self%position(unknown, point), unknown(pad%first + 1:pad%last), self%modulus(i, unknown, point))
        end associate
      end associate
    end do
    do i = 1, size(self%block)
      if (associated(self%block(i)%add_gap)) call self%block(i)%add_gap(self, self%position(unknown, point), unknown, gap)
    end do
  end function bearing_gap

  !> Moduli of a pad's top foil and bumps over those that are typed, for local unknowns [1].
  pure function bearing_modulus(self, i, unknown, point) result(modulus)
    class(bearing_type), intent(in) :: self !! the bearing
    integer, intent(in) :: i !! of the pad
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: point !! default: the present one
    real(wp) :: modulus(2), rate(2), part

    modulus = self%pad(i)%foil%modulus
    if (.not. self%heat%softens()) return
    part = self%point%growth
    if (present(point)) part = point%growth
    call moduli_at(self%heat, i, part, unknown, modulus, rate)
  end function bearing_modulus

  !> Pressure of the shaft's asperities at this rank's film nodes, pad by pad [Pa].
  function solid_pressure(self, unknown) result(pressure)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: pressure(self%film_nodes()), gap(self%film_nodes())
    integer :: i

    gap = self%gap(unknown)
    do i = 1, size(self%pad)
      associate (first => self%pad(i)%first_node + 1, last => self%pad(i)%last_node)
        pressure(first:last) = self%pad(i)%solid_pressure(gap(first:last))
      end associate
    end do
  end function solid_pressure

  !> Its derivative by the gap [Pa/m].
  pure function solid_rate(self, gap) result(rate)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: gap(:) !! at this rank's film nodes, pad by pad [m]
    real(wp) :: rate(size(gap))
    integer :: i

    do i = 1, size(self%pad)
      associate (first => self%pad(i)%first_node + 1, last => self%pad(i)%last_node)
        rate(first:last) = self%pad(i)%solid_rate(gap(first:last))
      end associate
    end do
  end function solid_rate

  !> The operating point with the shaft's position that is found or fixed.
  pure function bearing_position(self, unknown, asked) result(point)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in), optional :: asked !! default: the present one
    type(operating_point_type) :: point

    point = self%point
    if (present(asked)) point = asked
    point%place(self%coordinate) = unknown(self%first_shaft + 1:)
  end function bearing_position

  !> Eccentricity at the present state, found or fixed [m].
  function bearing_eccentricity(self) result(eccentricity)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp) :: eccentricity(2), place(shaft_coordinates)

    place = self%shaft_place()
    eccentricity = place(:2)
  end function bearing_eccentricity

  !> The shaft's coordinates at the present state, found or fixed [m], [rad].
  function shaft_place(self) result(place)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp) :: place(shaft_coordinates)
    type(operating_point_type) :: here
    real(wp) :: unknown(self%local_size())

    call self%get_unknowns(unknown)
    here = self%position(unknown)
    place = here%place
  end function shaft_place

  !> Smallest gap at the present state, over all ranks [m].
  real(wp) function smallest_gap(self) result(gap)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp) :: unknown(self%local_size()), depth(1)

    call self%get_unknowns(unknown)
    depth = largest_over_ranks([-minval(self%gap(unknown))])
    gap = -depth(1)
  end function smallest_gap

  !> Force and torque of films and asperities at the present state, over all ranks [N], [N m].
  function reaction(self) result(force)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp) :: force(film_forces)
    real(wp) :: unknown(self%local_size())

    call self%get_unknowns(unknown)
    force = sum_over_ranks(self%local_force(unknown, self%gap(unknown)))
  end function reaction

  !> Local unknowns at a state, in SI.
  subroutine get_unknowns(self, unknown, state)
    class(bearing_type), intent(in) :: self !! the bearing
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
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! in SI
    call self%exchange%put(unknown/self%unknown_scale, self%state)
  end subroutine set_unknowns

  !> Adds every rank's local unknowns, in SI, up in a scaled vector.
  subroutine add_up_unknowns(self, unknown, vector)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! in SI
    Vec, intent(in) :: vector          !! scaled
    PetscErrorCode :: ierr

    PetscCallA(VecSet(vector, 0.0_wp, ierr))
    call self%exchange%add(unknown/self%unknown_scale, vector)
  end subroutine add_up_unknowns

  !> Local values with what other ranks have at the same unknowns.
  function summed_values(self, value) result(total)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: value(:) !! of this rank's elements, in SI
    real(wp), allocatable :: total(:)
    PetscErrorCode :: ierr

    total = value
    if (rank_count() == 1) return
    PetscCallA(VecSet(self%left, 0.0_wp, ierr))
    call self%exchange%add(value, self%left)
    call self%exchange%get(self%left, total)
  end function summed_values

  !> Local unknowns of this rank.
  pure integer function local_size(self) result(unknowns)
    class(bearing_type), intent(in) :: self !! the bearing
    unknowns = self%blocks%local_unknowns()
  end function local_size

  !> Film nodes of this rank on all pads.
  pure integer function film_nodes(self) result(nodes)
    class(bearing_type), intent(in) :: self !! the bearing
    nodes = self%pad(size(self%pad))%last_node
  end function film_nodes

  !> Pressures at this rank's film nodes, pad by pad, among local unknowns [Pa].
  pure function film_pressure(self, unknown) result(pressure)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: pressure(self%film_nodes())
    integer :: i

    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        pressure(pad%first_node + 1:pad%last_node) = unknown(pad%first + 1:pad%first + pad%last_node - pad%first_node)
      end associate
    end do
  end function film_pressure

  !> A field of a block at this rank's film nodes, pad by pad, among local unknowns, in SI.
  pure function block_field(self, unknown, number, which) result(field)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    integer, intent(in) :: number !! of the block in its list
    integer, intent(in) :: which !! of its fields
    real(wp) :: field(self%film_nodes())

    associate (block => self%block(number))
      field = unknown(block%first(1) + which:block%first(1) + block%fields*size(field):block%fields)
    end associate
  end function block_field

  !> Puts pressures at this rank's film nodes, pad by pad, among local unknowns.
  pure subroutine put_pressure(self, pressure, unknown)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: pressure(:)   !! at all film nodes [Pa]
    real(wp), intent(inout) :: unknown(:) !! local, in SI
    integer :: i

    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        unknown(pad%first + 1:pad%first + pad%last_node - pad%first_node) = pressure(pad%first_node + 1:pad%last_node)
      end associate
    end do
  end subroutine put_pressure

  !> Puts the films' gas at ambient pressure, which a supply that is off leaves as it is.
  pure subroutine put_gas_at_rest(self, unknown)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(inout) :: unknown(:) !! local, in SI

    call self%put_pressure(spread(self%ambient_pressure, 1, self%film_nodes()), unknown)
    if (.not. allocated(self%feed)) return
    associate (first => self%feed%first, last => self%feed%first + mouth_unknowns*size(self%feed%mouth))
      unknown(first + 1:last) = 1.0_wp
    end associate
  end subroutine put_gas_at_rest

  !> Whether the films are weighted by SUPG instead of Galerkin.
  pure logical function upwinds(self)
    class(bearing_type), intent(in) :: self !! the bearing
    upwinds = self%pad(1)%film%flow%upwind
  end function upwinds

  !> Surfaces of the foils of each pad.
  function foil_surfaces(self) result(surface)
    class(bearing_type), intent(in) :: self !! the bearing
    type(foil_surface_type), allocatable :: surface(:)
    surface = self%pad(1)%foil%surfaces()
  end function foil_surfaces

  !> Whether foils have motions against the mirror image, which half of the width does not show.
  pure logical function has_mirror_motions(self) result(has)
    class(bearing_type), intent(in) :: self !! the bearing
    has = self%mesh%half .and. self%pad(1)%foil%moves_against_mirror()
  end function has_mirror_motions

  !> Nodes of a pad's whole mesh that this rank knows, in the order of its own.
  pure function mesh_nodes(self) result(node)
    class(bearing_type), intent(in) :: self !! the bearing
    integer, allocatable :: node(:)
    node = self%pad(1)%mesh%mesh_node
  end function mesh_nodes

  !> This rank's share of force and torque of pressures at the film nodes of all pads [N], [N m].
  pure function film_force(self, pressure) result(force)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: pressure(:) !! at all film nodes [Pa]
    real(wp) :: force(film_forces)
    integer :: i

    force = self%pad(1)%film%force(pressure(:self%pad(1)%last_node))
    do i = 2, size(self%pad)
      force = force + self%pad(i)%film%force(pressure(self%pad(i)%first_node + 1:self%pad(i)%last_node))
    end do
  end function film_force

  !> Whether some unknowns change so slowly that motions of the shaft hold them, see `gfb_heat_switch`.
  pure logical function has_slow_unknowns(self) result(has)
    class(bearing_type), intent(in) :: self !! the bearing
    has = any(self%block%is_slow)
  end function has_slow_unknowns

  !> Whether foils have meshes of their own.
  pure logical function is_meshed(self) result(meshed)
    class(bearing_type), intent(in) :: self !! the bearing
    integer :: i

    meshed = .false.
    do i = 1, size(self%pad)
      meshed = meshed .or. self%pad(i)%foil%is_meshed()
    end do
  end function is_meshed

  !> Whether the foils have contacts, on whatever rank.
  pure logical function has_contacts(self) result(has)
    class(bearing_type), intent(in) :: self !! the bearing
    has = self%pad(1)%foil%has_contacts()
  end function has_contacts

  !> This rank's share of the pads' force on the sleeve and torque on the shaft [N], [N m].
  pure function local_force(self, unknown, gap) result(force)
    class(bearing_type), intent(in) :: self !! the bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp) :: force(film_forces), share(film_forces, size(self%pad))
    integer :: i

    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        share(:, i) = pad%force(unknown(pad%first + 1:pad%last), gap(pad%first_node + 1:pad%last_node))
      end associate
    end do
    force = share(:, 1)
    do i = 2, size(self%pad)
      force = force + share(:, i)
    end do
  end function local_force

  !> A step is about to be followed along which contacts open and close.
  subroutine begin_bearing_path(self, can)
    class(bearing_type), intent(inout) :: self !! the bearing
    logical, intent(out) :: can !! there are contacts, and their forces are straight lines
    logical :: straight
    integer :: i

    can = self%is_meshed()
    do i = 1, size(self%pad)
      if (.not. self%pad(i)%foil%has_contacts()) cycle
      call begin_contact_path(self%pad(i)%foil%contacts, straight)
      can = can .and. straight
    end do
  end subroutine begin_bearing_path

  !> How much of a step can be taken until a contact of any pad opens or closes.
  subroutine next_bearing_change(self, state, step, share, name)
    class(bearing_type), intent(inout) :: self !! the bearing; it remembers the contact
    Vec, intent(in) :: state !! scaled
    Vec, intent(in) :: step  !! subtracted from it, scaled
    real(wp), intent(out) :: share !! of the step, may be above 1; `never` where none does [1]
    integer, intent(out) :: name(contact_name) !! of the contact: its rank from 1, its pad, its number there
    real(wp) :: here(self%local_size()), ahead(self%local_size()), nearest, first(1), rank(1)
    integer :: i, number

    call self%get_unknowns(here, state)
    call self%get_unknowns(ahead, step)
    ahead = here - ahead
    share = never
    name = 0
    do i = 1, size(self%pad)
      associate (pad => self%pad(i))
        if (.not. pad%foil%has_contacts()) cycle
        call next_contact(pad%foil%contacts, pad%foil%own_part(here(pad%first + 1:pad%last)), &
                          pad%foil%own_part(ahead(pad%first + 1:pad%last)), nearest, number)
        if (nearest >= share) cycle
        share = nearest
        name = [this_rank() + 1, i, number]
      end associate
    end do
    first = -largest_over_ranks([-share])
    if (share > first(1)) name = 0
    share = first(1)
    rank = largest_over_ranks([real(name(1), wp)]) ! one of those that tie
    if (name(1) /= nint(rank(1))) name = 0
    name = nint(sum_over_ranks(real(name, wp)))
    self%changing = name
  end subroutine next_bearing_change

  !> The contact that `next_change` found opens or closes.
  subroutine cross_bearing_change(self, column, row)
    class(bearing_type), intent(inout) :: self !! the bearing
    Vec, intent(in) :: column !! of what the matrix changes by, scaled; overwritten
    Vec, intent(in) :: row    !! the same, scaled; overwritten
    real(wp) :: force(self%local_size()), rate(self%local_size())
    integer :: rank, before
    PetscErrorCode :: ierr

    force = 0.0_wp
    rate = 0.0_wp
    rank = this_rank() + 1
    if (self%changing(1) == rank) then
      associate (pad => self%pad(self%changing(2)))
        before = pad%first + pad%foil%first
        call switch_contact(pad%foil%contacts, self%changing(3), force(before + 1:before + pad%foil%local_unknowns()), &
                            rate(before + 1:before + pad%foil%local_unknowns()))
      end associate
    end if
    PetscCallA(VecSet(column, 0.0_wp, ierr))
    call self%exchange%add(force/self%equation_scale(self%point), column)
    PetscCallA(VecSet(row, 0.0_wp, ierr))
    call self%exchange%add(rate*self%unknown_scale, row)
  end subroutine cross_bearing_change
end module gfb_bearing
