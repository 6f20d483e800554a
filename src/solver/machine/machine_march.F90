#include "gfb_petsc.h"
!> A machine over time: shaft, films and foils in one implicit step.
!>
!> Each bearing takes its step with its journal held (`gfb_time_march`), and says its force on the shaft f; the shaft takes its own
!> by the same differences, condensed exactly to its journals (`gfb_shaft_step`). Newton's method on the journals' motions a couples them,
!>
!> $$ (I + \Phi Z) \, \delta a = a_{\rm free} + \Phi f(a) - a, \quad \Phi = B H^{-1} B^T, \quad Z = -df/da, $$
!>
!> so that no force is a step late. Z, and the way that films and foils follow a journal, are tangents by each bearing's factors; they
!> are made anew with these. The shaft moves by the forces that the films have at the end, to the last digit.
!>
!> Films and journals are extrapolated first, and the shaft by these films' forces is off from there: one step of Newton's method by the
!> tangents at hand, before any film is solved, leaves some hundredths of that way.
!>
!> The first step is backward Euler's, which needs no past: of first order once, and so of second order in all.
module gfb_machine_march
  use petscvec
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_archive, only: archive_type
  use gfb_linear_solve, only: solve_general
  use gfb_backward_difference, only: difference_weights, newest_rate, next_step, kept_times, extrapolation_weights
  use gfb_film_load, only: film_forces
  use gfb_film_surface, only: shaft_coordinates
  use gfb_complex_solver, only: keep_entries
  use gfb_shaft_step, only: shaft_step_type, prepare_shaft_step, motion_without_films
  use gfb_machine, only: machine_type, journal_type, place_of_sleeve
  use gfb_machine_drive, only: machine_drive_type
  use gfb_machine_equilibrium, only: machine_bearing_type, journal_force, set_sizes
  use gfb_march_state, only: march_type, march_settings_type, allowed_step, usual_step, error_of
  use gfb_time_march, only: begin_march, end_march, prepare_step_of, predict_step, accept_step, find_misfit, rebuild_past
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_report_type, newton_settings_type, solve_nearby, solve_with_factors, has_factors
  implicit none (type)
  private
  public :: begin_machine_march, resume_from_past, take_machine_step, end_machine_march
  public :: visit_machine_march, resume_machine_march, forget_tangents

  real(wp), parameter :: rejected = 2.0_wp !! error over the largest one that is not accepted [1]
  integer, parameter :: most_trials = 12   !! of one step
  integer, parameter :: most_iterations = 20 !! of Newton's method on the journals' motions
  !> Of the journals' motions, over the way from where the step before had them expected: that is some times the step's own error.
  real(wp), parameter :: part_of_error = 5.0e-3_wp
  real(wp), parameter :: fine = 1.0e-9_wp !! but not less than that of the clearance [1]
  real(wp), parameter :: enough = 0.03_wp   !! of what journals are off that bearings are solved to on the way [1]
  real(wp), parameter :: nearby = 1.0e-3_wp !! of the clearance, shaft and sleeves that were read differ by less [1]
  real(wp), parameter :: long_ago = 1.0e6_wp !! step before the first one, over that: its difference is backward Euler's [1]
  real(wp), parameter :: small = 1.0e-3_wp !! motion by which a tangent is measured, over the clearance [1]

  !> How a bearing follows its journal in a step of time.
  type :: tangent_type
    integer :: factors = -1              !! factorizations when it was made
    type(tVec), allocatable :: way(:)    !! change of the state by a unit motion of the sleeve, scaled
    real(wp), allocatable :: length(:)   !! motion by which forces are measured [m], [rad]
    real(wp), allocatable :: stiffness(:, :) !! Z of the coordinates that the film feels [SI]
    logical, allocatable :: kept(:)      !! owned unknowns but the shaft's
  end type tangent_type

  !> The march.
  type, public :: machine_march_type
    type(machine_drive_type) :: drive
    type(march_type), allocatable :: film(:) !! of each bearing, its journal held; the first one has the clock
    real(wp), allocatable :: motion(:, :)    !! (all motions, kept_times) now and before [m], [1]
    real(wp), allocatable :: rate(:, :)      !! (all motions, 2) [m/s], [1/s]
    real(wp), allocatable :: force(:)        !! of the films on the held motions, now [N], [N m]
    real(wp), allocatable :: size_of(:)      !! of these motions: clearances, and those over half a width [m], [rad]
    real(wp), allocatable :: first_motion(:) !! at the beginning
    real(wp) :: usual = 0.0_wp               !! by how much the place is off that a step begins with, over the clearance [1]
    real(wp) :: part = part_of_error         !! to which a step is solved, over that way [1]
    real(wp) :: finest = fine                !! but not less than that of the clearance [1]
    integer :: solves = 0                    !! of Newton's method on the journals' motions, its iterations
    type(shaft_step_type), private :: shaft  !! of the present step
    type(tangent_type), allocatable, private :: tangent(:)
  end type machine_march_type

