!> Keys of `&bump_foil` that make the heights of its bumps random.
module gfb_height_deviation_keys
  use gfb_kinds, only: wp
  use gfb_bump_heights, only: crest_gaps, normal_deviations
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_text, only: text
  use gfb_value_rules, only: at_least, positive
  implicit none (type, external)
  private
  public :: read_height_deviation, height_deviation_type, draw_gaps, largest_gap

  character(len=*), parameter :: group = 'bump_foil'
  character(len=*), parameter :: law_words(*) = [character(len=6) :: 'normal']

  real(wp), parameter :: most_heights = 1.0e6_wp !! drawn for a scene

  !> How the heights deviate.
  type :: height_deviation_type
    real(wp) :: deviation = 0.0_wp !! standard deviation; 0: none was asked for [m]
    integer :: seed = 1            !! chooses the heights
    !> (bumps, strips of all pads) what the gaps of each strip are more than those of the first,
    !> pad by pad; not allocated: there is one strip [m]
    real(wp), allocatable :: further_gap(:, :)
  end type height_deviation_type

contains

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
end module gfb_height_deviation_keys
