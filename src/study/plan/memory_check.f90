!> Says what memory a scene takes, and refuses what the machine does not have.
module gfb_memory_check
  use gfb_kinds, only: wp
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_out_of_core, linear_solver_iterative
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_machine_memory, only: available_memory, unknown_memory
  use gfb_petsc_session, only: rank_count, ranks_on_node, largest_over_ranks
  use gfb_scene, only: scene_type
  use gfb_memory_laws, only: rank_memory
  use gfb_model_case, only: reduction_guyan
  use gfb_scene_rules, only: what_factors_do
  implicit none (type, external)
  private
  public :: show_memory, check_memory

  real(wp), parameter :: stated_factor = 1.5_wp !! estimate and peak differ by no more

  real(wp), parameter :: megabyte = 1.0e6_wp, gigabyte = 1.0e9_wp !! [B]

contains

  !> One line on the memory of a scene.
  subroutine show_memory(bytes, log)
    real(wp), intent(in) :: bytes !! of the equations [B]
    type(run_log_type), intent(in) :: log !! where the line goes
    real(wp) :: total

    total = rank_memory(bytes, rank_count())
    call log%line('memory: about '//megabytes(total)//' in all ('// &
                  text(total/stated_factor/gigabyte, 2)//' to '// &
                  text(total*stated_factor/gigabyte, 2)//' GB), '// &
                  megabytes(total/rank_count())//' a rank')
    if (is_too_much(bytes)) then
      call log%warning('this machine has '//megabytes(node_room())//' free for the '// &
                       text(ranks_on_node())//' rank(s) on it')
    end if
  end subroutine show_memory

  !> Refuses a scene that needs more memory than the machine has, on all ranks alike.
  subroutine check_memory(scene, bytes, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp), intent(in) :: bytes !! of its equations [B]
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (.not. scene%solver%memory_check) return
    if (is_too_much(bytes)) then
      call fail(error, scene%file//': needs about '//megabytes(node_need(bytes))// &
                ' of memory for '//text(ranks_on_node())//' rank(s) on a machine that has '// &
                megabytes(node_room())//' free; what helps: '//remedies(scene)// &
                ', or memory_check = .false. in &solver to try all the same')
    end if
  end subroutine check_memory

  !> What makes a scene smaller, in words.
  pure function remedies(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words
    logical :: shells

    words = 'a coarser &mesh'
    shells = scene%model%foil%has_shell_bumps .and. .not. scene%general%analysis%finds_modes
    if (shells .and. scene%model%reduction == reduction_guyan) then
      words = words//", reduction = 'none' where the mesh is wide"
    else if (shells) then
      words = words//", reduction = 'guyan' where the mesh is narrow"
    end if
    if (shells .and. what_factors_do(scene) == '' .and. &
        scene%model%reduction /= reduction_guyan .and. &
        scene%solver%linear_solver /= linear_solver_iterative) then
      words = words//", linear_solver = 'iterative' in &solver"
    end if
    if (scene%solver%linear_solver == linear_solver_direct .and. &
        .not. scene%general%analysis%finds_modes) then
      words = words//", linear_solver = 'out_of_core'"
    end if
    words = words//', more nodes'
  end function remedies

  !> Whether some machine of the job has less memory than its ranks need.
  logical function is_too_much(bytes) result(too_much)
    real(wp), intent(in) :: bytes !! of the equations [B]
    too_much = node_need(bytes) > node_room()
  end function is_too_much

  !> What the ranks of the fullest machine need [B].
  real(wp) function node_need(bytes) result(need)
    real(wp), intent(in) :: bytes !! of the equations [B]
    need = rank_memory(bytes, rank_count())*real(ranks_on_node(), wp)/real(rank_count(), wp)
  end function node_need

  !> What the machine with the least memory has [B].
  real(wp) function node_room() result(room)
    room = -maxval(largest_over_ranks([-min(available_memory(), unknown_memory)]))
  end function node_room

  !> Bytes in MB or GB.
  pure function megabytes(bytes) result(words)
    real(wp), intent(in) :: bytes !! [B]
    character(len=:), allocatable :: words

    if (bytes < 1.0e3_wp*megabyte) then
      words = text(bytes/megabyte, 3)//' MB'
    else
      words = text(bytes/(1.0e3_wp*megabyte), 3)//' GB'
    end if
  end function megabytes
end module gfb_memory_check
