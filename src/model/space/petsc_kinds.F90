#include "gfb_petsc.h"
!> Kinds of PETSc's numbers, for literals.
module gfb_petsc_kinds
  use petscsys
  implicit none (type)
  private

  PetscInt, parameter :: sample_int = 0
  PetscReal, parameter :: sample_real = 0.0
  integer, parameter, public :: pint = kind(sample_int)   !! kind of PetscInt
  integer, parameter, public :: preal = kind(sample_real) !! kind of PetscReal
end module gfb_petsc_kinds
