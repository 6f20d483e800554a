#include "gfb_petsc.h"
!> What a bearing's study shows and writes.
module gfb_bearing_writing
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_petsc_session, only: this_rank, share_failure
  use gfb_sweep_case, only: sweep_keys
  use gfb_bearing_record, only: bearing_record_type, sweep_name, sweep_unit, add_row
  use gfb_case_file, only: case_array_type, history_row_type, history_values, with_decimal_commas
  use gfb_contact_record, only: add_foil_contacts
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamics_record, only: add_dynamics_arrays, dynamics_table
  use gfb_text_file, only: write_text_file
  use gfb_run_context, only: run_context_type
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_units, only: ice_point
  use gfb_quantity, only: quantity_type, add_quantity, place_of, number_in
  use gfb_result_names, only: add_result
  use gfb_shape_rules, only: thin
  use gfb_bearing_answer, only: bearing_answer_type
  use gfb_bearing_summary, only: cost_type, answer_quantities, cost_quantities, show_closing_block, asked_first
  use gfb_answer_notes, only: show_contact_notes, show_film_notes
  use gfb_tilt_response, only: summary_quantities, show_tilt_response
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_reasons, only: reason_type
  use gfb_outcome, only: add_outcome
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_grid, only: add_foil_grids
  use gfb_provenance, only: blas_in_use
  use gfb_bearing_solution, only: bearing_solution_type
  use gfb_kept_limits, only: add_margins, show_broken_limits
  use gfb_mesh_plan, only: bearing_plan_type
  implicit none (type)
  private
  public :: record_arrays, write_bearing

  integer, parameter :: digits = 5, widest = 8 !! of a number; columns of a table

  !> A column that a table may have.
  type :: column_type
    character(len=26) :: name !! of the result
    character(len=16) :: head !! with the unit of the table
    real(wp) :: scale         !! table's number over SI number [1]
    character(len=16) :: beside = '' !! the vector's other component: its size shows rounding
    real(wp) :: zero = 0.0_wp !! of the table's scale [SI]
    character(len=16) :: instead = '' !! result that takes its place where there is one
  end type column_type

  type(column_type), parameter :: columns(*) = [ &
    column_type('load_capacity', 'capacity [N]', 1.0_wp), &
    column_type('load_capacity_coefficient', 'in lbf/in^3krpm', 1.0_wp), &
    column_type('lift_off_speed_rpm', 'lift-off [rpm]', 1.0_wp), &
    column_type('lift_off_supply_pressure', 'lift-off [bar]', 1.0e-5_wp), &
    column_type('misalignment_allowance', 'tilt [mrad]', 1.0e3_wp), &
    column_type('limit_reached', 'at the limit', 1.0_wp), &
    column_type('eccentricity_x', 'e_x [um]', 1.0e6_wp, 'eccentricity_y'), &
    column_type('eccentricity_y', 'e_y [um]', 1.0e6_wp, 'eccentricity_x'), &
    column_type('attitude_angle', 'attitude [deg]', 1.0_wp), &
    column_type('minimum_gap', 'film [um]', 1.0e6_wp), &
    column_type('running_clearance', 'clearance [um]', 1.0e6_wp, instead='running_play'), & ! a preload leaves a part of it
    column_type('running_play', 'play [um]', 1.0e6_wp), &
    column_type('shaft_temperature', 'shaft [C]', 1.0_wp, zero=ice_point), &
    column_type('maximum_film_temperature', 'hottest film [C]', 1.0_wp, zero=ice_point), &
    column_type('critical_mass', 'crit. mass [kg]', 1.0_wp), &
    column_type('growth_rate', 'growth [1/s]', 1.0_wp), &
    column_type('force_x', 'force_x [N]', 1.0_wp, 'force_y'), &
    column_type('force_y', 'force_y [N]', 1.0_wp, 'force_x'), &
    column_type('torque_x', 'torque_x [N m]', 1.0_wp, 'torque_y'), &
    column_type('torque_y', 'torque_y [N m]', 1.0_wp, 'torque_x'), &
    column_type('friction_torque', 'friction [N m]', 1.0_wp), &
    column_type('branch_changed', 'other branch', 1.0_wp)]

  real(wp), parameter :: rough_limit = 10.0_wp !! cell Peclet number above which Galerkin may oscillate [1]
  real(wp), parameter :: large_deflection = 0.25_wp !! of the bump height [1]
  real(wp), parameter :: still_bears = 0.01_wp    !! film over the clearance [1]
  real(wp), parameter :: nearly = 2.0_wp          !! film over touch_down_gap at the end of a run that it has ended [1]
  real(wp), parameter :: micrometre = 1.0e-6_wp   !! [m]
  real(wp), parameter :: neutral = 5.0e-4_wp      !! force over a lift by C that hardly holds an edge, over load and p_a D L [1]

  !> What is written beside the bearing's state and record.
  type, public :: bearing_result_type
    logical :: converged = .false.                   !! the state is the answer
    type(reason_type) :: reason                      !! why it is not
    type(bearing_plan_type) :: plan                  !! of the bearing
    type(cost_type) :: cost
    integer :: ranks = 1                             !! that computed it
    type(quantity_type), allocatable :: origin(:)    !! what the files say of it
    type(case_array_type), allocatable :: contacts(:)
  end type bearing_result_type

