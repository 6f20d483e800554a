/* MUMPS in complex arithmetic, called directly: a PETSc of real numbers calls it in real arithmetic only. */
#include <stdint.h>
#include <stdlib.h>
#include <zmumps_c.h>

_Static_assert(sizeof(MUMPS_INT) == 4, "MUMPS was built for integers of 8 bytes");

/* An instance for a matrix of which this rank gives some entries, numbered from 1; the arrays stay the caller's. Null
   where there is no memory. Whatever has no choice here is set by gfb_mumps_control. */
ZMUMPS_STRUC_C *gfb_mumps_create(int communicator, int order, int64_t entries, int *row, int *column, ZMUMPS_COMPLEX *value)
{
  const int       silent = 3, distributed = 18;
  ZMUMPS_STRUC_C *one = calloc(1, sizeof *one);

  if (!one) return NULL;
  one->comm_fortran = communicator;
  one->par = 1;
  one->job = -1;
  zmumps_c(one);
  for (int i = 0; i < silent; i++) one->icntl[i] = -1;
  one->icntl[silent] = 0;
  one->icntl[distributed - 1] = 3;
  one->n = order;
  one->nnz_loc = entries;
  one->irn_loc = row;
  one->jcn_loc = column;
  one->a_loc = value;
  return one;
}

/* ICNTL(place), as the manual of MUMPS numbers it. */
void gfb_mumps_control(ZMUMPS_STRUC_C *one, int place, int value)
{
  one->icntl[place - 1] = value;
}

/* Analysis (job 1), factors (2) or solutions (3); returns INFOG(1), negative where it failed. The right sides, wanted one
   behind the other on the first rank, are overwritten by their solutions. */
int gfb_mumps_run(ZMUMPS_STRUC_C *one, int job, int sides, ZMUMPS_COMPLEX *right)
{
  one->job = job;
  one->rhs = right;
  one->nrhs = sides;
  one->lrhs = one->n;
  zmumps_c(one);
  return one->infog[0];
}

/* Determinant of the matrix that was factored last, (part[0] + i part[1]) 2^exponent, on the first rank. */
void gfb_mumps_determinant(const ZMUMPS_STRUC_C *one, double *part, int *exponent)
{
  part[0] = one->rinfog[11];
  part[1] = one->rinfog[12];
  *exponent = one->infog[33];
}

void gfb_mumps_destroy(ZMUMPS_STRUC_C *one)
{
  one->job = -2;
  zmumps_c(one);
  free(one);
}
