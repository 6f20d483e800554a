/* What PETSc and the C library offer without a Fortran binding. */
#ifndef GFB_SHIM_H
#define GFB_SHIM_H
#include <stdint.h>
#include <petscsys.h>

/* Starts MPI where it has not started: until gfb_started the end of the process is a sentence and status 3. A process that no
   launcher has started, by Open MPI up to 4, needs no helper daemon where it shares nothing with others: its session folder is its
   own, and gone when it ends. Where a launcher, or the user, has set Open MPI up, that is all. What it loads takes no settings
   from the current folder. */
void gfb_start_mpi(void);

/* Starts PETSc and SLEPc, and MPI where it has not started; the communicator (of Fortran) is that of this group of ranks where it
   has. Words: the program's name and the options that were typed for PETSc, each with a zero behind it, in all so many characters.
   Of files of options that nobody has named only that of the home is read. */
PetscErrorCode gfb_start_slepc(MPI_Fint communicator, const char words[], size_t length);

/* To be called when MPI has started: takes back what was set in the environment, and what the end means. */
void gfb_started(void);

/* Makes what a library cannot do, such as factors that do not fit, end the program with a sentence and status 3; to be called
   before PETSc starts. */
PetscErrorCode gfb_end_with_sentences(void);

/* From now on, or no longer, what PETSc complains about may be a mistake of the program's, which it shows with its calls. */
void gfb_computing(int now);

/* A DMPlex of quadrilaterals, of which every rank gives some cells (numbers of their vertices among all, from 0)
   and the places of some vertices (in the order of the ranks); hands out its Fortran handle. */
PetscErrorCode gfb_create_plex(MPI_Fint communicator, PetscInt cells, PetscInt vertices, PetscInt all_vertices,
                               const PetscInt cell[], const PetscReal coordinate[], intptr_t *dm);

/* Gives a DMPlex (its Fortran handle) the part of each of this rank's cells before it is distributed: sizes of the
   parts, and the cells of each part one after the other. */
PetscErrorCode gfb_set_shell_partition(intptr_t dm, PetscInt parts, const PetscInt sizes[], const PetscInt cells[]);

/* All options that PETSc knows now, names and values with blanks between, as far as `length` characters hold them
   with the closing zero. */
PetscErrorCode gfb_all_options(char words[], size_t length);

#endif
