/* PETSc's and SLEPc's Fortran headers, and every name that differs between their versions.
   Debian 12 has 3.18, Debian 13 3.22; what changed since is settled here, so that no source asks for a version. */
#include <slepc/finclude/slepceps.h>
#if PETSC_VERSION_LT(3,21,0)
#define SNESLineSearchShellSetApply SNESLineSearchShellSetUserFunc
#endif
#if PETSC_VERSION_LT(3,22,0)
#define PETSC_NULL_INTEGER_ARRAY PETSC_NULL_INTEGER
#define PETSC_NULL_SCALAR_ARRAY PETSC_NULL_SCALAR
#endif
#if PETSC_VERSION_LT(3,23,0)
#define GFB_VecGetArray VecGetArrayF90
#define GFB_VecRestoreArray VecRestoreArrayF90
#define GFB_VecGetArrayRead VecGetArrayReadF90
#define GFB_VecRestoreArrayRead VecRestoreArrayReadF90
#define GFB_MatDenseGetArray MatDenseGetArrayF90
#define GFB_MatDenseRestoreArray MatDenseRestoreArrayF90
#define PETSC_NULL_INTEGER_POINTER PETSC_NULL_INTEGER_ARRAY
#define PETSC_NULL_SCALAR_POINTER PETSC_NULL_SCALAR_ARRAY
#define GFB_COMM MPI_Comm
#define GFB_REASON(r) r
#else
#define GFB_VecGetArray VecGetArray
#define GFB_VecRestoreArray VecRestoreArray
#define GFB_VecGetArrayRead VecGetArrayRead
#define GFB_VecRestoreArrayRead VecRestoreArrayRead
#define GFB_MatDenseGetArray MatDenseGetArray
#define GFB_MatDenseRestoreArray MatDenseRestoreArray
#define GFB_COMM MPIU_Comm
#define GFB_REASON(r) r%v
#endif
/* From 3.24 on the name is a macro that wants a pointer. */
#ifdef MatShellGetContext
#define GFB_MatShellGetContext MatShellGetContextCptr
#else
#define GFB_MatShellGetContext MatShellGetContext
#endif
