!> Whether a foil that vibrates has its mass: what a scene asks for, and what the log says of it.
module gfb_foil_mass_choice
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_rigid, meshes_foils
  use gfb_dynamics_case, only: mass_off, frequencies_at
  use gfb_foil_mass_case, only: has_densities
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type
  use gfb_foil_inertia, only: foil_inertia_type
  use gfb_foil_weighing, only: give_mass
  implicit none (type, external)
  private
  public :: choose_mass, describe_mass

  integer, parameter :: digits = 4 !! in the log

contains

  !> Gives the vibrating foil its mass, where the scene asks for it or needs it.
  subroutine choose_mass(scene, bearing, response)
    type(scene_type), intent(in) :: scene !! that vibrates
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    type(dynamic_response_type), intent(inout) :: response !! of it

    call give_mass(bearing, response, mass_wanted(scene), scene%dynamics%foil_modes, &
                   highest_frequency(scene, bearing%point%speed))
  end subroutine choose_mass

  !> What the scene asks for: nothing where a density is missing.
  pure function mass_wanted(scene) result(wanted)
    type(scene_type), intent(in) :: scene
    integer :: wanted

    wanted = scene%dynamics%foil_mass
    if (.not. has_densities(scene%top_foil, scene%bump_foil)) wanted = mass_off
  end function mass_wanted

  !> The highest frequency that is asked for, with those at which whirl is looked for [rad/s].
  pure function highest_frequency(scene, speed) result(highest)
    type(scene_type), intent(in) :: scene !! with its frequencies
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    real(wp) :: highest
    real(wp), parameter :: reach(2) = [1.2_wp, 1.5_wp] !! of critical masses, of rotors' modes [1]

    highest = max(maxval(frequencies_at(scene%dynamics, speed)), &
                  merge(reach(2), reach(1), scene%rotor%present)*speed)
  end function highest_frequency

  !> Whether the foil has its mass, and by what that was decided.
  subroutine describe_mass(scene, log, inertia, first)
    type(scene_type), intent(in) :: scene !! that vibrates
    type(run_log_type), intent(in) :: log !! where lines go
    type(foil_inertia_type), intent(in) :: inertia !! of its foil
    logical, intent(in) :: first !! it is the first answer; later ones say what they have judged
    character(len=:), allocatable :: line, lowest, highest

    if (scene%model%foil == foil_rigid .or. .not. (first .or. inertia%judged)) return
    lowest = hertz(inertia%lowest)
    highest = hertz(inertia%highest)
    if (.not. meshes_foils(scene%model%foil)) then
      line = 'left out'
    else if (scene%dynamics%foil_mass == mass_off) then
      line = "left out by foil_mass = 'off'"
    else if (.not. has_densities(scene%top_foil, scene%bump_foil)) then
      line = 'left out, for a foil has no density'
    else if (.not. inertia%present) then
      line = 'left out: the foil alone has no natural frequency below '//lowest// &
             ', and motions up to '//highest//', less than a third of it, are asked for'
    else if (inertia%judged) then
      line = 'of top foil and bumps, for the foil alone has a natural frequency of '//lowest// &
             ', and motions up to '//highest//', more than a third of it, are asked for'
    else
      line = 'of top foil and bumps'
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
    real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
    words = text(frequency/turn, digits)//' Hz'
  end function hertz
end module gfb_foil_mass_choice
