#include "gfb_petsc.h"
!> A bearing and its shaft over time: film, foil and shaft in one implicit step.
!>
!> A step is the bearing's balance with three more terms, each a difference of second order over the
!> present step and the one before (`gfb_backward_difference`): the gas that the film stores, dampers,
!> losses and mass of the foil (`gfb_foil_momentum`), and the shaft's inertia, \( m \ddot{\mathbf e} = \mathbf F - \mathbf f \), with the
!> force F on the sleeve and the outer one f on the shaft. A rotor on two bearings tilts, too:
!> \( I \ddot\phi + \mathbf G \dot\phi = -\mathbf M - \boldsymbol\tau \), with the torques M of the films and
!> tau from outside on the rotor, about its centre of mass.
!>
!> PETSc's TS differentiates unknowns; here the product r h is differenced as a whole, which keeps the
!> gas to round-off.
module gfb_time_march
  use petscmat
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_natural_order, only: natural_order_type, visit_vector
  use gfb_backward_difference, only: difference_weights, free_value, newest_rate, extrapolation_weights, next_step, kept_times
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_film_load, only: film_forces, acts_on
  use gfb_march_state, only: march_type, march_settings_type, pad_history_type, allowed_step, first_step, usual_step, &
                             place_ahead, error_of, visit_march
  use gfb_operating_point, only: operating_point_type
  use gfb_contacts_in_motion, only: set_contacts_moving, take_over_friction
  use gfb_bearing_system, only: bearing_system_type, bearing_order
  use gfb_bearing_motion, only: begin_dampers, prepare_step, end_step, recall_step, visit_motion, end_motion
  use gfb_feed_block, only: begin_feed
  use gfb_film_rates, only: fill_springs
  use gfb_newton, only: newton_type, newton_report_type, newton_settings_type, solve_nearby
  implicit none (type)
  private
  public :: begin_rubbing, march_type, march_settings_type, begin_march, resume_march, rebuild_past, take_step, end_march, visit_past, find_misfit
  public :: prepare_step_of, prepare_difference, predict_step, accept_step, keep_step, drive_at, place_of, look_at_pad, tolerance_of_step

  real(wp), parameter :: rejected = 2.0_wp !! error over the largest one that is not accepted [1]
  integer, parameter :: most_trials = 12 !! of one step
  real(wp), parameter :: coarsest = 1.0e-5_wp !! to what a step is solved at most, relative [1]
  real(wp), parameter :: unit(2, 2) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])

