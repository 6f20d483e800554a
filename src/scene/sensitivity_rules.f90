!> By which keys of a case file an answer can be derived.
module gfb_sensitivity_rules
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: coupling_partitioned
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_sensitivity_case, only: parameter_type
  use gfb_sweep_case, only: swept_key_type, named_keys
  use gfb_swept_key_rules, only: use_problem
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
    integer :: i, k

    associate (asked => scene%sensitivity)
      allocate (asked%parameter(0))
      if (.not. asked%present) return
      list = named_keys(asked%names)
      if (asked%names == '') list = list(:0)
      do i = 1, size(list)
        call add_parameter(keys, scene, list(i), problem)
        do k = 1, i - 1
          if (full_name(list(k)) /= full_name(list(i))) cycle
          problem = full_name(list(i))//' is given twice'
        end do
        if (problem == '') cycle
        if (asked%strings == size(list)) then
          call keys%complain(group, parameters, problem, i)
        else
          call keys%complain(group, parameters, problem)
        end if
      end do
      if (size(asked%tolerances) > 0 .and. size(asked%tolerances) /= size(list)) then
        call keys%complain(group, 'tolerances', 'must have one value a parameter: '// &
                           text(size(list))//', not '//text(size(asked%tolerances)))
      else if (size(asked%tolerances) == size(asked%parameter)) then
        asked%parameter%tolerance = asked%tolerances
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

  !> Adds a parameter with its unit and value.
  subroutine add_parameter(keys, scene, key, problem)
    type(case_keys_type), intent(in) :: keys
    type(scene_type), intent(inout) :: scene
    type(swept_key_type), intent(in) :: key
    character(len=:), allocatable, intent(out) :: problem !! empty where it can be one
    type(parameter_type) :: one

    one%group = key%group
    one%name = key%name
    if (key%group == 'operation' .and. key%name == 'load') then
      one%unit = 'N'
      one%value = norm2(scene%operation%load)
      problem = ''
      if (scene%general%analysis /= analysis_equilibrium) then
        problem = 'operation%load has no effect here: the position is given'
      end if
    else
      call keys%book%look_up_real(key%group, key%name, one%unit, problem)
      if (problem == '') problem = use_problem(keys, scene, key%group, key%name)
      if (problem == '') one%value = value_of(keys, key)
    end if
    if (problem == '' .and. .not. abs(one%value) > 0.0_wp) then
      problem = full_name(key)//' is 0: it has no size by which it could change'
    end if
    associate (asked => scene%sensitivity)
      if (problem == '') asked%parameter = [asked%parameter, one]
    end associate
  end subroutine add_parameter

  !> A key's group and name.
  pure function full_name(key) result(name)
    type(swept_key_type), intent(in) :: key
    character(len=:), allocatable :: name
    name = key%group//'%'//key%name
  end function full_name

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
