!> Reads a case file into a scene, once more for each value of a sweep over its keys; finds the keys
!> that `&sweep` and `&sensitivity` name.
module gfb_scene_reading
  use gfb_kinds, only: wp
  use gfb_foil_cases, only: bump_foil_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: coupling_partitioned
  use gfb_scene, only: scene_type, read_groups
  use gfb_study_cases, only: parameter_type
  use gfb_sweep_case, only: swept_key_type, swept_keys, sweep_keys, every_element, named_keys
  use gfb_text, only: text
  use gfb_case_text, only: read_case_text
  use gfb_errors, only: error_type
  use gfb_foreign_characters, only: as_utf8
  use gfb_key_book, only: key_type
  use gfb_key_effect, only: acts_on_nothing
  use gfb_plausible_values, only: check_plausible, check_tolerance
  use gfb_scene_rules, only: check_groups
  use gfb_changed_text, only: changed_text, changed_list_text
  implicit none (type, external)
  private
  public :: read_scene, read_scene_text, scene_at_value, scene_with_key, scene_with_keys, &
            key_table, all_keys

  character(len=*), parameter :: word_needed = &
    'needs a parameter that is a word, such as ''load'': '

  character(len=*), parameter :: group = 'sensitivity', parameters = 'parameters'

  character(len=*), parameter :: ending = '.nml'

