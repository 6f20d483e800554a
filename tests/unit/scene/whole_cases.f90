!> Cases whose groups are read, and not judged together yet: for tests of one rule between groups.
module whole_cases
  use gfb_case_keys, only: case_keys_type
  use gfb_scene, only: scene_type, read_groups
  implicit none (type, external)
  private
  public :: read_whole

  character(len=*), parameter, public :: bearing = &
    '&bearing radius=0.02 length=0.04 clearance=3e-5 / &gas viscosity=2e-5 ambient_pressure=1e5 / '
  character(len=*), parameter, public :: rigid = bearing//"&model foil='rigid' / "
  !> A bump foil and a top foil with all that a bearing of beams needs.
  character(len=*), parameter, public :: foils = &
    '&top_foil thickness=1e-4 youngs_modulus=2e11 poissons_ratio=0.3 / &bump_foil bumps=20 '// &
    'half_length=1.5e-3 pitch=6e-3 height=5e-4 thickness=1e-4 youngs_modulus=2e11 '// &
    'poissons_ratio=0.3 '

contains

  !> Reads all groups of a case that has no mistake by itself.
  subroutine read_whole(words, keys, scene)
    character(len=*), intent(in) :: words !! of the case file
    type(case_keys_type), intent(out) :: keys !! all read; gets what the rules complain about
    type(scene_type), intent(out) :: scene !! as it was read

    call keys%open_text(words, 'f')
    call read_groups(keys, scene)
    call keys%finish()
    if (keys%mistakes() == 0) return
    error stop 'a case of a test has mistakes of its own'
  end subroutine read_whole
end module whole_cases
