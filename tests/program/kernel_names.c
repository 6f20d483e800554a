/* Loaded before OpenBLAS: an OpenBLAS that falls back until the program has started anew, with a product as WRONG_PRODUCT says.
   Every start and every end is noted in the file of STARTS. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char mark[16];

static void note(const char *what)
{
  const char *place = getenv("STARTS"), *kernel = getenv("OPENBLAS_CORETYPE"), *set = getenv("GFB_BLAS_KERNEL");
  FILE       *file = place ? fopen(place, "a") : NULL;

  if (!file) return;
  fprintf(file, "%s %s %s\n", what, kernel ? kernel : "-", set ? set : "-");
  fclose(file);
}

/* The kernel's name is asked for by the program alone, mpiexec is no concern. */
static int is_program(void)
{
  return dlsym(RTLD_DEFAULT, "dgetrf_") != NULL;
}

__attribute__((constructor)) static void start(void)
{
  const char *set = getenv("GFB_BLAS_KERNEL");

  snprintf(mark, sizeof mark, "%s", set ? set : "");
  if (is_program()) note("start");
}

__attribute__((destructor)) static void end(void)
{
  if (is_program()) note("end");
}

char *openblas_get_corename(void)
{
  void *found = dlsym(RTLD_NEXT, "openblas_get_corename");
  char *(*corename)(void);

  memcpy(&corename, &found, sizeof found);
  return *mark && found ? corename() : "Prescott";
}

typedef void product(const char *, const char *, const int *, const int *, const int *, const double *, const double *, const int *,
                     const double *, const int *, const double *, double *, const int *, size_t, size_t);

void dgemm_(const char *left, const char *right, const int *m, const int *n, const int *k, const double *factor, const double *a,
            const int *rows_a, const double *b, const int *rows_b, const double *kept, double *c, const int *rows_c, size_t one,
            size_t other)
{
  const char *wrong = getenv("WRONG_PRODUCT");
  void       *found = dlsym(RTLD_NEXT, "dgemm_");
  product    *dgemm;

  if (wrong && strcmp(wrong, "illegal") == 0) __builtin_trap();
  memcpy(&dgemm, &found, sizeof found);
  dgemm(left, right, m, n, k, factor, a, rows_a, b, rows_b, kept, c, rows_c, one, other);
  if (wrong && *m > 100) c[*m + 3] += 1e-12;
}
