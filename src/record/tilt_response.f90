!> What a sweep of tilt gives beside the answers: angular stiffness, and the equilibrium at which
!> the shaft is fixed.
module gfb_tilt_response
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_result_table, only: at_this_point, at_first_point, at_fixed_equilibrium, load_kept, &
                              shaft_fixed, linearised_there, over_tilt
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_case_type, sweep_tilt_x, sweep_tilt_y
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer, visit_answer
  use gfb_newton, only: newton_type
  use gfb_static_stiffness, only: angular_stiffness
  implicit none (type, external)
  private
  public :: begin_tilt, measure_tilt, row_quantities, summary_quantities, show_tilt_response
  public :: tilt_axis, visit_response

  character(len=1), parameter :: axes(2) = ['x', 'y']

  !> Torques over tilts along the sweep.
  type, public :: tilt_response_type
    logical :: measured = .false.       !! there is a slope
    integer :: axis = 0                 !! that the sweep tilts about: 1 is x, 2 is y, 0 none
    real(wp) :: tilt = 0.0_wp           !! about it, at the last point [rad]
    real(wp) :: slope(2, 2) = 0.0_wp    !! torque about x, y by tilt about x, y, there [N m/rad]
    real(wp) :: first_slope(2, 2) = 0.0_wp !! where the sweep begins [N m/rad]
    logical :: has_secant = .false.     !! the torque without tilt is known
    real(wp) :: untilted(2) = 0.0_wp    !! it [N m]
    real(wp) :: secant(2) = 0.0_wp      !! torque less that, over the tilt, there [N m/rad]
    logical :: held = .false.           !! the shaft is fixed; otherwise the load is kept
    logical :: rubs = .false.           !! there are contacts
    logical :: from_equilibrium = .false. !! the equilibrium was found first
    type(bearing_answer_type) :: equilibrium !! there
  end type tilt_response_type

