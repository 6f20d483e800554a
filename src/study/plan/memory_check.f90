!> Says what memory a scene takes, and refuses what the machine does not have.
!>
!> What memory a scene will take, before anything is built.
!>
!> Laws in the number of unknowns, the rows of nodes and the linear solver, fitted to measured
!> peaks: docs/manual/linear_solvers.md has the table. They hold within a factor of 1.5.
module gfb_memory_check
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: node_unknowns
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_out_of_core, linear_solver_iterative
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_machine_memory, only: available_memory, unknown_memory
  use gfb_petsc_session, only: rank_count, ranks_on_node, largest_over_ranks
  use gfb_nonlinear_system, only: few_unknowns
  use gfb_scene, only: scene_type
  use gfb_model_case, only: reduction_guyan
  use gfb_scene_rules, only: what_factors_do
  implicit none (type, external)
  private
  public :: strip_memory, bearing_memory, modes_memory, film_memory, plate_memory, factor_entries, &
            study_share, &
            heated_memory, rank_memory, show_memory, check_memory

  real(wp), parameter :: stated_factor = 1.5_wp !! estimate and peak differ by no more

  real(wp), parameter :: a_rank = 45.0e6_wp       !! a process with its libraries [B]
  real(wp), parameter :: a_film_node = 2.0e3_wp   !! one unknown, and its equation's factors [B]
  real(wp), parameter :: on_each_rank = 0.5_wp    !! of that, where each rank has all factors

  real(wp), parameter :: megabyte = 1.0e6_wp, gigabyte = 1.0e9_wp !! [B]

