!> Phrases that take the place of the braces in a meaning of the table of results.
module gfb_result_phrases
  implicit none (type, external)
  private

  character(len=*), parameter, public :: &
    film_and_contact = 'film and solid contact', &
    film_and_contact_brake = 'film and solid contact brake', &
    all_modes_found = 'all modes asked for were found', &
    all_members = 'all members have an answer', of_this_step = 'of this step', &
    seed_and_reason = 'seed of the member, and why it has no answer', &
    of_all_steps = 'of all load steps', of_shifted_stiffness = 'of the shifted stiffness', &
    of_whole_table = 'of the whole table', travel_of_plate = 'travel of the plate', &
    with_stretches = 'of ranks, each with a stretch of the sweep', &
    at_this_point = 'at this point', at_first_point = 'at the sweep''s first point', &
    at_fixed_equilibrium = 'in the equilibrium at which the shaft is held', &
    at_begin_of_time = 'where the time begins', &
    load_kept = '; the load is kept', shaft_fixed = '; the shaft is held', &
    linearised_there = ', contact and friction linearised there'
  !> By the axis of the sweep.
  character(len=*), parameter, public :: over_tilt(2) = ['tilt_x = 0, over tilt_x', &
                                                         'tilt_y = 0, over tilt_y']
end module gfb_result_phrases
