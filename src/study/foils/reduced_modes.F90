#include "gfb_petsc.h"
!> Craig-Bampton matrices of a strip for the result file, and the frequencies they give.
module gfb_reduced_modes
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_foil_structure, only: foil_structure_type
  use gfb_craig_bampton, only: craig_bampton_type, craig_bampton
  use gfb_reduced_strip, only: assembled_eigenvalues
  use gfb_case_file, only: case_array_type, fill_array
  use gfb_modes_writing, only: turn
  implicit none (type)
  private
  public :: reduce_strip

contains

  !> Condenses every super-element of a strip, with some of its fixed-interface modes.
  !>
  !> Fails where a super-element cannot be factorized.
  subroutine reduce_strip(strip, modes_kept, wanted, shift, log, arrays, frequencies, error)
    type(foil_structure_type), intent(in) :: strip !! that vibrates
    integer, intent(in) :: modes_kept !! of every super-element
    integer, intent(in) :: wanted     !! frequencies
    real(wp), intent(in) :: shift     !! [1/s2]
    type(run_log_type), intent(in) :: log !! where lines go
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! their matrices
    type(quantity_type), allocatable, intent(inout) :: frequencies(:) !! of the reduced strip
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(craig_bampton_type), allocatable :: kinds(:)
    real(wp), allocatable :: eigenvalue(:)
    integer :: i

    call craig_bampton(strip, modes_kept, kinds, error)
    if (allocated(error)) return
    eigenvalue = assembled_eigenvalues(strip, kinds, shift, wanted)
    call list_matrices(strip, kinds, arrays)
    do i = 1, size(eigenvalue)
      call add_result(frequencies, 'craig_bampton_frequency_'//text(i), sqrt(max(eigenvalue(i), 0.0_wp))/turn)
    end do
    call log%line('Craig-Bampton: '//text(size(kinds))//' kinds of super-element with '//text(modes_kept)// &
                  ' modes each, written to /craig_bampton')
  end subroutine reduce_strip

  !> The matrices of every kind, each on the rank that computed it, for the result file.
  subroutine list_matrices(strip, kinds, arrays)
    type(foil_structure_type), intent(in) :: strip
    type(craig_bampton_type), intent(inout) :: kinds(:) !! the matrices leave them
    type(case_array_type), allocatable, intent(out) :: arrays(:)
    integer :: i

    allocate (arrays(2*size(kinds) + 1))
    do i = 1, size(kinds)
      call add_matrix('stiffness', kinds(i)%stiffness, arrays(2*i - 1))
      call add_matrix('mass', kinds(i)%mass, arrays(2*i))
    end do
    call fill_array('/craig_bampton/kind_of_substructure', '1', 'kind of each super-element, from the smallest x on', &
                    reshape(real(strip%substructure%kind, wp), [1, size(strip%substructure)]), arrays(size(arrays)))

  contains

    !> One matrix of a kind.
    subroutine add_matrix(name, matrix, array)
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: matrix(:, :)
      type(case_array_type), intent(inout) :: array

      array%path = '/craig_bampton/kind_'//text(i)//'/'//name
      array%unit = 'mixed SI'
      array%meaning = 'retained unknowns, then modes'
      array%rows = kinds(i)%retained + kinds(i)%modes
      if (kinds(i)%mine) then
        call move_alloc(matrix, array%values)
      else
        allocate (array%values(array%rows, 0))
      end if
    end subroutine add_matrix
  end subroutine list_matrices
end module gfb_reduced_modes
