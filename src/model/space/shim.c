#include "gfb_shim.h"
#include <petscdmplex.h>
#include <petscsf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* PETSc's own handler aborts with the error's number as status. */
static PetscErrorCode end_with_sentence(MPI_Comm communicator, int line, const char *function, const char *file,
                                        PetscErrorCode code, PetscErrorType kind, const char *message, void *context)
{
  const int status_machine = 3;
  int       ranks, initialized;

  switch (code) {
  case PETSC_ERR_LIB:
  case PETSC_ERR_MEM:
  case PETSC_ERR_NOT_CONVERGED:
  case PETSC_ERR_CONV_FAILED:
  case PETSC_ERR_MAT_LU_ZRPVT:
  case PETSC_ERR_MAT_CH_ZRPVT:
  case PETSC_ERR_INT_OVERFLOW:
    break;
  default:
    return PetscTraceBackErrorHandler(communicator, line, function, file, code, kind, message, context);
  }
  if (kind != PETSC_ERROR_INITIAL) return code;
  fflush(stdout);
  fprintf(stderr, "a library failed, in %s: %s\n", function ? function : "a library",
          message && *message ? message : (code == PETSC_ERR_MEM ? "no memory" : "no reason was given"));
  fflush(stderr);
  MPI_Initialized(&initialized);
  if (initialized && MPI_Comm_size(MPI_COMM_WORLD, &ranks) == MPI_SUCCESS && ranks > 1) MPI_Abort(MPI_COMM_WORLD, status_machine);
  exit(status_machine);
}

PetscErrorCode gfb_end_with_sentences(void)
{
  PetscFunctionBegin;
  PetscCall(PetscPushErrorHandler(end_with_sentence, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_create_plex(MPI_Fint communicator, PetscInt cells, PetscInt vertices, PetscInt all_vertices,
                               const PetscInt cell[], const PetscReal coordinate[], intptr_t *dm)
{
  const PetscInt dimensions = 2, corners = 4;
  PetscSF        owners;
  DM             plex;

  PetscFunctionBegin;
  PetscCall(DMPlexCreateFromCellListParallelPetsc(MPI_Comm_f2c(communicator), dimensions, cells, vertices, all_vertices,
                                                  corners, PETSC_FALSE, cell, dimensions, coordinate, &owners, NULL, &plex));
  PetscCall(PetscSFDestroy(&owners));
  *dm = (intptr_t)plex;
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_set_shell_partition(intptr_t dm, PetscInt parts, const PetscInt sizes[], const PetscInt cells[])
{
  PetscPartitioner partitioner;

  PetscFunctionBegin;
  PetscCall(DMPlexGetPartitioner((DM)dm, &partitioner));
  PetscCall(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  PetscCall(PetscPartitionerShellSetPartition(partitioner, parts, sizes, cells));
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_all_options(char words[], size_t length)
{
  char *all;

  PetscFunctionBegin;
  PetscCall(PetscOptionsGetAll(NULL, &all));
  PetscCall(PetscStrncpy(words, all, length));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}
