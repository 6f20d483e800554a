#include "gfb_petsc.h"
!> What a bump strip costs from the mesh to all displacements, step by step.
module gfb_strip_cost
  use petscksp
  use, intrinsic :: iso_fortran_env, only: output_unit
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_quad_mesh, only: quad_mesh_type, node_set
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures
  use gfb_film_mesh, only: axial_rows
  use gfb_substructures, only: substructure_type, find_kinds
  use gfb_shell_geometry, only: shell_section_type, node_unknowns
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_foil_assembly, only: create_foil_structure
  use gfb_cost_events, only: enter_stage, leave_stage
  implicit none (type)
  private
  public :: make_strip, strip_cost, argument, tell

  !> A bump strip and its supports.
  type, public :: strip_type
    type(quad_mesh_type) :: mesh
    type(shell_section_type) :: section
    logical, allocatable :: fixed(:, :)             !! (5, nodes)
    type(substructure_type), allocatable :: piece(:)
    integer :: bumps = 0
  end type strip_type

  !> CPU time of each step [s], and what came out.
  type, public :: strip_cost_type
    real(wp) :: set_up = 0.0_wp    !! numbering, condensation, assembly
    real(wp) :: factor = 0.0_wp    !! of a new pattern: analysis and numbers
    real(wp) :: refactor = 0.0_wp  !! of the same pattern: numbers only
    real(wp) :: solve = 0.0_wp     !! one right side
    real(wp) :: recovery = 0.0_wp  !! displacements of all nodes
    integer :: unknowns = 0        !! of the equations
    integer :: kinds = 0           !! condensed
    real(wp), allocatable :: moved(:, :) !! (5, nodes) zero at nodes of other ranks [m], [rad]
  end type strip_cost_type

