!> A shaft as its bearings feel it: condensed exactly to the motions of its journals.
!>
!> With the shaft's equations \( H q = r + B^T f \), the journals' motions \( a = B q \) and the
!> rest i, eliminated,
!>
!> $$ S a = g + f, \quad S = H_{bb} - H_{bi} H_{ii}^{-1} H_{ib}, \quad
!>    g = r_b - H_{bi} H_{ii}^{-1} r_i $$
!>
!> [Guyan1965]. S of a shaft at rest that nothing holds is singular, which is right; \( H_{ii} \) is
!> regular as soon as two journals are held, or one with its tilts.
module gfb_held_shaft
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  implicit none (type, external)
  private
  public :: hold_shaft, free_motions

  !> The condensed shaft.
  type, public :: held_shaft_type
    integer, allocatable :: held(:)        !! places of the journals' motions among the shaft's
    integer, allocatable :: free(:)        !! of the rest
    real(wp), allocatable :: stiffness(:, :) !! S [SI]
    real(wp), allocatable :: force(:)      !! g [N], [N m]
    real(wp), allocatable :: follows(:, :) !! the rest over the journals' motions
    real(wp), allocatable :: rest(:)       !! of the rest where journals stand at 0 [m], [1]
  end type held_shaft_type

contains

  !> Condenses a shaft; `.false.` where nothing holds it.
  pure subroutine hold_shaft(matrix, force, place, shaft, regular)
    real(wp), intent(in) :: matrix(:, :) !! H [SI]
    real(wp), intent(in) :: force(:)     !! r [N], [N m]
    integer, intent(in) :: place(:)      !! of the journals' motions among all, each once
    type(held_shaft_type), intent(out) :: shaft
    logical, intent(out) :: regular
    real(wp), allocatable :: right(:, :)
    integer :: i

    shaft%held = place
    shaft%free = pack([(i, i=1, size(force))], [(all(place /= i), i=1, size(force))])
    associate (b => shaft%held, f => shaft%free, n => size(place))
      allocate (right(size(f), n + 1))
      right(:, :n) = -matrix(f, b)
      right(:, n + 1) = force(f)
      call solve_general(matrix(f, f), right, regular)
      if (.not. regular) return
      shaft%follows = right(:, :n)
      shaft%rest = right(:, n + 1)
      shaft%stiffness = matrix(b, b) + matmul(matrix(b, f), right(:, :n))
      shaft%force = force(b) - matmul(matrix(b, f), right(:, n + 1))
    end associate
  end subroutine hold_shaft

  !> All motions of the shaft where its journals have theirs.
  pure function free_motions(shaft, motion) result(all_motions)
    type(held_shaft_type), intent(in) :: shaft
    real(wp), intent(in) :: motion(:) !! a, of the journals [m], [rad]
    real(wp) :: all_motions(size(shaft%held) + size(shaft%free)) !! q [m], [1]

    all_motions(shaft%held) = motion
    all_motions(shaft%free) = shaft%rest + matmul(shaft%follows, motion)
  end function free_motions
end module gfb_held_shaft
