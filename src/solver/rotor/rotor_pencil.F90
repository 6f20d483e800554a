#include "gfb_petsc.h"
!> Eigenvalues of film, foil and rotor together.
!>
!> With the film's and foil's unknowns u, the rotor's coordinates q and their rates v all motions
!> \( e^{\lambda t} \) obey
!>
!> $$ (J + \lambda E) u + (r_q + \lambda c_q) T q = 0, \quad v = \lambda q, \quad
!>    \lambda M v + \Omega G v + f(u, q) = 0, $$
!>
!> that is \( (A + \lambda B) x = 0 \) with a singular B. The eigenvalues next to a real shift \( \sigma \)
!> are those of \( (A + \sigma B)^{-1} B \) with the largest modulus, \( 1/(\sigma - \lambda) \). Its product
!> with a vector takes the factors of \( J + \sigma E \), which the coefficients \( Z(\sigma) \) have made, and
!> the 2 x 2 matrix \( D(\sigma) \) of the rotor: film and foil are eliminated. On half the width a conical
!> motion has an even and an odd share, each with a u of its own; that of shells is of another bearing. A foil of
!> mass m has rates \( w = \lambda u \) and \( \lambda m w \) in the first equation, without modes inside pieces.
!>
!> Springs with dampers relax alone at \( \lambda = -1/\tau \), one rate a spring, and with the film next to it: there
!> \( (1 + \lambda\tau) k d = p \), so in the disc \( |\lambda + 1/\tau| < \rho \) pressures are less than \( \rho\tau \)
!> of the springs' forces. Its rates, of which there is no end, are not looked for.
module gfb_rotor_pencil
  use petscvec
  use petscksp
  use slepceps
  use, intrinsic :: iso_c_binding, only: c_ptr, c_f_pointer
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank
  use gfb_rotor, only: planar, rotor_type, motion_of, inertia_of, gyration_of, dynamic_matrix, planar_part, inertia_rate, &
       inverse, cylindrical
  use gfb_mode_owner, only: participation
  use gfb_bearing_system, only: bearing_system_type
  use gfb_petsc_kinds, only: pint
  use gfb_film_surface, only: journal_motions
  use gfb_dynamic_response, only: dynamic_response_type, find_coefficients, find_sample, take_over_counts, forces_of
  use gfb_vibration_equations, only: vibration_equations_type, has_linear_parts, has_crowds, rate_at_rest
  use gfb_pencil_share, only: rotor_scale_type, share_type, take_rotor, put_rotor, entries_of, solve_film, add_momentum, &
       put_rates, take_film, put_film, energies_of, energy_unit, start_film, weigh_foil
  implicit none (type)
  private
  public :: find_pencil_modes, has_pencil, find_moving_share, skip_inner_modes, relaxation_of

  character(len=*), parameter :: prefix = 'rotor_' !! of PETSc's options
  integer, parameter :: krylov_room = 36      !! vectors kept beyond them
  integer, parameter :: most_restarts = 50    !! of the iteration that finds them
  real(wp), parameter :: tolerance = 1.0e-10_wp !! of the eigenvalues, relative

  real(wp), parameter :: infinite = 1.0e-9_wp !! a smaller eigenvalue of the product times the shift is nothing [1]

  !> An eigenvalue and what moves with it.
  type, public :: pencil_mode_type
    complex(wp) :: rate = 0.0_wp        !! lambda, its imaginary part not negative [1/s]
    complex(wp) :: motion(planar) = 0.0_wp !! of the rotor, of any size
    real(wp) :: share = 0.0_wp          !! of the rotor in the mode, 0 .. 1 [1]
    real(wp) :: foil_share = 0.0_wp     !! of the foil, 0 .. 1 [1]
    real(wp) :: film_share = 0.0_wp     !! of the film, 0 .. 1 [1]
    real(wp) :: moving_share = 0.0_wp   !! of the rotor in the kinetic energy of rotor and foil, 0 .. 1 [1]
  end type pencil_mode_type

  real(wp), parameter :: unnoticed = 0.1_wp !! pressures that relaxing springs are not held by, over their forces [1]

  !> The disc about the rate at which springs relax.
  type, public :: relaxation_type
    logical :: present = .false. !! springs have dampers
    real(wp) :: rate = 0.0_wp   !! its centre, -1/tau [1/s]
    real(wp) :: radius = 0.0_wp !! [1/s]
  contains
    procedure :: has => relaxation_has
  end type relaxation_type

  !> What the product needs.
  type :: pencil_type
    type(share_type), allocatable :: share(:)
    real(wp) :: motion(journal_motions, planar) = 0.0_wp !! T
    real(wp) :: shift = 0.0_wp                !! sigma [1/s]
    type(rotor_scale_type) :: scale
    real(wp) :: inertia = 0.0_wp              !! [kg], [kg m2]
    real(wp) :: gyration(planar, planar) = 0.0_wp
    real(wp) :: flexibility(planar, planar) = 0.0_wp !! inverse of D at the shift
    type(relaxation_type) :: left_out         !! modes that are not looked for
  end type pencil_type

