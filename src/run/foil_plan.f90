!> What a scene of foils alone needs, and no more; each choice with its reason.
module gfb_foil_plan
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_strip
  use gfb_model_case, only: half_width_auto, half_width_yes, reduction_guyan
  use gfb_modes_case, only: part_words, part_strip
  use gfb_bump_foil_case, only: fixed_edge_none
  use gfb_foil_builder, only: foil_plan_type
  implicit none (type, external)
  private
  public :: plan_foil

contains

  !> Chooses width and reduction, and tells the log why.
  subroutine plan_foil(scene, log, plan)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(foil_plan_type), intent(out) :: plan
    logical :: strip

    strip = scene%general%analysis == analysis_strip
    call log%heading('what the scene needs')
    if (strip) then
      call log%line('bump strip of '//text(scene%bump_foil%bumps)// &
                    ' bumps as shells, corner lines held in v')
    else
      call log%line('modes of the '//trim(part_words(scene%modes%part))//' as shells')
    end if
    plan%half = scene%model%half_width == half_width_yes
    if (scene%model%half_width == half_width_auto) then
      plan%half = strip .and. modulo(scene%mesh%axial_elements, 2) == 0
      if (plan%half) then
        call log%line('width: half, with symmetry at z = 0, because the loads are')
      else if (strip) then
        call log%line('width: whole, because axial_elements is odd')
      else
        call log%line('width: whole, because modes need not be symmetric')
      end if
    else if (plan%half .and. .not. strip) then
      call log%line('width: half, as half_width asks: only modes symmetric about z = 0 are found')
    else
      call log%line('width: '//trim(merge('half ', 'whole', plan%half))//', as half_width asks')
    end if
    plan%reduced = strip .and. scene%model%reduction == reduction_guyan
    if (plan%reduced) then
      call log%line('bumps: condensed onto corners, crests and the free edge, equal ones once')
    else if (strip) then
      call log%line('bumps: all unknowns, as reduction asks')
    end if
    if (scene%bump_foil%fixed_edge == fixed_edge_none .and. &
        (strip .or. scene%modes%part == part_strip)) then
      if (strip) then
        call log%line('strip: fixed nowhere; its gliding on the sleeve is removed at one node')
      else
        call log%line('strip: free; it has six rigid motions')
      end if
    end if
  end subroutine plan_foil
end module gfb_foil_plan
