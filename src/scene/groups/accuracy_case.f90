!> `&accuracy`: how well one number of the answer must be known.
module gfb_accuracy_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, between, from_to
  use gfb_result_names, only: asked_names
  use gfb_result_table, only: name_length, bearing, strip
  use gfb_scene_case, only: analysis_strip, is_bearing, misplaced_group
  implicit none (type, external)
  private
  public :: accuracy_case_type, read_accuracy_case, asked_name

  character(len=*), parameter, public :: all_coefficients = 'coefficients' !! not one number
  character(len=*), parameter, public :: of_vibrations(*) = &
    [character(len=13) :: 'critical_mass', 'whirl_ratio', 'stiffness_xx', 'stiffness_xy', &
     'stiffness_yx', 'stiffness_yy', 'damping_xx', 'damping_xy', 'damping_yx', 'damping_yy', &
     all_coefficients]

  !> The number and its error.
  type :: accuracy_case_type
    logical :: present = .false.    !! the case asks for it
    integer :: quantity = 0         !! number among the names that may be asked for
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
    call keys%choice_key('quantity', accuracy%quantity, asked_names(), &
                         'result whose error is estimated', accuracy%present)
    call keys%real_key('target', accuracy%target, '1', &
                       'error allowed, relative to the result; meshes are refined until the '// &
                       'estimate meets it', between(0.0_wp, 1.0_wp))
    call keys%integer_key('maximum_refinements', accuracy%maximum_refinements, &
                          'refinements, each by two, of a first mesh that is four times '// &
                          'coarser than `&mesh`', &
                          from_to(2.0_wp, 8.0_wp))
  end subroutine read_accuracy_case

  !> Name of the number that must be known so well.
  pure function asked_name(accuracy) result(name)
    type(accuracy_case_type), intent(in) :: accuracy !! with a quantity
    character(len=:), allocatable :: name
    character(len=name_length), allocatable :: names(:)

    names = asked_names()
    name = trim(names(accuracy%quantity))
  end function asked_name
end module gfb_accuracy_case
