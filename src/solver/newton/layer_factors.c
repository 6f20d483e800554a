/* Factors of a matrix whose unknowns lie in layers, each coupled with itself and with those beside it alone, but for a few rows and
   columns that couple all: of a film with heat the layers are its stations, those rows and columns the shaft's and the walls'.

   Block elimination along the layers, LAPACK's on each; the few rows and columns are left to the end (their Schur complement).
   There is no pattern to be analysed, and nothing to be searched for in a matrix whose layers are almost full. Rows are exchanged
   within a layer only; what digits that costs is given back by corrections of the solution, which look at the matrix itself. */
#include <stdint.h>
#include <petscpc.h>
#include <petscblaslapack.h>

/* A PC (its Fortran handle) becomes the factors of its matrix on one rank; `layer` of each unknown, from 1; 0: it couples all. */
PetscErrorCode gfb_use_layers(intptr_t handle, int order, const int layer[]);
/* Whether a PC's factors are of layers, made or not. */
PetscErrorCode gfb_are_layers(intptr_t handle, int *are);
/* Sign of the determinant that the present factors give: 1, -1; 0 where the PC has none of layers. */
PetscErrorCode gfb_layers_sign(intptr_t handle, int *sign);

static const char   label[]   = "layers";
static const double enough    = 1.0e-12; /* residual of a solution over the right side */
static const int    corrections = 3;     /* at most */

typedef struct {
  PetscBLASInt  layers, order, inner, border; /* unknowns: all, those in layers, the others */
  int          *layer;                        /* of each unknown, from 0; -1: none */
  PetscBLASInt *place;                        /* of each unknown, layer by layer, the border's last */
  PetscBLASInt *first;                        /* place where each layer begins, and the border */
  size_t       *diagonal, *side;              /* where blocks begin */
  double       *pivot, *below, *above; /* blocks of layers with themselves, with the one before, with the one behind */
  double       *column, *row, *corner; /* of the border: (inner, border), (inner, border) transposed, (border, border) */
  PetscBLASInt *exchange;              /* of rows, as LAPACK has it */
  double       *value;                 /* a solution, by places */
  Vec           left, correction;
  PetscBool     made;
  PetscBool     looks; /* at the residuals of its solutions: the first one tells whether others need corrections */
} Factors;

/* Numbers the unknowns, and makes room for the blocks. */
static PetscErrorCode place_unknowns(Factors *factors, int order, const int layer[])
{
  PetscFunctionBeginUser;
  factors->order = order;
  for (int i = 0; i < order; i++) factors->layers = PetscMax(factors->layers, layer[i]);
  const PetscBLASInt layers = factors->layers;
  PetscCall(PetscMalloc4(order, &factors->layer, order, &factors->place, order, &factors->exchange, order, &factors->value));
  PetscCall(PetscCalloc3(layers + 2, &factors->first, layers + 1, &factors->diagonal, layers + 1, &factors->side));
  PetscBLASInt *first = factors->first;
  for (int i = 0; i < order; i++) {
    factors->layer[i] = layer[i] - 1;
    first[(layer[i] > 0 ? layer[i] : layers + 1)]++;
  }
  for (PetscBLASInt k = 0; k <= layers; k++) first[k + 1] += first[k];
  factors->inner  = first[layers];
  factors->border = factors->order - factors->inner;
  for (int i = 0; i < order; i++) factors->place[i] = first[layer[i] > 0 ? layer[i] - 1 : layers]++;
  for (PetscBLASInt k = layers + 1; k > 0; k--) first[k] = first[k - 1];
  first[0] = 0;
  for (PetscBLASInt k = 0; k < layers; k++) {
    const size_t mine = first[k + 1] - first[k], next = k + 1 < layers ? first[k + 2] - first[k + 1] : 0;
    factors->diagonal[k + 1] = factors->diagonal[k] + mine * mine;
    factors->side[k + 1]     = factors->side[k] + mine * next;
  }
  const size_t inner = factors->inner, border = factors->border;
  PetscCall(PetscMalloc3(factors->diagonal[layers], &factors->pivot, factors->side[layers], &factors->below, factors->side[layers],
                         &factors->above));
  PetscCall(PetscMalloc3(inner * border, &factors->column, inner * border, &factors->row, border * border, &factors->corner));
  PetscFunctionReturn(0);
}

