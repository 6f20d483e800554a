/* Loaded before OpenBLAS: an OpenBLAS that falls back where it is loaded and can choose again, with a product as WRONG_PRODUCT says.
   Every choice, and every end, is noted in the file of STARTS. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int choices;

static void note(const char *what)
{
  const char *place = getenv("STARTS"), *kernel = getenv("OPENBLAS_CORETYPE");
  FILE       *file = place ? fopen(place, "a") : NULL;

  if (!file) return;
  fprintf(file, "%s %s\n", what, kernel ? kernel : "-");
  fclose(file);
}

/* The kernel's name is asked for by the program alone, mpiexec is no concern. */
static int is_program(void)
{
  return dlsym(RTLD_DEFAULT, "dgetrf_") != NULL;
}

__attribute__((destructor)) static void end(void)
{
  if (is_program()) note("end");
}

/* OpenBLAS calls it where it is loaded, and before its first product, where it does nothing; the program between them. */
void gotoblas_dynamic_init(void)
{
  void *found = dlsym(RTLD_NEXT, "gotoblas_dynamic_init");
  void (*choose)(void);

  choices++;
  if (choices < 2 || getenv("OPENBLAS_CORETYPE")) note("choice");
  memcpy(&choose, &found, sizeof found);
  choose();
}

char *openblas_get_corename(void)
{
  void *found = dlsym(RTLD_NEXT, "openblas_get_corename");
  char *(*corename)(void);

  memcpy(&corename, &found, sizeof found);
  return choices > 1 && found ? corename() : "Prescott";
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