contains

  !> Friction of foils that begin to move: all contacts rub as motions have it from now on; what they rub with stays as it is.
  subroutine begin_rubbing(bearing, continues)
    type(bearing_system_type), intent(inout) :: bearing !! at rest, or where a restart file has left it
    logical, intent(in) :: continues !! its contacts remember what they did in motion
    real(wp) :: unknown(bearing%local_size())
    integer :: i

    if (.not. bearing%is_meshed()) return
    call bearing%get_unknowns(unknown)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call set_contacts_moving(pad%foil%contacts)
        if (continues) cycle
        call take_over_friction(pad%foil%own_part(unknown(pad%first + 1:pad%last)), pad%foil%contacts)
      end associate
    end do
  end subroutine begin_rubbing

  !> Begins at rest: the present state has been there before.
  subroutine begin_march(drive, settings, bearing, march)
    type(shaft_drive_type), intent(in) :: drive !! what drives the shaft
    type(march_settings_type), intent(in) :: settings !! how steps are chosen
    type(bearing_system_type), intent(inout) :: bearing !! at a steady state; its equations get the foils' losses
    type(march_type), intent(out) :: march !! ready for `take_step`
    PetscErrorCode :: ierr
    integer :: i

    march%drive = drive
    march%settings = settings
    do i = 1, kept_times
      PetscCallA(VecDuplicate(bearing%state, march%state(i), ierr))
      PetscCallA(VecCopy(bearing%state, march%state(i), ierr))
    end do
    march%start = bearing%point
    if (bearing%shaft_fixed) march%start%place(:2) = bearing%eccentricity()
    march%next = first_step(march)
    march%past_step = march%next
    march%first_place = place_of(bearing)
    march%place = spread(march%first_place, 2, kept_times)
    allocate (march%unknown(bearing%local_size(), kept_times), march%pad(size(bearing%pad)))
    call bearing%get_unknowns(march%unknown(:, 1))
    march%unknown(:, 2:) = spread(march%unknown(:, 1), 2, kept_times - 1)
    call begin_feed(march%unknown(:, 1), bearing)
    if (settings%damps()) call begin_dampers(settings%damping, settings%arm, march%unknown(:, 1), bearing)
    do i = 1, size(bearing%pad)
      call look_at_pad(bearing, i, march%unknown(:, 1), march%pad(i))
      call look_at_pad(bearing, i, march%unknown(:, 1), march%pad(i))
    end do
    if (bearing%floats .and. .not. bearing%shaft_fixed) call begin_falling(bearing, march)
    if (settings%loss_time > 0.0_wp) call begin_losses(settings%loss_time, bearing)
  end subroutine begin_march

  !> From now on meshed foils lose what goes with the rate of their elastic forces.
  subroutine begin_losses(time, bearing)
    real(wp), intent(in) :: time !! of the losses over the stiffness [s]
    type(bearing_system_type), intent(inout) :: bearing !! with its matrix
    Mat :: stiffness
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(bearing%jacobian, MAT_DO_NOT_COPY_VALUES, stiffness, ierr))
    call fill_springs(bearing, stiffness)
    call bearing%losses%begin(time, stiffness, bearing%state)
  end subroutine begin_losses

  !> Begins with a given past instead, in equal steps.
  subroutine resume_march(unknown, place, velocity, bearing, march)
    real(wp), intent(in) :: unknown(:, :) !! (local unknowns, 2) now and one step ago [SI]
    real(wp), intent(in) :: place(:, :)   !! (coordinates, 2) of the sleeve, as many as move [m], [rad]
    real(wp), intent(in) :: velocity(:, :) !! (coordinates, 2) of it [m/s], [rad/s]
    type(bearing_system_type), intent(inout) :: bearing !! gets the newest state
    type(march_type), intent(inout) :: march !! that has begun; gets the past
    real(wp) :: weight(0:2)
    PetscErrorCode :: ierr

    call bearing%set_unknowns(2.0_wp*unknown(:, 2) - unknown(:, 1)) ! the first step is predicted along a line
    PetscCallA(VecCopy(bearing%state, march%state(3), ierr))
    call bearing%set_unknowns(unknown(:, 2))
    PetscCallA(VecCopy(bearing%state, march%state(2), ierr))
    call bearing%set_unknowns(unknown(:, 1))
    march%velocity(:size(velocity, 1), :) = velocity
    march%place(:size(place, 1), :2) = place
    weight = difference_weights(march%next, march%next)
    march%place(:, 3) = march%place(:, 2) &
      + (march%velocity(:, 1) - weight(0)*(march%place(:, 1) - march%place(:, 2)))/weight(2)
    call rebuild_past(bearing, march)
  end subroutine resume_march

  !> A load that is there at once moves a free shaft from the first moment on: its past is the parabola of that
  !> acceleration a, \( \mathbf v(-\Delta) = -\mathbf a \Delta \), and of that of its tilts. With a past at rest it would start
  !> late by half a step, of order 1.
  subroutine begin_falling(bearing, march)
    type(bearing_system_type), intent(in) :: bearing !! at rest
    type(march_type), intent(inout) :: march !! with its first step; gets the past
    real(wp) :: force(film_forces), acceleration(film_forces)
    integer :: i

    force = acts_on*bearing%reaction()
    acceleration = 0.0_wp
    acceleration(:2) = (force(:2) - march%drive%load_at(0.0_wp))/march%drive%mass
    if (tilts(bearing)) acceleration(4:) = (force(4:) - march%drive%torque_at(0.0_wp))/march%drive%transverse_inertia
    do i = 2, kept_times
      march%place(:, i) = march%first_place + 0.5_wp*acceleration*((i - 1)*march%next)**2
    end do
    march%velocity(:, 2) = -acceleration*march%next
  end subroutine begin_falling

  !> Saves or restores a march: numbers, the last two states before the newest, rates of masses, what springs remember.
  subroutine visit_past(archive, bearing, march)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state, with the mass it had
    type(march_type), intent(inout) :: march !! that has begun anew where the archive restores
    type(natural_order_type) :: order

    march%stages%ready = .false. ! rates of stages are found again, here and from the file
    march%stages%known = 0
    order = bearing_order(bearing)
    call visit_march(archive, march)
    call visit_vector(archive, 'before', order, march%state(2))
    call visit_vector(archive, 'before_that', order, march%state(3))
    call visit_motion(archive, bearing, order)
  end subroutine visit_past

  !> What in a march that was read does not fit itself or its states: times and steps, the way of the sleeve, films that are open.
  subroutine find_misfit(bearing, march, what)
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    type(march_type), intent(in) :: march !! begun anew, then filled from the file
    character(len=:), allocatable, intent(out) :: what !! in words; empty where all does
    real(wp) :: unknown(bearing%local_size()), place(film_forces), velocity(film_forces), weight(0:2), rounding
    type(operating_point_type) :: here
    logical :: open
    integer :: i

    what = ''
    rounding = sqrt(epsilon(rounding)) ! relative
    associate (step => march%past_step)
      if (.not. (march%time > 0.0_wp .and. march%time < march%settings%end_time .and. march%steps > 0)) then
        what = 'its time'
      else if (.not. (all(step > 0.0_wp) .and. march%next > 0.0_wp .and. march%step <= march%time*(1.0_wp + rounding)) .or. &
               max(maxval(step), march%next) > march%settings%end_time .or. abs(march%step - step(1)) > 0.0_wp .or. &
               march%rejections < 0) then
        what = 'its steps'
      end if
      if (what /= '') return
      weight = difference_weights(step(1), step(2))
      velocity = newest_rate(weight, march%place(:, 1), march%place(:, 2:))
      if (march%settings%by_stages) velocity = march%velocity(:, 1) ! has no such difference
      place = rounding*weight(0)*maxval(abs(march%place), 2)
      if (any(abs(velocity - march%velocity(:, 1)) > place)) what = 'the rates of the sleeve'
    end associate
    do i = 1, kept_times
      if (i == 1) call bearing%get_unknowns(unknown)
      if (i > 1) call bearing%get_unknowns(unknown, march%state(i))
      if (bearing%shaft_fixed .or. .not. bearing%floats) bearing%point%place = march%place(:, i)
      here = bearing%position(unknown)
      if (i <= march%steps + 1 .and. any(abs(here%place - march%place(:, i)) > rounding*maxval(abs(march%place)))) then
        what = 'where the sleeve was' ! before its first step there was none
      end if
      open = bearing%is_open_at(unknown)
      if (.not. open) what = 'a film that is not open'
    end do
    if (bearing%shaft_fixed .or. .not. bearing%floats) bearing%point%place = march%place(:, 1)
  end subroutine find_misfit

  !> Goes on from a restart file, which has left the bearing at the newest state, and the march with all but what follows
  !> from its last two states.
  subroutine rebuild_past(bearing, march)
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    type(march_type), intent(inout) :: march !! begun anew, then filled from the file
    integer :: i, step
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(bearing%state, march%state(1), ierr))
    call bearing%get_unknowns(march%unknown(:, 1))
    do step = 2, kept_times
      call bearing%get_unknowns(march%unknown(:, step), march%state(step))
    end do
    do step = 2, 1, -1
      if (bearing%shaft_fixed .or. .not. bearing%floats) bearing%point%place = march%place(:, step)
      call recall_step(bearing, step, march%unknown(:, step))
      do i = 1, size(bearing%pad)
        call look_at_pad(bearing, i, march%unknown(:, step), march%pad(i))
      end do
    end do
  end subroutine rebuild_past

  !> The gas of a pad at the present state becomes the newest one.
  subroutine look_at_pad(bearing, i, unknown, history)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: i !! of the pad
    real(wp), intent(in) :: unknown(:) !! of the bearing [SI]
    type(pad_history_type), intent(inout) :: history
    real(wp) :: gap(bearing%film_nodes())

    gap = bearing%gap(unknown)
    associate (pad => bearing%pad(i), film => bearing%pad(i)%film, nodes => bearing%pad(i)%last_node - bearing%pad(i)%first_node)
      if (.not. allocated(history%stored)) then
        allocate (history%stored(size(film%shape, 2), size(film%element_nodes, 2), 2), source=0.0_wp)
      end if
      history%stored(:, :, 2) = history%stored(:, :, 1)
      history%stored(:, :, 1) = film%stored(unknown(pad%first + 1:pad%first + nodes), gap(pad%first_node + 1:pad%last_node), &
                                            bearing%position(unknown))
    end associate
  end subroutine look_at_pad

  !> One step; shorter where it does not converge or is too inaccurate.
  !>
  !> Where even a short one has no answer the report says so, and the bearing is where it was.
  subroutine take_step(march, bearing, newton, report)
    type(march_type), intent(inout) :: march !! its past and its next step
    type(bearing_system_type), target, intent(inout) :: bearing !! at the newest state
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(newton_report_type), intent(out) :: report !! of the last trial
    type(newton_settings_type) :: settings
    real(wp) :: step, error, place(film_forces)
    integer :: trial

    step = allowed_step(march)
    settings = newton%settings
    do trial = 1, most_trials
      call prepare_step_of(march, step, bearing)
      call predict_step(march, step, bearing)
      newton%settings%step_tolerance = tolerance_of_step(march, settings%step_tolerance, bearing%clearance)
      newton%settings%residual_tolerance = max(settings%residual_tolerance, newton%settings%step_tolerance)
      newton%settings%on_the_way = newton%settings%step_tolerance > settings%step_tolerance ! its part of the error is small already
      call solve_nearby(newton, report)
      newton%settings = settings
      if (report%converged) then
        place = place_of(bearing)
        march%error = error_of(march, step, place)
        error = march%error/(march%settings%tolerance*bearing%clearance)
        if (march%settings%steps_per_turn > 0.0_wp .or. error < rejected) exit
        step = next_step(step, error)
      else
        step = 0.5_wp*step
      end if
      march%rejections = march%rejections + 1
      call bearing%return_to(march%state(1))
    end do
    if (report%converged .and. trial > most_trials) then
      report%converged = .false.
      report%reason = 'the error of a step stays too large'
    end if
    if (report%converged) then
      call accept_step(march, step, place, bearing)
      march%next = next_step(step, error)
      if (march%settings%steps_per_turn > 0.0_wp) march%next = usual_step(march)
    else
      call drive_at(march, march%time, bearing)
    end if
  end subroutine take_step

  !> To what a step is solved: a part of what the step before was off by its length, which its error adds to that of the march. What
  !> is not off, such as rest, is solved to the last digits.
  pure real(wp) function tolerance_of_step(march, fine, clearance) result(tolerance)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: fine !! to the last digits [1]
    real(wp), intent(in) :: clearance !! [m]

    tolerance = max(fine, min(coarsest, march%settings%unsolved*march%error/clearance))
  end function tolerance_of_step

  !> The state becomes the newest of the past; friction carries its slip along.
  subroutine accept_step(march, step, place, bearing)
    type(march_type), intent(inout) :: march !! its past
    real(wp), intent(in) :: step !! that led to it [s]
    real(wp), intent(in) :: place(:) !! of the sleeve and its tilt [m], [rad]
    type(bearing_system_type), intent(inout) :: bearing !! at the state
    real(wp) :: velocity(film_forces), weight(0:2)
    integer :: i

    weight = difference_weights(step, march%past_step(1))
    velocity = newest_rate(weight, place, march%place)
    march%velocity(:, 2) = march%velocity(:, 1)
    march%velocity(:, 1) = velocity
    march%place(:, 2:) = march%place(:, :kept_times - 1)
    march%place(:, 1) = place
    call end_step(bearing, weight, march%state(1), march%state(2))
    call keep_step(march, step, bearing)
    do i = 1, size(bearing%pad)
      call look_at_pad(bearing, i, march%unknown(:, 1), march%pad(i))
    end do
    if (bearing%is_meshed()) call bearing%commit()
  end subroutine accept_step

  !> Time goes on by a step, and the bearing's state becomes the newest that is kept.
  subroutine keep_step(march, step, bearing)
    type(march_type), intent(inout) :: march !! its past
    real(wp), intent(in) :: step !! that led to the state [s]
    type(bearing_system_type), intent(in) :: bearing !! at it
    integer :: i
    PetscErrorCode :: ierr

    march%past_step(2:) = march%past_step(:kept_times - 1)
    march%past_step(1) = step
    march%time = march%time + step
    if (abs(march%settings%end_time - march%time) < 1.0e-9_wp*step) march%time = march%settings%end_time
    march%step = step
    march%steps = march%steps + 1
    march%unknown(:, 2:) = march%unknown(:, :kept_times - 1)
    call bearing%get_unknowns(march%unknown(:, 1))
    do i = kept_times, 2, -1
      PetscCallA(VecCopy(march%state(i - 1), march%state(i), ierr))
    end do
    PetscCallA(VecCopy(bearing%state, march%state(1), ierr))
  end subroutine keep_step

  !> Puts what a step adds into the bearing's equations.
  subroutine prepare_step_of(march, step, bearing, held_at)
    type(march_type), intent(inout) :: march !! its past
    real(wp), intent(in) :: step !! [s]
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    !> where the sleeve is at the end of the step and how it is tilted, of a shaft that is moved from outside; else its drive
    !> has an orbit [m], [rad]
    real(wp), intent(in), optional :: held_at(film_forces)

    call prepare_difference(march, march%time + step, difference_weights(step, march%past_step(1)), march%state(1), march%state(2), &
                            bearing, held_at)
  end subroutine prepare_step_of

  !> The same of any difference over what the march, the bearing and two states have of the past.
  subroutine prepare_difference(march, time, weight, now, before, bearing, held_at)
    type(march_type), intent(inout) :: march !! its past
    real(wp), intent(in) :: time !! of the new state [s]
    real(wp), intent(in) :: weight(0:2) !! a_0, a_1, a_2 of `gfb_backward_difference` [1/s]
    Vec, intent(in) :: now, before !! scaled states of the past
    type(bearing_system_type), intent(inout) :: bearing !! gets the equations
    real(wp), intent(in), optional :: held_at(film_forces) !! as in `prepare_step_of` [m], [rad]
    real(wp) :: place(film_forces)
    integer :: i

    call drive_at(march, time, bearing)
    if (bearing%floats .and. .not. bearing%shaft_fixed) then
      bearing%point%inertia(1, 1) = march%drive%mass*weight(0)**2
      bearing%point%inertia(2, 2) = bearing%point%inertia(1, 1)
      place = free_place(march, weight)
      bearing%point%place(:2) = place(:2)
      if (tilts(bearing)) then
        bearing%point%inertia(4:, 4:) = march%drive%transverse_inertia*weight(0)**2*unit + weight(0)*gyration(march, time)
        bearing%point%place(4:5) = free_tilt(march, weight, gyration(march, time), place(4:))
      end if
    else if (present(held_at)) then
      bearing%point%place = held_at
    else
      bearing%point%place(:2) = march%start%place(:2) + march%drive%orbit_at(time)
    end if
    call prepare_step(bearing, weight, now, before)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), past => march%pad(i))
        pad%film%storage = weight(0)
        pad%film%past = weight(1)*past%stored(:, :, 1) + weight(2)*past%stored(:, :, 2)
      end associate
    end do
  end subroutine prepare_difference

  !> Where the sleeve would be after a step without any force: the acceleration is a_0^2 times the way from there.
  pure function free_place(march, weight) result(place)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: weight(0:2) !! of the step [1/s]
    real(wp) :: place(film_forces)
    place = free_value(weight, march%place, march%velocity)
  end function free_place

  !> The same of the tilts with the gyroscopic torque, which follows the rates of both: where
  !>
  !> $$ I a_0^2 (\phi - \hat\phi) + \mathbf G \dot\phi = 0, \quad \dot\phi = a_0 \phi + a_1 \phi_1 + a_2 \phi_2 $$
  pure function free_tilt(march, weight, gyration, without) result(tilt)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: weight(0:2) !! of the step [1/s]
    real(wp), intent(in) :: gyration(2, 2) !! G [N m s]
    real(wp), intent(in) :: without(2) !! without that torque [rad]
    real(wp) :: tilt(2), rest(2)

    associate (inertia => march%drive%transverse_inertia*weight(0)**2, now => march%place(4:, 1), before => march%place(4:, 2))
      rest = inertia*(without - now) - weight(2)*matmul(gyration, before - now)
      ! The matrix is [a, b; -b, a].
      associate (b => weight(0)*gyration(1, 2))
        tilt = now + [inertia*rest(1) - b*rest(2), b*rest(1) + inertia*rest(2)]/(inertia**2 + b**2)
      end associate
    end associate
  end function free_tilt

  !> Torque over the rates of both tilts: the rotor's spin is kept by a drive along its own axis. See `gfb_rotor`.
  pure function gyration(march, time) result(matrix)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: time !! [s]
    real(wp) :: matrix(2, 2)     !! [N m s]
    matrix = march%drive%polar_inertia*march%drive%speed_at(time)*reshape([0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp], [2, 2])
  end function gyration

  !> Speed and outer forces of a time become the bearing's.
  subroutine drive_at(march, time, bearing)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: time !! [s]
    type(bearing_system_type), intent(inout) :: bearing

    bearing%point%speed = march%drive%speed_at(time)
    bearing%point%load(:2) = march%drive%load_at(time)
    if (tilts(bearing)) bearing%point%load(4:5) = march%drive%torque_at(time)
  end subroutine drive_at

  !> Whether tilts are unknowns.
  pure logical function tilts(bearing)
    type(bearing_system_type), intent(in) :: bearing
    tilts = size(bearing%coordinate) > 2
  end function tilts

  !> Where the sleeve is at the present state, and its tilt [m], [rad].
  function place_of(bearing) result(place)
    type(bearing_system_type), intent(in) :: bearing
    real(wp) :: place(film_forces), unknown(bearing%local_size())
    type(operating_point_type) :: here

    call bearing%get_unknowns(unknown)
    here = bearing%position(unknown)
    place = here%place
  end function place_of

  !> Begins Newton's method ahead of the newest state, where the film is open there.
  subroutine predict_step(march, step, bearing)
    type(march_type), intent(in) :: march !! its past
    real(wp), intent(in) :: step !! [s]
    type(bearing_system_type), intent(inout) :: bearing !! prepared for the step; gets the state
    real(wp) :: ahead(size(march%unknown, 1)), place(film_forces)
    logical :: open
    integer :: i

    ahead = matmul(march%unknown, extrapolation_weights([step, march%past_step(:2)]))
    do i = 1, size(bearing%pad)
      associate (first => bearing%pad(i)%first + bearing%pad(i)%foil%first + 1, last => bearing%pad(i)%last)
        ahead(first:last) = march%unknown(first:last, 1) + step/march%past_step(1)*(march%unknown(first:last, 1) - march%unknown(first:last, 2))
      end associate
    end do
    if (bearing%floats .and. .not. bearing%shaft_fixed) then
      place = place_ahead(march, step)
      ahead(bearing%first_shaft + 1:) = place(bearing%coordinate)
    end if
    open = bearing%is_open_at(ahead)
    if (open) then
      call bearing%set_unknowns(ahead)
    else
      call bearing%set_unknowns(march%unknown(:, 1))
    end if
  end subroutine predict_step

  !> The bearing's equations become those of a steady state again.
  subroutine end_march(march, bearing)
    type(march_type), intent(inout) :: march !! its numbers stay
    type(bearing_system_type), intent(inout) :: bearing !! at the last state
    integer :: i
    PetscErrorCode :: ierr

    do i = 1, kept_times
      PetscCallA(VecDestroy(march%state(i), ierr))
    end do
    call end_motion(bearing)
    bearing%point%inertia = 0.0_wp
    if (bearing%floats) bearing%point%place = place_of(bearing)
    do i = 1, size(bearing%pad)
      if (allocated(bearing%pad(i)%film%past)) deallocate (bearing%pad(i)%film%past)
    end do
  end subroutine end_march
end module gfb_time_march
