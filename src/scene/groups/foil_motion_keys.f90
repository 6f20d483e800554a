!> What foils are where something moves, in each group that has keys of it: their mass, and a Maxwell
!> arm beside the springs of an elastic foundation.
module gfb_foil_motion_keys
  use gfb_kinds, only: wp
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_model_case, only: model_case_type, foil_shell, reduction_none, meshes_foils
  use gfb_top_foil_case, only: top_foil_case_type
  use gfb_value_rules, only: positive
  implicit none (type, external)
  private
  public :: read_maxwell_keys, check_maxwell_keys, check_foil_mass, has_densities

  integer, parameter, public :: mass_auto = 1 !! the foil has its mass where it counts
  integer, parameter, public :: mass_on = 2   !! it has it
  integer, parameter, public :: mass_off = 3  !! it has none
  character(len=*), parameter, public :: mass_words(*) = [character(len=4) :: 'auto', 'on', 'off']
  real(wp), parameter, public :: most_foil_modes = 1000.0_wp !! in a piece
  character(len=*), parameter, public :: foil_modes_words = &
    'fixed-interface modes kept inside each condensed piece of the bumps that has its mass'

  character(len=*), parameter :: stiffness = 'maxwell_stiffness', time = 'maxwell_time'

contains

  !> Reads both keys.
  subroutine read_maxwell_keys(keys, arm)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, in the group
    type(maxwell_arm_type), intent(inout) :: arm !! what they ask for

    call keys%real_key(stiffness, arm%stiffness, 'N/m^3', 'spring of the Maxwell arm, a spring '// &
                       'and a dashpot in series beside each spring of the elastic foundation', &
                       positive, default=no_default)
    call keys%real_key(time, arm%time, 's', 'relaxation time of that arm: its dashpot over '// &
                       'its spring', positive, default=no_default)
  end subroutine read_maxwell_keys

  !> Both or none, and springs for the arm to stand beside.
  subroutine check_maxwell_keys(keys, group, rests)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: group !! that may have them
    logical, intent(in) :: rests !! the foil rests on springs, or is not known

    call check_key(stiffness, time)
    call check_key(time, stiffness)

  contains

    subroutine check_key(name, other)
      character(len=*), intent(in) :: name, other

      if (.not. keys%meant(group, name)) return
      if (.not. keys%meant(group, other)) then
        call keys%complain(group, name, 'needs '//other//' beside it')
      end if
      if (rests) return
      call keys%complain(group, name, "needs foil = 'elastic_foundation' in &model")
    end subroutine check_key
  end subroutine check_maxwell_keys

  !> The keys of the foil's mass have a use in a group that has them, and the foils a density.
  subroutine check_foil_mass(keys, group, wanted, model, top_foil, bump_foil)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: group !! that asks for the mass
    integer, intent(in) :: wanted         !! `mass_auto`, ...
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` says
    type(bump_foil_case_type), intent(in) :: bump_foil !! what `&bump_foil` says
    character(len=*), parameter :: mass = 'foil_mass', modes = 'foil_modes'

    if (model%foil == 0) return
    if (keys%meant(group, mass) .and. .not. meshes_foils(model%foil)) then
      call keys%complain(group, mass, "needs foil = 'shell' in &model, or 'beam': no other foil "// &
                         'has a mass')
    else if (wanted == mass_on .and. .not. has_densities(top_foil, bump_foil)) then
      call keys%complain(group, mass, 'needs the density of both foils: give density in '// &
                         '&top_foil and in &bump_foil')
    end if
    if (.not. keys%meant(group, modes)) return
    if (model%foil /= foil_shell .or. model%reduction == reduction_none) then
      call keys%complain(group, modes, "needs foil = 'shell' and condensed bumps in &model: "// &
                         'nothing else has modes of its own inside')
    else if (wanted == mass_off) then
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
end module gfb_foil_motion_keys
