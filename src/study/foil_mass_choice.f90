!> Whether a foil that moves has its mass: what a scene asks for, and what the log says of it.
module gfb_foil_mass_choice
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type, foil_density
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: frequencies_at, mass_on, mass_off
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type
  use gfb_foil_inertia, only: foil_inertia_type, destroy_inertia
  use gfb_foil_weighing, only: give_mass, give_momentum
  implicit none (type, external)
  private
  public :: choose_mass, choose_momentum, resume_momentum, describe_mass

  integer, parameter :: digits = 4 !! in the log
  real(wp), parameter :: rotors_reach = 1.5_wp !! of rotors' modes, over the speed [1]

contains

  !> Gives the vibrating foil its mass, where the scene asks for it or needs it.
  subroutine choose_mass(scene, bearing, response)
    type(scene_type), intent(in) :: scene !! that vibrates
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    type(dynamic_response_type), intent(inout) :: response !! of it

    call give_mass(bearing, response, mass_wanted(scene), scene%foil_damping%foil_modes, &
                   highest_frequency(scene, bearing%point%speed))
  end subroutine choose_mass

  !> Gives the foils of a bearing at rest their mass over time, where the scene asks for it or
  !> needs it, and says so.
  subroutine choose_momentum(scene, log, bearing)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at rest
    type(foil_inertia_type) :: inertia

    call give_momentum(bearing, mass_wanted(scene), scene%foil_damping%foil_modes, &
                       fastest_motion(scene), inertia)
    if (scene%model%foil%has_top_foil) call describe_mass(scene, log, inertia, .true.)
    call destroy_inertia(inertia)
  end subroutine choose_momentum

  !> Gives them the mass that they had when a restart file was written.
  subroutine resume_momentum(scene, bearing)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(bearing_system_type), intent(inout) :: bearing !! where the file has left it
    type(foil_inertia_type) :: inertia

    call give_momentum(bearing, mass_on, scene%foil_damping%foil_modes, fastest_motion(scene), &
                       inertia)
    call destroy_inertia(inertia)
  end subroutine resume_momentum

  !> What the scene asks for: nothing where a density is missing.
  pure integer function mass_wanted(scene) result(wanted)
    type(scene_type), intent(in) :: scene

    wanted = scene%foil_damping%foil_mass
    if (.not. foil_density(scene) > 0.0_wp) wanted = mass_off
  end function mass_wanted

  !> The highest frequency with which something moves the shaft, or it moves by itself [rad/s].
  pure real(wp) function fastest_motion(scene) result(highest)
    type(scene_type), intent(in) :: scene !! with `&transient`

    associate (transient => scene%transient)
      highest = angular_speed(max(scene%operation%speed_rpm, transient%final_speed_rpm))
      highest = max(rotors_reach*highest, abs(transient%orbit_frequency))
      if (transient%pulse_length > 0.0_wp) highest = max(highest, turn/transient%pulse_length)
    end associate
  end function fastest_motion

  !> The highest frequency that is asked for, with those at which whirl is looked for [rad/s].
  pure real(wp) function highest_frequency(scene, speed) result(highest)
    type(scene_type), intent(in) :: scene !! with its frequencies
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    real(wp), parameter :: reach = 1.2_wp !! of critical masses [1]

    highest = max(maxval(frequencies_at(scene%dynamics, speed)), &
                  merge(rotors_reach, reach, scene%rotor%present)*speed)
  end function highest_frequency

  !> Whether the foil has its mass, and by what that was decided.
  subroutine describe_mass(scene, log, inertia, first)
    type(scene_type), intent(in) :: scene !! that vibrates
    type(run_log_type), intent(in) :: log !! where lines go
    type(foil_inertia_type), intent(in) :: inertia !! of its foil
    logical, intent(in) :: first !! it is the first answer; later ones say what they have judged
    character(len=:), allocatable :: line, lowest, highest, of_foils

    if (.not. scene%model%foil%deflects .or. .not. (first .or. inertia%judged)) return
    lowest = hertz(inertia%lowest)
    highest = hertz(inertia%highest)
    of_foils = 'of the plate'
    if (scene%model%foil%has_bumps) of_foils = 'of top foil and bumps'
    if (.not. scene%model%foil%has_top_foil) then
      line = 'left out'
    else if (scene%foil_damping%foil_mass == mass_off) then
      line = "left out by foil_mass = 'off'"
    else if (.not. foil_density(scene) > 0.0_wp) then
      line = 'left out, for a foil has no density'
    else if (.not. inertia%present) then
      line = 'left out: the foil alone has no natural frequency below '//lowest// &
             ', and motions up to '//highest//', less than a third of it, are asked for'
    else if (inertia%judged) then
      line = of_foils//', for the foil alone has a natural frequency of '//lowest// &
             ', and motions up to '//highest//', more than a third of it, are asked for'
    else
      line = of_foils
    end if
    call log%line('foil mass: '//line)
    if (inertia%present .and. inertia%left_out < 3.0_wp*inertia%highest) then
      call log%line('warning: condensed bumps have modes from '//hertz(inertia%left_out)// &
                    ' on that are left out: more foil_modes keep them')
    end if
  end subroutine describe_mass

  !> A frequency in words.
  function hertz(frequency) result(words)
    real(wp), intent(in) :: frequency !! [rad/s]
    character(len=:), allocatable :: words
    words = text(frequency/turn, digits)//' Hz'
  end function hertz
end module gfb_foil_mass_choice
