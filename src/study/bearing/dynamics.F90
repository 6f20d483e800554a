#include "gfb_petsc.h"
!> Small vibrations of the shaft about an answer: stiffness and damping, the mass that whirls, and the
!> modes of a rotor.
module gfb_dynamics
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type, place_of, number_in
  use gfb_result_names, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_motion_cases, only: tangent_stick, frequencies_at
  use gfb_film_surface, only: journal_motions, axial_coordinate
  use gfb_bearing_system, only: bearing_system_type
  use gfb_heat_switch, only: held_bearing_type, hold_heat
  use gfb_bearing_builder, only: build_opposite
  use gfb_newton, only: newton_type, forget_factors, show_enlargements
  use gfb_dynamic_response, only: dynamic_response_type, create_response, response_failure, destroy_response
  use gfb_frequency_response, only: frequency_response_type, cover_frequencies, coefficients_at, joined_type, join_frequencies, &
                                    most_joined
  use gfb_scene_vibration, only: vibration_of
  use gfb_foil_mass_choice, only: choose_mass, describe_mass
  use gfb_amplitude_response, only: vibration_state_type, start_vibration, find_at_amplitude
  use gfb_hammer, only: hammer_type, find_hammer
  use gfb_whirl, only: whirl_type, find_critical_mass
  use gfb_rotor, only: rotor_type, conical, words_of_sense
  use gfb_rotor_modes, only: rotor_answer_type, find_rotor_modes, find_axial_mode, rotor_mode_type
  use gfb_mode_owner, only: is_of_shaft, of_both
  use gfb_dynamics_record, only: dynamics_record_type, dynamics_point_type, stiffness_of, damping_of, mode_numbers, &
                                 motion_names
  implicit none (type, external)
  private
  public :: find_dynamics, find_instability, mass_excess, find_whirl

  integer, parameter :: digits = 4       !! in tables of the log
  integer, parameter :: translations = 2 !! of the shaft's coordinates, the first ones

  integer, parameter :: mode_digits = 5
  real(wp), parameter :: dead = 0.9_wp !! a mode with a larger damping ratio is not shown [1]
  character(len=*), parameter :: owners(4) = [character(len=14) :: 'rotor', 'foil', 'film', 'rotor and foil'] !! of modes, by number

