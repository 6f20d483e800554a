/* What PETSc's log (-log_view) does not show, for tools/bench scaling; preloaded into gfb (LD_PRELOAD).
 *
 * Times of the log become CPU times of each process, because PETSc reads its clock by MPI_Wtime. Waiting for another rank
 * is not counted; Open MPI yields where it is idle (mpi_yield_when_idle), and who waits naps. Messages that Fortran
 * libraries send, MUMPS that is, are counted for each of MUMPS' phases: PETSc counts its own only. Each rank leaves a
 * line "calls messages bytes collectives" for every phase in the file $GFB_PROBE_FILE.<rank>, and PETSc's log of its own
 * in $GFB_PROBE_FILE.log.<rank>: written by all ranks in turn, line by line, it takes longer than the run on 32 of them.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <time.h>

/* What a phase has cost. */
typedef struct {
  long calls, messages, bytes, collectives;
} cost_type;

enum { outside, analysis, factorization, solve, phases };

static cost_type cost[phases];
static int phase = outside;

static int alone = 1; /* whether the job has one rank */
static double waited; /* s of CPU time spent asking whether a message has come */

static double cpu_time(void)
{
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1.0e-9 * (double)now.tv_nsec;
}

double MPI_Wtime(void)
{
  return cpu_time() - waited;
}

/* Who yields again and again without working in between waits for another rank: it naps, so that others get on, and what
 * its waking costs is no work. MUMPS yields while it works, too, between its fronts; that is no waiting. */
int sched_yield(void)
{
  static const long between = 2000, patience = 200; /* ns that are no work; yields in a row */
  static const struct timespec nap = {0, 20000};
  static struct timespec last;
  static double woken = -1.0;
  static long yields;
  struct timespec now;

  if (alone) return 0;
  clock_gettime(CLOCK_MONOTONIC, &now);
  yields = (now.tv_sec - last.tv_sec) * 1000000000L + now.tv_nsec - last.tv_nsec < between ? yields + 1 : 0;
  last = now;
  if (yields < patience) {
    woken = -1.0;
    return 0;
  }
  if (woken < 0.0) woken = cpu_time();
  nanosleep(&nap, NULL);
  waited -= woken;
  woken = cpu_time();
  waited += woken;
  clock_gettime(CLOCK_MONOTONIC, &last);
  return 0;
}

__attribute__((constructor)) static void wake_in_time(void)
{
  const char *ranks = getenv("OMPI_COMM_WORLD_SIZE");

  unsetenv("LD_PRELOAD"); /* what Open MPI starts beside a process that runs alone would write its counts anew */
  alone = !ranks || atoi(ranks) < 2;
  prctl(PR_SET_TIMERSLACK, 1000UL, 0UL, 0UL, 0UL);
}

/* The start of MUMPS' C structure, in every version. */
typedef struct {
  int sym, par, job;
} mumps_start_type;

void dmumps_c(mumps_start_type *mumps)
{
  void (*real_one)(mumps_start_type *) = (void (*)(mumps_start_type *))dlsym(RTLD_NEXT, "dmumps_c");
  phase = mumps->job > outside && mumps->job < phases ? mumps->job : outside;
  cost[phase].calls++;
  real_one(mumps);
  phase = outside;
}

static const char *rank_text(void)
{
  const char *rank = getenv("OMPI_COMM_WORLD_RANK");
  if (!rank) rank = getenv("PMI_RANK");
  return rank ? rank : "0";
}

/* What of PETSc is called; its headers need not be there. */
int PetscViewerASCIIOpen(MPI_Comm, const char *, void **);
int PetscViewerGetFormat(void *, int *);
int PetscViewerPushFormat(void *, int);
int PetscViewerDestroy(void **);

