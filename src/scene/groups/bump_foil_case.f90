!> `&bump_foil`: the bump strip.
module gfb_bump_foil_case
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, pad_length
  use gfb_bump_list, only: bump_list_key
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_height_deviation_keys, only: read_height_deviation
  use gfb_text, only: text
  use gfb_value_rules, only: at_least, between, not_negative, positive
  implicit none (type, external)
  private
  public :: bump_foil_case_type, read_bump_foil_case, has_flats, bumps_overlap, gap_of_crest

  integer, parameter, public :: fixed_edge_leading = 1
  integer, parameter, public :: fixed_edge_trailing = 2
  integer, parameter, public :: fixed_edge_none = 3

  character(len=*), parameter :: edge_words(*) = [character(len=8) :: 'leading', 'trailing', 'none']
  !> In the order of `gfb_fixed_lines`.
  character(len=*), parameter :: line_words(*) = [character(len=9) :: 'corner', 'flat', 'half_flat']

  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative

  !> The bump strip. A number that is not given is zero.
  type :: bump_foil_case_type
    logical :: present = .false.            !! the group stands in the file
    real(wp) :: thickness = 0.0_wp          !! [m]
    real(wp) :: youngs_modulus = 0.0_wp     !! [Pa]
    real(wp) :: poissons_ratio = 0.0_wp     !! [1]
    real(wp) :: density = 0.0_wp            !! [kg/m^3]
    real(wp) :: half_length = 0.0_wp        !! half the chord of a bump's arc [m]
    real(wp) :: height = 0.0_wp             !! of a bump [m]
    integer :: bumps = 0
    real(wp) :: pitch = 0.0_wp              !! arc plus flat; from the bumps where not given [m]
    real(wp) :: width = 0.0_wp              !! of a strip, along the axis [m]
    integer :: fixed_edge = fixed_edge_trailing
    integer :: fixed_line = fixed_line_corner
    logical :: poissons_ratio_given = .false.
    !> at rest, one a bump from the smallest x on; not allocated: all crests touch [m]
    real(wp), allocatable :: crest_gap(:)
  end type bump_foil_case_type

contains

  !> Reads the group.
  subroutine read_bump_foil_case(keys, foil, bearing, as_shell, with_mass, with_pitch, with_width)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bump_foil_case_type), intent(out) :: foil !! what `&bump_foil` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    logical, intent(in) :: as_shell   !! the strip is meshed: its shape must be known
    logical, intent(in) :: with_mass  !! and its density too
    logical, intent(in) :: with_pitch !! more of it than an arc is meshed; no pad tells the pitch
    logical, intent(in) :: with_width !! no bearing tells the width
    logical :: gaps !! are given

    call keys%start_group('bump_foil', required=as_shell, optional=.true., &
                          present_in_file=foil%present)
    call length_key('thickness', foil%thickness, 'thickness of the foil')
    call keys%real_key('youngs_modulus', foil%youngs_modulus, 'Pa', "Young's modulus", positive, &
                       as_shell, default=no_default)
    call keys%real_key('poissons_ratio', foil%poissons_ratio, '1', "Poisson's ratio", &
                       between(-1.0_wp, 0.5_wp), as_shell, default=no_default, &
                       given=foil%poissons_ratio_given)
    call keys%real_key('density', foil%density, 'kg/m^3', 'density', positive, with_mass, &
                       default=no_default)
    call length_key('half_length', foil%half_length, "half the chord of a bump's arc")
    call length_key('height', foil%height, 'height of a bump')
    call keys%integer_key('bumps', foil%bumps, 'number of bumps', at_least(1.0_wp), &
                          as_shell, default=no_default)
    if (foil%bumps > 0) foil%pitch = pad_length(bearing)/foil%bumps
    call keys%real_key('pitch', foil%pitch, 'm', 'from bump to bump, arc plus flat', positive, &
                       with_pitch, default='length of the pad / `bumps`')
    if (as_shell .and. .not. with_width) foil%width = bearing%length
    call keys%real_key('width', foil%width, 'm', 'width of the strip, along the axis', positive, &
                       with_width, default='required for strips; a bearing''s length')
    call keys%choice_key('fixed_edge', foil%fixed_edge, edge_words, 'where the strip is fixed')
    call keys%choice_key('fixed_line', foil%fixed_line, line_words, &
                         'the strip begins at its fixed edge with an arc, a flat, or half a flat')
    call bump_list_key(keys, 'crest_gap', foil%crest_gap, foil%bumps, 'm', 'gap at rest '// &
                       'between a bump''s crest and the top foil or plate', not_negative, &
                       '0: all crests touch')
    gaps = keys%key%given
    call read_height_deviation(keys, foil%present, gaps, foil%bumps, foil%height, foil%crest_gap)
    call check_geometry(keys, foil, bearing)
    call keys%finish_group()

  contains

    !> A length that need not be given.
    subroutine length_key(name, value, meaning)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(inout) :: value !! [m]
      call keys%real_key(name, value, 'm', meaning, positive, as_shell, default=no_default)
    end subroutine length_key
  end subroutine read_bump_foil_case

  !> Gap at rest between a bump's crest and the top foil [m].
  elemental function gap_of_crest(foil, bump) result(gap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: bump !! number of the bump, from the smallest x on
    real(wp) :: gap

    gap = 0.0_wp
    if (allocated(foil%crest_gap)) gap = foil%crest_gap(bump)
  end function gap_of_crest

  !> Whether there are flats between the bumps.
  elemental function has_flats(foil) result(flats)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    logical :: flats
    flats = foil%pitch > 2.0_wp*foil%half_length*(1.0_wp + rounding)
  end function has_flats

  !> Whether a pitch is shorter than the bump's arc, or not known.
  elemental function bumps_overlap(foil) result(overlap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    logical :: overlap
    overlap = foil%pitch < 2.0_wp*foil%half_length*(1.0_wp - rounding)
  end function bumps_overlap

  !> Bumps that overlap, are more than half a circle, or do not fit on the pad.
  subroutine check_geometry(keys, foil, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    type(bearing_case_type), intent(in) :: bearing

    if (foil%half_length > 0.0_wp) then
      if (foil%height > foil%half_length) then
        call keys%complain('bump_foil', 'height', 'must not exceed half_length = '// &
                           text(foil%half_length)//' m: a bump is at most half a circle')
      end if
      if (foil%pitch > 0.0_wp .and. bumps_overlap(foil)) then
        call keys%complain('bump_foil', 'pitch', 'must be at least 2 half_length = '// &
                           text(2.0_wp*foil%half_length)//' m, and is '//text(foil%pitch)//' m')
      end if
    end if
    if (bearing%radius > 0.0_wp .and. &
        foil%bumps*foil%pitch > pad_length(bearing)*(1.0_wp + rounding)) then
      call keys%complain('bump_foil', 'bumps', text(foil%bumps)//' bumps of the pitch '// &
                         text(foil%pitch)//' m are longer than the pad, '// &
                         text(pad_length(bearing))//' m')
    end if
  end subroutine check_geometry
end module gfb_bump_foil_case
