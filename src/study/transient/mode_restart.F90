!> What modes inside condensed pieces of a foil remember over time, in a restart file: piece by piece, on whatever rank.
module gfb_mode_restart
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: largest_number
  use gfb_inner_motion, only: inner_motion_type
  use gfb_natural_order, only: piece_order
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type
  use gfb_restart_fields, only: put_field, read_field
  implicit none (type)
  private
  public :: keep_modes, recall_modes

  character(len=*), parameter :: path(2) = [character(len=19) :: '/march/modes', '/march/modes_before']

contains

  !> Writes amplitudes, then their rates, now and one step ago.
  subroutine keep_modes(motion, file)
    type(inner_motion_type), intent(in) :: motion !! the modes, where there are any
    type(result_file_type), intent(inout) :: file !! that is being written
    logical, allocatable :: has(:, :)
    real(wp), allocatable :: value(:, :)
    integer :: step, most

    if (.not. motion%present) return
    has = modes_of_pieces(motion)
    most = size(has, 1)
    allocate (value(2*most, size(has, 2)))
    do step = 1, size(path)
      value(:most, :) = unpack(motion%amplitude(:, step), has, 0.0_wp)
      value(most + 1:, :) = unpack(motion%rate(:, step), has, 0.0_wp)
      call put_field(piece_order(motion), value, trim(path(step)), 'SI', &
                     'of modes inside a condensed piece: amplitudes, rates', file)
    end do
  end subroutine keep_modes

  !> Reads them again.
  subroutine recall_modes(file, motion)
    type(stored_file_type), intent(inout) :: file    !! that is being read
    type(inner_motion_type), intent(inout) :: motion !! that has begun anew, where there are any; gets them
    logical, allocatable :: has(:, :)
    real(wp), allocatable :: value(:, :)
    integer :: step, most

    if (.not. motion%present) return
    has = modes_of_pieces(motion)
    most = size(has, 1)
    do step = 1, size(path)
      value = read_field(piece_order(motion), 2*most, trim(path(step)), file)
      motion%amplitude(:, step) = pack(value(:most, :), has)
      motion%rate(:, step) = pack(value(most + 1:, :), has)
    end do
  end subroutine recall_modes

  !> Which modes each piece of this rank has, of as many as any piece has on any rank.
  function modes_of_pieces(motion) result(has)
    type(inner_motion_type), intent(in) :: motion !! the modes
    logical, allocatable :: has(:, :) !! (modes, pieces)
    integer, allocatable :: modes(:)
    integer :: i, most

    modes = [(spread(size(motion%inner(i)%eigenvalue), 1, size(motion%inner(i)%place)), i=1, size(motion%inner))]
    most = largest_number(modes)
    has = spread([(i, i=1, most)], 2, size(modes)) <= spread(modes, 1, most)
  end function modes_of_pieces
end module gfb_mode_restart