contains

  !> At the equilibrium at which the shaft is fixed, before the sweep tilts it; nothing where it
  !> tilts nothing.
  subroutine begin_tilt(scene, bearing, newton, response)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(inout) :: bearing !! at the equilibrium
    type(newton_type), intent(inout) :: newton !! its solver
    type(tilt_response_type), intent(inout) :: response !! gets slope and equilibrium

    response%axis = tilt_axis(scene%sweep)
    if (response%axis == 0) return
    response%from_equilibrium = .true.
    response%equilibrium = bearing_answer(bearing)
    call measure(scene%operation%tilt, bearing, newton, response)
  end subroutine begin_tilt

  !> At a sweep's point; nothing where the sweep tilts nothing.
  subroutine measure_tilt(scene, value, bearing, newton, response)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp), intent(in) :: value !! tilt of the sweep's point, where it sweeps a tilt [rad]
    type(bearing_system_type), intent(inout) :: bearing !! at the point's answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(tilt_response_type), intent(inout) :: response !! gets slope and secant
    real(wp) :: tilt(2)

    response%axis = tilt_axis(scene%sweep)
    if (response%axis == 0) return
    tilt = scene%operation%tilt
    tilt(response%axis) = value
    call measure(tilt, bearing, newton, response)
  end subroutine measure_tilt

  !> Slope and secant at the present state.
  subroutine measure(tilt, bearing, newton, response)
    real(wp), intent(in) :: tilt(2) !! of the state [rad]
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(tilt_response_type), intent(inout) :: response
    real(wp) :: force(5)

    call angular_stiffness(bearing, newton, response%slope)
    force = bearing%reaction()
    response%held = bearing%shaft_fixed .or. .not. bearing%floats
    response%rubs = bearing%has_contacts()
    response%tilt = tilt(response%axis)
    if (.not. response%measured) then
      response%first_slope = response%slope
      call find_untilted(tilt, force(4:5), response)
    end if
    response%measured = .true.
    if (abs(response%tilt) > 0.0_wp) then
      response%secant = (force(4:5) - response%untilted)/response%tilt
    else
      response%secant = response%slope(:, response%axis)
    end if
  end subroutine measure

  !> Torque without tilt: that of the sweep's first state where that is not tilted about the swept
  !> axis; none, by symmetry about z = 0, where nothing else is tilted; otherwise not known.
  pure subroutine find_untilted(tilt, torque, response)
    real(wp), intent(in) :: tilt(2), torque(2) !! of the first state [rad], [N m]
    type(tilt_response_type), intent(inout) :: response

    if (abs(tilt(response%axis)) <= 0.0_wp) response%untilted = torque
    response%has_secant = any(abs(tilt([response%axis, 3 - response%axis])) <= 0.0_wp)
  end subroutine find_untilted

  !> Axis that a sweep tilts about, 0 for none.
  pure integer function tilt_axis(sweep) result(axis)
    type(sweep_case_type), intent(in) :: sweep !! with its parameter

    axis = 0
    if (.not. sweep%present) return
    if (sweep%parameter == sweep_tilt_x) axis = 1
    if (sweep%parameter == sweep_tilt_y) axis = 2
  end function tilt_axis

  !> What a point adds to its row of the history.
  function row_quantities(response) result(list)
    type(tilt_response_type), intent(in) :: response !! at the point
    type(quantity_type), allocatable :: list(:)
    integer :: i

    allocate (list(0))
    if (.not. response%measured) return
    call add_slopes(response, response%slope, at_this_point, list)
    if (.not. response%has_secant) return
    do i = 1, 2
      call add_result(list, 'secant_stiffness_'//axes(i), response%secant(i), &
                      over_tilt(response%axis))
    end do
  end function row_quantities

  !> What the sweep adds to the summary: the slope where it begins, and the equilibrium at which the
  !> shaft is fixed.
  function summary_quantities(response) result(list)
    type(tilt_response_type), intent(in) :: response !! of the whole sweep
    type(quantity_type), allocatable :: list(:)
    integer :: i

    allocate (list(0))
    if (.not. response%measured) return
    if (.not. response%from_equilibrium) then
      call add_slopes(response, response%first_slope, at_first_point, list)
      return
    end if
    call add_slopes(response, response%first_slope, at_fixed_equilibrium, list)
    associate (there => response%equilibrium)
      do i = 1, 2
        call add_result(list, 'held_force_'//axes(i), there%force(i))
      end do
      if (.not. there%has_foils) return
      call add_result(list, 'held_leading_edge_lift', there%leading_edge_lift(1))
      call add_result(list, 'held_leading_edge_lift_edge', there%leading_edge_lift(2))
      call add_result(list, 'held_lifted_length', there%lifted_length)
    end associate
  end function summary_quantities

  !> Adds four slopes: first letter of the name the torque, second the tilt.
  subroutine add_slopes(response, slope, where_on_sweep, list)
    type(tilt_response_type), intent(in) :: response
    real(wp), intent(in) :: slope(2, 2)   !! [N m/rad]
    character(len=*), intent(in) :: where_on_sweep !! in words
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=:), allocatable :: kept
    integer :: torque, tilt

    kept = load_kept
    if (response%held) kept = shaft_fixed
    if (response%rubs) kept = kept//linearised_there
    do torque = 1, 2
      do tilt = 1, 2
        call add_result(list, 'angular_stiffness_'//axes(torque)//axes(tilt), &
                        slope(torque, tilt), where_on_sweep//kept)
      end do
    end do
  end subroutine add_slopes

  !> Saves or restores what a sweep has given so far.
  pure subroutine visit_response(archive, response)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(tilt_response_type), intent(inout) :: response !! written where the archive restores

    call archive%visit('measured', response%measured)
    call archive%visit('axis', response%axis)
    call archive%visit('tilt', response%tilt)
    call archive%visit('slope', response%slope)
    call archive%visit('first_slope', response%first_slope)
    call archive%visit('has_secant', response%has_secant)
    call archive%visit('untilted', response%untilted)
    call archive%visit('secant', response%secant)
    call archive%visit('held', response%held)
    call archive%visit('rubs', response%rubs)
    call archive%visit('from_equilibrium', response%from_equilibrium)
    call archive%part('equilibrium')
    call visit_answer(archive, response%equilibrium)
    if (archive%saves) return
    call archive%require(any(response%axis == [0, 1, 2]), 'the axis of a tilt')
  end subroutine visit_response

  !> Lines of the closing block.
  subroutine show_tilt_response(log, response)
    type(run_log_type), intent(in) :: log !! where lines go
    type(tilt_response_type), intent(in) :: response !! of the whole sweep
    character(len=:), allocatable :: where_on_sweep

    if (.not. response%measured) return
    where_on_sweep = 'at the first point, '
    if (response%from_equilibrium) where_on_sweep = 'at the equilibrium, '
    call log%line('angular stiffness xx, xy, yx, yy '//four(transpose(response%first_slope))// &
                  ' N m/rad '//where_on_sweep// &
                  trim(merge('shaft fixed', 'load kept  ', response%held)))
    if (.not. response%has_secant) return
    call log%line('secant stiffness x, y '//two(response%secant)//' N m/rad at tilt_'// &
                  axes(response%axis)//' = '//text(response%tilt, 4)//' rad')
  end subroutine show_tilt_response

  !> Two numbers with a comma.
  pure function two(number) result(words)
    real(wp), intent(in) :: number(2)
    character(len=:), allocatable :: words
    words = text(number(1), 5)//', '//text(number(2), 5)
  end function two

  !> Four numbers with commas.
  pure function four(number) result(words)
    real(wp), intent(in) :: number(2, 2)
    character(len=:), allocatable :: words
    words = two(number(:, 1))//', '//two(number(:, 2))
  end function four
end module gfb_tilt_response
