!> How a bump strip begins at its fixed edge: the words of a case file and the meshes share them.
module gfb_fixed_lines
  implicit none (type, external)
  private

  integer, parameter, public :: fixed_line_corner = 1    !! with an arc, its corner clamped
  integer, parameter, public :: fixed_line_flat = 2      !! with a flat, its edge clamped
  integer, parameter, public :: fixed_line_half_flat = 3 !! half a flat at each end, edge clamped
end module gfb_fixed_lines