contains

  !> Bumps of [Gu2020] table 1, case 1: first corner line clamped, all corner lines fixed in v.
  !>
  !> Without more words ten equal ones.
  function make_strip(arc_elements, flat_elements, axial_elements, bumps, growth) result(strip)
    integer, intent(in) :: arc_elements, flat_elements !! of a bump
    integer, intent(in) :: axial_elements              !! over the whole width
    integer, intent(in), optional :: bumps !! their number; 10 where it is absent
    real(wp), intent(in), optional :: growth !! of the bumps' measures, from the first to the last [1]
    type(strip_type) :: strip

    real(wp), parameter :: width = 38.1e-3_wp
    type(strip_shape_type) :: shape
    real(wp), allocatable :: scale(:) ! of each bump
    integer :: i

    strip%bumps = 10
    if (present(bumps)) strip%bumps = bumps
    allocate (shape%bump(strip%bumps))
    allocate (scale(strip%bumps), source=1.0_wp)
    if (present(growth)) scale = [(1.0_wp + growth*real(i - 1, wp)/real(strip%bumps, wp), i=1, strip%bumps)]
    shape%bump%half_length = 1.778e-3_wp*scale
    shape%bump%height = 0.508e-3_wp*scale
    shape%bump%pitch = 4.572e-3_wp*scale
    shape%arc_elements = arc_elements
    shape%flat_elements = flat_elements
    strip%section = shell_section_type(0.102e-3_wp, 214.0e9_wp, 0.29_wp, 8440.0_wp)
    strip%mesh = bump_strip_mesh(shape, axial_rows(width, axial_elements, .false., 1.0_wp), .false.)
    strip%piece = strip_substructures(shape, strip%mesh)
    allocate (strip%fixed(node_unknowns, size(strip%mesh%position, 2)), source=.false.)
    strip%fixed(2, node_set(strip%mesh, 'corners')) = .true.
    strip%fixed(:, node_set(strip%mesh, 'fixed_edge')) = .true.
  end function make_strip

  !> Takes all steps once, full or reduced, equal pieces condensed once or each on its own.
  subroutine strip_cost(strip, reduced, congruent, cost, error)
    type(strip_type), intent(in) :: strip !! mesh, section and supports
    logical, intent(in) :: reduced   !! condense the pieces
    logical, intent(in) :: congruent !! see which pieces are equal
    type(strip_cost_type), intent(out) :: cost !! times, and the displacements
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(foil_structure_type) :: foil
    type(substructure_type), allocatable :: piece(:)
    real(wp), allocatable :: moved(:, :) ! of this rank's nodes
    Vec :: load, solution
    PetscErrorCode :: ierr
    real(wp) :: start
    integer :: i

    start = now()
    call enter_stage('set-up')
    piece = strip%piece
    piece%kind = [(i, i=1, size(piece))]
    if (congruent) call find_kinds(strip%mesh, strip%fixed, piece)
    call create_foil_structure(strip%mesh, strip%section, strip%fixed, piece, reduced, foil, error)
    call leave_stage()
    if (allocated(error)) return
    cost%set_up = now() - start
    cost%unknowns = foil%unknowns
    cost%kinds = foil%condensations
    PetscCallA(MatCreateVecs(foil%stiffness, solution, load, ierr))
    call load_crests(foil, strip%bumps, load)
    call time_solver(foil%stiffness, load, solution, cost)
    allocate (moved(node_unknowns, size(foil%part%mesh_node)))
    start = now()
    call enter_stage('recovery')
    call foil%displacements(solution, moved)
    call leave_stage()
    cost%recovery = now() - start
    allocate (cost%moved(node_unknowns, size(strip%mesh%position, 2)), source=0.0_wp)
    cost%moved(:, foil%part%mesh_node) = moved
    PetscCallA(VecDestroy(load, ierr))
    PetscCallA(VecDestroy(solution, ierr))
    call destroy_foil_structure(foil)
  end subroutine strip_cost

  !> A force on each node of the crest lines, no two alike, so that nothing is symmetric.
  subroutine load_crests(foil, bumps, load)
    type(foil_structure_type), intent(in) :: foil
    integer, intent(in) :: bumps
    Vec, intent(in) :: load
    integer, allocatable :: line(:)
    integer :: bump, i
    PetscErrorCode :: ierr

    do bump = 1, bumps
      line = node_set(foil%mesh, 'crest_'//text(bump))
      do i = 1, size(line)
        if (.not. foil%owns(line(i))) cycle
        PetscCallA(VecSetValue(load, int(foil%unknown(2, line(i)), pint), -1.0_wp - 0.5_wp*sin(real(7*bump + i, wp)), INSERT_VALUES, ierr))
      end do
    end do
    PetscCallA(VecAssemblyBegin(load, ierr))
    PetscCallA(VecAssemblyEnd(load, ierr))
  end subroutine load_crests

  !> Factors twice and solves once, by Cholesky as the strip's analysis does.
  subroutine time_solver(matrix, load, solution, cost)
    Mat, intent(in) :: matrix
    Vec, intent(in) :: load, solution
    type(strip_cost_type), intent(inout) :: cost

    KSP :: solver
    PC :: factors
    KSPConvergedReason :: reason
    PetscErrorCode :: ierr
    real(wp) :: start

    start = now()
    PetscCallA(MatSetOption(matrix, MAT_SPD, PETSC_TRUE, ierr))
    PetscCallA(KSPCreate(PETSC_COMM_WORLD, solver, ierr))
    PetscCallA(KSPSetOperators(solver, matrix, matrix, ierr))
    PetscCallA(KSPSetType(solver, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(solver, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(KSPSetUp(solver, ierr))
    cost%factor = now() - start
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr)) ! so that its numbers count as new
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(KSPSetOperators(solver, matrix, matrix, ierr))
    start = now()
    PetscCallA(KSPSetUp(solver, ierr))
    cost%refactor = now() - start
    start = now()
    PetscCallA(KSPSolve(solver, load, solution, ierr))
    cost%solve = now() - start
    PetscCallA(KSPGetConvergedReason(solver, reason, ierr))
    if (GFB_REASON(reason) < 0) error stop 'the strip that is measured is not fixed'
    PetscCallA(KSPDestroy(solver, ierr))
  end subroutine time_solver

  !> CPU time of this process [s].
  real(wp) function now() result(seconds)
    call cpu_time(seconds)
  end function now

  !> A whole number of the command line.
  integer function argument(position, usage) result(number)
    integer, intent(in) :: position !! of the argument on the command line, from 1
    character(len=*), intent(in) :: usage !! what the command line should be
    character(len=20) :: word
    integer :: status

    call get_command_argument(position, word)
    read (word, *, iostat=status) number
    if (status /= 0) error stop 'use: '//usage
  end function argument

  !> One result: a line `name,value`.
  subroutine tell(name, value)
    character(len=*), intent(in) :: name !! of the result
    real(wp), intent(in) :: value !! of the result, in its unit
    write (output_unit, '(a, ",", es23.15e3)') name, value
  end subroutine tell
end module gfb_strip_cost
