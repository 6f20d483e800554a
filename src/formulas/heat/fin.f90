!> A rod that conducts heat along itself and gives some of it to its surroundings.
!>
!> With the rise t over the surroundings it is \( k A t'' = h P t \). Between its ends, L apart,
!> and from each end flow
!>
!> $$ e (t_1 - t_2), \quad s\, t_i; \qquad e = \frac{k A m}{\sinh m L}, \quad
!>    s = k A m \tanh \frac{m L}{2}, \quad m^2 = \frac{h P}{k A} $$
!>
!> to the last digit, however long the rod is.
module gfb_fin
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: fin_conductances

  !> m L beyond which nothing arrives at the other end; sinh of more may be too large a number.
  real(wp), parameter :: longest = 700.0_wp

contains

  !> Conductance between the ends of a rod, and from each end to the surroundings.
  elemental subroutine fin_conductances(along, across, length, between, lost)
    real(wp), intent(in) :: along  !! k A [W m/K]
    real(wp), intent(in) :: across !! h P [W/(m K)]
    real(wp), intent(in) :: length !! L [m]
    real(wp), intent(out) :: between !! e [W/K]
    real(wp), intent(out) :: lost    !! s [W/K]
    real(wp) :: m

    between = along/length
    lost = 0.0_wp
    if (.not. across > 0.0_wp) return
    m = sqrt(across/along)
    between = along*m/sinh(min(m*length, longest))
    lost = along*m*tanh(0.5_wp*m*length)
  end subroutine fin_conductances
end module gfb_fin
