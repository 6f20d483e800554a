!> A scene that is looked at and not computed.
module gfb_check_scene
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_partition, only: division_type, divide, no_chain
  use gfb_film_mesh, only: axial_rows
  use gfb_model_case, only: reduction_guyan
  use gfb_foil_builder, only: foil_plan_type
  use gfb_part_builder, only: foil_chain
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: divide_bearing, film_mesh_of
  use gfb_petsc_session, only: rank_count
  use gfb_bearing_plan, only: plan_bearing
  use gfb_foil_plan, only: plan_foil
  use gfb_study, only: study_type
  use gfb_provenance, only: version_text
  implicit none (type, external)
  private
  public :: check_scene

contains

  !> Shares of a bearing, or of the foil that is alone.
  !>
  !> Fails when METIS does.
  subroutine show_partition(scene, ranks, log, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    integer, intent(in) :: ranks !! that share
    type(run_log_type), intent(in) :: log !! where lines go
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(bearing_plan_type) :: plan
    type(foil_plan_type) :: foil_plan
    type(division_type) :: division
    type(run_log_type) :: silent
    logical :: reduced
    integer :: rows

    if (allocated(scene%machine)) then
      call fail(error, scene%file//': shares of ranks are shown of one bearing, not of a machine')
      return
    end if
    silent%active = .false.
    if (scene%general%analysis%has_film) then
      reduced = .not. scene%model%foil%has_shell_bumps .or. scene%model%reduction == reduction_guyan
      call plan_bearing(scene, silent, plan)
      call divide_bearing(scene, film_mesh_of(scene, plan), ranks, division, error)
    else
      call plan_foil(scene, silent, foil_plan)
      reduced = foil_plan%reduced
      rows = size(axial_rows(1.0_wp, scene%mesh%axial_elements, foil_plan%half, 1.0_wp))
      call divide(no_chain(), foil_chain(scene, rows, reduced), ranks, division, error)
    end if
    if (allocated(error)) return
    call show_shares(division, reduced, log)
    if (scene%general%analysis%has_film .and. .not. scene%model%foil%has_shell_bumps) then
      call log%line('beams, if any, are the first rank''s')
    end if
  end subroutine show_partition

  !> A line a share.
  subroutine show_shares(division, reduced, log)
    type(division_type), intent(in) :: division
    logical, intent(in) :: reduced !! the bump foil's pieces are super-elements, else columns
    type(run_log_type), intent(in) :: log
    character(len=80) :: line
    real(wp) :: share
    integer :: i

    call log%heading('partition')
    call log%line(' rank  film columns  '//merge('super-elements', '  foil columns', reduced)// &
      '    unknowns  of the mean')
    do i = 1, division%parts
      share = real(division%load(i)*division%parts, wp)/real(max(1, sum(division%load)), wp)
      write (line, '(i5, i14, i16, i12, f12.2)') i - 1, count(division%film == i), &
        count(division%bumps == i), division%load(i), share
      call log%line(trim(line))
    end do
    call log%line('largest load over the mean: '//text(division%balance(), 4))
    call log%line('joints between pieces that are cut: '//text(division%cut)//' of '// &
      text(division%joints))
  end subroutine show_shares

  !> Says what a scene needs, and that it is in order; how it is shared out where that is asked for.
  !>
  !> Takes the steps of a run up to its first equation, and fails where the run would.
  subroutine check_scene(scene, study, shares, log, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    class(study_type), intent(inout) :: study !! that it asks for
    integer, intent(in) :: shares !! ranks whose shares to show; 0: those of the job; negative: none
    type(run_log_type), intent(in) :: log !! where lines go
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: ranks

    call log%line(version_text())
    call log%line(scene%file//': '//scene%general%title)
    call study%prepare(scene, log)
    call study%check(scene, error)
    if (allocated(error)) return
    ranks = shares
    if (shares == 0) ranks = rank_count()
    if (shares >= 0) call show_partition(scene, ranks, log, error)
    if (allocated(error)) return
    call log%line('')
    if (scene%hints /= '') call log%tell(scene%hints)
    if (scene%warnings /= '') call log%tell(scene%warnings)
    call log%tell(scene%file//' is in order')
  end subroutine check_scene
end module gfb_check_scene
