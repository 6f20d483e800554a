#include "gfb_petsc.h"
!> Bearings of some dozen unknowns at an answer that Newton's method finds from rest.
module small_bearings
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene_text
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: build_bearing
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, create_newton, solve_newton, destroy_newton
  implicit none (type)
  private
  public :: read_bearing, solve_bearing, free_bearing

  character(len=*), parameter :: lf = new_line('a')
  real(wp), parameter, public :: clearance = 31.8e-6_wp !! [m]
  !> Foils of a case: none, springs by their own pressure or by the mean along the axis.
  character(len=*), parameter, public :: foils(3) = [character(len=100) :: &
    "&model foil='rigid' /", &
    "&model foil='elastic_foundation' foundation_stiffness=5e9 foundation_pressure='local' /", &
    "&model foil='elastic_foundation' foundation_stiffness=5e9 foundation_pressure='axial_mean' /"]

contains

  !> A scene of an equilibrium under 20 N, with further groups.
  subroutine read_bearing(words, scene, analysis)
    character(len=*), intent(in) :: words
    type(scene_type), intent(out) :: scene
    character(len=*), intent(in), optional :: analysis !! another one
    type(error_type), allocatable :: error
    character(len=:), allocatable :: asked

    asked = 'equilibrium'
    if (present(analysis)) asked = analysis
    call read_scene_text("&scene analysis='"//asked//"' /"//lf// &
                         '&bearing radius=19.05e-3 length=38.1e-3 clearance=31.8e-6 /'//lf// &
                         '&gas viscosity=1.95e-5 ambient_pressure=1.0135e5 /'//lf// &
                         '&operation speed_rpm=3e4 load=-20,5 /'//lf// &
                         '&mesh circumferential_elements=16 axial_elements=4 /'//lf//words//lf, 'f', scene, error)
    if (allocated(error)) error stop 'the scene of a test is wrong'
  end subroutine read_bearing

  !> Its answer; the shaft is held at a position instead of floating where one is given.
  subroutine solve_bearing(scene, half, bearing, newton, place)
    type(scene_type), intent(in) :: scene
    logical, intent(in) :: half !! of the width is solved
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    real(wp), intent(in), optional :: place(2) !! [m]
    type(newton_report_type) :: report
    type(error_type), allocatable :: error
    real(wp), allocatable :: unknown(:)

    call build_bearing(scene, bearing_plan_type(scene%mesh%circumferential_elements, scene%mesh%axial_elements, half, &
                                                floats=.not. present(place)), bearing, error)
    if (allocated(error)) error stop 'a wrong mesh in a test'
    if (present(place)) bearing%point%place(:2) = place
    allocate (unknown(bearing%local_size()), source=0.0_wp)
    call bearing%put_gas_at_rest(unknown)
    call bearing%set_unknowns(unknown)
    call create_newton(newton, bearing, 'bearing_', newton_settings_type(1.0e-12_wp, 1.0e-12_wp, 60), &
                       run_log_type(.false., .false.))
    call solve_newton(newton, report)
    if (.not. report%converged) error stop 'a test has no answer to begin with'
  end subroutine solve_bearing

  !> Frees both.
  subroutine free_bearing(bearing, newton)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton

    call destroy_newton(newton)
    call bearing%destroy()
  end subroutine free_bearing
end module small_bearings