/* Rows of a layer. */
static PetscBLASInt size_of(const Factors *factors, PetscBLASInt k)
{
  return factors->first[k + 1] - factors->first[k];
}

/* Puts the matrix into the blocks. */
static PetscErrorCode fill(Factors *factors, Mat matrix)
{
  PetscInt           order;
  const PetscInt    *row, *column;
  const PetscScalar *value;
  PetscBool          done;
  const size_t       inner = factors->inner, border = factors->border;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(factors->pivot, factors->diagonal[factors->layers]));
  PetscCall(PetscArrayzero(factors->below, factors->side[factors->layers]));
  PetscCall(PetscArrayzero(factors->above, factors->side[factors->layers]));
  PetscCall(PetscArrayzero(factors->column, inner * border));
  PetscCall(PetscArrayzero(factors->row, inner * border));
  PetscCall(PetscArrayzero(factors->corner, border * border));
  PetscCall(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &order, &row, &column, &done));
  PetscCheck(done && order == factors->order, PETSC_COMM_SELF, PETSC_ERR_SUP, "layers are of PETSc's own sparse matrices");
  PetscCall(MatSeqAIJGetArrayRead(matrix, &value));
  for (PetscInt i = 0; i < order; i++) {
    const int          mine = factors->layer[i];
    const PetscBLASInt at = factors->place[i], size = mine < 0 ? 0 : size_of(factors, mine);
    for (PetscInt e = row[i]; e < row[i + 1]; e++) {
      const int          other = factors->layer[column[e]];
      const PetscBLASInt to    = factors->place[column[e]];
      if (mine < 0 && other < 0) factors->corner[(at - inner) + (to - inner) * border] = value[e];
      else if (mine < 0) factors->row[to + (at - inner) * inner] = value[e];
      else if (other < 0) factors->column[at + (to - inner) * inner] = value[e];
      else {
        const size_t place = (at - factors->first[mine]) + (size_t)(to - factors->first[other]) * size;
        PetscCheck(PetscAbs(mine - other) <= 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "layers %d and %d are coupled", mine, other);
        if (other == mine) factors->pivot[factors->diagonal[mine] + place] = value[e];
        else if (other < mine) factors->below[factors->side[other] + place] = value[e];
        else factors->above[factors->side[mine] + place] = value[e];
      }
    }
  }
  PetscCall(MatSeqAIJRestoreArrayRead(matrix, &value));
  PetscCall(MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &order, &row, &column, &done));
  PetscFunctionReturn(0);
}

/* y = y - A x or y = y - A^T x, of several x and y. */
static void take_away(char transposed, PetscBLASInt rows, PetscBLASInt columns, PetscBLASInt many, const double a[], PetscBLASInt rows_of_a,
                      const double x[], PetscBLASInt apart_x, double y[], PetscBLASInt apart_y)
{
  const double       minus = -1.0, one = 1.0;
  const PetscBLASInt single = 1;

  if (many == 1) {
    const PetscBLASInt columns_of_a = transposed == 'T' ? rows : columns;
    BLASgemv_(&transposed, &rows_of_a, &columns_of_a, &minus, a, &rows_of_a, x, &single, &one, y, &single);
  } else BLASgemm_(&transposed, "N", &rows, &many, &columns, &minus, a, &rows_of_a, x, &apart_x, &one, y, &apart_y);
}

/* Solves with a layer's own block. */
static void solve_block(const Factors *factors, PetscBLASInt k, char transposed, PetscBLASInt many, double x[], PetscBLASInt apart)
{
  const PetscBLASInt size = size_of(factors, k);
  PetscBLASInt       info;

  LAPACKgetrs_(&transposed, &size, &many, factors->pivot + factors->diagonal[k], &size, factors->exchange + factors->first[k], x,
               &apart, &info);
}

/* Solves what the layers say alone, of several right sides. */
static void solve_layers(const Factors *factors, PetscBLASInt many, double x[])
{
  const PetscBLASInt *first = factors->first, inner = factors->inner;

  for (PetscBLASInt k = 0; k < factors->layers; k++) {
    const PetscBLASInt size = size_of(factors, k);
    if (k > 0) take_away('N', size, size_of(factors, k - 1), many, factors->below + factors->side[k - 1], size, x + first[k - 1], inner,
                         x + first[k], inner);
    solve_block(factors, k, 'N', many, x + first[k], inner);
  }
  for (PetscBLASInt k = factors->layers - 2; k >= 0; k--) {
    const PetscBLASInt size = size_of(factors, k);
    take_away('N', size, size_of(factors, k + 1), many, factors->above + factors->side[k], size, x + first[k + 1], inner, x + first[k],
              inner);
  }
}

