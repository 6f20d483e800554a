!> What grooves ask of the scene.
module gfb_groove_rules
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: pad_length, surface_of
  use gfb_case_keys, only: case_keys_type
  use gfb_film_surface, only: film_surface_type, entraining_speed
  use gfb_groove_case, only: groove_group, on_sleeve
  use gfb_operation_case, only: angular_speed
  use gfb_model_case, only: film_scheme_supg, half_width_yes
  use gfb_scene, only: scene_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_grooves

contains

  !> Checks what grooves ask of bearing, model and gas.
  subroutine check_grooves(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    if (.not. scene%grooves%present .or. .not. scene%general%analysis%has_film) return
    associate (grooves => scene%grooves, model => scene%model)
      call keys%rule(groove_group, 'on', scene%thermal%present, 'cannot stand beside &thermal '// &
                     'in this version')
      call keys%rule('gas', 'turbulence', scene%gas%law%turbulent, "must be 'none' with "// &
                     '&grooves in this version')
      call keys%rule(groove_group, 'on', grooves%member == on_sleeve .and. &
                     model%foil%has_top_foil, "must be 'shaft' over a top foil, which "// &
                     'has no grooves')
      call keys%rule('model', 'film_scheme', model%film_scheme == film_scheme_supg, 'must not '// &
                     "be 'supg' with &grooves: upwinding is for smooth surfaces")
      call keys%rule('model', 'half_width', model%half_width == half_width_yes .and. &
                     .not. grooves%mirrors(), 'needs bands in &grooves that mirror each other '// &
                     'about z = 0, and pump against each other')
      if (grooves%are_resolved()) call check_resolved(keys, scene)
      if (keys%mistakes() == 0 .and. .not. grooves%are_resolved()) call warn_of_count(keys, scene)
    end associate
  end subroutine check_grooves

  !> Grooves are meshed where they stand still, on a ring without ends, over local springs at most.
  subroutine check_resolved(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    associate (grooves => scene%grooves, model => scene%model)
      call keys%rule(groove_group, 'model', grooves%member /= on_sleeve .and. grooves%member > 0, &
                     "needs on = 'sleeve': the film over grooves that turn is never steady")
      call keys%rule(groove_group, 'model', .not. scene%bearing%is_ring(), 'needs '// &
                     "leading_edge_condition = 'periodic': lines of the mesh follow the grooves")
      call keys%rule(groove_group, 'model', model%foil%is_known() .and. .not. &
                     (model%has_local_springs() .or. .not. model%foil%deflects), 'needs foil = '// &
                     "'rigid', or 'elastic_foundation' with foundation_pressure = 'local'")
      call keys%rule(groove_group, 'model', scene%shaft_contact%present, 'must be narrow '// &
                     'beside &shaft_contact')
      call keys%rule(groove_group, 'model', scene%feed%present, 'must be '// &
                     "'narrow' beside &feed: lines of the mesh follow the grooves")
    end associate
  end subroutine check_resolved

  !> Warns of grooves that are too few for their limit.
  !>
  !> Beside the losses at the ends of bands, 1/N, gas is compressed within a pitch: \( 3 \cdot
  !> 10^{-5} (2 \pi \Lambda/N)^2 \) of the load, \( \Lambda = 6 \mu \Omega R^2/(p_a h^2) \).
  subroutine warn_of_count(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp), parameter :: within_pitch = 3.0e-5_wp, much = 0.01_wp !! [1]
    real(wp), parameter :: fewest_pitches = 6.0_wp !! of a pad
    type(film_surface_type) :: surface
    real(wp) :: pitch, gap, number, loss

    associate (grooves => scene%grooves, bearing => scene%bearing, gas => scene%gas)
      if (grooves%count == 0) return
      surface = surface_of(bearing)
      pitch = turn*surface%radius_at(0.5_wp*(grooves%band_begin(1) + grooves%band_end(1)))/ &
              real(grooves%count, wp)
      if (any(grooves%band_end - grooves%band_begin < pitch)) then
        call keys%warn(groove_group, 'count', 'gives a pitch of '//text(pitch, 3)//' m, more '// &
                       'than a band is wide: grooves are taken as infinitely many')
      end if
      if (.not. bearing%is_ring() .and. pad_length(bearing) < fewest_pitches*pitch) then
        call keys%warn(groove_group, 'count', 'leaves a pad less than 6 pitches: grooves are '// &
                       'taken as infinitely many')
      end if
      gap = bearing%clearance
      if (.not. gap > 0.0_wp) gap = scene%operation%axial_gap
      if (.not. min(gas%ambient_pressure, gap) > 0.0_wp) return
      number = 12.0_wp*gas%viscosity*bearing%radius/(gas%ambient_pressure*gap**2)* &
               entraining_speed(angular_speed(scene%operation%speed_rpm), bearing%radius)
      loss = within_pitch*(turn*number/real(grooves%count, wp))**2
      if (loss > much) then
        call keys%warn(groove_group, 'count', 'leaves gas that is compressed between ridges, '// &
                       'which is not modelled: about '//text(100.0_wp*loss, 2)//' % of the load')
      end if
    end associate
  end subroutine warn_of_count
end module gfb_groove_rules
