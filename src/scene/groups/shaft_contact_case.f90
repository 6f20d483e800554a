!> `&shaft_contact`: the rough shaft touches the foil, or sleeve, where the film is thin.
module gfb_shaft_contact_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, from_to, positive
  use gfb_scene_case, only: is_bearing, misplaced_group
  implicit none (type, external)
  private
  public :: shaft_contact_case_type, read_shaft_contact_case

  real(wp), parameter :: usual_friction = 0.1_wp, highest_friction = 10.0_wp

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
  end subroutine read_shaft_contact_case
end module gfb_shaft_contact_case
