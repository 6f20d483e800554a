!> `&accuracy`: how well one number of the answer must be known.
module gfb_accuracy_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_scene_case, only: analysis_strip, is_bearing, misplaced_group
  use gfb_output_case, only: output_case_type
  use gfb_sweep_case, only: sweep_case_type
  use gfb_value_rules, only: between, from_to
  implicit none (type, external)
  private
  public :: accuracy_case_type, read_accuracy_case, check_accuracy

  integer, parameter :: first_of_strips = 15 !! among the words

  !> Names of the summary; first those of bearings, then those of strips.
  character(len=*), parameter, public :: accuracy_words(*) = [character(len=24) :: &
                                         'eccentricity_x', 'eccentricity_y', 'attitude_angle', &
                                         'force_x', 'force_y', 'torque_x', 'torque_y', &
                                         'friction_torque', 'power_loss', 'minimum_gap', &
                                         'minimum_gap_midplane', 'minimum_gap_edge', &
                                         'maximum_pressure', 'minimum_pressure', &
                                         'maximum_deflection', 'maximum_force', &
                                         'loading_stiffness', 'dissipated_energy']

  !> The number and its error.
  type :: accuracy_case_type
    logical :: present = .false.    !! the case asks for it
    integer :: quantity = 0         !! place among the words
    real(wp) :: target = 1.0e-2_wp  !! error allowed, relative
    integer :: maximum_refinements = 4 !! of the first mesh, each by two
  end type accuracy_case_type

contains

  !> Reads the group.
  subroutine read_accuracy_case(keys, accuracy, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(accuracy_case_type), intent(out) :: accuracy !! what `&accuracy` asks for
    integer, intent(in) :: analysis !! 0 where it is not known

    call keys%start_group('accuracy', optional=.true., present_in_file=accuracy%present, &
                          misplaced=misplaced_group(analysis, is_bearing(analysis) .or. &
                                                    analysis == analysis_strip))
    call keys%choice_key('quantity', accuracy%quantity, accuracy_words, &
                         'the number that must be known so well', accuracy%present)
    call keys%real_key('target', accuracy%target, '1', &
                       'error allowed, over the number itself; meshes are refined until the '// &
                       'estimate meets it', between(0.0_wp, 1.0_wp))
    call keys%integer_key('maximum_refinements', accuracy%maximum_refinements, &
                          'of a mesh four times as coarse as `&mesh` says, each by two', &
                          from_to(2.0_wp, 8.0_wp))
    call keys%finish_group()
  end subroutine read_accuracy_case

  !> The number must be one of the analysis, and of one answer.
  subroutine check_accuracy(keys, accuracy, sweep, output, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(accuracy_case_type), intent(in) :: accuracy !! what `&accuracy` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    type(output_case_type), intent(in) :: output !! what `&output` asks for
    integer, intent(in) :: analysis !! 0 where it is not known

    if (.not. accuracy%present .or. analysis == 0) return
    if (accuracy%quantity > 0) then
      if (is_bearing(analysis) .neqv. accuracy%quantity < first_of_strips) then
        call keys%complain('accuracy', 'quantity', 'is no number of this analysis')
      end if
    end if
    if (sweep%present) then
      call keys%complain('accuracy', 'quantity', 'needs a scene of one answer, without &sweep')
    end if
    if (output%restart_every > 0) then
      call keys%complain('accuracy', 'quantity', 'is found on several meshes: no restart file '// &
                         'goes on with them, so restart_every must be 0')
    end if
  end subroutine check_accuracy
end module gfb_accuracy_case
