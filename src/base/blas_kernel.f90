!> OpenBLAS' kernel. A library older than the processor does not know it and falls back to a
!> kernel that is several times slower; then the program chooses, by what the processor can do.
module gfb_blas_kernel
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
  use gfb_c_library, only: text_of
  use gfb_machine_memory, only: start_blas
  implicit none (type, external)
  private
  public :: kernel_choice, choose_kernel, kernel_name

  character(len=*), parameter :: fallback = 'Prescott' !! of OpenBLAS, on x86-64
  integer, parameter :: longest = 64 !! letters of a name

  interface
    subroutine gfb_blas_kernel_name(name, room) bind(c)
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(out) :: name(*)
      integer(c_int), value :: room
    end subroutine gfb_blas_kernel_name

    !> Chooses a kernel, by a name that ends with a null; 0 where OpenBLAS cannot choose again.
    function gfb_set_kernel(kernel) result(done) bind(c)
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: kernel(*)
      integer(c_int) :: done
    end function gfb_set_kernel

    integer function gfb_vector_bits() bind(c)
      implicit none (type, external)
    end function gfb_vector_bits

    integer function gfb_kernel_is_right() bind(c)
      implicit none (type, external)
    end function gfb_kernel_is_right
  end interface

contains

  !> The kernel that the start chooses; empty where the one that computes stays.
  pure function kernel_choice(kernel, vector_bits, given) result(choice)
    character(len=*), intent(in) :: kernel !! that computes now; empty: no OpenBLAS
    integer, intent(in) :: vector_bits     !! of the widest vectors of the processor
    logical, intent(in) :: given           !! the user has chosen a kernel
    character(len=:), allocatable :: choice

    choice = ''
    if (given .or. kernel /= fallback) return
    if (vector_bits >= 256) choice = 'Haswell'
    if (vector_bits >= 512) choice = 'SkylakeX'
  end function kernel_choice

  !> Chooses another kernel where OpenBLAS fell back and the user chose none, and the fallback again
  !> where that one computes wrongly. Before the first product.
  subroutine choose_kernel()
    character(len=:), allocatable :: choice
    integer(c_int) :: done
    integer :: none

    call get_environment_variable('OPENBLAS_CORETYPE', status=none)
    choice = kernel_choice(kernel_name(), gfb_vector_bits(), none /= 1)
    if (choice == '') return
    done = gfb_set_kernel(choice//c_null_char)
    if (done == 0) return
    call start_blas()
    if (gfb_kernel_is_right() == 0) done = gfb_set_kernel(fallback//c_null_char)
  end subroutine choose_kernel

  !> Name of OpenBLAS' kernel; empty where BLAS is another.
  function kernel_name() result(name)
    character(len=:), allocatable :: name
    character(kind=c_char) :: letters(longest)

    call gfb_blas_kernel_name(letters, int(longest, c_int))
    name = text_of(letters)
  end function kernel_name
end module gfb_blas_kernel
