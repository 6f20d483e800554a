#include "gfb_petsc.h"
!> Film and foil of one bearing in the eigenvalue problem of a rotor: their entries of its vectors.
!>
!> A vector of `gfb_rotor_pencil` holds, on each rank, the unknowns u of each share, and behind them, where the foil
!> has its mass, their rates over the shift.
module gfb_pencil_share
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, this_rank
  use gfb_rotor, only: planar
  use gfb_film_measures, only: square_integrals
  use gfb_bearing_system, only: bearing_system_type
  use gfb_complex_solver, only: complex_solver_type, keep_entries
  use gfb_dynamic_response, only: dynamic_response_type
  implicit none (type)
  private
  public :: take_rotor, put_rotor, entries_of, solve_film, add_momentum, put_rates, take_film, put_film, energies_of, &
            energy_unit, start_film, weigh_foil

  !> Sizes of the rotor's entries.
  type, public :: rotor_scale_type
    real(wp) :: length = 1.0_wp !! of its coordinates [m], [rad]
    real(wp) :: clock = 1.0_wp  !! of rates [1/s]
  end type rotor_scale_type

  !> A u of its own.
  type, public :: share_type
    type(bearing_system_type), pointer :: bearing => null()
    type(dynamic_response_type), pointer :: response => null() !! of it
    integer :: part = 1 !! of the response
    class(complex_solver_type), pointer :: solver => null() !! with J + sigma E
    logical, pointer :: kept(:) => null() !! owned unknowns that its motions have
    integer :: first = 0, entries = 0   !! entries of a vector on this rank before it; those of u
    logical :: has_mass = .false.       !! rates of u over the shift stand behind it
    type(tVec) :: one, other, work      !! room for vectors of u
    type(tMat) :: steady, mass          !! J; M where there is one
    logical :: has_foil = .false.       !! with unknowns of displacements
    type(tVec) :: foil                  !! on these what makes a product of scaled vectors one in SI, 0 on all others
    type(tVec) :: column(planar)        !! u that it takes to hold the rotor's coordinates still
    type(tMat) :: rate                  !! E
  end type share_type

