#include "gfb_petsc.h"
!> How numbers of an answer follow keys of the case file, by the adjoint.
!>
!> At an answer \( J(u, a) = 0 \) a number \( g(u, a) \) follows a key a by
!>
!> $$ \frac{dg}{da} = \frac{\partial g}{\partial a} - \lambda^T \frac{\partial J}{\partial a}, \qquad
!>    J_u^T \lambda = g_u: $$
!>
!> one transposed solve a number, with the factors that the answer has. The derivatives by a at a fixed state are
!> differences of residual and number, of bearings built with a little more and a little less of the key.
!> Contacts stay open, stick or slide as they do at the answer.
!>
!> Numbers of an answer as functions of its unknowns and of the bearing, and their derivatives by the unknowns.
!>
!> The smallest gap and the extreme pressures are those of the nodes where they are at the answer.
module gfb_sensitivity
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use petscsys
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, sum_over_ranks, largest_over_ranks
  use gfb_film_load, only: film_forces
  use gfb_film_measures, only: film_drag, film_drag_rates, film_integral
  use gfb_solid_contact, only: contact_pressure_rate
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_scene, only: scene_type
  use gfb_sensitivity_case, only: parameter_type, quantity_words
  use gfb_sweep_case, only: swept_key_type, swept_keys
  use gfb_operation_case, only: angular_speed
  use gfb_pad_contacts, only: set_lending
  use gfb_newton, only: newton_type, solve_transposed
  implicit none (type)
  private
  public :: find_extremes, measure, measure_gradient, keep_tangent, find_sensitivities, changed_evaluation

  integer, parameter :: place_e = 1, place_force = 3, place_torque = 7, place_speed = 8 !! first numbers of each kind
  integer, parameter, public :: place_extremes = 9, numbers = 11
  integer, parameter :: extremes = 3 !! smallest gap, largest and smallest pressure

  !> The film nodes of extreme values, 0 on all ranks but one.
  type, public :: extreme_nodes_type
    integer :: node(extremes) = 0
  end type extreme_nodes_type

  !> How a derivative by a key is made of differences.
  type :: difference_type
    real(wp) :: part = 2.0e-4_wp !! of the key, that it is changed by [1]
    !> of the values at one and two such steps on both sides; with these the error is of fourth order
    real(wp) :: weight(-2:2) = [1.0_wp, -8.0_wp, 0.0_wp, 8.0_wp, -1.0_wp]/12.0_wp
  end type difference_type

  real(wp), parameter :: central(-2:2) = [0.0_wp, -0.5_wp, 0.0_wp, 0.5_wp, 0.0_wp] !! the same of second order
  real(wp), parameter :: forward(-2:2) = [0.0_wp, 0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp] !! exact where all is linear
  real(wp), parameter :: enough = 1.0e-10_wp    !! residual of an adjoint, over its right side [1]
  real(wp), parameter :: degrees = 180.0_wp/acos(-1.0_wp) !! per radian
  integer, parameter :: most_corrections = 10   !! of an adjoint: the factors may be those of a matrix close by

  !> What is found of an answer.
  type, public :: sensitivity_type
    real(wp), allocatable :: value(:)         !! of each of `quantity_words` [its unit]
    real(wp), allocatable :: derivative(:, :) !! (quantities, parameters) not a number where there is none
    character(len=:), allocatable :: problem  !! why there are none by some parameter
  end type sensitivity_type

  abstract interface
    !> Residual and numbers at an answer's state with another value of a key; the bearing is as before on return.
    subroutine changed_evaluation(scene, parameter, value, bearing, unknown, nodes, residual, number, problem, at)
      import :: scene_type, parameter_type, bearing_system_type, extreme_nodes_type, tVec, wp
      implicit none (type, external)
      type(scene_type), intent(in) :: scene !! what is asked for
      type(parameter_type), intent(in) :: parameter !! the key
      real(wp), intent(in) :: value !! of it [its unit]
      type(bearing_system_type), intent(inout) :: bearing !! at its answer
      real(wp), intent(in) :: unknown(:) !! local ones of the answer, in SI
      type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
      type(tVec), intent(in) :: residual !! scaled
      real(wp), intent(out) :: number(:) !! as `measure` has them [SI]
      character(len=:), allocatable, intent(out) :: problem !! why there are none; empty where there is none
      real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    end subroutine changed_evaluation
  end interface

