!> What a sample of bearings must have, and cannot have.
module gfb_sample_rules
  use gfb_kinds, only: wp
  use gfb_foil_cases, only: draw_gaps, largest_gap
  use gfb_case_keys, only: case_keys_type
  use gfb_result_table, only: bearing
  use gfb_scene, only: scene_type
  use gfb_study_rules, only: one_answer
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_sample, sample_member

contains

  !> What a sample cannot have beside it.
  subroutine check_sample(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'sample', key = 'count'

    if (.not. scene%sample%present) return
    if (keys%meant('bump_foil', 'height_deviation')) then
      call check_heights(keys, scene)
    else
      call keys%rule(group, key, .not. keys%holds(group, 'parameters'), 'needs '// &
                     'height_deviation in &bump_foil, or parameters: without them all members '// &
                     'are the same')
    end if
    call keys%rule(group, key, scene%sweep%present, one_answer)
    call keys%rule(group, key, scene%accuracy%present, 'cannot stand beside &accuracy: one '// &
                   'member on one mesh has its error, then all have it on that mesh')
    call keys%rule(group, key, scene%output%restart_every > 0, 'is of many runs, which no '// &
                   'restart file resumes: restart_every must be 0')
  end subroutine check_sample

  !> Every member keeps the rule that the scene keeps: no gap as large as a bump.
  subroutine check_heights(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(scene_type) :: member
    real(wp), parameter :: most_heights = 50.0e6_wp !! of all members
    real(wp) :: lowest, drawn_heights
    integer :: number

    associate (foil => scene%bump_foil)
      if (foil%bumps < 1 .or. .not. foil%height%value > 0.0_wp) return
      lowest = foil%height%smallest()
      if (.not. foil%random%deviation > 0.0_wp) return
      if (foil%random%seed > huge(0) - scene%sample%count) then
        call keys%complain('sample', 'count', 'leads to a seed that is too large')
        return
      end if
      drawn_heights = real(scene%sample%count, wp)*real(foil%bumps, wp)* &
                      real(foil%strips*scene%bearing%all_pads(), wp)
      if (drawn_heights > most_heights) then
        call keys%complain('sample', 'count', 'needs '//text(drawn_heights, 3)//' heights of '// &
                           'bumps, which must not be more than '//text(nint(most_heights)))
        return
      end if
      do number = 2, scene%sample%count
        member = sample_member(scene, number)
        associate (drawn => member%bump_foil)
          if (largest_gap(drawn%random, drawn%crest_gap) < lowest) cycle
          call keys%complain('sample', 'count', 'seed '//text(drawn%random%seed)//' leaves a '// &
                             'gap that is not less than the height of the bumps, '// &
                             text(lowest)//' m')
        end associate
        return
      end do
    end associate
  end subroutine check_heights

  !> A member: the scene with another seed.
  pure function sample_member(scene, number) result(member)
    type(scene_type), intent(in) :: scene !! with `&sample`
    integer, intent(in) :: number !! of the member, from 1
    type(scene_type) :: member

    member = scene
    member%sample%present = .false.
    associate (foil => member%bump_foil)
      foil%random%seed = scene%bump_foil%random%seed + number - 1
      if (foil%random%deviation > 0.0_wp) then
        call draw_gaps(foil%random, foil%bumps, foil%strips*scene%bearing%all_pads(), &
                       foil%crest_gap)
      end if
      member%name = scene%name//'.seed'//text(foil%random%seed)
    end associate
  end function sample_member
end module gfb_sample_rules
