!> The numbers without unit that a bearing's state depends on, for the log.
module gfb_scene_numbers
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type
  use gfb_foundation_foil, only: foundation_stiffness
  use gfb_gas_case, only: gas_case_type
  use gfb_model_case, only: foil_elastic_foundation, meshes_foils
  use gfb_operation_case, only: angular_speed
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_strip_load_case, only: bump_stiffness
  use gfb_sweep_case, only: sweep_load, sweep_speed
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: show_numbers

  integer, parameter :: digits = 3 !! shown

contains

  !> Bearing number, load, clearance and stiffness of the bumps, as far as the scene has them.
  subroutine show_numbers(scene, log)
    type(scene_type), intent(in) :: scene !! of a bearing
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp) :: stiffness !! of the bumps [N/m^3]
    real(wp) :: p_a, area !! [Pa], D L [m^2]

    p_a = scene%gas%ambient_pressure
    area = 2.0_wp*scene%bearing%radius*scene%bearing%length
    call log%line('numbers without unit:')
    call log%line('  clearance over radius C/R: '// &
                  text(scene%bearing%clearance/scene%bearing%radius, digits))
    call log%line('  bearing number 6 mu Omega/p_a (R/C)^2: '// &
                  spread_text(scene, sweep_speed, scene%operation%speed_rpm, &
                              bearing_number(scene%bearing, scene%gas, 1.0_wp)))
    if (scene%general%analysis == analysis_equilibrium) then
      call log%line('  load over p_a D L: '// &
                    spread_text(scene, sweep_load, norm2(scene%operation%load), 1.0_wp/(p_a*area)))
    end if
    stiffness = 0.0_wp
    if (scene%model%foil == foil_elastic_foundation) then
      stiffness = foundation_stiffness(scene%model, scene%bump_foil)
    else if (meshes_foils(scene%model%foil)) then
      stiffness = bump_stiffness(scene%bump_foil)
    end if
    if (stiffness > 0.0_wp) then
      call log%line('  bump stiffness times C over p_a: '// &
                    text(stiffness*scene%bearing%clearance/p_a, digits))
    end if
  end subroutine show_numbers

  !> Bearing number 6 mu Omega / p_a (R / C)^2 [1].
  elemental function bearing_number(bearing, gas, speed_rpm) result(number)
    type(bearing_case_type), intent(in) :: bearing !! the pad
    type(gas_case_type), intent(in) :: gas !! its gas
    real(wp), intent(in) :: speed_rpm !! of the shaft [rpm]
    real(wp) :: number

    number = 6.0_wp*gas%viscosity*angular_speed(speed_rpm)/gas%ambient_pressure* &
             (bearing%radius/bearing%clearance)**2
  end function bearing_number

  !> A number in proportion to what a sweep may change: one value, or the range of the sweep.
  function spread_text(scene, parameter, value, factor) result(words)
    type(scene_type), intent(in) :: scene
    integer, intent(in) :: parameter !! of the sweep that changes it
    real(wp), intent(in) :: value    !! without such a sweep [its unit]
    real(wp), intent(in) :: factor   !! number over value [1/its unit]
    character(len=:), allocatable :: words

    words = text(factor*value, digits)
    if (.not. scene%sweep%present .or. scene%sweep%parameter /= parameter) return
    words = text(factor*minval(scene%sweep%values), digits)//' to '// &
            text(factor*maxval(scene%sweep%values), digits)
  end function spread_text
end module gfb_scene_numbers