contains

  !> Begins at rest, in an equilibrium.
  subroutine begin_machine_march(machine, motion, force, drive, settings, bearing, march)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: motion(:) !! all of the machine, where it rests [m], [1]
    real(wp), intent(in) :: force(:)  !! of the films on the held motions there [N], [N m]
    type(machine_drive_type), intent(in) :: drive !! what drives it
    type(march_settings_type), intent(in) :: settings(:) !! of each bearing; steps are those of the first one
    type(machine_bearing_type), intent(inout) :: bearing(:) !! at their answers
    type(machine_march_type), intent(out) :: march
    real(wp), allocatable :: of_force(:)
    integer :: i

    march%drive = drive
    march%motion = spread(motion, 2, kept_times)
    march%first_motion = motion
    allocate (march%rate(size(march%first_motion), 2), source=0.0_wp)
    march%force = force
    call set_sizes(machine, bearing, march%size_of, of_force)
    allocate (march%film(size(bearing)), march%tangent(size(bearing)))
    do i = 1, size(bearing)
      call begin_march(drive%clock, settings(i), bearing(i)%bearing, march%film(i))
      march%film(i)%past_step = long_ago*march%film(i)%next
      call begin_tangent(bearing(i)%bearing, machine%journal(i), march%size_of(machine%journal(i)%at), march%tangent(i))
    end do
  end subroutine begin_machine_march

  !> Room for a bearing's tangent.
  subroutine begin_tangent(bearing, journal, size_of, tangent)
    type(bearing_system_type), intent(in) :: bearing
    type(journal_type), intent(in) :: journal !! in it
    real(wp), intent(in) :: size_of(:) !! of its motions [m], [rad]
    type(tangent_type), intent(inout) :: tangent
    real(wp) :: flag(bearing%local_size())
    Vec :: flags
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: k

    flag = 1.0_wp
    flag(bearing%first_shaft + 1:) = 0.0_wp
    PetscCallA(VecDuplicate(bearing%state, flags, ierr))
    call bearing%exchange%put(flag, flags)
    PetscCallA(GFB_VecGetArrayRead(flags, values, ierr))
    tangent%kept = values > 0.5_wp
    PetscCallA(GFB_VecRestoreArrayRead(flags, values, ierr))
    PetscCallA(VecDestroy(flags, ierr))
    tangent%length = small*size_of
    associate (n => size(journal%coordinate))
      allocate (tangent%way(n), tangent%stiffness(n, n))
    end associate
    tangent%stiffness = 0.0_wp
    do k = 1, size(tangent%way)
      PetscCallA(VecDuplicate(bearing%state, tangent%way(k), ierr))
    end do
  end subroutine begin_tangent

  !> Begins with a given past of the shaft instead, in equal steps; films have got theirs (`resume_march`).
  pure subroutine resume_from_past(motion, rate, march)
    real(wp), intent(in) :: motion(:, :) !! (all motions, 2) now and one step ago [m], [1]
    real(wp), intent(in) :: rate(:, :)   !! (all motions, 2) [m/s], [1/s]
    type(machine_march_type), intent(inout) :: march !! that has begun
    real(wp) :: weight(0:2)
    integer :: i

    do i = 1, size(march%film)
      march%film(i)%past_step = march%film(i)%next
    end do
    weight = difference_weights(march%film(1)%next, march%film(1)%next)
    march%motion(:, :2) = motion
    march%rate = rate
    march%motion(:, 3) = motion(:, 2) + (rate(:, 1) - weight(0)*(motion(:, 1) - motion(:, 2)))/weight(2)
  end subroutine resume_from_past

  !> One step; shorter where it does not converge or is too inaccurate.
  !>
  !> Where even a short one has no answer the reason is given, and all is where it was.
  subroutine take_machine_step(machine, bearing, march, reason)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:) !! at the newest states
    type(machine_march_type), intent(inout) :: march
    character(len=:), allocatable, intent(out) :: reason !! why there is none; empty where there is
    real(wp) :: step, error, place(shaft_coordinates, size(bearing))
    real(wp), allocatable :: motion(:)
    integer :: i, trial

    associate (clock => march%film(1))
      step = allowed_step(clock)
      do trial = 1, most_trials
        call try_step(machine, bearing, march, step, motion, place, reason)
        if (reason == '') then
          error = 0.0_wp
          do i = 1, size(bearing)
            error = max(error, error_of(march%film(i), step, place(:, i))/(clock%settings%tolerance*bearing(i)%bearing%clearance))
          end do
          if (clock%settings%steps_per_turn > 0.0_wp .or. error < rejected) exit
          step = next_step(step, error)
          if (trial == most_trials) reason = 'the error of a step stays too large'
        else
          step = 0.5_wp*step
        end if
        clock%rejections = clock%rejections + 1
        do i = 1, size(bearing)
          call bearing(i)%bearing%return_to(march%film(i)%state(1))
        end do
      end do
      if (reason /= '') return
      call accept_machine_step(march, step, motion, place, bearing)
      clock%next = next_step(step, error)
      if (clock%settings%steps_per_turn > 0.0_wp) clock%next = usual_step(clock)
    end associate
  end subroutine take_machine_step

  !> What is found becomes the newest of the past.
  subroutine accept_machine_step(march, step, motion, place, bearing)
    type(machine_march_type), intent(inout) :: march
    real(wp), intent(in) :: step !! that led to it [s]
    real(wp), intent(in) :: motion(:) !! of the shaft [m], [1]
    real(wp), intent(in) :: place(:, :) !! (coordinates, bearing) of the sleeves [m], [rad]
    type(machine_bearing_type), intent(inout) :: bearing(:) !! at their states
    real(wp) :: rate(size(motion))
    integer :: i

    rate = newest_rate(difference_weights(step, march%film(1)%past_step(1)), motion, march%motion)
    march%rate(:, 2) = march%rate(:, 1)
    march%rate(:, 1) = rate
    march%motion(:, 2:) = march%motion(:, :kept_times - 1)
    march%motion(:, 1) = motion
    do i = 1, size(bearing)
      call accept_step(march%film(i), step, place(:, i), bearing(i)%bearing)
    end do
  end subroutine accept_machine_step

  !> A step of a given length.
  subroutine try_step(machine, bearing, march, step, motion, place, reason)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:) !! at the newest states; at those of the step where there is one
    type(machine_march_type), intent(inout) :: march
    real(wp), intent(in) :: step !! [s]
    real(wp), allocatable, intent(out) :: motion(:) !! all of the machine [m], [1]
    real(wp), intent(out) :: place(:, :) !! (coordinates, bearing) of the sleeves [m], [rad]
    character(len=:), allocatable, intent(out) :: reason !! why there is none
    real(wp), dimension(size(machine%held)) :: here, force, left
    real(wp) :: weight(0:2), speed, off, allowed, wanted
    real(wp), allocatable :: free(:)
    logical :: regular, predicted
    integer :: i, iteration

    associate (clock => march%film(1))
      weight = difference_weights(step, clock%past_step(1))
      speed = clock%drive%speed_at(clock%time + step)
      if (.not. march%shaft%serves(weight(0), speed)) then
        call prepare_shaft_step(machine%equations, weight(0), speed, machine%held, march%shaft, regular)
        reason = 'the equations of the shaft are singular'
        if (.not. regular) return
      end if
      free = motion_without_films(march%shaft, machine%equations, weight, march%motion, march%rate, &
                                  march%drive%force_at(clock%time + step))
      here = matmul(march%motion(machine%held, :), extrapolation_weights([step, clock%past_step(:2)]))
    end associate
    do i = 1, size(bearing)
      place(:, i) = march%film(i)%place(:, 1)
      place(machine%journal(i)%coordinate, i) = place_of_sleeve(machine%journal(i), here)
      call prepare_step_of(march%film(i), step, bearing(i)%bearing, place(:, i))
      call predict_step(march%film(i), step, bearing(i)%bearing)
    end do
    allowed = max(march%finest, enough*march%usual)
    predicted = all(march%tangent%factors >= 0)
    if (predicted) then
      call sum_forces(machine, bearing, force)
      call see_imbalance(machine, march, free, here, force, left, march%usual)
      call follow_shaft(machine, march, left, here, place, bearing, regular)
      allowed = max(march%finest, march%part*march%usual)
    end if
    do iteration = 1, most_iterations
      call find_forces(machine, bearing, allowed, iteration > 1, march%tangent, force, reason)
      if (reason /= '') return
      march%solves = march%solves + 1
      call see_imbalance(machine, march, free, here, force, left, off)
      if (iteration == 1 .and. .not. predicted) march%usual = off
      wanted = max(march%finest, march%part*march%usual)
      if (off <= wanted .and. allowed <= wanted) exit
      allowed = wanted
      call follow_shaft(machine, march, left, here, place, bearing, regular)
      if (.not. regular) exit
    end do
    reason = ''
    motion = free + matmul(march%shaft%follows, force)
    march%force = force
    if (iteration > most_iterations .or. .not. off <= wanted) reason = 'shaft and films did not come to balance'
  end subroutine try_step

  !> Forces of all films on the held motions, their journals held.
  subroutine find_forces(machine, bearing, allowed, again, tangent, force, reason)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:) !! prepared for a step
    real(wp), intent(in) :: allowed !! last step of Newton's method on each, relative [1]
    logical, intent(in) :: again !! they were solved beside these places before
    type(tangent_type), intent(inout) :: tangent(:)
    real(wp), intent(out) :: force(:) !! [N], [N m]
    character(len=:), allocatable, intent(out) :: reason !! why there is none
    integer :: i

    do i = 1, size(bearing)
      call solve_held(bearing(i), machine%journal(i), allowed, again, tangent(i), reason)
      if (reason /= '') then
        reason = 'bearing '//text(i)//': '//reason
        return
      end if
    end do
    call sum_forces(machine, bearing, force)
  end subroutine find_forces

  !> Forces of all films on the held motions, at their present states.
  subroutine sum_forces(machine, bearing, force)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(in) :: bearing(:)
    real(wp), intent(out) :: force(:) !! [N], [N m]
    real(wp) :: own(film_forces)
    integer :: i

    force = 0.0_wp
    do i = 1, size(bearing)
      own = journal_force(bearing(i)%bearing)
      associate (journal => machine%journal(i))
        force(journal%at) = force(journal%at) + journal%sign*own(journal%coordinate)
      end associate
    end do
  end subroutine sum_forces

  !> How far the shaft, moved by forces of the films, is from where the journals are held.
  subroutine see_imbalance(machine, march, free, here, force, left, off)
    type(machine_type), intent(in) :: machine
    type(machine_march_type), intent(in) :: march !! with the shaft's step
    real(wp), intent(in) :: free(:)  !! all motions without films [m], [1]
    real(wp), intent(in) :: here(:)  !! held motions [m], [rad]
    real(wp), intent(in) :: force(:) !! of the films on these [N], [N m]
    real(wp), intent(out) :: left(:) !! way from there [m], [rad]
    real(wp), intent(out) :: off     !! its largest part, over the clearance [1]

    left = free(machine%held) + matmul(march%shaft%flexibility, force) - here
    off = maxval(abs(left)/march%size_of)
  end subroutine see_imbalance

  !> Moves the journals to where the shaft comes to if films follow their tangents, and films and foils along these.
  subroutine follow_shaft(machine, march, left, here, place, bearing, regular)
    type(machine_type), intent(in) :: machine
    type(machine_march_type), intent(in) :: march !! with the tangents of its bearings
    real(wp), intent(in) :: left(:)        !! way of the shaft from the held motions by the films' forces there [m], [rad]
    real(wp), intent(inout) :: here(:)     !! held motions [m], [rad]
    real(wp), intent(inout) :: place(:, :) !! (coordinates, bearing) of the sleeves [m], [rad]
    type(machine_bearing_type), intent(inout) :: bearing(:) !! get their states
    logical, intent(out) :: regular !! else all is as it was
    real(wp) :: change(size(here))
    integer :: i

    change = left
    call solve_general(coupled_matrix(machine, march), change, regular)
    if (.not. regular) return
    here = here + change
    do i = 1, size(bearing)
      call move_sleeve(machine%journal(i), here, change, march%tangent(i), bearing(i)%bearing)
      place(:, i) = bearing(i)%bearing%point%place
    end do
  end subroutine follow_shaft

  !> I + Phi Z.
  pure function coupled_matrix(machine, march) result(matrix)
    type(machine_type), intent(in) :: machine
    type(machine_march_type), intent(in) :: march !! with the tangents of its bearings
    real(wp) :: matrix(size(machine%held), size(machine%held)), stiffness(size(machine%held), size(machine%held))
    integer :: i

    stiffness = 0.0_wp
    do i = 1, size(machine%journal)
      associate (at => machine%journal(i)%at, sign => machine%journal(i)%sign, own => march%tangent(i)%stiffness)
        stiffness(at, at) = stiffness(at, at) + own*spread(sign, 1, size(at))*spread(sign, 2, size(at))
      end associate
    end do
    matrix = matmul(march%shaft%flexibility, stiffness)
    do i = 1, size(machine%held)
      matrix(i, i) = matrix(i, i) + 1.0_wp
    end do
  end function coupled_matrix

  !> A bearing's step, its journal held; and its tangent where its factors are new.
  subroutine solve_held(one, journal, allowed, again, tangent, reason)
    type(machine_bearing_type), intent(inout) :: one !! prepared for a step
    type(journal_type), intent(in) :: journal !! in it
    real(wp), intent(in) :: allowed !! last step of its Newton method, relative [1]
    logical, intent(in) :: again !! it was solved beside this place before
    type(tangent_type), intent(inout) :: tangent
    character(len=:), allocatable, intent(out) :: reason !! why there is no answer
    type(newton_report_type) :: report
    type(newton_settings_type) :: settings

    reason = ''
    settings = one%newton%settings
    one%newton%settings%on_the_way = .true.
    one%newton%settings%step_tolerance = max(allowed, settings%step_tolerance)
    one%newton%settings%residual_tolerance = max(allowed, settings%residual_tolerance)
    call solve_nearby(one%newton, report, again)
    one%newton%settings = settings
    if (.not. report%converged) then
      reason = report%reason
    else if (tangent%factors /= one%newton%factorizations .and. has_factors(one%newton)) then
      call find_tangent(one, journal, tangent)
      tangent%factors = one%newton%factorizations
    end if
  end subroutine solve_held

  !> Changes of the state by unit motions of the sleeve, by the factors at hand, and of the force along them.
  subroutine find_tangent(one, journal, tangent)
    type(machine_bearing_type), intent(inout) :: one !! at a state of the step; left there
    type(journal_type), intent(in) :: journal !! in it
    type(tangent_type), intent(inout) :: tangent
    real(wp) :: before(film_forces), gained(film_forces), place(film_forces)
    Vec :: column, state
    PetscErrorCode :: ierr
    integer :: k

    before = journal_force(one%bearing)
    place = one%bearing%point%place
    PetscCallA(VecDuplicate(one%bearing%state, column, ierr))
    PetscCallA(VecDuplicate(one%bearing%state, state, ierr))
    PetscCallA(VecCopy(one%bearing%state, state, ierr))
    do k = 1, size(journal%coordinate)
      associate (along => journal%coordinate(k), length => tangent%length(k))
        call one%bearing%shaft_column(along, column)
        call keep_entries(column, tangent%kept)
        call solve_with_factors(one%newton, column, tangent%way(k))
        PetscCallA(VecScale(tangent%way(k), -1.0_wp, ierr))
        call keep_entries(tangent%way(k), tangent%kept)
        PetscCallA(VecAXPY(one%bearing%state, length, tangent%way(k), ierr))
        one%bearing%point%place(along) = place(along) + length
        gained = journal_force(one%bearing) - before
        tangent%stiffness(:, k) = gained(journal%coordinate)/length ! the sleeve moves by e = o - a
        one%bearing%point%place = place
        PetscCallA(VecCopy(state, one%bearing%state, ierr))
      end associate
    end do
    PetscCallA(VecDestroy(column, ierr))
    PetscCallA(VecDestroy(state, ierr))
  end subroutine find_tangent

  !> Moves a sleeve to where the held motions put it, and film and foil along their tangent, where the film stays open.
  subroutine move_sleeve(journal, motion, change, tangent, bearing)
    type(journal_type), intent(in) :: journal
    real(wp), intent(in) :: motion(:) !! a, of the machine [m], [rad]
    real(wp), intent(in) :: change(:) !! that led to it [m], [rad]
    type(tangent_type), intent(in) :: tangent
    type(bearing_system_type), intent(inout) :: bearing
    real(wp) :: unknown(bearing%local_size()), before(bearing%local_size())
    logical :: open
    PetscErrorCode :: ierr
    integer :: k

    call bearing%get_unknowns(before)
    bearing%point%place(journal%coordinate) = place_of_sleeve(journal, motion)
    if (tangent%factors >= 0) then
      do k = 1, size(journal%coordinate)
        PetscCallA(VecAXPY(bearing%state, -journal%sign(k)*change(journal%at(k)), tangent%way(k), ierr))
      end do
    end if
    call bearing%get_unknowns(unknown)
    unknown(bearing%first_shaft + 1:) = bearing%point%place(bearing%coordinate)
    open = bearing%is_open_at(unknown)
    if (open) call bearing%set_unknowns(unknown)
    if (.not. open) call bearing%set_unknowns(before)
  end subroutine move_sleeve

  !> Saves or restores a march: the shaft's motions, rates and what films do to it. The past of each film is `visit_past`'s.
  pure subroutine visit_machine_march(archive, march)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(machine_march_type), intent(inout) :: march !! that has begun anew where the archive restores

    call archive%visit('motion', march%motion)
    call archive%visit('rate', march%rate)
    call archive%visit('force', march%force)
    call archive%visit('first_motion', march%first_motion)
    call archive%visit('usual', march%usual)
    call archive%visit('solves', march%solves)
  end subroutine visit_machine_march

  !> Goes on from what was read, which is judged.
  subroutine resume_machine_march(machine, bearing, march, what)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:) !! at the newest states
    type(machine_march_type), intent(inout) :: march !! begun anew, then filled from the file
    character(len=:), allocatable, intent(out) :: what !! does not fit, in words; empty where all does
    real(wp) :: rate(size(march%rate, 1)), off
    integer :: i

    what = ''
    associate (clock => march%film(1))
      do i = 1, size(bearing)
        if (abs(march%film(i)%time - clock%time) > 0.0_wp .or. march%film(i)%steps /= clock%steps) what = 'times that differ'
        if (what == '') call find_misfit(bearing(i)%bearing, march%film(i), what)
        if (what /= '') return
      end do
      rate = newest_rate(difference_weights(clock%past_step(1), clock%past_step(2)), march%motion(:, 1), march%motion(:, 2:))
      off = maxval(abs(rate - march%rate(:, 1)))
      if (off > sqrt(epsilon(off))*maxval(abs(march%motion))/clock%past_step(1)) what = 'the rates of the shaft'
    end associate
    do i = 1, size(bearing)
      associate (journal => machine%journal(i))
        if (any(abs(place_of_sleeve(journal, march%motion(machine%held, 1)) - march%film(i)%place(journal%coordinate, 1)) > &
                nearby*march%size_of(journal%at))) what = 'where the journals are'
      end associate
    end do
    if (what /= '') return
    do i = 1, size(bearing)
      call rebuild_past(bearing(i)%bearing, march%film(i))
    end do
  end subroutine resume_machine_march

  !> Tangents are made anew with the next factors, as a march that is resumed makes them.
  pure subroutine forget_tangents(march)
    type(machine_march_type), intent(inout) :: march
    march%tangent%factors = -1
  end subroutine forget_tangents

  !> The bearings' equations become those of a steady state again.
  subroutine end_machine_march(march, bearing)
    type(machine_march_type), intent(inout) :: march !! its numbers stay
    type(machine_bearing_type), intent(inout) :: bearing(:) !! at the last states
    PetscErrorCode :: ierr
    integer :: i, k

    do i = 1, size(bearing)
      call end_march(march%film(i), bearing(i)%bearing)
      do k = 1, size(march%tangent(i)%way)
        PetscCallA(VecDestroy(march%tangent(i)%way(k), ierr))
      end do
    end do
  end subroutine end_machine_march
end module gfb_machine_march
