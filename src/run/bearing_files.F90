#include "gfb_petsc.h"
!> Writes the files of a bearing: all of them, or none.
module gfb_bearing_files
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_quantity, only: quantity_type
  use gfb_petsc_session, only: this_rank, rank_count, share_failure
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: film_block, full_rows
  use gfb_result_file, only: result_file_type, keep_result_file, drop_result_file
  use gfb_case_file, only: history_row_type, write_case_file, summary_text
  use gfb_grid_file, only: grid_type, grid_field_type, write_grid_file, block_bounds
  use gfb_strip_grid, only: strip_grid
  use gfb_text_file, only: write_text_file
  use gfb_run_log, only: run_log_type
  implicit none (type)
  private
  public :: write_bearing_files

contains

  !> Writes summary, case file, film and echo; what did not converge under a name of its own.
  !>
  !> Fails when a file cannot be written; older results are then as they were.
  subroutine write_bearing_files(scene, bearing, folder, converged, provenance, summary, history, log, &
                                 error)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    character(len=*), intent(in) :: folder
    logical, intent(in) :: converged
    type(quantity_type), intent(in) :: provenance(:), summary(:)
    type(history_row_type), intent(in) :: history(:)
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error

    character(len=:), allocatable :: stem
    type(result_file_type) :: case_file, film_file
    logical :: with_film

    stem = folder//'/'//scene%name
    if (.not. converged) stem = stem//'.unconverged'
    with_film = scene%output%pressure .or. scene%output%gap .or. scene%output%deflection
    call write_case_file(stem//'.h5', PETSC_COMM_WORLD, MPI_INFO_NULL, this_rank() == 0, scene%verbatim, &
                         scene%echo, provenance, summary, history, case_file, error)
    call share_failure(error)
    if (with_film .and. .not. allocated(error)) then
      call write_film(scene, bearing, stem//'.film.vtkhdf', film_file, error)
      call share_failure(error)
    end if
    if (.not. allocated(error)) call keep_all(stem, case_file, film_file, with_film, summary, scene, error)
    call share_failure(error)
    if (allocated(error)) then
      call drop_result_file(case_file)
      call drop_result_file(film_file)
      return
    end if
    call log%line('')
    call log%line('results: '//stem//'.summary, .h5'//trim(merge(', .film.vtkhdf', '              ', with_film))// &
                  ', .used.nml')
  end subroutine write_bearing_files

  !> The film's fields.
  subroutine write_film(scene, bearing, path, file, error)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    character(len=*), intent(in) :: path
    type(result_file_type), intent(out) :: file
    type(error_type), allocatable, intent(out) :: error

    real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
    type(grid_type) :: grid
    type(grid_field_type), allocatable :: field(:)
    real(wp) :: unknown(bearing%local_size())
    real(wp), allocatable :: position_x(:)

    call bearing%get_unknowns(unknown)
    allocate (field(0))
    associate (whole => bearing%whole, nodes => size(bearing%mesh%mesh_node))
      position_x = whole%radius*(whole%station_angle - whole%station_angle(1))
      if (whole%periodic) position_x = [position_x, whole%radius*turn]
      grid = strip_grid(position_x, full_rows(bearing), this_rank(), rank_count())
      call add_field('theta', 'rad', 'angle around the bearing', bearing%film%angle)
      if (scene%output%pressure) call add_field('pressure', 'Pa', 'absolute pressure', unknown(:nodes))
      if (scene%output%gap) call add_field('gap', 'm', 'film thickness', bearing%gap(unknown))
      if (scene%output%deflection) then
        call add_field('deflection', 'm', 'of the foil, away from the shaft', bearing%foil%deflection(unknown))
      end if
    end associate
    call write_grid_file(path, PETSC_COMM_WORLD, MPI_INFO_NULL, this_rank(), rank_count(), grid, field, &
                         [grid_field_type ::], file, error)

  contains

    !> Adds a nodal field to the list.
    subroutine add_field(name, unit, meaning, value)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(in) :: value(:) !! at the local nodes
      type(grid_field_type) :: one
      real(wp), allocatable :: block(:)
      integer :: first, last

      call block_bounds(grid%points, this_rank(), rank_count(), first, last)
      one%name = name
      one%unit = unit
      one%meaning = meaning
      call film_block(bearing, value, first, last, block)
      one%block = reshape(block, [1, size(block)])
      field = [field, one]
    end subroutine add_field
  end subroutine write_film

  !> Gives the finished files their names and writes the small ones.
  subroutine keep_all(stem, case_file, film_file, with_film, summary, scene, error)
    character(len=*), intent(in) :: stem
    type(result_file_type), intent(in) :: case_file, film_file
    logical, intent(in) :: with_film
    type(quantity_type), intent(in) :: summary(:)
    type(scene_type), intent(in) :: scene
    type(error_type), allocatable, intent(out) :: error

    if (this_rank() /= 0) return
    call write_text_file(stem//'.used.nml', scene%echo, error)
    if (allocated(error)) return
    call keep_result_file(case_file, error)
    if (allocated(error)) return
    if (with_film) call keep_result_file(film_file, error)
    if (allocated(error)) return
    call write_text_file(stem//'.summary', summary_text(summary), error)
  end subroutine keep_all
end module gfb_bearing_files
