#include "gfb_petsc.h"
!> Whose a mode of a machine is: shares of its energy.
!>
!> Of each bearing that is what the film stores by its pressures, and the foil's strain and kinetic
!> energy, as for the modes of a rotor (`energies_of`); of the shaft its strain and kinetic energy,
!> all means over a turn of the mode.
module gfb_machine_shares
  use petscvec
  use gfb_kinds, only: wp
  use gfb_machine, only: machine_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type
  use gfb_pencil_share, only: share_type, energies_of, energy_unit, weigh_foil
  use gfb_machine_linear, only: linear_bearing_type, journal_motion
  implicit none (type)
  private
  public :: find_shares

contains

  !> Shares of each bearing's film and foil; the rest is the shaft's.
  subroutine find_shares(machine, linear, rate, motion, share, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! with the factors of the mode's rate, or next to it
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(in) :: motion(:) !! of all that moves, as the machine's equations have it [m], [1]
    real(wp), allocatable, intent(out) :: share(:) !! a bearing each [1]
    logical, intent(out) :: found !! films and foils could be solved for
    real(wp) :: of_shaft, of_film
    complex(wp), allocatable :: own(:)
    integer :: i, k

    allocate (share(size(linear)), source=0.0_wp)
    associate (equations => machine%equations)
      of_shaft = real(dot_product(motion, matmul(equations%stiffness, motion) + abs(rate)**2*matmul(equations%mass, motion)), wp)
    end associate
    found = .true.
    do i = 1, size(linear)
      associate (coordinate => linear(i)%response%motion)
        own = journal_motion(machine, i, coordinate, motion)
      end associate
      do k = 1, size(linear(i)%response%part)
        if (.not. any(abs(own(linear(i)%response%part(k)%coordinate)) > 0.0_wp)) cycle
        call find_energy(linear(i)%bearing, linear(i)%response, k, rate, own, of_film, found)
        if (.not. found) return
        share(i) = share(i) + of_film
      end do
    end do
    share = share/max(tiny(1.0_wp), of_shaft + sum(share))
  end subroutine find_shares

  !> Twice the energy of film and foil in a part's motions.
  subroutine find_energy(bearing, response, number, rate, motion, energy, found)
    type(bearing_system_type), target, intent(in) :: bearing
    type(dynamic_response_type), target, intent(inout) :: response !! with the factors of the rate
    integer, intent(in) :: number !! of its part
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(in) :: motion(:) !! of the journal [m], [rad]
    real(wp), intent(out) :: energy !! [J]
    logical, intent(out) :: found
    type(share_type) :: share
    real(wp) :: energies(3)
    PetscInt :: entries
    PetscErrorCode :: ierr
    integer :: k

    associate (part => response%part(number), one => response%one, other => response%other)
      PetscCallA(VecSet(one, 0.0_wp, ierr))
      PetscCallA(VecSet(other, 0.0_wp, ierr))
      do k = 1, size(part%coordinate)
        associate (its => motion(part%coordinate(k)), steady => response%steady_column(part%coordinate(k)), &
                   squeeze => response%squeeze_column(part%coordinate(k)))
          PetscCallA(VecAXPY(one, real(its, wp), steady, ierr))
          PetscCallA(VecAXPY(one, real(rate*its, wp), squeeze, ierr))
          PetscCallA(VecAXPY(other, aimag(its), steady, ierr))
          PetscCallA(VecAXPY(other, aimag(rate*its), squeeze, ierr))
        end associate
      end do
      call part%solver%solve([one], [other], found)
    end associate
    energy = 0.0_wp
    if (.not. found) return
    share%bearing => bearing
    share%response => response
    share%one = response%rise%re(1)
    share%other = response%rise%im(1)
    share%steady = response%equations%steady
    share%has_mass = response%equations%inertia%present
    if (share%has_mass) share%mass = response%equations%inertia%mass
    PetscCallA(VecGetLocalSize(bearing%state, entries, ierr))
    share%entries = int(entries)
    call weigh_foil(share)
    energies = energies_of(share, response%one) + energies_of(share, response%other)
    energy = energy_unit(share)*(energies(1) + energies(2) + abs(rate)**2*energies(3))
    if (share%has_foil) then
      PetscCallA(VecDestroy(share%foil, ierr))
    end if
  end subroutine find_energy
end module gfb_machine_shares
