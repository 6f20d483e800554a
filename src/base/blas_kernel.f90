!> OpenBLAS' kernel. A library older than the processor does not know it and falls back to a
!> kernel that is several times slower; then the program chooses, by what the processor can do.
module gfb_blas_kernel
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
  use gfb_c_library, only: text_of
  use gfb_machine_memory, only: start_blas
  implicit none (type, external)
  private
  public :: kernel_step, choose_kernel, kernel_name

  character(len=*), parameter :: fallback = 'Prescott' !! of OpenBLAS, on x86-64
  !> Marks of a start anew: with a kernel that was chosen, and with the fallback after that one was
  !> wrong.
  character(len=*), parameter :: chosen = 'chosen', refused = 'refused'
  integer, parameter :: longest = 64 !! letters of a name

  interface
    subroutine gfb_blas_kernel_name(name, room) bind(c)
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(out) :: name(*)
      integer(c_int), value :: room
    end subroutine gfb_blas_kernel_name

    subroutine gfb_start_again(kernel, why) bind(c)
      import :: c_char
      implicit none (type, external)
      character(kind=c_char), intent(in) :: kernel(*), why(*)
    end subroutine gfb_start_again

    subroutine gfb_forget_kernel() bind(c)
      implicit none (type, external)
    end subroutine gfb_forget_kernel

    integer function gfb_vector_bits() bind(c)
      implicit none (type, external)
    end function gfb_vector_bits

    integer function gfb_kernel_is_right() bind(c)
      implicit none (type, external)
    end function gfb_kernel_is_right
  end interface

contains

  !> What the start does: nothing ('keep'), 'check' the kernel that was chosen, or start anew with
  !> a kernel, which is named.
  pure function kernel_step(kernel, vector_bits, given, mark) result(step)
    character(len=*), intent(in) :: kernel !! that computes now; empty: no OpenBLAS
    integer, intent(in) :: vector_bits     !! of the widest vectors of the processor
    logical, intent(in) :: given           !! the user has chosen a kernel
    character(len=*), intent(in) :: mark   !! of a start anew; empty: this is none
    character(len=:), allocatable :: step

    step = 'keep'
    if (mark == chosen) step = 'check'
    if (mark /= '' .or. given .or. kernel /= fallback) return
    if (vector_bits >= 256) step = 'Haswell'
    if (vector_bits >= 512) step = 'SkylakeX'
  end function kernel_step

  !> Starts the program anew with another kernel where OpenBLAS fell back and the user chose none;
  !> after that, with the fallback again where the kernel computes wrongly. Before MPI starts.
  subroutine choose_kernel()
    character(len=:), allocatable :: step
    character(len=8) :: mark
    integer :: none

    call get_environment_variable('OPENBLAS_CORETYPE', status=none)
    call get_environment_variable('GFB_BLAS_KERNEL', mark)
    step = kernel_step(kernel_name(), gfb_vector_bits(), none /= 1, mark)
    if (mark /= '') call gfb_forget_kernel()
    select case (step)
    case ('keep')
    case ('check')
      call start_blas()
      if (gfb_kernel_is_right() /= 0) return
      call gfb_start_again(fallback//c_null_char, refused//c_null_char)
      error stop 'OpenBLAS computes wrongly; OPENBLAS_CORETYPE names another kernel'
    case default ! where that cannot be, the run goes on
      call gfb_start_again(step//c_null_char, chosen//c_null_char)
    end select
  end subroutine choose_kernel

  !> Name of OpenBLAS' kernel; empty where BLAS is another.
  function kernel_name() result(name)
    character(len=:), allocatable :: name
    character(kind=c_char) :: letters(longest)

    call gfb_blas_kernel_name(letters, int(longest, c_int))
    name = text_of(letters)
  end function kernel_name
end module gfb_blas_kernel
