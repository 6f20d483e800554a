#include "gfb_petsc.h"
!> What a bearing's study shows and writes.
module gfb_bearing_writing
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_results, only: add_result
  use gfb_scene, only: scene_type
  use gfb_shape_rules, only: thin
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_bearing_summary, only: cost_type, answer_quantities, cost_quantities, &
                                 show_closing_block, asked_first
  use gfb_contact_notes, only: show_contact_notes
  use gfb_film_notes, only: show_film_notes
  use gfb_tilt_response, only: summary_quantities, show_tilt_response
  use gfb_bearing_record, only: bearing_record_type, analysis_name, add_row
  use gfb_case_file, only: case_array_type, history_row_type
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_output, only: add_foil_grids
  use gfb_provenance, only: blas_in_use
  use gfb_run_context, only: run_context_type
  use gfb_sweep, only: sweep_type
  use gfb_sweep_table, only: show_points, place_on_sweep
  implicit none (type)
  private
  public :: write_bearing

  real(wp), parameter :: rough_limit = 10.0_wp !! cell Peclet number above which Galerkin may oscillate [1]
  real(wp), parameter :: large_deflection = 0.25_wp !! of the bump height [1]
  real(wp), parameter :: still_bears = 0.01_wp    !! film over the clearance [1]
  real(wp), parameter :: nearly = 2.0_wp          !! film over touch_down_gap at the end of a run that it has ended [1]
  real(wp), parameter :: micrometre = 1.0e-6_wp   !! [m]
  real(wp), parameter :: neutral = 5.0e-4_wp      !! force over a lift by C that hardly holds an edge, over load and p_a D L [1]

  !> What is written beside the bearing's state and record.
  type, public :: bearing_result_type
    logical :: converged = .false.                   !! the state is the answer
    logical :: upwind = .false.                      !! SUPG was planned
    real(wp) :: peclet = 0.0_wp                      !! cell Peclet number of the concentric film [1]
    integer :: cells = 0                             !! film elements along the motion
    type(cost_type) :: cost
    integer :: ranks = 1                             !! that computed it
    type(quantity_type), allocatable :: origin(:)    !! what the files say of it
    type(case_array_type), allocatable :: contacts(:)
  end type bearing_result_type

