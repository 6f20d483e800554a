/* MUMPS in complex arithmetic, called directly: a PETSc of real numbers calls it in real arithmetic only. */
#include <stdint.h>
#include <stdlib.h>
#include <zmumps_c.h>

_Static_assert(sizeof(MUMPS_INT) == 4, "MUMPS was built for integers of 8 bytes");

/* An instance for a matrix of which this rank gives some entries, numbered from 1; the arrays stay the caller's. Null
   where there is no memory. Whatever has no choice here is set by gfb_mumps_control. */
ZMUMPS_STRUC_C *gfb_mumps_create(int communicator, int order, int64_t entries, int *row, int *column)
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
  return one;
}

/* Where the matrix' entries are, in the order of rows and columns. */
void gfb_mumps_take(ZMUMPS_STRUC_C *one, ZMUMPS_COMPLEX *value)
{
  one->a_loc = value;
}

/* ICNTL(place), as the manual of MUMPS numbers it. */
void gfb_mumps_control(ZMUMPS_STRUC_C *one, int place, int value)
{
  one->icntl[place - 1] = value;
}

/* What ICNTL(place) is. */
int gfb_mumps_told(const ZMUMPS_STRUC_C *one, int place)
{
  return one->icntl[place - 1];
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

/* Entries that this rank's factors and fronts take, or fronts alone where factors go to files, as the analysis has estimated
   them with ICNTL(14) [1]. */
int64_t gfb_mumps_entries(const ZMUMPS_STRUC_C *one)
{
  const int     on_disk = one->icntl[21], entries = on_disk ? one->info[19] : one->info[7];
  const int64_t million = 1000000;

  return entries < 0 ? -million * entries : entries;
}

/* Where factors and fronts go, which MUMPS finds room for itself before; the caller keeps it as long as it solves. MUMPS counts
   many entries in millions. */
void gfb_mumps_use(ZMUMPS_STRUC_C *one, ZMUMPS_COMPLEX *room, int64_t entries)
{
  const int64_t million = 1000000;

  one->wk_user = room;
  one->lwk_user = entries <= INT32_MAX ? (int)entries : -(int)(entries / million);
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
