!> Reads a case file into a scene, once more for each value of a sweep over its keys.
module gfb_scene_reading
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_case_text, only: read_case_text
  use gfb_changed_text, only: changed_text, changed_list_text
  use gfb_errors, only: error_type
  use gfb_foreign_characters, only: as_utf8
  use gfb_key_book, only: key_type
  use gfb_named_key_rules, only: list_length, check_sensitivity, check_swept_keys
  use gfb_plausible_values, only: check_plausible
  use gfb_scene, only: scene_type
  use gfb_scene_groups, only: read_groups
  use gfb_scene_rules, only: check_groups
  use gfb_sweep_case, only: swept_key_type, swept_keys, sweep_keys
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: read_scene, read_scene_text, scene_at_value, scene_with_key, key_table, all_keys

  character(len=*), parameter :: ending = '.nml'

contains

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

  !> All groups and keys there are, as a Markdown table.
  function key_table() result(table)
    character(len=:), allocatable :: table
    type(case_keys_type) :: keys

    call read_nothing(keys)
    table = keys%book%table()
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
