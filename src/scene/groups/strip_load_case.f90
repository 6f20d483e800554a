!> `&strip_load`: what presses on a bump strip, and what it rests on.
module gfb_strip_load_case
  use gfb_kinds, only: wp
  use gfb_foil_cases, only: bump_foil_case_type, solid_width
  use gfb_curved_bump, only: known_stiffness
  use gfb_case_keys, only: case_keys_type, longest_list, unless, any_value, from_to, positive
  use gfb_analysis_row, only: analysis_row_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: strip_load_case_type, read_strip_load_case, crest_forces
  public :: bump_stiffness, typical_deflection

  integer, parameter, public :: load_crest_pressure = 1
  integer, parameter, public :: load_plates = 2 !! two rigid planes, the upper one moved or forced

  integer, parameter, public :: distribution_uniform = 1
  integer, parameter, public :: distribution_increasing_decreasing = 2
  integer, parameter, public :: distribution_table = 3

  integer, parameter, public :: support_contact = 1 !! corner lines rest on the sleeve, and can lift
  integer, parameter, public :: support_held = 2    !! corner lines cannot move in v

  character(len=*), parameter :: kind_words(*) = [character(len=14) :: 'crest_pressure', 'plates']
  character(len=*), parameter :: distribution_words(*) = [character(len=21) :: 'uniform', &
                                                          'increasing_decreasing', 'table']
  character(len=*), parameter :: support_words(*) = [character(len=7) :: 'contact', 'held']
  character(len=*), parameter :: not_with_plates = "has no use with kind = 'plates'"
  real(wp), parameter :: most_steps = 1.0e6_wp

  !> The load of a strip.
  type :: strip_load_case_type
    integer :: kind = load_crest_pressure
    integer :: distribution = distribution_uniform
    real(wp) :: pressure = 0.0_wp              !! the uniform one, or the peak [Pa]
    real(wp), allocatable :: bump_pressure(:)  !! one a bump [Pa]
    real(wp) :: maximum_force = 0.0_wp         !! on the plate; 0: it is moved [N]
    real(wp) :: maximum_displacement = 0.0_wp  !! of the plate; 0: it is forced [m]
    integer :: steps_up = 10
    integer :: steps_down = 0
    integer :: support = support_contact
  end type strip_load_case_type

