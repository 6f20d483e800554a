!> The top foil's mesh over a film.
module gfb_top_mesh
  use gfb_kinds, only: wp
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_foil_mesh, only: top_foil_mesh
  implicit none (type, external)
  private
  public :: top_mesh

contains

  !> The top foil on the film's nodes, unrolled: x = R (theta - theta_0).
  pure function top_mesh(film, height, window) result(mesh)
    type(film_mesh_type), intent(in) :: film   !! the film's mesh
    real(wp), intent(in) :: height             !! of the mid-surface above the flats' [m]
    integer, intent(in), optional :: window(2) !! first and last station; default: all
    type(quad_mesh_type) :: mesh

    mesh = top_foil_mesh(film%radius*(film%station_angle - film%station_angle(1)), height, &
                         film%row_axial, film%half, window)
  end function top_mesh
end module gfb_top_mesh