contains

  !> Whether modes can be found as eigenvalues, and counted: all parts of the equations are linear in lambda, and none of them brings a
  !> crowd of eigenvalues. Viscous losses of a mesh put a rate next to -1/tau for each of its unknowns, and the phase of the
  !> determinant turns too fast to be followed.
  pure function has_pencil(equations)
    type(vibration_equations_type), intent(in) :: equations !! of a bearing
    logical :: has_pencil
    has_pencil = has_linear_parts(equations) .and. .not. has_crowds(equations)
  end function has_pencil

  !> Whether a rate lies in the disc.
  elemental logical function relaxation_has(self, rate) result(has)
    class(relaxation_type), intent(in) :: self !! the disc
    complex(wp), intent(in) :: rate !! [1/s]
    has = self%present .and. abs(rate - self%rate) < self%radius
  end function relaxation_has

  !> The disc of a bearing's springs.
  pure type(relaxation_type) function relaxation_of(response) result(relaxation)
    type(dynamic_response_type), intent(in) :: response !! of a bearing
    associate (equations => response%equations, time => response%equations%vibration%damping_time)
      relaxation%present = time > 0.0_wp .and. has_pencil(equations) .and. .not. equations%inertia%present
      if (relaxation%present) relaxation = relaxation_type(.true., -1.0_wp/time, unnoticed/time)
    end associate
  end function relaxation_of

  !> Modes next to a real shift, nearest first, one of each complex pair.
  subroutine find_pencil_modes(bearing, response, rotor, kind, shift, wanted, modes, reach, found, left_out)
    type(bearing_system_type), target, intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), target, intent(inout) :: response !! of it, with a pencil
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    real(wp), intent(in) :: shift !! sigma, no eigenvalue [1/s]
    integer, intent(in) :: wanted !! modes, each of a complex pair
    type(pencil_mode_type), allocatable, intent(out) :: modes(:) !! none where the iteration finds none
    real(wp), intent(out) :: reach !! distance of the last mode from the shift; huge where there are no more [1/s]
    logical, intent(out) :: found !! the matrix could be factorized
    type(relaxation_type), intent(in), optional :: left_out !! whose modes are not looked for
    type(pencil_type), target :: pencil
    complex(wp) :: coefficient(journal_motions, journal_motions)

    allocate (modes(0))
    reach = 0.0_wp
    call skip_inner_modes(response, .true.)
    call find_coefficients(bearing, response, cmplx(shift, 0.0_wp, wp), coefficient, found, &
                           only_translations=kind == cylindrical, keep=.true.)
    call skip_inner_modes(response, .false.)
    if (.not. found) return
    pencil%shift = shift
    if (present(left_out)) pencil%left_out = left_out
    pencil%scale%clock = shift
    pencil%scale%length = bearing%clearance
    if (kind /= cylindrical) pencil%scale%length = 2.0_wp*pencil%scale%length/rotor%bearing_distance
    pencil%motion = motion_of(rotor, kind)
    pencil%inertia = inertia_of(rotor, kind)
    pencil%gyration = gyration_of(rotor, kind, bearing%point%speed)
    pencil%flexibility = inverse(real(dynamic_matrix(rotor, kind, coefficient, cmplx(shift, 0.0_wp, wp), bearing%point%speed), wp))
    allocate (pencil%share(merge(2, 1, kind /= cylindrical .and. (size(response%part) == 2 .or. allocated(response%opposite)))))
    call create_share(pencil, bearing, response, 1, pencil%share(1))
    if (size(pencil%share) == 2) then
      pencil%share(2)%first = entries_of(pencil%share(1))
      if (allocated(response%opposite)) then
        call create_share(pencil, response%opposite_bearing, response%opposite, 1, pencil%share(2))
      else
        call create_share(pencil, bearing, response, 2, pencil%share(2))
      end if
    end if
    call solve_pencil(pencil, wanted, modes, reach)
    call destroy_pencil(pencil)
  end subroutine find_pencil_modes

  !> Leaves modes inside condensed pieces of the foils out of the matrix that is combined next, or not.
  subroutine skip_inner_modes(response, skips)
    type(dynamic_response_type), intent(inout) :: response !! of a bearing
    logical, intent(in) :: skips !! they are left out

    response%equations%inertia%skips_modes = skips
    if (allocated(response%opposite)) response%opposite%equations%inertia%skips_modes = skips
  end subroutine skip_inner_modes

  !> E, and the film's answers to motions of the rotor at the shift.
  subroutine create_share(pencil, bearing, response, number, share)
    type(pencil_type), intent(in) :: pencil
    type(bearing_system_type), target, intent(in) :: bearing
    type(dynamic_response_type), target, intent(inout) :: response
    integer, intent(in) :: number !! of the response's part
    type(share_type), intent(inout) :: share
    PetscInt :: entries
    PetscErrorCode :: ierr
    integer :: i, k

    share%bearing => bearing
    share%response => response
    share%part = number
    share%solver => response%part(number)%solver
    share%kept => response%part(number)%kept
    share%one = response%one
    share%other = response%other
    share%steady = response%equations%steady
    PetscCallA(VecGetLocalSize(bearing%state, entries, ierr))
    share%entries = int(entries)
    share%has_mass = response%equations%inertia%present
    if (share%has_mass) share%mass = response%equations%inertia%mass
    PetscCallA(VecDuplicate(bearing%state, share%work, ierr))
    call weigh_foil(share)
    call rate_at_rest(response%equations, share%rate)
    do i = 1, planar
      PetscCallA(VecDuplicate(bearing%state, share%column(i), ierr))
      PetscCallA(VecSet(response%one, 0.0_wp, ierr))
      associate (coordinate => response%part(number)%coordinate)
        do k = 1, size(coordinate)
          associate (factor => pencil%motion(coordinate(k), i))
            PetscCallA(VecAXPY(response%one, factor, response%steady_column(coordinate(k)), ierr))
            PetscCallA(VecAXPY(response%one, factor*pencil%shift, response%squeeze_column(coordinate(k)), ierr))
          end associate
        end do
      end associate
      call solve_film(share, response%one, share%column(i))
    end do
  end subroutine create_share

  !> Krylov-Schur's method for the eigenvalues of the product with the largest modulus.
  subroutine solve_pencil(pencil, wanted, modes, reach)
    type(pencil_type), target, intent(inout) :: pencil
    integer, intent(in) :: wanted
    type(pencil_mode_type), allocatable, intent(out) :: modes(:)
    real(wp), intent(out) :: reach !! [1/s]
    Mat :: operator
    EPS :: solver
    Vec :: real_part, imaginary_part, left
    PetscInt :: mine, all, columns, found, i
    PetscScalar :: re, im
    PetscErrorCode :: ierr
    type(pencil_mode_type) :: one

    mine = int(sum(entries_of(pencil%share)) + merge(2*planar, 0, this_rank() == 0), pint)
    PetscCallA(MatCreateShell(PETSC_COMM_WORLD, mine, mine, PETSC_DETERMINE, PETSC_DETERMINE, pencil, operator, ierr))
    PetscCallA(MatShellSetOperation(operator, MATOP_MULT, apply_pencil, ierr))
    PetscCallA(MatCreateVecs(operator, real_part, left, ierr))
    PetscCallA(VecDuplicate(real_part, imaginary_part, ierr))
    PetscCallA(MatGetSize(operator, all, columns, ierr))
    PetscCallA(EPSCreate(PETSC_COMM_WORLD, solver, ierr))
    PetscCallA(EPSSetOptionsPrefix(solver, prefix, ierr))
    PetscCallA(EPSSetOperators(solver, operator, PETSC_NULL_MAT, ierr))
    PetscCallA(EPSSetProblemType(solver, EPS_NHEP, ierr))
    PetscCallA(EPSSetWhichEigenpairs(solver, EPS_LARGEST_MAGNITUDE, ierr))
    PetscCallA(EPSSetTolerances(solver, tolerance, int(most_restarts, pint), ierr))
    call leave_out(pencil, solver)
    PetscCallA(EPSSetDimensions(solver, min(int(wanted, pint), all), min(int(wanted + krylov_room, pint), all), PETSC_DEFAULT_INTEGER, ierr))
    PetscCallA(EPSSetFromOptions(solver, ierr))
    ! A start without any symmetry, which no mode may lack, and without random numbers, on which a run would depend.
    PetscCallA(VecSet(left, 0.0_wp, ierr))
    do i = 1, size(pencil%share)
      call start_film(pencil%share(i), left)
    end do
    call put_rotor(pencil%scale, pencil%scale%length*[1.0_wp, 0.5_wp], pencil%scale%length*pencil%scale%clock*[0.25_wp, 0.5_wp], left)
    PetscCallA(EPSSetInitialSpace(solver, 1_pint, [left], ierr))
    PetscCallA(EPSSolve(solver, ierr))
    PetscCallA(EPSGetConverged(solver, found, ierr))
    allocate (modes(0))
    reach = 0.0_wp
    if (found >= all) reach = huge(1.0_wp)
    do i = 0, found - 1
      PetscCallA(EPSGetEigenpair(solver, i, re, im, real_part, imaginary_part, ierr))
      if (hypot(re, im) <= infinite/pencil%shift) then
        reach = huge(1.0_wp)
        exit
      end if
      one%rate = pencil%shift - 1.0_wp/cmplx(re, im, wp)
      if (pencil%left_out%has(one%rate)) cycle
      reach = max(reach, 1.0_wp/hypot(re, im))
      if (im < 0.0_wp) cycle
      call weigh(pencil, real_part, imaginary_part, one)
      modes = [modes, one]
    end do
    PetscCallA(EPSDestroy(solver, ierr))
    PetscCallA(VecDestroy(real_part, ierr))
    PetscCallA(VecDestroy(imaginary_part, ierr))
    PetscCallA(VecDestroy(left, ierr))
    PetscCallA(MatDestroy(operator, ierr))
  end subroutine solve_pencil

  !> Puts eigenvalues of the product behind all others where the rates are left out: a disc about a real rate becomes one.
  subroutine leave_out(pencil, solver)
    type(pencil_type), intent(in) :: pencil
    EPS, intent(in) :: solver
    RG :: wanted
    real(wp) :: distance, scale
    PetscErrorCode :: ierr

    if (.not. pencil%left_out%present) return
    distance = pencil%shift - pencil%left_out%rate
    scale = distance**2 - pencil%left_out%radius**2
    PetscCallA(EPSGetRG(solver, wanted, ierr))
    PetscCallA(RGSetType(wanted, RGELLIPSE, ierr))
    PetscCallA(RGEllipseSetParameters(wanted, distance/scale, pencil%left_out%radius/scale, 1.0_wp, ierr))
    PetscCallA(RGSetComplement(wanted, PETSC_TRUE, ierr))
  end subroutine leave_out

  !> PETSc callback: the product of (A + sigma B)^-1 B with a vector.
  subroutine apply_pencil(operator, x, y, ierr)
    Mat :: operator
    Vec :: x, y
    PetscErrorCode, intent(out) :: ierr
    type(c_ptr) :: address
    type(pencil_type), pointer :: pencil
    real(wp) :: q(planar), v(planar), force(planar), new_q(planar)
    integer :: i, k

    call GFB_MatShellGetContext(operator, address, ierr)
    call c_f_pointer(address, pencil)
    call take_rotor(pencil%scale, x, q, v)
    force = pencil%inertia*v + matmul(pencil%gyration, q) + pencil%inertia*pencil%shift*q
    do i = 1, size(pencil%share)
      associate (share => pencil%share(i), response => pencil%share(i)%response)
        associate (part => response%part(share%part))
          call take_film(share, x, response%one)
          PetscCallA(MatMult(share%rate, response%one, response%other, ierr))
          if (share%has_mass) call add_momentum(share, pencil%shift, x, response%one, response%other)
          do k = 1, size(part%coordinate)
            PetscCallA(VecAXPY(response%other, dot_product(pencil%motion(part%coordinate(k), :), q), response%squeeze_column(part%coordinate(k)), ierr))
          end do
          call solve_film(share, response%other, response%one)
          ! Forces of minus a change: the rotor's equation has them on the other side.
          force = force + matmul(transpose(pencil%motion(part%coordinate, :)), &
                                 forces_of(share%bearing, response, part, 1, 0.0_wp, response%one))
          call put_film(share, response%one, y)
        end associate
      end associate
    end do
    new_q = matmul(pencil%flexibility, force)
    do i = 1, size(pencil%share)
      associate (share => pencil%share(i), one => pencil%share(i)%response%one)
        call take_film(share, y, one)
        do k = 1, planar
          PetscCallA(VecAXPY(one, -new_q(k), share%column(k), ierr))
        end do
        call put_film(share, one, y)
        if (share%has_mass) call put_rates(share, pencil%shift, x, one, y)
      end associate
    end do
    call put_rotor(pencil%scale, new_q, pencil%shift*new_q - q, y)
    ierr = 0
  end subroutine apply_pencil

  !> The rotor's motion in a mode, and what share it has. Its displacement in the bearing over the clearance, squared,
  !> stands for an energy \( p_a C A / 2 \) of a film that is trapped; beside it are what the film stores by its pressures
  !> and the foil's strain and kinetic energy (`energies_of`). That is multiplied by the rotor's part of the kinetic energy
  !> of rotor and foil, so that a foil that takes a heavy rotor along by next to nothing is not the rotor. That part shows
  !> rotor from foil: where either vibrates by itself it is half of the energy, and the other half strains what carries it.
  subroutine weigh(pencil, real_part, imaginary_part, mode)
    type(pencil_type), intent(in) :: pencil
    Vec, intent(in) :: real_part, imaginary_part
    type(pencil_mode_type), intent(inout) :: mode
    real(wp) :: re(planar), im(planar), v(planar), of_rotor, energies(3), of_foil, mass
    integer :: i

    call take_rotor(pencil%scale, real_part, re, v)
    call take_rotor(pencil%scale, imaginary_part, im, v)
    if (aimag(mode%rate) <= 0.0_wp) im = 0.0_wp ! then not written
    mode%motion = cmplx(re, im, wp)/pencil%scale%length
    of_rotor = sum(abs(mode%motion)**2)
    energies = 0.0_wp
    do i = 1, size(pencil%share)
      energies = energies + energies_of(pencil%share(i), real_part)
      if (aimag(mode%rate) > 0.0_wp) energies = energies + energies_of(pencil%share(i), imaginary_part)
    end do
    of_foil = energies(2) + energies(3)*abs(mode%rate)**2
    mass = pencil%inertia*pencil%scale%length**2/energy_unit(pencil%share(1))
    associate (all => max(tiny(1.0_wp), of_rotor + energies(1) + of_foil), &
               moving => max(tiny(1.0_wp), mass*of_rotor + energies(3)))
      mode%moving_share = mass*of_rotor/moving
      mode%share = of_rotor/all*mode%moving_share
      mode%foil_share = of_foil/all
      mode%film_share = energies(1)/all
    end associate
  end subroutine weigh

  !> The rotor's share of what moves in a mode (`gfb_mode_owner`); without the foil's mass, or where it cannot be solved for, it stays
  !> the rotor's part of the kinetic energy.
  subroutine find_moving_share(bearing, response, rotor, kind, mode)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it, with a pencil
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    type(pencil_mode_type), intent(inout) :: mode !! that vibrates
    complex(wp), dimension(journal_motions, journal_motions) :: z, slope, without_mass
    logical :: found(2)

    if (.not. response%equations%inertia%present) return
    call skip_inner_modes(response, .true.)
    call find_slopes(bearing, response, kind, mode%rate, .false., z, slope, found(1))
    call find_slopes(bearing, response, kind, mode%rate, .true., z, without_mass, found(2))
    call skip_inner_modes(response, .false.)
    if (.not. all(found)) return
    associate (speed => bearing%point%speed)
      mode%moving_share = participation(dynamic_matrix(rotor, kind, z, mode%rate, speed), inertia_rate(rotor, kind, mode%rate, speed), &
                                        planar_part(rotor, kind, slope - without_mass))
    end associate
  end subroutine find_moving_share

  !> Z of a rate and its derivative, of the motions of a kind.
  subroutine find_slopes(bearing, response, kind, rate, without_mass, z, slope, found)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    integer, intent(in) :: kind
    complex(wp), intent(in) :: rate !! [1/s]
    logical, intent(in) :: without_mass !! the derivative lacks the foil's
    complex(wp), intent(out) :: z(:, :), slope(:, :) !! 0 by symmetry, or where they are not asked for [SI]
    logical, intent(out) :: found
    integer :: i

    z = 0.0_wp
    slope = 0.0_wp
    found = .true.
    do i = 1, merge(1, size(response%part), kind == cylindrical)
      if (found) call add_part(bearing, response, i)
    end do
    if (kind == cylindrical .or. .not. (found .and. allocated(response%opposite))) return
    call add_part(response%opposite_bearing, response%opposite, 1)
    call take_over_counts(response)

  contains

    !> Adds those of a part's coordinates.
    subroutine add_part(its_bearing, its_response, number)
      type(bearing_system_type), intent(in) :: its_bearing
      type(dynamic_response_type), intent(inout) :: its_response
      integer, intent(in) :: number !! of its part
      integer, allocatable :: k(:)
      complex(wp), allocatable :: value(:, :), change(:, :)

      k = its_response%part(number)%coordinate
      allocate (value(size(k), size(k)), change(size(k), size(k)))
      call find_sample(its_bearing, its_response, number, rate, value, change, found, without_mass)
      if (.not. found) return
      z(k, k) = value
      slope(k, k) = change
    end subroutine add_part
  end subroutine find_slopes

  !> Frees what PETSc holds.
  subroutine destroy_pencil(pencil)
    type(pencil_type), intent(inout) :: pencil
    PetscErrorCode :: ierr
    integer :: i, k

    do i = 1, size(pencil%share)
      PetscCallA(MatDestroy(pencil%share(i)%rate, ierr))
      PetscCallA(VecDestroy(pencil%share(i)%work, ierr))
      if (pencil%share(i)%has_foil) then
        PetscCallA(VecDestroy(pencil%share(i)%foil, ierr))
      end if
      do k = 1, planar
        PetscCallA(VecDestroy(pencil%share(i)%column(k), ierr))
      end do
    end do
  end subroutine destroy_pencil
end module gfb_rotor_pencil
