!> How far an answer keeps the limits of `&capacity`: the smallest film that is wanted where it ends
!> no search, the highest temperature and the largest stress. Of a sweep its worst point counts.
module gfb_kept_limits
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_case_file, only: history_row_type, history_values
  use gfb_quantity, only: quantity_type, place_of, number_in
  use gfb_result_names, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_units, only: ice_point, micrometres
  implicit none (type, external)
  private
  public :: add_margins, show_broken_limits

  character(len=*), parameter :: hottest(*) = [character(len=28) :: &
                                               'maximum_film_temperature', &
                                               'maximum_top_foil_temperature']
  character(len=*), parameter :: strained(*) = [character(len=28) :: &
                                                'maximum_top_foil_stress', &
                                                'maximum_bump_foil_stress']
  real(wp), parameter :: megapascals = 1.0e-6_wp !! in a pascal
  real(wp), parameter :: at_limit = 1.0e-6_wp    !! what a search for a limit leaves of a margin [1]

  !> The worst value of some results, and where.
  type :: worst_type
    logical :: known = .false.
    real(wp) :: value = 0.0_wp !! [SI]
    integer :: point = 0       !! of a sweep; 0: of the last state
  end type worst_type

contains

  !> Adds how many times each limit is kept: below 1 it is broken.
  subroutine add_margins(scene, history, summary)
    type(scene_type), intent(in) :: scene !! with the limits
    type(history_row_type), intent(in) :: history(:) !! points of a sweep, if it is one
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! of the last state
    type(worst_type) :: film, heat, stress

    call find_worst(scene, history, summary, film, heat, stress)
    if (film%known) then
      call add_result(summary, 'film_margin', film%value/scene%capacity%smallest_gap)
    end if
    ! What is colder than the gas around it is as far from its limit as one likes.
    if (heat%known .and. heat%value > scene%thermal%ambient_temperature) then
      call add_result(summary, 'temperature_margin', heat_margin(scene, heat%value))
    end if
    if (stress%known .and. stress%value > 0.0_wp) then
      call add_result(summary, 'stress_margin', scene%capacity%largest_stress/stress%value)
    end if
  end subroutine add_margins

  !> How far the highest temperature is above the gas around, over how far a temperature is; at the
  !> limit, where a search has ended there, 1.
  pure real(wp) function heat_margin(scene, temperature) result(margin)
    type(scene_type), intent(in) :: scene !! with the limit
    real(wp), intent(in) :: temperature !! above that of the gas around [K]

    associate (ambient => scene%thermal%ambient_temperature)
      margin = (scene%capacity%highest_temperature - ambient)/(temperature - ambient)
    end associate
    if (abs(margin - 1.0_wp) <= at_limit) margin = 1.0_wp
  end function heat_margin

  !> Warns of each limit that is broken.
  subroutine show_broken_limits(scene, history, summary, log)
    type(scene_type), intent(in) :: scene !! with the limits
    type(history_row_type), intent(in) :: history(:) !! points of a sweep, if it is one
    type(quantity_type), intent(in) :: summary(:) !! of the last state
    type(run_log_type), intent(in) :: log
    type(worst_type) :: film, heat, stress

    call find_worst(scene, history, summary, film, heat, stress)
    associate (wanted => scene%capacity)
      if (film%known .and. film%value < wanted%smallest_gap) then
        call log%warning('the smallest film, '//text(film%value*micrometres, 4)//' um'// &
                         place(film)//', is thinner than smallest_gap of &capacity, '// &
                         text(wanted%smallest_gap*micrometres, 4)//' um')
      end if
      if (heat%known .and. heat%value > wanted%highest_temperature .and. &
          heat_margin(scene, heat%value) < 1.0_wp) then
        call log%warning('the highest temperature of film and top foil, '// &
                         text(heat%value - ice_point, 4)//' C'//place(heat)// &
                         ', is above highest_temperature of &capacity, '// &
                         text(wanted%highest_temperature - ice_point, 4)//' C')
      end if
      if (stress%known .and. stress%value > wanted%largest_stress) then
        call log%warning('the largest stress of the foils, '// &
                         text(stress%value*megapascals, 4)//' MPa'//place(stress)// &
                         ', is above largest_stress of &capacity, '// &
                         text(wanted%largest_stress*megapascals, 4)//' MPa')
      end if
    end associate
  end subroutine show_broken_limits

  !> The thinnest film where one is wanted and none ends a search, the highest temperature and the
  !> largest stress where they have limits.
  subroutine find_worst(scene, history, summary, film, heat, stress)
    type(scene_type), intent(in) :: scene
    type(history_row_type), intent(in) :: history(:)
    type(quantity_type), intent(in) :: summary(:)
    type(worst_type), intent(out) :: film, heat, stress
    character(len=*), parameter :: of_all_time = 'minimum_gap_over_time'
    integer :: i

    associate (wanted => scene%capacity)
      if (wanted%smallest_gap > 0.0_wp .and. wanted%limit == 0) then
        if (place_of(of_all_time, summary) > 0) then
          film = worst_type(.true., number_in(summary, of_all_time))
        else
          call look(film, 'minimum_gap', -1.0_wp)
        end if
      end if
      do i = 1, merge(size(hottest), 0, wanted%highest_temperature > 0.0_wp)
        call look(heat, trim(hottest(i)), 1.0_wp)
      end do
      do i = 1, merge(size(strained), 0, wanted%largest_stress > 0.0_wp)
        call look(stress, trim(strained(i)), 1.0_wp)
      end do
    end associate

  contains

    !> Takes the points of a sweep, else the last state.
    subroutine look(worst, name, sign)
      type(worst_type), intent(inout) :: worst
      character(len=*), intent(in) :: name !! of a result
      real(wp), intent(in) :: sign !! 1: the largest is the worst; -1: the smallest
      real(wp), allocatable :: value(:)
      integer :: point

      if (scene%sweep%present .and. size(history) > 0) then
        value = history_values(history, name)
        do point = 1, size(value)
          call meet(worst, value(point), point, sign)
        end do
      else if (place_of(name, summary) > 0) then
        call meet(worst, number_in(summary, name), 0, sign)
      end if
    end subroutine look
  end subroutine find_worst

  !> Keeps a value where it is worse.
  pure subroutine meet(worst, value, point, sign)
    type(worst_type), intent(inout) :: worst
    real(wp), intent(in) :: value !! NaN: there is none
    integer, intent(in) :: point !! of a sweep, or 0
    real(wp), intent(in) :: sign

    if (ieee_is_nan(value)) return
    if (worst%known .and. sign*(value - worst%value) <= 0.0_wp) return
    worst = worst_type(.true., value, point)
  end subroutine meet

  !> Where the worst value is, of a sweep.
  pure function place(worst) result(words)
    type(worst_type), intent(in) :: worst
    character(len=:), allocatable :: words

    words = ''
    if (worst%point > 0) words = ' at point '//text(worst%point)//' of the sweep'
  end function place
end module gfb_kept_limits
