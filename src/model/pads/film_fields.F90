!> Fields of the film on the whole pads, whichever rank knows their nodes.
module gfb_film_fields
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: fetch_entries
  use gfb_bearing, only: bearing_type
  implicit none (type, external)
  private
  public :: film_values, full_rows, film_block

contains

  !> A field of the films, known at each rank's nodes pad by pad, at any nodes of the pads' whole meshes, which are
  !> numbered pad by pad.
  function film_values(bearing, value, wanted) result(found)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    real(wp), intent(in) :: value(:)     !! at the local film nodes, in any unit [SI]
    integer, intent(in) :: wanted(:)     !! nodes of the whole meshes
    real(wp) :: found(size(wanted))
    real(wp) :: own(1, size(bearing%pad)*count(bearing%pad(1)%mesh%owned))
    integer :: number(size(own)), nodes, first, i

    nodes = bearing%mesh%nodes()
    first = 0
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), last => first + count(bearing%pad(i)%mesh%owned))
        own(1, first + 1:last) = pack(value(pad%first_node + 1:pad%last_node), pad%mesh%owned)
        number(first + 1:last) = (i - 1)*nodes + pack(pad%mesh%mesh_node, pad%mesh%owned)
      end associate
      first = first + count(bearing%pad(i)%mesh%owned)
    end do
    found = pack(fetch_entries(size(bearing%pad)*nodes, number, own, wanted), .true.)
  end function film_values

  !> Rows of the whole width, also where half of it is solved.
  pure function full_rows(bearing) result(position)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    real(wp), allocatable :: position(:) !! z [m]

    associate (z => bearing%mesh%row_axial)
      if (bearing%mesh%half) then
        position = [-z(size(z):2:-1), z]
      else
        position = z
      end if
    end associate
  end function full_rows

  !> This rank's consecutive part of a film field on the whole pads: pad by pad, station by station, rows of the whole
  !> width, a ring closed by its first station.
  subroutine film_block(bearing, value, first, last, block)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    real(wp), intent(in) :: value(:)   !! at the local film nodes, in any unit [SI]
    integer, intent(in) :: first, last !! nodes of the pads this rank takes, from 1
    real(wp), allocatable, intent(out) :: block(:) !! of these nodes, in the same unit [SI]

    integer, allocatable :: wanted(:)
    integer :: i, rows, row, station, lines, pad

    associate (whole => bearing%mesh)
      rows = size(full_rows(bearing))
      lines = whole%circumferential() + 1
      allocate (wanted(last - first + 1))
      do i = first, last
        pad = (i - 1)/(lines*rows)
        station = modulo((i - 1)/rows - pad*lines, whole%stations())
        row = modulo(i - 1, rows) + 1
        if (whole%half) row = abs(row - whole%rows()) + 1
        pad = pad/whole%repeats ! the others are the same
        wanted(i - first + 1) = pad*whole%nodes() + station*whole%rows() + row
      end do
    end associate
    block = film_values(bearing, value, wanted)
  end subroutine film_block
end module gfb_film_fields