contains

  !> Entries of a symmetric matrix' factors for each unknown of shells on a grid of nodes:
  !> dissection cuts along the shorter side.
  pure real(wp) function factor_entries(stations, rows) result(entries)
    integer, intent(in) :: stations, rows !! of nodes
    real(wp), parameter :: a_doubling = 32.0_wp, narrow = -43.0_wp, least = 30.0_wp
    entries = max(least, a_doubling*log(real(max(2, min(stations, rows)), wp))/log(2.0_wp) + narrow)
  end function factor_entries

  !> A bump strip [B].
  pure function strip_memory(unknowns, stations, rows, reduced, friction, linear_solver) &
    result(bytes)
    real(wp), intent(in) :: unknowns         !! of the equations [1]
    integer, intent(in) :: stations, rows    !! of nodes that are solved
    logical, intent(in) :: reduced           !! bumps are condensed
    logical, intent(in) :: friction          !! the matrix is not symmetric
    integer, intent(in) :: linear_solver     !! `linear_solver_direct`, ...
    real(wp) :: bytes, entries, line

    if (reduced) then
      line = real(node_unknowns*rows, wp)
      if (linear_solver == linear_solver_out_of_core) then
        bytes = unknowns*line*merge(135.0_wp, 115.0_wp, friction)
      else
        bytes = unknowns*line*merge(180.0_wp, 140.0_wp, friction)
      end if
      return
    end if
    entries = factor_entries(stations, rows)
    select case (linear_solver)
    case (linear_solver_iterative)
      bytes = unknowns*merge(2.6e3_wp, 2.1e3_wp, friction)
    case (linear_solver_out_of_core)
      bytes = unknowns*merge(2.9e3_wp + 2.2_wp*entries, 2.1e3_wp + 1.1_wp*entries, friction)
    case default
      bytes = unknowns*merge(2.85e3_wp + 14.0_wp*entries, 2.5e3_wp + 7.0_wp*entries, friction)
    end select
  end function strip_memory

  !> Modes of a strip: all unknowns with a mass, and the strip of super-elements beside them [B].
  pure real(wp) function modes_memory(unknowns, retained, stations, rows) result(bytes)
    real(wp), intent(in) :: unknowns !! of the equations [1]
    real(wp), intent(in) :: retained      !! of them, where bumps are super-elements [1]
    integer, intent(in) :: stations, rows !! of nodes
    real(wp), parameter :: a_mass = 540.0_wp       !! of an unknown [B]
    real(wp), parameter :: two_matrices = 60.0_wp !! of an unknown times those of a line [B]

    bytes = unknowns*a_mass + retained*real(node_unknowns*rows, wp)*two_matrices + &
            strip_memory(unknowns, stations, rows, .false., .false., linear_solver_direct)
  end function modes_memory

  !> A film without shells [B].
  pure real(wp) function film_memory(nodes, ranks) result(bytes)
    integer, intent(in) :: nodes !! that are solved
    integer, intent(in) :: ranks !! of the job
    bytes = real(nodes, wp)*a_film_node
    if (nodes <= few_unknowns) bytes = bytes*(1.0_wp + on_each_rank*real(ranks - 1, wp))
  end function film_memory

  !> A plate under its film: three unknowns a node more [B].
  pure real(wp) function plate_memory(nodes) result(bytes)
    integer, intent(in) :: nodes !! that are solved
    real(wp), parameter :: a_node = 2.2e4_wp !! [B]
    bytes = real(nodes, wp)*a_node
  end function plate_memory

  !> A bearing of shells [B].
  pure function bearing_memory(nodes, bump_unknowns, rows, reduced, linear_solver) result(bytes)
    integer, intent(in) :: nodes              !! of the film, and of the top foil
    real(wp), intent(in) :: bump_unknowns     !! of the bump foil, condensed or not [1]
    integer, intent(in) :: rows               !! of nodes over the width that is solved
    logical, intent(in) :: reduced            !! bumps are condensed
    integer, intent(in) :: linear_solver      !! `linear_solver_direct`, ...
    real(wp) :: bytes
    real(wp), parameter :: an_entry = 18.0_wp !! of factors; foils lie over each other [B]
    real(wp), parameter :: in_files = 0.3_wp  !! of the factors stays in memory
    real(wp) :: an_unknown, a_coupling

    an_unknown = an_entry*factor_entries(huge(rows), rows)
    a_coupling = 0.0_wp
    if (linear_solver == linear_solver_iterative) then
      an_unknown = 3.0e3_wp
    else if (linear_solver == linear_solver_out_of_core) then
      an_unknown = 2.2e3_wp + in_files*an_unknown
      a_coupling = 135.0_wp
    else
      an_unknown = 3.3e3_wp + an_unknown
      a_coupling = 170.0_wp
    end if
    bytes = real((node_unknowns + 1)*nodes, wp)*an_unknown
    if (reduced) then
      bytes = bytes + bump_unknowns*real(node_unknowns*rows, wp)*a_coupling
    else
      bytes = bytes + bump_unknowns*an_unknown
    end if
  end function bearing_memory

  !> What a study of a bearing takes, over what its answer does [1]. Small vibrations have complex
  !> factors, on half the width also those of motions against the mirror.
  pure real(wp) function study_share(scene, half) result(share)
    type(scene_type), intent(in) :: scene !! of a bearing
    logical, intent(in) :: half !! the width is solved
    share = 1.0_wp
    if (scene%transient%present .or. scene%periodic%present) share = 2.0_wp
    if (.not. scene%dynamics%present) return
    share = merge(3.5_wp, 2.3_wp, half)
    ! Measured on half the width: peaks of 364 and 754 MB at 7,465 and 24,650 unknowns.
    if (scene%solver%linear_solver == linear_solver_iterative) share = merge(11.5_wp, 7.5_wp, half)
  end function study_share

  !> Memory with two temperatures a film node, which factors of MUMPS tie to all else [B].
  pure real(wp) function heated_memory(scene, nodes, cold) result(bytes)
    type(scene_type), intent(in) :: scene !! of a bearing
    integer, intent(in) :: nodes !! of a pad
    real(wp), intent(in) :: cold !! without heat [B]
    real(wp), parameter :: a_node = 1.0e4_wp, of_shells = 1.5_wp !! [B], [1]

    bytes = cold*merge(of_shells, 1.0_wp, scene%model%foil%has_shell_bumps) &
      + a_node*real(nodes*scene%bearing%all_pads(), wp)
  end function heated_memory

  !> All ranks together, with what each process takes by itself [B].
  pure real(wp) function rank_memory(bytes, ranks) result(total)
    real(wp), intent(in) :: bytes !! of the equations [B]
    integer, intent(in) :: ranks !! of the job
    real(wp), parameter :: a_cut = 0.1_wp !! a further rank adds for ghosts, messages, whole tables
    total = bytes*(1.0_wp + a_cut*real(min(ranks, 8) - 1, wp)) + a_rank*real(ranks, wp)
  end function rank_memory

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
