#include "gfb_petsc.h"
!> A rigid rotor on two equal bearings that are aligned with it.
!>
!> By symmetry its motions are of two kinds: cylindrical ones, both bearings move alike; conical ones,
!> the rotor turns about its centre of mass and the bearings move against each other. Each has two
!> coordinates q, and with the coefficients Z of one bearing
!>
!> $$ D(\lambda) q = 0, \qquad D = T^T Z(\lambda) T + \lambda^2 M + \lambda \Omega G. $$
!>
!> Cylindrical: q is the displacement, M the mass that a bearing carries. Conical: q is the rotation,
!> which moves the shaft in the bearing at a distance a = L/2 by \( a (q_y, -q_x) \) and turns it by q;
!> M is half the transverse inertia, and the polar one turns the rates of both rotations into each
!> other's torque (gyroscopic), \( G = I_p/2 \, [0, 1; -1, 0] \).
module gfb_rotor
  use gfb_kinds, only: wp
  use gfb_film_surface, only: journal_motions
  implicit none (type, external)
  private
  public :: has_conical, kinds_of, motion_of, inertia_of, gyration_of, dynamic_matrix, planar_part, inertia_rate, determinant, &
            inverse, whirl_sense, words_of_sense

  integer, parameter, public :: cylindrical = 1, conical = 2 !! kinds of motion
  integer, parameter, public :: planar = 2 !! coordinates of each

  !> The rotor; inertias are those of the whole rotor.
  type, public :: rotor_type
    real(wp) :: mass = 0.0_wp                !! that one bearing carries [kg]
    real(wp) :: transverse_inertia = 0.0_wp  !! about an axis through its centre of mass [kg m2]
    real(wp) :: polar_inertia = 0.0_wp       !! about its own axis [kg m2]
    real(wp) :: bearing_distance = 0.0_wp    !! from midplane to midplane [m]
  end type rotor_type

