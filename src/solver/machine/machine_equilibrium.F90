#include "gfb_petsc.h"
!> Equilibrium of a machine: the shaft's motions at its journals with which films carry it.
!>
!> Each bearing is solved with its journal held, and says the force on the shaft f and how that
!> follows the journal, \( Z = -df/da \), exactly. Newton's method on the few motions a of all
!> journals couples them through the condensed shaft,
!>
!> $$ (S + Z) \, \delta a = g + f(a) - S a, $$
!>
!> so that no force is a step late. Z is made once, and follows what steps teach by Broyden's rank-one
!> update; it is made anew where a step makes too little of the imbalance go.
!>
!> Where the shaft conducts heat its temperatures T under the bearings are found with the motions: to
!> a stand T, to f the heat q that the film gives to the shaft, to S and g the shaft's conductances.
!> How forces and heat of such a bearing follow both is made by differences.
module gfb_machine_equilibrium
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_linear_solve, only: solve_general
  use gfb_film_load, only: acts_on, film_forces
  use gfb_operating_point, only: operating_point_type
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_film_surface, only: all_translations => translations
  use gfb_held_shaft, only: held_shaft_type
  use gfb_machine, only: machine_type, journal_type, hold_at_rest, place_of_sleeve
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, has_factors
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_position, only: solve_at
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_saved_state, only: saved_state_type
  use gfb_heat_switch, only: held_bearing_type, hold_heat
  use gfb_vibration_law, only: vibration_type
  use gfb_dynamic_response, only: dynamic_response_type, create_response, find_coefficients, destroy_response
  implicit none (type)
  private
  public :: find_machine_equilibrium, journal_force, move_journal, find_journal_coefficients, set_sizes

  integer, parameter :: ways = 2 !! translations of a journal across its axis
  integer, parameter :: most_steps = 60 !! of Newton's method
  real(wp), parameter :: tolerance = 1.0e-10_wp !! of a motion, over the clearance [1]
  real(wp), parameter :: balanced = 1.0e-9_wp   !! imbalance over the load [1]
  real(wp), parameter :: no_more = 1.0e-12_wp   !! the same with which no further step is taken [1]
  real(wp), parameter :: longest = 0.25_wp      !! step of a journal, over its clearance [1]
  real(wp), parameter :: least_load = 1.0e-6_wp !! that an imbalance is measured against, over p_a D L [1]
  real(wp), parameter :: slow = 0.3_wp          !! of the imbalance that is left by a step with which Z is made anew [1]
  real(wp), parameter :: temperature_size = 200.0_wp !! steps of a temperature are measured by [K]
  real(wp), parameter :: least_power = 1.0e-3_wp !! that heat is measured by [W]
  real(wp), parameter :: difference = 1.0e-3_wp !! of a motion or temperature over its size, for derivatives [1]
  real(wp), parameter :: last_digits = 1.0e-2_wp !! of a step's tolerance: kept factors leave a part of a step, new ones its square [1]
  real(wp), parameter :: progress = 0.95_wp !! imbalance over the best before, in so many steps:
  integer, parameter :: most_idle = 8
  real(wp), parameter :: least_share = 0.1_wp !! of a step within its limits: less is taken whatever it does [1]
  real(wp), parameter :: shortest = 1.0e-3_wp   !! share of a step that is tried [1]

  !> A bearing of the machine, with its solver.
  type, public :: machine_bearing_type
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null()
    type(path_settings_type) :: path
  end type machine_bearing_type

  !> What a film does to its journal, in the order of the coordinates that it feels; behind them stands heat.
  type :: film_type
    integer, allocatable :: at(:)            !! places of what it feels among the machine's unknowns
    real(wp), allocatable :: sign(:)         !! which it has there [1]
    real(wp), allocatable :: force(:)        !! on the shaft, and heat into it [N], [N m], [W]
    real(wp), allocatable :: stiffness(:, :) !! Z [SI]
  end type film_type

  !> What was found.
  type, public :: machine_equilibrium_type
    logical :: converged = .false.
    character(len=:), allocatable :: reason !! why not
    real(wp), allocatable :: motion(:) !! a: those that films feel [m], [rad]
    real(wp), allocatable :: force(:)  !! f: of the films on the shaft [N], [N m]
    real(wp), allocatable :: temperature(:) !! T: of the shaft, where it conducts, under bearings with heat [K]
    type(held_shaft_type) :: held
    type(film_type), allocatable, private :: film(:) !! one a journal
    real(wp), allocatable, private :: unknown(:)     !! motions, then temperatures [m], [rad], [K]
    real(wp), allocatable, private :: action(:)      !! of the films on them [N], [N m], [W]
    real(wp), allocatable, private :: stiffness(:, :), load(:) !! S and g, of the shaft alone [SI]
    integer :: steps = 0
  end type machine_equilibrium_type

