!> A bearing's answer as results, and how the log shows it.
module gfb_bearing_summary
  use gfb_kinds, only: wp
  use gfb_film_surface, only: axial => axial_coordinate
  use gfb_units, only: degrees, ice_point
  use gfb_quantity, only: quantity_type, quantity_word, quantity_truth, add_quantity, place_of
  use gfb_result_names, only: add_result
  use gfb_result_table, only: film_and_contact, film_and_contact_brake, of_pads, of_foil, of_cone
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text, engineering_text
  use gfb_bearing_answer, only: bearing_answer_type
  use gfb_feed_answer, only: feed_answer_type
  use gfb_groove_answer, only: groove_answer_type
  use gfb_heat_answer, only: heat_answer_type, heat_share_type
  use gfb_modulus_law, only: is_usual_modulus, usual_words
  implicit none (type, external)
  private
  public :: answer_quantities, cost_quantities, add_counts, show_closing_block, &
            asked_first

  real(wp), parameter :: no_direction = 1.0e-12_wp !! vectors smaller than this have none, relative

  !> What an answer cost.
  type, public :: cost_type
    integer :: unknowns = 0
    integer :: newton_iterations = 0
    integer :: factorizations = 0
    integer :: factorizations_finest = 0 !! of the matrix of the finest mesh
    real(wp) :: wall_time = 0.0_wp   !! [s]
    real(wp) :: peak_memory = 0.0_wp !! of all ranks [B]
  end type cost_type

  !> Of an edge off its bumps, over the clearance: another equilibrium is likely [1].
  real(wp), parameter :: lifted = 0.02_wp

  !> What an analysis is asked for, in the order in which summary and closing block begin with it;
  !> what a scene does not have is absent.
  character(len=*), parameter :: asked(*) = [character(len=28) :: &
    'load_capacity', 'load_capacity_coefficient', 'load_capacity_coefficient_si', &
    'lift_off_speed_rpm', 'lift_off_supply_pressure', 'misalignment_allowance', &
    'limit_reached', 'not_reached', 'ending', 'onset_speed_rpm', 'critical_mass', 'growth_rate', &
    'time', 'turns', 'orbit_x', 'orbit_y', 'minimum_gap_over_time', 'film_margin', &
    'temperature_margin', 'stress_margin']
  integer, parameter :: digits = 6, label = 16 !! of their lines