contains

  !> The rotor's coordinates and their rates out of a vector.
  subroutine take_rotor(scale, x, q, v)
    type(rotor_scale_type), intent(in) :: scale !! of the entries
    Vec, intent(in) :: x !! the vector
    real(wp), intent(out) :: q(planar) !! coordinates [m], [rad]
    real(wp), intent(out) :: v(planar) !! their rates [m/s], [rad/s]
    real(wp) :: both(2*planar)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    both = 0.0_wp
    if (this_rank() == 0) then
      PetscCallA(GFB_VecGetArrayRead(x, values, ierr))
      both = values(size(values) - 2*planar + 1:)
      PetscCallA(GFB_VecRestoreArrayRead(x, values, ierr))
    end if
    both = sum_over_ranks(both)*scale%length
    q = both(:planar)
    v = both(planar + 1:)*scale%clock
  end subroutine take_rotor

  !> The reverse.
  subroutine put_rotor(scale, q, v, x)
    type(rotor_scale_type), intent(in) :: scale !! of the entries
    real(wp), intent(in) :: q(planar) !! coordinates [m], [rad]
    real(wp), intent(in) :: v(planar) !! their rates [m/s], [rad/s]
    Vec, intent(in) :: x !! the vector
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    if (this_rank() /= 0) return
    PetscCallA(GFB_VecGetArray(x, values, ierr))
    values(size(values) - 2*planar + 1:) = [q, v/scale%clock]/scale%length
    PetscCallA(GFB_VecRestoreArray(x, values, ierr))
  end subroutine put_rotor

  !> Entries of a vector on this rank that belong to a share.
  elemental integer function entries_of(share) result(entries)
    type(share_type), intent(in) :: share !! film and foil of one bearing
    entries = share%entries*merge(2, 1, share%has_mass)
  end function entries_of

  !> Solves with J + sigma E of a part.
  subroutine solve_film(share, right, answer)
    type(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: right, answer !! scaled
    Vec :: imaginary_part
    PetscErrorCode :: ierr
    logical :: solved

    call keep_entries(right, share%kept)
    PetscCallA(VecDuplicate(right, imaginary_part, ierr))
    PetscCallA(VecSet(imaginary_part, 0.0_wp, ierr))
    PetscCallA(VecCopy(right, answer, ierr))
    call share%solver%solve([answer], [imaginary_part], solved)
    PetscCallA(VecDestroy(imaginary_part, ierr))
  end subroutine solve_film

  !> Adds m (w + sigma u).
  subroutine add_momentum(share, shift, x, film, sum)
    type(share_type), intent(in) :: share !! film and foil of one bearing
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
    type(share_type), intent(in) :: share !! film and foil of one bearing
    real(wp), intent(in) :: shift !! sigma [1/s]
    Vec, intent(in) :: x, film, y !! a vector, the product's u, and the product
    PetscErrorCode :: ierr

    call take_film(share, x, share%work)
    PetscCallA(VecAYPX(share%work, -1.0_wp/shift, film, ierr))
    call put_film(share, share%work, y, share%entries)
  end subroutine put_rates

  !> A part's film and foil out of a vector.
  subroutine take_film(share, x, film, behind)
    type(share_type), intent(in) :: share !! film and foil of one bearing
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
    type(share_type), intent(in) :: share !! film and foil of one bearing
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

  !> What a motion stores of energy, over p_a C A / 2: of the film, that of compressed gas,
  !> \( \overline{(p'/p_a)^2} \); of the foil, strain and, over the square of the rate, kinetic energy,
  !> \( u^T K u \) and \( u^T M u \) [s2] over p_a C A.
  function energies_of(share, x) result(energies)
    type(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: x !! the vector
    real(wp) :: energies(3), sums(2), unit, value(share%bearing%local_size()) !! [1], [1], [s2]
    PetscErrorCode :: ierr
    integer :: i

    call take_film(share, x, share%one)
    call share%bearing%get_unknowns(value, share%one)
    associate (pad => share%bearing%pad)
      sums = sum_over_ranks(sum(reshape([(square_integrals(pad(i)%film, value(pad(i)%first + 1:pad(i)%last)), i=1, size(pad))], &
                                        [2, size(pad)]), 2))
      energies = [sums(1)/sums(2)/share%bearing%ambient_pressure**2, 0.0_wp, 0.0_wp]
      if (.not. share%has_foil) return
      unit = share%bearing%ambient_pressure*share%bearing%clearance*sums(2)
      call keep_foil(share, share%one)
      energies(2) = product_by(share%steady)/unit
      if (share%has_mass) energies(3) = product_by(share%mass)/unit
    end associate

  contains

    !> Product of the foil's displacements with their forces by a matrix.
    real(wp) function product_by(matrix) result(energy)
      Mat, intent(in) :: matrix

      PetscCallA(MatMult(matrix, share%one, share%other, ierr))
      PetscCallA(VecPointwiseMult(share%other, share%other, share%foil, ierr))
      PetscCallA(VecDot(share%one, share%other, energy, ierr))
    end function product_by
  end function energies_of

  !> p_a C A of the whole bearing [J].
  function energy_unit(share) result(unit)
    type(share_type), intent(in) :: share !! film and foil of one bearing
    real(wp) :: unit !! [J]
    real(wp) :: area(1)
    integer :: i, k

    area = 0.0_wp
    do i = 1, size(share%bearing%pad)
      associate (film => share%bearing%pad(i)%film)
        area = area + film%copies*sum([(sum(film%geometry(k)%area), k=1, size(film%geometry))])
      end associate
    end do
    area = sum_over_ranks(area)
    unit = share%bearing%ambient_pressure*share%bearing%clearance*area(1)
  end function energy_unit

  !> Values without any order in a vector, the same in each run: multiples of the golden ratio, less their integers. No
  !> mode lacks them, as one of a part of the foil that touches nothing lacks pressures.
  subroutine start_film(share, x)
    type(share_type), intent(in) :: share !! film and foil of one bearing
    Vec, intent(in) :: x !! the vector
    real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(GFB_VecGetArray(share%one, values, ierr))
    values = [(modulo(real(i, wp)*golden, 1.0_wp) - 0.5_wp, i=1, size(values))]
    PetscCallA(GFB_VecRestoreArray(share%one, values, ierr))
    call keep_entries(share%one, share%kept)
    call put_film(share, share%one, x)
  end subroutine start_film

  !> Leaves a bearing's motion of the foil alone.
  subroutine keep_foil(share, film)
    type(share_type), intent(in) :: share
    Vec, intent(in) :: film
    PetscScalar, pointer :: values(:), weight(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(share%foil, weight, ierr))
    PetscCallA(GFB_VecGetArray(film, values, ierr))
    where (weight <= 0.0_wp) values = 0.0_wp
    PetscCallA(GFB_VecRestoreArray(film, values, ierr))
    PetscCallA(GFB_VecRestoreArrayRead(share%foil, weight, ierr))
  end subroutine keep_foil

  !> Where the foil's displacements stand, with the sizes of unknowns and equations.
  subroutine weigh_foil(share)
    type(share_type), intent(inout) :: share !! film and foil of one bearing
    real(wp) :: value(share%bearing%local_size())
    logical :: of_foil(size(value))
    PetscErrorCode :: ierr
    integer :: i

    share%has_foil = share%bearing%is_meshed()
    if (.not. share%has_foil) return
    of_foil = .false.
    do i = 1, size(share%bearing%pad)
      associate (pad => share%bearing%pad(i))
        of_foil(pad%first + pad%foil%first + 1:pad%last) = .true.
      end associate
    end do
    value = merge(share%bearing%unknown_scale*share%bearing%equation_scale(share%bearing%point), 0.0_wp, of_foil)
    PetscCallA(VecDuplicate(share%bearing%state, share%foil, ierr))
    call share%bearing%exchange%put(value, share%foil)
  end subroutine weigh_foil
end module gfb_pencil_share
