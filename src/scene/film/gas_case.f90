!> `&gas`: the gas in the film.
module gfb_gas_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_scene_case, only: is_bearing, misplaced_group
  use gfb_value_rules, only: positive
  implicit none (type, external)
  private
  public :: gas_case_type, read_gas_case

  !> The gas, ideal and of constant temperature.
  type :: gas_case_type
    real(wp) :: viscosity = 0.0_wp         !! dynamic [Pa s]
    real(wp) :: ambient_pressure = 0.0_wp  !! absolute [Pa]
  end type gas_case_type

contains

  !> Reads the group.
  subroutine read_gas_case(keys, gas, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(gas_case_type), intent(out) :: gas !! what `&gas` asks for
    integer, intent(in) :: analysis !! 0 where it is not known
    logical :: needed

    needed = is_bearing(analysis)
    call keys%start_group('gas', required=needed, optional=.not. needed, &
                          misplaced=misplaced_group(analysis, needed))
    call keys%real_key('viscosity', gas%viscosity, 'Pa s', 'dynamic viscosity', positive, needed)
    call keys%real_key('ambient_pressure', gas%ambient_pressure, 'Pa', &
                       'absolute pressure at the edges of the pad', positive, needed)
    call keys%finish_group()
  end subroutine read_gas_case
end module gfb_gas_case
