!> The names under which a bearing's answer is written.
module gfb_bearing_summary
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, number_quantity, count_quantity, word_quantity, &
                          truth_quantity, add_quantity
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text, engineering_text
  use gfb_bearing_answer, only: bearing_answer_type
  implicit none (type, external)
  private
  public :: answer_quantities, cost_quantities, count_quantities, attitude_angle, show_closing_block

  real(wp), parameter :: degrees = 180.0_wp/acos(-1.0_wp) !! per radian
  real(wp), parameter :: no_direction = 1.0e-12_wp !! vectors smaller than this have none, relative

  !> What an answer cost.
  type, public :: cost_type
    integer :: unknowns = 0
    integer :: newton_iterations = 0
    integer :: factorizations = 0
    real(wp) :: wall_time = 0.0_wp   !! [s]
    real(wp) :: peak_memory = 0.0_wp !! of all ranks [B]
  end type cost_type

contains

  !> Quantities of one answer.
  function answer_quantities(analysis, converged, answer, clearance, force_scale) result(list)
    character(len=*), intent(in) :: analysis !! as the user types it
    logical, intent(in) :: converged
    type(bearing_answer_type), intent(in) :: answer
    real(wp), intent(in) :: clearance        !! C [m]
    real(wp), intent(in) :: force_scale      !! size of a force [N]
    type(quantity_type), allocatable :: list(:)
    character(len=:), allocatable :: who !! presses on sleeve and shaft
    character(len=:), allocatable :: braking

    who = 'film'
    braking = 'torque with which the film brakes the shaft'
    if (answer%has_solid_contact) then
      who = 'film and solid contact'
      braking = 'torque with which film and solid contact brake the shaft'
    end if
    call add_quantity(list, word_quantity('analysis', analysis, 'kind of analysis'))
    call add_quantity(list, truth_quantity('converged', converged, 'whether the answer was found'))
    call add_quantity(list, number_quantity('eccentricity_x', answer%eccentricity(1), 'm', &
      'e_x, of the sleeve relative to the shaft'))
    call add_quantity(list, number_quantity('eccentricity_y', answer%eccentricity(2), 'm', &
      'e_y, of the sleeve relative to the shaft'))
    if (norm2(answer%eccentricity) > no_direction*clearance .and. &
        norm2(answer%force(1:2)) > no_direction*force_scale) then
      call add_quantity(list, number_quantity('attitude_angle', attitude_angle(answer)*degrees, &
        'deg', 'from the load to the thinnest film, positive in +theta'))
    end if
    call add_quantity(list, number_quantity('force_x', answer%force(1), 'N', who// &
      ' force on the sleeve, x'))
    call add_quantity(list, number_quantity('force_y', answer%force(2), 'N', who// &
      ' force on the sleeve, y'))
    call add_quantity(list, number_quantity('torque_x', answer%force(3), 'N m', who// &
      ' torque on the shaft about x'))
    call add_quantity(list, number_quantity('torque_y', answer%force(4), 'N m', who// &
      ' torque on the shaft about y'))
    call add_quantity(list, number_quantity('torque_x_without_suction', &
      answer%force_without_suction(3), 'N m', 'torque_x of the pressure above ambient'))
    call add_quantity(list, number_quantity('torque_y_without_suction', &
      answer%force_without_suction(4), 'N m', 'torque_y of the pressure above ambient'))
    call add_quantity(list, number_quantity('friction_torque', answer%friction_torque, 'N m', &
      braking))
    call add_quantity(list, number_quantity('power_loss', answer%power_loss, 'W', &
      'friction torque times speed'))
    call add_quantity(list, number_quantity('minimum_gap', answer%minimum_gap, 'm', &
      'smallest film thickness'))
    call add_quantity(list, number_quantity('minimum_gap_midplane', answer%minimum_gap_midplane, &
      'm', 'smallest film thickness at z = 0'))
    call add_quantity(list, number_quantity('minimum_gap_edge', answer%minimum_gap_edge, 'm', &
      'smallest film thickness at the bearing edges'))
    call add_quantity(list, number_quantity('maximum_pressure', answer%maximum_pressure, 'Pa', &
      'largest absolute pressure'))
    call add_quantity(list, number_quantity('minimum_pressure', answer%minimum_pressure, 'Pa', &
      'smallest absolute pressure'))
    call add_quantity(list, number_quantity('maximum_peclet', answer%maximum_peclet, '1', &
      'largest cell Peclet number of the film'))
    if (answer%has_foils) call add_quantity(list, foil_quantities(answer))
    if (answer%has_solid_contact) call add_quantity(list, solid_quantities(answer))
  end function answer_quantities

  !> What asperities of the shaft add.
  function solid_quantities(answer) result(list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type) :: list(4)

    list(1) = number_quantity('solid_contact_force_x', answer%solid_force(1), 'N', &
                              'share of force_x that the solid contact carries')
    list(2) = number_quantity('solid_contact_force_y', answer%solid_force(2), 'N', &
                              'share of force_y that the solid contact carries')
    list(3) = number_quantity('solid_contact_torque', answer%solid_torque, 'N m', &
                              'share of friction_torque that the solid contact has')
    list(4) = number_quantity('maximum_solid_contact_pressure', answer%maximum_solid_pressure, &
                              'Pa', 'largest pressure of the solid contact')
  end function solid_quantities

  !> What foils that are structures add.
  function foil_quantities(answer) result(list)
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type) :: list(5)
    character(len=*), parameter :: meaning = 'way of the top foil''s edge towards the shaft, '

    list(1) = number_quantity('leading_edge_lift', answer%leading_edge_lift(1), 'm', &
                              meaning//'at z = 0')
    list(2) = number_quantity('leading_edge_lift_edge', answer%leading_edge_lift(2), 'm', &
                              meaning//'at the ends of the bearing')
    list(3) = number_quantity('trailing_edge_lift', answer%trailing_edge_lift(1), 'm', &
                              meaning//'at z = 0')
    list(4) = number_quantity('trailing_edge_lift_edge', answer%trailing_edge_lift(2), 'm', &
                              meaning//'at the ends of the bearing')
    list(5) = number_quantity('lifted_length', answer%lifted_length, '1', &
                              'crest length without contact over all of it')
  end function foil_quantities

  !> Quantities of what it cost.
  function cost_quantities(cost) result(list)
    type(cost_type), intent(in) :: cost
    type(quantity_type), allocatable :: list(:)

    call add_quantity(list, count_quantity('unknowns', cost%unknowns, 'unknowns of the equations'))
    call add_quantity(list, count_quantities(cost%newton_iterations, cost%factorizations))
    call add_quantity(list, number_quantity('wall_time', cost%wall_time, 's', &
      'from start to answer'))
    call add_quantity(list, number_quantity('peak_memory', cost%peak_memory, 'B', &
      'sum over ranks of the largest held'))
  end function cost_quantities

  !> What was counted from the start of the run to an answer.
  pure function count_quantities(newton_iterations, factorizations) result(list)
    integer, intent(in) :: newton_iterations, factorizations
    type(quantity_type) :: list(2)

    list(1) = count_quantity('newton_iterations', newton_iterations, 'iterations of all solves')
    list(2) = count_quantity('factorizations', factorizations, &
                             'matrix factorizations of all solves')
  end function count_quantities

  !> Angle from the load's direction to that of the thinnest film, in (-pi, pi] [rad].
  pure function attitude_angle(answer) result(angle)
    type(bearing_answer_type), intent(in) :: answer
    real(wp) :: angle

    associate (e => answer%eccentricity, f => answer%force)
      angle = atan2(-f(1)*e(2) + f(2)*e(1), -f(1)*e(1) - f(2)*e(2))
    end associate
  end function attitude_angle

  !> The answer in the units an engineer reads.
  subroutine show_closing_block(log, converged, answer, clearance, cost, ranks, blas)
    type(run_log_type), intent(in) :: log
    logical, intent(in) :: converged
    type(bearing_answer_type), intent(in) :: answer
    real(wp), intent(in) :: clearance     !! C [m]
    type(cost_type), intent(in) :: cost
    integer, intent(in) :: ranks
    character(len=*), intent(in) :: blas  !! library in use
    character(len=4) :: who

    if (converged) then
      call log%heading('answer')
    else
      call log%heading('last state reached, not the answer')
    end if
    call log%line('eccentricity     '//pair(answer%eccentricity, 'um', 1.0e6_wp)// &
                  '   over C '//text(answer%eccentricity(1)/clearance, 5)//', '// &
                  text(answer%eccentricity(2)/clearance, 5))
    call log%line('attitude angle   '//engineering_text(attitude_angle(answer), 'deg', degrees))
    who = merge('full', 'film', answer%has_solid_contact)
    call log%line(who//' force       '//pair(answer%force(1:2), 'N', 1.0_wp))
    call log%line(who//' torque      '//pair(answer%force(3:4), 'N m', &
      1.0_wp)//'   without suction '// &
                  pair(answer%force_without_suction(3:4), 'N m', 1.0_wp))
    call log%line('minimum gap      '//engineering_text(answer%minimum_gap, 'um', 1.0e6_wp)// &
                  '   midplane '//engineering_text(answer%minimum_gap_midplane, 'um', 1.0e6_wp)// &
                  ', edge '//engineering_text(answer%minimum_gap_edge, 'um', 1.0e6_wp))
    call log%line('pressure         '//engineering_text(answer%minimum_pressure, 'to', &
      1.0e-6_wp)//' '// &
                  engineering_text(answer%maximum_pressure, 'MPa', 1.0e-6_wp))
    if (answer%has_foils) then
      call log%line('top foil edges   leading '//lifts(answer%leading_edge_lift)//', trailing '// &
                    lifts(answer%trailing_edge_lift)//' um off the bumps (midplane, ends)')
      call log%line('crests           '//text(100.0_wp*answer%lifted_length, 3)// &
                    ' % of their length touch nothing')
    end if
    if (answer%has_solid_contact) then
      call log%line('solid contact    '//pair(answer%solid_force(1:2), 'N', 1.0_wp)// &
                    ' of the force, friction torque '// &
                    engineering_text(answer%solid_torque, 'N m', 1.0_wp))
    end if
    call log%line('friction torque  '//engineering_text(answer%friction_torque, 'N m', 1.0_wp)// &
                  '   power loss '//engineering_text(answer%power_loss, 'W', 1.0_wp))
    call log%line('largest Peclet   '//text(answer%maximum_peclet, 3))
    call log%line('cost             '//text(cost%unknowns)//' unknowns, '// &
                  text(cost%newton_iterations)//' iterations, '//text(cost%factorizations)// &
                  ' factorizations, '//text(cost%wall_time, 3)//' s, '// &
                  text(cost%peak_memory*1.0e-6_wp, &
                  3)//' MB, '//text(ranks)//' rank(s), BLAS '//blas)
  end subroutine show_closing_block

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
    words = '('//text(numbers(1)*scale, 4)//', '//text(numbers(2)*scale, 4)//') '//unit
  end function pair
end module gfb_bearing_summary