contains

  !> What a record has beside its history: contacts, coefficients, modes.
  function record_arrays(scene, bearing, record, points) result(arrays)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(in) :: bearing !! whose contacts were recorded
    type(bearing_record_type), intent(in) :: record !! of all points
    integer, intent(in) :: points !! of it, from the first
    type(case_array_type), allocatable :: arrays(:)

    allocate (arrays(0))
    call add_foil_contacts(bearing, record%contacts, points, arrays)
    call add_dynamics_arrays(record%dynamics, scene%sweep%present, points, arrays)
  end function record_arrays

  !> Writes `<case>.coefficients.csv`; nothing where there is no answer.
  !>
  !> Fails when the file cannot be written.
  subroutine write_coefficients(record, scene, context, error)
    type(bearing_record_type), intent(in) :: record !! of all answers
    type(scene_type), intent(in) :: scene !! whose name the file has
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: name, table
    real(wp) :: values(size(record%history))
    integer :: i

    if (.not. allocated(record%dynamics%point)) return
    if (size(record%dynamics%point) == 0) return ! as a restart file leaves it
    name = ''
    if (scene%sweep%present) name = column_name(scene)
    values = [(number_in(record%history(i)%quantity, name), i=1, size(values))]
    if (this_rank() == 0) then
      table = dynamics_table(record%dynamics, name, values)
      if (context%csv%decimal_comma) table = with_decimal_commas(table)
      call write_text_file(context%folder//'/'//scene%name//'.coefficients.csv', table, error)
    end if
    call share_failure(error)
    if (.not. allocated(error)) call context%log%line('table of coefficients: '//scene%name//'.coefficients.csv')
  end subroutine write_coefficients

  !> A line a point, with the numbers that change along the sweep.
  subroutine show_points(scene, history, log)
    type(scene_type), intent(in) :: scene !! with a sweep
    type(history_row_type), intent(in) :: history(:) !! its points
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp) :: numbers(size(history), widest)
    character(len=:), allocatable :: line
    integer :: i, k, wide, many

    if (size(history) < 2) return
    wide = max(12, len(swept(scene)))
    line = repeat(' ', wide - len(swept(scene)))//swept(scene)
    many = 0
    do i = 1, size(columns)
      if (columns(i)%name == column_name(scene) .or. many == widest) cycle
      if (.not. all(ieee_is_nan(history_values(history, trim(columns(i)%instead))))) cycle
      numbers(:, many + 1) = columns(i)%scale*(history_values(history, trim(columns(i)%name)) - columns(i)%zero)
      if (.not. changes(numbers(:, many + 1), size_beside(columns(i), history))) cycle
      many = many + 1
      line = line//'  '//adjustr(columns(i)%head)
    end do
    call log%heading('points of the sweep')
    call log%line(line)
    associate (value => history_values(history, column_name(scene)))
      do k = 1, size(history)
        line = right(value(k), wide)
        do i = 1, many
          line = line//'  '//right(numbers(k, i), len(columns%head))
        end do
        call log%line(line)
      end do
    end associate
  end subroutine show_points

  !> Which point of its sweep the state is, or how far the sweep has come; empty without a sweep.
  function place_on_sweep(scene, history, converged) result(words)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(history_row_type), intent(in) :: history(:) !! its points that have an answer
    logical, intent(in) :: converged !! the state is the last point's answer
    character(len=:), allocatable :: words
    real(wp) :: value(size(history))

    words = ''
    if (.not. scene%sweep%present) return
    if (size(history) == 0) then
      words = 'no point of the sweep has an answer'
      return
    end if
    value = history_values(history, column_name(scene))
    words = text(size(history))
    if (.not. scene%sweep%turn_folds) words = words//' of '//text(size(scene%sweep%values))
    words = words//': '//sweep_name(scene%sweep)//' = '//text(value(size(value)))//' '// &
            sweep_unit(scene%sweep)
    if (.not. converged) words = 'the last with an answer is '//words
  end function place_on_sweep

  !> What the sweep changes, with its unit.
  pure function swept(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words
    words = sweep_name(scene%sweep)//' ['//sweep_unit(scene%sweep)//']'
  end function swept

  !> Name of its column in the history.
  pure function column_name(scene) result(name)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: name

    name = 'key_value'
    if (scene%sweep%parameter /= sweep_keys) name = sweep_name(scene%sweep)
  end function column_name

  !> Largest of the vector's other component, in the table's unit; zero where there is none.
  real(wp) function size_beside(column, history) result(largest)
    type(column_type), intent(in) :: column !! of the table
    type(history_row_type), intent(in) :: history(:) !! points of the sweep

    largest = 0.0_wp
    if (column%beside == '') return
    largest = column%scale*maxval(abs(history_values(history, trim(column%beside))))
  end function size_beside

  !> Whether numbers are there and not all the same but for rounding.
  pure function changes(numbers, beside)
    real(wp), intent(in) :: numbers(:)
    real(wp), intent(in) :: beside !! size of what they are rounded beside
    logical :: changes
    real(wp), parameter :: rounding = 1.0e-9_wp
    real(wp), allocatable :: known(:)

    known = pack(numbers, .not. ieee_is_nan(numbers))
    changes = .false.
    if (size(known) > 0) changes = maxval(known) - minval(known) > rounding*max(maxval(abs(known)), beside)
  end function changes

  !> A number at the right end of a field; blank where there is none.
  pure function right(number, width) result(words)
    real(wp), intent(in) :: number !! in the table's unit
    integer, intent(in) :: width !! of the field
    character(len=width) :: words

    words = ''
    if (.not. ieee_is_nan(number)) words = text(number, digits)
    words = adjustr(words)
  end function right

  !> Shows the present state and writes it with what was recorded before.
  !>
  !> Fails when a file cannot be written.
  subroutine write_bearing(scene, context, solution, answer, result, summary, error)
    type(scene_type), intent(in) :: scene !! whose names the files have
    type(run_context_type), intent(in) :: context !! of the run
    type(bearing_solution_type), intent(inout) :: solution !! with the last state and the record
    type(bearing_answer_type), intent(in) :: answer !! of that state, with stresses
    type(bearing_result_type), intent(in) :: result !! what else is written
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(result_grid_type), allocatable :: grids(:)
    type(history_row_type), allocatable :: columns(:)

    associate (bearing => solution%bearing, record => solution%record, converged => result%converged, log => context%log)
      call add_quantity(summary, answer_quantities(trim(scene%general%asked%word), converged, answer, &
                                                   bearing%clearance, bearing%force_scale()))
      call add_quantity(summary, summary_quantities(record%tilted))
      call add_quantity(summary, bearing%pad(1)%foil%sizes())
      if (allocated(record%judged)) call add_quantity(summary, record%judged)
      if (record%dynamics%onset > 0.0_wp) call add_result(summary, 'onset_speed_rpm', record%dynamics%onset)
      call add_margins(scene, record%history, summary)
      call add_quantity(summary, cost_quantities(result%cost))
      summary = asked_first(summary)
      columns = columns_of(scene, solution)
      if (scene%sweep%present) call show_points(scene, record%history, log)
      call show_closing_block(log, summary, converged, place_on_sweep(scene, record%history, converged), answer, &
                              bearing%clearance, result%cost, result%ranks, blas_in_use())
      call show_film_notes(scene, bearing%pad(1)%film%law, bearing%mesh, bearing%point%speed, &
                           answer%minimum_gap, [answer%minimum_pressure, answer%maximum_pressure], log)
      if (converged .and. answer%has_foils) then
        call show_growth(log, record%judged, neutral*bearing%force_scale()/bearing%clearance, size(bearing%pad) == 1)
      end if
      call show_tilt_response(log, record%tilted)
      if (.not. result%plan%upwind) call show_unresolved(log, result%plan, answer%rough_peclet)
      call show_large_deflection(log, scene, answer%maximum_deflection)
      if (.not. converged) call show_early_end(log, scene, answer%minimum_gap)
      if (converged) call show_broken_limits(scene, record%history, summary, log)
      if (scene%model%foil%has_bumps) call show_contact_notes(log, scene%contact, answer%contact, answer%maximum_deflection)
      allocate (grids(0))
      call add_film_grid(bearing, scene%output, grids)
      call add_foil_grids(bearing, grids)
      call add_outcome(summary, converged, result%reason)
      call write_result_set(scene, context%folder, converged, result%origin, summary, record%history, result%contacts, &
                            grids, context%csv, log, error, columns, record%series)
      if (.not. allocated(error)) call write_coefficients(record, scene, context, error)
    end associate
  end subroutine write_bearing

  !> Warns of cells so long, and without upwinding, that the pressure may oscillate, or that it does not fall behind the film as
  !> it should.
  subroutine show_unresolved(log, plan, rough)
    type(run_log_type), intent(in) :: log
    type(bearing_plan_type), intent(in) :: plan !! without upwinding
    real(wp), intent(in) :: rough !! Peclet number of cells along which the gap changes [1]

    if (rough > rough_limit) then
      call log%warning('cell Peclet number '//text(rough, 3)//' where the gap changes from '// &
                       'cell to cell: the pressure may oscillate; refine, or use film_scheme = ''supg'' with film_order = 1')
    else if (plan%peclet > rough_limit) then
      call log%warning('cell Peclet number '//text(plan%peclet, 3)//' of the concentric film, without upwinding: the smallest '// &
                       'pressure may be 1 to 5 % too low, forces keep their digits; circumferential_elements = '// &
                       text(ceiling(plan%circumferential*plan%peclet/rough_limit))//', or film_scheme = ''supg'' with film_order = 1')
    end if
  end subroutine show_unresolved

  !> Warns where a run has ended at a film that touch_down_gap calls closed and that may still bear.
  subroutine show_early_end(log, scene, gap)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: gap !! smallest of the last state [m]

    associate (ends => scene%solver%touch_down_gap, clearance => scene%bearing%clearance)
      if (.not. ends > still_bears*clearance .or. gap > nearly*ends .or. scene%shaft_contact%present) return
      call log%warning('touch_down_gap = '//text(ends)//' m in &solver is '//text(100.0_wp*ends/clearance, 3)// &
                       ' % of the clearance, and has ended the run: thinner films still carry load; without the key the run goes on to '// &
                       'a hundredth of a per cent')
    end associate
  end subroutine show_early_end

  !> Warns of a foil that deflects more than displacements that are taken to be small.
  subroutine show_large_deflection(log, scene, deflection)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: deflection !! largest of the foil [m]
    character(len=*), parameter :: small = ': displacements were taken to be small'

    associate (height => scene%bump_foil%height%value, radius => scene%bearing%radius)
      if (height > 0.0_wp .and. deflection > large_deflection*height) then
        call log%warning('the foil deflects by '//text(100.0_wp*deflection/height, 3)//' % of the bump height'//small)
      else if (deflection > thin*radius) then
        call log%warning('the foil deflects by '//text(100.0_wp*deflection/radius, 3)//' % of the radius'//small)
      end if
    end associate
  end subroutine show_large_deflection

  !> The columns that the history of a sweep has, also where no point has an answer.
  function columns_of(scene, solution) result(columns)
    type(scene_type), intent(in) :: scene
    type(bearing_solution_type), intent(in) :: solution
    type(history_row_type), allocatable :: columns(:)
    type(bearing_record_type) :: record

    allocate (columns(0))
    if (.not. scene%sweep%present .or. size(solution%record%history) > 0) return
    call add_row(scene, solution%bearing, solution%newton, .false., record, scene%sweep%values(1))
    columns = record%history
  end function columns_of

  !> Says that an equilibrium of the foils cannot be one that stays: where the determinant is negative an odd number of
  !> motions grows. And that it hardly is one: where next to no force lifts the free edge.
  subroutine show_growth(log, judged, firm, listed)
    type(run_log_type), intent(in) :: log
    type(quantity_type), intent(in) :: judged(:) !! what is known of the answer
    real(wp), intent(in) :: firm !! stiffness of an edge that rests firmly [N/m]
    logical, intent(in) :: listed !! a search for equilibria can list them
    character(len=:), allocatable :: advice

    advice = ''
    if (listed) advice = '; gfb --branches lists equilibria'
    if (number_in(judged, 'determinant_sign') < -0.5_wp) then
      call log%tell('stability        unstable: the determinant of the equations is negative, so some motion of shaft and '// &
                    'foils grows'//advice)
    end if
    if (place_of('edge_stiffness', judged) == 0) return
    associate (stiffness => number_in(judged, 'edge_stiffness'))
      if (.not. abs(stiffness) < firm) return
      call log%line('stability        nearly neutral: '//text(stiffness*micrometre, 2)//' N lift the free edge of the top foil '// &
                    'by 1 um'//advice)
    end associate
  end subroutine show_growth
end module gfb_bearing_writing
