!> Keys of the Maxwell arm beside the springs of an elastic foundation, in each group of what moves.
module gfb_maxwell_keys
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_value_rules, only: positive
  implicit none (type, external)
  private
  public :: read_maxwell_keys, check_maxwell_keys

  character(len=*), parameter :: stiffness = 'maxwell_stiffness', time = 'maxwell_time'

contains

  !> Reads both keys.
  subroutine read_maxwell_keys(keys, arm)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, in the group
    type(maxwell_arm_type), intent(inout) :: arm !! what they ask for

    call keys%real_key(stiffness, arm%stiffness, 'N/m^3', 'spring of the Maxwell arm, a spring '// &
                       'and a dashpot in series beside each spring of the elastic foundation', &
                       positive, default=no_default)
    call keys%real_key(time, arm%time, 's', 'relaxation time of that arm: its dashpot over '// &
                       'its spring', positive, default=no_default)
  end subroutine read_maxwell_keys

  !> Both or none, and springs for the arm to stand beside.
  subroutine check_maxwell_keys(keys, group, rests)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: group !! that may have them
    logical, intent(in) :: rests !! the foil rests on springs, or is not known

    call check_key(stiffness, time)
    call check_key(time, stiffness)

  contains

    subroutine check_key(name, other)
      character(len=*), intent(in) :: name, other

      if (.not. keys%meant(group, name)) return
      if (.not. keys%meant(group, other)) then
        call keys%complain(group, name, 'needs '//other//' beside it')
      end if
      if (rests) return
      call keys%complain(group, name, "needs foil = 'elastic_foundation' in &model")
    end subroutine check_key
  end subroutine check_maxwell_keys
end module gfb_maxwell_keys
