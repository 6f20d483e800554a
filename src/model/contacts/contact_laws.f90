!> The laws of a scene's contacts: stiffness, friction, and artificial stiffness of the matrix.
module gfb_contact_laws
  use gfb_kinds, only: wp
  use gfb_contact_case, only: contact_case_type, direction_motion, surface_face, motion_coulomb
  use gfb_foil_cases, only: bump_foil_case_type
  use gfb_strip_load_case, only: bump_stiffness
  use gfb_contact_law, only: contact_law_type
  use gfb_contact_set, only: contact_set_type
  use gfb_bump_contacts, only: contact_sleeve, contact_top
  implicit none (type, external)
  private
  public :: set_contact_laws

  real(wp), parameter :: first_penetration = 1.0e-4_wp !! that counts, over a typical displacement
  !> Artificial stiffness of slaves, in the matrix alone, over a bump's, so that a floating foil
  !> leaves it regular.
  real(wp), parameter :: normal_share = 1.0e-7_wp

contains

  !> Sets what sleeve and top are to the bumps, which surfaces touch, and what artificial
  !> stiffness the contacts have in the matrix.
  subroutine set_contact_laws(contact, foil, displacement, contacts)
    type(contact_case_type), intent(in) :: contact !! what `&contact` asks for
    type(bump_foil_case_type), intent(in) :: foil  !! what `&bump_foil` asks for
    real(wp), intent(in) :: displacement !! typical one of a foil [m]
    type(contact_set_type), intent(inout) :: contacts !! this rank's

    contacts%law = contact_laws(contact)
    contacts%sticks_in_motion = contact%friction_law_in_motion == motion_coulomb
    contacts%at_faces = contact%contact_surface == surface_face
    contacts%secant_penetration = first_penetration*displacement
    contacts%artificial_normal = normal_share*bump_stiffness(foil)*foil%pitch%value
  end subroutine set_contact_laws

  !> The laws of sleeve and top.
  pure function contact_laws(contact) result(law)
    type(contact_case_type), intent(in) :: contact
    type(contact_law_type) :: law(contact_top)

    law = contact_law_type(contact%normal_stiffness, contact%exponent, 0.0_wp, &
                           contact%stick_length, contact%friction_law, &
                           one_way=contact%friction_direction == direction_motion)
    law(contact_sleeve)%friction = contact%friction_sleeve
    law(contact_top)%friction = contact%friction_top
  end function contact_laws
end module gfb_contact_laws