contains

  !> The nodes of the smallest gap and of the largest and smallest pressure at the present state.
  subroutine find_extremes(bearing, where_they_are)
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    type(extreme_nodes_type), intent(out) :: where_they_are !! on this rank
    real(wp) :: unknown(bearing%local_size()), value(bearing%film_nodes(), extremes), most(extremes), here(extremes)
    integer :: i

    call bearing%get_unknowns(unknown)
    value(:, 1) = -bearing%gap(unknown)
    value(:, 2) = bearing%film_pressure(unknown)
    value(:, 3) = -value(:, 2)
    here = maxval(value, 1)
    most = largest_over_ranks(here)
    ! one of those ranks that have the node
    here = largest_over_ranks(merge(real(this_rank() + 1, wp), 0.0_wp, here >= most))
    do i = 1, extremes
      if (nint(here(i)) == this_rank() + 1) where_they_are%node(i) = maxloc(value(:, i), 1)
    end do
  end subroutine find_extremes

  !> Eccentricity [m], forces and torques on the sleeve [N], [N m], friction torque [N m], speed [rad/s], the values
  !> at the extreme nodes [m], [Pa].
  function measure(bearing, unknown, point, nodes) result(number)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in) :: point !! with the shaft's position where it is fixed
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp) :: number(numbers)
    real(wp) :: gap(bearing%film_nodes()), pressure(bearing%film_nodes()), solid(bearing%film_nodes())
    type(operating_point_type) :: here
    integer :: i

    here = bearing%position(unknown, point)
    gap = bearing%gap(unknown, point)
    pressure = bearing%film_pressure(unknown)
    solid = bearing%solid_pressure(unknown)
    number = 0.0_wp
    number(place_force:place_torque - 1) = bearing%local_force(unknown, gap)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        number(place_torque) = number(place_torque) + pad%film%radius* &
          film_drag(pad%film, pressure(first:last), gap(first:last), here)
        if (.not. pad%contact%present) cycle
        number(place_torque) = number(place_torque) + pad%film%radius*pad%contact%friction* &
          film_integral(pad%film, solid(first:last))
      end associate
    end do
    if (nodes%node(1) > 0) number(place_extremes) = gap(nodes%node(1))
    do i = 2, extremes
      if (nodes%node(i) > 0) number(place_extremes + i - 1) = pressure(nodes%node(i))
    end do
    number = sum_over_ranks(number)
    number(place_e:place_e + 1) = here%eccentricity
    number(place_speed) = point%speed
  end function measure

  !> This rank's shares of the derivatives of these numbers by the local unknowns, at the present state and point.
  subroutine measure_gradient(bearing, nodes, gradient)
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp), intent(out) :: gradient(:, :) !! (local unknowns, numbers) [SI]
    real(wp) :: unknown(bearing%local_size()), gap(bearing%film_nodes()), by_gap(bearing%film_nodes(), numbers)
    integer :: i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    gradient = 0.0_wp
    by_gap = 0.0_wp
    if (bearing%floats .and. bearing%last_rank) then
      do i = 1, 2
        gradient(bearing%first_shaft + i, place_e + i - 1) = 1.0_wp
      end do
    end if
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        call add_forces(pad, gap(first:last), gradient(pad%first + 1:pad%last, :), by_gap(first:last, :))
        call add_drag(bearing, pad, unknown, gap(first:last), gradient, by_gap(first:last, :))
      end associate
    end do
    call add_extremes(bearing, nodes, gradient, by_gap)
    do i = 1, size(bearing%pad)
      call follow_gap(bearing, bearing%pad(i), by_gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node, :), gradient)
    end do
  end subroutine measure_gradient

  !> Forces and torques: weights of the pressures, those of the asperities by the gap.
  pure subroutine add_forces(pad, gap, by_unknown, by_gap)
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: gap(:) !! at its nodes [m]
    real(wp), intent(inout) :: by_unknown(:, :), by_gap(:, :) !! (pad's unknowns or nodes, numbers)
    integer :: k

    do k = 1, film_forces
      associate (weight => pad%film%force_weight(k, :))
        by_unknown(:size(gap), place_force + k - 1) = weight
        by_gap(:, place_force + k - 1) = weight*contact_pressure_rate(pad%contact, gap)
      end associate
    end do
  end subroutine add_forces

  !> Friction torque of a pad's film and asperities. Between the nodes the rigid gap follows the shaft by itself.
  subroutine add_drag(bearing, pad, unknown, gap, gradient, by_gap)
    type(bearing_system_type), intent(in) :: bearing
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(in) :: gap(:)     !! at the pad's nodes [m]
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (bearing's unknowns or pad's nodes, numbers)
    real(wp), parameter :: part = 1.0e-3_wp ! of the clearance, that the shaft is moved by
    real(wp) :: by_pressure(size(gap)), by_node(size(gap)), area(size(gap)), step
    type(operating_point_type) :: ahead, behind
    integer :: k

    associate (film => pad%film, pressure => unknown(pad%first + 1:pad%first + size(gap)))
      call film_drag_rates(film, pressure, gap, bearing%position(unknown), by_pressure, by_node)
      associate (mine => gradient(pad%first + 1:pad%first + size(gap), place_torque))
        mine = mine + film%radius*by_pressure
      end associate
      area = nodal_areas(pad)
      by_gap(:, place_torque) = film%radius*(by_node + pad%contact%friction*area*contact_pressure_rate(pad%contact, gap))
      if (.not. bearing%floats) return
      step = part*film%clearance
      do k = 1, 2
        ahead = bearing%position(unknown)
        behind = ahead
        ahead%eccentricity(k) = ahead%eccentricity(k) + step
        behind%eccentricity(k) = behind%eccentricity(k) - step
        associate (by_shaft => gradient(bearing%first_shaft + k, place_torque))
          by_shaft = by_shaft + film%radius*(film_drag(film, pressure, gap, ahead) &
                                             - film_drag(film, pressure, gap, behind))/(2.0_wp*step)
        end associate
      end do
    end associate
  end subroutine add_drag

  !> Weights of a field's nodal values in its integral, this rank's share [m2].
  pure function nodal_areas(pad) result(area)
    type(pad_type), intent(in) :: pad
    real(wp) :: area(size(pad%film%angle))
    integer :: element

    area = 0.0_wp
    do element = 1, size(pad%film%element_nodes, 2)
      associate (nodes => pad%film%element_nodes(:, element))
        area(nodes) = area(nodes) + pad%film%copies*matmul(pad%film%shape, pad%film%geometry(element)%area)
      end associate
    end do
  end function nodal_areas

  !> The extreme values, on the rank that has their nodes.
  pure subroutine add_extremes(bearing, nodes, gradient, by_gap)
    type(bearing_system_type), intent(in) :: bearing
    type(extreme_nodes_type), intent(in) :: nodes
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (bearing's unknowns or nodes, numbers)
    integer :: i, k

    if (nodes%node(1) > 0) by_gap(nodes%node(1), place_extremes) = 1.0_wp
    do k = 2, extremes
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i))
          if (nodes%node(k) <= pad%first_node .or. nodes%node(k) > pad%last_node) cycle
          gradient(pad%first + nodes%node(k) - pad%first_node, place_extremes + k - 1) = 1.0_wp
        end associate
      end do
    end do
  end subroutine add_extremes

  !> What a pad's gap does by the unknowns that move it: its foil's, or pressures, and the shaft's.
  pure subroutine follow_gap(bearing, pad, by_gap, gradient)
    type(bearing_system_type), intent(in) :: bearing
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: by_gap(:, :) !! (pad's nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (bearing's unknowns, numbers)
    integer :: node, k

    do node = 1, size(by_gap, 1)
      if (pad%foil%source(node) > 0) then
        associate (mine => gradient(pad%first + pad%foil%source(node), :))
          mine = mine + pad%foil%rate(node)*by_gap(node, :)
        end associate
      end if
      if (.not. bearing%floats) cycle
      do k = 1, 2
        associate (mine => gradient(bearing%first_shaft + k, :))
          mine = mine + pad%film%motion(k, node)*by_gap(node, :)
        end associate
      end do
    end do
  end subroutine follow_gap

  !> The matrix of the bearing's equations at its answer, without what is lent to open contacts.
  subroutine keep_tangent(bearing, tangent)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer
    Mat, intent(out) :: tangent !! its copy
    PetscErrorCode :: ierr
    logical :: moved

    call bearing%settle(bearing%state, moved)
    call set_lending(bearing, .false.)
    call bearing%linearise(bearing%state)
    call set_lending(bearing, .true.)
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, tangent, ierr))
  end subroutine keep_tangent

  !> Derivatives of all quantities that the scene asks for by all its parameters.
  subroutine find_sensitivities(scene, bearing, newton, tangent, evaluate, found, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    Mat, intent(in) :: tangent !! of `keep_tangent`
    procedure(changed_evaluation) :: evaluate !! of the residual with other values of the keys
    type(sensitivity_type), intent(out) :: found !! values and derivatives
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]

    Vec :: adjoint(size(quantity_words)), change
    type(extreme_nodes_type) :: nodes
    real(wp) :: unknown(bearing%local_size()), number(numbers), slope(numbers), combined(size(quantity_words), numbers), along
    character(len=:), allocatable :: problem
    logical :: solved(size(quantity_words))
    PetscErrorCode :: ierr
    integer :: i, k

    call bearing%get_unknowns(unknown)
    call find_extremes(bearing, nodes)
    number = measure(bearing, unknown, bearing%point, nodes)
    call combine(number, found%value, combined)
    call find_adjoints(scene, bearing, newton, tangent, nodes, combined, adjoint, solved)
    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    associate (parameter => scene%sensitivity%parameter)
      allocate (found%derivative(size(quantity_words), size(parameter)), source=ieee_value(1.0_wp, ieee_quiet_nan))
      found%problem = ''
      do i = 1, size(parameter)
        call find_change(scene, parameter(i), bearing, unknown, nodes, evaluate, change, slope, problem, at)
        if (problem /= '') then
          found%problem = parameter(i)%key%label()//': '//problem
          cycle
        end if
        do k = 1, size(quantity_words)
          if (.not. solved(k)) cycle
          PetscCallA(VecDot(adjoint(k), change, along, ierr))
          found%derivative(k, i) = dot_product(combined(k, :), slope) - along
        end do
      end do
    end associate
    if (any(scene%sensitivity%quantity .and. .not. solved)) found%problem = 'the transposed equations were not solved'
    do k = 1, size(quantity_words)
      if (scene%sensitivity%quantity(k)) then
        PetscCallA(VecDestroy(adjoint(k), ierr))
      end if
    end do
    PetscCallA(VecDestroy(change, ierr))
  end subroutine find_sensitivities

  !> The quantities in the order of `quantity_words` from the numbers that are measured, and their derivatives.
  pure subroutine combine(number, value, rate)
    real(wp), intent(in) :: number(:)              !! measured
    real(wp), allocatable, intent(out) :: value(:) !! of the quantities
    real(wp), intent(out) :: rate(:, :)            !! (quantities, numbers)
    real(wp) :: square
    integer, parameter :: attitude = 3, power = 9, extremes = 10 !! among the quantities
    integer :: k

    allocate (value(size(rate, 1)))
    rate = 0.0_wp
    value(:2) = number(place_e:place_e + 1)
    value(attitude + 1:power - 1) = number(place_force:place_torque)
    value(extremes:) = number(place_extremes:)
    do k = 1, 2
      rate(k, place_e + k - 1) = 1.0_wp
    end do
    do k = place_force, place_torque
      rate(attitude + 1 + k - place_force, k) = 1.0_wp
    end do
    do k = place_extremes, size(number)
      rate(extremes + k - place_extremes, k) = 1.0_wp
    end do
    value(power) = number(place_torque)*number(place_speed)
    rate(power, place_torque) = number(place_speed)
    rate(power, place_speed) = number(place_torque)
    ! from the load's direction to that of the thinnest film
    associate (e => number(place_e:place_e + 1), f => number(place_force:place_force + 1))
      value(attitude) = degrees*atan2(f(2)*e(1) - f(1)*e(2), -f(1)*e(1) - f(2)*e(2))
      square = dot_product(e, e)
      if (square > 0.0_wp) rate(attitude, place_e:place_e + 1) = degrees*[-e(2), e(1)]/square
      square = dot_product(f, f)
      if (square > 0.0_wp) rate(attitude, place_force:place_force + 1) = -degrees*[-f(2), f(1)]/square
    end associate
  end subroutine combine

  !> An adjoint for every quantity that is asked for; vectors of the others are not created.
  subroutine find_adjoints(scene, bearing, newton, tangent, nodes, combined, adjoint, solved)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    type(newton_type), intent(in) :: newton
    Mat, intent(in) :: tangent
    type(extreme_nodes_type), intent(in) :: nodes
    real(wp), intent(in) :: combined(:, :) !! (quantities, numbers)
    Vec, intent(inout) :: adjoint(:)
    logical, intent(out) :: solved(:)
    real(wp) :: gradient(bearing%local_size(), numbers)
    Vec :: right
    PetscErrorCode :: ierr
    integer :: k

    solved = .false.
    call measure_gradient(bearing, nodes, gradient)
    PetscCallA(VecDuplicate(bearing%state, right, ierr))
    do k = 1, size(adjoint)
      if (.not. scene%sensitivity%quantity(k)) cycle
      PetscCallA(VecDuplicate(bearing%state, adjoint(k), ierr))
      PetscCallA(VecSet(right, 0.0_wp, ierr))
      call bearing%exchange%add(matmul(gradient, combined(k, :))*bearing%unknown_scale, right)
      call solve_adjoint(newton, tangent, right, adjoint(k), solved(k))
    end do
    PetscCallA(VecDestroy(right, ierr))
  end subroutine find_adjoints

  !> Solves a transposed system with factors of a matrix that is close, and corrects the solution.
  subroutine solve_adjoint(newton, tangent, right, adjoint, solved)
    type(newton_type), intent(in) :: newton
    Mat, intent(in) :: tangent
    Vec, intent(in) :: right   !! scaled
    Vec, intent(in) :: adjoint !! scaled
    logical, intent(out) :: solved
    real(wp), parameter :: useful = 0.1_wp   ! share of the residual that a correction leaves
    real(wp), parameter :: accepted = 1.0e-8_wp ! residual over the right side
    Vec :: left, correction
    PetscReal :: whole, norm, before
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDuplicate(right, left, ierr))
    PetscCallA(VecDuplicate(right, correction, ierr))
    PetscCallA(VecSet(adjoint, 0.0_wp, ierr))
    PetscCallA(VecCopy(right, left, ierr))
    PetscCallA(VecNorm(right, NORM_2, whole, ierr))
    norm = whole
    do i = 1, most_corrections
      before = norm
      if (before <= enough*whole) exit
      call solve_transposed(newton, left, correction)
      PetscCallA(VecAXPY(adjoint, 1.0_wp, correction, ierr))
      PetscCallA(MatMultTranspose(tangent, adjoint, left, ierr))
      PetscCallA(VecAYPX(left, -1.0_wp, right, ierr))
      PetscCallA(VecNorm(left, NORM_2, norm, ierr))
      if (.not. norm <= useful*before) exit
    end do
    solved = norm <= accepted*whole
    PetscCallA(VecDestroy(correction, ierr))
    PetscCallA(VecDestroy(left, ierr))
  end subroutine solve_adjoint

  !> How residual and numbers change with a key while the state stays.
  subroutine find_change(scene, parameter, bearing, unknown, nodes, evaluate, change, slope, problem, at)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    type(bearing_system_type), intent(inout) :: bearing
    real(wp), intent(in) :: unknown(:) !! local ones of the answer, in SI
    type(extreme_nodes_type), intent(in) :: nodes
    procedure(changed_evaluation) :: evaluate
    Vec, intent(in) :: change            !! of the residual, scaled, by the key's unit
    real(wp), intent(out) :: slope(:)    !! of the numbers, by the key's unit
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    Vec :: residual
    real(wp) :: number(numbers), value, step
    PetscErrorCode :: ierr
    type(difference_type) :: difference
    integer :: steps

    PetscCallA(VecDuplicate(change, residual, ierr))
    PetscCallA(VecSet(change, 0.0_wp, ierr))
    slope = 0.0_wp
    value = present_value(scene, parameter, bearing%point, at)
    difference = difference_of(parameter%key)
    step = difference%part*abs(value)
    if (parameter%key%is_gap()) step = difference%part*scene%bearing%clearance
    problem = ''
    if (.not. step > 0.0_wp) problem = 'it is 0 here'
    do steps = -2, 2
      if (problem /= '') exit
      if (.not. abs(difference%weight(steps)) > 0.0_wp) cycle
      call evaluate(scene, parameter, value + steps*step, bearing, unknown, nodes, residual, number, problem, at)
      PetscCallA(VecAXPY(change, difference%weight(steps)/step, residual, ierr))
      slope = slope + difference%weight(steps)/step*number
    end do
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine find_change

  !> The differences that suit a key. Where it leaves the foils' stiffness alone little is lost to rounding. In thickness
  !> and material stiffness is a polynomial, or nearly one, of low degree. The shape of bumps is neither, and a pitch adds
  !> up along the strip.
  !> Gaps of contacts that stay as they are are part of the equations in proportion.
  pure function difference_of(key) result(difference)
    type(swept_key_type), intent(in) :: key
    type(difference_type) :: difference
    real(wp), parameter :: small = 4.0e-6_wp, large = 5.0e-4_wp

    select case (key%group)
    case ('operation', 'gas', 'bore', 'contact', 'shaft_contact')
      difference = difference_type(small, central)
    case default
      select case (key%name)
      case ('clearance', 'preload')
        difference = difference_type(small, central)
      case ('crest_gap', 'corner_gap')
        difference = difference_type(0.01_wp, forward)
      case ('thickness', 'bump_thickness', 'strip_thickness', 'youngs_modulus', 'poissons_ratio')
        difference = difference_type(large, central)
      case default
        return
      end select
    end select
  end function difference_of

  !> Value of a parameter at the answer: the sweep's where it changes that very key.
  pure function present_value(scene, parameter, point, at) result(value)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    real(wp) :: value !! [its unit]
    type(swept_key_type), allocatable :: list(:)
    integer :: i

    value = parameter%value
    if (parameter%key%group == 'operation') then
      value = point%speed/angular_speed(1.0_wp)
      if (parameter%key%name == 'load') value = norm2(point%load)
    else if (present(at) .and. allocated(scene%sweep%keys)) then
      list = swept_keys(scene%sweep)
      do i = 1, size(list)
        if (list(i)%label() == parameter%key%label()) value = at
      end do
    end if
  end function present_value
end module gfb_sensitivity
