!> The list of studies: which one a scene asks for.
module gfb_studies
  use gfb_errors, only: error_type, fail
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium, analysis_strip, analysis_modes
  use gfb_model_case, only: meshes_foils
  use gfb_study, only: study_type
  use gfb_refinement, only: refinement_type
  use gfb_sample, only: sample_type
  use gfb_bearing_study, only: bearing_study_type
  use gfb_branches_study, only: branches_study_type
  use gfb_strip_study, only: strip_study_type
  use gfb_modes_study, only: modes_study_type
  implicit none (type, external)
  private
  public :: create_study

contains

  !> The study of a scene's analysis, on one mesh or on several.
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
    select case (scene%general%analysis)
    case (analysis_strip)
      allocate (strip_study_type :: study)
    case (analysis_modes)
      allocate (modes_study_type :: study)
    case default
      if (branches) then
        allocate (branches_study_type :: study)
      else
        allocate (bearing_study_type :: study)
      end if
    end select
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

  !> Whether all equilibria of a scene can be looked for.
  !>
  !> Fails where they cannot.
  subroutine check_branches(scene, error)
    type(scene_type), intent(in) :: scene
    type(error_type), allocatable, intent(out) :: error

    if (scene%accuracy%present) then
      call fail(error, scene%file//': &accuracy: is for one answer, not for all of --branches')
      return
    end if
    if (scene%sample%present) then
      call fail(error, scene%file//': &sample: has one answer a member, not all of --branches')
      return
    end if
    if (scene%dynamics%present) then
      call fail(error, scene%file//": --branches has no use with analysis = 'linear_dynamics'")
      return
    end if
    if (scene%transient%present) then
      call fail(error, scene%file//": --branches has no use with analysis = 'transient'")
      return
    end if
    if (scene%periodic%present) then
      call fail(error, scene%file//": --branches has no use with analysis = 'periodic'")
      return
    end if
    if (scene%capacity%question > 0) then
      call fail(error, scene%file//": --branches needs analysis = 'equilibrium': a limit is "// &
                'looked for on one branch')
      return
    end if
    select case (scene%general%analysis)
    case (analysis_strip, analysis_modes) ! they have one answer, which is found as ever
    case default
      if (scene%general%analysis == analysis_equilibrium .and. &
          meshes_foils(scene%model%foil)) return
      call fail(error, scene%file//": --branches needs analysis = 'equilibrium' and "// &
                "foil = 'shell' or 'beam'")
    end select
  end subroutine check_branches
end module gfb_studies
