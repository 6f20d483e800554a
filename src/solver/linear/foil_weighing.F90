#include "gfb_petsc.h"
!> Weighs a foil that moves, or decides that its mass does not count.
!>
!> Whether it counts is seen by the lowest natural frequency of the foil alone, its contacts as
!> they are: next to it and beyond nothing may be left out. A free edge that is lifted has a low one.
!>
!> It is no hook of the momentum block. Such hooks add to a step of time or to a vibration of the bearing as it is; here it is found out,
!> once and before any of them, whether there is such a block: by an eigenvalue problem on the assembled matrix at rest, contacts and
!> softness in it, which every other block has to have been in already.
module gfb_foil_weighing
  use slepceps
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: largest_over_ranks, largest_number, any_rank
  use gfb_motion_cases, only: mass_auto, mass_on, mass_off
  use gfb_craig_bampton, only: craig_bampton_type, reduce_matrices
  use gfb_condensed_piece, only: condensed_piece_type, destroy_pieces
  use gfb_bearing_system, only: bearing_system_type
  use gfb_film_rates, only: fill_from_foil
  use gfb_inner_motion, only: inner_modes_type
  use gfb_foil_inertia, only: foil_inertia_type
  use gfb_linear_solver, only: use_multigrid
  use gfb_dynamic_response, only: dynamic_response_type, linearise_steady
  implicit none (type)
  private
  public :: give_mass, give_momentum

  real(wp), parameter :: safe_ratio = 1.0_wp/3.0_wp !! of a frequency to the foil's, where its mass is little [1]
  real(wp), parameter :: tolerance = 1.0e-8_wp !! of the foil's lowest eigenvalue [1]
  real(wp), parameter :: solved = 1.0e-10_wp !! residual of iterations for it, over the right side [1]
  character(len=*), parameter :: prefix = 'foil_modes_' !! of PETSc's options

