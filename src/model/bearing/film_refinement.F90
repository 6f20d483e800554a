!> The film's mesh where it is fed, and where grooves begin and end: sides of elements through the centres of orifices and along
!> the ends of bands.
module gfb_film_refinement
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: pad_rows
  use gfb_feed_case, only: hole_type, find_holes, spread_line
  use gfb_film_mesh, only: film_mesh_type
  use gfb_graded_places, only: graded_places
  use gfb_scene, only: scene_type
  implicit none (type, external)
  private
  public :: refine_at_holes, meet_bands

  real(wp), parameter :: near = 1.0e-6_wp !! rows that mirror each other, relative [1]

contains

  !> Puts sides of elements on the ends of bands of grooves, where the slope of the pressure jumps.
  subroutine meet_bands(scene, mesh)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(film_mesh_type), intent(inout) :: mesh !! of the first pad
    real(wp), parameter :: any_size = huge(any_size) !! no element is finer there
    real(wp), allocatable :: place(:)

    associate (ends => scene%grooves%row_ends(pad_rows(scene%bearing)))
      if (size(ends) == 0) return
      place = graded_rows(mesh, [real(wp) ::], ends, any_size)
      call put_places(place, mesh%order, .false., mesh%row_axial)
    end associate
  end subroutine meet_bands

  !> Puts sides of elements on the centres of orifices, as long there as a mouth's radius, and on rows that are spread.
  !>
  !> Foils that are meshed, or lie on crests, keep their stations: there holes lie where they do.
  subroutine refine_at_holes(scene, kept, mesh)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp), intent(in) :: kept(:) !! angles of sides that stay [rad]
    type(film_mesh_type), intent(inout) :: mesh !! of the first pad
    type(hole_type), allocatable :: hole(:)
    real(wp), allocatable :: angle(:), along(:), bands(:)
    real(wp) :: radius
    integer :: i

    if (.not. scene%feed%has_orifices() .or. scene%model%foil%has_top_foil) return
    along = scene%feed%row_positions
    bands = scene%grooves%row_ends(pad_rows(scene%bearing))
    radius = 0.5_wp*scene%feed%mouth_diameter
    if (scene%feed%spread == spread_line) then
      call put_places(graded_rows(mesh, bands, along, huge(radius)), mesh%order, .false., mesh%row_axial)
      return
    end if
    call put_places(graded_rows(mesh, bands, along, radius), mesh%order, .false., mesh%row_axial)
    allocate (angle(0))
    do i = 1, scene%bearing%pads
      call find_holes(scene%feed, scene%bearing, i, hole)
      angle = [angle, hole%angle]
    end do
    if (mesh%periodic) angle = [angle - turn, angle, angle + turn]
    associate (order => mesh%order, finest => radius/maxval(mesh%surface%radius_at(abs(along))), station => mesh%station_angle)
      if (mesh%periodic) then
        call put_places(graded_places([station(1::order), station(1) + turn], kept, angle, finest), order, .true., mesh%station_angle)
      else
        call put_places(graded_places(station(1::order), kept, angle, finest), order, .false., mesh%station_angle)
      end if
    end associate
  end subroutine refine_at_holes

  !> Rows with sides on some; where they mirror each other about the middle of the width, to the last digit.
  function graded_rows(mesh, kept, along, finest) result(place)
    type(film_mesh_type), intent(in) :: mesh
    real(wp), intent(in) :: kept(:) !! rows that have sides already [m]
    real(wp), intent(in) :: along(:), finest !! those where elements are finest, and how long there [m]
    real(wp), allocatable :: place(:)
    real(wp), allocatable :: side(:)

    side = mesh%row_axial(1::mesh%order)
    if (mesh%half) then
      place = graded_places(side, [kept, -kept], [along, -along], finest)
    else if (mirrored(kept) .and. mirrored(along) .and. .not. mesh%surface%is_ring() .and. any(abs(side) <= 0.0_wp)) then
      place = graded_places(pack(side, side >= 0.0_wp), [kept, -kept], [along, -along], finest)
      place = [-place(size(place):2:-1), place]
    else
      place = graded_places(side, kept, along, finest)
    end if
  end function graded_rows

  !> Whether rows mirror each other about the middle of the width; none do.
  pure logical function mirrored(along)
    real(wp), intent(in) :: along(:) !! rising [m]
    mirrored = all(abs(along + along(size(along):1:-1)) <= near*maxval([0.0_wp, abs(along)]))
  end function mirrored

  !> Places of nodes by the sides of their elements; those of biquadratic ones have one in their middle.
  subroutine put_places(side, order, ring, place)
    real(wp), intent(in) :: side(:) !! first to last
    integer, intent(in) :: order
    logical, intent(in) :: ring !! the last side is the first
    real(wp), allocatable, intent(out) :: place(:)
    integer :: n

    n = size(side) - 1
    allocate (place(order*n + 1))
    place(1::order) = side
    if (order == 2) place(2::2) = 0.5_wp*(side(:n) + side(2:))
    if (ring) place = place(:order*n)
  end subroutine put_places
end module gfb_film_refinement