/* The same of the transposed matrix, of one right side. */
static void solve_layers_transposed(const Factors *factors, double x[])
{
  const PetscBLASInt *first = factors->first, inner = factors->inner;

  for (PetscBLASInt k = 1; k < factors->layers; k++) {
    const PetscBLASInt before = size_of(factors, k - 1);
    take_away('T', size_of(factors, k), before, 1, factors->above + factors->side[k - 1], before, x + first[k - 1], inner, x + first[k],
              inner);
  }
  for (PetscBLASInt k = factors->layers - 1; k >= 0; k--) {
    const PetscBLASInt size = size_of(factors, k);
    if (k + 1 < factors->layers) {
      const PetscBLASInt next = size_of(factors, k + 1);
      take_away('T', size, next, 1, factors->below + factors->side[k], next, x + first[k + 1], inner, x + first[k], inner);
    }
    solve_block(factors, k, 'T', 1, x + first[k], inner);
  }
}

/* Eliminates layer by layer, then what couples all; whether all pivots were there. */
static PetscBool eliminate(Factors *factors)
{
  const PetscBLASInt inner = factors->inner, border = factors->border;
  PetscBLASInt       info;

  for (PetscBLASInt k = 0; k < factors->layers; k++) {
    const PetscBLASInt size = size_of(factors, k);
    double            *pivot = factors->pivot + factors->diagonal[k];
    if (k > 0) {
      const PetscBLASInt before = size_of(factors, k - 1);
      take_away('N', size, before, size, factors->below + factors->side[k - 1], size, factors->above + factors->side[k - 1], before,
                pivot, size);
    }
    LAPACKgetrf_(&size, &size, pivot, &size, factors->exchange + factors->first[k], &info);
    if (info != 0) return PETSC_FALSE;
    if (k + 1 < factors->layers) solve_block(factors, k, 'N', size_of(factors, k + 1), factors->above + factors->side[k], size);
  }
  if (border == 0) return PETSC_TRUE;
  solve_layers(factors, border, factors->column);
  take_away('T', border, inner, border, factors->row, inner, factors->column, inner, factors->corner, border);
  LAPACKgetrf_(&border, &border, factors->corner, &border, factors->exchange + inner, &info);
  return info == 0 ? PETSC_TRUE : PETSC_FALSE;
}

static PetscErrorCode factor(PC pc)
{
  Factors *factors;
  Mat      matrix;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(PCGetOperators(pc, NULL, &matrix));
  if (!factors->left) {
    PetscCall(MatCreateVecs(matrix, &factors->left, &factors->correction));
  }
  PetscCall(fill(factors, matrix));
  factors->made  = eliminate(factors);
  factors->looks = PETSC_TRUE;
  PetscCall(PCSetFailedReason(pc, factors->made ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT));
  PetscFunctionReturn(0);
}

/* A solution as the factors give it. */
static PetscErrorCode solve_once(Factors *factors, Vec right, Vec solution, PetscBool transposed)
{
  const PetscBLASInt inner = factors->inner, border = factors->border, one = 1;
  const PetscScalar *given;
  PetscScalar       *found;
  double            *x = factors->value, *last = x + inner;
  PetscBLASInt       info;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(right, &given));
  for (PetscBLASInt i = 0; i < factors->order; i++) x[factors->place[i]] = given[i];
  PetscCall(VecRestoreArrayRead(right, &given));
  if (!transposed) solve_layers(factors, 1, x);
  if (border > 0) {
    take_away('T', border, inner, 1, transposed ? factors->column : factors->row, inner, x, inner, last, border);
    LAPACKgetrs_(transposed ? "T" : "N", &border, &one, factors->corner, &border, factors->exchange + inner, last, &border, &info);
    take_away('N', inner, border, 1, transposed ? factors->row : factors->column, inner, last, border, x, inner);
  }
  if (transposed) solve_layers_transposed(factors, x);
  PetscCall(VecGetArrayWrite(solution, &found));
  for (PetscBLASInt i = 0; i < factors->order; i++) found[i] = x[factors->place[i]];
  PetscCall(VecRestoreArrayWrite(solution, &found));
  PetscFunctionReturn(0);
}

