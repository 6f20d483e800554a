!> The list of analyses: what each is called, what it finds, which groups it has a use for, and a
!> case file that shows it. Whoever needs to know asks the row; which row it is matters to nobody.
module gfb_analysis_row
  implicit none (type, external)
  private
  public :: machine_row

  integer, parameter, public :: limit_load = 1  !! the largest that leaves the film
  integer, parameter, public :: limit_speed = 2 !! the one that lifts the asperities off
  integer, parameter, public :: limit_tilt = 3  !! the largest that leaves the film
  integer, parameter, public :: limit_supply = 4 !! the lowest pressure of it that leaves the film

  character(len=*), parameter :: of_bearings = ' bearing pads ramp bore gas feed grooves '// &
    'thermal shaft_contact operation sweep contact accuracy sample capacity'
  character(len=*), parameter :: offered_often = ' pads bore feed grooves thermal '// &
    'shaft_contact sweep'

  character(len=*), parameter :: bearing = &
    '&bearing radius=19.05e-3 length=38.1e-3 clearance=31.8e-6 / '// &
    '&gas viscosity=1.95e-5 ambient_pressure=1.0135e5 / &pads preload=0.1 / '// &
    '&bore waves=3 wave_amplitude=1.0e-6 / &shaft_contact roughness=0.5e-6 pressure=10.0e6 / '// &
    "&grooves on='shaft' angle=0.5 depth=20.0e-6 band_begin=-19.05e-3, 4.0e-3 "// &
    "band_end=-4.0e-3, 19.05e-3 pumping='up', 'down' / "
  !> The bump foil of [Gu2020], case 1, but for its fixed edge.
  character(len=*), parameter :: bumps = '&bump_foil thickness=0.102e-3 youngs_modulus=214.0e9 '// &
    'poissons_ratio=0.29 half_length=1.778e-3 height=0.508e-3 pitch=4.572e-3 '
  character(len=*), parameter :: holes = "&feed kind='orifices' supply_pressure=6.0e5 "// &
    'orifice_diameter=0.2e-3 orifices=8 row_positions=-10.0e-3, 10.0e-3 '
  character(len=*), parameter :: beams = bearing//holes//"through='top_foil' / "// &
    '&top_foil thickness=0.102e-3 youngs_modulus=214.0e9 poissons_ratio=0.29 '// &
    "fixed_edge='trailing' / "//bumps//"bumps=26 fixed_edge='trailing' "// &
    "fixed_line='half_flat' / &contact friction_top=0.1 friction_sleeve=0.1 / "// &
    "&model foil='beam' / &operation speed_rpm=30000.0 "
  character(len=*), parameter :: load = 'load=-100.0, 0.0 /'
  character(len=*), parameter :: loads = load//"&sweep parameter='load' values=100.0, 90.0, 80.0 /"
  character(len=*), parameter :: derivatives = "&sensitivity quantity='minimum_gap' "// &
    "parameters='bearing%clearance', 'gas%viscosity' tolerances=1.0e-6, 2.0e-7 / "// &
    "&accuracy quantity='minimum_gap' /"
  character(len=*), parameter :: sample = '&sample count=100 /'
  character(len=*), parameter :: heat = &
    ' &thermal shaft_conductance=0.3 sleeve_conductance=1.0 '// &
    'bump_conductance=190.0 shaft_expansion=12.0e-6 sleeve_expansion=12.0e-6 /'

  !> An analysis. One that is not known, as where its word is misspelt, finds and refuses nothing.
  type, public :: analysis_row_type
    integer :: number = 0            !! place in the list; 0: it is not known
    character(len=22) :: word = ''   !! in the case file
    logical :: has_film = .false.    !! there are a shaft and a film, else foils alone
    logical :: floats = .false.      !! the shaft finds the place where it carries a given load
    logical :: holds = .false.       !! its place is given; of both what `&operation` has
    logical :: loads_strip = .false. !! a bump foil alone, in load steps
    logical :: finds_modes = .false. !! natural ones of a foil, or a part of it
    logical :: is_machine = .false.  !! of a shaft in several bearings, each a case of its own
    integer :: limit = 0             !! `limit_load`, ...: of what a limit is looked for; 0: none is
    character(len=22) :: limit_result = '' !! its name among the results
    character(len=200) :: groups = ''   !! of the case file, where others have no use for them
  contains
    procedure, non_overridable :: is_known, is_structure, takes, refusal
  end type analysis_row_type

  !> What shows an analysis: a case file that can be run. No scene carries it along.
  type, public :: analysis_example_type
    character(len=100) :: offered = '' !! groups of it that stand in comments
    character(len=1600) :: text = ''  !! the file but for `&scene`; it has an answer
  contains
    procedure :: offers
  end type analysis_example_type

  type(analysis_row_type), parameter, public :: analysis_unknown = analysis_row_type()

  type(analysis_row_type), parameter, public :: analysis_equilibrium = analysis_row_type( &
    number=1, word='equilibrium', has_film=.true., floats=.true., &
    groups=of_bearings//' sensitivity ')

  type(analysis_row_type), parameter, public :: analysis_fixed_position = analysis_row_type( &
    number=2, word='fixed_position', has_film=.true., holds=.true., &
    groups=of_bearings//' sensitivity ')

  type(analysis_row_type), parameter, public :: analysis_strip = analysis_row_type( &
    number=3, word='strip', loads_strip=.true., groups=' strip_load contact accuracy sample ')

  type(analysis_row_type), parameter, public :: analysis_modes = analysis_row_type( &
    number=4, word='modes', finds_modes=.true., groups=' modes ')

  type(analysis_row_type), parameter, public :: analysis_linear_dynamics = analysis_row_type( &
    number=5, word='linear_dynamics', has_film=.true., floats=.true., holds=.true., &
    groups=of_bearings//' dynamics rotor foil_damping sensitivity ')

  type(analysis_row_type), parameter, public :: analysis_load_capacity = analysis_row_type( &
    number=6, word='load_capacity', has_film=.true., floats=.true., limit=limit_load, &
    limit_result='load_capacity', groups=of_bearings//' ')

  type(analysis_row_type), parameter, public :: analysis_lift_off = analysis_row_type( &
    number=7, word='lift_off', has_film=.true., floats=.true., limit=limit_speed, &
    limit_result='lift_off_speed_rpm', groups=of_bearings//' ')

  type(analysis_row_type), parameter, public :: analysis_misalignment = analysis_row_type( &
    number=8, word='misalignment_allowance', has_film=.true., floats=.true., limit=limit_tilt, &
    limit_result='misalignment_allowance', groups=of_bearings//' ')

  type(analysis_row_type), parameter, public :: analysis_transient = analysis_row_type( &
    number=9, word='transient', has_film=.true., floats=.true., holds=.true., &
    groups=of_bearings//' transient rotor unbalance foil_damping ')

  type(analysis_row_type), parameter, public :: analysis_periodic = analysis_row_type( &
    number=10, word='periodic', has_film=.true., floats=.true., &
    groups=of_bearings//' periodic rotor unbalance foil_damping ')

  character(len=*), parameter :: of_machines = ' shaft discs bearings loads machine '

  !> Those of a machine; each is called as that of one bearing.
  type(analysis_row_type), parameter :: machine_rows(*) = [ &
    analysis_row_type(number=1, word='equilibrium', is_machine=.true., &
                      groups=of_machines//' sweep '), &
    analysis_row_type(number=5, word='linear_dynamics', is_machine=.true., &
                      groups=of_machines//' sweep dynamics unbalance '), &
    analysis_row_type(number=9, word='transient', is_machine=.true., &
                      groups=of_machines//' transient unbalance '), &
    analysis_row_type(number=10, word='periodic', is_machine=.true., &
                      groups=of_machines//' periodic unbalance ')]

  !> Each at the place of its number.
  type(analysis_row_type), parameter, public :: analysis_rows(*) = &
    [analysis_equilibrium, analysis_fixed_position, analysis_strip, analysis_modes, &
     analysis_linear_dynamics, analysis_load_capacity, analysis_lift_off, analysis_misalignment, &
     analysis_transient, analysis_periodic]

  !> In the order of the rows. Nothing would lift off without asperities, and no orbit closes where
  !> contacts rub.
  type(analysis_example_type), parameter, public :: analysis_examples(size(analysis_rows)) = [ &
    analysis_example_type(offered_often//' sensitivity accuracy sample ', &
      beams//loads//derivatives//sample//heat), &
    analysis_example_type(offered_often//' sensitivity accuracy sample ', &
      beams//'eccentricity=30.0e-6, 9.0e-6 /'// &
      "&sweep parameter='eccentricity_x' values=30.0e-6, 29.0e-6, 28.0e-6 /"// &
      derivatives//sample//heat), &
    analysis_example_type(' accuracy ', &
      bumps//"bumps=10 width=38.1e-3 fixed_edge='leading' / "// &
      "&contact friction_sleeve=0.1 / &strip_load kind='crest_pressure' pressure=0.2e6 "// &
      "steps_up=10 / &accuracy quantity='maximum_deflection' /"), &
    analysis_example_type('', &
      bumps//"bumps=4 density=8440.0 width=38.1e-3 fixed_edge='leading' / "// &
      "&modes part='strip' count=6 /"), &
    analysis_example_type(offered_often//' rotor ', &
      beams//loads//'&dynamics frequency_ratios=0.5, 1.0 / &rotor mass=1.0 /'//heat), &
    analysis_example_type(offered_often//' accuracy sample ', &
      beams//load//"&sweep parameter='speed_rpm' values=30000.0, 25000.0, 20000.0 / "// &
      "&capacity smallest_gap=4.0e-6 / &accuracy quantity='load_capacity' /"//sample//heat), &
    analysis_example_type(' pads bore feed grooves thermal sweep accuracy sample ', &
      beams//loads//'&capacity contact_part=0.01 / '// &
      "&accuracy quantity='lift_off_speed_rpm' /"//sample//heat), &
    analysis_example_type(offered_often//' accuracy sample ', &
      beams//loads//'&capacity smallest_gap=4.0e-6 / '// &
      "&accuracy quantity='misalignment_allowance' /"//sample//heat), &
    analysis_example_type(' pads bore feed grooves thermal shaft_contact ', &
      beams//load//'&rotor mass=1.0 / &transient turns=0.2 / '// &
      '&unbalance unbalance=2.0e-6 /'//heat), &
    analysis_example_type(' pads bore feed grooves shaft_contact ', &
      bearing//holes//"/ &model foil='elastic_foundation' foundation_stiffness=4.8243e9 / "// &
      '&mesh circumferential_elements=48 axial_elements=6 / '// &
      '&operation speed_rpm=30000.0 load=-60.0, 0.0 / &rotor mass=1.5 / '// &
      '&periodic steps_per_turn=40 / &unbalance unbalance=1.5e-6 / '// &
      '&foil_damping foundation_damping=3.0e5 /')]

contains

  !> The same analysis of a machine; where a machine has none it is that of one bearing.
  pure type(analysis_row_type) function machine_row(analysis) result(row)
    type(analysis_row_type), intent(in) :: analysis !! of one bearing
    integer :: i

    row = analysis
    do i = 1, size(machine_rows)
      if (machine_rows(i)%number == analysis%number) row = machine_rows(i)
    end do
  end function machine_row

  !> Whether the case file says which analysis is asked for.
  pure logical function is_known(self) result(known)
    class(analysis_row_type), intent(in) :: self !! the analysis, as far as it is known
    known = self%number > 0
  end function is_known

  !> Whether it is of foils alone.
  pure logical function is_structure(self) result(structure)
    class(analysis_row_type), intent(in) :: self !! the analysis
    structure = self%is_known() .and. .not. self%has_film
  end function is_structure

  !> Whether it has a use for a group of the case file.
  pure logical function takes(self, group)
    class(analysis_row_type), intent(in) :: self !! the analysis
    character(len=*), intent(in) :: group !! its name
    takes = index(self%groups, ' '//group//' ') > 0
  end function takes

  !> Whether a group stands in a comment.
  pure logical function offers(self, group)
    class(analysis_example_type), intent(in) :: self !! the example
    character(len=*), intent(in) :: group !! its name
    offers = index(self%offered, ' '//group//' ') > 0
  end function offers

  !> What is wrong with a group that it has no use for; empty where nothing is.
  pure function refusal(self, group) result(words)
    class(analysis_row_type), intent(in) :: self !! the analysis
    character(len=*), intent(in) :: group !! its name
    character(len=:), allocatable :: words

    words = ''
    if (self%takes(group) .or. .not. self%is_known()) return
    words = "has no use with analysis = '"//trim(self%word)//"'"
    if (self%is_machine) words = 'has no use in the case of a machine: bearings have files of '// &
      'their own'
  end function refusal
end module gfb_analysis_row
