!> Sleeves that move on supports, and what they make of the motions of a machine.
!>
!> A film feels how its journal moves in its sleeve. With that, \( a = s - o \), in the place of the
!> journal's own motion s among all, and the sleeve's o behind them, motions and forces are
!>
!> $$ q = T q', \quad s = a + o, \quad r' = T^T r, \quad M' = T^T M T, $$
!>
!> and what films feel are some of the motions q', as where sleeves are at rest.
module gfb_moving_sleeves
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: true_motions, forces_on_motions, relative_motions, true_of_relative

  !> A sleeve on a support.
  type, public :: moving_sleeve_type
    integer :: place(2) = 0   !! of its motions along x and y among all
    integer :: journal(2) = 0 !! of its journal's
  end type moving_sleeve_type

  !> Motions q of those, q', that have journals relative to their sleeves.
  interface true_motions
    module procedure true_real_motions, true_complex_motions
  end interface true_motions

  !> Forces r' on motions q' of those, r, on q.
  interface forces_on_motions
    module procedure real_forces, complex_forces
  end interface forces_on_motions

contains

  !> Motions q of q'.
  pure function true_real_motions(sleeve, motion) result(true)
    type(moving_sleeve_type), intent(in) :: sleeve(:)
    real(wp), intent(in) :: motion(:) !! q' [m], [1]
    real(wp) :: true(size(motion))
    true = real(true_complex_motions(sleeve, cmplx(motion, 0.0_wp, wp)), wp)
  end function true_real_motions

  !> The same of amplitudes.
  pure function true_complex_motions(sleeve, motion) result(true)
    type(moving_sleeve_type), intent(in) :: sleeve(:)
    complex(wp), intent(in) :: motion(:) !! q' [m], [1]
    complex(wp) :: true(size(motion))
    integer :: i

    true = motion
    do i = 1, size(sleeve)
      associate (s => sleeve(i)%journal, o => sleeve(i)%place)
        true(s) = true(s) + motion(o)
      end associate
    end do
  end function true_complex_motions

  !> Forces r' of r.
  pure function real_forces(sleeve, force) result(forces)
    type(moving_sleeve_type), intent(in) :: sleeve(:)
    real(wp), intent(in) :: force(:) !! r [N], [N m]
    real(wp) :: forces(size(force))
    forces = real(complex_forces(sleeve, cmplx(force, 0.0_wp, wp)), wp)
  end function real_forces

  !> The same of amplitudes.
  pure function complex_forces(sleeve, force) result(forces)
    type(moving_sleeve_type), intent(in) :: sleeve(:)
    complex(wp), intent(in) :: force(:) !! r [N], [N m]
    complex(wp) :: forces(size(force))
    integer :: i

    forces = force
    do i = 1, size(sleeve)
      associate (s => sleeve(i)%journal, o => sleeve(i)%place)
        forces(o) = forces(o) + force(s)
      end associate
    end do
  end function complex_forces

  !> Columns of motions q as columns of q'.
  pure function relative_motions(sleeve, columns) result(relative)
    type(moving_sleeve_type), intent(in) :: sleeve(:)
    real(wp), intent(in) :: columns(:, :) !! (motion, column) [m], [1]
    real(wp) :: relative(size(columns, 1), size(columns, 2))
    integer :: i

    relative = columns
    do i = 1, size(sleeve)
      associate (s => sleeve(i)%journal, o => sleeve(i)%place)
        relative(s, :) = relative(s, :) - columns(o, :)
      end associate
    end do
  end function relative_motions

  !> T.
  pure function true_of_relative(sleeve, count) result(matrix)
    type(moving_sleeve_type), intent(in) :: sleeve(:)
    integer, intent(in) :: count !! of all motions
    real(wp) :: matrix(count, count)
    integer :: i

    matrix = 0.0_wp
    do i = 1, count
      matrix(i, i) = 1.0_wp
      matrix(:, i) = true_motions(sleeve, matrix(:, i))
    end do
  end function true_of_relative
end module gfb_moving_sleeves
