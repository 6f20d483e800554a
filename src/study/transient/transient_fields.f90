!> Film and foils of a shaft over time at chosen times.
module gfb_transient_fields
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_time_march, only: march_type
  use gfb_grid_series, only: grid_series_type
  use gfb_result_set, only: result_grid_type, add_series_step
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_output, only: add_foil_grids
  implicit none (type, external)
  private
  public :: keep_fields

  real(wp), parameter :: round_off = 1.0e-9_wp !! of times over the interval [1]

contains

  !> Adds the present film and foils to the series: at the beginning, and by the first step that
  !> reaches each chosen time.
  subroutine keep_fields(scene, march, bearing, series)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(march_type), intent(in) :: march !! at the beginning or after a step
    type(bearing_system_type), intent(in) :: bearing !! at the same state
    type(grid_series_type), intent(inout) :: series !! may get a step
    type(result_grid_type), allocatable :: grids(:)

    associate (interval => scene%transient%field_interval, start => scene%transient%field_start)
      if (.not. interval > 0.0_wp) return
      if (march%steps == 0) then
        if (start > 0.0_wp) return
      else if (passed(march%time) == passed(march%time - march%step)) then
        return
      end if
    end associate
    allocate (grids(0))
    call add_film_grid(bearing, scene%output, grids)
    if (size(grids) == 0) return ! no field is asked for
    call add_foil_grids(bearing, grids)
    call add_series_step(series, 'time', 's', march%time, grids)
  contains
    !> Chosen times until this one.
    pure function passed(time) result(times)
      real(wp), intent(in) :: time !! [s]
      integer :: times
      real(wp) :: intervals

      intervals = (time - scene%transient%field_start)/scene%transient%field_interval
      times = max(0, floor(intervals + round_off) + 1)
    end function passed
  end subroutine keep_fields
end module gfb_transient_fields
