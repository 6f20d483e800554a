!> The list of studies: which one a scene asks for, and its run.
module gfb_studies
  use gfb_errors, only: error_type, fail
  use gfb_scene, only: scene_type
  use gfb_quantity, only: quantity_type
  use gfb_text, only: text
  use gfb_machine_memory, only: start_blas
  use gfb_petsc_session, only: rank_count
  use gfb_mesh_case, only: linear_solver_out_of_core
  use gfb_direct_solver, only: keep_factors_on_disk
  use gfb_provenance, only: version_text
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type, run_study
  use gfb_refinement, only: refinement_type
  use gfb_sample, only: sample_type
  use gfb_bearing_study, only: bearing_study_type
  use gfb_sweep_study, only: sweep_study_type
  use gfb_motion_study, only: transient_study_type, periodic_study_type
  use gfb_branches_study, only: branches_study_type
  use gfb_strip_study, only: strip_study_type
  use gfb_modes_study, only: modes_study_type
  use gfb_machine_study, only: machine_study_type
  implicit none (type, external)
  private
  public :: create_study, run_scene

contains

  !> The study of a scene's analysis, on one mesh or on several. Equilibria, small vibrations about
  !> them, and the three limits (load capacity, lift-off, misalignment) are those of a bearing, at
  !> one point or along a sweep.
  !>
  !> Fails where all equilibria are wanted of a scene that has but one.
  subroutine create_study(scene, branches, study, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    logical, intent(in) :: branches !! all equilibria are looked for
    class(study_type), allocatable, intent(out) :: study !! that was chosen
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(refinement_type), allocatable :: refinement
    type(sample_type), allocatable :: sample

    if (branches) call check_branches(scene, error)
    if (allocated(error)) return
    if (allocated(scene%machine)) then
      allocate (machine_study_type :: study)
    else if (scene%general%analysis%loads_strip) then
      allocate (strip_study_type :: study)
    else if (scene%general%analysis%finds_modes) then
      allocate (modes_study_type :: study)
    else if (branches) then
      allocate (branches_study_type :: study)
    else if (scene%transient%present) then
      allocate (transient_study_type :: study)
    else if (scene%periodic%present) then
      allocate (periodic_study_type :: study)
    else if (scene%sweep%present) then
      allocate (sweep_study_type :: study)
    else
      allocate (bearing_study_type :: study)
    end if
    if (scene%sample%present) then
      allocate (sample)
      call move_alloc(study, sample%pattern)
      call move_alloc(sample, study)
    end if
    if (.not. scene%accuracy%present) return
    allocate (refinement)
    call move_alloc(study, refinement%pattern)
    call move_alloc(refinement, study)
  end subroutine create_study

  !> Whether all equilibria of a scene can be looked for; strips and modes have one answer, which is
  !> found as ever.
  !>
  !> Fails where they cannot.
  subroutine check_branches(scene, error)
    type(scene_type), intent(in) :: scene
    type(error_type), allocatable, intent(out) :: error
    character(len=:), allocatable :: why ! the first of these reasons is the last that is set

    why = ''
    associate (analysis => scene%general%analysis)
      if (analysis%has_film .and. &
          .not. (analysis%floats .and. scene%model%foil%has_bumps)) then
        why = "--branches needs analysis = 'equilibrium' and foil = 'shell' or 'beam'"
      end if
    end associate
    if (scene%capacity%limit > 0) then
      why = "--branches needs analysis = 'equilibrium': a limit is looked for on one branch"
    end if
    if (scene%periodic%present) why = "--branches has no use with analysis = 'periodic'"
    if (scene%transient%present) why = "--branches has no use with analysis = 'transient'"
    if (scene%dynamics%present) why = "--branches has no use with analysis = 'linear_dynamics'"
    if (scene%sample%present) why = '&sample: has one answer a member, not all of --branches'
    if (allocated(scene%machine)) why = '--branches has no use with &shaft'
    if (scene%accuracy%present) why = '&accuracy: is for one answer, not for all of --branches'
    if (why /= '') call fail(error, scene%file//': '//why)
  end subroutine check_branches

  !> Computes and writes what a scene asks for.
  !>
  !> Fails on files that cannot be written.
  subroutine run_scene(scene, branches, context, study, summary, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    logical, intent(in) :: branches !! all equilibria are looked for
    type(run_context_type), intent(inout) :: context !! of the run; the restart file is looked for
    class(study_type), allocatable, intent(out) :: study        !! that was done
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what was written of the answer
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call context%log%line(version_text())
    call context%log%line(scene%file//': '//scene%general%title)
    call context%log%line('results go to '//context%folder//', '//text(rank_count())//' rank(s)')
    if (context%petsc_options /= '') then
      call context%log%line('options given to PETSc: '//context%petsc_options)
    end if
    if (scene%hints /= '') call context%log%line(scene%hints)
    if (scene%warnings /= '') call context%log%warned(scene%warnings)
    call start_blas()
    context%reduction = ''
    if (allocated(scene%model%reduction_reason)) then
      context%reduction = 'bumps '//scene%model%reduction_reason
    end if
    if (scene%solver%linear_solver == linear_solver_out_of_core) call keep_factors_on_disk()
    call create_study(scene, branches, study, error)
    if (.not. allocated(error)) call context%take_case(scene%name, error)
    if (allocated(error)) return
    if (scene%accuracy%present .or. scene%sample%present) then
      if (context%resumes) then
        call context%log%line('restart: not with &accuracy or &sample, the run starts anew')
      end if
    else if (.not. branches) then
      call context%find_restart(scene, error)
    end if
    if (.not. allocated(error)) call run_study(study, scene, context, summary, error)
    call context%give_back()
  end subroutine run_scene
end module gfb_studies
