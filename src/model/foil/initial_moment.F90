#include "gfb_petsc.h"
!> Load of a top foil that was rolled with another radius than the bore's, and lies in the bore now.
!>
!> Its bending strain is that of the displacements less \( \kappa_0 = 1/R_f - 1/R \) about the axis:
!> plane stress has the moments \( M_x = D \kappa_0 \) around and \( M_z = \nu D \kappa_0 \) along the
!> bearing in a foil that is held as the bore is, D of `plane_strain_section`. They do work on
!>
!> $$ f \cdot \delta u = \int M_x \Bigl( \delta\alpha_{,x} + \frac{\delta v}{R^2} \Bigr)
!>    + M_z \, \delta v_{,zz} \, dA $$
!>
!> The first term leaves couples at leading and trailing edge, the last at the sides, exactly those of
!> elements whose turns are linear. The second is the change of curvature of an arc that moves
!> inwards: what holds the foil in its circle is a pressure \( D \kappa_0 / R^2 \) from its bumps. It is the
!> only place where the foil is not unrolled: a flat one with couples at its edges would lie on
!> nothing between them.
module gfb_initial_moment
  use gfb_kinds, only: wp
  use gfb_top_foil_case, only: top_foil_case_type, initial_curvature
  use gfb_film_mesh, only: film_mesh_type
  use gfb_foil_surface, only: foil_surface_type
  use gfb_planar_beam, only: beam_section_type, plane_strain_section
  use gfb_meshed_foil, only: meshed_foil_type
  implicit none (type)
  private
  public :: add_initial_moment, set_initial_moment

  integer, parameter :: radial = 2, about_axis = 4, about_tangent = 5 !! of a node's unknowns

contains

  !> The load, where the case file asks for one; the foil's unknowns are numbered.
  subroutine add_initial_moment(top_foil, film, foil)
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    class(meshed_foil_type), intent(inout) :: foil !! gets the load
    type(foil_surface_type), allocatable :: surface(:)
    real(wp) :: along(size(film%station_angle)), across(size(film%row_axial))
    integer :: i, station, row, top

    if (.not. abs(initial_curvature(top_foil, film%surface%radius)) > 0.0_wp) return
    allocate (foil%initial_shape(foil%local_unknowns(), 2), source=0.0_wp)
    along = tributary(film%surface%radius*film%station_angle)
    across = tributary(film%row_axial)
    surface = foil%surfaces()
    top = findloc(surface%lies_on_film, .true., dim=1)
    associate (part => surface(top)%part)
      do i = 1, size(part%mesh_node)
        if (.not. part%owned(i)) cycle
        station = (part%mesh_node(i) - 1)/size(across) + 1
        row = part%mesh_node(i) - (station - 1)*size(across)
        call add(1, radial, along(station)*across(row)/film%surface%radius**2)
        call add(1, about_axis, across(row)*at_end(station, size(along)))
        call add(2, about_tangent, -along(station)*at_end(row, size(across)))
      end do
    end associate
    call set_initial_moment(top_foil, film%surface%radius, foil)

  contains

    !> Adds a force to an unknown of the node, where it has one.
    subroutine add(part, component, force)
      integer, intent(in) :: part, component !! of the moment; of the displacement
      real(wp), intent(in) :: force !! of a moment 1 N [1/m], [m]
      integer :: number

      number = foil%own_unknown(top, component, surface(top)%part%mesh_node(i))
      if (number > 0) foil%initial_shape(number, part) = foil%initial_shape(number, part) + force
    end subroutine add
  end subroutine add_initial_moment

  !> The load with thickness, material and free radius of a case file.
  pure subroutine set_initial_moment(top_foil, radius, foil)
    type(top_foil_case_type), intent(in) :: top_foil !! of a foil on the same mesh
    real(wp), intent(in) :: radius !! of the bearing [m]
    class(meshed_foil_type), intent(inout) :: foil !! gets the load, if it has any
    type(beam_section_type) :: section

    if (.not. allocated(foil%initial_shape)) return
    section = plane_strain_section(top_foil%thickness, top_foil%youngs_modulus, top_foil%poissons_ratio)
    foil%initial_curvature = initial_curvature(top_foil, radius)
    foil%initial_load = section%bending*foil%initial_curvature* &
                        (foil%initial_shape(:, 1) + top_foil%poissons_ratio*foil%initial_shape(:, 2))
  end subroutine set_initial_moment

  !> What a couple of 1 N per length does at a line of nodes: against the turn at the first, with it at the last.
  pure function at_end(line, last) result(sense)
    integer, intent(in) :: line, last
    real(wp) :: sense !! [1]

    sense = 0.0_wp
    if (line == 1) sense = -1.0_wp
    if (line == last) sense = 1.0_wp
  end function at_end

  !> Half the distance between the neighbours of each point of a line [m].
  pure function tributary(point) result(length)
    real(wp), intent(in) :: point(:) !! rising [m]
    real(wp) :: length(size(point))
    integer :: last

    last = size(point)
    length = 0.0_wp
    length(:last - 1) = 0.5_wp*(point(2:) - point(:last - 1))
    length(2:) = length(2:) + 0.5_wp*(point(2:) - point(:last - 1))
  end function tributary
end module gfb_initial_moment
