!> gfb: bump-type gas foil bearings.
program gfb
  use gfb_errors, only: error_type, status_machine
  use gfb_c_library, only: exit_with_status
  use gfb_machine_memory, only: look_for_room, room_to_start
  use gfb_blas_kernel, only: choose_kernel
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: limit_time, stop_agreed, stop_status
  use gfb_pool, only: pool_type, start_pool, stop_pool
  use gfb_petsc_session, only: start_petsc, stop_petsc, this_rank
  use gfb_reasons, only: status_unconverged
  use gfb_command_line, only: command_line_type, read_command_line
  use gfb_information, only: information
  use gfb_run_case, only: run_case
  use gfb_run_groups, only: run_groups
  implicit none (type, external)

  type(command_line_type) :: line
  type(pool_type) :: pool
  type(run_log_type) :: log
  type(error_type), allocatable :: error
  character(len=:), allocatable :: words
  integer :: status
  logical :: converged, well

  call read_command_line(line, error)
  call look_for_room(room_to_start)
  if (line%version .or. .not. (line%informs() .or. line%check)) call choose_kernel()
  call start_pool(line%groups, pool)
  call start_petsc(line%petsc)
  if (line%time_limit > 0) call limit_time(line%time_limit)
  log%active = this_rank() == 0 .and. pool%rank == 0
  status = 0
  if (.not. allocated(error)) then
    log%verbose = line%verbose
    log%quiet = line%quiet
    call log%begin()
    if (line%informs()) then
      call information(line, words, error)
      if (.not. allocated(error)) call log%tell(words)
    else if (line%groups > 0) then
      call run_groups(line, pool, log, status, error)
    else
      call run_case(line, log, converged, error)
      if (.not. converged) status = status_unconverged
    end if
  end if
  if (stop_agreed() .and. status == status_unconverged) status = stop_status()
  call log%repeat_warnings()
  if (allocated(error)) then
    call log%complaint(error%message)
    status = error%status
  end if
  call stop_petsc(well)
  call stop_pool(pool)
  if (.not. well .and. status == 0) status = status_machine
  call exit_with_status(status)
end program gfb
