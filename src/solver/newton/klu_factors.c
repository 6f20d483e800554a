/* KLU's factors as a preconditioner of PETSc's: PETSc calls KLU too, but ends the program where a matrix is singular,
   and does not hand out the sign of its determinant. */
#include <stdint.h>
#include <petscpc.h>

/* A PC (its Fortran handle) becomes KLU's factors of its matrix; `has` tells whether the program was built with KLU. */
PetscErrorCode gfb_use_klu(intptr_t handle, int *has);
/* Drops KLU's factors and their pivots, if the PC has any: the next ones do not depend on those before. */
PetscErrorCode gfb_forget_klu(intptr_t handle);
/* Sign of the determinant that the present factors tell: 1, -1; 0 where the PC has none of KLU's. */
PetscErrorCode gfb_klu_sign(intptr_t handle, int *sign);

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
static const double most_growth = 10.0; /* of factors by earlier pivots, over that of factors by pivots of their own */

typedef struct {
  KLU(common)      common;
  KLU(symbolic)   *symbolic; /* of the pattern that matrix and state name */
  KLU(numeric)    *numeric;
  double           growth; /* largest entry of the matrix over that of its upper factor, when pivots were chosen */
  PetscObjectId    matrix;
  PetscObjectState state;
} Factors;

static PetscErrorCode forget(Factors *factors)
{
  PetscFunctionBeginUser;
  KLU(free_numeric)(&factors->numeric, &factors->common);
  KLU(free_symbolic)(&factors->symbolic, &factors->common);
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

/* Factors by pivots of the matrix's own. */
static void find_factors(Factors *factors, PetscInt row[], PetscInt column[], double value[])
{
  factors->numeric = KLU(factor)(row, column, value, factors->symbolic, &factors->common);
  if (!factors->numeric) return;
  KLU(rgrowth)(row, column, value, factors->symbolic, factors->numeric, &factors->common);
  factors->growth = factors->common.rgrowth;
}

/* PETSc has the matrix by rows, KLU takes columns: the factors are those of the transposed matrix. */
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

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(PCGetOperators(pc, NULL, &matrix));
  PetscCall(PetscObjectGetId((PetscObject)matrix, &id));
  PetscCall(MatGetNonzeroState(matrix, &state));
  if (factors->symbolic && (id != factors->matrix || state != factors->state)) PetscCall(forget(factors));
  factors->matrix = id;
  factors->state  = state;
  PetscCall(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &order, &row, &column, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "KLU takes matrices of one rank");
  PetscCall(MatSeqAIJGetArrayRead(matrix, &value));
  if (!factors->symbolic) factors->symbolic = KLU(analyze)(order, (PetscInt *)row, (PetscInt *)column, &factors->common);
  if (factors->symbolic) {
    refactor(factors, (PetscInt *)row, (PetscInt *)column, (double *)value);
    if (!factors->numeric) find_factors(factors, (PetscInt *)row, (PetscInt *)column, (double *)value);
  }
  PetscCall(MatSeqAIJRestoreArrayRead(matrix, &value));
  PetscCall(MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &order, &row, &column, &done));
  if (factors->numeric) PetscCall(PCSetFailedReason(pc, PC_NOERROR));
  else if (factors->common.status == KLU_SINGULAR) PetscCall(PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT));
  else PetscCall(PCSetFailedReason(pc, PC_FACTOR_OUTMEMORY));
  PetscFunctionReturn(0);
}

static PetscErrorCode solve_by(PC pc, Vec right, Vec solution, PetscBool transposed)
{
  Factors     *factors;
  PetscScalar *value;
  PetscInt     order;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(VecGetLocalSize(right, &order));
  PetscCall(VecCopy(right, solution));
  PetscCall(VecGetArray(solution, &value));
  if (transposed) KLU(solve)(factors->symbolic, factors->numeric, order, 1, value, &factors->common);
  else KLU(tsolve)(factors->symbolic, factors->numeric, order, 1, value, &factors->common);
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
#endif
