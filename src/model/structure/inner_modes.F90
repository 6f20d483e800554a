#include "gfb_petsc.h"
!> Fixed-interface modes inside the condensed pieces of a foil that moves.
!>
!> Modes \( \phi_i \) of unit modal mass with the natural frequencies \( \omega_i \) couple by \( m_i \) to the
!> retained unknowns u of their piece:
!>
!> $$ \ddot\eta_i + \omega_i^2 \eta_i = -m_i^T \ddot u, \qquad f = \sum_i m_i \ddot\eta_i $$
!>
!> Source: [CraigBampton1968].
module gfb_inner_modes
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  implicit none (type)
  private
  public :: inner_block, add_to_pieces

  !> Modes inside the condensed pieces of one kind.
  type, public :: inner_modes_type
    integer, allocatable :: number(:, :)     !! (retained, pieces) bearing's, from 0; -1: fixed
    integer, allocatable :: place(:)         !! (pieces) from 1, pad by pad, whatever rank has them
    real(wp), allocatable :: coupling(:, :)  !! (retained, modes) m_i [sqrt(kg)], of one sign on all ranks
    real(wp), allocatable :: eigenvalue(:)   !! omega_i squared [1/s2]
  end type inner_modes_type

contains

  !> What the modes inside a piece do to its retained unknowns in a motion \( e^{\lambda t} \):
  !> \( -\sum_i \lambda^4 m_i m_i^T/(\omega_i^2 (1 + l) + \lambda^2) \).
  pure function inner_block(inner, rate, loss) result(block)
    type(inner_modes_type), intent(in) :: inner !! of one kind
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(in) :: loss !! l of the stiffness [1]
    complex(wp) :: block(size(inner%coupling, 1), size(inner%coupling, 1))
    integer :: i

    block = 0.0_wp
    do i = 1, size(inner%eigenvalue)
      associate (m => inner%coupling(:, i))
        block = block - rate**4/(inner%eigenvalue(i)*(1.0_wp + loss) + rate**2)* &
          spread(m, 2, size(m))*spread(m, 1, size(m))
      end associate
    end do
  end function inner_block

  !> Adds a block to a matrix at the retained unknowns of every piece of a kind.
  subroutine add_to_pieces(inner, block, matrix)
    type(inner_modes_type), intent(in) :: inner !! of one kind
    real(wp), intent(in) :: block(:, :)         !! (retained, retained)
    Mat, intent(in) :: matrix                   !! not assembled yet
    PetscInt :: row(size(inner%number, 1))
    PetscErrorCode :: ierr
    integer :: k

    do k = 1, size(inner%number, 2)
      row = int(inner%number(:, k), pint)
      PetscCallA(MatSetValues(matrix, size(row, kind=pint), row, size(row, kind=pint), row, [block], ADD_VALUES, ierr))
    end do
  end subroutine add_to_pieces
end module gfb_inner_modes
