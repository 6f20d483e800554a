!> How the numbers of a dataset lie in an HDF5 file: few in one piece, many in compressed chunks.
module gfb_dataset_layout
  use hdf5
  implicit none (type, external)
  private
  public :: choose_layout

  integer(hsize_t), parameter :: few = 1000_hsize_t !! numbers that stay in one piece
  !> 256 KiB of reals; HDF5 caches 1 MiB.
  integer(hsize_t), parameter :: chunk_numbers = 32768_hsize_t
  integer, parameter :: effort = 4 !! of deflate, 1 to 9: more takes longer and hardly saves

contains

  !> The property list of a new dataset, to be closed; compressed where the library has the filters.
  subroutine choose_layout(extent, compressed, layout, status)
    integer(hsize_t), intent(in) :: extent(:) !! of the dataset, fastest index first
    logical, intent(in) :: compressed !! it may be
    integer(hid_t), intent(out) :: layout !! of the HDF5 library
    integer, intent(out) :: status !! 0, or HDF5's error
    integer(hsize_t) :: chunk(size(extent)), left
    logical :: has_filter
    integer :: i

    call h5pcreate_f(H5P_DATASET_CREATE_F, layout, status)
    if (status /= 0 .or. .not. compressed .or. product(extent) <= few) return
    call look_for(H5Z_FILTER_DEFLATE_F, has_filter)
    if (.not. has_filter) return
    left = chunk_numbers
    do i = 1, size(extent)
      chunk(i) = min(extent(i), left)
      left = max(1_hsize_t, left/chunk(i))
    end do
    call h5pset_chunk_f(layout, size(chunk), chunk, status)
    call look_for(H5Z_FILTER_SHUFFLE_F, has_filter)
    if (status == 0 .and. has_filter) call h5pset_shuffle_f(layout, status)
    if (status == 0) call h5pset_deflate_f(layout, effort, status)
  end subroutine choose_layout

  !> Whether the library can apply a filter.
  subroutine look_for(filter, has_filter)
    integer, intent(in) :: filter !! its number
    logical, intent(out) :: has_filter !! it can
    integer :: uses, status

    call h5zfilter_avail_f(filter, has_filter, status)
    has_filter = has_filter .and. status == 0
    if (.not. has_filter) return
    call h5zget_filter_info_f(filter, uses, status)
    has_filter = status == 0 .and. iand(uses, H5Z_FILTER_ENCODE_ENABLED_F) /= 0
  end subroutine look_for
end module gfb_dataset_layout
