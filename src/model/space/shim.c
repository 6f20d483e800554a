#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */
#include "gfb_shim.h"
#include <ftw.h>
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

/* Settings of a process that is alone. Two isolated ones would take the same session folder and the same names in shared
   memory: each gets a folder of its own, and messages to itself need no shared memory. */
static char        session[4096]; /* the folder */
static const char *const alone[][2] = {
  {"OMPI_MCA_orte_tmpdir_base", session},
  {"OMPI_MCA_ess_singleton_isolated", "1"},
  {"OMPI_MCA_pml", "ob1"},
  {"OMPI_MCA_btl", "self"},
};
static const size_t alone_settings = sizeof alone/sizeof *alone;
static int          is_alone       = 0;

/* What begins so was set by a launcher; a setting that is there, by a user who wants something of Open MPI. */
static int is_launched(void)
{
  static const char *const signs[] = {"PMIX_", "PMI_", "OMPI_COMM_", "OMPI_MCA_ess_", "SLURM_STEP", "ALPS_", "PALS_", "FLUX_",
                                      "JSM_"};
  extern char **environ;

  for (char **word = environ; word && *word; word++)
    for (size_t i = 0; i < sizeof signs/sizeof *signs; i++)
      if (strncmp(*word, signs[i], strlen(signs[i])) == 0) return 1;
  for (size_t i = 0; i < alone_settings; i++)
    if (getenv(alone[i][0])) return 1;
  return 0;
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *place)
{
  (void)status, (void)kind, (void)place;
  (void)!remove(path);
  return 0;
}

static void remove_session(void)
{
  nftw(session, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

void gfb_start_alone(void)
{
#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION < 5
  const char *folder = getenv("TMPDIR");

  if (is_launched()) return;
  if (snprintf(session, sizeof session, "%s/gfb-XXXXXX", folder && *folder ? folder : "/tmp") >= (int)sizeof session) return;
  if (!mkdtemp(session)) return;
  is_alone = 1;
  atexit(remove_session);
  for (size_t i = 0; i < alone_settings; i++) setenv(alone[i][0], alone[i][1], 1);
#endif
}

void gfb_started(void)
{
  for (size_t i = 0; is_alone && i < alone_settings; i++) unsetenv(alone[i][0]);
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
