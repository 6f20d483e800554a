!> What is said where a bearing has no answer: why, and the last state that was reached.
module gfb_missing_answer
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_elastic_foundation, foundation_pressure_local
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_petsc_session, only: largest_over_ranks
  use gfb_bearing_system, only: bearing_system_type
  use gfb_continuation, only: path_report_type
  use gfb_reasons, only: reason_type, reason_no_equilibrium, reason_no_answer, reason_fixed_shaft, &
                         reason_no_limit, reason_stopped
  implicit none (type, external)
  private
  public :: explain_missing

  real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp !! [rad]

contains

  !> Says why there is no answer, and how far the path led.
  subroutine explain_missing(scene, bearing, report, fixed, log, reason)
    type(scene_type), intent(in) :: scene !! what was asked for
    type(bearing_system_type), intent(in) :: bearing !! at the last state that was reached
    type(path_report_type), intent(in) :: report !! of the path
    logical, intent(in) :: fixed             !! the shaft was, at an equilibrium
    type(run_log_type), intent(in) :: log    !! gets the lines
    type(reason_type), intent(out) :: reason !! why there is none

    reason%code = reason_no_answer
    if (scene%general%analysis == analysis_equilibrium) reason%code = reason_no_equilibrium
    if (scene%capacity%question > 0) reason%code = reason_no_limit
    if (fixed) reason%code = reason_fixed_shaft
    reason%detail = report%reason()
    if (stop_agreed()) then
      reason%code = reason_stopped
      reason%detail = stop_words()
      return
    end if
    associate (point => report%reached, force => bearing%reaction())
      call log%tell(reason%words())
      if (has_stiff_edges(scene)) then
        call log%line('with foundation_pressure = ''local'' the edges, at ambient pressure, do '// &
                      'not deflect and may touch first; ''axial_mean'' in &model lets them')
      end if
      select case (reason%code)
      case (reason_fixed_shaft)
        call log%line('last state reached: tilt ('//text(point%tilt(1), 4)//', '// &
                      text(point%tilt(2), 4)//') rad, film force ('//text(force(1), 5)//', '// &
                      text(force(2), 5)//') N, '//thinnest_film(bearing))
      case (reason_no_equilibrium, reason_no_limit)
        call log%line('last state reached: load ('//text(force(1), 5)//', '//text(force(2), 5)// &
                      ') N, speed '//text(point%speed*30.0_wp/acos(-1.0_wp), 5)//' rpm, tilt ('// &
                      text(point%tilt(1), 4)//', '//text(point%tilt(2), 4)//') rad, '// &
                      thinnest_film(bearing))
      case default
        call log%line('last state reached: '//text(100.0_wp*report%fraction, 4)// &
                      ' % of the path, speed '// &
                      text(point%speed*30.0_wp/acos(-1.0_wp), 5)//' rpm, '//thinnest_film(bearing))
      end select
    end associate
  end subroutine explain_missing

  !> Where the film is thinnest, in words; of half a width, the half that is solved.
  function thinnest_film(bearing) result(words)
    type(bearing_system_type), intent(in) :: bearing
    character(len=:), allocatable :: words
    real(wp) :: unknown(bearing%local_size()), smallest, place(2)
    real(wp), allocatable :: gap(:)
    integer :: node, pad

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    smallest = bearing%smallest_gap()
    place = -huge(place)
    node = minloc(gap, 1)
    if (node > 0) then
      pad = count(bearing%pad%first_node < node)
      associate (film => bearing%pad(pad)%film, here => node - bearing%pad(pad)%first_node)
        if (gap(node) <= smallest) place = [film%angle(here), film%axial(here)]
      end associate
    end if
    place = largest_over_ranks(place)
    words = 'film thinnest at theta = '//text(place(1)/degree, 4)//' deg, z = '// &
            text(place(2)*1.0e3_wp, 3)//' mm: '//text(smallest*1.0e6_wp, 3)//' um'
  end function thinnest_film

  !> Whether the edges of the film do not deflect: they are at ambient pressure.
  pure function has_stiff_edges(scene) result(has)
    type(scene_type), intent(in) :: scene
    logical :: has

    has = .false.
    if (scene%model%foil /= foil_elastic_foundation) return
    has = scene%model%foundation_pressure == foundation_pressure_local
  end function has_stiff_edges
end module gfb_missing_answer
