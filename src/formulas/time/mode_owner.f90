!> Whose a mode of rotor, foil and film is.
!>
!> Against the film the rotor's share of all energy counts. Against the foil it is its share of what
!> moves: with the matrix D of the rotor that film and foil leave, a zero of its determinant at
!> \( \lambda \), and the parts of rotor and foil in its derivative, \( N_r = 2 \lambda M +
!> \Omega G \) and \( N_f \), that of the foil's mass,
!>
!> $$ s = \frac{|p_r|}{|p_r| + |p_f|}, \qquad
!>    p = \mathrm{tr}(\mathrm{adj}(D) \, N) = w^T N q, $$
!>
!> with the right and left vectors q and w of the mode: the participation of the rotor
!> [PerezArriaga1982]. Where nothing is lost or fed it is the rotor's part of the kinetic energy,
!> and what strains belongs to what it carries. Two modes that veer have shares whose sum is 1, in
!> a film that drives as in one that does not, and the same growth where each has half.
module gfb_mode_owner
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: owner_of, is_of_shaft, find_branches, participation

  integer, parameter, public :: of_rotor = 1, of_foil = 2, of_film = 3, of_both = 4
  !> Of the rotor in a mode of its own: the film's have some thousandths, the rotor's a tenth [1].
  real(wp), parameter, public :: least_share = 0.02_wp
  !> Of the rotor in what moves: with less the mode is the foil's, with more the rotor's, between
  !> these both's [1].
  real(wp), parameter :: veering(2) = [0.3_wp, 0.7_wp]
  real(wp), parameter :: apart = 0.1_wp !! rates of modes that veer, over them, at most [1]

contains

  !> Whose a mode is.
  elemental integer function owner_of(share, foil_share, film_share, moving_share) result(owner)
    real(wp), intent(in) :: share      !! of the rotor in all energy [1]
    real(wp), intent(in) :: foil_share, film_share !! of foil and film [1]
    real(wp), intent(in) :: moving_share !! of the rotor in what moves [1]

    owner = of_film
    if (foil_share >= film_share) owner = of_foil
    if (share < least_share .or. moving_share <= veering(1)) return
    owner = of_rotor
    if (moving_share < veering(2)) owner = of_both
  end function owner_of

  !> Whether a mode is the rotor's, or both the rotor's and the foil's.
  elemental logical function is_of_shaft(owner) result(is)
    integer, intent(in) :: owner !! of the mode
    is = owner == of_rotor .or. owner == of_both
  end function is_of_shaft

  !> Which modes are branches of the rotor: those in which it has half of what moves, or more. Of
  !> modes that exchange their motions and have all less, that is the one which has most: so a
  !> branch goes on from one to the other.
  pure function find_branches(owner, moving_share, kind, rate) result(is)
    integer, intent(in) :: owner(:) !! of the modes of an answer
    real(wp), intent(in) :: moving_share(:) !! of the rotor [1]
    integer, intent(in) :: kind(:) !! of the rotor's motion
    complex(wp), intent(in) :: rate(:) !! growth + i frequency [1/s]
    logical :: is(size(owner))
    integer :: i

    is = is_of_shaft(owner)
    do i = 1, size(owner)
      if (.not. is(i) .or. moving_share(i) >= 0.5_wp) cycle
      is(i) = .not. any(is_of_shaft(owner) .and. kind == kind(i) .and. &
                        abs(rate - rate(i)) < apart*abs(rate(i)) .and. &
                        moving_share > moving_share(i))
    end do
  end function find_branches

  !> The rotor's share of what moves, s.
  pure real(wp) function participation(matrix, of_inertia, of_foil_mass) result(share)
    complex(wp), intent(in) :: matrix(2, 2) !! D at its zero [SI]
    complex(wp), intent(in) :: of_inertia(2, 2), of_foil_mass(2, 2) !! N of rotor and foil [SI]
    complex(wp) :: adjugate(2, 2)
    real(wp) :: rotor_part, foil_part

    adjugate = reshape([matrix(2, 2), -matrix(2, 1), -matrix(1, 2), matrix(1, 1)], [2, 2])
    rotor_part = abs(sum(adjugate*transpose(of_inertia)))
    foil_part = abs(sum(adjugate*transpose(of_foil_mass)))
    share = rotor_part/max(tiny(1.0_wp), rotor_part + foil_part)
  end function participation
end module gfb_mode_owner
