#include "gfb_shim.h"
#include <petscdmplex.h>
#include <petscsf.h>

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
