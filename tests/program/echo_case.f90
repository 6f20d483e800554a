!> Prints a case file with every value used, as `<case>.used.nml` has it, and computes nothing.
program echo_case
  use, intrinsic :: iso_fortran_env, only: error_unit
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene
  implicit none (type, external)
  type(scene_type) :: scene
  type(error_type), allocatable :: error
  character(len=4096) :: file

  call get_command_argument(1, file)
  call read_scene(trim(file), scene, error)
  if (allocated(error)) then
    write (error_unit, '(a)') error%message
    stop 1
  end if
  write (*, '(a)') scene%echo
end program echo_case