contains

  !> Coefficients at the frequencies of the scene, the critical mass and the rotor's modes, where they are asked for; the bearing's
  !> state and equations are left as they are.
  subroutine find_dynamics(scene, log, bearing, newton, record, found, whirl)
    type(scene_type), intent(in) :: scene !! what is asked for, with the sweep's value in its keys
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), target, intent(inout) :: bearing !! at its answer
    type(newton_type), intent(inout) :: newton !! its factorizations are counted
    type(dynamics_record_type), intent(inout) :: record !! gets the answer's coefficients
    !> entries of K and C, critical mass, whirl ratio, the rotor's growth; not allocated where nothing is asked for
    type(quantity_type), allocatable, intent(out) :: found(:)
    type(whirl_type), intent(out) :: whirl !! what was found of it, where it was looked for
    type(rotor_answer_type) :: rotor
    type(dynamic_response_type) :: response
    type(frequency_response_type) :: model
    type(dynamics_point_type) :: point
    type(held_bearing_type) :: held
    logical :: first

    if (.not. scene%dynamics%present) return
    call hold_heat(bearing, held)
    if (.not. allocated(record%point)) allocate (record%point(0))
    first = size(record%point) == 0
    allocate (found(0))
    if (.not. scene%sweep%present) call log%heading('small vibrations')
    if (first) call describe(scene, log)
    ! What is to come has no use for the answer's factors.
    if (.not. (scene%sweep%present .or. scene%sensitivity%present)) call forget_factors(newton)
    call start_response(scene, log, held%bearing, response, record%problem)
    if (allocated(record%problem)) return
    call describe_mass(scene, log, response%equations%inertia, first)
    call fill_coefficients(scene, log, held%bearing, response, model, point, record%problem)
    if (.not. allocated(record%problem)) then
      call add_entries('stiffness_', point%motion, stiffness_of(point, 1), found)
      call add_entries('damping_', point%motion, damping_of(point, 1), found)
      if (.not. scene%sweep%present) call show_coefficients(scene, log, held%bearing%point%speed, point)
    end if
    if (.not. allocated(record%problem) .and. size(scene%dynamics%amplitudes) > 0) then
      call fill_amplitudes(scene, log, held%bearing, response, point, record%problem)
    end if
    if (.not. allocated(record%problem) .and. scene%dynamics%stability .and. held%bearing%point%speed > 0.0_wp) then
      call add_whirl(log, held%bearing, response, model, found, whirl, record%problem)
      if (scene%rotor%present .and. .not. allocated(record%problem)) then
        call find_rotor_modes(held%bearing, response, rotor_of(scene), rotor)
      end if
    end if
    if (.not. allocated(record%problem) .and. scene%bearing%row%has_sectors .and. &
        (scene%feed%present .or. scene%grooves%present)) then
      call add_hammer(log, held%bearing, response, model, found, record%problem)
    end if
    if (.not. allocated(record%problem) .and. scene%bearing%row%moves_along .and. scene%rotor%present) then
      call add_axial_mode(scene, log, held%bearing, response, point%frequency(1), found)
    end if
    whirl%weighs = response%equations%inertia%present
    record%point = [record%point, point]
    if (response%enlargements > 0) call show_enlargements(log, response%enlargements)
    call end_response(held%bearing, newton, response)
    if (.not. allocated(rotor%mode)) return
    call show_rotor(log, held%bearing%point%speed, scene%sweep%present, found, scene%rotor%mass, rotor)
    call add_rotor(rotor, found)
    if (rotor%defined) record%point(size(record%point))%mode = mode_matrix(rotor)
  end subroutine find_dynamics

  !> Stiffness and damping at the frequencies of the scene.
  subroutine fill_coefficients(scene, log, bearing, response, model, point, problem)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(frequency_response_type), intent(inout) :: model !! gets the samples that the frequencies need
    type(dynamics_point_type), intent(inout) :: point
    character(len=:), allocatable, intent(inout) :: problem !! what could not be factorized
    logical :: made
    integer :: i

    point%frequency = frequencies_at(scene%dynamics, bearing%point%speed)
    if (scene%dynamics%interpolation_tolerance > 0.0_wp) then
      call add_frequencies(scene%dynamics%interpolation_tolerance, log, bearing, response, model, point, made)
    else
      call cover_frequencies(bearing, response, point%frequency, log, model, made)
    end if
    if (.not. made) problem = 'the vibration at '//text(model%failed)//' rad/s: '//response_failure(response)
    if (.not. made) return
    point%motion = bearing%mesh%surface%motions()
    associate (motions => size(point%motion))
      allocate (point%coefficient(motions, motions, size(point%frequency)))
    end associate
    do i = 1, size(point%frequency)
      point%coefficient(:, :, i) = coefficients_at(response, model, point%frequency(i))
    end do
  end subroutine fill_coefficients

  !> Puts frequencies between those of the scene, and says how many.
  subroutine add_frequencies(tolerance, log, bearing, response, model, point, made)
    real(wp), intent(in) :: tolerance !! of lines between neighbours [1]
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(frequency_response_type), intent(inout) :: model !! gets the samples
    type(dynamics_point_type), intent(inout) :: point !! with the frequencies of the scene
    logical, intent(out) :: made !! else nothing is solved at one of them
    type(joined_type) :: joined
    integer :: asked

    asked = size(point%frequency)
    call join_frequencies(bearing, response, tolerance, log, model, point%frequency, joined)
    made = joined%found
    if (.not. made) return
    point%interpolation_miss = joined%largest_miss
    if (.not. joined%by_function) then
      call log%warning('no frequencies are put between those given: that would take more samples than a function '// &
                       'goes through; a larger interpolation_tolerance takes fewer')
      return
    end if
    call log%line(text(size(point%frequency) - asked)//' frequencies put between the '//text(asked)//' given, in table and files: '// &
                  'lines between neighbours miss K and C by at most '//text(100.0_wp*joined%largest_miss, 2)//' % of the largest entry')
    if (joined%largest_miss > tolerance) then
      call log%warning('lines between frequencies miss K and C by more than interpolation_tolerance: no more than '// &
                       text(most_joined)//' frequencies are taken')
    end if
  end subroutine add_frequencies

  !> Stiffness and damping at the amplitudes of the scene, each found from the one before.
  subroutine fill_amplitudes(scene, log, bearing, response, point, problem)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(dynamics_point_type), intent(inout) :: point
    character(len=:), allocatable, intent(inout) :: problem !! what could not be factorized
    type(vibration_state_type) :: vibration
    real(wp) :: none
    integer :: i, k, along
    logical :: found

    none = ieee_value(none, ieee_quiet_nan)
    point%amplitude = scene%dynamics%amplitudes
    associate (amplitudes => size(point%amplitude), frequencies => size(point%frequency))
      allocate (point%at_amplitude(journal_motions, journal_motions, amplitudes, frequencies), &
                source=cmplx(none, none, wp))
      allocate (point%friction_loss(translations, amplitudes, frequencies))
    end associate
    do i = 1, size(point%frequency)
      do along = 1, translations
        call start_vibration(bearing, vibration)
        do k = 1, size(point%amplitude)
          call find_at_amplitude(bearing, response, cmplx(0.0_wp, point%frequency(i), wp), along, point%amplitude(k), &
                                 vibration, found)
          if (.not. found) then
            problem = 'the vibration at '//text(point%frequency(i))//' rad/s: '//response_failure(response)
            return
          end if
          if (.not. vibration%converged) then
            call log%warning('amplitude '//text(point%amplitude(k), digits)//' m along '//'xy'(along:along)// &
                          ': contacts have not converged in '//text(vibration%passes)//' passes')
          end if
          point%at_amplitude(:, along, k, i) = vibration%coefficient
          point%friction_loss(along, k, i) = vibration%lost
        end do
      end do
      call show_amplitudes(log, point, i)
    end do
  end subroutine fill_amplitudes

  !> A line an amplitude.
  subroutine show_amplitudes(log, point, i)
    type(run_log_type), intent(in) :: log
    type(dynamics_point_type), intent(in) :: point
    integer, intent(in) :: i !! number of the frequency
    integer :: k

    call log%line('contacts that slide to and fro, at '//text(point%frequency(i), digits)//' rad/s:')
    call log%line('amplitude [m]   Kxx Kxy Kyx Kyy [N/m]   Cxx Cxy Cyx Cyy [N s/m]   lost in contacts, x y [J a cycle]')
    do k = 1, size(point%amplitude)
      associate (z => point%at_amplitude(:, :, k, i), lost => point%friction_loss(:, k, i))
        call log%line(text(point%amplitude(k), digits)//numbers_of(point%motion, real(z, wp))//numbers_of(point%motion, aimag(z)/point%frequency(i))// &
                      '   '//text(lost(1), digits)//' '//text(lost(2), digits))
      end associate
    end do
  end subroutine show_amplitudes

  !> The entries of x and y, or of z and of tilts, row by row.
  function numbers_of(motion, matrix) result(line)
    integer, intent(in) :: motion(:) !! the shaft's coordinates
    real(wp), intent(in) :: matrix(:, :)
    character(len=:), allocatable :: line
    integer :: row

    line = '  '
    if (motion(1) == axial_coordinate) then
      line = line//' '//text(matrix(1, 1), digits)//', '//text(matrix(2, 2), digits)//' '//text(matrix(2, 3), digits)//' '// &
             text(matrix(3, 2), digits)//' '//text(matrix(3, 3), digits)
      return
    end if
    do row = 1, translations
      line = line//' '//text(matrix(row, 1), digits)//' '//text(matrix(row, 2), digits)
    end do
  end function numbers_of

  !> What is positive where the rotor is unstable: growth of its least damped mode at an answer, and with a loss factor,
  !> which has no growth, the excess of its mass over the critical one.
  subroutine find_instability(scene, bearing, newton, excess, problem)
    type(scene_type), intent(in) :: scene !! with a rotor
    type(bearing_system_type), target, intent(inout) :: bearing !! at its answer
    type(newton_type), intent(inout) :: newton !! its factorizations are counted
    real(wp), intent(out) :: excess !! [1/s], with a loss factor [1]
    character(len=:), allocatable, intent(out) :: problem !! why it was not found
    type(dynamic_response_type) :: response
    type(rotor_answer_type) :: answer
    type(whirl_type) :: whirl
    type(held_bearing_type) :: held

    call hold_heat(bearing, held)
    excess = 0.0_wp
    if (scene%dynamics%loss_factor > 0.0_wp) then
      call find_whirl(scene, held%bearing, newton, whirl, problem)
      excess = mass_excess(scene%rotor%mass, whirl%critical_mass, whirl%found)
      return
    end if
    call start_response(scene, newton%log, held%bearing, response, problem)
    if (allocated(problem)) return
    call find_rotor_modes(held%bearing, response, rotor_of(scene), answer)
    if (.not. answer%found) then
      problem = 'modes were not found: '//answer%reason
    else if (answer%decides == 0) then
      problem = 'no mode is the rotor''s'
    else
      excess = real(answer%mode(answer%decides)%rate, wp)
    end if
    call end_response(held%bearing, newton, response)
  end subroutine find_instability

  !> The excess of a mass over the critical one, over the sum of both: -1 where no mass whirls, 1 where every one does.
  pure function mass_excess(mass, critical_mass, whirls) result(excess)
    real(wp), intent(in) :: mass !! of the rotor on this bearing, positive [kg]
    real(wp), intent(in) :: critical_mass !! [kg]
    logical, intent(in) :: whirls !! there is a critical mass
    real(wp) :: excess !! [1]

    excess = -1.0_wp
    if (whirls) excess = (mass - critical_mass)/(mass + critical_mass)
  end function mass_excess

  !> The mass above which a rigid shaft whirls at an answer.
  subroutine find_whirl(scene, bearing, newton, whirl, problem)
    type(scene_type), intent(in) :: scene !! whose `&dynamics` says what the foil does
    type(bearing_system_type), target, intent(inout) :: bearing !! at its answer
    type(newton_type), intent(inout) :: newton !! its factorizations are counted
    type(whirl_type), intent(out) :: whirl !! what was found
    character(len=:), allocatable, intent(out) :: problem !! why it was not searched
    type(dynamic_response_type) :: response
    type(frequency_response_type) :: model
    type(held_bearing_type) :: held

    call hold_heat(bearing, held)
    call create_response(held%bearing, vibration_of(scene), response, log=newton%log)
    call choose_mass(scene, held%bearing, response)
    call find_critical_mass(held%bearing, response, newton%log, model, whirl)
    if (.not. whirl%searched) problem = response_failure(response)
    call end_response(held%bearing, newton, response)
  end subroutine find_whirl

  !> The scene's rotor.
  pure function rotor_of(scene) result(rotor)
    type(scene_type), intent(in) :: scene
    type(rotor_type) :: rotor
    associate (given => scene%rotor)
      rotor = rotor_type(given%mass, given%transverse_inertia, given%polar_inertia, given%bearing_distance)
    end associate
  end function rotor_of

  !> The bearing linearised at its answer, with that of tilts where half the width is solved and their foil is another.
  subroutine start_response(scene, log, bearing, response, problem)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing
    type(dynamic_response_type), intent(out) :: response
    character(len=:), allocatable, intent(inout) :: problem !! why there is none
    type(bearing_system_type), allocatable :: opposite
    type(error_type), allocatable :: error

    if (bearing%has_mirror_motions()) then
      allocate (opposite)
      call build_opposite(scene, bearing, opposite, error)
      if (allocated(error)) then
        problem = error%message
        return
      end if
    end if
    call create_response(bearing, vibration_of(scene), response, opposite, log)
    call choose_mass(scene, bearing, response)
  end subroutine start_response

  !> Counts what the vibrations have cost, and leaves the bearing's equations as they were.
  subroutine end_response(bearing, newton, response)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(dynamic_response_type), intent(inout) :: response

    newton%factorizations = newton%factorizations + response%factorizations
    newton%enlargements = newton%enlargements + response%enlargements
    call destroy_response(response)
    call bearing%linearise(bearing%state)
  end subroutine end_response

  !> What is modelled of the foil, and what is not.
  subroutine describe(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log

    if (scene%thermal%present) then
      call log%line('heat: temperatures stay as they are, with the clearance they leave: they change in seconds')
    end if
    if (scene%foil_damping%loss_time() > 0.0_wp) then
      call log%line('losses: viscous ones of the foils, with the loss factor '//text(scene%foil_damping%loss_factor, digits)// &
                    ' at '//text(scene%foil_damping%loss_frequency, digits)//' rad/s')
    end if
    if (.not. scene%model%foil%has_bumps) return
    call log%line('contacts: closed ones stay closed, and if they rub '// &
                  trim(merge('stick   ', 'slide on', scene%dynamics%contact_tangent == tangent_stick)))
    if (scene%dynamics%loss_factor > 0.0_wp) then
      call log%line('losses: loss_factor acts on the stiffness of top foil and bumps, in the place of friction')
    end if
  end subroutine describe

  !> A line a frequency that was asked for.
  subroutine show_coefficients(scene, log, speed, point)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    type(dynamics_point_type), intent(in) :: point
    character(len=:), allocatable :: line
    integer :: i

    if (point%motion(1) == axial_coordinate) then
      call log%line('frequency [rad/s] (over speed)   Kzz [N/m], of tilts Kxx Kxy Kyx Kyy [N m/rad]   '// &
                    'Czz [N s/m], Cxx Cxy Cyx Cyy [N m s/rad]')
    else
      call log%line('frequency [rad/s] (over speed)   Kxx Kxy Kyx Kyy [N/m]   Cxx Cxy Cyx Cyy [N s/m]')
    end if
    do i = 1, size(point%frequency)
      if (all(abs(frequencies_at(scene%dynamics, speed) - point%frequency(i)) > 0.0_wp)) cycle
      line = text(point%frequency(i), digits)
      if (speed > 0.0_wp) line = line//' ('//text(point%frequency(i)/speed, digits)//')'
      call log%line(line//numbers_of(point%motion, stiffness_of(point, i))//numbers_of(point%motion, damping_of(point, i)))
    end do
  end subroutine show_coefficients

  !> The entries that are results, a number each.
  subroutine add_entries(name, motion, matrix, found)
    character(len=*), intent(in) :: name !! before the two axes
    integer, intent(in) :: motion(:) !! the shaft's coordinates
    real(wp), intent(in) :: matrix(:, :)
    type(quantity_type), allocatable, intent(inout) :: found(:)
    integer, parameter :: across = 1, along = 2, tilt = 3 !! the axis
    character(len=4) :: axes(size(motion))
    integer :: kind(size(motion)), row, column

    axes = motion_names(motion)
    kind = merge(across, merge(along, tilt, motion == axial_coordinate), motion < axial_coordinate)
    do row = 1, size(matrix, 1)
      do column = 1, size(matrix, 2)
        ! What couples kinds, and the tilts of a shaft that moves across, is in the arrays alone.
        if (kind(row) /= kind(column) .or. (kind(row) == tilt .and. any(kind == across))) cycle
        call add_result(found, name//trim(axes(row))//trim(axes(column)), matrix(row, column))
      end do
    end do
  end subroutine add_entries

  !> Looks for the mass that whirls, where the shaft turns.
  subroutine add_whirl(log, bearing, response, model, found, whirl, problem)
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(frequency_response_type), intent(inout) :: model !! of the frequencies that were asked for
    type(quantity_type), allocatable, intent(inout) :: found(:)
    type(whirl_type), intent(out) :: whirl
    character(len=:), allocatable, intent(inout) :: problem !! what could not be factorized

    call find_critical_mass(bearing, response, log, model, whirl)
    if (whirl%found) then
      call log%line('critical mass '//text(whirl%critical_mass, 5)//' kg on this bearing: heavier rigid shafts whirl, at '// &
                    text(whirl%ratio, 5)//' of the speed')
      call add_result(found, 'critical_mass', whirl%critical_mass)
      call add_result(found, 'whirl_ratio', whirl%ratio)
    else if (whirl%searched) then
      call log%line('no critical mass: no rigid shaft whirls between 0.05 and 1.2 times the speed')
    else
      problem = 'the search for the critical mass: '//response_failure(response)
    end if
  end subroutine add_whirl

  !> Looks for the mass that the supply, or gas in deep grooves, makes grow along the axis.
  subroutine add_hammer(log, bearing, response, model, found, problem)
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(in) :: bearing !! that is fed or has grooves
    type(dynamic_response_type), intent(inout) :: response
    type(frequency_response_type), intent(inout) :: model !! of the frequencies that were asked for
    type(quantity_type), allocatable, intent(inout) :: found(:)
    character(len=:), allocatable, intent(inout) :: problem !! what could not be factorized
    type(hammer_type) :: hammer

    call find_hammer(bearing, response, log, model, hammer)
    if (hammer%found) then
      call log%line('pneumatic hammer: runners heavier than the critical mass of '//text(hammer%critical_mass, 5)// &
                    ' kg grow along the axis, at '//text(hammer%frequency, 5)//' rad/s')
      call add_result(found, 'critical_mass', hammer%critical_mass)
      call add_result(found, 'hammer_frequency', hammer%frequency)
    else if (hammer%searched .and. hammer%always) then
      call log%line('pneumatic hammer: the film drives motions along the axis at all frequencies up to 1e6 rad/s')
    else if (hammer%searched) then
      call log%line('no pneumatic hammer: the film damps motions along the axis at all frequencies')
    else
      problem = 'the search for pneumatic hammer: '//response_failure(response)
    end if
  end subroutine add_hammer

  !> Looks for the rotor's mode along its axis.
  subroutine add_axial_mode(scene, log, bearing, response, frequency, found)
    type(scene_type), intent(in) :: scene !! of a thrust bearing with a rotor
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    real(wp), intent(in) :: frequency !! of the table, where the search begins [rad/s]
    type(quantity_type), allocatable, intent(inout) :: found(:)
    type(rotor_mode_type) :: mode
    logical :: is_found

    if (scene%dynamics%loss_factor > 0.0_wp) then
      call log%line('axial mode: none, for a loss factor is defined for steady vibrations alone')
      return
    end if
    call find_axial_mode(bearing, response, scene%rotor%mass, frequency, mode%rate, is_found)
    if (.not. is_found) then
      call log%line('axial mode: not found')
      return
    end if
    call log%line('axial mode of '//text(scene%rotor%mass, digits)//' kg: '//text(aimag(mode%rate), mode_digits)//' rad/s, changes as exp('// &
                  text(real(mode%rate, wp), mode_digits)//' t), damping ratio '//text(damping_ratio(mode), mode_digits))
    call add_result(found, 'axial_frequency', aimag(mode%rate))
    call add_result(found, 'growth_rate', real(mode%rate, wp))
    call add_result(found, 'damping_ratio', damping_ratio(mode))
  end subroutine add_axial_mode

  !> Says how the rotor moves.
  subroutine show_rotor(log, speed, briefly, known, mass, answer)
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    logical, intent(in) :: briefly !! without the table of modes
    type(quantity_type), intent(in) :: known(:) !! critical mass, where one was found
    real(wp), intent(in) :: mass !! of the rotor on this bearing [kg]
    type(rotor_answer_type), intent(in) :: answer !! its modes
    logical, allocatable :: listed(:)
    integer :: i

    if (.not. answer%defined) then
      call log%judged('rotor: no growth rates, for a loss factor is defined for steady vibrations alone; '//by_mass(known, mass), &
                      mass <= number_in(known, 'critical_mass', huge(mass)))
    else if (.not. answer%found) then
      call log%line('rotor: its modes were not found: '//answer%reason)
    else
      if (.not. briefly) then
        call log%line('modes: frequency [rad/s] (over speed), growth [1/s], damping ratio, rotor''s share')
        listed = damping_ratio(answer%mode) < dead .or. .not. is_of_shaft(answer%mode%owner) .and. real(answer%mode%rate) > 0.0_wp
        do i = 1, size(answer%mode)
          if (listed(i)) call log%line(mode_words(speed, answer%mode(i)))
        end do
        call log%line(text(count(.not. listed))//' more die out in less than a turn of their own')
        if (.not. answer%counted) call log%line('modes are not counted, as by factors: iterations have no determinant')
      end if
      if (answer%decides > 0) call log%judged('rotor: '//state_words(speed, answer%mode(answer%decides)), &
                                              real(answer%mode(answer%decides)%rate, wp) <= 0.0_wp)
      if (answer%decides == 0) call log%line('rotor: none of the modes found is the rotor''s')
      if (answer%decides > 1) call log%line('less damped: '//other_words(speed, answer%mode(1)))
      if (answer%foil_grows) then
        call log%warning('film or foil move by themselves: a mode grows in which the rotor has no share, so this '// &
                         'equilibrium is unstable, and the rotor''s growth rate means nothing')
      end if
    end if
  end subroutine show_rotor

  !> What the critical mass says of a rotor.
  pure function by_mass(known, mass) result(words)
    type(quantity_type), intent(in) :: known(:)
    real(wp), intent(in) :: mass !! [kg]
    character(len=:), allocatable :: words
    integer :: place

    words = 'no mass whirls in x and y'
    place = place_of('critical_mass', known)
    if (place == 0) return
    words = 'it is lighter than the critical mass: stable in x and y'
    if (mass > known(place)%number) words = 'it is heavier than the critical mass: it whirls'
  end function by_mass

  !> A mode as a line of the table.
  function mode_words(speed, mode) result(words)
    real(wp), intent(in) :: speed !! [rad/s]
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = text(aimag(mode%rate), mode_digits)//' ('//text(aimag(mode%rate)/speed, mode_digits)//'), '// &
            text(real(mode%rate, wp), mode_digits)//', '//text(damping_ratio(mode), mode_digits)//', '//text(mode%share, 3)//', '
    if (.not. is_of_shaft(mode%owner)) then
      words = words//trim(owners(mode%owner))
    else
      words = words//motion_words(mode)
    end if
  end function mode_words

  !> What the rotor does in a mode, and whether the foil vibrates as much.
  function motion_words(mode) result(words)
    type(rotor_mode_type), intent(in) :: mode !! the rotor's, or both's
    character(len=:), allocatable :: words

    words = trim(merge('conical    ', 'cylindrical', mode%kind == conical))//sense_words(mode)
    if (mode%owner == of_both) words = words//', rotor and foil: the rotor has '//text(100.0_wp*mode%moving_share, 2)// &
                                       ' % of what moves'
  end function motion_words

  !> Which way a mode goes round.
  pure function sense_words(mode) result(words)
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = ''
    if (aimag(mode%rate) > 0.0_wp) words = ' '//words_of_sense(mode%sense)
  end function sense_words

  !> A mode of foil or film that is damped less than all of the rotor.
  function other_words(speed, mode) result(words)
    real(wp), intent(in) :: speed !! [rad/s]
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = 'a mode of the '//trim(owners(mode%owner))//' at '//text(aimag(mode%rate)/speed, mode_digits)// &
            ' of the speed that changes as exp('//text(real(mode%rate, wp), mode_digits)//' t)'
  end function other_words

  !> What the mode that decides says.
  function state_words(speed, mode) result(words)
    real(wp), intent(in) :: speed !! [rad/s]
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = 'stable, its'
    if (real(mode%rate, wp) > 0.0_wp) words = 'unstable, its'
    words = words//' least damped mode ('//motion_words(mode)//') is at '//text(aimag(mode%rate)/speed, mode_digits)//' of the speed and changes as exp('// &
            text(real(mode%rate, wp), mode_digits)//' t), damping ratio '//text(damping_ratio(mode), mode_digits)
  end function state_words

  !> Damping over critical damping.
  elemental real(wp) function damping_ratio(mode) result(ratio)
    type(rotor_mode_type), intent(in) :: mode
    ratio = -real(mode%rate, wp)/abs(mode%rate)
  end function damping_ratio

  !> Adds the least damped mode of the rotor, and of any kind, to results, where there is one.
  subroutine add_rotor(answer, found)
    type(rotor_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: found(:)

    if (.not. answer%found) return
    if (size(answer%mode) > 0) then
      call add_result(found, 'largest_growth_rate', real(answer%mode(1)%rate, wp))
      call add_result(found, 'largest_growth_frequency', aimag(answer%mode(1)%rate))
    end if
    if (answer%decides == 0) return
    associate (mode => answer%mode(answer%decides))
      call add_result(found, 'growth_rate', real(mode%rate, wp))
      call add_result(found, 'whirl_frequency', aimag(mode%rate))
      call add_result(found, 'damping_ratio', damping_ratio(mode))
    end associate
  end subroutine add_rotor

  !> The modes as numbers that are kept.
  pure function mode_matrix(answer) result(matrix)
    type(rotor_answer_type), intent(in) :: answer !! its modes
    real(wp), allocatable :: matrix(:, :) !! (number, mode) as `gfb_dynamics_record` has them [SI]
    integer :: i

    allocate (matrix(mode_numbers, merge(size(answer%mode), 0, answer%found)))
    do i = 1, size(matrix, 2)
      associate (mode => answer%mode(i))
        matrix(:, i) = [aimag(mode%rate), real(mode%rate, wp), damping_ratio(mode), mode%share, real(mode%kind, wp), mode%sense, &
                        mode%foil_share, mode%moving_share, real(mode%owner, wp)]
      end associate
    end do
  end function mode_matrix
end module gfb_dynamics
