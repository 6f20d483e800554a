!> Gaps at crests need a model in which crests touch something, sizes bump by bump one that has the
!> bumps.
module gfb_crest_gap_rules
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: meshes_foils
  use gfb_modes_case, only: part_strip, part_top_foil
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_modes, analysis_strip, is_bearing
  use gfb_strip_load_case, only: load_plates
  use gfb_text, only: text
  use gfb_kinds, only: wp
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
          if (scene%bump_foil%strips > 1) call keys%complain('bump_foil', 'strips', words)
        end if
      else if (analysis == analysis_modes .and. part > 0) then
        if (scene%bump_foil%strips > 1) then
          call keys%complain('bump_foil', 'strips', 'must be 1 for modes: each strip has its own')
        end if
        if (part /= part_strip .and. part /= part_top_foil) then
          words = "needs part = 'strip' in &modes: the other parts are those of one bump"
        end if
      else if (analysis == analysis_strip .and. scene%bump_foil%strips > 1 .and. &
               scene%mesh%edge_refinement > 1.0_wp) then
        call keys%complain('mesh', 'edge_refinement', 'must be 1 for strips side by side: each '// &
                           'has equal rows')
      end if
    end associate
    call complain_of(keys, key, words)
    call check_nested_strips(keys, scene)
  end subroutine check_bump_sizes

  !> Complains where the meshes of an estimated error would not refine each other: each must share
  !> its elements out evenly among the strips.
  subroutine check_nested_strips(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: multiple

    if (scene%bump_foil%strips <= 1 .or. .not. scene%accuracy%present) return
    multiple = merge(4, 8, modulo(scene%bump_foil%strips, 2) == 0)*scene%bump_foil%strips
    if (modulo(scene%mesh%axial_elements, multiple) == 0) return
    call keys%complain('bump_foil', 'strips', 'needs axial_elements in &mesh that are a '// &
                       'multiple of '//text(multiple)//', not '// &
                       text(scene%mesh%axial_elements)//', so that the meshes of &accuracy '// &
                       'refine each other')
  end subroutine check_nested_strips

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
