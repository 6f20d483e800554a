/* What PETSc and the C library offer without a Fortran binding. */
#ifndef GFB_SHIM_H
#define GFB_SHIM_H
#include <stdint.h>
#include <petscsys.h>

/* Gives a DMPlex (its Fortran handle) the part of every cell before it is distributed: sizes of the
   parts, and the cells of each part one after the other, both read on the first rank. */
PetscErrorCode gfb_set_shell_partition(intptr_t dm, PetscInt parts, const PetscInt sizes[], const PetscInt cells[]);

#endif
