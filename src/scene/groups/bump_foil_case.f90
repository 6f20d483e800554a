!> `&bump_foil`: the bump strip.
module gfb_bump_foil_case
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, pad_length
  use gfb_bump_heights, only: crest_gaps, normal_deviations
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_foil_sizes, only: bump_list_key, complain_of_bumps, strip_sizes_type, read_strip_sizes, &
                            refuse_strip_sizes, gives_strips, sizes_differ
  use gfb_text, only: text
  use gfb_value_rules, only: between, from_to, not_negative, positive, at_least
  implicit none (type, external)
  private
  public :: bump_foil_case_type, read_bump_foil_case, has_flats, bumps_overlap, gap_of_crest, &
            gap_of_corner, solid_width, has_sizes, one_bump, one_strip, strips_differ, &
            bump_pitches, bump_half_lengths, bump_heights, bump_thicknesses, draw_gaps, &
            largest_gap

  integer, parameter, public :: fixed_edge_leading = 1
  integer, parameter, public :: fixed_edge_trailing = 2
  integer, parameter, public :: fixed_edge_none = 3

  character(len=*), parameter :: group = 'bump_foil'
  character(len=*), parameter :: edge_words(*) = [character(len=8) :: 'leading', 'trailing', 'none']
  !> In the order of `gfb_fixed_lines`.
  character(len=*), parameter :: line_words(*) = [character(len=9) :: 'corner', 'flat', 'half_flat']
  character(len=*), parameter :: law_words(*) = [character(len=6) :: 'normal']

  real(wp), parameter :: most_bumps = 1.0e6_wp, most_strips = 1.0e5_wp !! of a foil
  real(wp), parameter :: most_heights = 1.0e6_wp !! drawn for a scene
  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative

  !> How the heights deviate.
  type :: height_deviation_type
    real(wp) :: deviation = 0.0_wp !! standard deviation; 0: none was asked for [m]
    integer :: seed = 1            !! chooses the heights
    !> (bumps, strips of all pads) what the gaps of each strip are more than those of the first,
    !> pad by pad; not allocated: there is one strip [m]
    real(wp), allocatable :: further_gap(:, :)
  end type height_deviation_type

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
    integer :: strips = 1                   !! side by side along the axis
    real(wp) :: cut_width = 0.0_wp          !! between two of them [m]
    real(wp) :: offset = 0.0_wp             !! of their fixed edge from the pad's, mean [m]
    type(strip_sizes_type) :: strip         !! sizes that differ from strip to strip
    integer :: fixed_edge = fixed_edge_trailing
    integer :: fixed_line = fixed_line_corner
    logical :: poissons_ratio_given = .false.
    !> at rest, one a bump from the smallest x on; not allocated: all crests touch [m]
    real(wp), allocatable :: crest_gap(:)
    !> at rest between the corners of each bump and the sleeve; not allocated: all touch [m]
    real(wp), allocatable :: corner_gap(:)
    ! Sizes of each bump from the smallest x on, where they are given so; the single ones are then
    ! their means, that of the heights the largest one.
    real(wp), allocatable :: bump_pitch(:)       !! [m]
    real(wp), allocatable :: bump_half_length(:) !! [m]
    real(wp), allocatable :: bump_height(:)      !! [m]
    real(wp), allocatable :: bump_thickness(:)   !! [m]
    type(height_deviation_type) :: random   !! law of the heights from which the gaps follow
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
    real(wp) :: lowest !! height [m]
    logical :: gaps    !! are given

    call keys%start_group(group, required=as_shell, optional=.true., &
                          present_in_file=foil%present)
    call length_key('thickness', foil%thickness, 'thickness of the foil', 'bump_thickness')
    call keys%real_key('youngs_modulus', foil%youngs_modulus, 'Pa', "Young's modulus", positive, &
                       as_shell, default=no_default)
    call keys%real_key('poissons_ratio', foil%poissons_ratio, '1', "Poisson's ratio", &
                       between(-1.0_wp, 0.5_wp), as_shell, default=no_default, &
                       given=foil%poissons_ratio_given)
    call keys%real_key('density', foil%density, 'kg/m^3', 'density', positive, with_mass, &
                       default=no_default)
    call length_key('half_length', foil%half_length, "half the chord of a bump's arc", &
                    'bump_half_length')
    call length_key('height', foil%height, 'height of a bump', 'bump_height')
    call keys%integer_key('bumps', foil%bumps, 'number of bumps', from_to(1.0_wp, most_bumps), &
                          as_shell, default=no_default)
    if (foil%bumps > 0) foil%pitch = pad_length(bearing)/foil%bumps
    call keys%real_key('pitch', foil%pitch, 'm', 'from bump to bump, arc plus flat', positive, &
                       with_pitch .and. .not. keys%holds(group, 'bump_pitch') .and. &
                       .not. gives_strips(keys, 'pitch'), &
                       default='length of the pad / `bumps`')
    call read_sizes(keys, foil)
    if (as_shell .and. .not. with_width) foil%width = bearing%length
    call keys%real_key('width', foil%width, 'm', 'width of the strip, along the axis', positive, &
                       with_width, default='required for strips; a bearing''s length')
    call read_cuts(keys, foil)
    call keys%choice_key('fixed_edge', foil%fixed_edge, edge_words, 'where the strip is fixed')
    call keys%choice_key('fixed_line', foil%fixed_line, line_words, &
                         'the strip begins at its fixed edge with an arc, a flat, or half a flat')
    call bump_list_key(keys, 'crest_gap', foil%crest_gap, foil%bumps, 'm', 'gap at rest '// &
                       'between a bump''s crest and the top foil or plate', not_negative, &
                       '0: all crests touch')
    gaps = keys%key%given
    call bump_list_key(keys, 'corner_gap', foil%corner_gap, foil%bumps, 'm', 'gap at rest '// &
                       'between a bump''s two corner lines and the sleeve', not_negative, &
                       '0: all corners touch')
    lowest = foil%height
    if (allocated(foil%bump_height)) lowest = minval(foil%bump_height)
    if (allocated(foil%strip%height)) lowest = minval(foil%strip%height)
    call read_height_deviation(keys, foil%present, gaps, foil%bumps, foil%strips*bearing%pads, &
                               lowest, foil%random, foil%crest_gap)
    call check_geometry(keys, foil, bearing)
    call keys%finish_group()

  contains

    !> A length that need not be given.
    subroutine length_key(name, value, meaning, list)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(inout) :: value !! [m]
      character(len=*), intent(in), optional :: list !! key that says it bump by bump
      logical :: required
      required = as_shell
      if (present(list)) required = required .and. .not. keys%holds(group, list) .and. &
                                    .not. gives_strips(keys, name)
      call keys%real_key(name, value, 'm', meaning, positive, required, default=no_default)
    end subroutine length_key
  end subroutine read_bump_foil_case

  !> Reads how the strip is cut into strips side by side.
  subroutine read_cuts(keys, foil)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(inout) :: foil
    character(len=*), parameter :: meaning = 'width of each cut between two strips'
    character(len=*), parameter :: why = 'needs strips = 2 in &bump_foil, or more'
    real(wp) :: strip !! width of each [m]
    logical :: right

    call keys%integer_key('strips', foil%strips, 'strips side by side along the axis, '// &
                          'cut apart; the width is that of all with the cuts', &
                          from_to(1.0_wp, most_strips))
    right = keys%last_key_is_right()
    if (foil%present .and. foil%strips <= 1) then
      call keys%useless_key('cut_width', meaning, why)
      call refuse_strip_sizes(keys, why)
      return
    end if
    call keys%real_key('cut_width', foil%cut_width, 'm', meaning, positive, &
                       foil%strips > 1, default='required with `strips`')
    right = right .and. keys%last_key_is_right()
    call read_strip_sizes(keys, foil%strips, foil%pitch, foil%half_length, foil%height, &
                          foil%thickness, foil%offset, foil%strip)
    if (.not. right .or. .not. foil%width > 0.0_wp) return
    strip = solid_width(foil)/real(foil%strips, wp)
    if (foil%cut_width < strip) return
    call keys%complain(group, 'cut_width', 'must be less than the width of a strip, '// &
                       text(max(0.0_wp, strip), 4)//' m: so much is left of '// &
                       text(foil%width)//' m for each of '//text(foil%strips))
  end subroutine read_cuts

  !> Reads the sizes that differ from bump to bump.
  subroutine read_sizes(keys, foil)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(inout) :: foil

    call size_list('pitch', foil%bump_pitch, 'from bump to bump, arc plus flat')
    if (allocated(foil%bump_pitch)) foil%pitch = mean(foil%bump_pitch)
    call size_list('half_length', foil%bump_half_length, "half the chord of the bump's arc")
    if (allocated(foil%bump_half_length)) foil%half_length = mean(foil%bump_half_length)
    call size_list('height', foil%bump_height, 'height of the bump')
    if (allocated(foil%bump_height)) foil%height = maxval(foil%bump_height)
    call size_list('thickness', foil%bump_thickness, 'thickness of the bump, arc and flat')
    if (allocated(foil%bump_thickness)) foil%thickness = mean(foil%bump_thickness)

  contains

    !> One list, which stands for the single size.
    subroutine size_list(name, list, meaning)
      character(len=*), intent(in) :: name, meaning
      real(wp), allocatable, intent(out) :: list(:) !! [m]

      call bump_list_key(keys, 'bump_'//name, list, foil%bumps, 'm', meaning, positive, &
                         '`'//name//'` of all bumps')
      call keys%rule(group, 'bump_'//name, keys%key%given .and. keys%holds(group, name), &
                     'contradicts '//name//': give one of them')
    end subroutine size_list
  end subroutine read_sizes

  !> Mean of a list, to the last digit where all values are one.
  pure function mean(list) result(value)
    real(wp), intent(in) :: list(:)
    real(wp) :: value
    value = list(1) + sum(list - list(1))/size(list)
  end function mean

  !> Width of all strips without the cuts [m].
  elemental function solid_width(foil) result(width)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp) :: width
    width = foil%width - real(foil%strips - 1, wp)*foil%cut_width
  end function solid_width

  !> Whether a size is given bump by bump.
  elemental function has_sizes(foil) result(has)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    logical :: has
    has = allocated(foil%bump_pitch) .or. allocated(foil%bump_half_length) .or. &
          allocated(foil%bump_height) .or. allocated(foil%bump_thickness)
  end function has_sizes

  !> A foil of one of the bumps alone.
  elemental function one_bump(foil, bump) result(one)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: bump !! its number, from the smallest x on
    type(bump_foil_case_type) :: one

    one = foil
    one%bumps = 1
    if (allocated(foil%bump_pitch)) one%pitch = foil%bump_pitch(bump)
    if (allocated(foil%bump_half_length)) one%half_length = foil%bump_half_length(bump)
    if (allocated(foil%bump_height)) one%height = foil%bump_height(bump)
    if (allocated(foil%bump_thickness)) one%thickness = foil%bump_thickness(bump)
    if (allocated(one%bump_pitch)) deallocate (one%bump_pitch)
    if (allocated(one%bump_half_length)) deallocate (one%bump_half_length)
    if (allocated(one%bump_height)) deallocate (one%bump_height)
    if (allocated(one%bump_thickness)) deallocate (one%bump_thickness)
    if (allocated(one%crest_gap)) deallocate (one%crest_gap)
  end function one_bump

  !> Whether strips side by side have different bumps, or begin at different places.
  elemental function strips_differ(foil) result(differ)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    logical :: differ
    differ = sizes_differ(foil%strip)
  end function strips_differ

  !> A foil of one of the strips side by side alone.
  elemental function one_strip(foil, strip) result(one)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: strip !! its number, from the smallest z on
    type(bump_foil_case_type) :: one

    one = foil
    one%width = solid_width(foil)/real(foil%strips, wp)
    one%strips = 1
    one%cut_width = 0.0_wp
    one%strip = strip_sizes_type()
    if (allocated(foil%strip%pitch)) one%pitch = foil%strip%pitch(strip)
    if (allocated(foil%strip%half_length)) one%half_length = foil%strip%half_length(strip)
    if (allocated(foil%strip%height)) one%height = foil%strip%height(strip)
    if (allocated(foil%strip%thickness)) one%thickness = foil%strip%thickness(strip)
    if (allocated(foil%strip%offset)) one%offset = foil%strip%offset(strip)
  end function one_strip

  !> Pitch of each bump [m].
  pure function bump_pitches(foil) result(pitch)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp) :: pitch(foil%bumps)
    pitch = foil%pitch
    if (allocated(foil%bump_pitch)) pitch = foil%bump_pitch
  end function bump_pitches

  !> Half the chord of each bump's arc [m].
  pure function bump_half_lengths(foil) result(half_length)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp) :: half_length(foil%bumps)
    half_length = foil%half_length
    if (allocated(foil%bump_half_length)) half_length = foil%bump_half_length
  end function bump_half_lengths

  !> Height of each bump [m].
  pure function bump_heights(foil) result(height)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp) :: height(foil%bumps)
    height = foil%height
    if (allocated(foil%bump_height)) height = foil%bump_height
  end function bump_heights

  !> Thickness of each bump [m].
  pure function bump_thicknesses(foil) result(thickness)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp) :: thickness(foil%bumps)
    thickness = foil%thickness
    if (allocated(foil%bump_thickness)) thickness = foil%bump_thickness
  end function bump_thicknesses

  !> Gap at rest between a bump's crest and the top foil, which is as high as the highest bump [m].
  elemental function gap_of_crest(foil, bump, strip) result(gap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: bump !! number of the bump, from the smallest x on
    integer, intent(in), optional :: strip !! from the smallest z on; needed where they differ
    real(wp) :: gap

    gap = 0.0_wp
    if (allocated(foil%crest_gap)) gap = foil%crest_gap(bump)
    if (allocated(foil%bump_height)) gap = gap + (foil%height - foil%bump_height(bump))
    if (.not. present(strip)) return
    if (allocated(foil%random%further_gap)) gap = gap + foil%random%further_gap(bump, strip)
    if (allocated(foil%strip%height)) gap = gap + (foil%height - foil%strip%height(strip))
  end function gap_of_crest

  !> Gap at rest between a corner line and the sleeve; each bump has two lines of its own [m].
  elemental function gap_of_corner(foil, line) result(gap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: line !! number of the corner line, from the smallest x on
    real(wp) :: gap
    gap = 0.0_wp
    if (allocated(foil%corner_gap)) gap = foil%corner_gap((line + 1)/2)
  end function gap_of_corner

  !> Whether there are flats between the bumps; with sizes bump by bump, at any of them.
  elemental function has_flats(foil) result(flats)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    logical :: flats

    if (has_sizes(foil)) then
      flats = any(bump_pitches(foil) > 2.0_wp*bump_half_lengths(foil)*(1.0_wp + rounding))
    else
      flats = foil%pitch > 2.0_wp*foil%half_length*(1.0_wp + rounding)
    end if
  end function has_flats

  !> Whether a pitch is shorter than the bump's arc, or not known.
  elemental function bumps_overlap(foil) result(overlap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    logical :: overlap

    if (has_sizes(foil)) then
      overlap = any(overlapping(foil))
    else
      overlap = foil%pitch < 2.0_wp*foil%half_length*(1.0_wp - rounding)
    end if
  end function bumps_overlap

  !> Which pitches are shorter than the bump's arc.
  pure function overlapping(foil) result(overlap)
    type(bump_foil_case_type), intent(in) :: foil
    logical :: overlap(foil%bumps)
    overlap = bump_pitches(foil) < 2.0_wp*bump_half_lengths(foil)*(1.0_wp - rounding)
  end function overlapping

  !> Bumps that overlap, are more than half a circle, or do not fit on the pad.
  subroutine check_geometry(keys, foil, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    type(bearing_case_type), intent(in) :: bearing

    if (strips_differ(foil)) then
      return ! checked strip by strip, where all groups are known
    else if (has_sizes(foil)) then
      call check_bumps(keys, foil)
    else if (foil%half_length > 0.0_wp) then
      call keys%rule(group, 'height', foil%height > foil%half_length, 'must not exceed '// &
                     'half_length = '//text(foil%half_length)//' m: a bump is at most half a '// &
                     'circle')
      call keys%rule(group, 'pitch', foil%pitch > 0.0_wp .and. bumps_overlap(foil), &
                     'must be at least 2 half_length = '//text(2.0_wp*foil%half_length)// &
                     ' m, and is '//text(foil%pitch)//' m')
    end if
    if (bearing%radius > 0.0_wp .and. &
        foil%bumps*foil%pitch > pad_length(bearing)*(1.0_wp + rounding)) then
      call keys%complain(group, 'bumps', text(foil%bumps)//' bumps of the '// &
                         trim(merge('mean pitch', 'pitch     ', allocated(foil%bump_pitch)))// &
                         ' '//text(foil%pitch)//' m are longer than the pad, '// &
                         text(pad_length(bearing))//' m')
    end if
  end subroutine check_geometry

  !> Bumps with sizes of their own that overlap, or are more than half a circle.
  subroutine check_bumps(keys, foil)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    real(wp) :: height(foil%bumps), half_length(foil%bumps)
    character(len=:), allocatable :: key

    if (.not. foil%half_length > 0.0_wp) return
    half_length = bump_half_lengths(foil)
    key = 'height'
    if (allocated(foil%bump_height)) key = 'bump_height'
    height = bump_heights(foil)
    call complain_of_bumps(keys, key, height > half_length, height, &
                           'must not exceed half_length: a bump is at most half a circle', &
                           'half_length', half_length)
    if (.not. foil%pitch > 0.0_wp) return
    key = 'pitch'
    if (allocated(foil%bump_pitch)) key = 'bump_pitch'
    call complain_of_bumps(keys, key, overlapping(foil), bump_pitches(foil), &
                           'must be at least 2 half_length, or bumps overlap', &
                           '2 half_length', 2.0_wp*half_length)
  end subroutine check_bumps

  !> The gaps that random heights leave. Each strip of each pad has heights of its own, the numbers
  !> of the seed one after the other; at rest its highest crest touches.
  pure subroutine draw_gaps(law, bumps, strips, gap)
    type(height_deviation_type), intent(inout) :: law !! gets gaps of further strips
    integer, intent(in) :: bumps  !! of a strip
    integer, intent(in) :: strips !! of all pads
    real(wp), allocatable, intent(out) :: gap(:) !! of the first strip, one a bump [m]
    real(wp) :: height(bumps, strips)
    integer :: strip

    height = law%deviation*reshape(normal_deviations(law%seed, size(height)), shape(height))
    gap = crest_gaps(height(:, 1))
    if (allocated(law%further_gap)) deallocate (law%further_gap)
    if (strips == 1) return
    allocate (law%further_gap(bumps, strips))
    do strip = 1, strips
      law%further_gap(:, strip) = crest_gaps(height(:, strip)) - gap
    end do
  end subroutine draw_gaps

  !> The largest gap of all strips [m].
  pure function largest_gap(law, gap) result(largest)
    type(height_deviation_type), intent(in) :: law !! with the gaps of further strips
    real(wp), intent(in) :: gap(:) !! of the first strip, one a bump [m]
    real(wp) :: largest

    largest = maxval(gap)
    if (.not. allocated(law%further_gap)) return
    largest = maxval(law%further_gap + spread(gap, 2, size(law%further_gap, 2)))
  end function largest_gap

  !> Reads the law of the heights, and the gaps that they leave where none are given.
  subroutine read_height_deviation(keys, in_file, gaps, bumps, strips, height, law, gap)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    logical, intent(in) :: in_file !! the file has the group
    logical, intent(in) :: gaps    !! and gives the gaps themselves
    integer, intent(in) :: bumps   !! of a strip, 0 where not known
    integer, intent(in) :: strips  !! of all pads
    real(wp), intent(in) :: height !! of a bump, 0 where not known [m]
    type(height_deviation_type), intent(out) :: law !! of the heights, where they are random
    real(wp), allocatable, intent(inout) :: gap(:) !! one a bump; none: all crests touch [m]
    character(len=:), allocatable :: key
    logical :: random, right

    key = 'crest_gap'
    call keys%real_key('height_deviation', law%deviation, 'm', 'standard deviation of the '// &
                       'bumps'' heights; at rest the highest crest touches', positive, &
                       default=no_default, given=random)
    right = keys%last_key_is_right()
    call read_law(keys, in_file .and. .not. random, law%seed, right)
    if (gaps .and. random) then
      call keys%complain(group, 'height_deviation', 'contradicts crest_gap: the gaps follow '// &
                         'from the heights; give one of them')
    else if (right .and. real(bumps, wp)*real(strips, wp) > most_heights) then
      call keys%complain(group, 'height_deviation', text(bumps)//' bumps on '//text(strips)// &
                         ' strips of all pads have more than '//text(nint(most_heights))// &
                         ' heights')
      law%deviation = 0.0_wp ! none is drawn
      return
    else if (right .and. bumps > 0) then
      key = 'height_deviation'
      call draw_gaps(law, bumps, strips, gap)
    end if
    if (.not. allocated(gap) .or. .not. height > 0.0_wp) return
    if (largest_gap(law, gap) < height) return
    call keys%complain(group, key, 'leaves a gap of '//text(largest_gap(law, gap), 4)//' m, '// &
                       'which must be less than the height of the bumps, '//text(height)//' m')
  end subroutine read_height_deviation

  !> The law of random heights, and what chooses them.
  subroutine read_law(keys, useless, seed, right)
    type(case_keys_type), intent(inout) :: keys
    logical, intent(in) :: useless   !! heights do not deviate
    integer, intent(out) :: seed
    logical, intent(inout) :: right  !! the heights are known so far
    character(len=*), parameter :: seed_meaning = 'chooses the random heights: the same seed '// &
      'gives the same ones'
    character(len=*), parameter :: law_meaning = 'law of the random heights'
    integer :: law

    seed = 1
    law = 1
    if (useless) then
      call keys%useless_key('seed', seed_meaning, 'needs height_deviation')
      call keys%useless_key('deviation_law', law_meaning, 'needs height_deviation')
      return
    end if
    call keys%integer_key('seed', seed, seed_meaning, at_least(0.0_wp))
    right = right .and. (keys%last_key_is_right() .or. .not. keys%key%given)
    call keys%choice_key('deviation_law', law, law_words, law_meaning)
    right = right .and. law > 0
  end subroutine read_law
end module gfb_bump_foil_case
