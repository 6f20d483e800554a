#include "gfb_version.h"
!> Which program computed this, where and with what.
module gfb_provenance
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_c_library, only: host_name
  use gfb_blas_kernel, only: kernel_name
  use gfb_petsc_session, only: petsc_version_text, rank_count
  implicit none (type, external)
  private
  public :: version_text, program_words, provenance, blas_in_use

contains

  !> Version of the program and its libraries.
  function version_text() result(words)
    character(len=:), allocatable :: words
    words = program_words()//', '//GFB_BUILD//' build by '//GFB_COMPILER//', '// &
      petsc_version_text()//', BLAS '//blas_in_use()
  end function version_text

  !> Version and commit of the program.
  pure function program_words() result(words)
    character(len=:), allocatable :: words
    words = 'gfb '//GFB_VERSION//' ('//GFB_COMMIT//')'
  end function program_words

  !> What the result file says of its origin.
  function provenance(command, petsc_options, reduction) result(list)
    character(len=*), intent(in) :: command !! the whole command line
    character(len=*), intent(in), optional :: petsc_options !! that were given; empty: none
    character(len=*), intent(in), optional :: reduction !! that was chosen by 'auto'; empty: none
    type(quantity_type), allocatable :: list(:)

    call add_result(list, 'program_version', GFB_VERSION)
    call add_result(list, 'commit', GFB_COMMIT)
    call add_result(list, 'compiler', GFB_COMPILER)
    call add_result(list, 'build', GFB_BUILD)
    call add_result(list, 'libraries', petsc_version_text())
    call add_result(list, 'blas', blas_in_use())
    call add_result(list, 'command', command)
    if (present(petsc_options)) then
      if (petsc_options /= '') call add_result(list, 'petsc_options', petsc_options)
    end if
    if (present(reduction)) then
      if (reduction /= '') call add_result(list, 'reduction', reduction)
    end if
    call add_result(list, 'host', host_name())
    call add_result(list, 'date', date_text())
    call add_result(list, 'ranks', rank_count())
  end function provenance

  !> Date and time with their distance from UTC.
  function date_text() result(words)
    character(len=:), allocatable :: words
    character(len=8) :: date
    character(len=10) :: time
    character(len=5) :: zone

    call date_and_time(date, time, zone)
    words = date(1:4)//'-'//date(5:6)//'-'//date(7:8)//' '//time(1:2)//':'//time(3:4)//':'//time(5:6)// &
      ' '//zone
  end function date_text

  !> Name of the BLAS this process has loaded, as the system names it, and its kernel.
  function blas_in_use() result(name)
    character(len=:), allocatable :: name, path
    character(len=1024) :: line
    integer :: unit, status

    name = 'unknown'
    path = ''
    open (newunit=unit, file='/proc/self/maps', status='old', action='read', iostat=status)
    do while (status == 0)
      read (unit, '(a)', iostat=status) line
      if (status == 0) path = trim(line(index(line, '/', back=.true.) + 1:)) ! the search for names costs more than reading
      if (status /= 0 .or. index(path, 'libblas') + index(path, 'openblas') + index(path, 'libmkl') == 0) cycle
      name = trim(line(index(line, '/'):))
      if (index(line, 'openblas') > 0) exit
    end do
    if (status == 0) close (unit)
    if (index(name, 'openblas-serial') > 0) then
      name = 'OpenBLAS (serial)'
    else if (index(name, 'openblas') > 0) then
      name = 'OpenBLAS'
    else if (index(name, '/blas/') > 0) then
      name = 'reference (slow: install libopenblas0-serial)'
    else
      name = name(index(name, '/', back=.true.) + 1:)
    end if
    if (kernel_name() /= '') name = name//', '//kernel_name()//' kernel'
  end function blas_in_use
end module gfb_provenance
