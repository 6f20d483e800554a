#include "gfb_petsc.h"
!> Heat in a search from nothing: on the first mesh that has an answer at ambient temperature it comes to that answer; every
!> finer mesh begins hot.
!>
!> What temperatures do to gas, shaft and sleeve comes at once, or in steps. Where that ends short of all of it there may be an
!> answer still, or a runaway, which is a fold: from there on all of it counts, at a lower speed that makes as much less heat,
!> and the speed is raised until it is the one asked for or the branch ends.
module gfb_heat_start
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: ice_point
  use gfb_film_surface, only: axial_coordinate
  use gfb_work_bound, only: gives_up
  use gfb_ending, only: ending_type, path_heats_up, ending_heated, ending_lost
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_heat, only: film_heat_type
  use gfb_heat_balance, only: film_work_type, find_surplus, hottest
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_bearing_builder, only: heat_of
  use gfb_heat_switch, only: add_heat
  use gfb_newton, only: renew_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_saved_state, only: saved_state_type
  use gfb_start_position, only: solve_at, set_interference
  use gfb_start_problem, only: start_problem_type, trial_settings, first_step
  use gfb_answer_transfer, only: transfer_answer
  implicit none (type)
  private
  public :: heat_up, carry_heat, show_heat

  ! Counted on 78 members of `tools/bench population --set hot`, seeds 20 to 22, 38 of which have answers: 37 of these were looked at
  ! and come with all heat at once, none in steps or from a lower speed. Those win no answer: they name 20 of the 40 refusals, as folds.
  ! With 0.02 in the place of least_part 5 of these keep their fold, at 782 instead of 872 factorizations, but end at up to 3.5 % less heat.
  integer, parameter :: most_at_once = 15        !! Newton's iterations, of a step: those that converge take 5 to 9
  real(wp), parameter :: first_part = 0.3_wp     !! of the ambient temperature, or twice the clearance, that a first step may take [1]
  real(wp), parameter :: least_part = 1.0e-3_wp  !! of all heat, in a step [1]
  real(wp), parameter :: least_share = 0.02_wp   !! of the way that is gone, in a step [1]
  real(wp), parameter :: least_shown = 0.05_wp   !! of the way from a state that was reached before, in a step [1]
  real(wp), parameter :: lowest_speed = 0.3_wp !! over the one asked for: below it films that bear a load touch down [1]

