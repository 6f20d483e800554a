!> `&model`: how the bearing is modelled.
module gfb_model_case
  use gfb_kinds, only: wp
  use gfb_analysis_row, only: analysis_row_type
  use gfb_bearing_row, only: bearing_row_type, needs_thrust
  use gfb_case_keys, only: case_keys_type, unless, from_to, positive, longest_list
  use gfb_foil_row, only: foil_row_type, foil_rows, foil_shell
  use gfb_key_effect, only: acts_on_all
  implicit none (type, external)
  private
  public :: model_case_type, read_model_case

  !> What most keys of bumps say to other foils, and then why.
  character(len=*), parameter, public :: needs_meshes = &
    "needs foil = 'shell' in &model, or 'beam': "

  character(len=*), parameter, public :: needs_plate = "needs foil = 'plate' in &model"

  integer, parameter, public :: reduction_guyan = 1 !! bumps condensed onto lines that can be loaded
  integer, parameter, public :: reduction_none = 2
  integer, parameter, public :: reduction_auto = 3  !! whichever costs less

  integer, parameter, public :: half_width_auto = 1
  integer, parameter, public :: half_width_yes = 2
  integer, parameter, public :: half_width_no = 3

  integer, parameter, public :: springs_one_sided = 1 !! they push the top foil alone
  integer, parameter, public :: springs_two_sided = 2 !! they pull it, too

  integer, parameter, public :: film_scheme_auto = 1
  integer, parameter, public :: film_scheme_galerkin = 2
  integer, parameter, public :: film_scheme_supg = 3

  integer, parameter, public :: film_order_bilinear = 1
  integer, parameter, public :: film_order_biquadratic = 2

  integer, parameter, public :: coupling_monolithic = 1
  integer, parameter, public :: coupling_partitioned = 2

  !> Pitch and half length of their bumps grow with the radius: Walowit-Anno's stiffness falls.
  real(wp), parameter :: exponent_of_curved_strips = -4.0_wp

  integer, parameter, public :: foundation_pressure_local = 1
  integer, parameter, public :: foundation_pressure_axial_mean = 2 !! along the rows of nodes
  integer, parameter, public :: foundation_pressure_radial_mean = 3 !! the same of a thrust bearing

  character(len=*), parameter :: reduction_words(*) = [character(len=5) :: 'guyan', 'none', 'auto']
  character(len=*), parameter :: half_words(*) = [character(len=4) :: 'auto', 'yes', 'no']
  character(len=*), parameter :: scheme_words(*) = [character(len=8) :: 'auto', 'galerkin', 'supg']
  character(len=*), parameter :: coupling_words(*) = [character(len=11) :: &
                                                      'monolithic', 'partitioned']
  character(len=*), parameter :: spring_words(*) = [character(len=9) :: 'one_sided', 'two_sided']
  character(len=*), parameter :: pressure_words(*) = [character(len=11) :: 'local', 'axial_mean', &
                                                      'radial_mean']

  !> The model.
  type :: model_case_type
    type(foil_row_type) :: foil                  !! unknown where its word is misspelt
    integer :: reduction = reduction_guyan
    character(len=:), allocatable :: reduction_reason !! of the program's choice, by 'auto'
    integer :: half_width = half_width_auto      !! one half, with symmetry at the midplane
    integer :: film_scheme = film_scheme_auto
    integer :: film_order = film_order_bilinear
    integer :: coupling = coupling_monolithic    !! film and foil together, or in turns
    real(wp) :: foundation_stiffness = 0.0_wp    !! 0: from the bumps; at the mean radius [N/m^3]
    real(wp), allocatable :: cut_radii(:)        !! of a thrust bearing's strips [m]
    real(wp), allocatable :: strip_stiffness(:)  !! of each one; none: all are alike [N/m^3]
    real(wp) :: foundation_exponent = 0.0_wp     !! with which it changes along the radius [1]
    integer :: foundation_pressure = foundation_pressure_axial_mean
    real(wp) :: crest_stiffness = 0.0_wp         !! under a plate; 0: from the bumps [N/m^2]
    integer :: crest_springs = springs_one_sided
    real(wp) :: spring_pitch = 0.0_wp            !! of springs at points; 0: along the lines [m]
  contains
    procedure, non_overridable :: has_strips, has_local_springs
  end type model_case_type

