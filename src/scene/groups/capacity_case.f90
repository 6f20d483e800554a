!> `&capacity`: the limit up to which load, speed or tilt is asked for.
module gfb_capacity_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, between, positive
  use gfb_scene_case, only: analysis_load_capacity, analysis_lift_off, analysis_misalignment, &
                            asks_limit, misplaced_group
  implicit none (type, external)
  private
  public :: capacity_case_type, read_capacity_case

  character(len=*), parameter :: axis_words(*) = ['x', 'y']

  !> What is asked for.
  type :: capacity_case_type
    !> `analysis_load_capacity`, `analysis_lift_off` or `analysis_misalignment`; 0: nothing is
    integer :: question = 0
    real(wp) :: smallest_gap = 0.0_wp    !! that the film may have [m]
    real(wp) :: contact_part = 1.0e-2_wp !! of the load that asperities may carry [1]
    integer :: tilt_axis = 1             !! about which the shaft tilts: 1 x, 2 y
  contains
    procedure :: seeks_load
  end type capacity_case_type

contains

  !> Whether it is a load that is asked for.
  elemental logical function seeks_load(self)
    class(capacity_case_type), intent(in) :: self !! what is asked for
    seeks_load = self%question == analysis_load_capacity
  end function seeks_load

  !> Reads the group, which belongs to analyses that look for a limit.
  subroutine read_capacity_case(keys, capacity, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(capacity_case_type), intent(out) :: capacity !! what `&capacity` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    logical :: by_gap

    by_gap = analysis == analysis_load_capacity .or. analysis == analysis_misalignment
    if (asks_limit(analysis)) capacity%question = analysis
    call keys%start_group('capacity', required=by_gap, optional=.not. by_gap, &
                          misplaced=misplaced_group(analysis, asks_limit(analysis)))
    call keys%real_key('smallest_gap', capacity%smallest_gap, 'm', &
                       'film thickness at which load or tilt has reached its limit', positive, &
                       required=by_gap, &
                       default="required for 'load_capacity' and 'misalignment_allowance'")
    call keys%real_key('contact_part', capacity%contact_part, '1', &
                       'part of the load that asperities carry at the lift-off speed', &
                       between(0.0_wp, 1.0_wp))
    call keys%choice_key('tilt_axis', capacity%tilt_axis, axis_words, &
                         'axis about which the sleeve tilts for the misalignment allowance')
    if (capacity%question == 0) return
    if (analysis == analysis_lift_off) then
      call keys%rule('capacity', 'smallest_gap', keys%meant('capacity', 'smallest_gap'), &
                     "has no use with analysis = 'lift_off': that has its limit in contact_part")
    else if (keys%meant('capacity', 'contact_part')) then
      call keys%complain('capacity', 'contact_part', "needs analysis = 'lift_off'")
    end if
    call keys%rule('capacity', 'tilt_axis', keys%meant('capacity', 'tilt_axis') .and. &
                   analysis /= analysis_misalignment, "needs analysis = 'misalignment_allowance'")
  end subroutine read_capacity_case
end module gfb_capacity_case
