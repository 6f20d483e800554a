!> `&shaft_contact`: the rough shaft touches the foil, or sleeve, where the film is thin.
module gfb_shaft_contact_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: model_case_type, foil_elastic_foundation, foundation_pressure_local, &
                            coupling_partitioned
  use gfb_operation_case, only: operation_case_type
  use gfb_scene_case, only: analysis_equilibrium, is_bearing, misplaced_group
  use gfb_sweep_case, only: sweep_case_type, sweep_load, sweep_speed
  use gfb_value_rules, only: from_to, positive
  implicit none (type, external)
  private
  public :: shaft_contact_case_type, read_shaft_contact_case, check_shaft_contact

  real(wp), parameter :: usual_friction = 0.1_wp, highest_friction = 10.0_wp
  character(len=*), parameter :: none_at_rest = 'must not be zero at rest: no position is an '// &
                                 'answer rather than another'

  !> The asperities of both surfaces as one.
  type :: shaft_contact_case_type
    logical :: present = .false.             !! the group stands in the file
    real(wp) :: roughness = 0.0_wp           !! mean height [m]
    real(wp) :: pressure = 0.0_wp            !! where the mean planes meet [Pa]
    real(wp) :: friction = usual_friction    !! coefficient [1]
  end type shaft_contact_case_type

contains

  !> Reads the group; without it nothing touches.
  subroutine read_shaft_contact_case(keys, contact, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(shaft_contact_case_type), intent(out) :: contact !! what `&shaft_contact` asks for
    integer, intent(in) :: analysis !! 0 where it is not known

    call keys%start_group('shaft_contact', optional=.true., present_in_file=contact%present, &
                          misplaced=misplaced_group(analysis, is_bearing(analysis)))
    call keys%real_key('roughness', contact%roughness, 'm', &
                       'roughness height s of shaft and foil together: asperities carry the '// &
                       'pressure p_0 exp(-h/s) where the film has the thickness h', &
                       positive, .true.)
    call keys%real_key('pressure', contact%pressure, 'Pa', &
                       'pressure p_0 of the asperities at zero film thickness', positive, .true.)
    call keys%real_key('friction', contact%friction, '1', &
                       'friction coefficient of the asperities', from_to(0.0_wp, highest_friction))
    call keys%finish_group()
  end subroutine read_shaft_contact_case

  !> What the asperities load must have equations of its own, and at rest they must carry something.
  subroutine check_shaft_contact(keys, contact, model, operation, sweep, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(shaft_contact_case_type), intent(in) :: contact !! what `&shaft_contact` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    integer, intent(in) :: analysis !! 0 where it is not known
    logical :: rests

    if (.not. contact%present .or. .not. is_bearing(analysis)) return
    if (model%foil == foil_elastic_foundation .and. &
        model%foundation_pressure == foundation_pressure_local) then
      call keys%complain('model', 'foundation_pressure', "must be 'axial_mean' with "// &
                         '&shaft_contact: springs without unknowns of their own feel the film '// &
                         'alone')
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' with &shaft_contact")
    end if
    if (analysis /= analysis_equilibrium .or. .not. allocated(sweep%values)) return
    rests = .not. operation%speed_rpm > 0.0_wp .and. keys%meant('operation', 'speed_rpm')
    if (sweep%parameter == sweep_speed) rests = any(.not. sweep%values > 0.0_wp)
    if (.not. rests) return
    if (operation%load_given .and. .not. any(abs(operation%load) > 0.0_wp)) then
      call keys%complain('operation', 'load', none_at_rest)
    else if (sweep%parameter == sweep_load .and. any(.not. abs(sweep%values) > 0.0_wp)) then
      call keys%complain('sweep', 'values', none_at_rest)
    end if
  end subroutine check_shaft_contact
end module gfb_shaft_contact_case