int PetscLogView(void *of_all)
{
  int (*real_one)(void *) = (int (*)(void *))dlsym(RTLD_NEXT, "PetscLogView");
  const char *file = getenv("GFB_PROBE_FILE");
  char path[4096];
  void *own;
  int format, error;

  if (!file) return real_one(of_all);
  snprintf(path, sizeof path, "%s.log.%s", file, rank_text());
  error = PetscViewerGetFormat(of_all, &format);
  if (!error) error = PetscViewerASCIIOpen(MPI_COMM_SELF, path, &own);
  if (!error) error = PetscViewerPushFormat(own, format);
  if (!error) error = real_one(own);
  return error ? error : PetscViewerDestroy(&own);
}

static int rank_count(const MPI_Fint *communicator)
{
  int ranks = 1;
  PMPI_Comm_size(PMPI_Comm_f2c(*communicator), &ranks);
  return ranks;
}

static void count_message(const MPI_Fint *count, const MPI_Fint *type)
{
  int bytes = 0;
  PMPI_Type_size(PMPI_Type_f2c(*type), &bytes);
  cost[phase].messages++;
  cost[phase].bytes += (long)*count * bytes;
}

#define SEND(name)                                                                                          \
  void p##name(void *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *);              \
  void name(void *data, MPI_Fint *count, MPI_Fint *type, MPI_Fint *to, MPI_Fint *tag, MPI_Fint *communicator, \
            MPI_Fint *error)                                                                                \
  {                                                                                                         \
    count_message(count, type);                                                                             \
    p##name(data, count, type, to, tag, communicator, error);                                               \
  }

#define SEND_LATER(name)                                                                                    \
  void p##name(void *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *);  \
  void name(void *data, MPI_Fint *count, MPI_Fint *type, MPI_Fint *to, MPI_Fint *tag, MPI_Fint *communicator, \
            MPI_Fint *request, MPI_Fint *error)                                                             \
  {                                                                                                         \
    count_message(count, type);                                                                             \
    p##name(data, count, type, to, tag, communicator, request, error);                                      \
  }

SEND(mpi_send_)
SEND(mpi_ssend_)
SEND_LATER(mpi_isend_)

static void count_collective(const MPI_Fint *communicator)
{
  if (rank_count(communicator) > 1) cost[phase].collectives++;
}

void pmpi_allreduce_(void *, void *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *);
void mpi_allreduce_(void *from, void *to, MPI_Fint *count, MPI_Fint *type, MPI_Fint *operation, MPI_Fint *communicator,
                    MPI_Fint *error)
{
  count_collective(communicator);
  pmpi_allreduce_(from, to, count, type, operation, communicator, error);
}

void pmpi_reduce_(void *, void *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *);
void mpi_reduce_(void *from, void *to, MPI_Fint *count, MPI_Fint *type, MPI_Fint *operation, MPI_Fint *root,
                 MPI_Fint *communicator, MPI_Fint *error)
{
  count_collective(communicator);
  pmpi_reduce_(from, to, count, type, operation, root, communicator, error);
}

void pmpi_bcast_(void *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *, MPI_Fint *);
void mpi_bcast_(void *data, MPI_Fint *count, MPI_Fint *type, MPI_Fint *root, MPI_Fint *communicator, MPI_Fint *error)
{
  count_collective(communicator);
  pmpi_bcast_(data, count, type, root, communicator, error);
}

void pmpi_barrier_(MPI_Fint *, MPI_Fint *);
void mpi_barrier_(MPI_Fint *communicator, MPI_Fint *error)
{
  count_collective(communicator);
  pmpi_barrier_(communicator, error);
}

__attribute__((destructor)) static void write_costs(void)
{
  const char *file = getenv("GFB_PROBE_FILE");
  char path[4096];
  FILE *out;

  if (!file) return;
  snprintf(path, sizeof path, "%s.%s", file, rank_text());
  out = fopen(path, "w");
  if (!out) return;
  for (int i = 0; i < phases; i++) {
    fprintf(out, "%ld %ld %ld %ld\n", cost[i].calls, cost[i].messages, cost[i].bytes, cost[i].collectives);
  }
  fclose(out);
}
