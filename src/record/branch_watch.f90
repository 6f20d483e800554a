!> Whether the answers of a sweep stay on one branch of equilibria, where a bearing may have
!> several: where the leading edge of its top foil is free.
!>
!> Another branch is recognised by one of three signs:
!>
!> - the determinant of the equations' matrix has changed its sign, and no fold was turned: between
!>   two answers on one branch it changes only at folds;
!> - the free edge has moved by more than 0.2 C beyond the line through the two answers before, and
!>   by more than that line foretells; after one answer only, by more than 0.4 C;
!> - the smallest film has done so; after one answer only it shows nothing.
!>
!> The line is one over the logarithm of the parameter where its values have one sign: over that
!> the film of one branch is nearly straight. Where a path of short steps has led to the answer,
!> only the first sign counts.
module gfb_branch_watch
  use gfb_kinds, only: wp
  use gfb_quantity, only: number_in
  use gfb_result_names, only: add_result
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: parameter_words, sweep_keys, sweep_load_angle
  use gfb_top_foil_case, only: top_foil_trailing
  use gfb_case_file, only: history_row_type
  implicit none (type, external)
  private
  public :: watch_branch, note_start

  real(wp), parameter :: foretold = 0.2_wp !! off the line through two answers, over C [1]
  real(wp), parameter :: alone = 0.4_wp    !! off the only answer before, over C [1]
  character(len=*), parameter :: lifts(2) = [character(len=22) :: &
    'leading_edge_lift', 'leading_edge_lift_edge']

contains

  !> Puts `started_anew` into the last row of a sweep's history.
  subroutine note_start(history, anew)
    type(history_row_type), intent(inout) :: history(:) !! the last row gets the result
    logical, intent(in) :: anew !! its answer was found from nothing, where no path led to it
    call add_result(history(size(history))%quantity, 'started_anew', anew)
  end subroutine note_start

  !> Judges the last row of a sweep's history by the rows before, and puts `branch_changed` into it;
  !> nothing is done where no edge is free.
  subroutine watch_branch(scene, in_short_steps, history, why)
    type(scene_type), intent(in) :: scene !! of the sweep
    logical, intent(in) :: in_short_steps !! a path of short steps has led to the last answer
    type(history_row_type), intent(inout) :: history(:) !! the last row gets its result
    character(len=:), allocatable, intent(out) :: why !! it is another branch; empty: it is not
    logical :: steps_alike

    why = ''
    if (.not. scene%general%analysis%floats) return
    if (.not. scene%model%foil%has_bumps) return
    if (scene%top_foil%fixed_edge /= top_foil_trailing) return
    if (determinant_changed(history)) why = 'the determinant of the matrix changed its sign'
    ! Neighbouring limits lie at other loads, speeds or tilts, some of them at a branch's end.
    steps_alike = .not. (in_short_steps .or. scene%sweep%turn_folds .or. &
                         scene%capacity%limit > 0)
    if (why == '' .and. steps_alike) then
      why = move_words(scene, history)
    end if
    call add_result(history(size(history))%quantity, 'branch_changed', why /= '')
  end subroutine watch_branch

  !> Whether the determinant has another sign than in the last row that knows it, and no fold lies
  !> between, or the same sign and a fold does.
  pure logical function determinant_changed(history) result(changed)
    type(history_row_type), intent(in) :: history(:)
    real(wp) :: now, before
    integer :: row, folds

    changed = .false.
    now = number_in(history(size(history))%quantity, 'determinant_sign')
    if (.not. abs(now) > 0.0_wp) return
    folds = 0
    do row = size(history) - 1, 1, -1
      if (number_in(history(row)%quantity, 'fold') > 0.0_wp) folds = folds + 1
      before = number_in(history(row)%quantity, 'determinant_sign')
      if (.not. abs(before) > 0.0_wp) cycle
      changed = now*before < 0.0_wp .neqv. modulo(folds, 2) == 1
      return
    end do
  end function determinant_changed

  !> What has moved to where the rows before do not lead; empty where nothing has.
  function move_words(scene, history) result(words)
    type(scene_type), intent(in) :: scene
    type(history_row_type), intent(in) :: history(:)
    character(len=:), allocatable :: words
    real(wp) :: at(3)
    integer :: i, last, known

    words = ''
    last = size(history)
    if (last < 2) return
    known = 1 ! answers before on one branch
    if (last > 2) then
      if (.not. number_in(history(last - 1)%quantity, 'branch_changed') > 0.0_wp) known = 2
    end if
    if (known == 2) at = places(scene, history(last - 2:))
    if (known == 2) then
      if (.not. abs(at(2) - at(1)) > 0.0_wp) known = 1
    end if
    do i = 1, size(lifts)
      if (leaves(trim(lifts(i)))) words = 'the free edge jumped'
    end do
    if (known == 2 .and. words == '') then
      if (leaves('minimum_gap')) words = 'the smallest film jumped'
    end if

  contains

    !> Whether a number is off the line through the rows before, or far from the only one.
    function leaves(name)
      character(len=*), intent(in) :: name
      logical :: leaves
      real(wp) :: now, before, change

      now = number_in(history(last)%quantity, name)
      before = number_in(history(last - 1)%quantity, name)
      if (known == 1) then
        leaves = abs(now - before) > alone*scene%bearing%clearance
      else
        change = (before - number_in(history(last - 2)%quantity, name))* &
                 (at(3) - at(2))/(at(2) - at(1))
        leaves = abs(now - before - change) > max(foretold*scene%bearing%clearance, abs(change))
      end if
    end function leaves
  end function move_words

  !> Where rows lie along the sweep: its parameter, or the logarithm where all values have one sign.
  pure function places(scene, rows) result(at)
    type(scene_type), intent(in) :: scene
    type(history_row_type), intent(in) :: rows(:)
    real(wp) :: at(size(rows))
    character(len=:), allocatable :: name
    integer :: i

    name = 'key_value'
    if (scene%sweep%parameter /= sweep_keys) name = trim(parameter_words(scene%sweep%parameter))
    at = [(number_in(rows(i)%quantity, name), i=1, size(rows))]
    associate (values => scene%sweep%values)
      if (scene%sweep%parameter == sweep_load_angle) return
      if (all(values > 0.0_wp) .or. all(values < 0.0_wp)) at = log(abs(at))
    end associate
  end function places
end module gfb_branch_watch
