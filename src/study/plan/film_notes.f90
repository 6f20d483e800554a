!> What the log says of a film's bore and gas at its answer.
module gfb_film_notes
  use gfb_kinds, only: wp
  use gfb_aligned_mesh, only: kinks_inside
  use gfb_bearing_case, only: pad_turn
  use gfb_bore_profile, only: bore_kinks, bore_peak
  use gfb_film_mesh, only: film_mesh_type
  use gfb_gas_law, only: gas_law_type, density_table
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_keys
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: show_film_notes

  real(wp), parameter :: thin = 10.0e-6_wp       !! gap below which slip may matter [m]
  real(wp), parameter :: air_path = 0.066e-6_wp  !! mean free path of air at one atmosphere [m]
  real(wp), parameter :: atmosphere = 101325.0_wp !! [Pa]
  real(wp), parameter :: laminar = 2000.0_wp     !! Reynolds number up to which films may be [1]

contains

  !> Tells what the bore means for the mesh, and what of the gas is left out or left its range.
  subroutine show_film_notes(scene, law, mesh, speed, minimum_gap, pressure, log)
    type(scene_type), intent(in) :: scene !! of a bearing
    type(gas_law_type), intent(in) :: law !! of its gas, which a sweep may have changed
    type(film_mesh_type), intent(in) :: mesh !! of its film
    real(wp), intent(in) :: speed       !! of the shaft [rad/s]
    real(wp), intent(in) :: minimum_gap !! of the answer [m]
    real(wp), intent(in) :: pressure(2) !! smallest and largest of the answer [Pa]
    type(run_log_type), intent(in) :: log !! where lines go

    if (scene%bore%present .and. scene%sweep%parameter /= sweep_keys) then
      call show_bore(scene, mesh, log)
    end if
    call show_slip(law, minimum_gap, log)
    call show_turbulence(law, speed*scene%bearing%radius*scene%bearing%clearance, log)
    if (pressure(2) > law%fluid%saturation) then
      call log%warning('the pressure exceeds '//text(law%fluid%saturation, 4)//' Pa, at which '// &
                       'the gas condenses: that is not modelled')
    end if
    if (law%density == density_table) then
      associate (table => law%density_curve%place)
        if (pressure(1) >= table(1) .and. pressure(2) <= table(size(table))) return
        call log%warning('the pressure leaves the table of the gas, '//text(table(1))//' to '// &
                         text(table(size(table)))//' Pa: beyond its ends density and '// &
                         'viscosity are extrapolated')
      end associate
    end if
  end subroutine show_film_notes

  !> How much slip would matter where it is left out: the flow grows by 6 lambda/h.
  subroutine show_slip(law, minimum_gap, log)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: minimum_gap !! [m]
    type(run_log_type), intent(in) :: log
    real(wp) :: more

    if (law%mean_free_path > 0.0_wp .or. .not. minimum_gap > 0.0_wp) return
    if (minimum_gap > thin) return
    more = 6.0_wp*air_path*(atmosphere/law%ambient_pressure)/minimum_gap
    call log%line('slip             not modelled; in air it would raise the flow through the '// &
                  'smallest gap by '//text(100.0_wp*more, 2)//' % (mean_free_path in &gas)')
  end subroutine show_slip

  !> The film's Reynolds number, where the density is known.
  subroutine show_turbulence(law, speed_and_gap, log)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: speed_and_gap !! of the surface, times the clearance [m2/s]
    type(run_log_type), intent(in) :: log
    real(wp) :: number

    number = law%ambient_density*speed_and_gap/law%viscosity
    if (law%turbulent) then
      call log%line('turbulence       Reynolds number '//text(number, 3)// &
                    ' over the clearance, at ambient pressure')
    else if (number > laminar) then
      call log%warning('the Reynolds number over the clearance is '//text(number, 3)// &
                       ": such a film is turbulent; turbulence = 'ng_pan' in &gas models it")
    end if
  end subroutine show_turbulence

  !> Height of the bore, and where its kinks lie.
  subroutine show_bore(scene, mesh, log)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: mesh
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words
    integer :: on_pad, inside, i

    associate (profile => scene%bore%profile)
      words = 'bore             up to '//text(bore_peak(profile)*1.0e6_wp, 4)// &
              ' um over the circle, '//text(bore_peak(profile)/scene%bearing%clearance, 3)// &
              ' of the clearance'
      call kinks_inside(mesh, bore_kinks(profile, &
                                         pad_turn(scene%bearing, [(i, i=1, scene%bearing%pads)])), &
                        on_pad, inside)
    end associate
    if (on_pad > 0 .and. inside == 0) then
      words = words//'; sides of elements on all '//text(on_pad)//' kinks'
    else if (on_pad > 0) then
      words = words//'; '//text(inside)//' of '//text(on_pad)//' kinks lie inside elements: '// &
              'the error that they leave shrinks with the square of an element''s length'
    end if
    call log%line(words)
  end subroutine show_bore
end module gfb_film_notes
