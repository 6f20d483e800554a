!> What a foil needs to have a mass under vibration.
module gfb_foil_mass_case
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_dynamics_case, only: dynamics_case_type, mass_on, mass_off
  use gfb_kinds, only: wp
  use gfb_model_case, only: model_case_type, foil_shell, reduction_none, meshes_foils
  use gfb_top_foil_case, only: top_foil_case_type
  implicit none (type, external)
  private
  public :: check_foil_mass, has_densities

contains

  !> The keys of the foil's mass have a use, and the foils a density.
  subroutine check_foil_mass(keys, dynamics, model, top_foil, bump_foil)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(dynamics_case_type), intent(in) :: dynamics !! what `&dynamics` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` says
    type(bump_foil_case_type), intent(in) :: bump_foil !! what `&bump_foil` says
    character(len=*), parameter :: group = 'dynamics', mass = 'foil_mass', modes = 'foil_modes'

    if (.not. dynamics%present .or. model%foil == 0) return
    if (keys%meant(group, mass) .and. .not. meshes_foils(model%foil)) then
      call keys%complain(group, mass, "needs foil = 'shell' in &model, or 'beam': no other "// &
                         'foil has a mass')
    else if (dynamics%foil_mass == mass_on .and. &
             .not. has_densities(top_foil, bump_foil)) then
      call keys%complain(group, mass, 'needs the density of both foils: give density in '// &
                         '&top_foil and in &bump_foil')
    end if
    if (.not. keys%meant(group, modes)) return
    if (model%foil /= foil_shell .or. model%reduction == reduction_none) then
      call keys%complain(group, modes, "needs foil = 'shell' and condensed bumps in &model: "// &
                         'nothing else has modes of its own inside')
    else if (dynamics%foil_mass == mass_off) then
      call keys%complain(group, modes, "has no use with foil_mass = 'off'")
    end if
  end subroutine check_foil_mass

  !> Whether both foils have a density.
  pure function has_densities(top_foil, bump_foil) result(has)
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` says
    type(bump_foil_case_type), intent(in) :: bump_foil !! what `&bump_foil` says
    logical :: has
    has = top_foil%density > 0.0_wp .and. bump_foil%density > 0.0_wp
  end function has_densities
end module gfb_foil_mass_case
