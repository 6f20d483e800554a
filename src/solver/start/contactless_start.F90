#include "gfb_petsc.h"
!> The starts of a bearing whose foil touches nothing but the film: the load at once, at a fixed position
!> from rest to speed and then with the shaft released, or with the shaft laid on its foil first; of a thrust bearing
!> at a held gap, and then with the runner released.
module gfb_contactless_start
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_ending, only: path_lost, path_touches_at
  use gfb_text, only: text
  use gfb_film_surface, only: axial => axial_coordinate, translations, shaft_coordinates
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_film_load, only: film_forces
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type, trial_settings, clearance_of, usual_eccentricity
  use gfb_saved_state, only: saved_state_type
  use gfb_soft_contact_start, only: hold_softly
  use gfb_start_position, only: guess_position, place_shaft, find_position, release_shaft, solve_at, put_at_rest, room_at_rest
  use gfb_film_room, only: smallest_gap_at_rest, closing_gaps, open_place
  implicit none (type)
  private
  public :: try_from_rest, try_laid_down, try_from_gap

  !> Of the load at once. Of 24 rigid journals without orifices six are cheaper than by 10, none dearer (250 factorizations become 187);
  !> by 24 two of 48 are cheaper yet, and three dearer.
  integer, parameter :: max_iterations = 16
  integer, parameter :: galerkin_steps = 2      !! of a path, before SUPG is asked
  real(wp), parameter :: aside = 0.25_wp*pi !! attitude of a shaft that does not lie where the load presses it [rad]
  real(wp), parameter :: behind_load = 0.1_wp   !! attitude of a shaft that is laid down; heavy loads leave 0 to 6 degrees [rad]
  real(wp), parameter :: deeper = 1.3_wp        !! over the one before [1]
  integer, parameter :: most_depths = 24        !! to 400 times the clearance
  integer, parameter :: most_gaps = 8           !! held, on the way to the load
  real(wp), parameter :: gap_step = 0.5_wp      !! logarithm of one held gap over the next, at most [1]
  real(wp), parameter :: coarse_peclet = 5.0_wp !! of a cell that is too large for Galerkin [1]

