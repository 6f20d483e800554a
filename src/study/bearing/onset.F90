#include "gfb_petsc.h"
!> The speed at which a rotor begins to whirl, between two points of a sweep over the speed; and whether it would at the
!> point from which it is followed over time.
module gfb_onset
  use gfb_kinds, only: wp
  use gfb_units, only: rpm
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type, place_of, number_in
  use gfb_result_table, only: at_begin_of_time
  use gfb_result_names, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_speed
  use gfb_root_bracket, only: root_bracket_type
  use gfb_operation_case, only: angular_speed
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_operating_point, only: operating_point_type
  use gfb_last_answer, only: last_answer_type
  use gfb_bearing_solution, only: bearing_solution_type
  use gfb_whirl, only: whirl_type
  use gfb_dynamics, only: find_instability, mass_excess, find_whirl
  implicit none (type, external)
  private
  public :: look_for_onset, may_look_for_onset, judge_first_point

  real(wp), parameter :: tolerance = 1.0e-7_wp !! of the speed, relative [1]
  integer, parameter :: most_trials = 20       !! of equilibria between the points
  integer, parameter :: digits = 4             !! in the log

contains

  !> Whether the sweep may still come to an onset, which is then looked for.
  pure logical function may_look_for_onset(solution) result(may)
    type(bearing_solution_type), intent(in) :: solution !! at a point of the sweep

    associate (scene => solution%scene)
      may = scene%sweep%parameter == sweep_speed .and. scene%rotor%present .and. .not. scene%bearing%row%moves_along
      may = may .and. .not. solution%record%dynamics%onset > 0.0_wp
    end associate
  end function may_look_for_onset

  !> Finds the speed where the growth of the rotor's least damped mode changes its sign, where it does so
  !> between the last two rows of the history; with a loss factor, which has no growth, where the critical mass passes
  !> the rotor's. The bearing comes back to its present answer.
  !>
  !> Every trial has an equilibrium of its own, on the path from the present answer.
  subroutine look_for_onset(solution)
    type(bearing_solution_type), intent(inout) :: solution !! at the last point's answer; its record gets the onset
    type(last_answer_type) :: kept
    type(root_bracket_type) :: bracket
    real(wp) :: speed(2), excess(2)
    character(len=:), allocatable :: problem
    logical :: known(2)

    associate (scene => solution%scene, bearing => solution%bearing, newton => solution%newton, &
               history => solution%record%history, onset => solution%record%dynamics%onset)
      if (.not. may_look_for_onset(solution) .or. size(history) < 2) return
      associate (before => history(size(history) - 1)%quantity, last => history(size(history))%quantity)
        speed = [number_in(before, 'speed_rpm'), number_in(last, 'speed_rpm')]
        call look_up_excess(scene, before, excess(1), known(1))
        call look_up_excess(scene, last, excess(2), known(2))
      end associate
      if (.not. all(known) .or. excess(1)*excess(2) > 0.0_wp) return
      bracket = root_bracket_type(speed(1), speed(2), excess(1), excess(2))
      call kept%save(bearing, newton)
      call close_in(scene, solution%path, bearing, newton, bracket, problem)
      call kept%restore(bearing, newton)
      call bearing%linearise(bearing%state)
      call kept%destroy()
      if (.not. allocated(problem)) onset = bracket%high
      call show_onset(scene, solution%context%log, bracket, excess(1) > 0.0_wp, problem)
    end associate
  end subroutine look_for_onset

  !> What is positive where the rotor is unstable, of a point of the sweep.
  pure subroutine look_up_excess(scene, row, excess, known)
    type(scene_type), intent(in) :: scene
    type(quantity_type), intent(in) :: row(:)
    real(wp), intent(out) :: excess !! [1/s], with a loss factor [1]
    logical, intent(out) :: known

    if (scene%dynamics%loss_factor > 0.0_wp) then
      known = .true. ! no mass whirls where there is none
      excess = mass_excess(scene%rotor%mass, number_in(row, 'critical_mass'), place_of('critical_mass', row) > 0)
    else
      known = place_of('growth_rate', row) > 0
      excess = number_in(row, 'growth_rate')
    end if
  end subroutine look_up_excess

  !> Says where the onset is, and by what it was found.
  subroutine show_onset(scene, log, bracket, calms, problem)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(root_bracket_type), intent(in) :: bracket !! around it [rpm]
    logical, intent(in) :: calms !! from growth to decay
    character(len=:), allocatable, intent(in) :: problem !! why it is not closer
    character(len=:), allocatable :: what

    if (scene%dynamics%loss_factor > 0.0_wp) then
      what = 'the critical mass passes the rotor''s '//text(scene%rotor%mass)//' kg (whirl in x and y; a loss factor has no '// &
             'growth rates), from '//trim(merge('whirl to none', 'none to whirl', calms))
    else
      what = 'the rotor''s least damped mode changes from '//trim(merge('growth to decay', 'decay to growth', calms))
    end if
    if (.not. allocated(problem)) then
      call log%line('onset: '//what//' at '//text(bracket%high, 8)//' rpm')
    else
      call log%line('onset: '//what//' between '//text(min(bracket%low, bracket%high))//' and '// &
                    text(max(bracket%low, bracket%high))//' rpm; no closer: '//problem)
    end if
  end subroutine show_onset

  !> False position with halved weights (Illinois) between two speeds, from the second one's answer.
  subroutine close_in(scene, path, bearing, newton, bracket, problem)
    type(scene_type), intent(in) :: scene
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(root_bracket_type), intent(inout) :: bracket !! of speeds [rpm]; its `high` is the onset where that is found
    character(len=:), allocatable, intent(out) :: problem !! why it is not found
    type(operating_point_type) :: target
    type(path_report_type) :: report
    real(wp) :: trial, here, change
    integer :: i

    do i = 1, most_trials
      call newton%log%is_within('onset of whirl, trial '//text(i))
      if (abs(bracket%at_high) <= 0.0_wp .or. abs(bracket%high - bracket%low) <= tolerance*abs(bracket%high)) return
      trial = bracket%trial()
      target = bearing%point
      target%speed = angular_speed(trial)
      call follow_path(bearing, newton, target, 1.0_wp, path, report)
      if (report%converged()) then
        call find_instability(scene, bearing, newton, here, problem)
      else
        problem = report%reason()
      end if
      if (allocated(problem)) then
        problem = 'at '//text(trial)//' rpm '//problem
        return
      end if
      change = abs(trial - bracket%high)
      call bracket%narrow(trial, here)
      if (change <= tolerance*abs(trial)) return
    end do
    problem = 'it jumps there, or '//text(most_trials)//' trials are too few'
  end subroutine close_in

  !> Says whether a shaft that turns in equilibrium would stay there: the mass of the rotor
  !> against the critical one.
  !>
  !> Of a rotor that tilts on two bearings it is the motion without tilt that is judged, by what
  !> each of them carries. The bearing's state and equations are left as they are.
  subroutine judge_first_point(solution)
    type(bearing_solution_type), intent(inout) :: solution !! of `&transient`, at its equilibrium; its record gets what it is
    type(whirl_type) :: whirl
    character(len=:), allocatable :: words, problem

    associate (bearing => solution%bearing, log => solution%context%log, point => solution%bearing%point, &
               mass => solution%scene%rotor%mass)
      if (.not. bearing%floats .or. bearing%shaft_fixed) return
      if (.not. point%speed > 0.0_wp) return
      call log%is_at('the critical mass')
      call find_whirl(solution%scene, bearing, solution%newton, whirl, problem)
      call log%is_at('')
      if (allocated(problem)) return
      words = 'the first point, '//text(point%speed/rpm)//' rpm under ('// &
              text(point%load(1), digits)//', '//text(point%load(2), digits)//') N, is linearly '
      if (.not. whirl%found) then
        call log%line(words//'stable: no rigid shaft whirls there between 0.05 and 1.2 times the speed')
        return
      end if
      call add_result(solution%record%judged, 'critical_mass', whirl%critical_mass, at_begin_of_time)
      call add_result(solution%record%judged, 'whirl_ratio', whirl%ratio)
      if (mass > whirl%critical_mass) then
        call log%warning(words//'unstable: the mass of '//text(mass, digits)//' kg is above '// &
                         'the critical mass of '//text(whirl%critical_mass, digits)// &
                         ' kg, and whirl at about '//text(whirl%ratio, digits)// &
                         ' of the speed grows from there')
      else
        call log%line(words//'stable: the mass of '//text(mass, digits)//' kg is below the '// &
                      'critical mass of '//text(whirl%critical_mass, digits)//' kg')
      end if
    end associate
  end subroutine judge_first_point
end module gfb_onset
