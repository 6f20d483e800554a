#include "gfb_petsc.h"
!> Film and foil of one bearing in the eigenvalue problem of a rotor: their entries of its vectors.
!>
!> A vector of `gfb_rotor_pencil` holds, on each rank, the unknowns u of each share, and behind them, where the foil
!> has its mass, their rates over the shift.
module gfb_pencil_share
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_film_measures, only: square_integrals
  use gfb_bearing_system, only: bearing_system_type
  use gfb_complex_factors, only: complex_factors_type, solve_complex, keep_entries
  use gfb_rotor, only: planar
  implicit none (type)
  private
  public :: entries_of, solve_film, add_momentum, put_rates, take_film, put_film, mean_square

  !> A u of its own.
  type, public :: share_type
    type(bearing_system_type), pointer :: bearing => null()
    type(complex_factors_type), pointer :: factors => null() !! of J + sigma E
    logical, pointer :: kept(:) => null() !! owned unknowns that its motions have
    integer :: first = 0, entries = 0   !! entries of a vector on this rank before it; those of u
    logical :: has_mass = .false.       !! rates of u over the shift stand behind it
    type(tVec) :: one, other, work      !! room for vectors of u
    type(tMat) :: steady, mass          !! J; M where there is one
    type(tVec) :: column(planar)        !! u that it takes to hold the rotor's coordinates still
    type(tMat) :: rate                  !! E
  end type share_type

contains

  !> Entries of a vector on this rank that belong to a share.
  elemental function entries_of(share) result(entries)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    integer :: entries
    entries = share%entries*merge(2, 1, share%has_mass)
  end function entries_of

  !> Solves with J + sigma E of a part.
  subroutine solve_film(share, right, answer)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: right, answer !! scaled
    Vec :: imaginary_part
    PetscErrorCode :: ierr
    logical :: solved

    call keep_entries(right, share%kept)
    PetscCallA(VecDuplicate(right, imaginary_part, ierr))
    PetscCallA(VecSet(imaginary_part, 0.0_wp, ierr))
    PetscCallA(VecCopy(right, answer, ierr))
    call solve_complex(share%factors, answer, imaginary_part, solved)
    PetscCallA(VecDestroy(imaginary_part, ierr))
  end subroutine solve_film

  !> Adds m (w + sigma u).
  subroutine add_momentum(share, shift, x, film, sum)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    real(wp), intent(in) :: shift !! sigma [1/s]
    Vec, intent(in) :: x, film, sum !! a vector, its u, and what is added to
    PetscErrorCode :: ierr

    call take_film(share, x, share%work, share%entries)
    PetscCallA(VecAXPY(share%work, 1.0_wp, film, ierr))
    PetscCallA(VecScale(share%work, shift, ierr))
    PetscCallA(MatMultAdd(share%mass, share%work, sum, sum, ierr))
  end subroutine add_momentum

  !> The rates of a product: sigma times its u less the u that it is of.
  subroutine put_rates(share, shift, x, film, y)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    real(wp), intent(in) :: shift !! sigma [1/s]
    Vec, intent(in) :: x, film, y !! a vector, the product's u, and the product
    PetscErrorCode :: ierr

    call take_film(share, x, share%work)
    PetscCallA(VecAYPX(share%work, -1.0_wp/shift, film, ierr))
    call put_film(share, share%work, y, share%entries)
  end subroutine put_rates

  !> A part's film and foil out of a vector.
  subroutine take_film(share, x, film, behind)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: x, film !! the vector, and what is taken
    integer, intent(in), optional :: behind !! entries of u: its rates
    PetscScalar, pointer :: values(:), own(:)
    PetscErrorCode :: ierr
    integer :: first

    first = share%first
    if (present(behind)) first = first + behind
    PetscCallA(GFB_VecGetArrayRead(x, values, ierr))
    PetscCallA(GFB_VecGetArray(film, own, ierr))
    own = values(first + 1:first + share%entries)
    PetscCallA(GFB_VecRestoreArray(film, own, ierr))
    PetscCallA(GFB_VecRestoreArrayRead(x, values, ierr))
  end subroutine take_film

  !> The reverse.
  subroutine put_film(share, film, x, behind)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: film, x !! what is put, and the vector
    integer, intent(in), optional :: behind !! entries of u: its rates
    PetscScalar, pointer :: values(:), own(:)
    PetscErrorCode :: ierr
    integer :: first

    first = share%first
    if (present(behind)) first = first + behind
    PetscCallA(GFB_VecGetArray(x, values, ierr))
    PetscCallA(GFB_VecGetArrayRead(film, own, ierr))
    values(first + 1:first + share%entries) = own
    PetscCallA(GFB_VecRestoreArrayRead(film, own, ierr))
    PetscCallA(GFB_VecRestoreArray(x, values, ierr))
  end subroutine put_film

  !> Mean of the squared pressure of a part's films over their area, over ambient pressure.
  function mean_square(share, x) result(mean)
    class(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: x !! the vector
    real(wp) :: mean, sums(2), value(share%bearing%local_size())
    integer :: i

    call take_film(share, x, share%one)
    call share%bearing%get_unknowns(value, share%one)
    associate (pad => share%bearing%pad)
      sums = sum_over_ranks(sum(reshape([(square_integrals(pad(i)%film, value(pad(i)%first + 1:pad(i)%last)), i=1, size(pad))], &
                                        [2, size(pad)]), 2))
      mean = sums(1)/sums(2)/pad(1)%film%ambient_pressure**2
    end associate
  end function mean_square
end module gfb_pencil_share
