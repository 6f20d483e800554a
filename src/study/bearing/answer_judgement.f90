!> What is asked of an answer once it is there: whether it folds, whether the foils stay.
module gfb_answer_judgement
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_shell
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, find_determinant_sign
  use gfb_edge_stiffness, only: find_edge_stiffness
  use gfb_stability, only: stability_type, find_stability
  implicit none (type, external)
  private
  public :: judge_answer

contains

  !> Judges the bearing's present state, which must be an answer; state and point stay as they are.
  subroutine judge_answer(scene, log, bearing, newton, list)
    type(scene_type), intent(in) :: scene !! whether stability is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at an answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: list(:) !! what is known of it
    type(stability_type) :: stability
    integer :: sign_of_determinant
    real(wp), allocatable :: stiffness(:)
    logical, allocatable :: known(:)
    integer :: i

    allocate (list(0))
    if (scene%solver%stability) then
      call find_stability(bearing, stability)
      newton%factorizations = newton%factorizations + stability%factorizations
      newton%enlargements = newton%enlargements + stability%enlargements
      call log%line('stability: '//stability_words(stability, &
                    bearing%pad(1)%whole%half .and. scene%model%foil == foil_shell))
      if (stability%counted) call add_result(list, 'stability', stability%negative)
      if (stability%found) then
        call add_result(list, 'growing_modes', stability%growing)
        call add_result(list, 'stability_margin', real(stability%nearest, wp))
      end if
    end if
    if (.not. bearing%floats .or. bearing%shaft_fixed) return
    ! The last of the factors, so that the next solve can begin with them.
    call find_determinant_sign(newton, sign_of_determinant)
    if (sign_of_determinant == 0) return
    call add_result(list, 'determinant_sign', sign_of_determinant)
    if (.not. bearing%pad(1)%foil%has_contacts()) return
    call find_edge_stiffness(bearing, newton, known, stiffness)
    if (any(known)) call add_result(list, 'edge_stiffness', minval(stiffness, known))
    do i = 1, merge(size(known), 0, size(known) > 1)
      if (known(i)) call add_result(list, 'edge_stiffness_'//text(i), stiffness(i))
    end do
  end subroutine judge_answer

  !> The stability as a sentence.
  function stability_words(stability, symmetric) result(words)
    type(stability_type), intent(in) :: stability
    logical, intent(in) :: symmetric !! no others were looked for
    character(len=:), allocatable :: words

    if (.not. stability%found) then
      words = 'the eigenvalues of the foils were not found'
      return
    end if
    words = 'an unknown number of'
    if (stability%counted) words = text(stability%negative)
    words = words//' negative eigenvalue(s) of the foils'' stiffness, '// &
      text(stability%growing)//' growing mode(s) ('// &
      trim(merge('stable  ', 'unstable', stability%negative + stability%growing == 0))
    if (stability%nearly_neutral) words = words//', one nearly neutral'
    words = words//') while the shaft is fixed; nearest to a change: ('// &
            text(real(stability%nearest, wp), 3)
    if (aimag(stability%nearest) > 0.0_wp) then
      words = words//' +- '//text(aimag(stability%nearest), 3)//' i'
    end if
    words = words//') p_a/C'
    if (symmetric) words = words//'; of modes symmetric about z = 0'
  end function stability_words
end module gfb_answer_judgement
