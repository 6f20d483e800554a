/* KLU's factors as a preconditioner of PETSc's: PETSc calls KLU too, but ends the program where a matrix is singular,
   and does not hand out the sign of its determinant.

   On several ranks each gathers the whole matrix and factors it, all alike. A solve then takes one message, for the right
   side; MUMPS' takes many, which in a small solve last longer than all arithmetic. */
#include <stdint.h>
#include <petscpc.h>

/* A PC (its Fortran handle) becomes KLU's factors of its matrix; `has` says whether the program was built with KLU. */
PetscErrorCode gfb_use_klu(intptr_t handle, int *has);
/* Drops KLU's factors and their pivots, if the PC has any: the next ones do not depend on those before. */
PetscErrorCode gfb_forget_klu(intptr_t handle);
/* Sign of the determinant that the present factors give: 1, -1; 0 where the PC has none of KLU's. */
PetscErrorCode gfb_klu_sign(intptr_t handle, int *sign);
/* Entries of the present factors over those that pivots on the diagonal leave; 0 where the PC has none of KLU's. */
PetscErrorCode gfb_klu_fill(intptr_t handle, double *fill);

#ifdef GFB_KLU
#include <klu.h>

/* KLU for PETSc's integers, which it takes as they are. */
#ifdef PETSC_USE_64BIT_INDICES
#define KLU(name) klu_l_##name
#else
#define KLU(name) klu_##name
#endif
_Static_assert(sizeof(PetscInt) == sizeof *((KLU(symbolic) *)0)->Q, "KLU takes PETSc's integers as they are");

static const char   label[] = "KLU";
static const double threshold = 0.01; /* of a pivot on the diagonal, over the largest in its column: as MUMPS has it */
/* The same where those beside it fill the factors. A film that has all but closed carries little of its own pressure and much of
   the gap's: the shaft's dense rows come early then, and each pivot beside the diagonal fills all that follow, up to thirty times
   in memory and five hundred times in time. Newton's method takes the few digits that pivots on the diagonal cost. */
static const double small_threshold = 1.0e-10;
static const double most_fill = 3.0;       /* entries of factors over those that pivots on the diagonal leave, before */
static const double least_growth = 1.0e-10; /* largest entry of the matrix over that of the factor; below it is round-off */
static const double most_growth = 10.0; /* of factors by earlier pivots, over that of factors by pivots of their own */

typedef struct {
  KLU(common)      common;
  KLU(symbolic)   *symbolic; /* of the pattern that matrix and state name */
  KLU(numeric)    *numeric;
  double           growth; /* largest entry of the matrix over that of its upper factor, when pivots were chosen */
  PetscObjectId    matrix;
  PetscObjectState state;
  /* On several ranks: */
  Mat          mine;           /* this rank's rows */
  PetscInt    *row, *column;   /* pattern of the whole matrix */
  double      *value, *vector; /* its entries; a right side and its solution */
  PetscMPIInt *entries, *entry, *rows, *first; /* of each rank: how many, and how many before them */
} Factors;

static PetscErrorCode forget(Factors *factors)
{
  PetscFunctionBeginUser;
  KLU(free_numeric)(&factors->numeric, &factors->common);
  KLU(free_symbolic)(&factors->symbolic, &factors->common);
  factors->common.tol = threshold;
  PetscCall(MatDestroy(&factors->mine));
  PetscCall(PetscFree4(factors->row, factors->column, factors->value, factors->vector));
  PetscCall(PetscFree(factors->entries));
  PetscFunctionReturn(0);
}

/* Factors by the pivots of those before, which spares the search for them. Without factors, or where these would lose digits,
   none are left. */
static void refactor(Factors *factors, PetscInt row[], PetscInt column[], double value[])
{
  if (!factors->numeric) return;
  if (KLU(refactor)(row, column, value, factors->symbolic, factors->numeric, &factors->common)
      && KLU(rgrowth)(row, column, value, factors->symbolic, factors->numeric, &factors->common)
      && factors->common.rgrowth * most_growth >= factors->growth) return;
  KLU(free_numeric)(&factors->numeric, &factors->common);
}

