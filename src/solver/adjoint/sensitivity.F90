#include "gfb_petsc.h"
!> How numbers of an answer follow keys of the case file, by the adjoint.
!>
!> At an answer \( J(u, a) = 0 \) a number \( g(u, a) \) follows a key a by
!>
!> $$ \frac{dg}{da} = \frac{\partial g}{\partial a} - \lambda^T \frac{\partial J}{\partial a}, \qquad
!>    J_u^T \lambda = g_u: $$
!>
!> one transposed solve a number, with the factors that the answer has. The derivatives by a at a fixed state are
!> differences of residual and number, of bearings with a little more and a little less of the key.
!> Contacts stay open, stick or slide as they do at the answer.
module gfb_sensitivity
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use petscmat
  use gfb_kinds, only: wp
  use gfb_units, only: degrees
  use gfb_scene, only: scene_type
  use gfb_study_cases, only: parameter_type, quantity_words
  use gfb_sweep_case, only: swept_key_type, swept_keys
  use gfb_operation_case, only: angular_speed
  use gfb_film_surface, only: translations
  use gfb_operating_point, only: operating_point_type
  use gfb_pad_contacts, only: linearise_exactly
  use gfb_bearing_system, only: bearing_system_type
  use gfb_model_case, only: meshes_foils
  use gfb_meshed_foil, only: split_motion, top_surface, bump_surface
  use gfb_newton, only: newton_type, solve_transposed
  use gfb_answer_numbers, only: extreme_nodes_type, known_answer_type, find_extremes, measure, measure_gradient, numbers, &
                                place_e, place_force, place_torque, place_speed, place_extremes, place_heat
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: any_rank, sum_over_ranks, share_failure
  use gfb_fixed_lines, only: fixed_line_half_flat
  use gfb_scene_reading, only: scene_with_key
  use gfb_foil_builder, only: keep_elements
  use gfb_changed_foil, only: elastic_work
  use gfb_bearing_builder, only: build_like, take_numbers
  implicit none (type)
  private
  public :: keep_tangent, find_sensitivities, evaluate_changed

  !> How a derivative by a key is made of differences.
  type :: difference_type
    real(wp) :: part = 2.0e-4_wp !! of the key, that it is changed by [1]
    !> of the values at one and two such steps on both sides; with these the error is of fourth order
    real(wp) :: weight(-2:2) = [1.0_wp, -8.0_wp, 0.0_wp, 8.0_wp, -1.0_wp]/12.0_wp
  end type difference_type

  real(wp), parameter :: central(-2:2) = [0.0_wp, -0.5_wp, 0.0_wp, 0.5_wp, 0.0_wp] !! the same of second order
  real(wp), parameter :: forward(-2:2) = [0.0_wp, 0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp] !! exact where all is linear
  real(wp), parameter :: enough = 1.0e-10_wp    !! residual of an adjoint, over its right side [1]
  integer, parameter :: most_corrections = 10   !! of an adjoint: the factors may be those of a matrix close by

  !> What is found of an answer.
  type, public :: sensitivity_type
    real(wp), allocatable :: value(:)         !! of each of `quantity_words` [its unit]
    real(wp), allocatable :: derivative(:, :) !! (quantities, parameters) not a number where there is none
    character(len=:), allocatable :: problem  !! why there are none by some parameter
  end type sensitivity_type

