!> `&bump_foil`, the bump strip. Its sizes have one value for all bumps, one a bump, or one a strip
!> of those that lie side by side.
module gfb_foil_cases
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default, between, positive, longest_list, &
                           rule_type, unless, at_least, from_to, not_negative
  use gfb_scene_case, only: needs_type
  use gfb_text, only: text, join
  use gfb_bearing_case, only: bearing_case_type, pad_length, strip_length, strip_ends, &
                              middle_radius
  use gfb_foil_row, only: foil_row_type
  use gfb_bump_heights, only: crest_gaps, normal_deviations
  use gfb_fixed_lines, only: fixed_line_corner, fixed_line_half_flat
  use gfb_key_effect, only: acts_on_gaps, acts_on_sheets, acts_on_shapes, acts_on_all
  implicit none (type, external)
  private
  public :: size_type, of_bump, of_strip, complain_of_sizes, bump_foil_case_type, &
            read_bump_foil_case, has_flats, bumps_overlap, gap_of_crest, gap_of_corner, &
            solid_width, has_sizes, one_bump, one_strip, strips_differ, sizes_mirror, draw_gaps, &
            largest_gap, missing_of_bumps

  character(len=*), parameter :: group = 'bump_foil'
  character(len=*), parameter :: walowit_anno = 'the stiffness by Walowit-Anno does not depend '// &
                                                'on it'

  !> A size.
  type :: size_type
    character(len=11) :: name = ''       !! of the key that has it for all bumps
    character(len=43) :: meaning = ''    !! of the size
    real(wp) :: value = 0.0_wp           !! of all bumps, or the mean; 0: not known [m]
    logical :: largest = .false.         !! of those that differ the value is the largest, no mean
    integer :: acts_on = acts_on_all     !! see `gfb_key_effect`
    real(wp), allocatable :: by_bump(:)  !! from the smallest x on; not allocated: all have one [m]
    real(wp), allocatable :: by_strip(:) !! from the smallest z on; the same [m]
  contains
    procedure, non_overridable :: read_value, read_by_bump, read_by_strip
    procedure, non_overridable :: each, smallest, mirrors, bump_key, key_in
  end type size_type

  integer, parameter, public :: fixed_edge_leading = 1
  integer, parameter, public :: fixed_edge_trailing = 2
  integer, parameter, public :: fixed_edge_none = 3

  character(len=*), parameter :: edge_words(*) = [character(len=8) :: 'leading', 'trailing', 'none']
  integer, parameter, public :: strip_curved = 1   !! crests are rays
  integer, parameter, public :: strip_straight = 2 !! they are parallel to the middle ray
  character(len=*), parameter :: form_words(*) = [character(len=8) :: 'curved', 'straight']
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
    type(size_type) :: thickness = size_type('thickness', 'thickness of the foil', &
                                            acts_on=acts_on_sheets)
    real(wp) :: youngs_modulus = 0.0_wp     !! [Pa]
    real(wp) :: poissons_ratio = 0.0_wp     !! [1]
    real(wp) :: density = 0.0_wp            !! [kg/m^3]
    type(size_type) :: half_length = size_type('half_length', "half the chord of a bump's arc", &
                                              acts_on=acts_on_shapes)
    type(size_type) :: height = size_type('height', 'height of a bump', largest=.true., &
                                         acts_on=acts_on_shapes)
    integer :: bumps = 0
    type(size_type) :: pitch = size_type('pitch', 'from bump to bump, arc plus flat')
    real(wp) :: width = 0.0_wp              !! of a strip, along the axis [m]
    integer :: strips = 1                   !! side by side along the axis
    real(wp) :: cut_width = 0.0_wp          !! between two of them [m]
    !> of the fixed edge of a journal, from the edge of the pad; of the leading end of a sector's
    !> strip, from the end of its ramp
    type(size_type) :: offset = size_type('offset', 'of the fixed edge, from the edge of the pad')
    integer :: fixed_edge = fixed_edge_trailing
    integer :: fixed_line = fixed_line_corner
    integer :: strip_form = strip_curved
    logical :: poissons_ratio_given = .false.
    !> of crests under a plate, from its leading edge; none: by pitch [rad]
    real(wp), allocatable :: crest_angles(:)
    !> at rest, one a bump from the smallest x on; not allocated: all crests touch [m]
    real(wp), allocatable :: crest_gap(:)
    !> at rest between the corners of each bump and the sleeve; not allocated: all touch [m]
    real(wp), allocatable :: corner_gap(:)
    type(height_deviation_type) :: random   !! law of the heights from which the gaps follow
  end type bump_foil_case_type