contains

  !> Reads the group.
  subroutine read_strip_load_case(keys, load, bumps, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(strip_load_case_type), intent(out) :: load !! what `&strip_load` asks for
    integer, intent(in) :: bumps    !! of the strip, 0 where not known
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    logical :: needed

    needed = analysis%takes('strip_load')
    call keys%start_group('strip_load', required=needed, optional=.not. needed, &
                          misplaced=analysis%refusal('strip_load'))
    call keys%choice_key('kind', load%kind, kind_words, 'how the strip is loaded: pressure on '// &
                         'its crests, or two rigid plates')
    ! Plates have none, and their echo must not show one.
    call keys%choice_key('distribution', load%distribution, distribution_words, 'distribution '// &
                         'of the crest pressure over the bumps', &
                         useless=unless(load%kind /= load_plates, not_with_plates))
    call read_pressures(keys, load, bumps, needed .and. load%kind == load_crest_pressure)
    call read_maximum('maximum_force', load%maximum_force, 'N', 'largest force on the upper plate')
    call read_maximum('maximum_displacement', load%maximum_displacement, 'm', &
                      'largest travel of the upper plate towards the strip')
    call keys%integer_key('steps_up', load%steps_up, 'load steps up to the full load', &
                          from_to(1.0_wp, most_steps))
    if (load%kind == load_plates) load%steps_down = load%steps_up
    call keys%integer_key('steps_down', load%steps_down, 'load steps back to zero', &
                          from_to(0.0_wp, most_steps), &
                          default='`steps_up` with plates, otherwise 0')
    call keys%choice_key('support', load%support, support_words, &
                         'corner lines rest on the sleeve and can lift, or cannot leave it')

  contains

    !> What the plate does at the whole load.
    subroutine read_maximum(name, value, unit, meaning)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(inout) :: value
      logical :: given

      call keys%real_key(name, value, unit, meaning, positive, &
                         default='plates need one of force and displacement', given=given)
      call keys%rule('strip_load', name, given .and. load%kind == load_crest_pressure, &
                     "needs kind = 'plates'")
    end subroutine read_maximum
  end subroutine read_strip_load_case

  !> The crest pressures.
  subroutine read_pressures(keys, load, bumps, needed)
    type(case_keys_type), intent(inout) :: keys
    type(strip_load_case_type), intent(inout) :: load
    integer, intent(in) :: bumps  !! of the strip, 0 where not known
    logical, intent(in) :: needed !! they are the load
    logical :: plates, table, known, given

    plates = load%kind == load_plates
    table = .not. plates .and. load%distribution == distribution_table
    known = .not. plates .and. load%distribution /= 0
    call keys%real_key('pressure', load%pressure, 'Pa', &
                       'crest pressure: the uniform one, or the largest', any_value, &
                       needed .and. known .and. .not. table, &
                       default='required unless plates or a table', given=given)
    if (given .and. plates) then
      call keys%complain('strip_load', 'pressure', not_with_plates)
    else if (given .and. table) then
      call keys%complain('strip_load', 'pressure', "has no use with distribution = 'table': "// &
                         'bump_pressure gives the pressures')
    end if
    call keys%real_list_key('bump_pressure', load%bump_pressure, longest_list, 'Pa', &
                            'crest pressure of every bump, with a table', any_value, &
                            needed .and. table, 'required for a table')
    if (keys%key%given .and. plates) then
      call keys%complain('strip_load', 'bump_pressure', not_with_plates)
    else if (table .and. bumps > 0 .and. keys%last_key_is_right()) then
      call keys%rule('strip_load', 'bump_pressure', size(load%bump_pressure) /= bumps, &
                     'must have one value a bump: '//text(bumps)//', not '// &
                     text(size(load%bump_pressure)))
    else if (size(load%bump_pressure) > 0 .and. known .and. .not. table) then
      call keys%complain('strip_load', 'bump_pressure', "needs distribution = 'table'")
    end if
  end subroutine read_pressures

  !> Pressure on every bump, from the smallest x on [Pa].
  pure function crest_pressures(load, bumps) result(pressure)
    type(strip_load_case_type), intent(in) :: load !! what `&strip_load` asks for
    integer, intent(in) :: bumps !! of the strip
    real(wp) :: pressure(bumps)
    integer :: n

    select case (load%distribution)
    case (distribution_increasing_decreasing)
      pressure = load%pressure* &
                 [(real(min(n, bumps + 1 - n), wp)/real((bumps + 1)/2, wp), n=1, bumps)]
    case (distribution_table)
      pressure = load%bump_pressure
    case default
      pressure = load%pressure
    end select
  end function crest_pressures

  !> Force on every crest line over the whole width [N].
  pure function crest_forces(load, foil) result(force)
    type(strip_load_case_type), intent(in) :: load !! what `&strip_load` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp) :: force(foil%bumps)
    force = crest_pressures(load, foil%bumps)*foil%pitch%each(foil%bumps)*solid_width(foil)
  end function crest_forces

  !> Stiffness per area of the bumps after Walowit and Anno [N/m^3]; 0 where it is not known.
  elemental real(wp) function bump_stiffness(foil) result(stiffness)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    stiffness = known_stiffness(foil%youngs_modulus, foil%poissons_ratio, foil%thickness%value, &
                                foil%half_length%value, foil%pitch%value)
  end function bump_stiffness

  !> About how far the whole load presses the bumps down [m]; a small part of their height where
  !> there is no load.
  elemental real(wp) function typical_deflection(load, foil) result(deflection)
    type(strip_load_case_type), intent(in) :: load !! what `&strip_load` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp), parameter :: part_of_height = 1.0e-3_wp
    real(wp) :: stiffness !! [N/m^3]
    real(wp) :: unloaded  !! [m]

    stiffness = bump_stiffness(foil)
    unloaded = part_of_height*foil%height%value
    deflection = 0.0_wp
    if (load%kind == load_plates .and. load%maximum_displacement > 0.0_wp) then
      deflection = load%maximum_displacement
    else if (load%kind == load_plates .and. min(foil%pitch%value, foil%width) > 0.0_wp .and. &
             foil%bumps > 0 .and. stiffness > 0.0_wp) then
      deflection = load%maximum_force/(foil%bumps*stiffness*foil%pitch%value*solid_width(foil))
    else if (load%kind == load_crest_pressure .and. stiffness > 0.0_wp) then
      deflection = abs(load%pressure)/stiffness
      if (load%distribution == distribution_table) then
        deflection = maxval([0.0_wp, abs(load%bump_pressure)])/stiffness
      end if
    end if
    ! What is lost in the rounding of the height is no load.
    if (.not. deflection > epsilon(unloaded)*unloaded) deflection = unloaded
  end function typical_deflection
end module gfb_strip_load_case
