!> What the log says of an answer that the numbers of the contacts' laws have a part in.
!>
!> The limits are those of measured errors: docs/manual/accuracy.md has the series.
module gfb_contact_notes
  use gfb_kinds, only: wp
  use gfb_contact_case, only: contact_case_type
  use gfb_contact_measures, only: contact_measures_type
  use gfb_contact_law, only: law_coulomb
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: show_contact_notes, show_loop_note

  !> Penetration over the deflection that is worth a warning, and the one aimed at [1].
  real(wp), parameter :: soft = 0.01_wp, hard = 1.0e-3_wp
  !> Way along which friction has not come up, over the deflection: the same two [1].
  real(wp), parameter :: smooth = 1.0e-3_wp, sharp = 1.0e-4_wp
  !> Energy that a loop lacks, over that which it has: the same two [1].
  real(wp), parameter :: lossless = 0.02_wp, full = 0.005_wp
  !> The same by stick length over slip, as measured [1].
  real(wp), parameter :: lacking_tanh = 15.0_wp, lacking_coulomb = 4.0_wp
  real(wp), parameter :: micrometres = 1.0e6_wp !! in a metre

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
        call log%warning('contacts give way by up to '//text(penetration*micrometres, 3)// &
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
  pure function power_of_ten(number) result(round)
    real(wp), intent(in) :: number !! positive
    real(wp) :: round
    round = 10.0_wp**ceiling(log10(number))
  end function power_of_ten
end module gfb_contact_notes