contains

  !> Whether the rotor has conical motions.
  elemental function has_conical(rotor)
    type(rotor_type), intent(in) :: rotor !! with its inertias, where it has
    logical :: has_conical
    has_conical = rotor%transverse_inertia > 0.0_wp
  end function has_conical

  !> The kinds of its motions.
  pure function kinds_of(rotor) result(kinds)
    type(rotor_type), intent(in) :: rotor !! with its inertias, where it has
    integer, allocatable :: kinds(:)

    kinds = [cylindrical]
    if (has_conical(rotor)) kinds = [cylindrical, conical]
  end function kinds_of

  !> Shaft's coordinates in the bearing over the rotor's, T.
  pure function motion_of(rotor, kind) result(motion)
    type(rotor_type), intent(in) :: rotor !! with its bearings' distance
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    real(wp) :: motion(journal_motions, planar) !! [1], [m]

    motion = 0.0_wp
    if (kind == cylindrical) then
      motion(1, 1) = 1.0_wp
      motion(2, 2) = 1.0_wp
    else
      motion(1, 2) = 0.5_wp*rotor%bearing_distance
      motion(2, 1) = -0.5_wp*rotor%bearing_distance
      motion(3, 1) = 1.0_wp
      motion(4, 2) = 1.0_wp
    end if
  end function motion_of

  !> What resists acceleration, a bearing.
  elemental function inertia_of(rotor, kind) result(inertia)
    type(rotor_type), intent(in) :: rotor !! with mass and inertias
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    real(wp) :: inertia !! [kg], [kg m2]
    inertia = merge(rotor%mass, 0.5_wp*rotor%transverse_inertia, kind == cylindrical)
  end function inertia_of

  !> Gyroscopic torque over the other rotation's rate, a bearing: Omega G.
  pure function gyration_of(rotor, kind, speed) result(gyration)
    type(rotor_type), intent(in) :: rotor !! with its polar inertia
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    real(wp), intent(in) :: speed !! of the rotor [rad/s]
    real(wp) :: gyration(planar, planar) !! [N m s]

    gyration = 0.0_wp
    if (kind == cylindrical) return
    gyration(1, 2) = 0.5_wp*rotor%polar_inertia*speed
    gyration(2, 1) = -gyration(1, 2)
  end function gyration_of

  !> D: what a motion \( q e^{\lambda t} \) needs of force or torque.
  pure function dynamic_matrix(rotor, kind, coefficient, rate, speed) result(matrix)
    type(rotor_type), intent(in) :: rotor !! with mass and inertias
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    complex(wp), intent(in) :: coefficient(journal_motions, journal_motions) !! Z of one bearing [SI]
    complex(wp), intent(in) :: rate !! lambda [1/s]
    real(wp), intent(in) :: speed   !! of the rotor [rad/s]
    complex(wp) :: matrix(planar, planar)
    integer :: i

    matrix = planar_part(rotor, kind, coefficient)
    matrix = matrix + rate*gyration_of(rotor, kind, speed)
    do i = 1, planar
      matrix(i, i) = matrix(i, i) + rate**2*inertia_of(rotor, kind)
    end do
  end function dynamic_matrix

  !> What coefficients of a bearing are for the rotor's coordinates, \( T^T Z T \).
  pure function planar_part(rotor, kind, coefficient) result(matrix)
    type(rotor_type), intent(in) :: rotor !! with its bearings' distance
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    complex(wp), intent(in) :: coefficient(journal_motions, journal_motions) !! Z of one bearing, or a derivative [SI]
    complex(wp) :: matrix(planar, planar)
    real(wp) :: motion(journal_motions, planar)

    if (kind == cylindrical) then
      matrix = coefficient(:planar, :planar) ! tilts may be unknown
    else
      motion = motion_of(rotor, kind)
      matrix = matmul(transpose(motion), matmul(coefficient, motion))
    end if
  end function planar_part

  !> The derivative of \( \lambda^2 M + \lambda \Omega G \) by \( \lambda \).
  pure function inertia_rate(rotor, kind, rate, speed) result(matrix)
    type(rotor_type), intent(in) :: rotor !! with mass and inertias
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    complex(wp), intent(in) :: rate !! lambda [1/s]
    real(wp), intent(in) :: speed   !! of the rotor [rad/s]
    complex(wp) :: matrix(planar, planar)
    integer :: i

    matrix = gyration_of(rotor, kind, speed)
    do i = 1, planar
      matrix(i, i) = matrix(i, i) + 2.0_wp*rate*inertia_of(rotor, kind)
    end do
  end function inertia_rate

  !> Inverse of a 2 x 2 matrix.
  pure function inverse(matrix)
    real(wp), intent(in) :: matrix(planar, planar) !! in any unit [SI]
    real(wp) :: inverse(planar, planar)

    inverse = reshape([matrix(2, 2), -matrix(2, 1), -matrix(1, 2), matrix(1, 1)], [planar, planar])
    inverse = inverse/(matrix(1, 1)*matrix(2, 2) - matrix(1, 2)*matrix(2, 1))
  end function inverse

  !> Determinant of a 2 x 2 matrix.
  pure function determinant(matrix)
    complex(wp), intent(in) :: matrix(planar, planar) !! in any unit [SI]
    complex(wp) :: determinant
    determinant = matrix(1, 1)*matrix(2, 2) - matrix(1, 2)*matrix(2, 1)
  end function determinant

  !> How a motion goes round, \( q e^{i \omega t} \) with positive frequency: 1 a circle with the
  !> speed, -1 a circle against it, 0 to and fro.
  pure real(wp) function whirl_sense(q) result(sense)
    complex(wp), intent(in) :: q(planar) !! in any unit [SI]
    sense = -2.0_wp*aimag(conjg(q(1))*q(2))/max(tiny(1.0_wp), sum(abs(q)**2))
  end function whirl_sense

  !> The same in words.
  pure function words_of_sense(sense) result(words)
    real(wp), intent(in) :: sense !! 1 of a circle with the speed [1]
    character(len=:), allocatable :: words
    real(wp), parameter :: circular = 0.05_wp !! a smaller sense goes to and fro [1]

    words = 'to and fro'
    if (sense > circular) words = 'forward'
    if (sense < -circular) words = 'backward'
  end function words_of_sense
end module gfb_rotor
