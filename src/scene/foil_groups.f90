!> Reads the groups of foils, what loads them and where they touch.
module gfb_foil_groups
  use gfb_bump_foil_case, only: read_bump_foil_case
  use gfb_case_keys, only: case_keys_type
  use gfb_contact_case, only: read_contact_case
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: read_strip_load_case
  use gfb_top_foil_case, only: read_top_foil_case
  implicit none (type, external)
  private
  public :: read_foil_groups

contains

  !> Reads the groups in the order in which they need each other.
  subroutine read_foil_groups(keys, scene, modes, plate, bumps, both, arc)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(inout) :: scene !! gets what they say
    logical, intent(in) :: modes !! they are asked for, and of what is known
    logical, intent(in) :: plate !! of the top foil
    logical, intent(in) :: bumps !! the bump foil is meshed
    logical, intent(in) :: both  !! of a bearing: both foils are meshed
    logical, intent(in) :: arc   !! an arc of it alone

    associate (analysis => scene%general%analysis)
      call read_top_foil_case(keys, scene%top_foil, plate .or. both, plate)
      call read_bump_foil_case(keys, scene%bump_foil, scene%bearing, bumps, modes .and. bumps, &
                               bumps .and. .not. arc .and. .not. both, bumps .and. .not. both)
      call read_strip_load_case(keys, scene%strip_load, scene%bump_foil%bumps, analysis)
      call read_contact_case(keys, scene%contact, scene%strip_load, scene%bump_foil, &
                             scene%bearing%clearance, analysis, scene%model%foil)
    end associate
  end subroutine read_foil_groups
end module gfb_foil_groups
