!> Kinds of numbers, and how many pads they are kept for.
module gfb_kinds
  use, intrinsic :: iso_fortran_env, only: real64, int64
  implicit none (type, external)
  private
  public :: wp, long, most_pads

  integer, parameter :: wp = real64   !! every real of the program
  integer, parameter :: long = int64  !! counts that can exceed two thousand million
  integer, parameter :: most_pads = 24 !! of a bearing
end module gfb_kinds
