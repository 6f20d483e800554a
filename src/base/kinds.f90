!> Kinds of numbers.
module gfb_kinds
  use, intrinsic :: iso_fortran_env, only: real64, int64
  implicit none (type, external)
  private
  public :: wp, long

  integer, parameter :: wp = real64   !! every real of the program
  integer, parameter :: long = int64  !! counts that can exceed two thousand million
end module gfb_kinds
