!> By which keys of a case file an answer can be derived.
module gfb_sensitivity_rules
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: coupling_partitioned
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_sensitivity_case, only: parameter_type
  use gfb_listed_keys, only: list_values, is_gap
  use gfb_sweep_case, only: swept_key_type, named_keys, every_element
  use gfb_swept_key_rules, only: look_up
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_sensitivity

  character(len=*), parameter :: group = 'sensitivity', parameters = 'parameters'

contains

  !> Looks the keys up, notes units and values, and complains about those that no answer follows.
  subroutine check_sensitivity(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, all read
    type(scene_type), intent(inout) :: scene !! gets the parameters
    type(swept_key_type), allocatable :: list(:)
    character(len=:), allocatable :: problem
    real(wp) :: tolerance
    integer :: i, k
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
        call add_parameter(keys, scene, list(i), tolerance, problem)
        do k = 1, i - 1
          if (.not. is_same(list(k), list(i))) cycle
          problem = list(i)%label()//' is given twice'
        end do
        if (problem == '') cycle
        if (asked%strings == size(list)) then
          call keys%complain(group, parameters, problem, i)
        else
          call keys%complain(group, parameters, problem)
        end if
      end do
      if (size(asked%tolerances) > 0 .and. .not. tolerated) then
        call keys%complain(group, 'tolerances', 'must have one value a parameter: '// &
                           text(size(list))//', not '//text(size(asked%tolerances)))
      end if
    end associate
    call check_beside(keys, scene)
  end subroutine check_sensitivity

  !> What answers rest on what was before: their derivatives would have to be carried along.
  subroutine check_beside(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    if (scene%sweep%friction_memory) then
      call keys%complain('sweep', 'friction_memory', 'cannot stand beside &sensitivity: slip '// &
                         'that is carried along depends on the parameters at all points before')
    end if
    if (scene%sweep%hold_position) then
      call keys%complain('sweep', 'hold_position', 'cannot stand beside &sensitivity: the '// &
                         'position that is held depends on the parameters, too')
    end if
    if (scene%sweep%turn_folds) then
      call keys%complain('sweep', 'turn_folds', 'cannot stand beside &sensitivity: at a fold '// &
                         'there is no derivative')
    end if
    if (scene%model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' beside &sensitivity")
    end if
    if (scene%accuracy%present) then
      call keys%complain(group, parameters, 'cannot stand beside &accuracy: its meshes '// &
                         'change, and with them the nodes of smallest and largest values')
    end if
    if (scene%sample%present) then
      call keys%complain(group, parameters, 'cannot stand beside &sample: derive one member '// &
                         'by its seed')
    end if
  end subroutine check_beside

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
      if (scene%general%analysis /= analysis_equilibrium) then
        problem = 'operation%load has no effect here: the position is given'
      end if
    else
      call look_up(keys, scene, key, one%unit, problem)
      if (problem /= '') return
      if (key%element == 0) then
        value = [value_of(keys, key)]
      else
        value = list_values(keys, key, scene%bump_foil)
      end if
    end if
    do i = 1, size(value)
      if (key%element > 0 .and. key%element /= i) cycle
      if (key%element /= 0) one%key%element = i
      one%value = value(i)
      if (problem == '' .and. .not. (abs(one%value) > 0.0_wp .or. is_gap(key))) then
        problem = one%key%label()//' is 0: it has no size by which it could change'
      end if
      if (problem == '') scene%sensitivity%parameter = [scene%sensitivity%parameter, one]
    end do
  end subroutine add_parameter

  !> Whether two names mean the same key, or one a value of the other.
  pure function is_same(one, other) result(same)
    type(swept_key_type), intent(in) :: one, other
    logical :: same

    same = one%group == other%group .and. one%name == other%name .and. &
           (one%element == other%element .or. &
            any([one%element, other%element] == every_element))
  end function is_same

  !> Value of a real key, given or by default; 0 where it has none.
  function value_of(keys, key) result(value)
    type(case_keys_type), intent(in) :: keys
    type(swept_key_type), intent(in) :: key
    real(wp) :: value !! [its unit]
    integer :: i, status

    value = 0.0_wp
    do i = 1, keys%notes%count
      associate (met => keys%notes%met(i))
        if (met%group /= key%group .or. met%key%name /= key%name) cycle
        read (met%value, *, iostat=status) value
        if (status /= 0) value = 0.0_wp
      end associate
    end do
  end function value_of
end module gfb_sensitivity_rules
