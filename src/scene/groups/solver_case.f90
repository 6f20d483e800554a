!> `&solver`: tolerances and limits of the solution.
module gfb_solver_case
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type
  use gfb_case_keys, only: case_keys_type, between, from_to, positive
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: solver_case_type, read_solver_case

  real(wp), parameter :: touch_down_part = 1.0e-4_wp !! of the clearance, smallest film
  real(wp), parameter :: most_iterations = 1.0e6_wp

  integer, parameter, public :: linear_solver_direct = 1
  integer, parameter, public :: linear_solver_out_of_core = 2 !! direct, with factors in files
  integer, parameter, public :: linear_solver_iterative = 3

  character(len=*), parameter :: linear_words(*) = [character(len=11) :: &
                                                    'direct', 'out_of_core', 'iterative']

  !> Tolerances and limits.
  type :: solver_case_type
    real(wp) :: residual_tolerance = 1.0e-10_wp !! of the scaled residual [1]
    real(wp) :: step_tolerance = 1.0e-9_wp      !! of the scaled step [1]
    integer :: maximum_iterations = 40          !! Newton steps of one load step
    integer :: maximum_load_steps = 200
    integer :: maximum_factorizations = 8000    !! of a search from nothing
    real(wp) :: smallest_load_step = 1.0e-4_wp  !! of the whole path [1]
    real(wp) :: touch_down_gap = 0.0_wp         !! below it an equilibrium is refused [m]
    logical :: stability = .false.              !! count the foils' modes that grow
    integer :: linear_solver = linear_solver_direct
    logical :: memory_check = .true.            !! refuse what the machine cannot hold
  end type solver_case_type

contains

  !> Reads the group; the touch-down gap's default is a part of the clearance.
  subroutine read_solver_case(keys, solver, bearing, touches)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(solver_case_type), intent(out) :: solver !! what `&solver` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    logical, intent(in) :: touches !! solid contact carries the shaft where the film does not

    call keys%start_group('solver')
    call keys%real_key('residual_tolerance', solver%residual_tolerance, '1', &
                       'scaled residual at which Newton''s method stops', between(0.0_wp, 1.0_wp))
    call keys%real_key('step_tolerance', solver%step_tolerance, '1', &
                       'scaled step at which Newton''s method stops', between(0.0_wp, 1.0_wp))
    call keys%integer_key('maximum_iterations', solver%maximum_iterations, &
                          'Newton steps of one load step at most', from_to(1.0_wp, most_iterations))
    call keys%integer_key('maximum_load_steps', solver%maximum_load_steps, &
                          'load steps at most', from_to(1.0_wp, most_iterations))
    call keys%integer_key('maximum_factorizations', solver%maximum_factorizations, &
                          'factorizations, of all meshes, after which a search from '// &
                          'nothing gives up', &
                          from_to(1.0_wp, most_iterations))
    call keys%real_key('smallest_load_step', solver%smallest_load_step, '1', &
                       'smallest load step, over the whole path, before the path is given up', &
                       between(0.0_wp, 1.0_wp))
    if (.not. touches) solver%touch_down_gap = touch_down_part*bearing%clearance
    call keys%real_key('touch_down_gap', solver%touch_down_gap, 'm', &
                       'film thickness below which an equilibrium is refused as touch-down', &
                       positive, &
                       default='1e-4 of the clearance; none with &shaft_contact')
    call keys%rule('solver', 'touch_down_gap', bearing%clearance > 0.0_wp .and. &
                   solver%touch_down_gap >= bearing%clearance, 'must be less than the '// &
                   'clearance, '//text(bearing%clearance)//' m')
    call keys%logical_key('stability', solver%stability, &
                          'count the growing modes of the foils, with the shaft fixed')
    call keys%choice_key('linear_solver', solver%linear_solver, linear_words, &
                         'factors in memory, factors in files, or iterations (uncondensed '// &
                         'strips of shells only)')
    call keys%logical_key('memory_check', solver%memory_check, &
                          'refuse a scene that needs more memory than the machine has')
  end subroutine read_solver_case
end module gfb_solver_case
