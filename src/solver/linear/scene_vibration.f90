!> What a scene says of its foil under vibration.
module gfb_scene_vibration
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_motion_cases, only: tangent_stick
  use gfb_foundation_foil, only: foundation_stiffness
  use gfb_vibration_law, only: vibration_type
  implicit none (type, external)
  private
  public :: vibration_of

contains

  !> What the foil does under vibration.
  pure function vibration_of(scene) result(vibration)
    type(scene_type), intent(in) :: scene !! with `&dynamics`
    type(vibration_type) :: vibration

    vibration%stick = scene%dynamics%contact_tangent == tangent_stick
    vibration%loss_factor = scene%dynamics%loss_factor
    associate (damping => scene%foil_damping)
      vibration%damping_time = damping%loss_time()
      if (damping%foundation_damping > 0.0_wp) then
        vibration%damping_time = damping%foundation_damping/ &
          foundation_stiffness(scene%model, scene%bump_foil)
      end if
      if (damping%arm%is_present()) then
        vibration%arm = damping%arm
        vibration%arm%stiffness = damping%arm%stiffness/ &
          foundation_stiffness(scene%model, scene%bump_foil)
      end if
    end associate
  end function vibration_of
end module gfb_scene_vibration
