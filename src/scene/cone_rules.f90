!> What a conical bearing asks of the scene.
module gfb_cone_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: half_width_yes, coupling_partitioned
  use gfb_operation_case, only: operation_case_type
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: operation_at, sweep_axial_load, sweep_keys
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_cone

contains

  !> Checks a scene with a conical bearing.
  subroutine check_cone(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    integer :: point

    if (.not. scene%bearing%half_angle > 0.0_wp) return
    call keys%rule('model', 'foil', scene%model%foil%has_top_foil, "must be 'rigid' or "// &
                   "'elastic_foundation' with "// &
                   'half_angle in &bearing: a foil on a cone is no plane when it is unrolled')
    call keys%rule('model', 'half_width', scene%model%half_width == half_width_yes, &
                   "must be 'no' with half_angle in &bearing: a cone's ends are not alike")
    call keys%rule('model', 'coupling', scene%model%coupling == coupling_partitioned, &
                   "must be 'monolithic' with half_angle in &bearing")
    call keys%rule('scene', 'analysis', scene%transient%present .or. scene%periodic%present &
                   .or. scene%capacity%limit > 0, 'cannot be that of a conical bearing yet: '// &
                   'it is known of its equilibria, fixed positions and small vibrations')
    call not_beside(scene%rotor%present, 'rotor', 'mass')
    call not_beside(scene%shaft_contact%present, 'shaft_contact', 'roughness')
    call not_beside(any(scene%sensitivity%quantity), 'sensitivity', 'quantity')
    call keys%rule('operation', 'axial_load', keys%meant('operation', 'axial_load') .and. &
                   scene%general%analysis%holds, 'has no use at a fixed '// &
                   'position')
    call keys%rule('sweep', 'parameter', scene%sweep%parameter == sweep_axial_load .and. &
                   .not. scene%general%analysis%floats, 'needs an equilibrium')
    do point = 1, size(scene%sweep%values)
      call keys%rule('sweep', 'values', scene%sweep%parameter == sweep_axial_load .and. .not. &
                     scene%sweep%values(point) > 0.0_wp, 'must be positive: a cone presses one '// &
                     'way alone', point)
    end do
    if (.not. scene%model%foil%deflects) call check_shift(keys, scene%bearing, scene%operation)
    if (scene%general%analysis%floats) call check_loads(keys, scene)

  contains

    !> Refuses a group.
    subroutine not_beside(there, group, key)
      logical, intent(in) :: there !! the file has it
      character(len=*), intent(in) :: group, key
      call keys%rule(group, key, there, 'cannot stand beside half_angle in &bearing yet')
    end subroutine not_beside
  end subroutine check_cone

  !> Warns of an axial load that takes suction, at the operating point or the first one of a sweep.
  subroutine check_loads(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(operation_case_type) :: there
    integer :: point

    associate (sweep => scene%sweep)
      if (size(sweep%values) == 0 .or. sweep%parameter == sweep_keys) then
        if (takes_suction(scene%bearing, scene%operation)) call warn('operation', 'axial_load', &
                                                                     'is', scene%operation)
        return
      end if
      do point = 1, size(sweep%values)
        there = operation_at(scene%operation, sweep, point)
        if (.not. takes_suction(scene%bearing, there)) cycle
        call warn('sweep', 'values', 'leaves axial_load', there, point)
        return
      end do
    end associate

  contains

    subroutine warn(group, key, how, operation, point)
      character(len=*), intent(in) :: group, key, how
      type(operation_case_type), intent(in) :: operation
      integer, intent(in), optional :: point
      call keys%warn(group, key, how//' less than tan(half_angle) times the load, '// &
                     text(tan(scene%bearing%half_angle)*norm2(operation%load), 4)//' N: only a '// &
                     'film with pressures below ambient carries both', point)
    end subroutine warn
  end subroutine check_loads

  !> Whether both loads take pressures below ambient. With p over ambient the film's force is
  !> \( F_z = \sin\beta \int p \, dA \) along the axis and
  !> \( F_r = \cos\beta \, | \int p \, e_r \, dA | \) across it: where p is nowhere negative,
  !> \( F_z \ge F_r \tan\beta \).
  elemental logical function takes_suction(bearing, operation) result(takes)
    type(bearing_case_type), intent(in) :: bearing !! a cone
    type(operation_case_type), intent(in) :: operation
    takes = operation%axial_load > 0.0_wp .and. &
            operation%axial_load < tan(bearing%half_angle)*norm2(operation%load)
  end function takes_suction

  !> Without a foil that deflects an axial position leaves a gap all around.
  subroutine check_shift(keys, bearing, operation)
    type(case_keys_type), intent(inout) :: keys
    type(bearing_case_type), intent(in) :: bearing
    type(operation_case_type), intent(in) :: operation
    real(wp) :: gap !! without eccentricity and tilt [m]

    gap = bearing%clearance - operation%axial_eccentricity*sin(bearing%half_angle)
    call keys%rule('operation', 'axial_eccentricity', bearing%clearance > 0.0_wp .and. .not. &
                   gap > 0.0_wp, 'closes the gap: '//text(gap, 4)//' m are left of the clearance')
  end subroutine check_shift
end module gfb_cone_rules