contains

  !> Gives the foil of a response its mass where it is asked for, or counts. The bearing of tilts has it where
  !> the other one has.
  subroutine give_mass(bearing, response, wanted, modes, highest)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    integer, intent(in) :: wanted   !! `mass_auto`, `mass_on` or `mass_off`
    integer, intent(in) :: modes    !! kept in each condensed piece, at most
    real(wp), intent(in) :: highest !! frequency that is asked for [rad/s]

    call create_inertia(bearing, response%equations%steady, wanted, modes, highest, response%equations%inertia)
    if (.not. allocated(response%opposite)) return
    call create_inertia(response%opposite_bearing, response%opposite%equations%steady, &
                        merge(mass_on, mass_off, response%equations%inertia%present), modes, highest, &
                        response%opposite%equations%inertia)
  end subroutine give_mass

  !> Gives the foils of a bearing their mass over time where it is asked for, or counts.
  subroutine give_momentum(bearing, wanted, modes, highest, inertia)
    type(bearing_system_type), intent(inout) :: bearing !! at rest; its equations stay
    integer, intent(in) :: wanted   !! `mass_auto`, `mass_on` or `mass_off`
    integer, intent(in) :: modes    !! kept in each condensed piece, at most
    real(wp), intent(in) :: highest !! frequency that is expected [rad/s]
    type(foil_inertia_type), intent(out) :: inertia !! what was found; to be destroyed
    Mat :: steady, mass
    PetscErrorCode :: ierr

    inertia%highest = highest
    if (wanted == mass_off .or. .not. bearing%is_meshed()) return
    call linearise_steady(bearing, .true., steady)
    call create_inertia(bearing, steady, wanted, modes, highest, inertia)
    PetscCallA(MatDestroy(steady, ierr))
    if (.not. inertia%present) return
    PetscCallA(MatDuplicate(inertia%mass, MAT_COPY_VALUES, mass, ierr))
    call bearing%momentum%begin(mass, bearing%state)
    if (inertia%has_modes) call bearing%momentum%inner%begin(inertia%inner, inertia%mass, inertia%left, inertia%right)
  end subroutine give_momentum

  !> Makes the mass where it is asked for, or decides whether it counts.
  subroutine create_inertia(bearing, steady, wanted, modes, highest, inertia)
    type(bearing_system_type), intent(in) :: bearing
    Mat, intent(in) :: steady
    integer, intent(in) :: wanted, modes
    real(wp), intent(in) :: highest
    type(foil_inertia_type), intent(out) :: inertia
    PetscErrorCode :: ierr

    inertia%highest = highest
    if (wanted == mass_off .or. .not. bearing%is_meshed()) return
    call weigh_foil(bearing, steady, modes, inertia)
    inertia%present = .true.
    if (wanted == mass_auto) then
      call find_lowest(bearing, steady, inertia)
      inertia%present = inertia%highest > safe_ratio*inertia%lowest
      inertia%judged = .true.
    end if
    if (inertia%present) then
      PetscCallA(VecDuplicate(bearing%state, inertia%left, ierr))
      PetscCallA(VecDuplicate(bearing%state, inertia%right, ierr))
      call bearing%exchange%put(1.0_wp/bearing%equation_scale(bearing%point), inertia%left)
      call bearing%exchange%put(bearing%unknown_scale, inertia%right)
    else
      PetscCallA(MatDestroy(inertia%mass, ierr))
    end if
  end subroutine create_inertia

  !> Modes inside pieces whose modulus is not that they were built with: each pad has its own.
  subroutine soften_modes(bearing, surface, pieces, inertia)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: surface(:) !! of the foil, one a kind of pieces
    integer, intent(in) :: pieces !! of a pad, of all kinds and ranks
    type(foil_inertia_type), intent(inout) :: inertia
    type(inner_modes_type), allocatable :: of_all(:)
    integer, allocatable :: mine(:)
    integer :: i, k, pad, pads
    real(wp) :: modulus(size(bearing%pad), size(surface))

    pads = size(bearing%pad)
    do pad = 1, pads
      modulus(pad, :) = bearing%pad(pad)%foil%modulus(surface)
    end do
    if (.not. any(abs(modulus - 1.0_wp) > 0.0_wp)) return
    call move_alloc(inertia%inner, of_all)
    allocate (inertia%inner(size(of_all)*pads))
    do i = 1, size(of_all)
      do pad = 1, pads
        mine = pack([(k, k=1, size(of_all(i)%place))], (of_all(i)%place - 1)/pieces == pad - 1)
        associate (one => inertia%inner((i - 1)*pads + pad))
          one%number = of_all(i)%number(:, mine)
          one%place = of_all(i)%place(mine)
          one%coupling = of_all(i)%coupling
          one%eigenvalue = modulus(pad, i)*of_all(i)%eigenvalue
        end associate
      end do
    end do
    if (inertia%left_out < huge(1.0_wp)) inertia%left_out = sqrt(minval(modulus))*inertia%left_out
  end subroutine soften_modes

  !> The mass matrix, and the modes inside condensed pieces.
  subroutine weigh_foil(bearing, pattern, modes, inertia)
    type(bearing_system_type), intent(in) :: bearing
    Mat, intent(in) :: pattern
    integer, intent(in) :: modes
    type(foil_inertia_type), intent(inout) :: inertia
    type(condensed_piece_type), allocatable :: piece(:)
    type(error_type), allocatable :: error
    real(wp) :: most(1)
    Mat :: of_foil
    PetscErrorCode :: ierr
    integer :: i, pieces

    associate (foil => bearing%pad(1)%foil)
      PetscCallA(MatDuplicate(foil%elastic, MAT_DO_NOT_COPY_VALUES, of_foil, ierr))
      ! Where a flat foil's stiffness couples nothing its mass has nothing but round-off.
      PetscCallA(MatSetOption(of_foil, MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE, ierr))
      call foil%add_mass(of_foil, piece, error)
      if (allocated(error)) error stop 'an element that has a stiffness has a mass'
    end associate
    pieces = largest_number([(piece(i)%place, i=1, size(piece))])
    allocate (inertia%inner(size(piece)))
    do i = 1, size(piece)
      call reduce_piece(bearing, piece(i), pieces, modes, inertia%left_out, inertia%inner(i), of_foil)
    end do
    call destroy_pieces(piece)
    call soften_modes(bearing, piece%surface, pieces, inertia)
    PetscCallA(MatAssemblyBegin(of_foil, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(of_foil, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDuplicate(pattern, MAT_DO_NOT_COPY_VALUES, inertia%mass, ierr))
    PetscCallA(MatSetOption(inertia%mass, MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE, ierr))
    call fill_from_foil(bearing, of_foil, inertia%mass)
    PetscCallA(MatDestroy(of_foil, ierr))
    inertia%has_modes = any_rank(any([(size(inertia%inner(i)%eigenvalue) > 0, i=1, size(piece))]))
    most = largest_over_ranks([-inertia%left_out])
    inertia%left_out = -most(1)
  end subroutine weigh_foil

  !> Adds the condensed mass of all pieces of a kind, and keeps its modes.
  subroutine reduce_piece(bearing, piece, pieces, wanted, left_out, inner, of_foil)
    type(bearing_system_type), intent(in) :: bearing
    type(condensed_piece_type), intent(in) :: piece
    integer, intent(in) :: pieces !! of a pad, of all kinds and ranks
    integer, intent(in) :: wanted !! modes
    real(wp), intent(inout) :: left_out !! [rad/s]
    type(inner_modes_type), intent(out) :: inner
    Mat, intent(in) :: of_foil
    type(craig_bampton_type) :: reduced
    PetscInt :: row(size(piece%number, 1))
    PetscErrorCode :: ierr
    integer :: i, k, pad, kept, modes

    ! One mode more shows what is left out.
    call reduce_matrices(piece%stiffness, piece%mass, piece%is_retained, wanted + 1, reduced)
    kept = reduced%retained
    modes = min(wanted, reduced%modes)
    if (reduced%modes > modes) left_out = min(left_out, sqrt(reduced%eigenvalue(modes + 1)))
    inner%eigenvalue = reduced%eigenvalue(:modes)
    inner%coupling = reduced%mass(:kept, kept + 1:kept + modes)
    do i = 1, modes
      associate (m => inner%coupling(:, i))
        ! Eigenvectors have either sign: the first large entry is positive, on any rank.
        if (m(findloc(abs(m) >= 0.5_wp*maxval(abs(m)), .true., dim=1)) < 0.0_wp) m = -m
      end associate
    end do
    inner%place = [((pad - 1)*pieces + piece%place, pad=1, size(bearing%pad))]
    allocate (inner%number(kept, size(bearing%pad)*size(piece%number, 2)), source=-1)
    do k = 1, size(piece%number, 2)
      row = int(piece%number(:, k) - 1, pint)
      PetscCallA(MatSetValues(of_foil, int(kept, pint), row, int(kept, pint), row, [reduced%mass(:kept, :kept)], ADD_VALUES, ierr))
      do pad = 1, size(bearing%pad)
        associate (number => inner%number(:, (pad - 1)*size(piece%number, 2) + k))
          do i = 1, kept
            if (piece%number(i, k) > 0) number(i) = bearing%blocks%global_number(2*pad, piece%number(i, k))
          end do
        end associate
      end do
    end do
  end subroutine reduce_piece

  !> Lowest natural frequency of the foil alone, by shifted and inverted iteration at zero.
  subroutine find_lowest(bearing, steady, inertia)
    type(bearing_system_type), intent(in) :: bearing
    Mat, intent(in) :: steady
    type(foil_inertia_type), intent(inout) :: inertia
    Mat :: stiffness, mass
    IS :: own
    EPS :: solver
    ST :: transformation
    KSP :: linear
    PC :: factors
    PetscInt :: found
    PetscScalar :: re, im
    PetscErrorCode :: ierr

    call own_numbers(bearing, own)
    if (bearing%has_motions) then
      call leave_foils(steady, own, stiffness)
      PetscCallA(MatDuplicate(inertia%mass, MAT_COPY_VALUES, mass, ierr))
    else
      PetscCallA(MatCreateSubMatrix(steady, own, own, MAT_INITIAL_MATRIX, stiffness, ierr))
      PetscCallA(MatCreateSubMatrix(inertia%mass, own, own, MAT_INITIAL_MATRIX, mass, ierr))
    end if
    PetscCallA(EPSCreate(PETSC_COMM_WORLD, solver, ierr))
    PetscCallA(EPSSetOptionsPrefix(solver, prefix, ierr))
    PetscCallA(EPSSetOperators(solver, stiffness, mass, ierr))
    PetscCallA(EPSSetProblemType(solver, EPS_GNHEP, ierr)) ! the scales of rows and columns differ
    PetscCallA(EPSSetTarget(solver, 0.0_wp, ierr))
    PetscCallA(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE, ierr))
    PetscCallA(EPSSetTolerances(solver, tolerance, PETSC_DEFAULT_INTEGER, ierr))
    PetscCallA(EPSGetST(solver, transformation, ierr))
    PetscCallA(STSetType(transformation, STSINVERT, ierr))
    PetscCallA(STGetKSP(transformation, linear, ierr))
    if (bearing%has_motions) then
      call use_multigrid(linear, prefix//'st_', .false., bearing%motions)
      PetscCallA(KSPSetTolerances(linear, solved, 0.0_wp, PETSC_DEFAULT_REAL, PETSC_DEFAULT_INTEGER, ierr))
      PetscCallA(KSPSetErrorIfNotConverged(linear, PETSC_FALSE, ierr))
    else
      PetscCallA(KSPSetType(linear, KSPPREONLY, ierr))
      PetscCallA(KSPGetPC(linear, factors, ierr))
      PetscCallA(PCSetType(factors, PCLU, ierr))
      PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    end if
    PetscCallA(EPSSetFromOptions(solver, ierr))
    PetscCallA(EPSSolve(solver, ierr))
    PetscCallA(EPSGetConverged(solver, found, ierr))
    inertia%lowest = 0.0_wp
    if (found > 0) then
      PetscCallA(EPSGetEigenvalue(solver, 0_pint, re, im, ierr))
      inertia%lowest = sqrt(hypot(re, im))
    end if
    PetscCallA(EPSDestroy(solver, ierr))
    PetscCallA(MatDestroy(stiffness, ierr))
    PetscCallA(MatDestroy(mass, ierr))
    PetscCallA(ISDestroy(own, ierr))
  end subroutine find_lowest

  !> The matrix of the foils in the numbers of the bearing, all other unknowns by themselves: iterations have their coarse space in these.
  subroutine leave_foils(steady, own, stiffness)
    Mat, intent(in) :: steady
    IS, intent(in) :: own !! this rank's unknowns of the foils
    Mat, intent(out) :: stiffness
    IS :: others
    PetscInt :: first, last
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(steady, MAT_COPY_VALUES, stiffness, ierr))
    PetscCallA(MatGetOwnershipRange(steady, first, last, ierr))
    PetscCallA(ISComplement(own, first, last, others, ierr))
    PetscCallA(MatZeroRowsColumnsIS(stiffness, others, 1.0_wp, PETSC_NULL_VEC, PETSC_NULL_VEC, ierr))
    PetscCallA(ISDestroy(others, ierr))
  end subroutine leave_foils

  !> Numbers, from 0, of this rank's unknowns of the foils among those of the bearing.
  subroutine own_numbers(bearing, own)
    type(bearing_system_type), intent(in) :: bearing
    IS, intent(out) :: own
    PetscInt :: first, last, i
    PetscInt, allocatable :: number(:)
    PetscErrorCode :: ierr
    integer :: pad

    associate (blocks => bearing%blocks)
      PetscCallA(MatGetOwnershipRange(bearing%pad(1)%foil%elastic, first, last, ierr))
      number = [((int(blocks%global_number(2*pad, int(i)), pint), i=first + 1, last), pad=1, size(bearing%pad))]
      PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, size(number, kind=pint), number, PETSC_COPY_VALUES, own, ierr))
    end associate
  end subroutine own_numbers
end module gfb_foil_weighing
