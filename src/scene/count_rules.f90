!> What a scene makes of its numbers without saying so: elements, steps, answers.
!>
!> Each of these counts is a real, which no product overflows, and keeps the limit of the counts
!> that are given, before anything of that size is made.
module gfb_count_rules
  use gfb_kinds, only: wp, long
  use gfb_units, only: pi
  use gfb_study_cases, only: part_strip
  use gfb_case_keys, only: case_keys_type
  use gfb_result_table, only: bearing, strip
  use gfb_scene, only: scene_type
  use gfb_text, only: text
  use gfb_bearing_case, only: pad_length
  use gfb_mesh_case, only: most_a_side
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: motion_free, duration_of, chosen_steps
  implicit none (type, external)
  private
  public :: check_counts

  integer(long), parameter :: most_in_all = 50000000_long !! elements of a mesh, steps, answers
  integer(long), parameter :: most_stations = 1000000_long !! elements along a bump strip

  !> Elements each way.
  type :: elements_type
    real(wp) :: along = 0.0_wp  !! the pad [1]
    real(wp) :: across = 0.0_wp !! its width [1]
    real(wp) :: bump = 0.0_wp   !! of an arc with its flat [1]
  end type elements_type

contains

  !> Checks all counts that follow from others.
  subroutine check_counts(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(elements_type) :: elements
    integer :: before

    before = keys%mistakes()
    elements = elements_of(scene)
    call check_film(keys, scene, elements)
    call check_bumps(keys, scene, elements)
    if (keys%mistakes() == before) call check_finest(keys, scene)
    call check_modes(keys, scene)
    call check_answers(keys, scene)
    call check_times(keys, scene)
    call check_periods(keys, scene)
  end subroutine check_counts

  !> Elements of film and top foil.
  subroutine check_film(keys, scene, elements)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(elements_type), intent(in) :: elements
    real(wp) :: most !! along the pad; whole elements a pitch may be half as many again [1]

    most = max(real(most_a_side, wp), 1.5_wp*real(scene%mesh%circumferential_elements, wp))
    if (elements%along > most) then
      call keys%complain('bearing', 'radius', 'the pad has '//text(pad_length(scene%bearing), 6)// &
                         ' m, along which align_crests in &mesh makes about '// &
                         text(elements%along, 3)//' elements at a pitch of '// &
                         text(scene%bump_foil%pitch%value, 6)//' m: must be at most '// &
                         text(most_a_side))
    else if (elements%along*elements%across*films(scene) > real(most_in_all, wp)) then
      call keys%complain('mesh', 'axial_elements', text(nint(elements%along))//' x '// &
                         text(nint(elements%across))//' elements'//of_films(scene)// &
                         ' are more than '//text(most_in_all))
    end if
  end subroutine check_film

  !> Elements of a bump foil that is meshed.
  subroutine check_bumps(keys, scene, elements)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(elements_type), intent(in) :: elements
    real(wp) :: bumps !! of all pads [1]

    if (.not. meshes_bumps(scene)) return
    bumps = real(scene%bump_foil%bumps, wp)*pads(scene)
    if (bumps*elements%bump*elements%across > real(most_in_all, wp)) then
      call keys%complain('bump_foil', 'bumps', text(scene%bump_foil%bumps)//' bumps of '// &
                         text(nint(elements%bump*elements%across, long))//' elements'// &
                         on_pads(scene)//' are more than '//text(most_in_all)//' elements')
    else if (scene%bump_foil%bumps*elements%bump > real(most_stations, wp)) then
      call keys%complain('bump_foil', 'bumps', text(scene%bump_foil%bumps)//' bumps of '// &
                         text(nint(elements%bump))//' elements are more than '// &
                         text(most_stations)//' along the strip')
    end if
  end subroutine check_bumps

  !> The finest mesh that an accuracy may take.
  subroutine check_finest(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(elements_type) :: finest
    type(scene_type) :: fine
    real(wp) :: all

    if (.not. scene%accuracy%present) return
    fine = scene
    associate (mesh => fine%mesh, number => scene%accuracy%maximum_refinements)
      mesh%circumferential_elements = finer(mesh%circumferential_elements, 4, number)
      mesh%axial_elements = finer(mesh%axial_elements, 2, number)
      mesh%arc_elements = finer(mesh%arc_elements, 2, number)
      mesh%flat_elements = finer(mesh%flat_elements, 1, number)
    end associate
    finest = elements_of(fine)
    all = finest%along*finest%across*films(scene)
    if (meshes_bumps(scene)) then
      all = max(all, scene%bump_foil%bumps*finest%bump*finest%across*pads(scene))
    end if
    call must_fit(keys, 'accuracy', 'maximum_refinements', all, 'the finest mesh has about ', &
                  ' elements')
  end subroutine check_finest

  !> A number of elements after some refinements by two, of a mesh that is four times coarser.
  elemental integer function finer(elements, least, refinements) result(number)
    integer, intent(in) :: elements !! that `&mesh` says, at most 100,000
    integer, intent(in) :: least !! of the first mesh
    integer, intent(in) :: refinements !! at most 8
    number = max(least, (elements + 3)/4)*2**refinements
  end function finer

  !> Elements of a scene each way.
  pure function elements_of(scene) result(elements)
    type(scene_type), intent(in) :: scene
    type(elements_type) :: elements

    elements%along = real(scene%mesh%circumferential_elements, wp)
    elements%across = real(scene%mesh%axial_elements, wp)
    elements%bump = real(scene%mesh%arc_elements + scene%mesh%flat_elements, wp)
    ! The shares of strips are rounded up, one element at least, and a line lies in a cut.
    if (scene%bump_foil%strips > 1) then
      elements%across = elements%across + 3.0_wp*real(scene%bump_foil%strips, wp)
    end if
    if (scene%mesh%align_crests .and. scene%bump_foil%bumps > 0) then
      call align_with_crests(scene, elements%along)
    end if
  end function elements_of

  !> Elements along a pad where lines of nodes lie above the crests: whole ones a pitch, and as
  !> long ones before the first crest and behind the last.
  pure subroutine align_with_crests(scene, along)
    type(scene_type), intent(in) :: scene
    real(wp), intent(inout) :: along !! [1]
    real(wp) :: of_pitch, rest !! elements; pitches outside the crests [1]

    associate (length => pad_length(scene%bearing), pitch => scene%bump_foil%pitch%value, &
               bumps => real(scene%bump_foil%bumps, wp))
      if (.not. (length > 0.0_wp .and. pitch > 0.0_wp)) return
      of_pitch = max(1.0_wp, anint(along*pitch/length))
      rest = max(0.0_wp, length/pitch - (bumps - 1.0_wp))
      along = of_pitch*(bumps - 1.0_wp + rest)
    end associate
  end subroutine align_with_crests

  !> Films of linear elements with as many nodes: of all pads, and of both bearings where a rotor
  !> tilts on two over time [1].
  pure real(wp) function films(scene) result(number)
    type(scene_type), intent(in) :: scene
    number = pads(scene)*real(scene%model%film_order**2, wp)
  end function films

  !> Pads, of both bearings where a rotor tilts on two over time [1].
  pure real(wp) function pads(scene) result(number)
    type(scene_type), intent(in) :: scene

    number = real(scene%bearing%pads, wp)
    if (scene%rotor%distance_in_time > 0.0_wp) number = 2.0_wp*number
  end function pads

  !> Pads and order of films in words.
  pure function of_films(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    words = on_pads(scene)
    if (scene%model%film_order > 1) words = ' of '//text(scene%model%film_order**2)// &
                                            ' nodes each'//words
  end function of_films

  !> Pads in words, where they are several.
  pure function on_pads(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    words = ''
    if (pads(scene) > 1.5_wp) words = ' on '//text(nint(pads(scene)))//' pads'
  end function on_pads

  !> Whether the whole bump foil is meshed.
  pure logical function meshes_bumps(scene) result(meshes)
    type(scene_type), intent(in) :: scene

    associate (analysis => scene%general%analysis)
      meshes = analysis%loads_strip .or. &
               (analysis%has_film .and. scene%model%foil%has_bumps) .or. &
               (analysis%finds_modes .and. scene%modes%part == part_strip)
    end associate
  end function meshes_bumps

  !> Modes inside pieces of the bumps: three a bump, arcs cut at the crest and the flat.
  subroutine check_modes(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: pieces !! [1]

    if (.not. meshes_bumps(scene)) return
    pieces = 3.0_wp*real(scene%bump_foil%bumps, wp)*real(scene%bump_foil%strips, wp)*pads(scene)
    call check('modes', 'substructure_modes', scene%modes%substructure_modes, &
               scene%general%analysis%finds_modes)
    call check('foil_damping', 'foil_modes', scene%foil_damping%foil_modes, &
               scene%dynamics%present .or. scene%transient%present)

  contains

    !> Checks the modes of one key.
    subroutine check(group, key, modes, counts)
      character(len=*), intent(in) :: group, key !! names in the case file
      integer, intent(in) :: modes  !! of a piece
      logical, intent(in) :: counts !! the key has a use

      if (.not. counts .or. pieces*real(modes, wp) <= real(most_in_all, wp)) return
      call keys%complain(group, key, text(modes)//' modes in each of '//text(pieces, 3)// &
                         ' pieces of the bumps are more than '//text(most_in_all))
    end subroutine check
  end subroutine check_modes

  !> Answers of a linear response: points of a sweep, times frequencies, times amplitudes.
  subroutine check_answers(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: points, frequencies !! [1]

    if (.not. scene%dynamics%present) return
    frequencies = real(size(scene%dynamics%frequencies), wp)
    points = real(max(1, size(scene%dynamics%amplitudes)), wp)
    if (allocated(scene%sweep%values)) points = points*real(max(1, size(scene%sweep%values)), wp)
    if (points*frequencies <= real(most_in_all, wp)) return
    call keys%complain('dynamics', 'frequencies', text(nint(frequencies))//' frequencies at '// &
                       text(points, 3)//' points or amplitudes are more than '//text(most_in_all))
  end subroutine check_answers

  !> Steps of a shaft over time, and the fields that it stores.
  subroutine check_times(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: duration, fastest, steps
    character(len=:), allocatable :: key

    associate (transient => scene%transient, operation => scene%operation)
      if (.not. transient%present) return
      if (min(operation%speed_rpm, transient%final_speed_rpm) < 0.0_wp) return
      if (.not. transient%duration > 0.0_wp .and. &
          .not. max(operation%speed_rpm, transient%final_speed_rpm)*transient%turns > 0.0_wp) return
      duration = duration_of(transient, operation)
      if (.not. duration < huge(duration)) return ! see the rule of its end
      fastest = max(angular_speed(operation%speed_rpm), angular_speed(transient%final_speed_rpm), &
                    abs(transient%orbit_frequency))
      steps = max(1.0_wp, duration*fastest/(2.0_wp*pi))
      steps = steps*merge(transient%steps_per_turn, chosen_steps(transient%time_method), &
                          transient%steps_per_turn > 0.0_wp)
      key = 'turns'
      if (keys%meant('transient', 'duration')) key = 'duration'
      if (transient%steps_per_turn > 1.0e5_wp) key = 'steps_per_turn'
      call must_fit(keys, 'transient', key, steps, 'makes about ', ' steps of time')
      if (.not. transient%field_interval > 0.0_wp) return
      call must_fit(keys, 'transient', 'field_interval', (duration - transient%field_start)/ &
                    transient%field_interval, 'makes about ', ' times of stored fields')
    end associate
  end subroutine check_times

  !> Steps of time in a period, and in those before the first orbit.
  subroutine check_periods(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: steps !! [1]

    associate (periodic => scene%periodic)
      if (.not. periodic%present) return
      steps = real(periodic%steps_per_turn, wp)
      if (periodic%motion /= motion_free) steps = steps*real(periodic%period_turns, wp)
      call must_fit(keys, 'periodic', 'steps_per_turn', steps, 'makes ', ' steps of a period')
      if (steps > real(most_in_all, wp) .or. periodic%motion == motion_free) return
      call must_fit(keys, 'periodic', 'start_turns', steps*real(periodic%start_turns, wp), &
                    'makes ', ' steps of time before the first orbit')
    end associate
  end subroutine check_periods

  !> Complains about a number that is larger than the limit of all.
  subroutine must_fit(keys, group, key, number, makes, what)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: group, key !! names in the case file
    real(wp), intent(in) :: number !! [1]
    character(len=*), intent(in) :: makes, what !! words before and behind the number

    call keys%rule(group, key, number > real(most_in_all, wp), makes//text(number, 3)//what// &
                   ': must be at most '//text(most_in_all))
  end subroutine must_fit
end module gfb_count_rules
