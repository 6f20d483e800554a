/* The end of a run for want of memory, said in a sentence: Fortran's allocations, and the wait for BLAS' working memory. */
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

static const int status_machine = 3;

/* BLAS needs microseconds of the processor for what is asked of it here, under valgrind a thousand times that [s]. */
static const int patience = 2;

static const char no_memory[] = "gfb: no memory: the run needs more than this machine, or a limit on it (ulimit -v), gives\n";

/* May be called by a handler of signals. */
static void end_without_memory(int signal_number)
{
  (void)signal_number;
  (void)!write(STDERR_FILENO, no_memory, strlen(no_memory));
  _exit(status_machine);
}

/* These two take the place of libgfortran's for what the compiler has made: the ends of an ALLOCATE, an assignment or a temporary
   array that gets no memory. libgfortran's own end with status 1. */
_Noreturn void _gfortran_os_error_at(const char *where, const char *format, ...);
_Noreturn void _gfortran_os_error(const char *words);

void _gfortran_os_error_at(const char *where, const char *format, ...)
{
  (void)where, (void)format;
  fflush(NULL);
  end_without_memory(0);
  for (;;) {}
}

void _gfortran_os_error(const char *words)
{
  _gfortran_os_error_at("", "%s", words);
}

void gfb_look_for_room(size_t bytes)
{
  void *room = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);

  if (room == MAP_FAILED) end_without_memory(0);
  munmap(room, bytes);
}

extern void dsyrk_(const char *half, const char *transposed, const int *order, const int *inner, const double *factor,
                   const double *a, const int *rows, const double *kept, double *c, const int *rows_of_c);

/* BLAS takes its working memory at its first product, and keeps it. Where OpenBLAS gets none, it asks again for ever: so this is
   asked for where its want can be reported. */
void gfb_start_blas(void)
{
  enum { order = 8 };
  const double     one = 1.0, none = 0.0;
  const int        n = order;
  double           a[order*order] = {0.0}, c[order*order] = {0.0};
  struct itimerval wait = {{0, 0}, {patience, 0}}, before = {{0, 0}, {0, 0}};
  struct sigaction action, former;
  int              waits;

  memset(&action, 0, sizeof action);
  sigemptyset(&action.sa_mask);
  action.sa_handler = end_without_memory;
  sigaction(SIGPROF, &action, &former);
  waits = setitimer(ITIMER_PROF, &wait, &before) == 0;
  dsyrk_("L", "N", &n, &n, &one, a, &n, &none, c, &n);
  if (waits) (void)setitimer(ITIMER_PROF, &before, NULL);
  sigaction(SIGPROF, &former, NULL);
}
