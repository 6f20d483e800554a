!> `&bore`: where the bore is no circle.
module gfb_bore_case
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: bearing_case_type, pad_angle, pad_turn, preload_angle
  use gfb_bore_profile, only: bore_profile_type, bore_height, bore_peak
  use gfb_case_keys, only: case_keys_type, longest_list, any_value, from_below, from_to, &
                           not_negative, positive, rule_type
  use gfb_scene_case, only: is_bearing, misplaced_group
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: bore_case_type, read_bore_case

  character(len=*), parameter :: group = 'bore'
  real(wp), parameter :: most_waves = 1000.0_wp      !! more are roughness, which no film mesh shows

  !> The bore.
  type :: bore_case_type
    logical :: present = .false.       !! the file has the group
    type(bore_profile_type) :: profile !! its height over the circle
  end type bore_case_type

contains

  !> Reads the group.
  subroutine read_bore_case(keys, bore, bearing, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bore_case_type), intent(out) :: bore !! what `&bore` asks for
    type(bearing_case_type), intent(in) :: bearing !! the pads on it
    integer, intent(in) :: analysis !! 0 where it is not known
    real(wp) :: peak, shims !! highest of the bore; of its shims, be the others wrong [m]
    integer :: mistakes !! before the group

    mistakes = keys%mistakes()
    call keys%start_group(group, optional=.true., present_in_file=bore%present, &
                          misplaced=misplaced_group(analysis, is_bearing(analysis)))
    call read_waves(keys, bore%profile)
    call read_shims(keys, bore%profile, shims)
    call read_table(keys, bore%profile)
    if (.not. bore%present) return
    call keys%rule(group, 'shim_height', .not. allocated(bore%profile%shim_height) .and. &
                   bearing%clearance > 0.0_wp .and. shims >= bearing%clearance, &
                   'must be less than the clearance of '//text(bearing%clearance)// &
                   ' m: no gap is left at rest')
    if (.not. bore%profile%present()) then
      call keys%rule(group, 'waves', keys%mistakes() == mistakes, 'or shim_angle or '// &
                     'profile_angle is needed: the group says nothing of the bore')
      return
    end if
    peak = bore_peak(bore%profile)
    if (.not. bearing%clearance > 0.0_wp) return
    if (peak >= bearing%clearance) then
      call keys%complain(group, highest_key(bore%profile), 'makes the bore '//text(peak, 4)// &
                         ' m high in all, which must be less than the clearance of '// &
                         text(bearing%clearance)//' m: no gap is left at rest')
    else if (.not. least_gap(bearing, bore%profile) > 0.0_wp) then
      call keys%complain(group, highest_key(bore%profile), 'with the preload of the pads '// &
                         'leaves no gap at rest')
    end if
  end subroutine read_bore_case

  !> Smallest gap at rest of pads with a preload [m].
  pure function least_gap(bearing, profile) result(gap)
    type(bearing_case_type), intent(in) :: bearing
    type(bore_profile_type), intent(in) :: profile
    real(wp) :: gap
    integer, parameter :: points = 2000 !! of a pad
    real(wp) :: angle, shift
    integer :: pad, i

    gap = bearing%clearance
    do pad = 1, bearing%pads
      do i = 0, points
        angle = bearing%leading_edge_angle + pad_turn(bearing, pad) &
          + pad_angle(bearing)*real(i, wp)/real(points, wp)
        shift = bearing%preload*cos(angle - preload_angle(bearing, pad))
        gap = min(gap, bearing%clearance*(1.0_wp - shift) - bore_height(profile, angle))
      end do
    end do
  end function least_gap

  !> Lobes.
  subroutine read_waves(keys, profile)
    type(case_keys_type), intent(inout) :: keys
    type(bore_profile_type), intent(inout) :: profile
    logical :: waves, amplitude

    call keys%integer_key('waves', profile%waves, 'waves of the bore around the circle; 0: none', &
                          from_to(0.0_wp, most_waves), given=waves)
    waves = profile%waves > 0
    call keys%real_key('wave_amplitude', profile%wave_amplitude, 'm', 'amplitude of the waves, '// &
                       'half of their height from trough to crest', positive, waves, &
                       default='required with waves', given=amplitude)
    call keys%real_key('wave_angle', profile%wave_angle, 'rad', 'angle of a crest, where the '// &
                       'bore is nearest to the shaft', any_value)
    if (amplitude .and. .not. waves) call keys%complain(group, 'wave_amplitude', 'needs waves')
    call keys%rule(group, 'wave_angle', keys%meant(group, 'wave_angle') .and. .not. waves, &
                   'needs waves')
  end subroutine read_waves

  !> Shims: each list has one value a shim; of arcs, ramps and heights one may stand for all.
  subroutine read_shims(keys, profile, highest)
    type(case_keys_type), intent(inout) :: keys
    type(bore_profile_type), intent(inout) :: profile
    real(wp), intent(out) :: highest !! shim; 0 where their heights are wrong [m]
    real(wp), allocatable :: angle(:), height(:), arc(:), ramp(:)
    logical :: right, here

    call keys%real_list_key('shim_angle', angle, longest_list, 'rad', 'middle of each shim '// &
                            'under the foil', any_value, .false., 'no shims')
    here = keys%key%given
    right = here .and. keys%last_key_is_right()
    call one_list('shim_height', height, 'm', 'height of the plateau of each shim, or '// &
                  'of all', any_value)
    highest = 0.0_wp
    if (keys%last_key_is_right()) highest = maxval(height)
    call one_list('shim_arc', arc, 'rad', 'whole arc of the plateau of each shim, or of all', &
                  not_negative)
    call one_list('shim_ramp', ramp, 'rad', 'arc of the ramp on each side of the plateau of '// &
                  'each shim, or of all', positive)
    if (.not. right) return
    if (any(0.5_wp*arc + ramp > 0.5_wp*turn)) then
      call keys%complain(group, 'shim_arc', 'with both ramps must be a whole turn at most')
      return
    end if
    profile%shim_angle = angle
    profile%shim_height = height
    profile%shim_arc = arc
    profile%shim_ramp = ramp
    call warn_of_overlaps(keys, angle, 0.5_wp*arc + ramp)

  contains

    !> One of the lists beside the angles.
    subroutine one_list(name, list, unit, meaning, rule)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), allocatable, intent(out) :: list(:)
      type(rule_type), intent(in) :: rule

      call keys%real_list_key(name, list, longest_list, unit, meaning, rule, here, &
                              'required with shim_angle')
      if (.not. here) then
        if (keys%key%given) call keys%complain(group, name, 'needs shim_angle')
      else if (.not. keys%last_key_is_right()) then
        right = .false.
      else if (size(list) == 1) then
        list = spread(list(1), 1, size(angle))
      else if (size(list) /= size(angle)) then
        call keys%complain(group, name, 'must have one value, or one a shim: '// &
                           text(size(angle))//', not '//text(size(list)))
        right = .false.
      end if
    end subroutine one_list
  end subroutine read_shims

  !> Warns of shims that overlap, as their heights add.
  subroutine warn_of_overlaps(keys, angle, reach)
    type(case_keys_type), intent(inout) :: keys
    real(wp), intent(in) :: angle(:) !! of their middles [rad]
    real(wp), intent(in) :: reach(:) !! from there to their ends [rad]
    real(wp), parameter :: rounding = 1.0e-9_wp !! of ends that are meant to meet [rad]
    real(wp) :: apart
    integer :: i, k

    do i = 2, size(angle)
      do k = 1, i - 1
        apart = modulo(angle(i) - angle(k), turn)
        apart = min(apart, turn - apart)
        if (apart > reach(i) + reach(k) - rounding) cycle
        call keys%warn(group, 'shim_angle', 'shims '//text(k)//' and '//text(i)//' overlap, '// &
                       'ramps included: their heights add', i)
        exit
      end do
    end do
  end subroutine warn_of_overlaps

  !> A measured bore, or wear.
  subroutine read_table(keys, profile)
    type(case_keys_type), intent(inout) :: keys
    type(bore_profile_type), intent(inout) :: profile
    real(wp), allocatable :: angle(:), height(:)
    logical :: here, right
    integer :: i

    call keys%real_list_key('profile_angle', angle, longest_list, 'rad', 'angles of a measured '// &
                            'bore, rising', from_below(0.0_wp, turn), .false., 'no profile')
    here = keys%key%given
    right = here .and. keys%last_key_is_right()
    if (right .and. size(angle) < 2) then
      call keys%complain(group, 'profile_angle', 'needs two values at least')
      right = .false.
    end if
    do i = 2, size(angle)
      if (.not. right) exit
      if (angle(i) > angle(i - 1)) cycle
      call keys%complain(group, 'profile_angle', 'must be greater than the value before it', i)
      right = .false.
    end do
    call keys%real_list_key('profile_height', height, longest_list, 'm', 'height of the bore '// &
                            'over the circle there, linear between the angles and around', &
                            any_value, here, 'required with profile_angle')
    if (keys%key%given .and. .not. here) then
      call keys%complain(group, 'profile_height', 'needs profile_angle')
    else if (keys%key%given .and. size(height) /= size(angle)) then
      call keys%complain(group, 'profile_height', 'must have one value an angle: '// &
                         text(size(angle))//', not '//text(size(height)))
      right = .false.
    end if
    if (.not. (right .and. keys%key%given)) return
    profile%table_angle = angle
    profile%table_height = height
  end subroutine read_table

  !> The key that has most to do with the height.
  pure function highest_key(profile) result(key)
    type(bore_profile_type), intent(in) :: profile
    character(len=:), allocatable :: key
    real(wp) :: height

    key = 'wave_amplitude'
    height = profile%wave_amplitude
    if (allocated(profile%shim_height)) then
      if (maxval(profile%shim_height) > height) key = 'shim_height'
      height = max(height, maxval(profile%shim_height))
    end if
    if (allocated(profile%table_height)) then
      if (maxval(profile%table_height) > height) key = 'profile_height'
    end if
  end function highest_key
end module gfb_bore_case
