#include "gfb_shim.h"
#include <petscdmplex.h>
#include <petscsf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int status_machine = 3;

/* Otherwise PETSc starts or ends, where all that fails is what an option asks for. */
static int computing = 0;

void gfb_computing(int now)
{
  computing = now;
}

static int begins(const char *function, const char *name)
{
  return function && strncmp(function, name, strlen(name)) == 0;
}

/* Whether PETSc, whose older versions give a line for the code then, or MUMPS, where it solves, got no memory. */
static int is_memory(PetscErrorCode code, const char *function, const char *message)
{
  return code == PETSC_ERR_MEM || begins(function, "PetscMalloc") || begins(function, "PetscRealloc")
      || (message && strstr(message, "INFOG(1)=-13"));
}

/* Whether an error is a failure of the machine's, or of an option that the user gave PETSc, and no mistake of the program's. */
static int is_outside(PetscErrorCode code, const char *function, const char *message)
{
  if (is_memory(code, function, message)) return 1;
  switch (code) {
  case PETSC_ERR_LIB:
  case PETSC_ERR_NOT_CONVERGED:
  case PETSC_ERR_CONV_FAILED:
  case PETSC_ERR_MAT_LU_ZRPVT:
  case PETSC_ERR_MAT_CH_ZRPVT:
  case PETSC_ERR_INT_OVERFLOW:
  case PETSC_ERR_FILE_OPEN:
  case PETSC_ERR_FILE_READ:
  case PETSC_ERR_FILE_WRITE:
  case PETSC_ERR_ARG_UNKNOWN_TYPE:
  case PETSC_ERR_MISSING_FACTOR:
    return 1;
  default:
    return !computing || begins(function, "PetscOptions");
  }
}

/* PETSc's own handler aborts with the error's number as status. */
static PetscErrorCode end_with_sentence(MPI_Comm communicator, int line, const char *function, const char *file,
                                        PetscErrorCode code, PetscErrorType kind, const char *message, void *context)
{
  const char *options = getenv("PETSC_OPTIONS");
  int         ranks, initialized;

  if (!is_outside(code, function, message)) return PetscTraceBackErrorHandler(communicator, line, function, file, code, kind, message, context);
  if (kind != PETSC_ERROR_INITIAL) return code;
  fflush(stdout);
  fprintf(stderr, "a library failed, in %s: %s", function ? function : "a library",
          is_memory(code, function, message) ? "no memory" : message && *message ? message : "no reason was given");
  if (options && *options) fprintf(stderr, "; PETSC_OPTIONS is '%s'", options);
  fprintf(stderr, "\n");
  fflush(stderr);
  gfb_started(); /* that was the sentence */
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
