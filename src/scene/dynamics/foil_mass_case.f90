!> What a foil needs to have a mass where it moves.
module gfb_foil_mass_case
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_dynamics_case, only: dynamics_case_type
  use gfb_foil_mass_words, only: mass_on, mass_off
  use gfb_kinds, only: wp
  use gfb_model_case, only: model_case_type, foil_shell, reduction_none, meshes_foils
  use gfb_top_foil_case, only: top_foil_case_type
  use gfb_transient_case, only: transient_case_type
  implicit none (type, external)
  private
  public :: check_foil_mass, has_densities

contains

  !> The keys of the foil's mass have a use, and the foils a density.
  subroutine check_foil_mass(keys, dynamics, transient, model, top_foil, bump_foil)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(dynamics_case_type), intent(in) :: dynamics !! what `&dynamics` asks for
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` says
    type(bump_foil_case_type), intent(in) :: bump_foil !! what `&bump_foil` says
    if (model%foil == 0) return
    if (transient%present) call check_mass('transient', transient%foil_mass)
    if (dynamics%present) call check_mass('dynamics', dynamics%foil_mass)

  contains

    !> The foil has a mass that can be asked for.
    subroutine check_mass(asking, wanted)
      character(len=*), intent(in) :: asking !! the group
      integer, intent(in) :: wanted
      character(len=*), parameter :: mass = 'foil_mass', modes = 'foil_modes'

      if (keys%meant(asking, mass) .and. .not. meshes_foils(model%foil)) then
        call keys%complain(asking, mass, "needs foil = 'shell' in &model, or 'beam': no other "// &
                           'foil has a mass')
      else if (wanted == mass_on .and. .not. has_densities(top_foil, bump_foil)) then
        call keys%complain(asking, mass, 'needs the density of both foils: give density in '// &
                           '&top_foil and in &bump_foil')
      end if
      if (.not. keys%meant(asking, modes)) return
      if (model%foil /= foil_shell .or. model%reduction == reduction_none) then
        call keys%complain(asking, modes, "needs foil = 'shell' and condensed bumps in &model: "// &
                           'nothing else has modes of its own inside')
      else if (wanted == mass_off) then
        call keys%complain(asking, modes, "has no use with foil_mass = 'off'")
      end if
    end subroutine check_mass
  end subroutine check_foil_mass

  !> Whether both foils have a density.
  pure function has_densities(top_foil, bump_foil) result(has)
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` says
    type(bump_foil_case_type), intent(in) :: bump_foil !! what `&bump_foil` says
    logical :: has
    has = top_foil%density > 0.0_wp .and. bump_foil%density > 0.0_wp
  end function has_densities
end module gfb_foil_mass_case
