/* OpenBLAS' kernel: which one computes, whether it computes rightly, and the program's start anew with another. OpenBLAS chooses
   it once, where it is loaded, so that a start anew is the only way to another. */
#define _GNU_SOURCE /* RTLD_DEFAULT */
#include <dlfcn.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char choice[] = "OPENBLAS_CORETYPE", mark[] = "GFB_BLAS_KERNEL"; /* variables of the environment */

/* Name of the kernel; empty where BLAS is no OpenBLAS, or is linked statically. */
void gfb_blas_kernel_name(char name[], int room)
{
  void *found = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  char *(*corename)(void);

  name[0] = '\0';
  if (!found) return;
  memcpy(&corename, &found, sizeof corename);
  snprintf(name, (size_t)room, "%s", corename());
}

/* Widest vectors that processor and system compute with, as far as kernels need them [bits]; 0 where there is no choice. */
int gfb_vector_bits(void)
{
#if defined(__x86_64__) && defined(__GNUC__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 0;
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd") ? 512 : 256;
#else
  return 0;
#endif
}

/* What was set for the start anew is no setting of the user's: neither this process nor its children see it. */
void gfb_forget_kernel(void)
{
  unsetenv(choice);
  unsetenv(mark);
}

/* The words of the command line, ended by NULL; NULL where the system does not tell them. */
static char **words_of_line(void)
{
  FILE  *file = fopen("/proc/self/cmdline", "r");
  char **words = NULL, *word = NULL;
  size_t room = 0, count = 0;

  while (file && getdelim(&word, &room, '\0', file) > 0) {
    char **longer = realloc(words, (count + 2)*sizeof *words);
    if (!longer) break;
    words          = longer;
    words[count++] = word;
    words[count]   = NULL;
    word           = NULL;
    room           = 0;
  }
  if (file && !feof(file)) words = NULL;
  if (file) fclose(file);
  return words;
}

/* Starts the program anew in this process, with the same words; comes back where that cannot be. Its file is called by its name,
   which the system shows. Valgrind would not follow. */
void gfb_start_again(const char *kernel, const char *why)
{
  const char *preload = getenv("LD_PRELOAD");
  char        program[PATH_MAX], **words = words_of_line();
  ssize_t     length = readlink("/proc/self/exe", program, sizeof program - 1);

  if (!words || length <= 0 || (preload && strstr(preload, "vgpreload"))) return;
  program[length] = '\0';
  if (setenv(choice, kernel, 1) == 0 && setenv(mark, why, 1) == 0) execv(program, words);
  gfb_forget_kernel();
}

/* The larger one is beyond what OpenBLAS has kernels of their own for (a million products); odd, so that edges are computed too. */
enum { small = 13, large = 109 };
static double lower[large*large], upper[large*large], product[large*large];

/* A number that is not that of its neighbours: 0 to 6. */
static int some(unsigned *seed)
{
  *seed = 1664525u**seed + 1013904223u;
  return (int)((*seed >> 16)%7);
}

extern void dgemm_(const char *, const char *, const int *, const int *, const int *, const double *, const double *, const int *,
                   const double *, const int *, const double *, double *, const int *, size_t, size_t);
extern void dgetrf_(const int *, const int *, double *, const int *, int *, int *);

/* A = L U by dgemm and back by dgetrf. L has halves below its diagonal, U twos on it, and L's rows stand in reverse: all sums are
   exact in any order, and there is one choice of pivots. A's columns are compared by sums over rows, each with its own weight. */
static int is_right(int n)
{
  const double one = 1.0, none = 0.0, rounding = 16.0*DBL_EPSILON;
  unsigned     seed = 1;
  int          wrong = 0, pivots[large], status = 0;
  double       rows[large] = {0.0}; /* weighted sums of L's columns */

  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      double *l      = &lower[n - 1 - i + j*n];
      *l             = i > j ? (some(&seed)%3 - 1)/2.0 : i == j;
      upper[i + j*n] = i < j ? some(&seed) - 3 : 2*(i == j);
      rows[j] += (n - i)**l;
    }
  dgemm_("N", "N", &n, &n, &n, &one, lower, &n, upper, &n, &none, product, &n, 1, 1);
  for (int j = 0; j < n; j++) {
    double sum = 0.0, right = 0.0;
    for (int k = 0; k < n; k++) {
      right += rows[k]*upper[k + j*n];
      sum += (k + 1)*product[k + j*n];
    }
    wrong |= !(fabs(sum - right) <= rounding*fabs(right));
  }
  dgetrf_(&n, &n, product, &n, pivots, &status);
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++)
      wrong |= !(fabs(product[i + j*n] - (i > j ? lower[n - 1 - i + j*n] : upper[i + j*n])) <= rounding);
  return !wrong && status == 0;
}

static sigjmp_buf before;

static void go_back(int signal_number)
{
  siglongjmp(before, signal_number);
}

/* Whether the kernel computes rightly here; an instruction that the processor does not know is a no. */
int gfb_kernel_is_right(void)
{
  struct sigaction action, former;
  volatile int     right = 0;

  memset(&action, 0, sizeof action);
  sigemptyset(&action.sa_mask);
  action.sa_handler = go_back;
  sigaction(SIGILL, &action, &former);
  if (sigsetjmp(before, 1) == 0) right = is_right(small) && is_right(large);
  sigaction(SIGILL, &former, NULL);
  return right;
}
