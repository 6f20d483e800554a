!> Top foil and bump strip as planar beams under the film.
!>
!> The equations are those of shells all nodes of whose stations move as one: along x, along v, and
!> turning about the axis. So the station's force is the sum of the shells' forces on its nodes,
!>
!> $$ f_i = \int N_i(x) \int (p - p_a) \, dz \, dx, $$
!>
!> which knows of the film no more than its mean along the axis. Forces are those on the solved
!> width. What differs from shells is the stiffness, and how the foil is built.
module gfb_beam_foil
  use gfb_shell_foil, only: shell_foil_type
  implicit none (type, external)
  private

  !> Both foils and this rank's part of their equations; the meshes are those that shells would
  !> have, the numbers of unknowns those that a station's nodes share.
  type, extends(shell_foil_type), public :: beam_foil_type
  end type beam_foil_type
end module gfb_beam_foil
