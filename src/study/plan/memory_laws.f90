!> What memory a scene will take, before anything is built.
!>
!> Laws in the number of unknowns, the rows of nodes and the linear solver. Their numbers are fitted
!> to peaks of whole processes, less what a process takes by itself, on one rank, with PETSc 3.18.5
!> and MUMPS 5.5: the tables under "Strips that grow", "Bearings that grow" and "Memory before the
!> solve" of docs/manual/linear_solvers.md have meshes, peaks and how far off the laws are; within
!> a factor of 1.5. Where a number comes from another measurement it says so.
module gfb_memory_laws
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: node_unknowns
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_out_of_core, linear_solver_iterative
  use gfb_nonlinear_system, only: few_unknowns
  use gfb_scene, only: scene_type
  implicit none (type, external)
  private
  public :: strip_memory, bearing_memory, modes_memory, film_memory, plate_memory, factor_entries, &
            study_share, heated_memory, rank_memory

  ! Every process.
  real(wp), parameter :: a_rank = 45.0e6_wp !! with its libraries, at the smallest meshes [B]
  real(wp), parameter :: a_cut = 0.1_wp     !! a further rank adds: ghosts, messages, tables [1]
  integer, parameter :: cut_ranks = 8       !! more of them add no more

  ! Entries of factors: a doubling of the narrower side of a grid adds a level of dissection.
  real(wp), parameter :: a_doubling = 32.0_wp, narrow = -43.0_wp !! of an unknown [1]
  real(wp), parameter :: least_entries = 30.0_wp                 !! of a grid of few rows [1]

  ! A full strip, without friction and with it, where the matrix is not symmetric: an unknown, and
  ! an entry of its factors. Ten bumps of [Gu2020], 1e4 to 1e6 unknowns.
  real(wp), parameter :: direct_unknown(2) = [2.5e3_wp, 2.85e3_wp]     !! [B]
  real(wp), parameter :: direct_entry(2) = [7.0_wp, 14.0_wp]           !! [B]
  real(wp), parameter :: out_of_core_unknown(2) = [2.1e3_wp, 2.9e3_wp] !! [B]
  real(wp), parameter :: out_of_core_entry(2) = [1.1_wp, 2.2_wp] !! what of it is not in files [B]
  real(wp), parameter :: iterative_unknown(2) = [2.1e3_wp, 2.6e3_wp] !! no factors [B]

  ! A condensed strip, the same: an unknown times those of a line of nodes, of which rows are full.
  real(wp), parameter :: direct_coupling(2) = [140.0_wp, 180.0_wp]      !! [B]
  real(wp), parameter :: out_of_core_coupling(2) = [115.0_wp, 135.0_wp] !! [B]

  ! Modes of a strip: beside its factors the mass of all unknowns, and the two matrices of the
  ! condensed strip, an unknown times those of a line.
  real(wp), parameter :: mass_unknown = 540.0_wp, mode_coupling = 60.0_wp !! [B]

  ! A bearing of shells: an unknown of film, top foil and full bumps, an entry of its factors (foils
  ! lie over each other: more than a strip's), an unknown of condensed bumps times those of a line.
  ! [Gu2020] at 100 N and 30,000 rpm, 1e5 to 3e6 unknowns.
  real(wp), parameter :: bearing_unknown = 3.3e3_wp, bearing_entry = 18.0_wp !! [B]
  real(wp), parameter :: bearing_out_of_core = 2.2e3_wp !! an unknown beside factors in files [B]
  real(wp), parameter :: in_memory = 0.3_wp             !! part of the factors that stays there [1]
  real(wp), parameter :: bearing_iterative = 3.0e3_wp   !! an unknown [B]
  real(wp), parameter :: bearing_coupling = 170.0_wp, bearing_coupling_out_of_core = 135.0_wp !! [B]

  ! A node of a film without shells, one unknown, and of a plate under it, three more.
  real(wp), parameter :: film_node = 2.0e3_wp, plate_node = 2.2e4_wp !! [B]
  real(wp), parameter :: on_each_rank = 0.5_wp !! of that, where each rank has all factors [1]

  ! With heat, two temperatures a film node, which factors of MUMPS tie to all else.
  real(wp), parameter :: heated_node = 1.0e4_wp   !! [B]
  real(wp), parameter :: heated_shells = 1.5_wp   !! of what shells take without [1]

  ! Studies over their answer: complex factors, on half the width also those of motions against the
  ! mirror; by iterations peaks of 364 and 754 MB at 7,465 and 24,650 unknowns on half the width.
  real(wp), parameter :: motion_share = 2.0_wp !! over time, and of orbits [1]
  real(wp), parameter :: vibration_share(2) = [2.3_wp, 3.1_wp] !! whole, half the width [1]
  real(wp), parameter :: iterative_vibration_share(2) = [7.5_wp, 11.5_wp] !! the same [1]

contains

  !> Entries of a symmetric matrix' factors for each unknown of shells on a grid of nodes:
  !> dissection cuts along the shorter side.
  pure real(wp) function factor_entries(stations, rows) result(entries)
    integer, intent(in) :: stations, rows !! of nodes
    entries = max(least_entries, &
                  a_doubling*log(real(max(2, min(stations, rows)), wp))/log(2.0_wp) + narrow)
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
    integer :: kind

    kind = merge(2, 1, friction)
    if (reduced) then
      line = real(node_unknowns*rows, wp)
      if (linear_solver == linear_solver_out_of_core) then
        bytes = unknowns*line*out_of_core_coupling(kind)
      else
        bytes = unknowns*line*direct_coupling(kind)
      end if
      return
    end if
    entries = factor_entries(stations, rows)
    select case (linear_solver)
    case (linear_solver_iterative)
      bytes = unknowns*iterative_unknown(kind)
    case (linear_solver_out_of_core)
      bytes = unknowns*(out_of_core_unknown(kind) + out_of_core_entry(kind)*entries)
    case default
      bytes = unknowns*(direct_unknown(kind) + direct_entry(kind)*entries)
    end select
  end function strip_memory

  !> Modes of a strip: all unknowns with a mass, and the strip of super-elements beside them [B].
  pure real(wp) function modes_memory(unknowns, retained, stations, rows) result(bytes)
    real(wp), intent(in) :: unknowns !! of the equations [1]
    real(wp), intent(in) :: retained      !! of them, where bumps are super-elements [1]
    integer, intent(in) :: stations, rows !! of nodes

    bytes = unknowns*mass_unknown + retained*real(node_unknowns*rows, wp)*mode_coupling + &
            strip_memory(unknowns, stations, rows, .false., .false., linear_solver_direct)
  end function modes_memory

  !> A film without shells [B].
  pure real(wp) function film_memory(nodes, ranks) result(bytes)
    integer, intent(in) :: nodes !! that are solved
    integer, intent(in) :: ranks !! of the job
    bytes = real(nodes, wp)*film_node
    if (nodes <= few_unknowns) bytes = bytes*(1.0_wp + on_each_rank*real(ranks - 1, wp))
  end function film_memory

  !> A plate under its film: three unknowns a node more [B].
  pure real(wp) function plate_memory(nodes) result(bytes)
    integer, intent(in) :: nodes !! that are solved
    bytes = real(nodes, wp)*plate_node
  end function plate_memory

  !> A bearing of shells [B].
  pure function bearing_memory(nodes, bump_unknowns, rows, reduced, linear_solver) result(bytes)
    integer, intent(in) :: nodes              !! of the film, and of the top foil
    real(wp), intent(in) :: bump_unknowns     !! of the bump foil, condensed or not [1]
    integer, intent(in) :: rows               !! of nodes over the width that is solved
    logical, intent(in) :: reduced            !! bumps are condensed
    integer, intent(in) :: linear_solver      !! `linear_solver_direct`, ...
    real(wp) :: bytes
    real(wp) :: an_unknown, a_coupling

    an_unknown = bearing_entry*factor_entries(huge(rows), rows)
    a_coupling = 0.0_wp
    if (linear_solver == linear_solver_iterative) then
      an_unknown = bearing_iterative
    else if (linear_solver == linear_solver_out_of_core) then
      an_unknown = bearing_out_of_core + in_memory*an_unknown
      a_coupling = bearing_coupling_out_of_core
    else
      an_unknown = bearing_unknown + an_unknown
      a_coupling = bearing_coupling
    end if
    bytes = real((node_unknowns + 1)*nodes, wp)*an_unknown
    if (reduced) then
      bytes = bytes + bump_unknowns*real(node_unknowns*rows, wp)*a_coupling
    else
      bytes = bytes + bump_unknowns*an_unknown
    end if
  end function bearing_memory

  !> What a study of a bearing takes, over what its answer does [1].
  pure real(wp) function study_share(scene, half) result(share)
    type(scene_type), intent(in) :: scene !! of a bearing
    logical, intent(in) :: half !! the width is solved
    integer :: width

    width = merge(2, 1, half)
    share = 1.0_wp
    if (scene%transient%present .or. scene%periodic%present) share = motion_share
    if (.not. scene%dynamics%present) return
    share = vibration_share(width)
    if (scene%solver%linear_solver == linear_solver_iterative) then
      share = iterative_vibration_share(width)
    end if
  end function study_share

  !> Memory with two temperatures a film node, which factors of MUMPS tie to all else [B].
  pure real(wp) function heated_memory(scene, nodes, cold) result(bytes)
    type(scene_type), intent(in) :: scene !! of a bearing
    integer, intent(in) :: nodes !! of a pad
    real(wp), intent(in) :: cold !! without heat [B]

    bytes = cold*merge(heated_shells, 1.0_wp, scene%model%foil%has_shell_bumps) &
      + heated_node*real(nodes*scene%bearing%all_pads(), wp)
  end function heated_memory

  !> All ranks together, with what each process takes by itself [B].
  pure real(wp) function rank_memory(bytes, ranks) result(total)
    real(wp), intent(in) :: bytes !! of the equations [B]
    integer, intent(in) :: ranks !! of the job
    total = bytes*(1.0_wp + a_cut*real(min(ranks, cut_ranks) - 1, wp)) + a_rank*real(ranks, wp)
  end function rank_memory
end module gfb_memory_laws