contains

  !> How many values a list means to have whose one value stands for all; 0 where it has as many as
  !> the file gives.
  pure integer function list_length(key, foil) result(length)
    type(swept_key_type), intent(in) :: key !! a list
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for

    length = 0
    if (key%group /= 'bump_foil') return
    if (key%is_gap() .or. index(key%name, 'bump_') == 1) length = foil%bumps
    if (index(key%name, 'strip_') == 1) length = foil%strips
  end function list_length

  !> All values of a list; none where the file does not give it and it has no default.
  function list_values(keys, key, foil) result(list)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(swept_key_type), intent(in) :: key !! a list
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp), allocatable :: list(:) !! [their unit]
    integer :: place

    list = [real(wp) ::]
    place = keys%book%place_of(key%group, key%name)
    if (place > 0) list = keys%book%keys(place)%numbers
    if (size(list) == 0 .and. key%is_gap()) list = [0.0_wp]
    if (size(list) == 1) list = spread(list(1), 1, max(1, list_length(key, foil)))
  end function list_values

  !> Why an index does not choose a value of a list; empty where it does.
  function index_problem(keys, key, foil) result(problem)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(swept_key_type), intent(in) :: key !! a list, with an index
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    character(len=:), allocatable :: problem
    integer :: length

    problem = ''
    length = size(list_values(keys, key, foil))
    if (key%is_gap() .and. keys%meant('bump_foil', 'height_deviation')) then
      problem = key%label()//' has no effect here: height_deviation gives the gaps'
    else if (length == 0) then
      problem = key%group//'%'//key%name//' is not given'
    else if (key%element > length) then
      problem = key%label()//' does not exist: the list has '//text(length)//' values'
    end if
  end function index_problem

  !> Looks the sweep's keys up, notes their unit, and complains about those that cannot be swept;
  !> nothing is done where the sweep changes no keys.
  subroutine check_swept_keys(keys, scene, right)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, all read
    type(scene_type), intent(inout) :: scene !! gets the unit of its sweep
    logical, intent(out) :: right !! the sweep changes keys, and can
    type(swept_key_type), allocatable :: list(:)
    character(len=:), allocatable :: problem, unit
    integer :: i

    right = scene%sweep%present .and. scene%sweep%parameter == sweep_keys
    if (.not. right) return
    list = swept_keys(scene%sweep)
    do i = 1, size(list)
      call look_up(keys, scene, list(i), unit, problem)
      if (i == 1) scene%sweep%unit = unit
      if (problem == '' .and. list(i)%element == every_element) then
        problem = list(i)%label()//': the values of a sweep are those of one element'
      end if
      if (problem == '' .and. unit /= scene%sweep%unit .and. scene%sweep%unit /= '') then
        problem = list(i)%label()//' is in '//unit//', the first key in '// &
                  scene%sweep%unit//': one value cannot be both'
      end if
      if (problem == '') cycle
      call keys%complain('sweep', 'parameter', problem)
      right = .false.
    end do
    associate (sweep => scene%sweep) ! the bearing is built anew for each value
      call keys%rule('sweep', 'turn_folds', sweep%turn_folds, word_needed//'a branch is '// &
                     'followed by its own length with the derivative by the parameter, and a '// &
                     'key has none')
      call keys%rule('sweep', 'friction_memory', sweep%friction_memory, word_needed//'where a '// &
                     'key changes, the contacts are built anew and have no slip to remember')
      call keys%rule('sweep', 'hold_position', sweep%hold_position, word_needed//'each value '// &
                     'of a key makes another bearing, and the shaft stands elsewhere in it')
      call keys%rule('sweep', 'parameter', scene%model%coupling == coupling_partitioned, 'keys '// &
                     "need coupling = 'monolithic' in &model: loops do not start from the "// &
                     'answer of a neighbour')
      right = right .and. .not. (sweep%turn_folds .or. sweep%friction_memory .or. &
                                 sweep%hold_position)
    end associate
  end subroutine check_swept_keys

  !> Looks up a real key, or a value of a list, that answers of the scene follow.
  subroutine look_up(keys, scene, key, unit, problem)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(swept_key_type), intent(in) :: key !! as it was typed
    character(len=:), allocatable, intent(out) :: unit !! of the key; empty where there is a problem
    character(len=:), allocatable, intent(out) :: problem !! in words; empty where there is none

    call keys%book%look_up_real(key%group, key%name, key%element /= 0, unit, problem)
    if (problem == '') problem = use_problem(keys, key)
    if (problem == '' .and. key%element /= 0) problem = index_problem(keys, key, scene%bump_foil)
  end subroutine look_up

  !> Why a key has no effect on the answers of this scene; empty where it has one.
  function use_problem(keys, named) result(problem)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(swept_key_type), intent(in) :: named !! the key, as it was typed
    character(len=:), allocatable :: problem

    associate (key => keys%book%keys(keys%book%place_of(named%group, named%name)))
      problem = key%idle
      if (key%acts_on == acts_on_nothing) then
        problem = 'it does not belong to the bearing, but to how it is computed'
      end if
    end associate
    if (problem /= '') problem = named%group//'%'//named%name//' has no effect here: '//problem
  end function use_problem

  !> Looks the keys up, notes units and values, and complains about those that no answer follows.
  subroutine check_sensitivity(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, all read
    type(scene_type), intent(inout) :: scene !! gets the parameters
    type(swept_key_type), allocatable :: list(:)
    character(len=:), allocatable :: problem
    real(wp) :: tolerance
    integer :: i, k, before
    logical :: tolerated

    associate (asked => scene%sensitivity)
      allocate (asked%parameter(0))
      if (.not. asked%present) return
      list = named_keys(asked%names)
      if (asked%names == '') list = list(:0)
      tolerated = size(asked%tolerances) == size(list)
      tolerance = 0.0_wp
      do i = 1, size(list)
        if (tolerated) tolerance = asked%tolerances(i)
        before = size(asked%parameter)
        call add_parameter(keys, scene, list(i), tolerance, problem)
        if (tolerated .and. size(asked%parameter) > before) then
          associate (last => asked%parameter(size(asked%parameter)))
            call check_tolerance(keys, list(i)%group//'%'//list(i)%name, &
                                 maxval(abs(asked%parameter(before + 1:)%value)), tolerance, &
                                 last%unit, i)
          end associate
        end if
        do k = 1, i - 1
          if (list(k)%group /= list(i)%group .or. list(k)%name /= list(i)%name) cycle
          if (list(k)%element /= list(i)%element .and. &
              all([list(k)%element, list(i)%element] /= every_element)) cycle
          problem = list(i)%label()//' is given twice'
        end do
        if (problem == '') cycle
        if (asked%strings == size(list)) then
          call keys%complain(group, parameters, problem, i)
        else
          call keys%complain(group, parameters, problem)
        end if
      end do
      call keys%rule(group, 'tolerances', size(asked%tolerances) > 0 .and. .not. tolerated, &
                     'must have one value a parameter: '//text(size(list))//', not '// &
                     text(size(asked%tolerances)))
    end associate
    ! Where answers rest on what was before, their derivatives would have to be carried along.
    call keys%rule('sweep', 'friction_memory', scene%sweep%friction_memory, 'cannot stand '// &
                   'beside &sensitivity: slip that is carried along depends on the parameters '// &
                   'at all points before')
    call keys%rule('sweep', 'hold_position', scene%sweep%hold_position, 'cannot stand beside '// &
                   '&sensitivity: the position that is held depends on the parameters, too')
    call keys%rule('sweep', 'turn_folds', scene%sweep%turn_folds, 'cannot stand beside '// &
                   '&sensitivity: at a fold there is no derivative')
    call keys%rule('model', 'coupling', scene%model%coupling == coupling_partitioned, &
                   "must be 'monolithic' beside &sensitivity")
    call keys%rule(group, parameters, scene%accuracy%present, 'cannot stand beside &accuracy: '// &
                   'its meshes change, and with them the nodes of smallest and largest values')
    call keys%rule(group, parameters, scene%sample%present, 'cannot stand beside &sample: '// &
                   'derive one member by its seed')
  end subroutine check_sensitivity

  !> Looks up what a sample draws, notes units and values, and complains about what no answer
  !> follows and about ends of a range that break a rule.
  subroutine check_sampled_keys(keys, scene, strict)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, all read
    type(scene_type), intent(inout) :: scene !! gets the parameters
    logical, intent(in), optional :: strict
    type(swept_key_type), allocatable :: list(:)
    type(case_keys_type) :: known, changed
    type(scene_type) :: there
    type(parameter_type) :: one
    character(len=:), allocatable :: problem, words
    real(wp), allocatable :: value(:)
    integer :: i, k

    associate (asked => scene%sample)
      if (.not. asked%present .or. asked%names == '') return
      list = named_keys(asked%names)
      call keys%rule('sample', 'factors', size(asked%factors) /= size(list), 'must have one '// &
                     'value a parameter: '//text(size(list))//', not '//text(size(asked%factors)))
      known = keys
      do i = 1, size(list)
        one%key = list(i)
        call look_up(keys, scene, one%key, one%unit, problem)
        if (problem == '' .and. one%key%element == every_element) problem = one%key%label()// &
          ': a value is drawn for one element'
        if (problem == '') then
          value = list_values(keys, one%key, scene%bump_foil)
          one%value = value(max(1, one%key%element))
          if (.not. abs(one%value) > 0.0_wp) problem = one%key%label()// &
            ' is 0: no factor changes it'
        end if
        do k = 1, size(asked%parameter)
          if (asked%parameter(k)%key%label() == one%key%label()) problem = one%key%label()// &
            ' is given twice'
        end do
        if (problem == '') asked%parameter = [asked%parameter, one]
        if (problem /= '' .and. asked%strings == size(list)) then
          call keys%complain('sample', parameters, problem, i)
        else if (problem /= '') then
          call keys%complain('sample', parameters, problem)
        end if
        if (problem /= '' .or. size(asked%factors) /= size(list)) cycle
        if (.not. asked%factors(i) >= 1.0_wp) cycle ! which was reported
        do k = -1, 1, 2 ! both ends
          words = text_with_key(scene, scene%verbatim, one%key, one%value*asked%factors(i)**k)
          call read_and_check(words, scene%file, .false., changed, there, strict)
          call keys%add_new(changed, known, 'sample', parameters, i)
        end do
      end do
    end associate
  end subroutine check_sampled_keys

  !> Adds a parameter with its unit and value; of a whole list all its values.
  subroutine add_parameter(keys, scene, key, tolerance, problem)
    type(case_keys_type), intent(in) :: keys
    type(scene_type), intent(inout) :: scene
    type(swept_key_type), intent(in) :: key
    real(wp), intent(in) :: tolerance !! of each value [its unit]
    character(len=:), allocatable, intent(out) :: problem !! empty where it can be one
    type(parameter_type) :: one
    real(wp), allocatable :: value(:)
    integer :: i

    one%key = key
    one%tolerance = tolerance
    allocate (value(0))
    if (key%label() == 'operation%load') then
      one%unit = 'N'
      value = [norm2(scene%operation%load)]
      problem = ''
      if (.not. scene%general%analysis%floats) then
        problem = 'operation%load has no effect here: the position is given'
      end if
    else
      call look_up(keys, scene, key, one%unit, problem)
      if (problem /= '') return
      value = list_values(keys, key, scene%bump_foil)
    end if
    one%key%acts_on = keys%book%keys(keys%book%place_of(key%group, key%name))%acts_on
    do i = 1, size(value)
      if (key%element > 0 .and. key%element /= i) cycle
      if (key%element /= 0) one%key%element = i
      one%value = value(i)
      if (problem == '' .and. .not. (abs(one%value) > 0.0_wp .or. key%is_gap())) then
        problem = one%key%label()//' is 0: it has no size by which it could change'
      end if
      if (problem == '') scene%sensitivity%parameter = [scene%sensitivity%parameter, one]
    end do
  end subroutine add_parameter

  !> Reads a case file.
  !>
  !> Fails with all mistakes of the file, one a line.
  subroutine read_scene(file, scene, error, strict)
    character(len=*), intent(in) :: file !! name of the case file
    type(scene_type), intent(out) :: scene !! what the case file asks for
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    logical, intent(in), optional :: strict !! warnings are mistakes
    character(len=:), allocatable :: words

    call read_case_text(file, words, error)
    if (allocated(error)) return
    call read_scene_text(words, file, scene, error, strict)
  end subroutine read_scene

  !> Reads the text of a case file.
  subroutine read_scene_text(words, file, scene, error, strict)
    character(len=*), intent(in) :: words  !! of the whole file
    character(len=*), intent(in) :: file   !! its name
    type(scene_type), intent(out) :: scene !! what the case file asks for
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    logical, intent(in), optional :: strict !! warnings are mistakes
    type(case_keys_type) :: keys
    character(len=:), allocatable :: utf8
    integer :: line, byte
    logical :: sweeps_keys

    call as_utf8(words, utf8, line, byte)
    call read_and_check(utf8, file, .true., keys, scene, strict)
    call check_plausible(keys, scene)
    if (line > 0) call keys%warn_of_line(line, 'the byte '//text(byte)//' is no UTF-8: it is '// &
                                         'read as a character of Latin-1; save the file as UTF-8')
    call check_sensitivity(keys, scene)
    call check_sampled_keys(keys, scene, strict)
    call check_swept_keys(keys, scene, sweeps_keys)
    if (sweeps_keys) call check_swept_values(keys, scene, strict)
    scene%echo = keys%book%echo()
    scene%warnings = keys%warning_lines()
    scene%hints = keys%hint_lines()
    call keys%report(error)
  end subroutine read_scene_text

  !> Reads the text of a case file, and checks all but what a sweep of keys makes of it, and how
  !> plausible the values are.
  subroutine read_and_check(words, file, noted, keys, scene, strict)
    character(len=*), intent(in) :: words, file
    logical, intent(in) :: noted !! for an echo of the keys
    type(case_keys_type), intent(out) :: keys
    type(scene_type), intent(out) :: scene
    logical, intent(in), optional :: strict

    scene%file = trim(file)
    scene%name = base_name(scene%file)
    scene%verbatim = words
    call keys%open_text(words, file, strict, noted)
    call read_groups(keys, scene)
    call keys%finish()
    call check_groups(keys, scene)
  end subroutine read_and_check

  !> Every value of a sweep of keys keeps the rules that it would have to keep in the file: the file
  !> is read with it.
  subroutine check_swept_values(keys, scene, strict)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    logical, intent(in), optional :: strict
    type(case_keys_type) :: known, changed
    type(scene_type) :: there
    integer :: point

    known = keys
    do point = 1, size(scene%sweep%values)
      call read_and_check(text_at_value(scene, scene%sweep%values(point)), scene%file, .false., &
                          changed, there, strict)
      call check_plausible(changed, there)
      call keys%add_new(changed, known, 'sweep', 'values', point)
    end do
  end subroutine check_swept_values

  !> The bearing of a scene with another value of the keys that its sweep changes, on its mesh.
  !>
  !> Fails where the value breaks a rule, which one between two values of the sweep may.
  subroutine scene_at_value(scene, value, there, error)
    type(scene_type), intent(in) :: scene !! whose sweep changes keys
    real(wp), intent(in) :: value !! [the sweep's unit]
    type(scene_type), intent(out) :: there !! the scene with the value in it
    type(error_type), allocatable, intent(out) :: error !! which rule is broken
    call read_bearing(text_at_value(scene, value), scene, there, error)
  end subroutine scene_at_value

  !> The bearing of a scene with another value of a key, on its mesh.
  !>
  !> Fails where the value breaks a rule.
  subroutine scene_with_key(scene, key, value, there, error, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(swept_key_type), intent(in) :: key !! of the case file
    real(wp), intent(in) :: value !! [its unit] of the key
    type(scene_type), intent(out) :: there !! the scene with the value in it
    type(error_type), allocatable, intent(out) :: error !! which rule is broken
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    character(len=:), allocatable :: words

    words = scene%verbatim
    if (present(at) .and. scene%sweep%parameter == sweep_keys) words = text_at_value(scene, at)
    call read_bearing(text_with_key(scene, words, key, value), scene, there, error)
  end subroutine scene_with_key

  !> The bearing of a scene with other values of some keys, on its mesh.
  !>
  !> Fails where the values break a rule.
  subroutine scene_with_keys(scene, parameter, value, there, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(parameter_type), intent(in) :: parameter(:) !! the keys
    real(wp), intent(in) :: value(:) !! [its unit] of each key
    type(scene_type), intent(out) :: there !! the scene with the values in it
    type(error_type), allocatable, intent(out) :: error !! which rule is broken
    character(len=:), allocatable :: words
    integer :: i

    words = scene%verbatim
    do i = 1, size(parameter)
      words = text_with_key(scene, words, parameter(i)%key, value(i))
    end do
    call read_bearing(words, scene, there, error)
    there%model%reduction = scene%model%reduction ! it is chosen for all members
  end subroutine scene_with_keys

  !> The bearing of a scene as another text describes it.
  subroutine read_bearing(words, scene, there, error)
    character(len=*), intent(in) :: words !! of a case file
    type(scene_type), intent(in) :: scene
    type(scene_type), intent(out) :: there
    type(error_type), allocatable, intent(out) :: error
    type(case_keys_type) :: keys
    type(scene_type) :: changed

    call read_and_check(words, scene%file, .false., keys, changed)
    call keys%report(error)
    there = scene
    there%bearing = changed%bearing
    there%bore = changed%bore
    there%dynamics = changed%dynamics
    there%rotor = changed%rotor
    there%transient = changed%transient
    there%periodic = changed%periodic
    there%unbalance = changed%unbalance
    there%foil_damping = changed%foil_damping
    there%capacity = changed%capacity
    there%gas = changed%gas
    there%feed = changed%feed
    there%grooves = changed%grooves
    there%thermal = changed%thermal
    there%operation = changed%operation
    there%top_foil = changed%top_foil
    there%bump_foil = changed%bump_foil
    there%contact = changed%contact
    there%shaft_contact = changed%shaft_contact
    there%model = changed%model
  end subroutine read_bearing

  !> The text of a case file with a value of the keys that its sweep changes, as its only value.
  function text_at_value(scene, value) result(changed)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: value !! [the sweep's unit]
    character(len=:), allocatable :: changed
    type(swept_key_type), allocatable :: list(:)
    integer :: i

    changed = changed_text(scene%verbatim, 'sweep', 'values', value) ! long lists take long to read
    list = swept_keys(scene%sweep)
    do i = 1, size(list)
      changed = text_with_key(scene, changed, list(i), value)
    end do
  end function text_at_value

  !> The text of a case file with another value of a key, or of a value of a list.
  function text_with_key(scene, words, key, value) result(changed)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: words
    type(swept_key_type), intent(in) :: key
    real(wp), intent(in) :: value !! [its unit]
    character(len=:), allocatable :: changed

    if (key%element > 0) then
      changed = changed_list_text(words, key%group, key%name, key%element, &
                                  list_length(key, scene%bump_foil), value)
    else
      changed = changed_text(words, key%group, key%name, value)
    end if
  end function text_with_key

  !> All groups and keys there are, as a Markdown table; of a case file, be it wrong, with why a key
  !> has no use in it.
  function key_table(words) result(table)
    character(len=*), intent(in), optional :: words !! of the whole case file
    character(len=:), allocatable :: table
    type(case_keys_type) :: keys
    type(scene_type) :: scene
    character(len=:), allocatable :: utf8
    integer :: line, byte

    if (present(words)) then
      call as_utf8(words, utf8, line, byte)
      call read_and_check(utf8, 'case', .false., keys, scene)
    else
      call read_nothing(keys)
    end if
    table = keys%book%table(present(words))
  end function key_table

  !> All keys there are.
  function all_keys() result(list)
    type(key_type), allocatable :: list(:)
    type(case_keys_type) :: keys

    call read_nothing(keys)
    list = keys%book%keys(:keys%book%count)
  end function all_keys

  !> Reads the keys of an empty file, and so notes what there is.
  subroutine read_nothing(keys)
    type(case_keys_type), intent(out) :: keys
    type(scene_type) :: scene

    call keys%open_text('', 'none')
    call read_groups(keys, scene)
  end subroutine read_nothing

  !> A file's name without its folder and its ending.
  pure function base_name(file) result(name)
    character(len=*), intent(in) :: file
    character(len=:), allocatable :: name
    integer :: last

    name = file(index(file, '/', back=.true.) + 1:)
    last = len(name) - len(ending)
    if (last < 1) return
    if (name(last + 1:) == ending) name = name(:last)
  end function base_name
end module gfb_scene_reading