contains

  !> At rest the film is at ambient pressure wherever the shaft is: from there to the load, or to speed first.
  subroutine try_from_rest(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended

    associate (bearing => problem%bearing, newton => problem%newton)
      call guess_position(bearing, problem%scene, problem%target, usual_eccentricity)
      if (bearing%floats) then
        call make_room(problem, report)
        if (report%has_cause()) return
      end if
      if (bearing%floats .and. problem%target%speed > 0.0_wp) then
        call try_directly(bearing, newton, problem%target, problem%settings, report)
        if (report%converged()) return
      end if
      call find_rigid_position(bearing, newton, problem%target, problem%settings, report)
      if (report%converged() .and. bearing%floats) then
        call release_shaft(bearing, newton, problem%target, problem%settings, report)
      end if
    end associate
  end subroutine try_from_rest

  !> Moves a shaft that floats to where the film is open while no foil is deflected, if it begins elsewhere. In a rigid bearing
  !> whose tilt leaves no such place that is the end.
  subroutine make_room(problem, report)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report !! has a cause where there is no room
    type(operating_point_type) :: point
    real(wp) :: place(2)
    logical :: exists

    point = problem%target
    point%place(:2) = problem%bearing%eccentricity()
    call open_place(problem%bearing, point, place, exists)
    if (exists) then
      if (any(abs(place - point%place(:2)) > 0.0_wp)) call place_shaft(problem%bearing, place)
    else if (.not. problem%scene%model%foil%deflects) then
      call refuse_room(problem, 'its tilt closes the gap', report)
    end if
  end subroutine make_room

  !> Says that the gap alone leaves no place for the shaft.
  subroutine refuse_room(problem, why, report)
    type(start_problem_type), intent(inout) :: problem
    character(len=*), intent(in) :: why !! what closes it
    type(path_report_type), intent(inout) :: report

    call put_at_rest(problem%bearing, problem%target)
    report%ending = path_touches_at('wherever it stands: '//why)
    report%reached = problem%bearing%point
    problem%no_room = .true.
  end subroutine refuse_room

  !> The runner held at a gap at which its ramp bears most, 1.2 times the gap, or at that asked for where it is wider; from there to the gap asked
  !> for, or released. A tilted runner is held as far above the gap at which it meets the pads. Foils in contact that Newton's method does
  !> not bring to speed there at once come on soft two-way contacts.
  subroutine try_from_gap(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    type(operating_point_type) :: held
    type(path_settings_type) :: downwards
    type(saved_state_type) :: start
    real(wp) :: closing(2)

    downwards = problem%settings
    downwards%touch_down_gap = 0.0_wp
    associate (bearing => problem%bearing, newton => problem%newton, target => problem%target, play => problem%scene%bearing%play)
      held = target
      closing = closing_gaps(bearing, target, play)
      if (play > 0.0_wp .and. sum(closing) >= play) then
        if (.not. problem%scene%model%foil%deflects) then
          call refuse_room(problem, 'its tilt takes '//text(sum(closing), 4)//' m of axial_play', report)
          return
        end if
        held%place(translations + 1:) = held%place(translations + 1:)*room_at_rest*play/sum(closing) ! the rest of it comes with the load
        closing = closing_gaps(bearing, held, play)
      end if
      held%place(axial) = -wide_gap(bearing, play, target, closing)
      if (bearing%floats .and. target%place(axial) < 0.0_wp) held%place(axial) = target%place(axial)
      if (.not. smallest_gap_at_rest(bearing, held) > 0.0_wp) held%place(axial) = -wide_gap(bearing, play, target, closing)
      call newton%log%detail('runner held at a gap of '//text(-held%place(axial), 4)//' m')
      call put_at_rest(bearing, held)
      call start%save(bearing)
      call solve_at(bearing, newton, held, .true., downwards, report)
      if (.not. report%converged() .and. bearing%has_contacts()) then
        call hold_softly(bearing, newton, held, downwards, report)
      else if (.not. report%converged()) then
        call start%restore(bearing)
        call follow_path(bearing, newton, held, 1.0_wp, downwards, report)
      end if
      if (report%converged() .and. .not. bearing%floats .and. any(abs(held%place - target%place) > 0.0_wp)) then
        call follow_path(bearing, newton, target, 1.0_wp, downwards, report)
      end if
      if (report%converged() .and. bearing%floats) then
        call approach_load(bearing, newton, play, closing, target, downwards, report)
        call start%destroy()
        call start%save(bearing)
        call solve_at(bearing, newton, target, .false., problem%settings, report, max_iterations)
        if (.not. report%converged()) then
          call start%restore(bearing)
          call release_shaft(bearing, newton, target, problem%settings, report)
        end if
      else
        report%shaft_fixed = .true.
      end if
      call start%destroy()
    end associate
  end subroutine try_from_gap

  !> A gap that is wide enough to begin with: the ramp bears most at 1.2 times it, or that asked for is wider. A runner between
  !> two bearings begins no further from the middle of its play than it is to come, and there where nothing loads it. What a tilt
  !> takes off the gap comes to it where little would be left.
  pure real(wp) function wide_gap(bearing, play, target, closing) result(gap)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: play !! 0: there is one bearing [m]
    type(operating_point_type), intent(in) :: target
    real(wp), intent(in) :: closing(2) !! axial gaps at which it meets the pads of both sides [m]
    real(wp) :: usual, near
    logical :: other !! the other one of two bearings has the smaller gap

    associate (wanted => -target%place(axial))
      other = play > 0.0_wp .and. (wanted > 0.5_wp*play .or. (bearing%floats .and. target%load(axial) > 0.0_wp))
      near = closing(merge(2, 1, other))
      usual = bearing%clearance*exp(gap_step)
      if (near > room_at_rest*usual) usual = usual + near
      gap = max(usual, wanted)
      if (.not. play > 0.0_wp) return
      gap = min(max(usual, merge(play - wanted, wanted, other .and. wanted > 0.0_wp)), 0.5_wp*(play + near - closing(merge(1, 2, other))))
      if (other) gap = play - gap
      if (bearing%floats .and. .not. abs(target%load(axial)) > 0.0_wp) gap = 0.5_wp*(play + closing(1) - closing(2))
    end associate
  end function wide_gap

  !> From one held gap to another until the film carries about the load: its force is next to a power of the gap, found from the
  !> last two. Newton's method leads from there to the load. Of 60 bearings at random as many have an answer without these steps,
  !> 45, at 713 factorizations instead of 589. Of two bearings it is the gap of the loaded one, of a tilted runner what is left of it.
  subroutine approach_load(bearing, newton, play, closing, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing !! with an answer at a held gap
    type(newton_type), target, intent(inout) :: newton
    real(wp), intent(in) :: play !! of a runner between two bearings, else 0 [m]
    real(wp), intent(in) :: closing(2) !! axial gaps at which it meets the pads of both sides [m]
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(inout) :: report
    type(operating_point_type) :: next
    type(saved_state_type) :: last
    real(wp) :: force(film_forces), missing, before, change, side, origin
    real(wp) :: power ! of the gap, minus that of the force [1]
    integer :: trial

    if (.not. abs(target%load(axial)) > 0.0_wp) return
    side = sign(1.0_wp, -target%load(axial))
    origin = merge(closing(2) - play, -closing(1), side < 0.0_wp) ! where that gap is none
    power = 1.0_wp
    do trial = 1, most_gaps
      force = bearing%reaction()
      missing = log(max(-target%load(axial)*side/max(force(axial)*side, tiny(1.0_wp)), tiny(1.0_wp)))
      if (abs(missing) < 0.5_wp*gap_step) exit
      if (trial > 1) power = (before - missing)/change
      if (.not. power > 0.0_wp) power = 1.0_wp
      before = missing
      change = min(max(missing/power, -gap_step), gap_step)
      next = bearing%point
      next%place(axial) = origin + (next%place(axial) - origin)*exp(-change)
      call last%save(bearing)
      call solve_at(bearing, newton, next, .true., settings, report)
      if (.not. report%converged()) then
        call last%restore(bearing)
        exit
      end if
    end do
    call last%destroy()
  end subroutine approach_load

  !> Where the way to the load has ended with the shaft aside: lays it on its foil where the load presses it, deeper and deeper
  !> until the film carries that much, and releases it.
  !>
  !> As a load grows from nothing the shaft leaves the centre across it. Where the film has its gap there, that branch ends,
  !> and another one carries a shaft that came to speed on its foil.
  subroutine try_laid_down(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved, at the end of that way
    type(path_report_type), intent(out) :: report !! how it ended; shaft fixed: nothing has been shown
    type(path_settings_type) :: quick, downwards
    type(operating_point_type) :: next
    real(wp) :: direction, force(film_forces), position(2)
    integer :: depth

    report%shaft_fixed = .true.
    report%ending = path_lost('the shaft lies where the load presses it')
    quick = trial_settings(problem%settings)
    downwards = quick
    downwards%touch_down_gap = 0.0_wp
    associate (bearing => problem%bearing, newton => problem%newton, load => problem%target%load(:2))
      position = bearing%eccentricity()
      if (-dot_product(position, load) > cos(aside)*norm2(position)*norm2(load)) return
      direction = atan2(load(2), load(1)) + behind_load
      call place_shaft(bearing, -room_at_rest*clearance_of(bearing)*[cos(direction), sin(direction)])
      call find_position(bearing, newton, problem%target, downwards, report)
      if (.not. report%converged()) return
      do depth = 1, most_depths
        force = bearing%reaction()
        if (dot_product(force(1:2), load) >= norm2(load)**2) exit
        next = bearing%point
        next%place(:2) = deeper*next%place(:2)
        call follow_path(bearing, newton, next, 0.5_wp, downwards, report)
        if (.not. report%converged()) exit ! a load may press it where a position does not lead
      end do
      call release_shaft(bearing, newton, problem%target, quick, report)
      report%shaft_fixed = .not. (report%converged() .or. report%has_cause())
    end associate
  end subroutine try_laid_down

  !> Newton's method at the target, from ambient pressure everywhere and the shaft where it is; where that fails the
  !> state is as it was.
  subroutine try_directly(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report
    type(saved_state_type) :: start
    real(wp) :: unknown(bearing%local_size()), place(shaft_coordinates)

    call newton%log%detail('the load at once, from ambient pressure')
    call start%save(bearing)
    place = bearing%shaft_place()
    unknown = 0.0_wp
    call bearing%put_gas_at_rest(unknown)
    unknown(bearing%first_shaft + 1:) = place(bearing%coordinate)
    call bearing%set_unknowns(unknown)
    call solve_at(bearing, newton, target, .false., settings, report, max_iterations)
    if (.not. report%converged()) call start%restore(bearing)
    call start%destroy()
  end subroutine try_directly

  !> A fixed position. Where Galerkin fails it is tried from the answer of SUPG; if that does not help, and
  !> its cells are large, no path leads to an answer.
  subroutine find_rigid_position(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report
    type(path_settings_type) :: quick
    type(path_report_type) :: other
    type(saved_state_type) :: start, failed
    real(wp) :: position(2), peclet

    position = bearing%eccentricity()
    call start%save(bearing)
    quick = settings
    if (.not. bearing%upwinds()) quick%maximum_steps = min(quick%maximum_steps, galerkin_steps)
    call find_position(bearing, newton, target, quick, report)
    if (.not. (report%converged() .or. bearing%upwinds())) then
      call failed%save(bearing)
      call start%restore(bearing)
      call find_by_upwinding(bearing, newton, target, position, settings, peclet, other)
      if (other%converged()) then
        report = other
      else if (peclet > coarse_peclet) then
        report%ending = path_lost("Galerkin's pressure oscillates and empties the film, as the cell Peclet number is "// &
                                  text(peclet, 3)//": film_scheme = 'supg' has an answer, or use a finer mesh")
        call failed%restore(bearing)
      else
        call start%restore(bearing)
        call find_position(bearing, newton, target, settings, report)
      end if
    end if
    call failed%destroy()
    call start%destroy()
  end subroutine find_rigid_position

  !> A fixed position by SUPG, and Galerkin's from there.
  subroutine find_by_upwinding(bearing, newton, target, eccentricity, settings, peclet, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    real(wp), intent(in) :: eccentricity(2) !! where the shaft is fixed [m]
    type(path_settings_type), intent(in) :: settings
    real(wp), intent(out) :: peclet         !! largest cell Peclet number of SUPG's answer, 0 without one [1]
    type(path_report_type), intent(out) :: report
    type(operating_point_type) :: wanted
    type(bearing_answer_type) :: answer

    bearing%pad%film%flow%upwind = .true.
    call find_position(bearing, newton, target, settings, report)
    bearing%pad%film%flow%upwind = .false.
    peclet = 0.0_wp
    if (.not. report%converged()) return
    answer = bearing_answer(bearing)
    peclet = answer%maximum_peclet
    wanted = target
    wanted%place(:2) = eccentricity
    call solve_at(bearing, newton, wanted, .true., settings, report)
    report%shaft_fixed = .true.
  end subroutine find_by_upwinding
end module gfb_contactless_start