contains

  !> Reads the value of all bumps, which need not be given where a list is.
  subroutine read_value(self, keys, needed, default)
    class(size_type), intent(inout) :: self !! the size
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    logical, intent(in) :: needed !! the size must be known
    character(len=*), intent(in), optional :: default !! in words
    character(len=:), allocatable :: words

    words = no_default
    if (present(default)) words = default
    call keys%real_key(trim(self%name), self%value, 'm', trim(self%meaning), positive, &
                       needed .and. self%key_in(keys) == self%name, default=words, &
                       acts_on=self%acts_on)
  end subroutine read_value

  !> Reads the size bump by bump.
  subroutine read_by_bump(self, keys, bumps)
    class(size_type), intent(inout) :: self !! the size
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    integer, intent(in) :: bumps !! of the strip, 0 where not known
    real(wp), allocatable :: values(:)

    call bump_list_key(keys, 'bump_'//trim(self%name), values, bumps, trim(self%meaning), &
                       positive, '`'//trim(self%name)//'` of all bumps', self%acts_on)
    if (keys%key%given) call refuse_both(keys, 'bump_'//trim(self%name), trim(self%name))
    if (.not. allocated(values)) return
    self%value = value_of(self, values)
    self%by_bump = values
  end subroutine read_by_bump

  !> Reads the size strip by strip. Values that are the same for all are the single one.
  subroutine read_by_strip(self, keys, strips, rule, useless, default)
    class(size_type), intent(inout) :: self !! the size
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    integer, intent(in) :: strips !! side by side, 0 where not known
    type(rule_type), intent(in) :: rule !! that each value keeps
    character(len=*), intent(in) :: useless !! why it has no use; empty where it has one
    character(len=*), intent(in), optional :: default !! in words
    character(len=:), allocatable :: name, words
    real(wp), allocatable :: values(:)

    name = 'strip_'//trim(self%name)
    words = '`'//trim(self%name)//'` of all strips'
    if (present(default)) words = default
    call shared_list_key(keys, name, values, 'strip', strips, 'smallest z', trim(self%meaning), &
                         rule, words, useless, self%acts_on)
    if (useless /= '') return
    if (keys%key%given) then
      call refuse_both(keys, name, trim(self%name))
      call refuse_both(keys, name, 'bump_'//trim(self%name))
    end if
    if (.not. allocated(values)) return
    self%value = value_of(self, values)
    if (any(abs(values - values(1)) > 0.0_wp)) self%by_strip = values
  end subroutine read_by_strip

  !> Complains where a size is given twice.
  subroutine refuse_both(keys, name, other)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, other !! keys

    call keys%rule(group, name, keys%holds(group, other), 'contradicts '//other// &
                   ': give one of them')
  end subroutine refuse_both

  !> The value that stands for a list: its mean, to the last digit where all values are one, or the
  !> largest [m].
  pure real(wp) function value_of(self, list) result(value)
    class(size_type), intent(in) :: self
    real(wp), intent(in) :: list(:)

    value = list(1) + sum(list - list(1))/size(list)
    if (self%largest) value = maxval(list)
  end function value_of

  !> One value a bump from the smallest x on, or one that stands for all.
  subroutine bump_list_key(keys, name, list, bumps, meaning, rule, default, acts_on)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: name !! of the key
    real(wp), allocatable, intent(out) :: list(:) !! not allocated where none is right [m]
    integer, intent(in) :: bumps !! of the strip, 0 where not known
    character(len=*), intent(in) :: meaning !! of the key
    type(rule_type), intent(in) :: rule !! that each value keeps
    character(len=*), intent(in) :: default !! in words
    integer, intent(in) :: acts_on !! `acts_on_sheets`, ...
    call shared_list_key(keys, name, list, 'bump', bumps, 'leading end', meaning, rule, default, &
                         '', acts_on)
  end subroutine bump_list_key

  !> One value a bump or strip, or one that stands for all.
  subroutine shared_list_key(keys, name, list, what, number, from, meaning, rule, default, &
                             useless, acts_on)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, meaning, default, useless
    real(wp), allocatable, intent(out) :: list(:) !! not allocated where none is right [m]
    character(len=*), intent(in) :: what !! has a value: 'bump' or 'strip'
    integer, intent(in) :: number !! of them, 0 where not known
    character(len=*), intent(in) :: from !! where the first is
    type(rule_type), intent(in) :: rule
    integer, intent(in) :: acts_on
    real(wp), allocatable :: values(:)

    call keys%real_list_key(name, values, longest_list, 'm', meaning//', one value a '//what// &
                            ' from the '//from//' on, or one for all', rule, .false., default, &
                            useless, acts_on)
    if (.not. keys%last_key_is_right() .or. number < 1) return
    if (size(values) == 1) values = spread(values(1), 1, number)
    call keys%rule(group, name, size(values) /= number, 'must have one value, or one a '// &
                   what//': '//text(number)//', not '//text(size(values)))
    if (size(values) == number) list = values
  end subroutine shared_list_key

  !> The size of each bump [m].
  pure function each(self, bumps) result(values)
    class(size_type), intent(in) :: self !! the size
    integer, intent(in) :: bumps !! of the strip
    real(wp) :: values(bumps)

    values = self%value
    if (allocated(self%by_bump)) values = self%by_bump
  end function each

  !> The smallest of all bumps and strips [m].
  elemental real(wp) function smallest(self) result(value)
    class(size_type), intent(in) :: self !! the size

    value = self%value
    if (allocated(self%by_bump)) value = minval(self%by_bump)
    if (allocated(self%by_strip)) value = minval(self%by_strip)
  end function smallest

  !> The size of one of the bumps alone.
  elemental function of_bump(size, bump) result(one)
    type(size_type), intent(in) :: size !! of all
    integer, intent(in) :: bump !! its number, from the smallest x on
    type(size_type) :: one

    one = size
    if (.not. allocated(one%by_bump)) return
    one%value = one%by_bump(bump)
    deallocate (one%by_bump)
  end function of_bump

  !> The size on one of the strips side by side alone.
  elemental function of_strip(size, strip) result(one)
    type(size_type), intent(in) :: size !! of all
    integer, intent(in) :: strip !! its number, from the smallest z on
    type(size_type) :: one

    one = size
    if (.not. allocated(one%by_strip)) return
    one%value = one%by_strip(strip)
    deallocate (one%by_strip)
  end function of_strip

  !> Whether the strips mirror each other about the midplane.
  elemental logical function mirrors(self) result(mirror)
    class(size_type), intent(in) :: self !! the size

    mirror = .true.
    if (.not. allocated(self%by_strip)) return
    mirror = all(abs(self%by_strip - self%by_strip(size(self%by_strip):1:-1)) <= 0.0_wp)
  end function mirrors

  !> The key that gives the size of the bumps.
  pure function bump_key(self) result(key)
    class(size_type), intent(in) :: self !! the size
    character(len=:), allocatable :: key

    key = trim(self%name)
    if (allocated(self%by_bump)) key = 'bump_'//key
  end function bump_key

  !> The key that stands in the file for the size: of strips, of bumps, or of all.
  pure function key_in(self, keys) result(key)
    class(size_type), intent(in) :: self !! the size
    type(case_keys_type), intent(in) :: keys !! the keys of the case file
    character(len=:), allocatable :: key

    key = trim(self%name)
    if (keys%holds(group, 'bump_'//trim(self%name))) key = 'bump_'//trim(self%name)
    if (keys%holds(group, 'strip_'//trim(self%name))) key = 'strip_'//trim(self%name)
  end function key_in

  !> Complains about sizes of single bumps or strips, the first few by their numbers.
  subroutine complain_of_sizes(keys, key, wrong, value, rule, other, limit, what)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: key      !! that is wrong
    logical, intent(in) :: wrong(:)          !! at which bumps or strips
    real(wp), intent(in) :: value(:)         !! of them [m]
    character(len=*), intent(in) :: rule, other !! what holds; what it is compared with
    real(wp), intent(in) :: limit(:)         !! of them [m]
    character(len=*), intent(in) :: what     !! they are: 'bump' or 'strip'
    integer, parameter :: most = 3           !! that are named
    character(len=:), allocatable :: words
    integer :: i

    if (.not. any(wrong)) return
    words = rule
    do i = 1, size(wrong)
      if (.not. wrong(i)) cycle
      if (count(wrong(:i)) > most) exit
      words = words//merge('; ', ', ', count(wrong(:i)) == 1)//what//' '//text(i)//' has '// &
              text(value(i))//' m with '//other//' = '//text(limit(i))//' m'
    end do
    if (count(wrong) > most) words = words//', and '//text(count(wrong) - most)//' more'
    call keys%complain(group, key, words)
  end subroutine complain_of_sizes

  !> Reads the group.
  subroutine read_bump_foil_case(keys, foil, bearing, needs, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bump_foil_case_type), intent(out) :: foil !! what `&bump_foil` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(needs_type), intent(in) :: needs !! of the analysis
    type(foil_row_type), intent(in) :: model !! of the foils
    logical :: gaps    !! are given
    logical :: springs !! have a stiffness of their own

    springs = .false.
    if (model%stiffness_key /= '') springs = keys%meant('model', trim(model%stiffness_key))
    call keys%start_group(group, required=needs%bumps, optional=.true., &
                          present_in_file=foil%present, acts_on=acts_on_all)
    if (model%stiffness_key == '') call keys%idle(model%needs_bumps())
    if (springs) call keys%idle(trim(model%stiffness_key)//' in &model is given')
    call foil%thickness%read_value(keys, needs%bumps)
    call keys%real_key('youngs_modulus', foil%youngs_modulus, 'Pa', "Young's modulus", positive, &
                       needs%bumps, default=no_default, acts_on=acts_on_sheets)
    call keys%real_key('poissons_ratio', foil%poissons_ratio, '1', "Poisson's ratio", &
                       between(-1.0_wp, 0.5_wp), needs%bumps, default=no_default, &
                       given=foil%poissons_ratio_given, acts_on=acts_on_sheets)
    call keys%real_key('density', foil%density, 'kg/m^3', 'density', positive, needs%mass, &
                       default=no_default)
    call foil%half_length%read_value(keys, needs%bumps)
    call foil%height%read_value(keys, needs%bumps)
    call keys%integer_key('bumps', foil%bumps, 'number of bumps', from_to(1.0_wp, most_bumps), &
                          needs%bumps, default=no_default)
    if (foil%bumps > 0) foil%pitch%value = strip_length(bearing)/foil%bumps
    call foil%pitch%read_value(keys, needs%pitch, 'length of the pad / `bumps`')
    call foil%pitch%read_by_bump(keys, foil%bumps)
    call foil%half_length%read_by_bump(keys, foil%bumps)
    call foil%height%read_by_bump(keys, foil%bumps)
    call foil%thickness%read_by_bump(keys, foil%bumps)
    if (needs%bumps .and. .not. needs%width) foil%width = bearing%length
    call keys%real_key('width', foil%width, 'm', 'width of the strip, along the axis', positive, &
                       needs%width, default='required for strips; a bearing''s length')
    call read_cuts(keys, foil, bearing)
    call keys%choice_key('fixed_edge', foil%fixed_edge, edge_words, 'where the strip is fixed')
    call keys%choice_key('fixed_line', foil%fixed_line, line_words, &
                         'the strip begins at its fixed edge with an arc, a flat, or half a flat')
    ! Else the first crest stands as far from the weld as half a bump is long.
    if (foil%fixed_line /= fixed_line_half_flat) call keys%act_on('half_length', acts_on_all)
    call keys%choice_key('strip_form', foil%strip_form, form_words, 'under a sector crests are '// &
                         "rays, or parallel to the ray in the pad's middle", &
                         useless=trim(bearing%row%thrust_keys))
    call bump_list_key(keys, 'crest_gap', foil%crest_gap, foil%bumps, 'gap at rest '// &
                       'between a bump''s crest and the top foil or plate', not_negative, &
                       '0: all crests touch', acts_on_gaps)
    gaps = keys%key%given
    call bump_list_key(keys, 'corner_gap', foil%corner_gap, foil%bumps, 'gap at rest '// &
                       'between a bump''s two corner lines and the sleeve', not_negative, &
                       '0: all corners touch', acts_on_gaps)
    call read_height_deviation(keys, foil, gaps, foil%strips*bearing%all_pads())
    call keys%real_list_key('crest_angles', foil%crest_angles, longest_list, 'rad', 'where '// &
                            'the crests under a plate stand, from the leading edge of the pad '// &
                            'on', at_least(0.0_wp), .false., 'from `pitch`')
    if (needs%weightless /= '') call keys%idle(trim(needs%weightless), 'density')
    if (model%stiffness_key /= '' .and. .not. springs) then
      call keys%idle(walowit_anno, 'height')
      call keys%idle(walowit_anno, 'width')
    else if (model%has_crest_springs) then ! crests are where they are, whatever springs they have
      call keys%idle('', 'pitch')
      call keys%idle('', 'half_length')
      call keys%idle('', 'crest_angles')
    end if
    call check_geometry(keys, foil, bearing)
  end subroutine read_bump_foil_case

  !> What of the sizes and the material that Walowit and Anno's stiffness follows from is not given;
  !> empty where all is.
  function missing_of_bumps(keys, by_strip, pitched) result(words)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    logical, intent(in) :: by_strip !! values of each strip count, too
    logical, intent(out) :: pitched !! the pitch is given, or follows
    character(len=:), allocatable :: words
    character(len=*), parameter :: needed(*) = [character(len=14) :: 'thickness', &
      'youngs_modulus', 'poissons_ratio', 'half_length', 'pitch or bumps']
    logical :: given(size(needed))
    integer :: i

    given = [(has(trim(needed(i))), i=1, size(needed))]
    pitched = has('pitch') .or. keys%meant(group, 'bumps')
    given(size(needed)) = pitched
    words = join(pack(needed, .not. given), ', ')

  contains

    !> Whether a size is given.
    logical function has(name)
      character(len=*), intent(in) :: name !! of the key
      has = keys%meant(group, name)
      if (by_strip .and. .not. has) has = keys%meant(group, 'strip_'//name)
    end function has
  end function missing_of_bumps

  !> Reads how the strip is cut into strips side by side.
  subroutine read_cuts(keys, foil, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(inout) :: foil
    type(bearing_case_type), intent(in) :: bearing
    character(len=:), allocatable :: useless
    real(wp) :: strip !! width of each [m]
    logical :: right
    integer :: i

    call keys%integer_key('strips', foil%strips, 'strips side by side along the axis, '// &
                          'cut apart; the width is that of all with the cuts', &
                          from_to(1.0_wp, most_strips))
    right = keys%last_key_is_right()
    useless = unless(foil%strips > 1 .or. .not. foil%present, &
                     'needs strips = 2 in &bump_foil, or more')
    call keys%real_key('cut_width', foil%cut_width, 'm', 'width of each cut between two strips', &
                       positive, foil%strips > 1, default='required with `strips`', &
                       useless=useless)
    right = right .and. keys%last_key_is_right()
    call foil%pitch%read_by_strip(keys, foil%strips, positive, useless)
    call foil%half_length%read_by_strip(keys, foil%strips, positive, useless)
    call foil%height%read_by_strip(keys, foil%strips, positive, useless)
    call foil%thickness%read_by_strip(keys, foil%strips, positive, useless)
    if (bearing%row%has_sectors) useless = '' ! a single strip may begin behind the ramp
    call foil%offset%read_by_strip(keys, foil%strips, not_negative, useless, &
                                   '0: strips begin at the edge of the pad, or its ramp''s end')
    if (.not. right) return
    if (bearing%row%has_sectors .and. foil%strips > 1 .and. foil%bumps > 0 .and. &
        .not. (keys%holds(group, 'pitch') .or. keys%holds(group, 'strip_pitch') .or. &
               allocated(foil%pitch%by_bump))) then
      foil%pitch%by_strip = [(0.5_wp*sum(strip_ends(bearing, foil%strips, foil%cut_width, i)), &
                              i=1, foil%strips)]*foil%pitch%value/middle_radius(bearing)
    end if
    if (.not. foil%width > 0.0_wp) return
    strip = solid_width(foil)/real(foil%strips, wp)
    if (foil%cut_width < strip) return
    call keys%complain(group, 'cut_width', 'must be less than the width of a strip, '// &
                       text(max(0.0_wp, strip), 4)//' m: so much is left of '// &
                       text(foil%width)//' m for each of '//text(foil%strips))
  end subroutine read_cuts

  !> Width of all strips without the cuts [m].
  elemental real(wp) function solid_width(foil) result(width)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    width = foil%width - real(foil%strips - 1, wp)*foil%cut_width
  end function solid_width

  !> Whether a size is given bump by bump.
  elemental logical function has_sizes(foil) result(has)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    has = allocated(foil%pitch%by_bump) .or. allocated(foil%half_length%by_bump) .or. &
          allocated(foil%height%by_bump) .or. allocated(foil%thickness%by_bump)
  end function has_sizes

  !> A foil of one of the bumps alone.
  elemental function one_bump(foil, bump) result(one)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: bump !! its number, from the smallest x on
    type(bump_foil_case_type) :: one

    one = foil
    one%bumps = 1
    one%pitch = of_bump(foil%pitch, bump)
    one%half_length = of_bump(foil%half_length, bump)
    one%height = of_bump(foil%height, bump)
    one%thickness = of_bump(foil%thickness, bump)
    if (allocated(one%crest_gap)) deallocate (one%crest_gap)
  end function one_bump

  !> Whether strips side by side have different bumps, or begin at different places.
  elemental logical function strips_differ(foil) result(differ)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    differ = allocated(foil%pitch%by_strip) .or. allocated(foil%half_length%by_strip) .or. &
             allocated(foil%height%by_strip) .or. allocated(foil%thickness%by_strip) .or. &
             allocated(foil%offset%by_strip)
  end function strips_differ

  !> Whether the strips mirror each other about the midplane.
  elemental logical function sizes_mirror(foil) result(mirror)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    mirror = foil%pitch%mirrors() .and. foil%half_length%mirrors() .and. foil%height%mirrors() &
             .and. foil%thickness%mirrors() .and. foil%offset%mirrors()
  end function sizes_mirror

  !> A foil of one of the strips side by side alone.
  elemental function one_strip(foil, strip) result(one)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: strip !! its number, from the smallest z on
    type(bump_foil_case_type) :: one

    one = foil
    one%width = solid_width(foil)/real(foil%strips, wp)
    one%strips = 1
    one%cut_width = 0.0_wp
    one%pitch = of_strip(foil%pitch, strip)
    one%half_length = of_strip(foil%half_length, strip)
    one%height = of_strip(foil%height, strip)
    one%thickness = of_strip(foil%thickness, strip)
    one%offset = of_strip(foil%offset, strip)
  end function one_strip

  !> Gap at rest between a bump's crest and the top foil, which is as high as the highest bump [m].
  elemental real(wp) function gap_of_crest(foil, bump, strip) result(gap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: bump !! number of the bump, from the smallest x on
    integer, intent(in), optional :: strip !! from the smallest z on; needed where they differ

    gap = 0.0_wp
    if (allocated(foil%crest_gap)) gap = foil%crest_gap(bump)
    associate (height => foil%height)
      if (allocated(height%by_bump)) gap = gap + (height%value - height%by_bump(bump))
      if (.not. present(strip)) return
      if (allocated(foil%random%further_gap)) gap = gap + foil%random%further_gap(bump, strip)
      if (allocated(height%by_strip)) gap = gap + (height%value - height%by_strip(strip))
    end associate
  end function gap_of_crest

  !> Gap at rest between a corner line and the sleeve; each bump has two lines of its own [m].
  elemental real(wp) function gap_of_corner(foil, line) result(gap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: line !! number of the corner line, from the smallest x on
    gap = 0.0_wp
    if (allocated(foil%corner_gap)) gap = foil%corner_gap((line + 1)/2)
  end function gap_of_corner

  !> Whether there are flats between the bumps; with sizes bump by bump, at any of them.
  elemental logical function has_flats(foil) result(flats)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for

    associate (n => merge(foil%bumps, 1, has_sizes(foil)))
      flats = any(foil%pitch%each(n) > 2.0_wp*foil%half_length%each(n)*(1.0_wp + rounding))
    end associate
  end function has_flats

  !> Whether a pitch is shorter than the bump's arc, or not known.
  elemental logical function bumps_overlap(foil) result(overlap)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    overlap = any(overlapping(foil, merge(foil%bumps, 1, has_sizes(foil))))
  end function bumps_overlap

  !> Which pitches are shorter than the bump's arc.
  pure function overlapping(foil, bumps) result(overlap)
    type(bump_foil_case_type), intent(in) :: foil
    integer, intent(in) :: bumps
    logical :: overlap(bumps)
    overlap = foil%pitch%each(bumps) < 2.0_wp*foil%half_length%each(bumps)*(1.0_wp - rounding)
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
    else if (foil%half_length%value > 0.0_wp) then
      call keys%rule(group, 'height', foil%height%value > foil%half_length%value, &
                     'must not exceed half_length = '//text(foil%half_length%value)// &
                     ' m: a bump is at most half a circle')
      call keys%rule(group, 'pitch', foil%pitch%value > 0.0_wp .and. bumps_overlap(foil), &
                     'must be at least 2 half_length = '//text(2.0_wp*foil%half_length%value)// &
                     ' m, and is '//text(foil%pitch%value)// &
                     ' m; where bumps fill the pad, take fewer')
    end if
    if (bearing%radius > 0.0_wp .and. &
        foil%bumps*foil%pitch%value > pad_length(bearing)*(1.0_wp + rounding)) then
      call keys%complain(group, 'bumps', text(foil%bumps)//' bumps of the '// &
                         trim(merge('mean pitch', 'pitch     ', allocated(foil%pitch%by_bump)))// &
                         ' '//text(foil%pitch%value)//' m are longer than the pad, '// &
                         text(pad_length(bearing))//' m')
    end if
  end subroutine check_geometry

  !> Bumps with sizes of their own that overlap, or are more than half a circle.
  subroutine check_bumps(keys, foil)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil

    if (.not. foil%half_length%value > 0.0_wp) return
    associate (height => foil%height%each(foil%bumps), pitch => foil%pitch%each(foil%bumps), &
               half_length => foil%half_length%each(foil%bumps))
      call complain_of_sizes(keys, foil%height%bump_key(), height > half_length, height, &
                             'must not exceed half_length: a bump is at most half a circle', &
                             'half_length', half_length, 'bump')
      if (.not. foil%pitch%value > 0.0_wp) return
      call complain_of_sizes(keys, foil%pitch%bump_key(), overlapping(foil, foil%bumps), pitch, &
                             'must be at least 2 half_length, or bumps overlap', &
                             '2 half_length', 2.0_wp*half_length, 'bump')
    end associate
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
  pure real(wp) function largest_gap(law, gap) result(largest)
    type(height_deviation_type), intent(in) :: law !! with the gaps of further strips
    real(wp), intent(in) :: gap(:) !! of the first strip, one a bump [m]

    largest = maxval(gap)
    if (.not. allocated(law%further_gap)) return
    largest = maxval(law%further_gap + spread(gap, 2, size(law%further_gap, 2)))
  end function largest_gap

  !> Reads the law of the heights, and the gaps that they leave where none are given.
  subroutine read_height_deviation(keys, foil, gaps, strips)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(inout) :: foil !! with what is read before
    logical, intent(in) :: gaps    !! the file gives the gaps themselves
    integer, intent(in) :: strips  !! of all pads
    character(len=:), allocatable :: key, useless
    real(wp) :: height !! of the lowest bump, 0 where not known [m]
    integer :: word !! number of the law
    logical :: random, right

    key = 'crest_gap'
    associate (law => foil%random)
      call keys%real_key('height_deviation', law%deviation, 'm', 'standard deviation of the '// &
                         'bumps'' heights; at rest the highest crest touches', positive, &
                         default=no_default, given=random)
      right = keys%last_key_is_right()
      useless = unless(random .or. .not. foil%present, 'needs height_deviation')
      call keys%integer_key('seed', law%seed, 'chooses the random heights, and what else '// &
                            '`&sample` draws: the same seed gives the same ones', &
                            at_least(0.0_wp), useless=unless(useless == '' .or. &
                            keys%holds('sample', 'parameters'), useless))
      right = right .and. (keys%last_key_is_right() .or. .not. keys%key%given)
      word = 1
      call keys%choice_key('deviation_law', word, law_words, 'law of the random heights', &
                           useless=useless)
      right = right .and. word > 0
      if (gaps .and. random) then
        call keys%complain(group, 'height_deviation', 'contradicts crest_gap: the gaps follow '// &
                           'from the heights; give one of them')
      else if (right .and. real(foil%bumps, wp)*real(strips, wp) > most_heights) then
        call keys%complain(group, 'height_deviation', text(foil%bumps)//' bumps on '// &
                           text(strips)//' strips of all pads have more than '// &
                           text(nint(most_heights))//' heights')
        law%deviation = 0.0_wp ! none is drawn
        return
      else if (right .and. foil%bumps > 0) then
        key = 'height_deviation'
        call draw_gaps(law, foil%bumps, strips, foil%crest_gap)
      end if
      height = foil%height%smallest()
      if (.not. allocated(foil%crest_gap) .or. .not. height > 0.0_wp) return
      if (largest_gap(law, foil%crest_gap) < height) return
      call keys%complain(group, key, 'leaves a gap of '//text(largest_gap(law, foil%crest_gap), &
                         4)//' m, which must be less than the height of the bumps, '// &
                         text(height)//' m')
    end associate
  end subroutine read_height_deviation
end module gfb_foil_cases
