#include "gfb_petsc.h"
!> Writes the files of a scene: all of them, or none.
module gfb_result_set
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_quantity, only: quantity_type
  use gfb_signals, only: hold_clock
  use gfb_petsc_session, only: this_rank, rank_count, share_failure
  use gfb_file_set, only: unfinished_file_type, publish, drop_unfinished, has_answer, remove_unanswered
  use gfb_result_file, only: result_file_type
  use gfb_case_file, only: history_row_type, case_array_type, write_case_file, summary_text, table_csv, &
                           with_decimal_commas, csv_settings_type
  use gfb_grid, only: result_grid_type, write_grid_file
  use gfb_grid_series, only: grid_series_type, begin_step, add_surface, write_series_file
  use gfb_text_file, only: write_unfinished_text
  use gfb_run_log, only: run_log_type
  implicit none (type)
  private
  public :: write_result_set, add_series_step, result_grid_type

contains

  !> Writes summary, case file, surfaces and echo; what did not converge under a name of its own.
  !>
  !> Fails when a file cannot be written; older results are then as they were.
  subroutine write_result_set(scene, folder, converged, provenance, summary, history, arrays, grids, &
                              csv, log, error, columns, series, parts)
    type(scene_type), intent(in) :: scene !! with its name and echo
    character(len=*), intent(in) :: folder !! where the files go
    logical, intent(in) :: converged !! it is an answer, not the last state reached
    type(quantity_type), intent(in) :: provenance(:) !! version, machine and command
    type(quantity_type), intent(in) :: summary(:) !! results of the answer
    type(history_row_type), intent(in) :: history(:) !! a row for each point or step
    type(case_array_type), intent(in) :: arrays(:) !! further arrays of the result file
    type(result_grid_type), intent(in) :: grids(:) !! surfaces, a file each
    type(csv_settings_type), intent(in) :: csv !! history, motion or orbits as a table
    type(run_log_type), intent(in) :: log !! where lines go
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(history_row_type), intent(in), optional :: columns(:) !! that a history without a row has
    type(grid_series_type), intent(in), optional :: series !! surfaces at steps, a further file each
    type(quantity_type), intent(in), optional :: parts(:) !! texts of further case files, by name

    character(len=:), allocatable :: stem, names, table
    type(result_file_type) :: file
    type(unfinished_file_type), allocatable :: files(:)
    integer :: i, played

    call hold_clock(.true.)
    stem = folder//'/'//scene%name
    if (.not. converged) stem = stem//'.unconverged'
    names = stem//'.summary, .h5'
    played = 0
    if (present(series)) played = surfaces_of(series)
    allocate (files(size(grids) + played + merge(4, 3, csv%wanted .or. scene%sweep%present)))
    call write_case_file(stem//'.h5', PETSC_COMM_WORLD, this_rank() == 0, scene%verbatim, &
                         scene%echo, provenance, summary, history, arrays, file, error, columns, parts)
    call share_failure(error)
    files(1) = file%written
    do i = 1, size(grids)
      if (allocated(error)) exit
      names = names//', .'//grids(i)%name//'.vtkhdf'
      call write_grid_file(stem//'.'//grids(i)%name//'.vtkhdf', PETSC_COMM_WORLD, this_rank(), &
                           rank_count(), grids(i)%grid, grids(i)%point_field, grids(i)%cell_field, &
                           file, error)
      call share_failure(error)
      files(i + 1) = file%written
    end do
    do i = 1, played
      if (allocated(error)) exit
      associate (name => '.'//series%surface(i)%name//'.steps.vtkhdf')
        names = names//', '//name
        call write_series_file(stem//name, PETSC_COMM_WORLD, this_rank() == 0, series, i, file, error)
      end associate
      call share_failure(error)
      files(1 + size(grids) + i) = file%written
    end do
    table = ''
    if (csv%wanted .or. scene%sweep%present) then
      table = table_csv(history, arrays, columns)
      if (csv%decimal_comma) table = with_decimal_commas(table)
      names = names//', .csv'
    end if
    if (this_rank() == 0) call keep_all(stem, files, summary, table, scene, error)
    call share_failure(error)
    call hold_clock(.false.)
    if (allocated(error)) return
    call log%line('')
    call log%tell('results: '//names//', .used.nml')
    if (this_rank() == 0) call tell_of_older(folder//'/'//scene%name, converged, log)
  end subroutine write_result_set

  !> Leaves no state without an answer beside an answer; says where an older answer stands beside such a state.
  subroutine tell_of_older(stem, converged, log)
    character(len=*), intent(in) :: stem !! folder and name of the case
    logical, intent(in) :: converged !! the new results are an answer
    type(run_log_type), intent(in) :: log
    logical :: removed

    if (.not. converged) then
      if (has_answer(stem)) then
        call log%tell('the results without .unconverged, '//stem//'.summary and the like, are of an earlier run')
      end if
      return
    end if
    call remove_unanswered(stem, removed)
    if (removed) call log%tell('removed: '//stem//'.unconverged.*, of an earlier run without an answer')
  end subroutine tell_of_older

  !> Writes the small files too and gives all of them their names, the summary last; none stays unfinished.
  subroutine keep_all(stem, files, summary, table, scene, error)
    character(len=*), intent(in) :: stem
    type(unfinished_file_type), intent(inout) :: files(:)
    type(quantity_type), intent(in) :: summary(:)
    character(len=*), intent(in) :: table !! comma-separated values; empty: not wanted
    type(scene_type), intent(in) :: scene
    type(error_type), allocatable, intent(inout) :: error !! of the large files
    integer :: i

    associate (last => size(files))
      if (table /= '' .and. .not. allocated(error)) call write_unfinished_text(stem//'.csv', table, files(last - 2), error)
      if (.not. allocated(error)) call write_unfinished_text(stem//'.used.nml', scene%echo, files(last - 1), error)
      if (.not. allocated(error)) call write_unfinished_text(stem//'.summary', summary_text(summary), files(last), error)
    end associate
    if (.not. allocated(error)) call publish(files, error)
    do i = 1, size(files)
      call drop_unfinished(files(i))
    end do
  end subroutine keep_all

  !> Surfaces of a series, which has none without a step.
  pure integer function surfaces_of(series) result(number)
    type(grid_series_type), intent(in) :: series

    number = 0
    if (allocated(series%surface)) number = size(series%surface)
  end function surfaces_of

  !> Adds surfaces as the next step of a series; all ranks call it.
  subroutine add_series_step(series, name, unit, value, grids)
    type(grid_series_type), intent(inout) :: series !! gets the step
    character(len=*), intent(in) :: name !! of what has a value at each step, such as time
    character(len=*), intent(in) :: unit !! of the value
    real(wp), intent(in) :: value !! at this step, in that unit
    type(result_grid_type), intent(in) :: grids(:) !! the same surfaces and fields at each step
    integer :: i

    if (size(grids) == 0) return
    call begin_step(series, name, unit, value)
    do i = 1, size(grids)
      call add_surface(series, PETSC_COMM_WORLD, this_rank(), rank_count(), grids(i))
    end do
  end subroutine add_series_step
end module gfb_result_set
