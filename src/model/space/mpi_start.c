/* The start of MPI and PETSc: without Open MPI's helper where a process is alone, without what somebody has left in the current
   folder, and with a sentence and a status where it fails. */
#define _GNU_SOURCE /* mkdtemp, nftw, O_PATH */
#include "gfb_shim.h"
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <slepcsys.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
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

/* Ranks that wait give their core to who computes: where other jobs are on it, one rank would keep the other from answering. A
   launched rank without others has nobody to wait for; each of its messages to itself (a hundred thousand in a run with MUMPS)
   would give its core to other jobs. */
static const char yielding[] = "OMPI_MCA_mpi_yield_when_idle";
static int        is_yielding = 0;

#ifdef OMPI_MAJOR_VERSION
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

/* Makes a folder of our own in another; 0 where that cannot be. Its name holds in every folder of work. */
static int make_session(const char *folder)
{
  char whole[PATH_MAX];

  return realpath(folder, whole) && snprintf(session, sizeof session, "%s/gfb-XXXXXX", whole) < (int)sizeof session
      && mkdtemp(session) != NULL;
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
  if (begun) fprintf(stderr, "gfb: PETSc could not start: an option in PETSC_OPTIONS or in a file of options is wrong\n");
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

#ifdef OMPI_MAJOR_VERSION
static char folder_before[PATH_MAX]; /* what TMPDIR was; empty: nothing */
static int  has_other_folder = 0;

/* Another folder for MPI's temporary files, until it has started. */
static void set_temporary_folder(const char *folder)
{
  const char *before = getenv("TMPDIR");

  if (before && snprintf(folder_before, sizeof folder_before, "%s", before) >= (int)sizeof folder_before) return;
  has_other_folder = setenv("TMPDIR", folder, 1) == 0;
}
#endif

/* What a process needs that no launcher has started. */
static void prepare_alone(void)
{
#ifdef OMPI_MAJOR_VERSION
  const char *const folders[] = {temporary_folder(), "/tmp"};

  if (is_launched()) {
    const char *ranks = getenv("OMPI_COMM_WORLD_SIZE");

    if (ranks && strcmp(ranks, "1") == 0) return;
    is_yielding = OMPI_MAJOR_VERSION < 5 && !getenv(yielding) && setenv(yielding, "1", 1) == 0;
    return;
  }
  for (size_t i = 0; !is_alone && i < sizeof folders/sizeof *folders; i++)
    is_alone = make_session(folders[i]);
  if (OMPI_MAJOR_VERSION >= 5) { /* it crashes where it can make no folder */
    if (!is_alone) {
      end_of_start();
      return;
    }
    set_temporary_folder(session);
  }
  if (!is_alone) return;
  atexit(remove_session);
  for (size_t i = 0; OMPI_MAJOR_VERSION < 5 && i < alone_settings; i++) setenv(alone[i][0], alone[i][1], 1);
#endif
}

/* Libraries that the program is linked with read settings as they are loaded, before main: UCX does where MPI is linked with it
   (Open MPI 5 of Debian 13). The loader calls what stands in .preinit_array before any of them, and constructors of the program
   after all: in between the process is in the root. */
static int folder_at_load = -1;

#define BEFORE_LIBRARIES __attribute__((no_sanitize("address", "undefined")))

BEFORE_LIBRARIES static void leave_before_libraries(int count, char **words, char **environment)
{
  (void)count, (void)words, (void)environment;
  if (access(".", X_OK) != 0) return;
  folder_at_load = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder_at_load >= 0 && chdir("/") != 0) {
    close(folder_at_load);
    folder_at_load = -1;
  }
}

__attribute__((section(".preinit_array"), used)) static void (*const leave_first)(int, char **, char **) = leave_before_libraries;

__attribute__((constructor(101))) static void return_after_libraries(void)
{
  static const char sentence[] = "gfb: the folder in which it was started is closed\n";

  if (folder_at_load < 0) return;
  if (fchdir(folder_at_load) != 0) {
    (void)!write(STDERR_FILENO, sentence, sizeof sentence - 1);
    _Exit(status_machine);
  }
  close(folder_at_load);
  folder_at_load = -1;
}

/* The current folder, which is left for the root; -1 where nothing in it can be opened by anybody's name. */
static int leave_folder(void)
{
  int here;

  if (access(".", X_OK) != 0) return -1;
  here = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (here < 0 || chdir("/") != 0) {
    fprintf(stderr, "gfb: the folder in which it was started cannot be opened: %s\n", strerror(errno));
    gfb_started(); /* that was the sentence */
    exit(status_machine);
  }
  return here;
}

static void return_to_folder(int here)
{
  if (here < 0) return;
  if (fchdir(here) != 0) {
    fprintf(stderr, "gfb: the folder in which it was started is closed: %s\n", strerror(errno));
    gfb_started();
    exit(status_machine);
  }
  close(here);
}

/* What MPI loads as it starts reads settings in the current folder (UCX does, ucx.conf), which may be a stranger's: it starts in the root. */
void gfb_start_mpi(void)
{
  int begun, provided, here;

  MPI_Initialized(&begun);
  if (begun) return;
  watch_start();
  prepare_alone();
  here = leave_folder();
  MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided);
  return_to_folder(here);
  gfb_started();
}

/* The file of options in the home, which is the user's own; one without any where there is none. */
static const char *own_options(char path[], size_t room)
{
  const char *home = getenv("HOME");
  struct stat status;

  if (home && *home == '/' && snprintf(path, room, "%s/.petscrc", home) < (int)room && stat(path, &status) == 0
      && S_ISREG(status.st_mode) && access(path, R_OK) == 0)
    return path;
  return "/dev/null";
}

/* PETSc reads three files by itself, two of them in the current folder: asked to skip them, it gets the home's by name. Files that
   the user names, and PETSC_OPTIONS, it reads as ever; its arguments outlive this call. */
PetscErrorCode gfb_start_slepc(MPI_Fint communicator, const char words[], size_t length)
{
  static const char skip[] = "-skip_petscrc";
  char              path[PATH_MAX], *next = malloc(length + 1), **arguments = calloc(length + 3, sizeof *arguments);
  const char       *file = own_options(path, sizeof path);
  int               count = 0, begun;

  if (!next || !arguments) return PETSC_ERR_MEM;
  memcpy(next, words, length);
  for (size_t i = 0; i < length; i += strlen(next + i) + 1) {
    arguments[count++] = next + i;
    if (strcmp(next + i, skip) == 0) file = "/dev/null";
    if (count == 1) arguments[count++] = (char *)skip;
  }
  MPI_Initialized(&begun);
  if (begun && communicator != 0 && MPI_Comm_f2c(communicator) != MPI_COMM_NULL) PETSC_COMM_WORLD = MPI_Comm_f2c(communicator);
  gfb_start_mpi();
  if (!begun) PetscBeganMPI = PETSC_TRUE; /* it ends MPI, also where an option ends it early */
  watch_start();
  PetscCall(SlepcInitialize(&count, &arguments, file, NULL));
  PetscCall(SlepcInitializeFortran());
  gfb_started();
  return 0;
}

void gfb_started(void)
{
  starting = 0;
#ifdef OMPI_MAJOR_VERSION
  if (has_other_folder && *folder_before) setenv("TMPDIR", folder_before, 1);
  else if (has_other_folder) unsetenv("TMPDIR");
  has_other_folder = 0;
#endif
  for (size_t i = 0; is_alone && i < alone_settings; i++) unsetenv(alone[i][0]);
  if (is_yielding) unsetenv(yielding);
  is_yielding = 0;
}
