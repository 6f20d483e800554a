!> Which keys of a case file a sweep may change, and with what.
module gfb_swept_key_rules
  use gfb_case_keys, only: case_keys_type
  use gfb_foil_mass_words, only: mass_off
  use gfb_model_case, only: meshes_foils, foil_elastic_foundation, foil_word, coupling_partitioned
  use gfb_scene, only: scene_type
  use gfb_listed_keys, only: index_problem
  use gfb_sweep_case, only: swept_key_type, swept_keys, sweep_keys, every_element
  implicit none (type, external)
  private
  public :: check_swept_keys, look_up

  character(len=*), parameter :: word_needed = &
    'needs a parameter that is a word, such as ''load'': '

contains

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
    call check_beside(keys, scene)
    associate (sweep => scene%sweep)
      right = right .and. .not. (sweep%turn_folds .or. sweep%friction_memory)
      right = right .and. .not. sweep%hold_position
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
    if (problem == '') problem = use_problem(keys, scene, key%group, key%name)
    if (problem == '' .and. key%element /= 0) problem = index_problem(keys, key, scene%bump_foil)
  end subroutine look_up

  !> What cannot stand beside keys, because the bearing is built anew for each value.
  subroutine check_beside(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    if (scene%sweep%turn_folds) then
      call keys%complain('sweep', 'turn_folds', word_needed//'a branch is followed by its own '// &
                         'length with the derivative by the parameter, and a key has none')
    end if
    if (scene%sweep%friction_memory) then
      call keys%complain('sweep', 'friction_memory', word_needed//'where a key changes, the '// &
                         'contacts are built anew and have no slip to remember')
    end if
    if (scene%sweep%hold_position) then
      call keys%complain('sweep', 'hold_position', word_needed//'each value of a key makes '// &
                         'another bearing, and the shaft stands elsewhere in it')
    end if
    if (scene%model%coupling == coupling_partitioned) then
      call keys%complain('sweep', 'parameter', "keys need coupling = 'monolithic' in &model: "// &
                         'loops do not start from the answer of a neighbour')
    end if
  end subroutine check_beside

  !> Why a key has no effect on the answers of this scene; empty where it has one.
  function use_problem(keys, scene, group, key) result(problem)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), intent(in) :: group, key !! names in the case file
    character(len=:), allocatable :: problem
    logical :: foils, springs, computed

    foils = meshes_foils(scene%model%foil)
    springs = scene%model%foil == foil_elastic_foundation
    computed = springs .and. .not. keys%meant('model', 'foundation_stiffness')
    problem = ''
    select case (group)
    case ('bearing', 'pads')
      return
    case ('gas')
      if (key == 'viscosity' .and. scene%gas%has_viscosity_law) then
        problem = 'a law or a table gives the viscosity'
      end if
    case ('bore')
      if (.not. scene%bore%present) problem = 'the file has no group &bore'
    case ('operation')
      if (key /= 'speed_rpm') problem = 'it chooses the first answer, the others follow that'
    case ('top_foil')
      if (.not. foils) problem = needs_foils()
    case ('bump_foil')
      if (springs .and. .not. computed) problem = 'foundation_stiffness in &model is given'
      if (computed .and. any(key == ['height', 'width '])) then
        problem = 'the stiffness by Walowit-Anno does not depend on it'
      end if
      if (.not. foils .and. .not. springs) problem = needs_foils()
    case ('contact')
      if (.not. foils) problem = needs_foils()
      if (foils .and. key == 'stick_length' .and. .not. scene%contact%may_rub) then
        problem = 'there is no friction'
      end if
    case ('shaft_contact')
      if (.not. scene%shaft_contact%present) problem = 'the file has no group &shaft_contact'
    case ('rotor')
      if (.not. scene%rotor%present) problem = 'the file has no group &rotor'
    case ('capacity')
      if (scene%capacity%question == 0) problem = 'no limit is looked for'
    case ('dynamics')
      if (.not. scene%dynamics%present) problem = "it needs analysis = 'linear_dynamics'"
    case ('model')
      if (.not. springs) problem = "it needs foil = 'elastic_foundation' in &model"
    case default
      problem = 'it does not belong to the bearing, but to how it is computed'
    end select
    if (key == 'density' .and. scene%dynamics%foil_mass == mass_off) problem = "foil_mass = 'off'"
    if (key == 'density' .and. .not. scene%dynamics%present) problem = 'nothing vibrates'
    if (problem /= '') problem = group//'%'//key//' has no effect here: '//problem

  contains

    !> Says which foils have the key.
    function needs_foils() result(words)
      character(len=:), allocatable :: words
      words = "it needs foil = 'shell' in &model, or 'beam', not '"// &
              foil_word(scene%model%foil)//"'"
    end function needs_foils
  end function use_problem
end module gfb_swept_key_rules