contains

  !> Reads the group.
  subroutine read_model_case(keys, model, bearing, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(model_case_type), intent(out) :: model !! what `&model` asks for
    type(bearing_row_type), intent(in) :: bearing !! the kind of bearing
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: journal !! why keys of one have no use
    integer :: foil !! its number, 0 where it is not known

    journal = trim(bearing%journal_keys)
    call keys%start_group('model', required=analysis%has_film, acts_on=acts_on_all)
    foil = 0
    if (analysis%is_structure()) foil = foil_shell%number
    call keys%choice_key('foil', foil, foil_rows%word, 'model of the foils', analysis%has_film)
    if (foil > 0) model%foil = foil_rows(foil)
    call keys%rule('model', 'foil', analysis%is_structure() .and. foil > 0 .and. &
                   .not. model%foil%has_shell_bumps, "must be 'shell' for strips and modes")
    call keys%choice_key('reduction', model%reduction, reduction_words, 'condense the bumps of '// &
                         'shells onto the lines that can be loaded; `auto`: where that costs '// &
                         'less', useless=unless(.not. model%foil%is_known() .or. &
                         model%foil%has_shell_bumps, "needs foil = 'shell': no other foil is "// &
                         'condensed'))
    call keys%choice_key('half_width', model%half_width, half_words, &
                         'solve one half, with symmetry at the midplane', useless=journal)
    call keys%choice_key('coupling', model%coupling, coupling_words, &
                         'solve film and foil together, or in turns for comparison', &
                         useless=journal)
    call keys%choice_key('film_scheme', model%film_scheme, scheme_words, &
                         'upwinding of the film elements')
    model%film_order = bearing%film_order
    if (max(keys%line_of_group('feed'), keys%line_of_group('grooves')) > 0) then
      model%film_order = film_order_biquadratic
    end if
    call keys%integer_key('film_order', model%film_order, '1: bilinear film elements; 2: '// &
                          'biquadratic ones, with twice as many node intervals each way as '// &
                          'elements (film and foils share the nodes)', from_to(1.0_wp, 2.0_wp), &
                          default='2 for thrust bearings and with &feed or &grooves, '// &
                          'otherwise 1', &
                          useless=unless(.not. analysis%is_structure(), &
                                         'needs a film: strips and modes have none'))
    call keys%rule('model', 'film_order', model%film_order == film_order_biquadratic .and. &
                   model%film_scheme == film_scheme_supg, 'cannot be 2 where film_scheme is '// &
                   "'supg': upwinding is for bilinear elements")
    call read_foundation(keys, model, bearing)
    call read_crest_springs(keys, model)
    call keys%rule('model', 'coupling', model%coupling == coupling_partitioned .and. &
                   model%has_local_springs(), 'cannot be '// &
                   "'partitioned' where foundation_pressure is 'local': springs under each "// &
                   'pressure have no equations of their own')
  end subroutine read_model_case

  !> Springs under every point of the film.
  subroutine read_foundation(keys, model, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(model_case_type), intent(inout) :: model
    type(bearing_row_type), intent(in) :: bearing
    character(len=:), allocatable :: why    !! its keys have no effect
    character(len=:), allocatable :: thrust !! why keys of sectors have no use
    logical :: sectors

    sectors = bearing%has_sectors
    thrust = trim(bearing%thrust_keys)
    why = unless(model%foil%has_foundation, "it needs foil = 'elastic_foundation' in &model")
    if (model%foil%has_crest_springs) why = "foil = '"//trim(model%foil%word)//"' does not know it"
    call keys%idle(why)
    call keys%real_key('foundation_stiffness', model%foundation_stiffness, 'N/m^3', &
                       'pressure over deflection of the elastic foundation', positive, &
                       default='Walowit-Anno from `&bump_foil`')
    if (sectors .and. .not. model%foundation_stiffness > 0.0_wp) then
      model%foundation_exponent = exponent_of_curved_strips
    end if
    call keys%real_key('foundation_exponent', model%foundation_exponent, '1', 'exponent n of '// &
                       'the radius in a thrust bearing: foundation_stiffness is that at the '// &
                       'mean radius, elsewhere it is (r/r_m)^n times that', from_to(-20.0_wp, &
                       20.0_wp), default='0; -4, of curved strips, where `&bump_foil` gives '// &
                       'the stiffness', useless=thrust)
    if (sectors) model%foundation_pressure = foundation_pressure_local
    call keys%real_list_key('strip_foundation_stiffness', model%strip_stiffness, longest_list, &
                            'N/m^3', 'of the strips of a thrust bearing, from the inner radius '// &
                            'on, in the place of foundation_stiffness', positive, .false., &
                            'none', useless=thrust)
    call keys%real_list_key('cut_radii', model%cut_radii, longest_list, 'm', 'radii where '// &
                            'these strips meet, rising', positive, .false., 'none', &
                            useless=thrust)
    call keys%choice_key('foundation_pressure', model%foundation_pressure, pressure_words, &
                         'what deflects the foundation: the pressure at each point, which '// &
                         'leaves the edges undeflected, its mean along the axis, or along '// &
                         'the radius of a thrust bearing')
    call keys%rule('model', 'foundation_pressure', sectors .and. model%foundation_pressure == &
                   foundation_pressure_axial_mean, "must be 'local' or 'radial_mean' with "// &
                   "kind = 'thrust' in &bearing")
    call keys%rule('model', 'foundation_pressure', .not. sectors .and. &
                   model%foundation_pressure == foundation_pressure_radial_mean, needs_thrust)
    ! One model, whichever way the rows of nodes lie.
    if (model%foundation_pressure == foundation_pressure_radial_mean) then
      model%foundation_pressure = foundation_pressure_axial_mean
    end if
    call keys%idle('')
  end subroutine read_foundation

  !> What a plate lies on.
  subroutine read_crest_springs(keys, model)
    type(case_keys_type), intent(inout) :: keys
    type(model_case_type), intent(inout) :: model
    character(len=:), allocatable :: useless

    useless = unless(model%foil%has_crest_springs .or. .not. model%foil%is_known(), needs_plate)
    call keys%real_key('crest_stiffness', model%crest_stiffness, 'N/m^2', 'line force over '// &
                       'deflection of the crests under a plate', positive, default= &
                       'Walowit-Anno from `&bump_foil`, times the pitch', useless=useless)
    call keys%choice_key('crest_springs', model%crest_springs, spring_words, 'whether the '// &
                         'crests push the plate alone, which can lift, or hold it', &
                         useless=useless)
    call keys%real_key('spring_pitch', model%spring_pitch, 'm', 'from spring to spring along '// &
                       'a crest, each of crest_stiffness times it: coil springs under a plate', &
                       positive, default='none: crests are lines of springs', useless=useless)
    call keys%rule('model', 'coupling', model%coupling == coupling_partitioned .and. &
                   .not. model%foil%can_take_turns, "cannot be 'partitioned' with foil = '"// &
                   trim(model%foil%word)//"'")
  end subroutine read_crest_springs

  !> Whether strips side by side have their own stiffness.
  pure logical function has_strips(self) result(has)
    class(model_case_type), intent(in) :: self !! what `&model` asks for
    has = allocated(self%strip_stiffness)
    if (has) has = size(self%strip_stiffness) > 0
  end function has_strips

  !> Whether the foil is springs that feel the pressure at their point alone, and have no unknowns.
  pure logical function has_local_springs(self) result(has)
    class(model_case_type), intent(in) :: self !! what `&model` asks for
    has = self%foil%has_foundation .and. self%foundation_pressure == foundation_pressure_local
  end function has_local_springs
end module gfb_model_case
