!> How much memory this machine still has, as Linux reports it.
module gfb_machine_memory
  use, intrinsic :: iso_c_binding, only: c_size_t
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: available_memory, unknown_memory, named_number, group_path, look_for_room, start_blas

  integer(c_size_t), parameter :: mebibyte = 1048576_c_size_t !! [B]
  integer(c_size_t), parameter, public :: room_to_start = 96*mebibyte !! of MPI and PETSc [B]
  !> Of HDF5, beside what is written [B].
  integer(c_size_t), parameter, public :: room_to_write = 16*mebibyte
  real(wp), parameter :: unknown_memory = huge(1.0_wp) !! where nothing says how much
  real(wp), parameter :: kilobyte = 1024.0_wp          !! the kernel's kB [B]
  integer, parameter :: longest_line = 500

  interface
    !> Ends the program with a sentence and status 3 where a limit of addresses does not leave so
    !> many to a library that would end in many ways.
    subroutine look_for_room(bytes) bind(c, name='gfb_look_for_room')
      import :: c_size_t
      implicit none (type, external)
      integer(c_size_t), value :: bytes !! to be had [B]
    end subroutine look_for_room

    !> Lets BLAS take its working memory; where there is none for it, the program ends with a
    !> sentence and status 3. OpenBLAS would ask for it for ever.
    subroutine start_blas() bind(c, name='gfb_start_blas')
      implicit none (type, external)
    end subroutine start_blas
  end interface

contains

  !> Memory that can be had without swapping: the kernel's own estimate, or what a limit on the
  !> group of processes leaves [B]. `unknown_memory` where neither can be read.
  real(wp) function available_memory() result(bytes)
    real(wp) :: free

    bytes = unknown_memory
    free = named_number('/proc/meminfo', 'MemAvailable:')
    if (free >= 0.0_wp) bytes = kilobyte*free
    bytes = min(bytes, group_room('0::', '/sys/fs/cgroup', 'memory.max', 'memory.current'))
    bytes = min(bytes, group_room('memory:', '/sys/fs/cgroup/memory', 'memory.limit_in_bytes', &
                                  'memory.usage_in_bytes'))
  end function available_memory

  !> What the limits of this process' group, and of those above it, leave [B].
  real(wp) function group_room(controller, root, limit_name, usage_name) result(room)
    character(len=*), intent(in) :: controller !! as /proc/self/cgroup names it
    character(len=*), intent(in) :: root       !! folder of the groups
    character(len=*), intent(in) :: limit_name, usage_name
    character(len=:), allocatable :: folder
    real(wp) :: limit, usage, cache
    integer :: slash

    room = unknown_memory
    folder = group_path('/proc/self/cgroup', controller)
    do
      limit = named_number(root//folder//'/'//limit_name, '')
      usage = named_number(root//folder//'/'//usage_name, '')
      ! Pages of files are given back when memory runs short.
      cache = max(0.0_wp, named_number(root//folder//'/memory.stat', 'inactive_file'))
      if (min(limit, usage) >= 0.0_wp) room = min(room, max(0.0_wp, limit - usage + cache))
      slash = index(folder, '/', back=.true.)
      if (slash == 0) exit
      folder = folder(:slash - 1)
    end do
  end function group_room

  !> Path of this process' group, without a slash at its end; empty for the topmost one.
  function group_path(file, controller) result(path)
    character(len=*), intent(in) :: file       !! lines such as 4:memory:/some/group
    character(len=*), intent(in) :: controller !! of the control groups: memory
    character(len=:), allocatable :: path
    character(len=longest_line) :: line
    integer :: unit, status, found

    path = ''
    open (newunit=unit, file=file, status='old', action='read', iostat=status)
    if (status /= 0) return
    do
      read (unit, '(a)', iostat=status) line
      if (status /= 0) exit
      found = index(line, controller)
      if (found == 0) cycle
      if (controller(1:1) == '0' .and. found /= 1) cycle
      path = trim(line(found + len(controller):))
      if (path == '/') path = ''
      exit
    end do
    close (unit)
  end function group_path

  !> The number behind a name at the beginning of a line of a file, or the first number where no
  !> name is given; negative where there is none.
  real(wp) function named_number(file, name) result(number)
    character(len=*), intent(in) :: file, name !! of `/proc`; what stands before the number
    character(len=longest_line) :: line
    integer :: unit, status

    number = -1.0_wp
    open (newunit=unit, file=file, status='old', action='read', iostat=status)
    if (status /= 0) return
    do
      read (unit, '(a)', iostat=status) line
      if (status /= 0) exit
      if (index(line, name) /= 1) cycle
      if (verify(line(len(name) + 1:len(name) + 1), ' 0123456789'//achar(9)) > 0) cycle
      read (line(len(name) + 1:), *, iostat=status) number
      if (status /= 0) number = -1.0_wp ! a word, such as max
      exit
    end do
    close (unit)
  end function named_number
end module gfb_machine_memory