contains

  !> Gives a bearing at its answer at ambient temperature the heat of its scene, and finds its answer with it.
  subroutine heat_up(problem, report)
    type(start_problem_type), intent(inout) :: problem !! at that answer; its scene has heat
    type(path_report_type), intent(out) :: report !! how it ended
    type(saved_state_type) :: cold
    logical :: stopped

    associate (bearing => problem%bearing, newton => problem%newton)
      call newton%log%stage('heat')
      call set_interference(bearing, problem%scene%bearing%interference)
      call add_heat(bearing, heat_of(problem%scene))
      call renew_newton(newton, bearing, 'bearing_')
      bearing%point%growth = 0.0_wp
      call judge_balance(bearing, report%ending)
      report%reached = bearing%point
      if (report%has_cause()) return
      call cold%save(bearing)
      call solve_at(bearing, newton, problem%target, .false., problem%settings, report, most_at_once)
      stopped = gives_up(newton%settings%bound)
      if (.not. (report%converged() .or. stopped)) then
        call newton%log%detail('in steps')
        call cold%restore(bearing)
        call raise_heat(problem, report)
      end if
      call cold%destroy()
    end associate
  end subroutine heat_up

  !> What temperatures do comes by steps, the first of which is as large as what they would do allows: from the temperatures of a
  !> film that does not feel them.
  subroutine raise_heat(problem, report)
    type(start_problem_type), intent(inout) :: problem !! at its answer at ambient temperature
    type(path_report_type), intent(out) :: report !! how it ended
    type(bearing_answer_type) :: answer
    type(operating_point_type) :: without
    real(wp) :: loss, rise
    logical :: stopped

    associate (bearing => problem%bearing, newton => problem%newton, heat => problem%bearing%heat)
      without = problem%target
      without%growth = 0.0_wp
      call solve_at(bearing, newton, without, .false., problem%settings, report)
      if (.not. report%converged()) then
        call say_where(problem, report)
        return
      end if
      answer = bearing_answer(bearing, brief=.true.)
      rise = abs(answer%heat%whole%maximum_film_temperature - heat%ambient)/heat%ambient
      loss = abs(heat%closing(answer%heat%shaft_temperature, answer%heat%sleeve_temperature))/bearing%clearance
      call follow_path(bearing, newton, problem%target, first_part/max(first_part, rise, 2.0_wp*loss), &
                       heating_settings(problem%settings, least_part), report)
      stopped = gives_up(newton%settings%bound)
      if (.not. (report%converged() .or. stopped)) call raise_speed(problem, report)
    end associate
  end subroutine raise_heat

  !> Limits of a path with heat while it is searched: where a step of a fiftieth of the way that is gone finds no answer, none
  !> is looked for by shorter ones.
  pure function heating_settings(settings, smallest) result(heating)
    type(path_settings_type), intent(in) :: settings !! the scene's
    real(wp), intent(in) :: smallest !! step, where less of the way is gone [1]
    type(path_settings_type) :: heating

    heating = trial_settings(settings)
    heating%smallest_step = smallest
    heating%smallest_share = least_share
    heating%trial_iterations = most_at_once
    heating%look_for_folds = .false.
    heating%stands_cold = .true.
  end function heating_settings

  !> Ends where the film makes more heat than can leave at any temperature.
  !>
  !> What it makes at least: a shaft that finds its place goes where the film drags less, whose mean gap then is about the same
  !> (of a runner along its axis, whose gap is free, the drag grows with the root of the viscosity).
  subroutine judge_balance(bearing, ending)
    type(bearing_system_type), intent(in) :: bearing !! with heat, at ambient temperature
    type(ending_type), intent(inout) :: ending !! stays as it is where there may be an answer
    type(bearing_answer_type) :: answer
    type(film_work_type) :: film
    real(wp) :: temperature, made, out
    logical :: always

    associate (heat => bearing%heat)
      if (heat%sleeve%growth > heat%shaft%growth) return ! a hot bearing may have more clearance
      if (allocated(bearing%feed)) return ! a supply cools as much as it is cold
      answer = bearing_answer(bearing, brief=.true.)
      associate (whole => answer%heat%whole, surface => bearing%mesh%surface)
        film = film_work_type(drag=whole%power, flow=max(whole%leading, whole%trailing, whole%trailing + whole%sides), area=whole%area)
        if (bearing%floats .and. .not. any(bearing%coordinate < axial_coordinate)) then
          film%power = 0.5_wp
        else if (bearing%floats) then
          film%drag = min(film%drag, heat%gas%law%viscosity*(surface%radius*bearing%point%speed)**2*whole%area/whole%mean_gap)
        end if
      end associate
      call find_surplus(heat, film, always, temperature, made, out)
    end associate
    if (always) ending = path_heats_up(hottest, temperature, made, out)
  end subroutine judge_balance

  !> From the part of all heat that was reached to all of it, at a speed that makes as much as was; and from there to the speed
  !> asked for. Where that does not begin, the state that was reached stands.
  subroutine raise_speed(problem, report)
    type(start_problem_type), intent(inout) :: problem !! at the state that was reached
    type(path_report_type), intent(inout) :: report !! in: of the path to it; out: how it ended
    type(operating_point_type) :: slow
    type(path_report_type) :: other
    type(saved_state_type) :: reached
    type(ending_type) :: ending
    real(wp) :: share

    associate (bearing => problem%bearing, newton => problem%newton, target => problem%target)
      share = sqrt(bearing%point%growth)
      slow = target
      slow%speed = target%speed*share
      if (target%speed > 0.0_wp .and. share > lowest_speed) then
        call newton%log%line('not with all heat at once ('//report%reason()//'): from a lower speed')
        call reached%save(bearing)
        call follow_path(bearing, newton, slow, 1.0_wp, heating_settings(problem%settings, least_shown), other)
        if (other%converged()) then
          ending = report%ending
          call follow_path(bearing, newton, target, first_step, heating_settings(problem%settings, least_shown), report)
          if (report%ending%kind == ending_lost .and. ending%has_cause()) report%ending = ending ! it is the same one, nearer to its end
        else
          call reached%restore(bearing)
        end if
        call reached%destroy()
      end if
      if (.not. report%converged()) call say_where(problem, report)
    end associate
  end subroutine raise_speed

  !> Says how far the heat of a bearing led, and how hot it was there.
  subroutine say_where(problem, report)
    type(start_problem_type), intent(in) :: problem !! at its last state
    type(path_report_type), intent(inout) :: report
    type(bearing_answer_type) :: answer
    character(len=:), allocatable :: where_it_ends

    associate (point => problem%bearing%point, speed => problem%target%speed)
      answer = bearing_answer(problem%bearing, brief=.true.)
      where_it_ends = 'at '//text(100.0_wp*point%growth, 3)//' % of the heat'
      if (.not. point%growth < 1.0_wp .and. speed > 0.0_wp) then
        where_it_ends = 'with heat at '//text(100.0_wp*point%speed/speed, 3)//' % of the speed'
      end if
      associate (heat => answer%heat)
        associate (shaft => felt(problem%bearing, heat%shaft_temperature), &
                   film => felt(problem%bearing, heat%whole%maximum_film_temperature))
          where_it_ends = where_it_ends//': shaft '//text(shaft, 4)//' K, film up to '//text(film, 4)//' K ('// &
                          text(shaft - ice_point, 3)//' and '//text(film - ice_point, 3)//' C)'
        end associate
      end associate
      if (report%ending%kind == ending_lost) then
        call report%ending%add_words('lost '//where_it_ends//'; ', '')
      else
        call report%ending%add_words('', '; last state '//where_it_ends)
      end if
    end associate
  end subroutine say_where

  !> A temperature as gas and radii feel it [K].
  pure real(wp) function felt(bearing, temperature)
    type(bearing_system_type), intent(in) :: bearing !! with heat
    real(wp), intent(in) :: temperature !! [K]
    felt = bearing%heat%ambient + bearing%point%growth*(temperature - bearing%heat%ambient)
  end function felt

  !> Newton's method with heat from the answer of the smaller mesh.
  subroutine carry_heat(problem, report)
    type(start_problem_type), intent(inout) :: problem !! with the smaller mesh's bearing
    type(path_report_type), intent(out) :: report !! how it ended

    call transfer_answer(problem%smaller, problem%bearing)
    call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report)
    problem%from_smaller = report%converged()
  end subroutine carry_heat

  !> The smaller mesh's refusal is shown on this one from the state where it ended. What does not lead to another end leaves that
  !> one's.
  subroutine show_heat(problem, report)
    type(start_problem_type), intent(inout) :: problem !! with the smaller mesh's bearing and its refusal
    type(path_report_type), intent(out) :: report !! how it ended
    logical :: begins

    associate (bearing => problem%bearing, newton => problem%newton)
      call transfer_answer(problem%smaller, bearing)
      call solve_at(bearing, newton, problem%smaller%point, problem%smaller%shaft_fixed, problem%settings, report)
      begins = report%converged() .and. problem%refusal%ending%kind /= ending_heated ! that is of any mesh
      if (begins) begins = .not. gives_up(newton%settings%bound)
      if (begins) then
        call follow_path(bearing, newton, problem%target, least_shown, heating_settings(problem%settings, least_shown), report)
        if (report%converged()) return
        call say_where(problem, report)
        if (report%has_cause()) return
      end if
      report%ending = problem%refusal%ending
    end associate
  end subroutine show_heat
end module gfb_heat_start
