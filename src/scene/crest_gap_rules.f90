!> Gaps at crests need a model in which crests touch something, sizes bump by bump one that has the
!> bumps.
module gfb_crest_gap_rules
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: meshes_foils
  use gfb_modes_case, only: part_strip, part_top_foil
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_modes, analysis_strip, is_bearing
  use gfb_strip_load_case, only: load_plates
  implicit none (type, external)
  private
  public :: check_crest_gaps, check_bump_sizes

contains

  !> Complains about gaps where no crest can close one.
  subroutine check_crest_gaps(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: key(*) = [character(len=16) :: 'crest_gap', 'height_deviation']
    character(len=:), allocatable :: words

    words = ''
    associate (analysis => scene%general%analysis)
      if (is_bearing(analysis) .and. scene%model%foil > 0) then
        if (.not. meshes_foils(scene%model%foil)) then
          words = "needs foil = 'shell' in &model, or 'beam': no other foil has crests"
        end if
      else if (analysis == analysis_strip .and. scene%strip_load%kind /= load_plates) then
        words = "needs kind = 'plates' in &strip_load: a force that is given acts on its crest "// &
                'wherever that is'
      else if (analysis == analysis_modes) then
        words = 'needs a bearing or a strip between plates: modes are those of foils that '// &
                'touch nothing'
      end if
    end associate
    call complain_of(keys, key, words)
  end subroutine check_crest_gaps

  !> Complains about sizes bump by bump where there is one bump, or none.
  subroutine check_bump_sizes(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: key(*) = [character(len=16) :: 'bump_pitch', &
                                             'bump_half_length', 'bump_height', 'bump_thickness']
    character(len=:), allocatable :: words

    words = ''
    associate (analysis => scene%general%analysis, part => scene%modes%part)
      if (is_bearing(analysis) .and. scene%model%foil > 0) then
        if (.not. meshes_foils(scene%model%foil)) then
          words = "needs foil = 'shell' in &model, or 'beam': no other foil has bumps"
        end if
      else if (analysis == analysis_modes .and. part > 0) then
        if (part /= part_strip .and. part /= part_top_foil) then
          words = "needs part = 'strip' in &modes: the other parts are those of one bump"
        end if
      end if
    end associate
    call complain_of(keys, key, words)
  end subroutine check_bump_sizes

  !> Complains about keys of the bump foil that stand in the file; not where there are no words.
  subroutine complain_of(keys, key, words)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: key(:), words
    integer :: i

    if (words == '') return
    do i = 1, size(key)
      if (.not. keys%meant('bump_foil', trim(key(i)))) cycle
      call keys%complain('bump_foil', trim(key(i)), words)
    end do
  end subroutine complain_of
end module gfb_crest_gap_rules