/* Entries of the factors over those that pivots on the diagonal leave. */
static double fill_of(const Factors *factors)
{
  return ((double)factors->numeric->lnz + (double)factors->numeric->unz) / (factors->symbolic->lnz + factors->symbolic->unz);
}

/* Factors by pivots of the matrix's own, by a threshold that stays until factors are forgotten. */
static void choose_pivots(Factors *factors, PetscInt row[], PetscInt column[], double value[], double tolerance)
{
  KLU(free_numeric)(&factors->numeric, &factors->common);
  factors->common.tol = tolerance;
  factors->numeric = KLU(factor)(row, column, value, factors->symbolic, &factors->common);
  if (!factors->numeric) return;
  KLU(rgrowth)(row, column, value, factors->symbolic, factors->numeric, &factors->common);
  factors->growth = factors->common.rgrowth;
}

/* The same, by a threshold that leaves them sparse. */
static void find_factors(Factors *factors, PetscInt row[], PetscInt column[], double value[])
{
  choose_pivots(factors, row, column, value, factors->common.tol);
  if (!factors->numeric) return;
  if (factors->common.tol > small_threshold) {
    if (fill_of(factors) > most_fill) choose_pivots(factors, row, column, value, small_threshold);
    else return;
  }
  if (!factors->numeric || factors->growth < least_growth) choose_pivots(factors, row, column, value, threshold);
}

/* The pattern of the whole matrix, and room for its entries. */
static PetscErrorCode gather_pattern(Factors *factors, Mat matrix, PetscMPIInt ranks, PetscMPIInt rank)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)matrix);
  PetscInt        rows, order, total = 0;
  const PetscInt *bound, *row, *column;
  PetscBool       done;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(matrix, &order, NULL));
  PetscCall(MatGetOwnershipRanges(matrix, &bound));
  PetscCall(MatGetRowIJ(factors->mine, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row, &column, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "KLU takes PETSc's own sparse matrices");
  PetscCall(PetscMalloc1(4 * ranks, &factors->entries));
  factors->entry = factors->entries + ranks;
  factors->rows  = factors->entry + ranks;
  factors->first = factors->rows + ranks;
  PetscCall(PetscMPIIntCast(row[rows], factors->entries + rank));
  PetscCallMPI(MPI_Allgather(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, factors->entries, 1, MPI_INT, comm));
  for (PetscMPIInt i = 0; i < ranks; i++) {
    PetscCall(PetscMPIIntCast(total, factors->entry + i));
    PetscCall(PetscMPIIntCast(bound[i], factors->first + i));
    PetscCall(PetscMPIIntCast(bound[i + 1] - bound[i], factors->rows + i));
    total += factors->entries[i];
  }
  PetscCall(PetscMalloc4(order + 1, &factors->row, total, &factors->column, total, &factors->value, order, &factors->vector));
  factors->row[0] = 0;
  for (PetscInt i = 0; i < rows; i++) factors->row[bound[rank] + i + 1] = factors->entry[rank] + row[i + 1];
  PetscCallMPI(MPI_Allgatherv(MPI_IN_PLACE, 0, MPIU_INT, factors->row + 1, factors->rows, factors->first, MPIU_INT, comm));
  PetscCallMPI(MPI_Allgatherv(column, factors->entries[rank], MPIU_INT, factors->column, factors->entries, factors->entry,
                              MPIU_INT, comm));
  PetscCall(MatRestoreRowIJ(factors->mine, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row, &column, &done));
  PetscFunctionReturn(0);
}

/* The whole matrix on this rank, of several. */
static PetscErrorCode gather(Factors *factors, Mat matrix, PetscMPIInt ranks)
{
  MPI_Comm      comm = PetscObjectComm((PetscObject)matrix);
  const double *value;
  PetscMPIInt   rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(MatMPIAIJGetLocalMat(matrix, factors->mine ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX, &factors->mine));
  if (!factors->row) PetscCall(gather_pattern(factors, matrix, ranks, rank));
  PetscCall(MatSeqAIJGetArrayRead(factors->mine, &value));
  PetscCallMPI(MPI_Allgatherv(value, factors->entries[rank], MPI_DOUBLE, factors->value, factors->entries, factors->entry,
                              MPI_DOUBLE, comm));
  PetscCall(MatSeqAIJRestoreArrayRead(factors->mine, &value));
  PetscFunctionReturn(0);
}