contains

  !> The matrix of the bearing's equations at its answer, without artificial stiffness of open contacts.
  subroutine keep_tangent(bearing, tangent)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer
    Mat, intent(out) :: tangent !! its copy
    PetscErrorCode :: ierr
    logical :: moved

    call bearing%settle(bearing%state, moved)
    call linearise_exactly(bearing, bearing%shaft_fixed)
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, tangent, ierr))
  end subroutine keep_tangent

  !> Derivatives of all quantities that the scene asks for by all its parameters.
  subroutine find_sensitivities(scene, bearing, newton, tangent, found, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    Mat, intent(in) :: tangent !! of `keep_tangent`
    type(sensitivity_type), intent(out) :: found !! values and derivatives
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]

    Vec :: adjoint(size(quantity_words))
    type(known_answer_type) :: answer
    real(wp) :: number(numbers), combined(size(quantity_words), numbers)
    character(len=:), allocatable :: problem
    logical :: solved(size(quantity_words))
    PetscErrorCode :: ierr
    integer :: i, k

    allocate (answer%unknown(bearing%local_size()), answer%motion(0))
    call bearing%get_unknowns(answer%unknown)
    call find_extremes(bearing, answer%nodes)
    number = measure(bearing, answer%unknown, bearing%point, answer%nodes)
    call combine(number, found%value, combined)
    call find_adjoints(scene, bearing, newton, tangent, answer%nodes, combined, adjoint, solved)
    if (meshes_foils(scene%model%foil)) call find_motions(bearing, adjoint, solved, answer)
    associate (parameter => scene%sensitivity%parameter)
      allocate (found%derivative(size(quantity_words), size(parameter)), source=ieee_value(1.0_wp, ieee_quiet_nan))
      found%problem = ''
      do i = 1, size(parameter)
        call find_derivatives(scene, parameter(i), bearing, answer, combined, adjoint, solved, found%derivative(:, i), &
                              problem, at)
        if (problem /= '') found%problem = parameter(i)%key%label()//': '//problem
      end do
    end associate
    if (any(scene%sensitivity%quantity .and. .not. solved)) found%problem = 'the transposed equations were not solved'
    do k = 1, size(quantity_words)
      if (scene%sensitivity%quantity(k)) then
        PetscCallA(VecDestroy(adjoint(k), ierr))
      end if
    end do
  end subroutine find_sensitivities

  !> The quantities in the order of `quantity_words` from the numbers that are measured, and their derivatives.
  pure subroutine combine(number, value, rate)
    real(wp), intent(in) :: number(:)              !! measured
    real(wp), allocatable, intent(out) :: value(:) !! of the quantities
    real(wp), intent(out) :: rate(:, :)            !! (quantities, numbers)
    real(wp) :: square
    integer, parameter :: attitude = 3, power = 9, extremes = 10 !! among the quantities
    integer :: k, axial

    allocate (value(size(rate, 1)))
    axial = size(value) - 1
    rate = 0.0_wp
    value(:2) = number(place_e:place_e + 1)
    value(attitude + 1:power - 1) = number(place_force:place_torque)
    value(extremes:axial - 1) = number(place_extremes:)
    value(axial:) = [-number(place_e), number(place_force)] ! of a ring
    rate(axial, place_e) = -1.0_wp
    rate(axial + 1, place_force) = 1.0_wp
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
    real(wp) :: gradient(bearing%local_size(), merge(numbers, place_heat - 1, bearing%heat%present))
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
      call bearing%exchange%add(matmul(gradient, combined(k, :size(gradient, 2)))*bearing%unknown_scale, right)
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

  !> How the foils move at the answer, and in the adjoints of all quantities.
  subroutine find_motions(bearing, adjoint, solved, answer)
    type(bearing_system_type), intent(in) :: bearing !! with meshed foils
    Vec, intent(in) :: adjoint(:) !! one a quantity
    logical, intent(in) :: solved(:) !! else there is none
    type(known_answer_type), intent(inout) :: answer !! with its unknowns; gets the motions
    real(wp) :: value(bearing%local_size())
    integer :: k

    deallocate (answer%motion)
    allocate (answer%motion(size(bearing%pad)))
    call add_motion(0, answer%unknown)
    do k = 1, size(adjoint)
      if (.not. solved(k)) cycle
      call bearing%exchange%get(adjoint(k), value)
      call add_motion(k, value/bearing%equation_scale(bearing%point))
    end do

  contains

    !> Displacements of a state, or of an adjoint.
    subroutine add_motion(number, value)
      integer, intent(in) :: number !! 0: the state
      real(wp), intent(in) :: value(:) !! local unknowns
      real(wp), allocatable :: top(:, :), bumps(:, :)
      integer :: i

      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), motion => answer%motion(i))
          call split_motion(pad%foil, value(pad%first + 1:pad%last), top, bumps)
          if (number == 0) then
            allocate (motion%top(size(top, 1), size(top, 2), 0:size(adjoint)), source=0.0_wp)
            allocate (motion%bumps(size(bumps, 1), size(bumps, 2), 0:size(adjoint)), source=0.0_wp)
          end if
          motion%top(:, :, number) = top
          motion%bumps(:, :, number) = bumps
        end associate
      end do
    end subroutine add_motion
  end subroutine find_motions

  !> Derivatives of all quantities by a key: by differences of residual and numbers at the state of the answer.
  subroutine find_derivatives(scene, parameter, bearing, answer, combined, adjoint, solved, derivative, problem, at)
    type(scene_type), intent(in) :: scene
    type(parameter_type), intent(in) :: parameter
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    real(wp), intent(in) :: combined(:, :) !! (quantities, numbers)
    Vec, intent(in) :: adjoint(:)     !! one a quantity
    logical, intent(in) :: solved(:)  !! else there is none
    real(wp), intent(inout) :: derivative(:) !! stays where there is none
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    Vec :: change, residual
    real(wp) :: number(numbers), slope(numbers), work(size(adjoint)), elastic(size(adjoint)), value, step, along
    PetscErrorCode :: ierr
    type(difference_type) :: difference
    integer :: steps, k

    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, residual, ierr))
    PetscCallA(VecSet(change, 0.0_wp, ierr))
    slope = 0.0_wp
    elastic = 0.0_wp
    value = present_value(scene, parameter, bearing%point, at)
    difference = difference_of(parameter%key)
    step = difference%part*abs(value)
    if (parameter%key%is_gap()) step = difference%part*scene%bearing%clearance
    problem = ''
    if (.not. step > 0.0_wp) problem = 'it is 0 here'
    do steps = -2, 2
      if (problem /= '') exit
      if (.not. abs(difference%weight(steps)) > 0.0_wp) cycle
      call evaluate_changed(scene, parameter, value + steps*step, bearing, answer, residual, number, work, problem, at)
      PetscCallA(VecAXPY(change, difference%weight(steps)/step, residual, ierr))
      slope = slope + difference%weight(steps)/step*number
      elastic = elastic + difference%weight(steps)/step*work
    end do
    do k = 1, merge(size(adjoint), 0, problem == '')
      if (.not. solved(k)) cycle
      PetscCallA(VecDot(adjoint(k), change, along, ierr))
      derivative(k) = dot_product(combined(k, :), slope) - along - elastic(k)
    end do
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine find_derivatives

  !> The differences that suit a key. Where it leaves the foils' stiffness alone little is lost to rounding. In thickness
  !> and material stiffness is a polynomial, or nearly one, of low degree. The shape of bumps is neither, and a pitch adds
  !> up along the strip.
  !> Gaps of contacts that stay as they are are part of the equations in proportion.
  pure function difference_of(key) result(difference)
    type(swept_key_type), intent(in) :: key
    type(difference_type) :: difference
    real(wp), parameter :: small = 4.0e-6_wp, large = 5.0e-4_wp

    select case (key%group)
    case ('operation', 'gas', 'bore', 'contact', 'shaft_contact', 'thermal')
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
      if (parameter%key%name == 'load') value = norm2(point%load(:translations))
    else if (present(at) .and. allocated(scene%sweep%keys)) then
      list = swept_keys(scene%sweep)
      do i = 1, size(list)
        if (list(i)%label() == parameter%key%label()) value = at
      end do
    end if
  end function present_value

  !> Residual and numbers at an answer's state with another value of a key; the bearing is as before on return.
  subroutine evaluate_changed(scene, parameter, value, bearing, answer, residual, number, work, problem, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(parameter_type), intent(in) :: parameter !! the key
    real(wp), intent(in) :: value !! of it [its unit]
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(known_answer_type), intent(in) :: answer !! what is known of it
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:) !! as `measure` has them [SI]
    real(wp), intent(out) :: work(:) !! of elastic forces that are not in the residual, on each adjoint
    character(len=:), allocatable, intent(out) :: problem !! why there are none; empty where there is none
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(scene_type) :: there
    type(error_type), allocatable :: error
    logical :: valid

    number = 0.0_wp
    work = 0.0_wp
    problem = ''
    valid = .true.
    if (parameter%key%group == 'operation') then
      call evaluate_operation(parameter, value, bearing, answer, residual, number, valid)
    else
      call scene_with_key(scene, parameter%key, value, there, error, at)
      if (allocated(error)) then
        problem = error%message
        return
      end if
      call keep_elements(scene, there)
      if (meshes_foils(scene%model%foil) .and. keeps_meshes(scene, parameter%key)) then
        call evaluate_in_place(scene, there, parameter%key, bearing, answer, residual, number, work, valid, error)
      else
        call evaluate_rebuilt(there, bearing, answer, residual, number, valid, problem, error)
      end if
      if (allocated(error)) problem = error%message
    end if
    if (any_rank(.not. valid)) problem = 'the film is closed at a value close by'
  end subroutine evaluate_changed

  !> The same bearing at another load, the direction kept, or at another speed.
  subroutine evaluate_operation(parameter, value, bearing, answer, residual, number, valid)
    type(parameter_type), intent(in) :: parameter
    real(wp), intent(in) :: value !! [its unit]
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    logical, intent(out) :: valid !! gap and pressure are positive
    type(operating_point_type) :: point

    point = bearing%point
    if (parameter%key%name == 'load') then
      point%load(:translations) = point%load(:translations)*(value/norm2(point%load(:translations)))
    else
      point%speed = angular_speed(value)
    end if
    call bearing%evaluate_at(point, bearing%state, residual, valid)
    number = measure(bearing, answer%unknown, point, answer%nodes)
  end subroutine evaluate_operation

  !> Whether a key moves neither the film's mesh nor the crests.
  pure logical function keeps_meshes(scene, key) result(keeps)
    type(scene_type), intent(in) :: scene
    type(swept_key_type), intent(in) :: key

    associate (name => key%name)
      select case (key%group)
      case ('gas', 'bore', 'contact', 'shaft_contact', 'thermal')
        keeps = .true.
      case ('bearing')
        keeps = name == 'clearance' .or. name == 'assembly_interference'
      case ('pads')
        keeps = name == 'preload' .or. name == 'preload_offset'
      case ('top_foil', 'bump_foil')
        keeps = name == 'thickness' .or. name == 'youngs_modulus' .or. name == 'poissons_ratio' .or. name == 'height' .or. &
                name == 'free_radius' .or. key%is_gap()
        ! else the first crest stands as far from the weld as half a bump is long
        if (name == 'half_length') keeps = scene%bump_foil%fixed_line == fixed_line_half_flat
      case default
        keeps = .false.
      end select
    end associate
  end function keeps_meshes

  !> The same bearing with other numbers. Its matrix of the foils stays; what changes in it is in the work.
  subroutine evaluate_in_place(scene, there, key, bearing, answer, residual, number, work, valid, error)
    type(scene_type), intent(in) :: scene, there !! as it is; with the key changed
    type(swept_key_type), intent(in) :: key !! that is changed
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    real(wp), intent(inout) :: work(:) !! 0 where no foil is another
    logical, intent(out) :: valid !! gap and pressure are positive
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: of_pad(size(work))
    logical :: of_bumps
    integer :: i

    call take_numbers(there, bearing)
    call bearing%evaluate_at(bearing%point, bearing%state, residual, valid)
    number = 0.0_wp ! they stay where the foils alone are others
    select case (key%group)
    case ('contact', 'top_foil', 'bump_foil')
      if (bearing%heat%present) number = measure(bearing, answer%unknown, bearing%point, answer%nodes)
    case default
      number = measure(bearing, answer%unknown, bearing%point, answer%nodes)
    end select
    call take_numbers(scene, bearing)
    of_bumps = key%group == 'bump_foil'
    if (key%is_gap() .or. .not. (of_bumps .or. key%group == 'top_foil')) return
    do i = 1, size(answer%motion)
      associate (pad => bearing%pad(i), motion => answer%motion(i))
        if (of_bumps) then
          call elastic_work(pad%foil, there, pad%whole, of_bumps, motion%bumps, of_pad, error)
        else
          call elastic_work(pad%foil, there, pad%whole, of_bumps, motion%top, of_pad, error)
        end if
      end associate
      if (allocated(error)) exit
      work = work + bearing%pad(i)%foil%modulus(merge(bump_surface, top_surface, of_bumps))*of_pad
    end do
    call share_failure(error)
    work = sum_over_ranks(work)
  end subroutine evaluate_in_place

  !> Another bearing on a mesh like this one's.
  subroutine evaluate_rebuilt(there, bearing, answer, residual, number, valid, problem, error)
    type(scene_type), intent(in) :: there
    type(bearing_system_type), intent(in) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    logical, intent(out) :: valid !! gap and pressure are positive
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(error_type), allocatable, intent(out) :: error
    type(bearing_system_type) :: other

    number = 0.0_wp
    valid = .true.
    problem = ''
    call build_like(there, bearing, other, error)
    if (allocated(error)) return
    if (is_alike(bearing, other)) then
      call take_contacts(bearing, other)
      call other%set_unknowns(answer%unknown)
      call other%evaluate(other%state, residual, valid)
      number = measure(other, answer%unknown, other%point, answer%nodes)
    else
      problem = 'the mesh changes with it'
    end if
    call other%destroy()
  end subroutine evaluate_rebuilt

  !> Whether two bearings have the same unknowns and contacts.
  logical function is_alike(bearing, other) result(alike)
    type(bearing_system_type), intent(in) :: bearing, other

    alike = bearing%local_size() == other%local_size() .and. bearing%film_nodes() == other%film_nodes() .and. &
      size(bearing%pad(1)%foil%contacts%point) == size(other%pad(1)%foil%contacts%point)
    if (alike) alike = all(bearing%pad(1)%mesh%mesh_node == other%pad(1)%mesh%mesh_node)
    alike = .not. any_rank(.not. alike)
  end function is_alike

  !> Contacts of a bearing are linearised where those of another are.
  subroutine take_contacts(bearing, other)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_system_type), intent(inout) :: other
    integer :: i

    do i = 1, size(bearing%pad)
      if (.not. bearing%pad(i)%foil%has_contacts()) cycle
      call other%pad(i)%foil%contacts%settle_like(bearing%pad(i)%foil%contacts)
    end do
  end subroutine take_contacts
end module gfb_sensitivity
