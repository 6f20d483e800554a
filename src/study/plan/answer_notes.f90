!> What the log says of an answer's film, and of the numbers of its contacts' laws.
!>
!> The limits are those of measured errors: docs/manual/accuracy.md has the series.
module gfb_answer_notes
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_contact_case, only: contact_case_type
  use gfb_contact_measures, only: contact_measures_type
  use gfb_contact_law, only: law_coulomb
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_aligned_mesh, only: kinks_inside
  use gfb_bearing_case, only: pad_turn
  use gfb_gap_shape, only: gap_shape_item_type, kinks_of
  use gfb_gap_shapes, only: find_shapes, peak_of
  use gfb_film_mesh, only: film_mesh_type
  use gfb_gas_law, only: gas_law_type, density_table
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_keys
  implicit none (type, external)
  private
  public :: show_contact_notes, show_loop_note, show_film_notes

  !> Penetration over the deflection that is worth a warning, and the one aimed at [1].
  real(wp), parameter :: soft = 0.01_wp, hard = 1.0e-3_wp
  !> Way along which friction has not come up, over the deflection: the same two [1].
  real(wp), parameter :: smooth = 1.0e-3_wp, sharp = 1.0e-4_wp
  !> Energy that a loop lacks, over that which it has: the same two [1].
  real(wp), parameter :: lossless = 0.02_wp, full = 0.005_wp
  !> The same by stick length over slip, as measured [1].
  real(wp), parameter :: lacking_tanh = 15.0_wp, lacking_coulomb = 4.0_wp

  real(wp), parameter :: thin = 10.0e-6_wp       !! gap below which slip may matter [m]
  real(wp), parameter :: air_path = 0.066e-6_wp  !! mean free path of air at one atmosphere [m]
  real(wp), parameter :: atmosphere = 101325.0_wp !! [Pa]
  real(wp), parameter :: laminar = 2000.0_wp     !! Reynolds number up to which films may be [1]

contains

  !> Warns of contacts so soft, or of a stick length so long, that they show in the answer.
  subroutine show_contact_notes(log, contact, measures, deflection)
    type(run_log_type), intent(in) :: log !! where lines go
    type(contact_case_type), intent(in) :: contact !! what `&contact` asks for
    type(contact_measures_type), intent(in) :: measures !! of the contacts at the answer
    real(wp), intent(in) :: deflection !! of the foil, or way of the plate that presses it [m]
    real(wp) :: stiffer

    if (.not. deflection > 0.0_wp) return
    associate (penetration => measures%penetration, lacking => measures%lacking, &
               stick => contact%stick_length)
      if (penetration > soft*deflection) then
        stiffer = contact%normal_stiffness*(penetration/(hard*deflection))**contact%exponent
        call log%warning('contacts penetrate by up to '//text(penetration*micrometres, 3)// &
                         ' um, '//text(100.0_wp*penetration/deflection, 3)// &
                         ' % of the deflection of '//text(deflection*micrometres, 4)// &
                         ' um: normal_stiffness = '//text(contact%normal_stiffness)// &
                         ' in &contact is too small for the foil; '// &
                         text(power_of_ten(stiffer))//' does not show')
      end if
      if (lacking > smooth*deflection) then
        call log%warning('contacts slide along up to '//text(measures%slip*micrometres, 3)// &
                         ' um, and stick_length = '//text(stick)//' m in &contact is too long '// &
                         'for that: friction comes up so late that the answer is off by some '// &
                         'times '//text(100.0_wp*lacking/deflection, 2)//' %; '// &
                         text(stick*sharp*deflection/lacking, 1)//' m does not show')
      end if
    end associate
  end subroutine show_contact_notes

  !> Warns of a stick length that takes a part of the energy that a loop of loading and unloading
  !> dissipates.
  subroutine show_loop_note(log, contact, slip)
    type(run_log_type), intent(in) :: log !! where lines go
    type(contact_case_type), intent(in) :: contact !! what `&contact` asks for
    real(wp), intent(in) :: slip !! largest of the loop [m]
    real(wp) :: lacking

    if (.not. slip > 0.0_wp) return
    lacking = merge(lacking_coulomb, lacking_tanh, contact%friction_law == law_coulomb)* &
              contact%stick_length/slip
    if (.not. lacking > lossless) return
    call log%warning('stick_length = '//text(contact%stick_length)//' m in &contact is '// &
                     text(100.0_wp*contact%stick_length/slip, 2)//' % of the longest slip, '// &
                     text(slip*micrometres, 3)//' um: about '// &
                     text(100.0_wp*min(1.0_wp, lacking), 1)//' % of the energy that the loop '// &
                     'dissipates are lacking; '// &
                     text(contact%stick_length*full/lacking, 1)//' m does not show')
  end subroutine show_loop_note

  !> The next power of ten.
  pure real(wp) function power_of_ten(number) result(round)
    real(wp), intent(in) :: number !! positive
    round = 10.0_wp**ceiling(log10(number))
  end function power_of_ten

  !> Says what the bore means for the mesh, and what of the gas is left out or left its range.
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
    type(gap_shape_item_type), allocatable :: shape(:)
    integer :: on_pad, inside, i

    associate (bearing => scene%bearing)
      call find_shapes(bearing, scene%bore, bearing%leading_edge_angle, 1.0_wp, shape)
      words = 'bore             up to '//text(peak_of(shape)*1.0e6_wp, 4)//' um over the '// &
              trim(bearing%row%no_bore)//', '// &
              text(peak_of(shape)/bearing%clearance, 3)//' of the '// &
              trim(bearing%row%gap_size)
      call kinks_inside(mesh, kinks_of(shape, 0.0_wp, pad_turn(bearing, &
                                                               [(i, i=1, bearing%pads)])), &
                        on_pad, inside)
    end associate
    if (on_pad > 0 .and. inside == 0) then
      words = words//'; sides of elements on all '//text(on_pad)//' kinks'
    else if (on_pad > 0) then
      words = words//'; '//text(inside)//' of '//text(on_pad)//' kinks lie inside elements, '// &
              'which take the bore there in the mean: the error that they leave shrinks with '// &
              'the square of an element''s length'
    end if
    call log%line(words)
  end subroutine show_bore
end module gfb_answer_notes
