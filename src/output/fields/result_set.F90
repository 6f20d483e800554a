#include "gfb_petsc.h"
!> Writes the files of a scene: all of them, or none.
module gfb_result_set
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_quantity, only: quantity_type
  use gfb_petsc_session, only: this_rank, rank_count, share_failure
  use gfb_file_set, only: unfinished_file_type, publish, drop_unfinished
  use gfb_result_file, only: result_file_type
  use gfb_case_file, only: history_row_type, case_array_type, write_case_file, summary_text, history_csv
  use gfb_grid_file, only: grid_type, grid_field_type, write_grid_file
  use gfb_text_file, only: write_unfinished_text
  use gfb_run_log, only: run_log_type
  implicit none (type)
  private
  public :: write_result_set, add_grid_field

  !> A surface with its fields, `<case>.<name>.vtkhdf`.
  type, public :: result_grid_type
    character(len=:), allocatable :: name !! film, top_foil or bump_foil
    type(grid_type) :: grid
    type(grid_field_type), allocatable :: point_field(:), cell_field(:)
  end type result_grid_type

contains

  !> Writes summary, case file, surfaces and echo; what did not converge under a name of its own.
  !>
  !> Fails when a file cannot be written; older results are then as they were.
  subroutine write_result_set(scene, folder, converged, provenance, summary, history, arrays, grids, &
                              csv, log, error, columns)
    type(scene_type), intent(in) :: scene !! with its name and echo
    character(len=*), intent(in) :: folder !! where the files go
    logical, intent(in) :: converged !! it is an answer, not the last state reached
    type(quantity_type), intent(in) :: provenance(:) !! version, machine and command
    type(quantity_type), intent(in) :: summary(:) !! results of the answer
    type(history_row_type), intent(in) :: history(:) !! a row for each point or step
    type(case_array_type), intent(in) :: arrays(:) !! further arrays of the result file
    type(result_grid_type), intent(in) :: grids(:) !! surfaces, a file each
    logical, intent(in) :: csv !! the history also as a table, which a sweep has anyway
    type(run_log_type), intent(in) :: log !! where lines go
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(history_row_type), intent(in), optional :: columns(:) !! that a history without a row has

    character(len=:), allocatable :: stem, names, table
    type(result_file_type) :: file
    type(unfinished_file_type) :: files(size(grids) + merge(4, 3, csv .or. scene%sweep%present))
    integer :: i

    stem = folder//'/'//scene%name
    if (.not. converged) stem = stem//'.unconverged'
    names = stem//'.summary, .h5'
    call write_case_file(stem//'.h5', PETSC_COMM_WORLD, this_rank() == 0, scene%verbatim, &
                         scene%echo, provenance, summary, history, arrays, file, error, columns)
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
    table = ''
    if (csv .or. scene%sweep%present) then
      table = history_csv(history, columns)
      names = names//', .csv'
    end if
    if (this_rank() == 0) call keep_all(stem, files, summary, table, scene, error)
    call share_failure(error)
    if (allocated(error)) return
    call log%line('')
    call log%tell('results: '//names//', .used.nml')
  end subroutine write_result_set

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

  !> Puts a field at the end of a list.
  subroutine add_grid_field(list, name, unit, meaning, block)
    type(grid_field_type), allocatable, intent(inout) :: list(:) !! gets the field
    character(len=*), intent(in) :: name !! of the field
    character(len=*), intent(in) :: unit !! of its numbers
    character(len=*), intent(in) :: meaning !! of the field, in words
    real(wp), intent(in) :: block(:, :) !! (components, entries of this rank), in its unit
    type(grid_field_type) :: one

    one%name = name
    one%unit = unit
    one%meaning = meaning
    one%block = block
    if (.not. allocated(list)) allocate (list(0))
    list = [list, one]
  end subroutine add_grid_field
end module gfb_result_set