contains

  !> Quantities of one answer.
  function answer_quantities(analysis, converged, answer, clearance, force_scale) result(list)
    character(len=*), intent(in) :: analysis !! as the user types it
    logical, intent(in) :: converged !! it is an answer, not the last state reached
    type(bearing_answer_type), intent(in) :: answer !! forces, gaps and pressures
    real(wp), intent(in) :: clearance        !! C [m]
    real(wp), intent(in) :: force_scale      !! size of a force [N]
    type(quantity_type), allocatable :: list(:)

    call add_result(list, 'analysis', analysis)
    call add_result(list, 'converged', converged)
    if (answer%ring%present) then
      call add_ring(answer, list)
      return
    end if
    call add_result(list, 'eccentricity_x', answer%place(1))
    call add_result(list, 'eccentricity_y', answer%place(2))
    if (answer%moves_along) call add_result(list, 'axial_eccentricity', answer%place(axial))
    if (norm2(answer%place(:2)) > no_direction*clearance .and. &
        norm2(answer%force(1:2)) > no_direction*force_scale) then
      call add_result(list, 'attitude_angle', attitude_angle(answer)*degrees)
    end if
    call add_loads(answer, list)
    call add_result(list, 'power_loss', answer%power_loss)
    call add_result(list, 'minimum_gap', answer%minimum_gap)
    call add_result(list, 'minimum_gap_midplane', answer%minimum_gap_midplane)
    call add_result(list, 'minimum_gap_edge', answer%minimum_gap_edge)
    call add_result(list, 'maximum_pressure', answer%maximum_pressure)
    call add_result(list, 'minimum_pressure', answer%minimum_pressure)
    call add_result(list, 'maximum_peclet', answer%maximum_peclet)
    if (allocated(answer%pad_gap)) call add_pads(answer, list)
    if (answer%feed%present) call add_feed(answer%feed, list)
    if (answer%grooves%present) call add_grooves(answer%grooves, list)
    if (answer%heat%present) call add_heat(answer%heat, .true., list)
    if (answer%has_foils) then
      call add_result(list, 'leading_edge_lift', answer%leading_edge_lift(1))
      call add_result(list, 'leading_edge_lift_edge', answer%leading_edge_lift(2))
      call add_result(list, 'trailing_edge_lift', answer%trailing_edge_lift(1))
      call add_result(list, 'trailing_edge_lift_edge', answer%trailing_edge_lift(2))
      call add_result(list, 'lifted_length', answer%lifted_length)
    end if
    call add_stresses(answer, list)
    call add_lines(answer, list)
    if (answer%has_solid_contact) then
      call add_result(list, 'solid_contact_force_x', answer%solid_force(1))
      call add_result(list, 'solid_contact_force_y', answer%solid_force(2))
      call add_result(list, 'solid_contact_torque', answer%solid_torque)
      call add_result(list, 'maximum_solid_contact_pressure', answer%maximum_solid_pressure)
    end if
  end function answer_quantities

  !> Adds a thrust bearing's answer.
  subroutine add_ring(answer, list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i, copies, solved

    associate (ring => answer%ring)
      call add_result(list, 'axial_gap', -answer%place(axial))
      call add_result(list, 'tilt_x', answer%place(4), of_pads)
      call add_result(list, 'tilt_y', answer%place(5), of_pads)
      call add_result(list, 'axial_force', answer%force(axial))
      call add_result(list, 'mean_pressure', answer%force(axial)/ring%area)
      call add_result(list, 'torque_x', answer%force(4))
      call add_result(list, 'torque_y', answer%force(5))
      call add_result(list, 'friction_torque', answer%friction_torque)
      call add_result(list, 'power_loss', answer%power_loss)
      call add_result(list, 'minimum_gap', answer%minimum_gap)
      call add_result(list, 'minimum_gap_radius', answer%thinnest(1))
      call add_result(list, 'minimum_gap_angle', answer%thinnest(2))
      if (ring%sides > 1) then
        call add_result(list, 'opposite_gap', ring%opposite_gap)
        call add_result(list, 'opposite_force', ring%opposite_force)
        call add_result(list, 'opposite_minimum_gap', ring%opposite_smallest)
      end if
      call add_result(list, 'maximum_pressure', answer%maximum_pressure)
      call add_result(list, 'minimum_pressure', answer%minimum_pressure)
      if (ring%centre(1) > 0.0_wp) then
        call add_result(list, 'centre_radius', ring%centre(1))
        call add_result(list, 'centre_angle', ring%centre(2))
      end if
      call add_result(list, 'maximum_deflection', answer%maximum_deflection, of_foil)
      if (answer%has_foils) then
        call add_result(list, 'deflection_trailing_inner', ring%trailing_deflection(1))
        call add_result(list, 'deflection_trailing_outer', ring%trailing_deflection(2))
        call add_result(list, 'lifted_length', answer%lifted_length)
      end if
      call add_result(list, 'maximum_peclet', answer%maximum_peclet)
      if (answer%feed%present) call add_feed(answer%feed, list)
      if (answer%grooves%present) call add_grooves(answer%grooves, list)
      if (answer%heat%present) call add_heat(answer%heat, .false., list)
      call add_result(list, 'pads_solved', ring%pads_solved)
    end associate
    call add_stresses(answer, list)
    call add_lines(answer, list)
    copies = answer%ring%pads/answer%ring%pads_solved
    do i = 1, merge(answer%ring%pads, 0, answer%ring%pads > 1)
      solved = (i - 1)/copies + 1
      if (allocated(answer%pad_gap)) then
        call add_result(list, 'axial_force_'//text(i), answer%pad_force(axial, solved)/copies)
        call add_result(list, 'minimum_gap_'//text(i), answer%pad_gap(solved))
      else ! equal ones
        call add_result(list, 'axial_force_'//text(i), answer%force(axial)/answer%ring%pads)
        call add_result(list, 'minimum_gap_'//text(i), answer%minimum_gap)
      end if
    end do
  end subroutine add_ring

  !> Adds the largest stresses of the foils.
  subroutine add_stresses(answer, list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: list(:)

    if (.not. allocated(answer%foil_stress)) return
    call add_result(list, 'maximum_top_foil_stress', answer%foil_stress(1))
    if (size(answer%foil_stress) == 1) return ! a plate on springs
    call add_result(list, 'maximum_bump_foil_stress', answer%foil_stress(2))
  end subroutine add_stresses

  !> Adds what the crests carry.
  subroutine add_lines(answer, list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i

    if (.not. allocated(answer%line_force)) return
    do i = 1, size(answer%line_force)
      call add_result(list, 'line_force_'//text(i), answer%line_force(i))
    end do
  end subroutine add_lines

  !> Adds what presses on sleeve and shaft.
  subroutine add_loads(answer, list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=:), allocatable :: by, braking !! the meanings' own words without solid contact

    if (answer%has_solid_contact) then
      by = film_and_contact
      braking = film_and_contact_brake
    end if
    call add_result(list, 'force_x', answer%force(1), by)
    call add_result(list, 'force_y', answer%force(2), by)
    if (answer%moves_along) call add_result(list, 'axial_force', answer%force(axial), of_cone)
    call add_result(list, 'torque_x', answer%force(4), by)
    call add_result(list, 'torque_y', answer%force(5), by)
    call add_result(list, 'torque_x_without_suction', answer%force_without_suction(4))
    call add_result(list, 'torque_y_without_suction', answer%force_without_suction(5))
    call add_result(list, 'friction_torque', answer%friction_torque, braking)
  end subroutine add_loads

  !> Adds what the supply gives.
  subroutine add_feed(feed, list)
    type(feed_answer_type), intent(in) :: feed
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i

    call add_result(list, 'supply_flow', feed%flow)
    call add_result(list, 'supply_power', feed%power)
    if (.not. allocated(feed%orifice)) return
    call add_result(list, 'choked_orifices', feed%choked)
    call add_result(list, 'backflow_orifices', feed%backflow)
    do i = 1, size(feed%orifice)
      call add_result(list, 'orifice_flow_'//text(i), feed%orifice(i))
      call add_result(list, 'mouth_pressure_'//text(i), feed%pressure(i))
    end do
  end subroutine add_feed

  !> Adds what grooves do to the film.
  subroutine add_grooves(grooves, list)
    type(groove_answer_type), intent(in) :: grooves
    type(quantity_type), allocatable, intent(inout) :: list(:)

    call add_result(list, 'pumped_pressure', grooves%pumped)
    call add_result(list, 'flow_low', grooves%flow(1))
    call add_result(list, 'flow_high', grooves%flow(2))
    if (grooves%weighed) call add_result(list, 'groove_end_loss', grooves%end_loss)
  end subroutine add_grooves

  !> Adds temperatures, and where the heat goes.
  subroutine add_heat(heat, grows, list)
    type(heat_answer_type), intent(in) :: heat
    logical, intent(in) :: grows !! there is a clearance, which may
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i

    associate (whole => heat%whole)
      call add_result(list, 'film_temperature', whole%film_temperature)
      call add_result(list, 'maximum_film_temperature', whole%maximum_film_temperature)
      call add_result(list, 'top_foil_temperature', whole%top_foil_temperature)
      call add_result(list, 'maximum_top_foil_temperature', whole%maximum_top_foil_temperature)
      call add_result(list, 'shaft_temperature', heat%shaft_temperature)
      call add_result(list, 'sleeve_temperature', heat%sleeve_temperature)
      call add_result(list, 'inlet_temperature', whole%inlet_temperature)
      if (heat%has_cooling) then
        call add_result(list, 'cooling_outlet_temperature', heat%cooling_outlet_temperature)
      end if
      call add_result(list, 'heat_to_shaft', whole%to_shaft)
      call add_result(list, 'heat_to_top_foil', whole%to_top_foil)
      call add_result(list, 'heat_through_bumps', whole%through_bumps)
      call add_result(list, 'heat_to_channel', whole%to_channel)
      call add_result(list, 'heat_by_gas', whole%by_gas)
      if (heat%is_fed) call add_result(list, 'heat_by_supply', whole%by_supply)
      call add_result(list, 'mass_flow_leading_edge', whole%leading)
      call add_result(list, 'mass_flow_trailing_edge', whole%trailing)
      call add_result(list, 'mass_flow_sides', whole%sides)
      if (grows) call add_result(list, 'running_clearance', heat%running_clearance)
      if (grows .and. heat%preload > 0.0_wp) then
        call add_result(list, 'running_play', heat%running_clearance - heat%preload)
      end if
      call add_result(list, 'energy_imbalance', heat%imbalance)
      if (heat%softens) call add_moduli('', whole)
    end associate
    do i = 1, merge(size(heat%pad), 0, size(heat%pad) > 1)
      associate (pad => heat%pad(i))
        call add_result(list, 'film_temperature_'//text(i), pad%film_temperature)
        call add_result(list, 'maximum_film_temperature_'//text(i), pad%maximum_film_temperature)
        call add_result(list, 'top_foil_temperature_'//text(i), pad%top_foil_temperature)
        call add_result(list, 'maximum_top_foil_temperature_'//text(i), &
                        pad%maximum_top_foil_temperature)
        call add_result(list, 'inlet_temperature_'//text(i), pad%inlet_temperature)
        call add_result(list, 'heat_to_shaft_'//text(i), pad%to_shaft)
        call add_result(list, 'heat_to_top_foil_'//text(i), pad%to_top_foil)
        call add_result(list, 'heat_through_bumps_'//text(i), pad%through_bumps)
        call add_result(list, 'heat_to_channel_'//text(i), pad%to_channel)
        call add_result(list, 'heat_by_gas_'//text(i), pad%by_gas)
        if (heat%is_fed) call add_result(list, 'heat_by_supply_'//text(i), pad%by_supply)
        if (heat%softens) call add_moduli('_'//text(i), pad)
      end associate
    end do

  contains

    !> Adds what is left of the moduli of foils.
    subroutine add_moduli(behind, share)
      character(len=*), intent(in) :: behind !! the name
      type(heat_share_type), intent(in) :: share
      if (heat%top_foil_bends) then
        call add_result(list, 'modulus_ratio_top_foil'//behind, share%modulus(1))
      end if
      call add_result(list, 'modulus_ratio_bumps'//behind, share%modulus(2))
    end subroutine add_moduli
  end subroutine add_heat

  !> Adds what each of several pads does.
  subroutine add_pads(answer, list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i

    do i = 1, size(answer%pad_gap)
      call add_result(list, 'force_x_'//text(i), answer%pad_force(1, i))
      call add_result(list, 'force_y_'//text(i), answer%pad_force(2, i))
      call add_result(list, 'minimum_gap_'//text(i), answer%pad_gap(i))
      if (.not. answer%has_foils) cycle
      call add_result(list, 'leading_edge_lift_'//text(i), answer%pad_lift(1, i))
      call add_result(list, 'leading_edge_lift_edge_'//text(i), answer%pad_lift(2, i))
    end do
  end subroutine add_pads

  !> Quantities of what it cost.
  function cost_quantities(cost) result(list)
    type(cost_type), intent(in) :: cost !! of the whole run
    type(quantity_type), allocatable :: list(:)

    call add_result(list, 'unknowns', cost%unknowns)
    call add_counts(cost%newton_iterations, cost%factorizations, list)
    call add_result(list, 'factorizations_finest', cost%factorizations_finest)
    call add_result(list, 'wall_time', cost%wall_time)
    call add_result(list, 'peak_memory', cost%peak_memory)
  end function cost_quantities

  !> Adds what was counted from the start of the run to an answer.
  pure subroutine add_counts(newton_iterations, factorizations, list)
    integer, intent(in) :: newton_iterations, factorizations !! so far
    type(quantity_type), allocatable, intent(inout) :: list(:) !! gets two quantities

    call add_result(list, 'newton_iterations', newton_iterations)
    call add_result(list, 'factorizations', factorizations)
  end subroutine add_counts

  !> Angle from the load's direction to that of the shaft's centre, -e, in (-pi, pi] [rad].
  pure real(wp) function attitude_angle(answer) result(angle)
    type(bearing_answer_type), intent(in) :: answer !! with eccentricity and force

    associate (e => answer%place(:2), f => answer%force)
      angle = atan2(-f(1)*e(2) + f(2)*e(1), -f(1)*e(1) - f(2)*e(2))
    end associate
  end function attitude_angle

  !> Direction of a vector, from x towards y, in [0, 360) [deg].
  pure real(wp) function direction_of(vector) result(angle)
    real(wp), intent(in) :: vector(2) !! in any unit
    angle = modulo(atan2(vector(2), vector(1))*degrees, 360.0_wp)
  end function direction_of

  !> The answer in the units an engineer reads.
  subroutine show_closing_block(log, summary, converged, place, answer, clearance, cost, ranks, &
                                blas)
    type(run_log_type), intent(in) :: log !! where lines go
    type(quantity_type), intent(in) :: summary(:) !! what was asked for stands in it
    logical, intent(in) :: converged !! it is an answer, not the last state reached
    character(len=*), intent(in) :: place !! point of the sweep, in words; empty without one
    type(bearing_answer_type), intent(in) :: answer !! to be shown
    real(wp), intent(in) :: clearance     !! C [m]
    type(cost_type), intent(in) :: cost !! of the whole run
    integer, intent(in) :: ranks !! number of MPI ranks
    character(len=*), intent(in) :: blas  !! library in use

    if (converged) then
      call log%heading('answer')
    else
      call log%heading('last state reached, not the answer')
    end if
    if (place /= '') call log%line('point            '//place)
    call show_asked(log, summary)
    if (answer%ring%present) then
      call show_bearing_of_runner(log, answer)
    else
      call show_bearing_of_shaft(log, answer)
    end if
    call log%line('power loss       '//engineering_text(answer%power_loss, 'W', 1.0_wp)// &
                  '   friction torque '// &
                  engineering_text(answer%friction_torque, 'mN m', 1.0e3_wp))
    if (answer%feed%present) call show_feed(log, answer%feed)
    if (answer%grooves%present) call show_grooves(log, answer%grooves)
    if (answer%heat%present) call show_heat(log, answer%heat, .not. answer%ring%present)
    call log%line('pressure         '// &
                  engineering_text(answer%minimum_pressure, 'to', 1.0e-3_wp)//' '// &
                  engineering_text(answer%maximum_pressure, 'kPa', 1.0e-3_wp))
    if (answer%ring%present) then
      call show_runner(log, answer)
    else
      call show_shaft(log, answer, clearance)
    end if
    if (allocated(answer%foil_stress)) call show_stresses(log, answer%foil_stress)
    call log%line('largest Peclet   '//text(answer%maximum_peclet, 3))
    call log%line('cost             '//text(cost%unknowns)//' unknowns, '// &
                  text(cost%newton_iterations)//' iterations, '//text(cost%factorizations)// &
                  ' factorizations, '//text(cost%wall_time, 3)//' s, '// &
                  text(cost%peak_memory*1.0e-6_wp, 3)//' MB, '// &
                  text(ranks)//' rank(s), BLAS '//blas)
  end subroutine show_closing_block

  !> The largest stresses of the foils.
  subroutine show_stresses(log, stress)
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: stress(:) !! of top foil and bumps, where these have a mesh [Pa]
    character(len=:), allocatable :: words

    words = 'top foil '//engineering_text(stress(1), 'MPa', 1.0e-6_wp)
    if (size(stress) > 1) words = words//', bumps '//engineering_text(stress(2), 'MPa', 1.0e-6_wp)
    call log%line('largest stress   '//words//' (von Mises)')
  end subroutine show_stresses

  !> What a thrust bearing bears, and on which film.
  subroutine show_bearing_of_runner(log, answer)
    type(run_log_type), intent(in) :: log
    type(bearing_answer_type), intent(in) :: answer

    associate (ring => answer%ring)
      call log%line('minimum gap      '//engineering_text(answer%minimum_gap, 'um', 1.0e6_wp)// &
                    '   at radius '//engineering_text(answer%thinnest(1), 'mm', 1.0e3_wp)//', '// &
                    engineering_text(answer%thinnest(2), 'deg', degrees))
      call log%line('axial force      '//engineering_text(answer%force(axial), 'N', 1.0_wp)// &
                    '   mean pressure '//engineering_text(answer%force(axial)/ring%area, 'kPa', &
                                                          1.0e-3_wp)//' over ambient')
      if (ring%sides > 1) then
        call log%line('runner''s other side: axial gap '// &
                      engineering_text(ring%opposite_gap, 'um', 1.0e6_wp)//', force '// &
                      engineering_text(ring%opposite_force, 'N', 1.0_wp)//', minimum gap '// &
                      engineering_text(ring%opposite_smallest, 'um', 1.0e6_wp))
      end if
    end associate
  end subroutine show_bearing_of_runner

  !> What the supply gives.
  subroutine show_feed(log, feed)
    type(run_log_type), intent(in) :: log
    type(feed_answer_type), intent(in) :: feed
    character(len=:), allocatable :: words

    words = 'supply           '//engineering_text(feed%flow, 'g/s', 1.0e3_wp)//'   power '// &
            engineering_text(feed%power, 'W', 1.0_wp)//' to compress it'
    if (feed%choked > 0) words = words//'; '//text(feed%choked)//' orifice(s) choked'
    if (feed%backflow > 0) then
      words = words//'; gas leaves the film through '//text(feed%backflow)//' orifice(s)'
    end if
    call log%line(words)
  end subroutine show_feed

  !> The line of a film with grooves in the log.
  subroutine show_grooves(log, grooves)
    type(run_log_type), intent(in) :: log
    type(groove_answer_type), intent(in) :: grooves

    call log%line('grooves          pumped up by '// &
                  engineering_text(grooves%pumped, 'kPa', 1.0e-3_wp)//'; out of the ends '// &
                  text(grooves%flow(1), 3)//', '//text(grooves%flow(2), 3)//' Pa m3/s')
  end subroutine show_grooves

  !> Where the runner is, and what the foils do.
  subroutine show_runner(log, answer)
    type(run_log_type), intent(in) :: log
    type(bearing_answer_type), intent(in) :: answer
    character(len=:), allocatable :: whose

    associate (ring => answer%ring)
      if (ring%centre(1) > 0.0_wp) then
        call log%line('                 centre on pad 1 at radius '// &
                      engineering_text(ring%centre(1), 'mm', 1.0e3_wp)//', '// &
                      engineering_text(ring%centre(2), 'deg', degrees)//' from its leading edge')
      end if
      if (answer%maximum_deflection > 0.0_wp) then
        call log%line('deflection       '//engineering_text(answer%maximum_deflection, 'um', &
                                                            1.0e6_wp)//' at most')
      end if
      if (answer%has_foils) then
        whose = ''
        if (allocated(answer%pad_gap)) then
          whose = 'of pad '//text(ring%thinnest_pad)//', where the film is thinnest, '
        end if
        call log%line('trailing edge    '//whose//'deflected by '// &
                      pair(ring%thinnest_deflection, 'um', 1.0e6_wp)//' inside and outside')
        call show_crests(log, answer)
      end if
      call log%line('axial gap        '//engineering_text(-answer%place(axial), 'um', 1.0e6_wp)// &
                    '   tilt '//pair(answer%place(4:5), 'mrad', 1.0e3_wp)// &
                    ', torque on shaft '//pair(answer%force(4:5), 'mN m', 1.0e3_wp))
    end associate
  end subroutine show_runner

  !> How much of the crests touches nothing.
  subroutine show_crests(log, answer)
    type(run_log_type), intent(in) :: log
    type(bearing_answer_type), intent(in) :: answer
    call log%line('crests           '//text(100.0_wp*answer%lifted_length, 3)// &
                  ' % of their length touch nothing')
  end subroutine show_crests

  !> What a journal bearing bears, and on which film.
  subroutine show_bearing_of_shaft(log, answer)
    type(run_log_type), intent(in) :: log
    type(bearing_answer_type), intent(in) :: answer
    character(len=:), allocatable :: place

    place = ''
    if (all(abs(answer%thinnest) < huge(0.0_wp))) then ! of a film that is a number somewhere
      place = 'at theta = '//text(modulo(answer%thinnest(2)*degrees, 360.0_wp), 4)// &
              ' deg, z = '//engineering_text(answer%thinnest(1), 'mm', 1.0e3_wp)//'; '
    end if
    call log%line('minimum gap      '//engineering_text(answer%minimum_gap, 'um', 1.0e6_wp)// &
                  '   '//place//'midplane '// &
                  engineering_text(answer%minimum_gap_midplane, 'um', 1.0e6_wp)//', edge '// &
                  engineering_text(answer%minimum_gap_edge, 'um', 1.0e6_wp))
    call log%line(forces_of(answer)//' force       '//pair(answer%force(1:2), 'N', 1.0_wp))
    if (allocated(answer%pad_gap)) call show_pads(log, answer)
    if (answer%has_solid_contact) then
      call log%line('solid contact    '//pair(answer%solid_force(1:2), 'N', 1.0_wp)// &
                    ' of the force, friction torque '// &
                    engineering_text(answer%solid_torque, 'mN m', 1.0e3_wp))
    end if
  end subroutine show_bearing_of_shaft

  !> Where the shaft is, and what the foils do.
  subroutine show_shaft(log, answer, clearance)
    type(run_log_type), intent(in) :: log
    type(bearing_answer_type), intent(in) :: answer
    real(wp), intent(in) :: clearance !! C [m]

    if (answer%has_foils) then
      call log%line('top foil edges   leading '//lifts(answer%leading_edge_lift)//', trailing '// &
                    lifts(answer%trailing_edge_lift)//' um off the bumps (midplane, ends'// &
                    mean_of(size(answer%pad_lift, 2))//')')
      call show_crests(log, answer)
      if (max(maxval(answer%pad_lift), maxval(answer%trailing_edge_lift)) > lifted*clearance) then
        call log%line('                 an edge is lifted; it may lie on its bumps, too: '// &
                      'gfb --branches lists equilibria')
      end if
    end if
    if (answer%moves_along) then
      call log%line('along the axis   '// &
                    engineering_text(answer%place(axial), 'um', 1.0e6_wp)//'   film force '// &
                    engineering_text(answer%force(axial), 'N', 1.0_wp))
    end if
    call log%line('eccentricity     '//pair(answer%place(:2), 'um', 1.0e6_wp)// &
                  '   over C '//text(answer%place(1)/clearance, 5)//', '// &
                  text(answer%place(2)/clearance, 5))
    call log%line('attitude angle   '// &
                  engineering_text(attitude_angle(answer), 'deg', degrees)//'   from '// &
                  forces_of(answer)//' force (in equilibrium the load), at '// &
                  text(direction_of(answer%force(1:2)), 4)// &
                  ' deg, to the shaft''s centre, -e, at '// &
                  text(direction_of(-answer%place(:2)), 4)//' deg, positive with the rotation')
    call log%line(forces_of(answer)//' torque      '//pair(answer%force(4:5), 'mN m', 1.0e3_wp)// &
                  '   without suction '// &
                  pair(answer%force_without_suction(4:5), 'mN m', 1.0e3_wp))
  end subroutine show_shaft

  !> Of what a value of several pads is the mean; empty for one.
  pure function mean_of(pads) result(words)
    integer, intent(in) :: pads !! how many there are
    character(len=:), allocatable :: words

    words = ''
    if (pads > 1) words = '; mean of '//text(pads)//' pads'
  end function mean_of

  !> Whose forces are reported: the film's alone, or all with those of solid contact.
  pure function forces_of(answer) result(who)
    type(bearing_answer_type), intent(in) :: answer
    character(len=4) :: who
    who = merge('full', 'film', answer%has_solid_contact)
  end function forces_of

  !> Where the heat goes, and how hot all is.
  subroutine show_heat(log, heat, grows)
    type(run_log_type), intent(in) :: log
    type(heat_answer_type), intent(in) :: heat
    logical, intent(in) :: grows !! there is a clearance, which may
    character(len=:), allocatable :: words

    associate (whole => heat%whole)
      call log%line('heat             '//share('to the shaft', whole%to_shaft)//', '// &
                    share('to the top foil', whole%to_top_foil)//', '// &
                    share('by the gas', whole%by_gas))
      if (heat%is_fed) call log%line('  of the supply  '//share('brought in', whole%by_supply))
      if (heat%has_cooling) then
        call log%line('  of top foil    '//share('through the bumps', whole%through_bumps)//', '// &
                      share('to the cooling gas', whole%to_channel))
      end if
      call log%line('temperatures     '//all_temperatures(heat, 0.0_wp)//' K')
      call log%line('                 '//all_temperatures(heat, ice_point)//' C')
      if (heat%has_cooling) then
        call log%line('cooling gas      leaves at '// &
                      tenths(heat%cooling_outlet_temperature)//' K, '// &
                      tenths(heat%cooling_outlet_temperature - ice_point)//' C')
      end if
      if (grows) call show_clearance(log, heat)
      if (heat%softens) then
        words = ''
        if (heat%top_foil_bends) words = text(whole%modulus(1), 4)//' in the top foil, '
        call log%line('modulus          '//words//text(whole%modulus(2), 4)//' in the bumps, '// &
                      'over youngs_modulus')
        if (.not. all(is_usual_modulus(whole%modulus(merge(1, 2, heat%top_foil_bends):)))) then
          call log%warning('modulus of the foils '//words//text(whole%modulus(2), 4)// &
                           ' in the bumps, over youngs_modulus; usual is '//usual_words)
        end if
      end if
      if (heat%off_table) call log%line('note: some foil is hotter or colder than the table or '// &
                    'the slope of its modulus goes: there it is as at the end')
    end associate

  contains

    !> A flow of heat with its part of the power.
    function share(words, flow)
      character(len=*), intent(in) :: words
      real(wp), intent(in) :: flow !! [W]
      character(len=:), allocatable :: share

      share = words//' '//engineering_text(flow, 'W', 1.0_wp)
      if (.not. heat%whole%power > 0.0_wp) return
      share = share//' ('//text(100.0_wp*flow/heat%whole%power, 3)//' %)'
    end function share
  end subroutine show_heat

  !> Temperatures of film, foil, walls and inlet.
  pure function all_temperatures(heat, zero) result(words)
    type(heat_answer_type), intent(in) :: heat
    real(wp), intent(in) :: zero !! of the scale [K]
    character(len=:), allocatable :: words

    associate (whole => heat%whole)
      words = 'film '//tenths(whole%film_temperature - zero)//' (at most '// &
              tenths(whole%maximum_film_temperature - zero)//'), top foil '// &
              tenths(whole%top_foil_temperature - zero)//' ('// &
              tenths(whole%maximum_top_foil_temperature - zero)//'), shaft '// &
              tenths(heat%shaft_temperature - zero)//', sleeve '// &
              tenths(heat%sleeve_temperature - zero)//', inlet '// &
              tenths(whole%inlet_temperature - zero)
    end associate
  end function all_temperatures

  !> A temperature to a tenth of a degree.
  pure function tenths(temperature) result(words)
    real(wp), intent(in) :: temperature !! [K] or [C]
    character(len=:), allocatable :: words
    words = text(0.1_wp*anint(10.0_wp*temperature), 5)
  end function tenths

  !> What room growth leaves the shaft.
  subroutine show_clearance(log, heat)
    type(run_log_type), intent(in) :: log
    type(heat_answer_type), intent(in) :: heat
    character(len=:), allocatable :: play

    play = ''
    if (heat%preload > 0.0_wp) then
      play = '; less '//engineering_text(heat%preload, 'um', 1.0e6_wp)// &
             ' of preload the shaft has a play of '// &
             engineering_text(heat%running_clearance - heat%preload, 'um', 1.0e6_wp)
    end if
    call log%line('clearance        '//engineering_text(heat%running_clearance, &
                                                        'um', 1.0e6_wp)//' when it runs'//play)
  end subroutine show_clearance

  !> What each of several pads does.
  subroutine show_pads(log, answer)
    type(run_log_type), intent(in) :: log
    type(bearing_answer_type), intent(in) :: answer
    integer :: i

    do i = 1, size(answer%pad_gap)
      call log%line('pad '//text(i)//'            '// &
                    'force '//pair(answer%pad_force(:2, i), 'N', 1.0_wp)//', minimum gap '// &
                    engineering_text(answer%pad_gap(i), 'um', 1.0e6_wp))
    end do
  end subroutine show_pads

  !> Lifts at midplane and ends [um].
  pure function lifts(value) result(words)
    real(wp), intent(in) :: value(2) !! [m]
    character(len=:), allocatable :: words
    words = '('//text(value(1)*1.0e6_wp, 3)//', '//text(value(2)*1.0e6_wp, 3)//')'
  end function lifts

  !> Two numbers with their unit.
  pure function pair(numbers, unit, scale) result(words)
    real(wp), intent(in) :: numbers(2)      !! in SI
    character(len=*), intent(in) :: unit    !! of the text
    real(wp), intent(in) :: scale           !! text's number over SI number
    character(len=:), allocatable :: words
    real(wp) :: shown(2)

    shown = numbers*scale
    where (abs(numbers) <= no_direction*norm2(numbers)) shown = 0.0_wp ! round-off
    words = '('//text(shown(1), 4)//', '//text(shown(2), 4)//') '//unit
  end function pair

  !> A summary with what was asked for behind the lines that open it; all else in its order.
  pure function asked_first(list) result(ordered)
    type(quantity_type), intent(in) :: list(:) !! of a summary
    type(quantity_type), allocatable :: ordered(:)
    character(len=*), parameter :: front(*) = [character(len=28) :: 'analysis', 'converged', asked]
    integer :: i, place

    allocate (ordered(0))
    do i = 1, size(front)
      place = place_of(trim(front(i)), list)
      if (place > 0) call add_quantity(ordered, list(place))
    end do
    do i = 1, size(list)
      if (all(front /= list(i)%name)) call add_quantity(ordered, list(i))
    end do
  end function asked_first

  !> Lines of the closing block: what was asked for, with its meaning.
  subroutine show_asked(log, list)
    type(run_log_type), intent(in) :: log !! where lines go
    type(quantity_type), intent(in) :: list(:) !! of a summary
    character(len=:), allocatable :: name
    integer :: i, place, rpm

    do i = 1, size(asked)
      name = trim(asked(i))
      place = place_of(name, list)
      if (place == 0) cycle
      rpm = index(name, '_rpm', back=.true.)
      if (rpm > 1 .and. rpm == len(name) - 3) name = name(:rpm - 1)
      call log%line(with_blanks(name)//' '//value_of(list(place)))
    end do
  end subroutine show_asked

  !> A name in words, as wide as the labels of the block.
  pure function with_blanks(name) result(words)
    character(len=*), intent(in) :: name
    character(len=max(label, len(name))) :: words
    integer :: i

    words = name
    do i = 1, len(name)
      if (name(i:i) == '_') words(i:i) = ' '
    end do
  end function with_blanks

  !> A value in the units an engineer reads, and what it is.
  pure function value_of(quantity) result(words)
    type(quantity_type), intent(in) :: quantity
    character(len=:), allocatable :: words

    select case (quantity%kind)
    case (quantity_word)
      words = quantity%word
      return
    case (quantity_truth)
      words = trim(merge('yes', 'no ', quantity%number > 0.5_wp))
    case default
      select case (quantity%unit)
      case ('m')
        words = text(quantity%number*1.0e6_wp, digits)//' um'
      case ('rad')
        words = text(quantity%number*1.0e3_wp, digits)//' mrad'
      case ('1')
        words = text(quantity%number, digits)
      case default
        words = text(quantity%number, digits)//' '//quantity%unit
      end select
    end select
    words = words//'   '//quantity%meaning
  end function value_of
end module gfb_bearing_summary
