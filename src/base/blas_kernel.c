/* OpenBLAS' kernel: which one computes, whether it computes rightly, and another in its place. */
#define _GNU_SOURCE /* RTLD_DEFAULT */
#include <dlfcn.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* Makes OpenBLAS choose again, a kernel that is named: by what it does itself where it is loaded, before any product. 0 where it has
   no such functions, with the kernel as it was. Nothing is left in the environment. */
int gfb_set_kernel(const char *kernel)
{
  static const char choice[] = "OPENBLAS_CORETYPE";
  void             *found[]  = {dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"), dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init")};
  void (*forget)(void), (*choose)(void);

  if (!found[0] || !found[1] || setenv(choice, kernel, 1) != 0) return 0;
  memcpy(&forget, &found[0], sizeof forget);
  memcpy(&choose, &found[1], sizeof choose);
  forget();
  choose();
  unsetenv(choice);
  return 1;
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
