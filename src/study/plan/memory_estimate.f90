!> What memory a scene will take, before anything is built.
!>
!> Laws in the number of unknowns, the rows of nodes and the linear solver, fitted to measured
!> peaks: docs/manual/linear_solvers.md has the table. They hold within a factor of 1.5.
module gfb_memory_estimate
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: node_unknowns
  use gfb_solver_case, only: linear_solver_direct, linear_solver_out_of_core, &
                             linear_solver_iterative
  implicit none (type, external)
  private
  public :: strip_memory, bearing_memory, modes_memory, film_memory, rank_memory, factor_entries

  real(wp), parameter, public :: stated_factor = 1.5_wp !! estimate and peak differ by no more

  real(wp), parameter :: a_rank = 45.0e6_wp       !! a process with its libraries [B]
  real(wp), parameter :: a_film_node = 2.0e3_wp   !! one unknown, and its equation's factors [B]

contains

  !> Entries of a symmetric matrix' factors for each unknown of shells on a grid of nodes:
  !> dissection cuts along the shorter side.
  pure function factor_entries(stations, rows) result(entries)
    integer, intent(in) :: stations, rows !! of nodes
    real(wp) :: entries
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
    real(wp) :: bytes
    real(wp) :: entries, line

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
  pure function modes_memory(unknowns, retained, stations, rows) result(bytes)
    real(wp), intent(in) :: unknowns !! of the equations [1]
    real(wp), intent(in) :: retained      !! of them, where bumps are super-elements [1]
    integer, intent(in) :: stations, rows !! of nodes
    real(wp) :: bytes
    real(wp), parameter :: a_mass = 540.0_wp       !! of an unknown [B]
    real(wp), parameter :: two_matrices = 60.0_wp !! of an unknown times those of a line [B]

    bytes = unknowns*a_mass + retained*real(node_unknowns*rows, wp)*two_matrices + &
            strip_memory(unknowns, stations, rows, .false., .false., linear_solver_direct)
  end function modes_memory

  !> A film without shells [B].
  pure function film_memory(nodes) result(bytes)
    integer, intent(in) :: nodes !! that are solved
    real(wp) :: bytes
    bytes = real(nodes, wp)*a_film_node
  end function film_memory

  !> A bearing of shells [B].
  pure function bearing_memory(nodes, bump_unknowns, rows, reduced, linear_solver) result(bytes)
    integer, intent(in) :: nodes              !! of the film, and of the top foil
    real(wp), intent(in) :: bump_unknowns     !! of the bump foil, condensed or not [1]
    integer, intent(in) :: rows               !! of nodes over the width that is solved
    logical, intent(in) :: reduced            !! bumps are condensed
    integer, intent(in) :: linear_solver      !! `linear_solver_direct`, ...
    real(wp) :: bytes
    real(wp), parameter :: an_entry = 15.0_wp !! of factors; foils lie over each other [B]
    real(wp), parameter :: in_files = 0.35_wp !! of the factors stays in memory
    real(wp) :: an_unknown, a_coupling

    an_unknown = an_entry*factor_entries(huge(rows), rows)
    if (linear_solver == linear_solver_out_of_core) then
      an_unknown = 3.5e3_wp + in_files*an_unknown
      a_coupling = 200.0_wp
    else
      an_unknown = 4.3e3_wp + an_unknown
      a_coupling = 225.0_wp
    end if
    bytes = real((node_unknowns + 1)*nodes, wp)*an_unknown
    if (reduced) then
      bytes = bytes + bump_unknowns*real(node_unknowns*rows, wp)*a_coupling
    else
      bytes = bytes + bump_unknowns*an_unknown
    end if
  end function bearing_memory

  !> All ranks together, with what each process takes by itself [B].
  pure function rank_memory(bytes, ranks) result(total)
    real(wp), intent(in) :: bytes !! of the equations [B]
    integer, intent(in) :: ranks !! of the job
    real(wp) :: total
    real(wp), parameter :: a_cut = 0.1_wp !! a further rank adds for ghosts, messages, whole tables
    total = bytes*(1.0_wp + a_cut*real(min(ranks, 8) - 1, wp)) + a_rank*real(ranks, wp)
  end function rank_memory
end module gfb_memory_estimate