/* PETSc has the matrix by rows, KLU takes columns: the factors are those of the transposed matrix. */
static void make_factors(Factors *factors, PetscInt order, PetscInt row[], PetscInt column[], double value[])
{
  if (!factors->symbolic) factors->symbolic = KLU(analyze)(order, row, column, &factors->common);
  if (!factors->symbolic) return;
  refactor(factors, row, column, value);
  if (!factors->numeric) find_factors(factors, row, column, value);
}

static PetscErrorCode factor(PC pc)
{
  Factors           *factors;
  Mat                matrix;
  PetscInt           order;
  const PetscInt    *row, *column;
  const PetscScalar *value;
  PetscBool          done;
  PetscObjectId      id;
  PetscObjectState   state;
  PetscMPIInt        ranks, failed, any;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(PCGetOperators(pc, NULL, &matrix));
  PetscCall(PetscObjectGetId((PetscObject)matrix, &id));
  PetscCall(MatGetNonzeroState(matrix, &state));
  if (id != factors->matrix || state != factors->state) PetscCall(forget(factors));
  factors->matrix = id;
  factors->state  = state;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &ranks));
  if (ranks > 1) {
    PetscCall(MatGetSize(matrix, &order, NULL));
    PetscCall(gather(factors, matrix, ranks));
    make_factors(factors, order, factors->row, factors->column, factors->value);
  } else {
    PetscCall(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &order, &row, &column, &done));
    PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "KLU takes PETSc's own sparse matrices");
    PetscCall(MatSeqAIJGetArrayRead(matrix, &value));
    make_factors(factors, order, (PetscInt *)row, (PetscInt *)column, (double *)value);
    PetscCall(MatSeqAIJRestoreArrayRead(matrix, &value));
    PetscCall(MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &order, &row, &column, &done));
  }
  failed = PC_NOERROR;
  if (!factors->numeric) failed = factors->common.status == KLU_SINGULAR ? PC_FACTOR_NUMERIC_ZEROPIVOT : PC_FACTOR_OUTMEMORY;
  /* One rank alone may have no memory. */
  PetscCallMPI(MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)pc)));
  PetscCall(PCSetFailedReason(pc, (PCFailedReason)any));
  PetscFunctionReturn(0);
}

static PetscErrorCode solve_by(PC pc, Vec right, Vec solution, PetscBool transposed)
{
  Factors           *factors;
  const PetscScalar *given;
  PetscScalar       *value;
  PetscInt           first, last;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(VecGetOwnershipRange(right, &first, &last));
  PetscCall(VecGetArray(solution, &value));
  PetscCall(VecGetArrayRead(right, &given));
  double *whole = factors->vector ? factors->vector : value;
  if (factors->vector) {
    PetscCallMPI(MPI_Allgatherv(given, (PetscMPIInt)(last - first), MPI_DOUBLE, whole, factors->rows, factors->first, MPI_DOUBLE,
                                PetscObjectComm((PetscObject)pc)));
  } else PetscCall(PetscArraycpy(whole, given, last - first));
  if (transposed) KLU(solve)(factors->symbolic, factors->numeric, factors->symbolic->n, 1, whole, &factors->common);
  else KLU(tsolve)(factors->symbolic, factors->numeric, factors->symbolic->n, 1, whole, &factors->common);
  if (factors->vector) PetscCall(PetscArraycpy(value, whole + first, last - first));
  PetscCall(VecRestoreArrayRead(right, &given));
  PetscCall(VecRestoreArray(solution, &value));
  PetscFunctionReturn(0);
}

static PetscErrorCode solve(PC pc, Vec right, Vec solution)
{
  return solve_by(pc, right, solution, PETSC_FALSE);
}

static PetscErrorCode solve_transposed(PC pc, Vec right, Vec solution)
{
  return solve_by(pc, right, solution, PETSC_TRUE);
}