contains

  !> Forces and moments of film and asperities on a journal.
  function journal_force(bearing) result(force)
    class(bearing_system_type), intent(in) :: bearing !! solved
    real(wp) :: force(film_forces) !! see `shaft_coordinates` [N], [N m]
    force = -acts_on*bearing%reaction()
  end function journal_force

  !> Solves a bearing with its journal held at another place, in one step or along a path.
  subroutine move_journal(one, coordinate, place, speed, moved, reason)
    type(machine_bearing_type), intent(inout) :: one !! on failure at the last place that was reached
    integer, intent(in) :: coordinate(:) !! of the shaft's five, those that move
    real(wp), intent(in) :: place(:) !! of its sleeve along these [m], [rad]
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    logical, intent(out) :: moved
    character(len=:), allocatable, intent(out) :: reason !! why not; empty where it was
    type(operating_point_type) :: target, before
    type(path_report_type) :: report
    real(wp) :: unknown(one%bearing%local_size()), tolerance
    logical :: near

    near = has_factors(one%newton)
    tolerance = one%newton%settings%step_tolerance
    if (near) one%newton%settings%step_tolerance = last_digits*tolerance
    call one%bearing%get_unknowns(unknown)
    before = one%bearing%point
    target = before
    target%place(coordinate) = place
    target%speed = speed
    call solve_at(one%bearing, one%newton, target, .true., one%path, report, near=near)
    one%newton%settings%step_tolerance = tolerance
    if (.not. report%converged()) then
      one%bearing%point = before
      call one%bearing%set_unknowns(unknown)
      call follow_path(one%bearing, one%newton, target, 0.5_wp, one%path, report)
    end if
    moved = report%converged()
    reason = ''
    if (.not. moved) reason = report%reason()
  end subroutine move_journal

  !> How the force on a journal follows it, at the present answer.
  subroutine find_stiffness(one, journal, stiffness, found)
    type(machine_bearing_type), intent(inout) :: one
    type(journal_type), intent(in) :: journal
    real(wp), allocatable, intent(out) :: stiffness(:, :) !! Z of the coordinates that its film feels [N/m], [N], [N m]
    logical, intent(out) :: found
    type(dynamic_response_type) :: response
    type(held_bearing_type) :: still
    complex(wp), allocatable :: coefficient(:, :)

    call hold_heat(one%bearing, still)
    call create_response(still%bearing, vibration_type(stick=.false.), response)
    call find_journal_coefficients(still%bearing, response, journal, (0.0_wp, 0.0_wp), coefficient, found)
    stiffness = real(coefficient, wp)
    one%newton%factorizations = one%newton%factorizations + response%factorizations
    call destroy_response(response)
  end subroutine find_stiffness

  !> Z of the motions that a journal's film feels.
  subroutine find_journal_coefficients(bearing, response, journal, rate, coefficient, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(journal_type), intent(in) :: journal
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), allocatable, intent(out) :: coefficient(:, :) !! (force, motion) [SI]
    logical, intent(out) :: found
    complex(wp) :: whole(size(response%motion), size(response%motion))
    integer :: of(size(journal%coordinate)), k

    call find_coefficients(bearing, response, rate, whole, found, only_translations=all(journal%coordinate <= ways))
    of = [(findloc(response%motion, journal%coordinate(k), 1), k=1, size(of))]
    coefficient = whole(of, of)
  end subroutine find_journal_coefficients

  !> From bearings that are solved somewhere, each with its journal held, to the equilibrium of the machine.
  subroutine find_machine_equilibrium(machine, bearing, motion, log, answer, nearby)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:) !! one a journal
    real(wp), intent(in) :: motion(:) !! a, to begin with [m], [rad]
    type(run_log_type), intent(in) :: log !! where lines go
    type(machine_equilibrium_type), intent(out) :: answer
    type(machine_equilibrium_type), intent(in), optional :: nearby !! another one, whose Z are begun with where it has them
    type(film_type), allocatable :: before(:)
    real(wp), allocatable :: stiffness(:, :), step(:), left(:), from(:), size_of(:), of_force(:)
    real(wp) :: share, norm, norm_before, best
    integer :: idle !! steps since the imbalance was last less than the best before by some part
    logical :: regular, done

    answer%reason = ''
    call hold_at_rest(machine, machine%held, answer%held, regular)
    if (.not. regular) then
      answer%reason = 'nothing holds the shaft: one journal alone needs journal_tilts'
      return
    end if
    call log%is_on('machine, all bearings together')
    call gather(machine, bearing, motion, answer)
    call set_sizes(machine, bearing, size_of, of_force)
    call move_all(machine, bearing, answer%unknown, answer, regular)
    if (.not. regular) return
    call take_stiffness(nearby, answer, regular)
    if (.not. regular) call linearise_all(machine, bearing, size_of, answer)
    if (answer%reason /= '') return
    left = imbalance_of(answer)
    norm = norm2(left/of_force)
    best = norm
    idle = 0
    do while (answer%steps < most_steps)
      if (stop_agreed()) then
        answer%reason = stop_words()
        return
      end if
      call log%is_on('machine, step '//text(answer%steps + 1)//', imbalance '//text(norm, 2))
      step = left/of_force
      stiffness = stiffness_of(answer)
      call solve_general((answer%stiffness + stiffness)*spread(size_of, 1, size(step))/ &
                         spread(of_force, 2, size(step)), step, regular)
      if (.not. regular) exit
      step = size_of*step
      share = min(1.0_wp, longest/max(maxval(abs(step/size_of)), tiny(1.0_wp)))
      done = share >= 1.0_wp .and. maxval(abs(step/size_of)) < tolerance
      before = answer%film
      from = answer%unknown
      norm_before = norm
      call take_step(machine, bearing, step, max(norm, balanced)*of_force, share, answer)
      if (answer%reason /= '') return
      answer%steps = answer%steps + 1
      left = imbalance_of(answer)
      norm = norm2(left/of_force)
      call log%detail('machine: step '//text(answer%steps)//', share '//text(share, 3)//', imbalance '//text(norm, 3))
      if (done .or. norm < no_more) exit
      idle = idle + 1
      if (norm < progress*best) idle = 0
      if (idle == 0) best = norm
      if (idle > most_idle) exit
      if (norm > (1.0_wp - (1.0_wp - slow)*share)*norm_before) then ! less than a part of what was to go went
        call linearise_all(machine, bearing, size_of, answer)
        if (answer%reason /= '') return
      else
        call learn(from, before, size_of, answer)
      end if
    end do
    call log%is_on('')
    answer%converged = norm < balanced
    if (.not. answer%converged) answer%reason = what_is_left(machine, answer, norm)
  end subroutine find_machine_equilibrium

  !> Z of another equilibrium of the machine.
  pure subroutine take_stiffness(nearby, answer, taken)
    type(machine_equilibrium_type), intent(in), optional :: nearby
    type(machine_equilibrium_type), intent(inout) :: answer
    logical, intent(out) :: taken !! it has them
    integer :: i

    taken = present(nearby)
    if (taken) taken = allocated(nearby%film)
    if (taken) taken = all([(allocated(nearby%film(i)%stiffness), i=1, size(nearby%film))])
    if (.not. taken) return
    do i = 1, size(answer%film)
      answer%film(i)%stiffness = nearby%film(i)%stiffness
    end do
  end subroutine take_stiffness

  !> Says that shaft and films did not come to balance, and how hot the shaft was.
  pure function what_is_left(machine, answer, norm) result(words)
    type(machine_type), intent(in) :: machine
    type(machine_equilibrium_type), intent(in) :: answer
    real(wp), intent(in) :: norm !! imbalance over the load [1]
    character(len=:), allocatable :: words
    integer :: at

    words = 'shaft and films did not come to balance in '//text(answer%steps)//' steps, '//text(norm, 2)//' of the load is left'
    if (.not. machine%heat%present) return
    at = maxloc(answer%temperature, 1)
    words = words//'; the shaft has '//text(answer%temperature(at), 4)//' K under bearing '// &
            text(findloc(machine%heat%at, at, 1))//': it may warm up without an end'
  end function what_is_left

  !> Motions, and temperatures where the shaft conducts, in one list, with what the shaft alone makes of them.
  subroutine gather(machine, bearing, motion, answer)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(in) :: bearing(:)
    real(wp), intent(in) :: motion(:) !! a, to begin with [m], [rad]
    type(machine_equilibrium_type), intent(inout) :: answer
    integer :: i, n

    n = size(motion)
    answer%unknown = motion
    answer%stiffness = answer%held%stiffness
    answer%load = answer%held%force
    if (machine%heat%present) then
      associate (held => machine%heat%held)
        answer%unknown = [motion, spread(0.0_wp, 1, size(held%force))]
        answer%load = [answer%load, held%force]
        deallocate (answer%stiffness)
        allocate (answer%stiffness(size(answer%load), size(answer%load)), source=0.0_wp)
        answer%stiffness(:n, :n) = answer%held%stiffness
        answer%stiffness(n + 1:, n + 1:) = held%stiffness
      end associate
    end if
    allocate (answer%action, mold=answer%unknown)
    allocate (answer%film(size(bearing)))
    do i = 1, size(bearing)
      associate (film => answer%film(i), journal => machine%journal(i))
        film%at = journal%at
        film%sign = journal%sign
        if (.not. has_heat(machine, i)) cycle
        film%at = [journal%at, n + machine%heat%at(i)]
        film%sign = [journal%sign, 1.0_wp]
        answer%unknown(n + machine%heat%at(i)) = bearing(i)%bearing%heat%shaft%temperature
      end associate
    end do
  end subroutine gather

  !> Whether the film of a bearing exchanges heat with a shaft that conducts.
  pure logical function has_heat(machine, number)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the bearing

    has_heat = machine%heat%present
    if (has_heat) has_heat = machine%heat%at(number) > 0
  end function has_heat

  !> How large a motion of each journal and a force on it are, and a temperature and heat.
  subroutine set_sizes(machine, bearing, size_of, of_force)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(in) :: bearing(:) !! its own
    real(wp), allocatable, intent(out) :: size_of(:)  !! clearance, and that over half the width [m], [rad]
    real(wp), allocatable, intent(out) :: of_force(:) !! load, and that times half the width [N], [N m]
    type(bearing_answer_type) :: alone
    real(wp) :: load, half, power
    integer :: i, temperatures

    temperatures = 0
    if (machine%heat%present) temperatures = size(machine%heat%held%force)
    power = 0.0_wp
    do i = 1, merge(size(bearing), 0, temperatures > 0)
      alone = bearing_answer(bearing(i)%bearing, brief=.true.)
      power = power + alone%power_loss
    end do
    allocate (size_of(size(machine%held) + temperatures), source=temperature_size)
    allocate (of_force(size(machine%held) + temperatures), source=max(power, least_power))
    load = max(sum(abs(machine%force(::2))), least_load*bearing(1)%bearing%force_scale())
    do i = 1, size(bearing)
      half = max(0.5_wp*bearing(i)%bearing%pad(1)%film%width, bearing(i)%bearing%mesh%surface%tilt_arm())
      associate (journal => machine%journal(i))
        where (journal%coordinate <= all_translations)
          size_of(journal%at) = bearing(i)%bearing%clearance
          of_force(journal%at) = load
        else where
          size_of(journal%at) = bearing(i)%bearing%clearance/half
          of_force(journal%at) = load*half
        end where
      end associate
    end do
  end subroutine set_sizes

  !> What is left of the balance, g + f - S a [N], [N m], [W].
  pure function imbalance_of(answer) result(left)
    type(machine_equilibrium_type), intent(in) :: answer
    real(wp) :: left(size(answer%unknown))
    left = answer%load + answer%action - matmul(answer%stiffness, answer%unknown)
  end function imbalance_of

  !> Solves all bearings with their journals elsewhere.
  subroutine move_all(machine, bearing, unknown, answer, moved)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:)
    real(wp), intent(in) :: unknown(:) !! motions, then temperatures [m], [rad], [K]
    type(machine_equilibrium_type), intent(inout) :: answer !! gets them, and forces
    logical, intent(out) :: moved
    character(len=:), allocatable :: reason
    integer :: i, n

    n = size(machine%held)
    answer%action = 0.0_wp
    do i = 1, size(bearing)
      associate (journal => machine%journal(i), film => answer%film(i))
        if (has_heat(machine, i)) bearing(i)%bearing%heat%shaft%temperature = unknown(n + machine%heat%at(i))
        call move_journal(bearing(i), journal%coordinate, place_of_sleeve(journal, unknown(:n)), machine%speed, moved, reason)
        if (.not. moved) then
          answer%reason = 'bearing '//text(i)//': '//reason
          return
        end if
        film%force = film_action(machine, i, bearing(i)%bearing)
        answer%action(film%at) = answer%action(film%at) + film%sign*film%force
      end associate
    end do
    answer%unknown = unknown
    answer%motion = unknown(:n)
    answer%temperature = unknown(n + 1:)
    answer%force = answer%action(:n)
    answer%reason = ''
  end subroutine move_all

  !> Forces of a film along the coordinates that it feels, and its heat into a shaft that conducts.
  function film_action(machine, number, bearing) result(action)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the bearing
    type(bearing_system_type), intent(in) :: bearing !! solved
    real(wp), allocatable :: action(:) !! [N], [N m], [W]
    type(bearing_answer_type) :: answer
    real(wp) :: force(film_forces)

    force = journal_force(bearing)
    action = force(machine%journal(number)%coordinate)
    if (.not. has_heat(machine, number)) return
    answer = bearing_answer(bearing, brief=.true.)
    action = [action, answer%heat%whole%to_shaft]
  end function film_action

  !> Takes a step, or as much of it as all bearings can follow, and as makes less of the imbalance; a small part is taken anyhow.
  subroutine take_step(machine, bearing, step, bound, share, answer)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:)
    real(wp), intent(in) :: step(:)  !! of all motions and temperatures [m], [rad], [K]
    real(wp), intent(in) :: bound(:) !! the imbalance is not to be more, all of it together, each over its own [N], [N m], [W]
    real(wp), intent(inout) :: share !! of the step that is taken [1]
    type(machine_equilibrium_type), intent(inout) :: answer
    real(wp) :: from(size(step)), first
    logical :: moved

    from = answer%unknown
    first = share
    do
      call move_all(machine, bearing, from + share*step, answer, moved)
      if (.not. moved .and. share < shortest) return
      if (moved .and. share < least_share*first) return
      if (moved) moved = norm2(imbalance_of(answer)/bound) <= 1.0_wp
      if (moved) return
      share = 0.5_wp*share
    end do
  end subroutine take_step

  !> Z of each journal.
  subroutine linearise_all(machine, bearing, size_of, answer)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:)
    real(wp), intent(in) :: size_of(:) !! of motions and temperatures [m], [rad], [K]
    type(machine_equilibrium_type), intent(inout) :: answer
    real(wp), allocatable :: stiffness(:, :)
    logical :: found
    integer :: i

    do i = 1, size(bearing)
      associate (film => answer%film(i))
        if (has_heat(machine, i)) then
          call find_differences(machine, i, bearing(i), film%force, answer%unknown(film%at), size_of(film%at), stiffness, answer%reason)
        else
          call find_stiffness(bearing(i), machine%journal(i), stiffness, found)
          if (.not. found) answer%reason = 'bearing '//text(i)//': its linearised equations cannot be factorized'
        end if
        if (answer%reason /= '') return
        film%stiffness = stiffness
      end associate
    end do
  end subroutine linearise_all

  !> Z of a bearing with heat, by differences: temperatures of film and foils follow its journal and the shaft's temperature.
  subroutine find_differences(machine, number, one, action, unknown, size_of, stiffness, reason)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the bearing
    type(machine_bearing_type), intent(inout) :: one !! is left as it is
    real(wp), intent(in) :: action(:)  !! of its film now [N], [N m], [W]
    real(wp), intent(in) :: unknown(:) !! what it feels, motions and temperature [m], [rad], [K]
    real(wp), intent(in) :: size_of(:) !! of these [m], [rad], [K]
    real(wp), allocatable, intent(out) :: stiffness(:, :) !! Z [SI]
    character(len=:), allocatable, intent(inout) :: reason
    type(saved_state_type) :: state
    character(len=:), allocatable :: why
    real(wp) :: place(size(unknown) - 1), move
    logical :: moved
    integer :: k, n

    n = size(unknown)
    allocate (stiffness(n, n))
    call state%save(one%bearing)
    associate (shaft => one%bearing%heat%shaft, coordinate => machine%journal(number)%coordinate)
      do k = 1, n
        move = difference*size_of(k)
        place = one%bearing%point%place(coordinate)
        if (k < n) place(k) = place(k) - move ! the journal moves, not the sleeve
        if (k == n) shaft%temperature = unknown(n) + move
        call move_journal(one, coordinate, place, machine%speed, moved, why)
        if (moved) stiffness(:, k) = (action - film_action(machine, number, one%bearing))/move
        shaft%temperature = unknown(n)
        call state%restore(one%bearing)
        if (moved) cycle
        reason = 'bearing '//text(number)//', as near as derivatives are taken: '//why
        exit
      end do
    end associate
    call state%destroy()
  end subroutine find_differences

  !> Z of all motions and temperatures.
  pure function stiffness_of(answer) result(stiffness)
    type(machine_equilibrium_type), intent(in) :: answer
    real(wp), allocatable :: stiffness(:, :) !! [SI]
    integer :: i

    allocate (stiffness, mold=answer%stiffness)
    stiffness = 0.0_wp
    do i = 1, size(answer%film)
      associate (at => answer%film(i)%at, sign => answer%film(i)%sign)
        stiffness(at, at) = stiffness(at, at) + answer%film(i)%stiffness*spread(sign, 1, size(at))*spread(sign, 2, size(at))
      end associate
    end do
  end function stiffness_of

  !> Broyden's update of each journal's Z by what a step has shown.
  pure subroutine learn(from, before, size_of, answer)
    real(wp), intent(in) :: from(:) !! motions and temperatures before the step [m], [rad], [K]
    type(film_type), intent(in) :: before(:) !! the films there
    real(wp), intent(in) :: size_of(:) !! of them [m], [rad], [K]
    type(machine_equilibrium_type), intent(inout) :: answer !! behind it
    integer :: i

    do i = 1, size(before)
      associate (film => answer%film(i))
        associate (at => film%at)
          call learn_one(film%sign*(answer%unknown(at) - from(at)), film%force - before(i)%force, size_of(at), film%stiffness)
        end associate
      end associate
    end do
  end subroutine learn

  !> The same of one journal.
  pure subroutine learn_one(moved, gained, size_of, stiffness)
    real(wp), intent(in) :: moved(:)   !! the step [m], [rad]
    real(wp), intent(in) :: gained(:)  !! force by it [N], [N m]
    real(wp), intent(in) :: size_of(:) !! of motions [m], [rad]
    real(wp), intent(inout) :: stiffness(:, :) !! Z [SI]
    real(wp), dimension(size(moved)) :: along, missed

    along = moved/size_of**2
    if (.not. dot_product(along, moved) > 0.0_wp) return
    missed = -gained - matmul(stiffness, moved)
    stiffness = stiffness + spread(missed, 2, size(moved))*spread(along, 1, size(moved))/dot_product(along, moved)
  end subroutine learn_one
end module gfb_machine_equilibrium
