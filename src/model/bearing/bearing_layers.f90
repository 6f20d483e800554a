!> Layers of a bearing's unknowns: stations of films, each coupled with those beside it alone.
module gfb_bearing_layers
  use gfb_petsc_session, only: rank_count
  use gfb_bearing, only: bearing_type
  implicit none (type, external)
  private
  public :: layers_of

  !> unknowns of a layer: of 33 rows of nodes with three each, and what springs add. With 40 rows
  !> the factors take a sixth more memory in all than MUMPS', with 64 two fifths, and of few wide
  !> layers (biquadratic sectors) more time.
  integer, parameter :: widest = 104

contains

  !> The layer of each unknown, from 1; 0: of walls and the shaft, which are coupled with all. None
  !> on several ranks, of foils with meshes of their own, of a film all around, whose last station
  !> is coupled with the first, and of wide films.
  function layers_of(bearing) result(layer)
    class(bearing_type), intent(in) :: bearing !! numbered
    integer, allocatable :: layer(:) !! (unknowns)
    integer, allocatable :: width(:)
    integer :: i, before

    if (rank_count() > 1 .or. bearing%is_meshed() .or. bearing%mesh%periodic) then
      allocate (layer(0))
      return
    end if
    allocate (layer(bearing%local_size()), source=0)
    before = 0
    do i = 1, size(bearing%pad)
      call place_pad(bearing, i, before, layer)
      before = maxval(layer)
    end do
    allocate (width(0:before), source=0)
    do i = 1, size(layer)
      width(layer(i)) = width(layer(i)) + 1
    end do
    if (maxval(width) > widest) layer = [integer ::]
  end function layers_of

  !> Layers of what stands at the nodes of a pad.
  pure subroutine place_pad(bearing, number, before, layer)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: before !! layers of the pads before
    integer, intent(inout) :: layer(:)
    integer :: b, node, here

    associate (pad => bearing%pad(number), of => bearing%blocks%global + 1)
      do node = 1, size(pad%mesh%mesh_node)
        ! An element of second order spans three stations.
        here = before + (pad%mesh%mesh_node(node) - 1)/pad%whole%rows()/pad%whole%order + 1
        layer(of(pad%first + node)) = here
        associate (mean => pad%foil%source(node)) ! of a station, by which its springs move
          if (mean > 0) layer(of(pad%first + mean)) = here
        end associate
        do b = 1, size(bearing%block)
          associate (fields => bearing%block(b)%fields)
            if (fields == 0) cycle
            associate (last => bearing%block(b)%first(number) + fields*node)
              layer(of(last - fields + 1:last)) = here
            end associate
          end associate
        end do
      end do
    end associate
  end subroutine place_pad
end module gfb_bearing_layers