static PetscErrorCode destroy(PC pc)
{
  Factors *factors;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(forget(factors));
  PetscCall(PetscFree(factors));
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_use_klu(intptr_t handle, int *has)
{
  PC       pc = (PC)handle;
  Factors *factors;

  PetscFunctionBeginUser;
  *has = 1;
  PetscCall(PetscNew(&factors));
  KLU(defaults)(&factors->common);
  factors->common.tol = threshold;
  /* Rows and columns are scaled already. Scaled once more by its largest entry, the shaft's dense row of unknowns becomes a
     pivot early, and fills all that follow. */
  factors->common.scale = -1; /* nor looks KLU for indices out of range, in what PETSc has put together */
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, label));
  PetscCall(PCShellSetContext(pc, factors));
  PetscCall(PCShellSetSetUp(pc, factor));
  PetscCall(PCShellSetApply(pc, solve));
  PetscCall(PCShellSetApplyTranspose(pc, solve_transposed));
  PetscCall(PCShellSetDestroy(pc, destroy));
  PetscFunctionReturn(0);
}

/* KLU's factors of a PC, NULL where it has none. */
static PetscErrorCode get_factors(PC pc, Factors **factors)
{
  PetscBool   is_shell, is_klu;
  const char *name;

  PetscFunctionBeginUser;
  *factors = NULL;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCSHELL, &is_shell));
  if (!is_shell) PetscFunctionReturn(0);
  PetscCall(PCShellGetName(pc, &name));
  PetscCall(PetscStrcmp(name, label, &is_klu));
  if (is_klu) PetscCall(PCShellGetContext(pc, factors));
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_forget_klu(intptr_t handle)
{
  Factors *factors;

  PetscFunctionBeginUser;
  PetscCall(get_factors((PC)handle, &factors));
  if (factors) PetscCall(forget(factors));
  PetscFunctionReturn(0);
}

/* Whether it takes an odd number of exchanges to put a permutation in order; `seen` is overwritten. */
static PetscBool is_odd(const PetscInt permutation[], PetscInt order, PetscBool seen[])
{
  PetscBool odd = PETSC_FALSE;

  for (PetscInt i = 0; i < order; i++) seen[i] = PETSC_FALSE;
  for (PetscInt i = 0; i < order; i++) {
    for (PetscInt j = i; !seen[j]; j = permutation[j]) {
      seen[j] = PETSC_TRUE;
      if (permutation[j] != i) odd = !odd;
    }
  }
  return odd;
}

PetscErrorCode gfb_klu_sign(intptr_t handle, int *sign)
{
  Factors   *factors;
  PetscBool  odd, *seen;

  PetscFunctionBeginUser;
  *sign = 0;
  PetscCall(get_factors((PC)handle, &factors));
  if (!factors || !factors->numeric) PetscFunctionReturn(0);
  const PetscInt order = factors->symbolic->n;
  const double  *pivot = factors->numeric->Udiag;
  PetscCall(PetscMalloc1(order, &seen));
  odd = is_odd(factors->numeric->Pnum, order, seen) != is_odd(factors->symbolic->Q, order, seen) ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(PetscFree(seen));
  for (PetscInt i = 0; i < order; i++) {
    if (pivot[i] < 0.0) odd = !odd;
  }
  *sign = odd ? -1 : 1;
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_klu_fill(intptr_t handle, double *fill)
{
  Factors *factors;

  PetscFunctionBeginUser;
  PetscCall(get_factors((PC)handle, &factors));
  *fill = factors && factors->numeric ? fill_of(factors) : 0.0;
  PetscFunctionReturn(0);
}

#else

PetscErrorCode gfb_use_klu(intptr_t handle, int *has)
{
  (void)handle;
  *has = 0;
  return 0;
}

PetscErrorCode gfb_forget_klu(intptr_t handle)
{
  (void)handle;
  return 0;
}

PetscErrorCode gfb_klu_sign(intptr_t handle, int *sign)
{
  (void)handle;
  *sign = 0;
  return 0;
}

PetscErrorCode gfb_klu_fill(intptr_t handle, double *fill)
{
  (void)handle;
  *fill = 0.0;
  return 0;
}
#endif
