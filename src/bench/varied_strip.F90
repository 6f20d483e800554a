#include "gfb_petsc.h"
!> A condensed bump strip, on any number of ranks, no two super-elements of which are equal.
!>
!> `gfb_bench_varied_strip ARC FLAT AXIAL BUMPS`: elements of a bump's arc, of its flat, over the
!> width; bumps that grow along the strip. Writes lines `name,value`; what the steps cost, PETSc's
!> log shows (`-log_view`). `tools/bench scaling` makes a table of it.
program gfb_bench_varied_strip
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: start_petsc, stop_petsc, this_rank, sum_over_ranks, largest_over_ranks
  use gfb_c_library, only: peak_memory
  use gfb_strip_cost, only: strip_type, make_strip, strip_cost_type, strip_cost, argument, tell
  implicit none (type)

  character(len=*), parameter :: usage = 'gfb_bench_varied_strip ARC FLAT AXIAL BUMPS'

  real(wp), parameter :: growth = 0.5_wp !! of the bumps along the strip

  call start_petsc()
  call measure(make_strip(argument(1, usage), argument(2, usage), argument(3, usage), argument(4, usage), growth))
  call stop_petsc()

contains

  !> Goes from the mesh to all displacements.
  subroutine measure(strip)
    type(strip_type), intent(in) :: strip
    type(strip_cost_type) :: cost
    type(error_type), allocatable :: error
    real(wp) :: memory(1), largest(1), condensed(1)

    call strip_cost(strip, .true., .true., cost, error)
    if (allocated(error)) error stop 'an element of the strip cannot be computed'
    memory = sum_over_ranks([peak_memory()])
    condensed = sum_over_ranks([real(cost%kinds, wp)])
    largest = largest_over_ranks([maxval(abs(cost%moved(2, :)))])
    if (this_rank() /= 0) return
    call tell('pieces', real(size(strip%piece), wp))
    call tell('condensations', condensed(1))
    call tell('shell_unknowns', real(count(.not. strip%fixed), wp))
    call tell('unknowns', real(cost%unknowns, wp))
    call tell('peak_memory', memory(1))
    call tell('largest_deflection', largest(1))
  end subroutine measure
end program gfb_bench_varied_strip