/* The same, corrected until it meets the matrix. */
static PetscErrorCode solve_by(PC pc, Vec right, Vec solution, PetscBool transposed)
{
  Factors  *factors;
  Mat       matrix;
  PetscReal whole, norm;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &factors));
  PetscCall(PCGetOperators(pc, NULL, &matrix));
  PetscCall(solve_once(factors, right, solution, transposed));
  if (!factors->looks) PetscFunctionReturn(0);
  PetscCall(VecNorm(right, NORM_2, &whole));
  for (int i = 0; i < corrections; i++) {
    if (transposed) PetscCall(MatMultTranspose(matrix, solution, factors->left));
    else PetscCall(MatMult(matrix, solution, factors->left));
    PetscCall(VecAYPX(factors->left, -1.0, right));
    PetscCall(VecNorm(factors->left, NORM_2, &norm));
    if (!(norm > enough * whole)) {
      if (i == 0 && whole > 0.0) factors->looks = PETSC_FALSE;
      break;
    }
    PetscCall(solve_once(factors, factors->left, factors->correction, transposed));
    PetscCall(VecAXPY(solution, 1.0, factors->correction));
  }
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
  PetscCall(VecDestroy(&factors->left));
  PetscCall(VecDestroy(&factors->correction));
  PetscCall(PetscFree4(factors->layer, factors->place, factors->exchange, factors->value));
  PetscCall(PetscFree3(factors->first, factors->diagonal, factors->side));
  PetscCall(PetscFree3(factors->pivot, factors->below, factors->above));
  PetscCall(PetscFree3(factors->column, factors->row, factors->corner));
  PetscCall(PetscFree(factors));
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_use_layers(intptr_t handle, int order, const int layer[])
{
  PC       pc = (PC)handle;
  Factors *factors;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&factors));
  PetscCall(place_unknowns(factors, order, layer));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, label));
  PetscCall(PCShellSetContext(pc, factors));
  PetscCall(PCShellSetSetUp(pc, factor));
  PetscCall(PCShellSetApply(pc, solve));
  PetscCall(PCShellSetApplyTranspose(pc, solve_transposed));
  PetscCall(PCShellSetDestroy(pc, destroy));
  PetscFunctionReturn(0);
}

/* Changes a sign once for each exchange of rows and each negative pivot of a block. */
static int sign_of_block(const double block[], const PetscBLASInt exchange[], PetscBLASInt size, int sign)
{
  for (PetscBLASInt i = 0; i < size; i++) {
    if ((block[i + (size_t)i * size] < 0.0) != (exchange[i] != i + 1)) sign = -sign;
  }
  return sign;
}

PetscErrorCode gfb_are_layers(intptr_t handle, int *are)
{
  PC          pc = (PC)handle;
  PetscBool   is_shell, are_layers;
  const char *name;

  PetscFunctionBeginUser;
  *are = 0;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCSHELL, &is_shell));
  if (!is_shell) PetscFunctionReturn(0);
  PetscCall(PCShellGetName(pc, &name));
  PetscCall(PetscStrcmp(name, label, &are_layers));
  *are = are_layers ? 1 : 0;
  PetscFunctionReturn(0);
}

PetscErrorCode gfb_layers_sign(intptr_t handle, int *sign)
{
  Factors *factors;
  int      are;

  PetscFunctionBeginUser;
  *sign = 0;
  PetscCall(gfb_are_layers(handle, &are));
  if (!are) PetscFunctionReturn(0);
  PetscCall(PCShellGetContext((PC)handle, &factors));
  if (!factors->made) PetscFunctionReturn(0);
  *sign = 1;
  for (PetscBLASInt k = 0; k < factors->layers; k++)
    *sign = sign_of_block(factors->pivot + factors->diagonal[k], factors->exchange + factors->first[k], size_of(factors, k), *sign);
  *sign = sign_of_block(factors->corner, factors->exchange + factors->inner, factors->border, *sign);
  PetscFunctionReturn(0);
}