contains

  !> Shows the present state and writes it with what was recorded before.
  !>
  !> Fails when a file cannot be written.
  subroutine write_bearing(scene, context, sweep, result, summary, error)
    type(scene_type), intent(in) :: scene !! whose names the files have
    type(run_context_type), intent(in) :: context !! of the run
    type(sweep_type), intent(inout) :: sweep !! with the last state and the record
    type(bearing_result_type), intent(in) :: result !! what else is written
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(bearing_answer_type) :: answer
    type(result_grid_type), allocatable :: grids(:)
    type(history_row_type), allocatable :: columns(:)

    associate (bearing => sweep%bearing, record => sweep%record, converged => result%converged, log => context%log)
      answer = bearing_answer(bearing)
      call add_quantity(summary, answer_quantities(analysis_name(scene), converged, answer, &
                                                   bearing%pad(1)%film%clearance, bearing%force_scale()))
      call add_quantity(summary, summary_quantities(record%tilted))
      call add_quantity(summary, bearing%pad(1)%foil%sizes())
      if (allocated(record%judged)) call add_quantity(summary, record%judged)
      if (record%dynamics%onset > 0.0_wp) call add_result(summary, 'onset_speed_rpm', record%dynamics%onset)
      call add_quantity(summary, cost_quantities(result%cost))
      summary = asked_first(summary)
      columns = columns_of(scene, sweep)
      if (scene%sweep%present) call show_points(scene, record%history, log)
      call show_closing_block(log, summary, converged, place_on_sweep(scene, record%history, converged), answer, &
                              bearing%pad(1)%film%clearance, result%cost, result%ranks, blas_in_use())
      call show_film_notes(scene, bearing%pad(1)%film%law, bearing%pad(1)%whole, bearing%point%speed, &
                           answer%minimum_gap, [answer%minimum_pressure, answer%maximum_pressure], log)
      if (converged .and. answer%has_foils) then
        call show_growth(log, record%judged, neutral*bearing%force_scale()/bearing%pad(1)%film%clearance, size(bearing%pad) == 1)
      end if
      call show_tilt_response(log, record%tilted)
      if (.not. result%upwind) call show_unresolved(log, result, answer%rough_peclet)
      call show_large_deflection(log, scene, answer%maximum_deflection)
      if (.not. converged) call show_early_end(log, scene, answer%minimum_gap)
      call show_contact_notes(log, scene%contact, answer%contact, answer%maximum_deflection)
      allocate (grids(0))
      call add_film_grid(bearing, scene%output, grids)
      call add_foil_grids(bearing, grids)
      call write_result_set(scene, context%folder, converged, result%origin, summary, record%history, result%contacts, &
                            grids, context%csv, log, error, columns, record%series)
    end associate
  end subroutine write_bearing

  !> Warns of cells so long, and without upwinding, that the pressure may oscillate, or that it does not fall behind the film as
  !> it should.
  subroutine show_unresolved(log, result, rough)
    type(run_log_type), intent(in) :: log
    type(bearing_result_type), intent(in) :: result
    real(wp), intent(in) :: rough !! Peclet number of cells along which the gap changes [1]

    if (rough > rough_limit) then
      call log%warning('cell Peclet number '//text(rough, 3)//' where the gap changes from '// &
                       'cell to cell: the pressure may oscillate; refine, or use film_scheme = ''supg'' with film_order = 1')
    else if (result%peclet > rough_limit) then
      call log%warning('cell Peclet number '//text(result%peclet, 3)//' of the concentric film, without upwinding: the smallest '// &
                       'pressure may be 1 to 5 % too low, forces keep their digits; circumferential_elements = '// &
                       text(ceiling(result%cells*result%peclet/rough_limit))//', or film_scheme = ''supg'' with film_order = 1')
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
                       ' % of the clearance, and has ended the run: thinner films still bear; without the key the run goes on to '// &
                       'a hundredth of a per cent')
    end associate
  end subroutine show_early_end

  !> Warns of a foil that gives way more than displacements that are taken to be small.
  subroutine show_large_deflection(log, scene, deflection)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: deflection !! largest of the foil [m]
    character(len=*), parameter :: small = ': displacements were taken to be small'

    associate (height => scene%bump_foil%height%value, radius => scene%bearing%radius)
      if (height > 0.0_wp .and. deflection > large_deflection*height) then
        call log%warning('the foil gives way by '//text(100.0_wp*deflection/height, 3)//' % of the bump height'//small)
      else if (deflection > thin*radius) then
        call log%warning('the foil gives way by '//text(100.0_wp*deflection/radius, 3)//' % of the radius'//small)
      end if
    end associate
  end subroutine show_large_deflection

  !> The columns that the history of a sweep has, also where no point has an answer.
  function columns_of(scene, sweep) result(columns)
    type(scene_type), intent(in) :: scene
    type(sweep_type), intent(in) :: sweep
    type(history_row_type), allocatable :: columns(:)
    type(bearing_record_type) :: record

    allocate (columns(0))
    if (.not. scene%sweep%present .or. size(sweep%record%history) > 0) return
    call add_row(scene, sweep%bearing, sweep%newton, .false., record, scene%sweep%values(1))
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
    integer :: i

    advice = ''
    if (listed) advice = '; gfb --branches lists equilibria'

    do i = 1, size(judged)
      associate (number => judged(i)%number)
        if (judged(i)%name == 'determinant_sign' .and. number < -0.5_wp) then
          call log%line('stability        unstable: the determinant of the equations is negative, so some motion of shaft and '// &
                        'foils grows'//advice)
        else if (judged(i)%name == 'edge_stiffness' .and. abs(number) < firm) then
          call log%line('stability        nearly neutral: '//text(number*micrometre, 2)//' N lift the free edge of the top foil '// &
                        'by 1 um'//advice)
        end if
      end associate
    end do
  end subroutine show_growth
end module gfb_bearing_writing
