#include "gfb_petsc.h"
!> Small bearings, cold and with heat, in a state that no symmetry makes easy.
module shaken_bearings
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene_text
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: build_bearing
  use dense_algebra, only: spread_out
  implicit none (type)
  private
  public :: build_shaken, about

  character(len=*), parameter :: lf = new_line('a')
  character(len=*), parameter :: pad = "&scene analysis='equilibrium' /"//lf//'&bearing radius=4e-3 length=6e-3 clearance=3e-5 /'//lf// &
    '&operation speed_rpm=2e5 load=-1,0.5 /'//lf
  character(len=*), parameter :: bumps = &
    '&bump_foil thickness=0.1e-3 youngs_modulus=214e9 poissons_ratio=0.29 half_length=1.778e-3 height=0.508e-3 pitch=4.572e-3 '// &
    "fixed_edge='trailing' bumps=5 /"//lf
  character(len=*), parameter :: beams = "&model foil='beam' /"//lf// &
    "&top_foil thickness=0.11e-3 youngs_modulus=200e9 poissons_ratio=0.28 fixed_edge='leading' /"//lf//bumps// &
    '&contact friction_sleeve=0.2 friction_top=0.3 normal_stiffness=5e10 stick_length=1e-7 /'//lf// &
    '&mesh circumferential_elements=13 axial_elements=4 arc_elements=4 flat_elements=2 align_crests=.false. /'//lf
  character(len=*), parameter :: springs = "&top_foil thickness=0.11e-3 /"//lf//bumps// &
    '&mesh circumferential_elements=13 axial_elements=4 /'//lf//"&model foil='elastic_foundation' foundation_pressure="
  character(len=*), parameter :: cold = '&gas ambient_pressure=1e5 viscosity=1.95e-5 /'//lf
  character(len=*), parameter :: heat = "&gas ambient_pressure=1e5 viscosity_law='sutherland' /"//lf// &
    '&thermal ambient_temperature=293.15 shaft_conductance=0.3 sleeve_conductance=1.0 bump_conductance=190 '// &
    'sleeve_expansion=12e-6 shaft_expansion=12e-6 modulus_slope=-8e-4 /'//lf
  character(len=*), parameter, public :: cold_mean = pad//cold//springs//"'axial_mean' /"//lf
  character(len=*), parameter, public :: cold_local = pad//cold//springs//"'local' /"//lf
  character(len=*), parameter, public :: cold_beams = pad//cold//beams
  character(len=*), parameter, public :: warm_mean = pad//heat//springs//"'axial_mean' /"//lf
  character(len=*), parameter, public :: warm_local = pad//heat//springs//"'local' /"//lf
  character(len=*), parameter, public :: warm_beams = pad//heat//beams

contains

  !> A bearing in a state that no symmetry makes easy; contacts follow.
  subroutine build_shaken(words, bearing)
    character(len=*), intent(in) :: words
    type(bearing_system_type), intent(inout) :: bearing
    type(scene_type) :: scene
    type(error_type), allocatable :: error
    real(wp), allocatable :: unknown(:), number(:)
    logical :: moved
    integer :: i

    call read_scene_text(words, 'a test', scene, error)
    if (allocated(error)) error stop 'a wrong case in a test: '//error%message
    call build_bearing(scene, bearing_plan_type(scene%mesh%circumferential_elements, scene%mesh%axial_elements, .true., floats=.true.), &
                       bearing, error)
    if (allocated(error)) error stop 'a wrong bearing in a test'
    number = about(bearing, 0)
    unknown = number*bearing%unknown_scale
    do i = 1, size(bearing%pad)
      associate (one => bearing%pad(i))
        unknown(one%first + 1:one%first + one%foil%first) = one%film%ambient_pressure*(1.2_wp + 0.4_wp*number(one%first + 1:one%first + one%foil%first))
        unknown(one%first + one%foil%first + 1:one%last) = 2.0e-2_wp*unknown(one%first + one%foil%first + 1:one%last)
      end associate
    end do
    if (bearing%has_slow_unknowns()) unknown(bearing%pad(1)%last + 1:bearing%first_shaft) = 325.0_wp + 20.0_wp*number(bearing%pad(1)%last + 1:bearing%first_shaft)
    unknown(bearing%first_shaft + 1:) = bearing%clearance*[0.2_wp, -0.1_wp]
    call bearing%set_unknowns(unknown)
    do i = 1, 3 ! what slides sticks first
      call bearing%begin_step()
      call bearing%settle(bearing%state, moved)
    end do
  end subroutine build_shaken

  !> Numbers from -1 to 1 at all local unknowns, the same on every rank that has one.
  function about(bearing, seed) result(number)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: seed
    real(wp) :: number(bearing%local_size())
    number = 2.0_wp*spread_out(int(bearing%blocks%global) + 1 + seed) - 1.0_wp
  end function about
end module shaken_bearings
