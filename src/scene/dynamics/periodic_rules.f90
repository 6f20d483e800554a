!> What a scene must have, and cannot have, where orbits that close are looked for.
module gfb_periodic_rules
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_maxwell_keys, only: check_maxwell_keys
  use gfb_model_case, only: model_case_type, coupling_partitioned, foil_elastic_foundation, &
    meshes_foils
  use gfb_operation_case, only: operation_case_type
  use gfb_periodic_case, only: periodic_case_type, motion_free, follow_nothing, follow_speed, &
    follow_unbalance, follow_mass
  use gfb_rotor_case, only: rotor_case_type
  implicit none (type, external)
  private
  public :: check_periodic

  character(len=*), parameter :: group = 'periodic'
  character(len=*), parameter :: useless = "has no use with analysis = 'periodic'"

contains

  !> Checks a scene with `&periodic`.
  subroutine check_periodic(keys, periodic, operation, rotor, model, may_rub)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(periodic_case_type), intent(in) :: periodic !! what `&periodic` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(rotor_case_type), intent(in) :: rotor !! what `&rotor` says
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    logical, intent(in) :: may_rub !! a friction coefficient of `&contact` is positive

    if (.not. periodic%present) return
    if (keys%meant('operation', 'speed_rpm') .and. .not. operation%speed_rpm > 0.0_wp) then
      call keys%complain('operation', 'speed_rpm', "must be positive with analysis = 'periodic'")
    end if
    if (.not. rotor%present) then
      call keys%complain('scene', 'analysis', "'periodic' needs the mass of the shaft, in &rotor")
    else if (keys%meant('rotor', 'bearing_distance')) then
      call keys%complain('rotor', 'bearing_distance', useless//': the shaft moves in x and y alone')
    end if
    call check_motion(keys, periodic)
    call check_branch(keys, periodic, operation, rotor)
    call check_foil(keys, periodic, model, may_rub)
    call check_other_groups(keys)
  end subroutine check_periodic

  !> A forced motion has its unbalance, a free one none.
  subroutine check_motion(keys, periodic)
    type(case_keys_type), intent(inout) :: keys
    type(periodic_case_type), intent(in) :: periodic

    if (periodic%motion == motion_free) then
      call refuse(keys, 'unbalance', "has no use with motion = 'free'")
      call refuse(keys, 'unbalance_angle', "has no use with motion = 'free'")
      call refuse(keys, 'period_turns', "has no use with motion = 'free'")
      call refuse(keys, 'start_turns', "has no use with motion = 'free'")
      if (periodic%parameter /= 0 .and. all(periodic%parameter /= [follow_speed, follow_mass])) then
        call keys%complain(group, 'parameter', "must be 'speed_rpm' or 'mass' with "// &
                           "motion = 'free': the limit cycles are followed from the onset "// &
                           'of whirl on')
      end if
    else
      call refuse(keys, 'first_amplitude', "needs motion = 'free'")
      if (.not. keys%meant(group, 'unbalance') .and. periodic%parameter /= follow_unbalance) then
        call keys%complain(group, 'unbalance', "must be given with motion = 'forced'")
      end if
    end if
  end subroutine check_motion

  !> A branch has an end, which is not its beginning.
  subroutine check_branch(keys, periodic, operation, rotor)
    type(case_keys_type), intent(inout) :: keys
    type(periodic_case_type), intent(in) :: periodic
    type(operation_case_type), intent(in) :: operation
    type(rotor_case_type), intent(in) :: rotor
    real(wp) :: begin

    if (periodic%parameter == follow_nothing) then
      call refuse(keys, 'final_value', "needs a parameter other than 'none'")
      call refuse(keys, 'points', "needs a parameter other than 'none'")
      call refuse(keys, 'step', "needs a parameter other than 'none'")
      return
    end if
    if (.not. keys%meant(group, 'final_value')) then
      call keys%complain(group, 'final_value', 'must be given with parameter')
      return
    end if
    begin = operation%speed_rpm
    if (periodic%parameter == follow_unbalance) begin = periodic%unbalance
    if (periodic%parameter == follow_mass) begin = rotor%mass
    if (.not. abs(periodic%final_value - begin) > 0.0_wp) then
      call keys%complain(group, 'final_value', 'must differ from where the parameter begins')
    else if (periodic%parameter /= follow_unbalance .and. .not. periodic%final_value > 0.0_wp) then
      call keys%complain(group, 'final_value', 'must be positive')
    end if
  end subroutine check_branch

  !> What the foil must be.
  subroutine check_foil(keys, periodic, model, may_rub)
    type(case_keys_type), intent(inout) :: keys
    type(periodic_case_type), intent(in) :: periodic
    type(model_case_type), intent(in) :: model
    logical, intent(in) :: may_rub

    if (periodic%foundation_damping > 0.0_wp .and. model%foil /= foil_elastic_foundation) then
      call keys%complain(group, 'foundation_damping', "needs foil = 'elastic_foundation' in &model")
    end if
    call check_maxwell_keys(keys, group, any(model%foil == [0, foil_elastic_foundation]))
    if (meshes_foils(model%foil) .and. may_rub .and. &
        (periodic%motion == motion_free .or. periodic%parameter /= follow_nothing)) then
      call keys%complain('model', 'foil', 'needs friction_top and friction_sleeve of 0 with '// &
                         "motion = 'free', and with parameter: where contacts stick, orbits "// &
                         'lie side by side, and are no branch')
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' with analysis = "// &
                         "'periodic': film, foil and shaft take their steps together")
    end if
  end subroutine check_foil

  !> What cannot stand beside `&periodic`.
  subroutine check_other_groups(keys)
    type(case_keys_type), intent(inout) :: keys

    if (keys%meant('sweep', 'parameter')) then
      call keys%complain('sweep', 'parameter', &
        useless//': parameter in &periodic follows the orbits')
    end if
    if (keys%meant('accuracy', 'quantity')) call keys%complain('accuracy', 'quantity', useless)
    if (keys%meant('sample', 'count')) call keys%complain('sample', 'count', useless)
    if (keys%meant('sensitivity', 'quantity')) then
      call keys%complain('sensitivity', 'quantity', useless)
    end if
    if (keys%meant('output', 'restart_every')) then
      call keys%complain('output', 'restart_every', useless)
    end if
  end subroutine check_other_groups

  !> Complains about a key that is given.
  subroutine refuse(keys, name, words)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, words

    if (keys%meant(group, name)) call keys%complain(group, name, words)
  end subroutine refuse
end module gfb_periodic_rules
