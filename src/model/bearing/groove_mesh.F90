!> The film's mesh along grooves, each of which it resolves.
module gfb_groove_mesh
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: pad_rows
  use gfb_film_mesh, only: film_mesh_type, axial_rows
  use gfb_scene, only: scene_type
  implicit none (type, external)
  private
  public :: lay_along_grooves

  real(wp), parameter :: near = 1.0e-6_wp !! the middle of the width, over half of it [1]

contains

  !> Lays a ring's mesh along grooves: sides of elements on their edges and on the ends of their bands, elements narrower towards
  !> both, stations that are turned from row to row as the lines are.
  !>
  !> A line that makes the angle b with the motion turns by \( d\theta = \cot b \, ds/r(s) \).
  subroutine lay_along_grooves(scene, elements, mesh)
    type(scene_type), intent(in) :: scene !! with grooves that are meshed
    integer, intent(in) :: elements !! across the whole width, about
    type(film_mesh_type), intent(inout) :: mesh !! a ring, of the same order, width and surface
    real(wp), allocatable :: part(:), bound(:)
    real(wp) :: rows(2), pitch
    integer :: groove, around, i, k

    associate (grooves => scene%grooves)
      around = grooves%whole_elements(size(mesh%station_angle)/mesh%order)/grooves%count
      groove = min(max(2, nint(real(around, wp)*(1.0_wp - grooves%ridge_part))), around - 2)
      pitch = turn/real(grooves%count, wp)
      part = [graded([0.0_wp, 1.0_wp - grooves%ridge_part], groove), graded([1.0_wp - grooves%ridge_part, 1.0_wp], around - groove)]
      mesh%station_angle = [(pitch*(real(i, wp) + part), i=0, grooves%count - 1)]
      rows = pad_rows(scene%bearing)
      bound = [rows(1), grooves%row_ends(rows), rows(2)]
      ! Both halves of a width that mirrors are meshed as the half alone would be.
      if (rows(1) < 0.0_wp .and. grooves%mirrors()) then
        bound = [0.0_wp, pack(bound, bound > near*rows(2))]
        if (.not. mesh%half) bound = [-bound(size(bound):2:-1), bound]
      end if
      mesh%row_axial = [real(wp) ::]
      do k = 1, size(bound) - 1
        associate (share => (bound(k + 1) - bound(k))/(rows(2) - rows(1)))
          mesh%row_axial = [mesh%row_axial, graded(bound(k:k + 1), max(2, nint(real(elements, wp)*share)))]
        end associate
      end do
      mesh%row_axial = [mesh%row_axial, bound(size(bound))]
      mesh%slant = slants(scene, mesh)
    end associate

  contains

    !> Places of nodes between two ends, without the last one.
    function graded(ends, elements) result(place)
      real(wp), intent(in) :: ends(2)
      integer, intent(in) :: elements
      real(wp), allocatable :: place(:)

      place = 0.5_wp*sum(ends) + axial_rows(ends(2) - ends(1), elements, .false., scene%mesh%edge_refinement, mesh%order)
      place(1) = ends(1)
      place = place(:size(place) - 1)
    end function graded
  end subroutine lay_along_grooves

  !> By which stations are turned at each row of a mesh along grooves; not at z = 0 [rad].
  function slants(scene, mesh) result(slant)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: mesh
    real(wp) :: slant(size(mesh%row_axial))
    real(wp) :: angle, radius(2), length
    integer :: i

    slant = 0.0_wp
    associate (row => mesh%row_axial)
      do i = 2, size(row)
        slant(i) = slant(i - 1)
        angle = scene%grooves%line_angle(0.5_wp*(row(i - 1) + row(i)))
        if (.not. abs(angle) > 0.0_wp) cycle
        radius = mesh%surface%radius_at(row(i - 1:i))
        length = (row(i) - row(i - 1))/radius(1)
        if (abs(radius(2) - radius(1)) > 0.0_wp) length = (row(i) - row(i - 1))*log(radius(2)/radius(1))/(radius(2) - radius(1))
        slant(i) = slant(i) + length/tan(angle)
      end do
      if (row(1) < 0.0_wp) slant = slant - slant(minloc(abs(row), 1))
    end associate
  end function slants
end module gfb_groove_mesh
