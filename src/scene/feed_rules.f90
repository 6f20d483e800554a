!> What a film that is fed under pressure asks of the scene.
module gfb_feed_rules
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: pad_angle
  use gfb_bearing_row, only: needs_thrust
  use gfb_case_keys, only: case_keys_type
  use gfb_feed_case, only: feed_group, feed_porous, hole_type, find_holes, spread_rim, &
                           through_sleeve
  use gfb_film_surface, only: film_surface_type
  use gfb_bearing_case, only: surface_of
  use gfb_gas_law, only: density_peng_robinson, density_table
  use gfb_model_case, only: coupling_partitioned
  use gfb_scene, only: scene_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_feed

  !> Of the film's width: gas flows along a thicker wall [1].
  real(wp), parameter :: thin_wall = 0.2_wp

contains

  !> Checks what the supply asks of bearing, model and gas.
  subroutine check_feed(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    logical :: real_gas

    if (.not. scene%feed%present .or. .not. scene%general%analysis%has_film) return
    associate (feed => scene%feed, model => scene%model, bearing => scene%bearing, gas => scene%gas)
      call warn_of_low('supply_pressure', feed%supply_pressure)
      call warn_of_low('channel_pressure', feed%channel_pressure)
      real_gas = any(gas%law%density == [density_peng_robinson, density_table])
      call keys%rule(feed_group, 'kind', real_gas .and. feed%has_orifices(), "must be 'porous' "// &
                     'beside equation_of_state or a table of the gas in this version')
      call keys%rule(feed_group, 'supply_temperature', real_gas .and. feed%temperature_given &
                     .and. .not. scene%thermal%present, 'has no use beside equation_of_state '// &
                     'or a table of the gas without &thermal: they hold at one temperature')
      call keys%rule(feed_group, 'supply_pressure', gas%law%density == density_peng_robinson &
                     .and. feed%supply_pressure >= gas%law%fluid%saturation, 'must be below '// &
                     text(gas%law%fluid%saturation, 4)//' Pa, at which the gas condenses at '// &
                     'its temperature')
      if (gas%law%density == density_table .and. allocated(gas%law%density_curve%place)) then
        associate (most => maxval(gas%law%density_curve%place))
          call keys%rule(feed_group, 'supply_pressure', feed%supply_pressure > most, 'must lie '// &
                         'in the table of the gas, up to '//text(most)//' Pa')
        end associate
      end if
      call keys%rule(feed_group, 'kind', bearing%play > 0.0_wp, 'cannot stand beside '// &
                     'axial_play in &bearing in this version')
      call keys%rule('model', 'coupling', model%coupling == coupling_partitioned, &
                     "must be 'monolithic' with &feed")
      call keys%rule(feed_group, 'kind', feed%kind == feed_porous .and. model%foil%has_top_foil, &
                     "must be 'orifices' under a top foil, through which no wall feeds")
      call keys%rule(feed_group, 'through', feed%has_orifices() .and. &
                     feed%through == through_sleeve .and. model%foil%has_top_foil .and. &
                     model%foil%is_known(), 'must be given, '// &
                     "'top_foil' or 'channel': holes of the sleeve end under the foil")
      call keys%rule(feed_group, 'through', feed%through /= through_sleeve .and. &
                     model%foil%is_known() .and. .not. model%foil%has_top_foil, &
                     "needs a top foil: foil = 'beam', "// &
                     "'plate' or 'shell' in &model")
      call keys%rule('bearing', 'inner_edge', bearing%inner_edge > 1 .and. &
                     .not. bearing%row%has_sectors, needs_thrust)
      if (feed%kind == feed_porous .and. min(feed%wall_thickness, bearing%length) > 0.0_wp) then
        if (feed%wall_thickness > thin_wall*bearing%length) then
          call keys%warn(feed_group, 'wall_thickness', 'is more than a fifth of the width of '// &
                         text(bearing%length)//' m: gas flows along the wall, too, which is '// &
                         'not modelled')
        end if
      end if
      if (feed%has_orifices()) call check_mouths(keys, scene)
    end associate

  contains

    !> Warns of a pressure that feeds nothing.
    subroutine warn_of_low(key, pressure)
      character(len=*), intent(in) :: key !! of the pressure
      real(wp), intent(in) :: pressure !! absolute [Pa]

      if (.not. keys%meant(feed_group, key)) return
      if (min(scene%gas%ambient_pressure, pressure) <= 0.0_wp .or. &
          pressure > scene%gas%ambient_pressure) return
      call keys%warn(feed_group, key, 'is not above the ambient pressure of '// &
                     text(scene%gas%ambient_pressure)//' Pa: nothing is fed. It is absolute')
    end subroutine warn_of_low
  end subroutine check_feed

  !> Mouths lie on a pad, and not on each other.
  subroutine check_mouths(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(hole_type), allocatable :: hole(:)
    type(film_surface_type) :: surface
    character(len=:), allocatable :: key, crossed
    real(wp) :: apart
    integer :: pad, i, k, found

    associate (feed => scene%feed, bearing => scene%bearing)
      if (.not. allocated(feed%row_positions)) return
      if (min(bearing%radius, bearing%length, feed%mouth_diameter) <= 0.0_wp) return
      if (size(feed%row_positions) == 0 .or. feed%holes_of_row() < 1) return
      if (feed%spread /= spread_rim) return
      call check_cuts(keys, scene)
      surface = surface_of(bearing)
      key = 'orifices'
      if (size(feed%orifice_angles) > 0) key = 'orifice_angles'
      found = 0
      do pad = 1, bearing%pads
        call find_holes(feed, bearing, pad, hole)
        found = found + size(hole)
        do i = 1, size(hole)
          crossed = crossed_by(scene, hole(i), surface%radius_at(hole(i)%along))
          if (crossed /= '') then
            call keys%complain(feed_group, key, 'puts the mouth of orifice '// &
                               text(hole(i)%number)//' across '//crossed//' of pad '//text(pad))
            return
          end if
          do k = 1, i - 1
            apart = modulo(hole(i)%angle - hole(k)%angle + 0.5_wp*turn, turn) - 0.5_wp*turn
            apart = hypot(apart*surface%radius_at(hole(i)%along), hole(i)%along - hole(k)%along)
            if (apart >= feed%mouth_diameter) cycle
            call keys%complain(feed_group, key, 'makes mouths overlap: those of orifices '// &
                               text(hole(k)%number)//' and '//text(hole(i)%number)//' are '// &
                               text(apart, 4)//' m apart')
            return
          end do
        end do
      end do
      call keys%rule(feed_group, key, found == 0, 'leaves no orifice on a pad')
    end associate
  end subroutine check_mouths

  !> What of its pad the mouth of an orifice lies across; empty where nothing.
  function crossed_by(scene, hole, radius) result(words)
    type(scene_type), intent(in) :: scene
    type(hole_type), intent(in) :: hole
    real(wp), intent(in) :: radius !! of the surface at its centre [m]
    character(len=:), allocatable :: words
    real(wp) :: half, angle

    words = ''
    if (scene%bearing%is_ring()) return
    half = 0.5_wp*scene%feed%mouth_diameter
    associate (bearing => scene%bearing, arc => pad_angle(scene%bearing))
      angle = hole%angle - bearing%leading_edge_angle
      if (min(angle, arc - angle)*radius <= half) then
        words = 'an edge'
      else if (bearing%ramp_part > 0.0_wp .and. &
               abs(angle - bearing%ramp_part*arc)*radius < half) then
        words = 'the end of the ramp'
      end if
    end associate
  end function crossed_by

  !> Mouths lie on one strip of a foundation that is cut.
  subroutine check_cuts(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: row, i

    if (.not. scene%model%has_strips()) return
    associate (rows => scene%feed%row_positions, cuts => scene%model%cut_radii)
      do row = 1, size(rows)
        do i = 1, size(cuts)
          if (abs(rows(row) - cuts(i)) >= 0.5_wp*scene%feed%mouth_diameter) cycle
          call keys%complain(feed_group, 'row_positions', 'puts mouths across the cut at '// &
                             text(cuts(i))//' m', row)
        end do
      end do
    end associate
  end subroutine check_cuts
end module gfb_feed_rules
