/* MPI's start: without Open MPI's helper where a process is alone, and with a sentence and a status where it fails. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */
#include "gfb_shim.h"
#include <errno.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const int status_machine = 3;

/* Settings of a process that is alone. Two isolated ones would take the same session folder and the same names in shared
   memory: each gets a folder of its own, and messages to itself need no shared memory. What it does not use is not loaded:
   collective calls of many ranks, and plug-ins that look for displays, graphics cards and disks of the machine, for which hwloc
   looks in that folder. */
static char        session[4096]; /* the folder */
static const char *const alone[][2] = {
  {"OMPI_MCA_orte_tmpdir_base", session},
  {"OMPI_MCA_ess_singleton_isolated", "1"},
  {"OMPI_MCA_pml", "ob1"},
  {"OMPI_MCA_btl", "self"},
  {"OMPI_MCA_coll", "self,basic,libnbc"},
  {"HWLOC_PLUGINS_PATH", session},
};
static const size_t alone_settings = sizeof alone/sizeof *alone;
static int          is_alone       = 0;

/* Ranks that wait give their core to who computes: where other jobs are on it, one rank would keep the other from answering. */
static const char yielding[] = "OMPI_MCA_mpi_yield_when_idle";
static int        is_yielding = 0;

#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION < 5
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
#endif

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *place)
{
  (void)status, (void)kind, (void)place;
  (void)!remove(path);
  return 0;
}

static void remove_session(void)
{
  if (is_alone) nftw(session, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

/* The process that is starting MPI, 0 before and afterwards; a child of Open MPI's is none. */
static pid_t starting = 0;

static const char *temporary_folder(void)
{
  const char *folder = getenv("TMPDIR");

  return folder && *folder ? folder : "/tmp";
}

/* Makes a folder of our own in another; 0 where that cannot be. */
static int make_session(const char *folder)
{
  return snprintf(session, sizeof session, "%s/gfb-XXXXXX", folder) < (int)sizeof session && mkdtemp(session) != NULL;
}

static void say_not_started(void)
{
  const char *folder = temporary_folder();

  fflush(NULL);
  if (!is_alone && !make_session(folder)) {
    fprintf(stderr, "gfb: MPI could not start: nothing can be written in %s; TMPDIR names a folder for it\n", folder);
    return;
  }
  is_alone = 1; /* the folder is removed */
  fprintf(stderr, "gfb: MPI could not start: its settings, such as variables OMPI_MCA_..., or its folder for temporary files do "
                  "not serve; with OMPI_MCA_orte_execute_quiet=0 it says more\n");
}

static void end_of_start(void)
{
  int begun, ended = 0;

  if (starting != getpid()) return;
  starting = 0;
  MPI_Initialized(&begun);
  if (begun) MPI_Finalized(&ended);
  if (ended) return; /* PETSc has done what it was asked for, such as -help intro */
  if (begun) fprintf(stderr, "gfb: PETSc could not start: what it was told, by PETSC_OPTIONS or a file .petscrc, does not serve\n");
  else say_not_started();
  remove_session();
  _Exit(status_machine);
}

/* MPI has no handler of errors before it has started: where it fails, libmpi ends the process by exit or _exit with status 1.
   This _exit takes the place of the C library's for all libraries, and differs from it during the start only. */
void _exit(int status)
{
  end_of_start();
  _Exit(status);
}

static void watch_start(void)
{
  char here[PATH_MAX];

  if (!getcwd(here, sizeof here) && errno == ENOENT) {
    fprintf(stderr, "gfb: the folder in which it was started is not there any more\n");
    exit(status_machine);
  }
  if (!starting) atexit(end_of_start);
  starting = getpid();
}

void gfb_start_alone(void)
{
  watch_start();
#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION < 5
  const char *const folders[] = {temporary_folder(), "/tmp"};
  int               begun;

  MPI_Initialized(&begun); /* where the ranks have been divided into groups */
  if (begun) return;
  if (is_launched()) {
    is_yielding = !getenv(yielding) && setenv(yielding, "1", 1) == 0;
    return;
  }
  for (size_t i = 0; !is_alone && i < sizeof folders/sizeof *folders; i++)
    is_alone = make_session(folders[i]);
  if (!is_alone) return;
  atexit(remove_session);
  for (size_t i = 0; i < alone_settings; i++) setenv(alone[i][0], alone[i][1], 1);
#endif
}

void gfb_started(void)
{
  starting = 0;
  for (size_t i = 0; is_alone && i < alone_settings; i++) unsetenv(alone[i][0]);
  if (is_yielding) unsetenv(yielding);
  is_yielding = 0;
}
