!> Reads the groups that say what is done with answers: written, refined, repeated.
module gfb_study_groups
  use gfb_accuracy_case, only: read_accuracy_case
  use gfb_case_keys, only: case_keys_type
  use gfb_output_case, only: read_output_case
  use gfb_sample_case, only: read_sample_case
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: misplaced_group, analysis_modes
  use gfb_sensitivity_case, only: read_sensitivity_case
  implicit none (type, external)
  private
  public :: read_study_groups

contains

  !> Reads them, behind the groups that say what is computed.
  subroutine read_study_groups(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(inout) :: scene !! gets what they say; its analysis is the file's

    call read_output_case(keys, scene%output)
    associate (analysis => scene%general%analysis)
      call read_sensitivity_case(keys, scene%sensitivity, analysis)
      call read_accuracy_case(keys, scene%accuracy, analysis)
      call read_sample_case(keys, scene%sample, &
                            misplaced_group(analysis, analysis /= analysis_modes))
    end associate
  end subroutine read_study_groups
end module gfb_study_groups
