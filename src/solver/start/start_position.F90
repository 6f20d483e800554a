#include "gfb_petsc.h"
!> Where a search for an answer begins: a fixed shaft, brought from rest to speed, and released.
module gfb_start_position
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: micrometres
  use gfb_ending, only: path_reached, path_lost
  use gfb_petsc_session, only: largest_over_ranks, sum_over_ranks
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_load, only: acts_on, film_forces
  use gfb_film_surface, only: translations, axial_coordinate
  use gfb_solid_contact, only: contact_pressure
  use gfb_gap_part, only: gap_part_type
  use gfb_gap_shape, only: gap_shape_item_type
  use gfb_gap_shapes, only: find_shapes, peak_of
  use gfb_bearing_system, only: bearing_system_type
  use gfb_film_room, only: undeflected_gap
  use gfb_newton, only: newton_type, newton_report_type, solve_newton, solve_nearby
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  implicit none (type)
  private
  public :: guess_position, place_shaft, find_position, release_shaft, solve_at, put_at_rest, &
            set_interference

  real(wp), parameter :: start_attitude = 0.5_wp !! of a position that is not given [rad]
  real(wp), parameter, public :: room_at_rest = 0.75_wp  !! largest approach to the sleeve to begin with, over the clearance [1]

contains

  !> Newton's method at a point, as a path of one step.
  subroutine solve_at(bearing, newton, target, fixed, settings, report, most, near)
    type(bearing_system_type), intent(inout) :: bearing !! the bearing, in its present state
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: target   !! asked for
    logical, intent(in) :: fixed !! the shaft is fixed at the point's position
    type(path_settings_type), intent(in) :: settings !! limits
    type(path_report_type), intent(out) :: report !! of a path of one step
    integer, intent(in), optional :: most !! iterations; the settings' by default
    logical, intent(in), optional :: near !! beside the answer of the solve before, whose factors serve; default: it is not
    type(newton_report_type) :: solved
    logical :: keeps_factors
    integer :: allowed

    bearing%point = target
    bearing%shaft_fixed = fixed
    allowed = newton%settings%maximum_iterations
    if (present(most)) newton%settings%maximum_iterations = min(most, allowed)
    keeps_factors = .false.
    if (present(near)) keeps_factors = near
    if (keeps_factors) call solve_nearby(newton, solved)
    if (.not. keeps_factors) call solve_newton(newton, solved)
    newton%settings%maximum_iterations = allowed
    report%ending = path_lost(solved%reason)
    if (solved%converged) then
      if (fixed .or. .not. bearing%floats) then
        report%ending = path_reached()
      else if (bearing%smallest_gap() >= settings%touch_down_gap) then
        report%ending = path_reached()
      else
        report%ending = path_lost('the film of the answer is thinner than '//text(settings%touch_down_gap*micrometres, 3)//' um')
      end if
    end if
    report%reached = target
    report%fraction = 1.0_wp
    report%steps = 1
  end subroutine solve_at

  !> A fixed position at rest, brought to speed.
  subroutine find_position(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing !! with the position as its eccentricity
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: target   !! asked for
    type(path_settings_type), intent(in) :: settings !! limits
    type(path_report_type), intent(out) :: report !! how it ended

    type(path_settings_type) :: to_position
    type(operating_point_type) :: wanted, free

    to_position = settings
    to_position%touch_down_gap = 0.0_wp
    wanted = target
    wanted%place(:2) = bearing%eccentricity()
    free = free_position(bearing, wanted)
    call put_at_rest(bearing, free)
    call newton%log%detail('fixed position, from rest to speed')
    call follow_path(bearing, newton, free, 1.0_wp, to_position, report)
    report%shaft_fixed = .true.
    if (report%converged() .and. any(abs(free%place - wanted%place) > 0.0_wp)) then
      call newton%log%detail('to the position asked for')
      call follow_path(bearing, newton, wanted, 0.25_wp, to_position, report)
      report%shaft_fixed = .true.
    end if
  end subroutine find_position

  !> Releases the shaft where it is fixed, and moves the load from the film's reaction to its target.
  subroutine release_shaft(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing !! with an answer at a fixed position
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: target   !! asked for
    type(path_settings_type), intent(in) :: settings !! limits
    type(path_report_type), intent(out) :: report !! how it ended
    real(wp) :: force(film_forces), change
    integer, allocatable :: along(:) ! of the shaft's coordinates, those that are forces

    force = acts_on*bearing%reaction()
    bearing%shaft_fixed = .false.
    bearing%point%load(bearing%coordinate) = force(bearing%coordinate)
    call newton%log%detail('shaft released, load from the reaction to its target')
    along = pack(bearing%coordinate, bearing%coordinate <= translations)
    change = norm2(target%load(along) - force(along))
    call follow_path(bearing, newton, target, 2.0_wp*norm2(force(along))/max(change, tiny(1.0_wp)), settings, report)
  end subroutine release_shaft

  !> A position with room for the shaft while the foil has not yet moved: the one asked for, or one
  !> between it and the centred one.
  function free_position(bearing, wanted) result(free)
    type(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: wanted
    type(operating_point_type) :: free
    type(operating_point_type) :: centred
    real(wp) :: at_rest(bearing%film_nodes()), extremes(2)

    free = wanted
    centred = wanted
    centred%place = 0.0_wp
    at_rest = undeflected_gap(bearing, centred)
    extremes = largest_over_ranks([-minval(at_rest), maxval(at_rest - undeflected_gap(bearing, wanted))])
    associate (clearance => -extremes(1), approach => extremes(2)) ! the former less than C with a preload or a bore that is no circle
      if (approach < clearance) return
      free%place = wanted%place*room_at_rest*clearance/approach
    end associate
  end function free_position

  !> Puts the bearing at rest at a fixed position: ambient pressure everywhere, exactly; a supply is off.
  subroutine put_at_rest(bearing, position)
    type(bearing_system_type), intent(inout) :: bearing
    type(operating_point_type), intent(in) :: position
    real(wp) :: unknown(bearing%local_size())

    bearing%point = position
    bearing%point%speed = 0.0_wp
    bearing%point%supply = 0.0_wp
    bearing%shaft_fixed = .true.
    unknown = 0.0_wp
    call bearing%put_gas_at_rest(unknown)
    unknown(bearing%first_shaft + 1:) = position%place(bearing%coordinate)
    call bearing%set_unknowns(unknown)
  end subroutine put_at_rest

  !> A position to begin with: the scene's, or halfway to where a film would carry the load.
  subroutine guess_position(bearing, scene, target, eccentricity)
    type(bearing_system_type), intent(inout) :: bearing !! gets the position, and all else zero
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(operating_point_type), intent(in) :: target !! the operating point asked for
    real(wp), intent(in) :: eccentricity !! where none is given, over the free clearance [1]
    type(gap_shape_item_type), allocatable :: shape(:)
    real(wp) :: direction, free

    bearing%point%place(:translations) = target%place(:translations)
    if (.not. bearing%floats) return
    if (.not. scene%operation%eccentricity_given) then
      call find_shapes(scene%bearing, scene%bore, scene%bearing%leading_edge_angle, 1.0_wp, shape)
      free = scene%bearing%clearance*(1.0_wp - scene%bearing%preload) - max(peak_of(shape), 0.0_wp) &
        - bearing%pad(1)%film%interference() - 0.5_wp*scene%bearing%length*norm2(target%place(4:5)) &
        - bearing%mesh%surface%sine*target%place(axial_coordinate)
      direction = start_attitude
      if (norm2(target%load(:2)) > 0.0_wp) direction = direction + atan2(target%load(2), target%load(1))
      bearing%point%place(:2) = -eccentricity*max(free, 0.0_wp)*[cos(direction), sin(direction)]
      if (bearing%asperities%present .and. .not. target%speed > 0.0_wp .and. norm2(target%load(:2)) > 0.0_wp) then
        bearing%point%place(:2) = resting_position(bearing, target)
      end if
    end if
    call place_shaft(bearing, (bearing%point%place(:2))) ! a copy: it is overwritten
  end subroutine guess_position

  !> Takes an interference off the gap of all pads.
  subroutine set_interference(bearing, interference)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: interference !! of the shaft [m]
    integer :: i

    do i = 1, size(bearing%pad)
      call bearing%pad(i)%film%put(gap_part_type(name='interference', level=interference))
    end do
  end subroutine set_interference

  !> Puts a shaft that finds its own position somewhere to begin with.
  subroutine place_shaft(bearing, position)
    type(bearing_system_type), intent(inout) :: bearing !! gets the position, and all else zero
    real(wp), intent(in) :: position(2) !! eccentricity [m]
    real(wp) :: unknown(bearing%local_size())

    bearing%point%place(:2) = position
    unknown = 0.0_wp
    unknown(bearing%first_shaft + 1:) = bearing%point%place(bearing%coordinate)
    call bearing%set_unknowns(unknown)
  end subroutine place_shaft

  !> Where the asperities of a shaft that does not turn carry its load on a rigid sleeve: the gap that
  !> halves, as often as it takes, between the clearance and none.
  function resting_position(bearing, target) result(eccentricity)
    type(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: target
    real(wp) :: eccentricity(2)
    integer, parameter :: halvings = 40
    type(operating_point_type) :: there
    real(wp) :: gap(bearing%film_nodes()), direction(2)
    real(wp) :: near, far, middle, force(film_forces), smallest(1)
    integer :: i

    there = target
    direction = -target%load(:2)/norm2(target%load(:2))
    near = 0.0_wp
    far = bearing%clearance
    do i = 1, halvings
      middle = 0.5_wp*(near + far)
      there%place(:2) = middle*direction
      gap = undeflected_gap(bearing, there)
      smallest = largest_over_ranks([-minval(gap)])
      force = sum_over_ranks(bearing%film_force(bearing%ambient_pressure + contact_pressure(bearing%asperities, gap)))
      if (smallest(1) < 0.0_wp .and. dot_product(force(1:2), target%load(:2)) < norm2(target%load(:2))**2) then
        near = middle
      else
        far = middle
      end if
    end do
    eccentricity = near*direction
  end function resting_position
end module gfb_start_position
