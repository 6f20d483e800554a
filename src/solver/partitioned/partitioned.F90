#include "gfb_petsc.h"
!> Film and foil in turns, as in [Gu2020] Fig. 6b, for comparison with solving them together.
!>
!> A loop solves the film, and the shaft's position where it floats, with the foil fixed, and then
!> the foil with the film fixed. It has converged when the foil's answer is the deflection that the
!> film was solved with. Anderson acceleration shortens the loops. They start from the film of a
!> rigid foil with the foil at rest, or along a sweep from the neighbour's answer; nothing else
!> helps them.
!>
!> The equations of one side of a bearing, film and shaft or the foil, with the other side fixed.
!>
!> They are the coupled bearing's own: its residual with the other side's unknowns where they are in
!> the bearing's state, and its matrix, of both of which the side takes its share.
!>
!> Under constant pressures a foil that has lifted off flaps away by many clearances, which no film
!> would let it do. So the fixed film is the gas in the gap rather than its pressure: where the foil
!> moves, p h stays, to first order, as in a very fast bearing. Where the foil comes to rest the
!> pressures are those that were kept, so the answer of the loops is the same.
module gfb_partitioned
  use petscmat
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_ending, only: path_reached, path_thins, path_lost
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: largest_over_ranks
  use gfb_operating_point, only: operating_point_type
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, create_newton, solve_newton, forget_factors, &
                        destroy_newton
  use gfb_anderson_acceleration, only: anderson_type, create_anderson, accelerate, destroy_anderson
  use gfb_continuation, only: path_settings_type, path_report_type
  implicit none (type)
  private
  public :: create_side, create_partitioned, follow_partitioned, forget_partitioned, destroy_partitioned

  real(wp), parameter :: room = 1.0e3_wp !! clearance while the film is not asked, over its own [1]

  !> One side; keep it and the bearing where they are.
  type, extends(nonlinear_system_type), public :: coupling_side_type
    type(bearing_system_type), pointer, private :: bearing => null()
    logical, private :: of_foil = .false. !! else of film and shaft
    IS, private :: part                   !! the side's unknowns among the bearing's
    Vec, private :: whole, whole_residual !! of the bearing, at a state of the side
    Vec, private :: whole_step
    IS, private :: film_part              !! the pressures among the bearing's unknowns
    Vec, private :: kept                  !! the foil where the film was fixed
    Vec, private :: moved, pressure       !! displacement of the foil from there; pressures, scaled
    Mat, private :: yielding              !! pressures by the foil's unknowns, scaled
    Mat, private :: felt, stiffening      !! the foil's equations by the pressures; product of both
    logical, private :: multiplied = .false.
    !> of each unknown this rank knows: a pressure's among `film_part`, a displacement's in `part`, from 0 on
    integer, allocatable, private :: number(:)
  contains
    procedure :: evaluate => evaluate_side, linearise => linearise_side, settle => settle_side
    procedure :: begin_step => begin_side_step, virtual_work => work_on_side, take => take_side
    procedure :: give => give_side, fix_film, destroy => destroy_side
  end type coupling_side_type

  integer, parameter :: most_loops = 200         !! of film and foil
  integer, parameter :: foil_patience = 5        !! iterations of the foil over those of a solve
  integer, parameter :: halvings = 8             !! of a displacement to where the film has no answer
  real(wp), parameter :: longest_displacement = 0.3_wp    !! in a loop, over the clearance [1]

  !> Both sides, their solvers and what the loops remember. Keep it where it is.
  type, public :: partitioned_type
    type(newton_type) :: film_newton, foil_newton
    integer :: loops = 0 !! since its creation
    type(coupling_side_type), private :: film, foil
    type(run_log_type), private :: log
    logical, private :: created = .false.
    type(anderson_type), private :: anderson
    Vec, private :: kept                       !! foil that the film was solved with
    Vec, private :: answer                     !! foil under that film
    Vec, private :: change                     !! from the one to the other
    Vec, private :: film_before, kept_before   !! one loop ago
    real(wp), allocatable, private :: asked(:) !! change as deflection of this rank's film nodes [m]
  end type partitioned_type

contains

  !> One side: its unknowns among the bearing's, and a matrix for its equations.
  subroutine create_side(bearing, of_foil, side)
    type(bearing_system_type), target, intent(in) :: bearing !! with a matrix that was filled once
    logical, intent(in) :: of_foil !! the foil's side; else that of film and shaft
    type(coupling_side_type), intent(inout) :: side !! is created

    PetscInt :: first, last
    PetscInt, allocatable :: film(:), foil(:), number(:)
    PetscErrorCode :: ierr
    integer :: i, k

    side%bearing => bearing
    side%of_foil = of_foil
    side%dense_rows = bearing%dense_rows .and. .not. of_foil
    side%low_fill = bearing%low_fill
    PetscCallA(VecGetOwnershipRange(bearing%state, first, last, ierr))
    allocate (film(0), foil(0))
    associate (block => bearing%blocks%first_owned)
      do i = 1, size(bearing%pad)
        film = [film, [(first + int(k, pint), k=block(2*i - 1), block(2*i) - 1)]]
        foil = [foil, [(first + int(k, pint), k=block(2*i), block(2*i + 1) - 1)]]
      end do
      if (of_foil) then
        number = foil
      else
        number = [film, [(first + int(k, pint), k=block(2*size(bearing%pad) + 1), int(last - first) - 1)]]
      end if
    end associate
    PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, size(number, kind=pint), number, PETSC_COPY_VALUES, side%part, ierr))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, size(number, kind=pint), PETSC_DETERMINE, side%state, ierr))
    PetscCallA(VecDuplicate(bearing%state, side%whole, ierr))
    PetscCallA(VecDuplicate(bearing%state, side%whole_residual, ierr))
    PetscCallA(VecDuplicate(bearing%state, side%whole_step, ierr))
    PetscCallA(MatCreateSubMatrix(bearing%jacobian, side%part, side%part, MAT_INITIAL_MATRIX, side%jacobian, ierr))
    call side%take()
    if (of_foil) call create_yielding(side, film)
  end subroutine create_side

  !> Room for how the pressures yield to the foil.
  subroutine create_yielding(side, film)
    type(coupling_side_type), intent(inout) :: side
    PetscInt, intent(in) :: film(:) !! this rank's pressures among the bearing's unknowns
    PetscInt, parameter :: one = 1
    PetscInt :: pressures, unknowns
    PetscErrorCode :: ierr

    pressures = size(film, kind=pint)
    PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, pressures, film, PETSC_COPY_VALUES, side%film_part, ierr))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, pressures, PETSC_DETERMINE, side%pressure, ierr))
    PetscCallA(VecDuplicate(side%state, side%kept, ierr))
    PetscCallA(VecDuplicate(side%state, side%moved, ierr))
    PetscCallA(VecGetLocalSize(side%state, unknowns, ierr))
    PetscCallA(MatCreateAIJ(PETSC_COMM_WORLD, pressures, unknowns, PETSC_DETERMINE, PETSC_DETERMINE, one, PETSC_NULL_INTEGER_ARRAY, one, PETSC_NULL_INTEGER_ARRAY, side%yielding, ierr))
    PetscCallA(MatCreateSubMatrix(side%bearing%jacobian, side%part, side%film_part, MAT_INITIAL_MATRIX, side%felt, ierr))
    call number_parts(side)
  end subroutine create_yielding

  !> Numbers what this rank knows of the bearing's unknowns, those of other ranks too: pressures among the pressures, the
  !> foils' displacements among those of the side.
  subroutine number_parts(side)
    type(coupling_side_type), intent(inout) :: side
    real(wp) :: number(side%bearing%local_size())
    PetscErrorCode :: ierr

    PetscCallA(VecSet(side%whole, 0.0_wp, ierr))
    call number_part(side%part, side%moved)
    call number_part(side%film_part, side%pressure)
    call side%bearing%get_unknowns(number, side%whole)
    side%number = nint(number/side%bearing%unknown_scale)

  contains

    !> Numbers the unknowns of a part from 0 on.
    subroutine number_part(part, vector)
      IS, intent(in) :: part      !! of the bearing's unknowns
      Vec, intent(in) :: vector   !! of the part; is overwritten
      PetscInt :: first, last, i
      PetscErrorCode :: ierr

      PetscCallA(VecGetOwnershipRange(vector, first, last, ierr))
      PetscCallA(VecSetValues(vector, last - first, [(i, i=first, last - 1)], [(real(i, wp), i=first, last - 1)], INSERT_VALUES, ierr))
      PetscCallA(VecAssemblyBegin(vector, ierr))
      PetscCallA(VecAssemblyEnd(vector, ierr))
      PetscCallA(VecISCopy(side%whole, part, SCATTER_FORWARD, vector, ierr))
    end subroutine number_part
  end subroutine number_parts

  !> Fixes the film of the bearing's present state: its pressures where the foil stays, and the gas
  !> in the gap where it moves.
  subroutine fix_film(self)
    class(coupling_side_type), intent(inout) :: self !! the side

    real(wp) :: unknown(self%bearing%local_size()), gap(self%bearing%film_nodes()), rate
    PetscInt :: row(1), column(1)
    PetscErrorCode :: ierr
    integer :: i, node, source

    call self%bearing%get_unknowns(unknown)
    gap = self%bearing%gap(unknown)
    PetscCallA(VecISCopy(self%bearing%state, self%part, SCATTER_REVERSE, self%kept, ierr))
    do i = 1, size(self%bearing%pad)
      associate (pad => self%bearing%pad(i), foil => self%bearing%pad(i)%foil, film => self%bearing%pad(i)%film)
        do node = 1, size(pad%mesh%mesh_node)
          source = foil%source(node) - foil%first
          if (.not. pad%mesh%owned(node) .or. source < 1) cycle
          rate = -unknown(pad%first + node)/gap(pad%first_node + node)*foil%rate(node)* &
            foil%unknown_scale(source)/film%ambient_pressure
          if (film%fixed(node)) rate = 0.0_wp
          row = int(self%number(pad%first + node), pint)
          column = int(self%number(pad%first + foil%source(node)), pint)
          PetscCallA(MatSetValues(self%yielding, 1_pint, row, 1_pint, column, [rate], INSERT_VALUES, ierr))
        end do
      end associate
    end do
    PetscCallA(MatAssemblyBegin(self%yielding, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%yielding, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine fix_film

  !> Takes the side's state from the bearing's.
  subroutine take_side(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    PetscErrorCode :: ierr
    PetscCallA(VecISCopy(self%bearing%state, self%part, SCATTER_REVERSE, self%state, ierr))
  end subroutine take_side

  !> Puts the side's state into the bearing's.
  subroutine give_side(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    PetscErrorCode :: ierr
    PetscCallA(VecISCopy(self%bearing%state, self%part, SCATTER_FORWARD, self%state, ierr))
  end subroutine give_side

  !> The bearing's state with a state of the side in it.
  subroutine complete(self, state)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(self%bearing%state, self%whole, ierr))
    PetscCallA(VecISCopy(self%whole, self%part, SCATTER_FORWARD, state, ierr))
    if (.not. self%of_foil) return
    PetscCallA(VecWAXPY(self%moved, -1.0_wp, self%kept, state, ierr))
    PetscCallA(VecISCopy(self%whole, self%film_part, SCATTER_REVERSE, self%pressure, ierr))
    PetscCallA(MatMultAdd(self%yielding, self%moved, self%pressure, self%pressure, ierr))
    PetscCallA(VecISCopy(self%whole, self%film_part, SCATTER_FORWARD, self%pressure, ierr))
  end subroutine complete

  !> Residual of the side's equations. A foil under fixed pressures may close the film before it
  !> converges, whose equations nobody asks then: they are given room.
  subroutine evaluate_side(self, state, residual, valid)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    Vec, intent(in) :: residual !! of the side, scaled; is filled
    logical, intent(out) :: valid !! the equations can be evaluated at this state
    real(wp) :: clearance
    PetscErrorCode :: ierr

    call complete(self, state)
    clearance = self%bearing%clearance
    if (self%of_foil) self%bearing%pad(:)%film%clearance = room*clearance
    call self%bearing%evaluate(self%whole, self%whole_residual, valid)
    self%bearing%pad(:)%film%clearance = clearance
    PetscCallA(VecISCopy(self%whole_residual, self%part, SCATTER_REVERSE, residual, ierr))
  end subroutine evaluate_side

  !> Derivative of the side's equations by its own unknowns.
  subroutine linearise_side(self, state)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    real(wp) :: clearance
    PetscErrorCode :: ierr

    call complete(self, state)
    clearance = self%bearing%clearance
    if (self%of_foil) self%bearing%pad(:)%film%clearance = room*clearance
    call self%bearing%linearise(self%whole)
    self%bearing%pad(:)%film%clearance = clearance
    PetscCallA(MatCreateSubMatrix(self%bearing%jacobian, self%part, self%part, MAT_REUSE_MATRIX, self%jacobian, ierr))
    if (self%of_foil) call stiffen(self)
  end subroutine linearise_side

  !> Adds to the foil's matrix that the pressures yield.
  subroutine stiffen(self)
    type(coupling_side_type), intent(inout) :: self
    MatReuse :: reuse
    PetscErrorCode :: ierr

    PetscCallA(MatCreateSubMatrix(self%bearing%jacobian, self%part, self%film_part, MAT_REUSE_MATRIX, self%felt, ierr))
    reuse = MAT_INITIAL_MATRIX
    if (self%multiplied) reuse = MAT_REUSE_MATRIX
    PetscCallA(MatMatMult(self%felt, self%yielding, reuse, 2.0_wp, self%stiffening, ierr))
    self%multiplied = .true.
    PetscCallA(MatAXPY(self%jacobian, 1.0_wp, self%stiffening, SUBSET_NONZERO_PATTERN, ierr))
  end subroutine stiffen

  !> Contacts follow the foil; under a fixed foil they stay.
  subroutine settle_side(self, state, moved)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    logical, intent(out) :: moved !! some contact changed

    moved = .false.
    if (.not. self%of_foil) return
    call complete(self, state)
    call self%bearing%settle(self%whole, moved)
    self%settled = self%bearing%settled
  end subroutine settle_side

  !> A new Newton step begins where the foil's contacts are.
  subroutine begin_side_step(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    if (self%of_foil) call self%bearing%begin_step()
  end subroutine begin_side_step

  !> Work of the residual forces on the foil along a step, scaled.
  real(wp) function work_on_side(self, residual, step) result(work)
    class(coupling_side_type), intent(in) :: self !! the side
    Vec, intent(in) :: residual !! of the side, scaled
    Vec, intent(in) :: step !! of the side, scaled
    PetscErrorCode :: ierr

    PetscCallA(VecSet(self%whole_residual, 0.0_wp, ierr))
    PetscCallA(VecSet(self%whole_step, 0.0_wp, ierr))
    PetscCallA(VecISCopy(self%whole_residual, self%part, SCATTER_FORWARD, residual, ierr))
    PetscCallA(VecISCopy(self%whole_step, self%part, SCATTER_FORWARD, step, ierr))
    work = self%bearing%virtual_work(self%whole_residual, self%whole_step)
  end function work_on_side

  !> Frees what PETSc holds.
  subroutine destroy_side(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    PetscErrorCode :: ierr

    PetscCallA(ISDestroy(self%part, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
    PetscCallA(VecDestroy(self%whole, ierr))
    PetscCallA(VecDestroy(self%whole_residual, ierr))
    PetscCallA(VecDestroy(self%whole_step, ierr))
    PetscCallA(MatDestroy(self%jacobian, ierr))
    if (.not. self%of_foil) return
    PetscCallA(ISDestroy(self%film_part, ierr))
    PetscCallA(VecDestroy(self%kept, ierr))
    PetscCallA(VecDestroy(self%moved, ierr))
    PetscCallA(VecDestroy(self%pressure, ierr))
    PetscCallA(MatDestroy(self%yielding, ierr))
    PetscCallA(MatDestroy(self%felt, ierr))
    if (allocated(self%number)) deallocate (self%number)
    if (self%multiplied) then
      PetscCallA(MatDestroy(self%stiffening, ierr))
    end if
  end subroutine destroy_side

  !> Cuts a bearing into its two sides.
  subroutine create_partitioned(bearing, settings, log, sides)
    type(bearing_system_type), target, intent(inout) :: bearing !! with a state
    type(newton_settings_type), intent(in) :: settings !! when Newton's method stops
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(partitioned_type), target, intent(inout) :: sides !! are created
    type(newton_settings_type) :: foil_settings
    PetscErrorCode :: ierr

    call bearing%linearise(bearing%state)
    call create_side(bearing, .false., sides%film)
    call create_side(bearing, .true., sides%foil)
    call create_newton(sides%film_newton, sides%film, 'film_', settings, log)
    foil_settings = settings
    foil_settings%maximum_iterations = foil_patience*settings%maximum_iterations
    call create_newton(sides%foil_newton, sides%foil, 'foil_', foil_settings, log)
    sides%log = log
    PetscCallA(VecDuplicate(sides%film%state, sides%film_before, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%kept, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%answer, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%change, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%kept_before, ierr))
    allocate (sides%asked(size(deflection(bearing))), source=0.0_wp)
    call create_anderson(sides%foil%state, size(sides%asked), sides%anderson)
    sides%created = .true.
  end subroutine create_partitioned

  !> Brings the bearing to a point by loops from its present state. On return the state is the
  !> answer, or the last film there was on the foil that it was solved with.
  subroutine follow_partitioned(bearing, newton, target, settings, sides, report)
    type(bearing_system_type), target, intent(inout) :: bearing !! the bearing, in its present state
    type(newton_type), intent(inout) :: newton !! of the coupled equations: only counts here
    type(operating_point_type), intent(in) :: target !! the operating point asked for
    type(path_settings_type), intent(in) :: settings !! limits
    type(partitioned_type), target, intent(inout) :: sides !! film and foil
    type(path_report_type), intent(out) :: report !! how it ended
    character(len=:), allocatable :: reason
    logical :: converged
    integer :: spent(5)

    spent = counts(sides)
    bearing%point = target
    call repeat_loops(bearing, sides, converged, reason)
    report%ending = path_lost(reason)
    if (converged) then
      report%ending = path_reached()
      if (bearing%smallest_gap() < settings%touch_down_gap) report%ending = path_thins()
    end if
    spent = counts(sides) - spent
    newton%iterations = newton%iterations + spent(2) + spent(4)
    newton%factorizations = newton%factorizations + spent(3) + spent(5)
    call sides%log%line('partitioned: '//text(spent(1))//' loops, film '//text(spent(2))//' Newton iterations with '// &
                        text(spent(3))//' factorizations, foil '//text(spent(4))//' with '//text(spent(5))// &
                        ': '//report%reason())
    report%reached = target
    report%fraction = merge(1.0_wp, 0.0_wp, report%converged())
    report%steps = 1
  end subroutine follow_partitioned

  !> What was spent since creation: loops, then iterations and factorizations of the film and the
  !> foil.
  pure function counts(sides) result(spent)
    type(partitioned_type), intent(in) :: sides
    integer :: spent(5)

    spent = [sides%loops, sides%film_newton%iterations, sides%film_newton%factorizations, &
             sides%foil_newton%iterations, sides%foil_newton%factorizations]
  end function counts

  !> Film, foil, acceleration, until neither changes.
  subroutine repeat_loops(bearing, sides, converged, reason)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(partitioned_type), target, intent(inout) :: sides
    logical, intent(out) :: converged
    character(len=:), allocatable, intent(out) :: reason

    type(newton_report_type) :: solved
    real(wp) :: size_of_change
    integer :: loop
    PetscErrorCode :: ierr

    call sides%film%take()
    call sides%foil%take()
    PetscCallA(VecCopy(sides%foil%state, sides%kept, ierr))
    PetscCallA(VecCopy(sides%foil%state, sides%answer, ierr))
    PetscCallA(VecCopy(sides%kept, sides%kept_before, ierr))
    PetscCallA(VecCopy(sides%film%state, sides%film_before, ierr))
    converged = .false.
    reason = 'film and foil still change after '//text(most_loops)//' loops'
    do loop = 1, most_loops
      sides%loops = sides%loops + 1
      call solve_film(sides, loop > 1, solved)
      if (.not. solved%converged) then
        reason = 'the film above the fixed foil in loop '//text(loop)//': '//solved%reason
        exit
      end if
      call solve_foil(bearing, sides, solved)
      if (.not. solved%converged) then
        reason = 'the foil under the fixed film in loop '//text(loop)//': '//solved%reason
        exit
      end if
      size_of_change = largest(sides%asked)/bearing%clearance
      call show_loop(bearing, sides, loop, size_of_change)
      converged = size_of_change <= sides%foil_newton%settings%step_tolerance
      if (converged) then
        reason = 'converged'
        return
      end if
      PetscCallA(VecCopy(sides%kept, sides%kept_before, ierr))
      PetscCallA(VecCopy(sides%film%state, sides%film_before, ierr))
      call choose_next(bearing, sides, loop == 1)
    end do
    call put_foil(sides, sides%kept_before)
    PetscCallA(VecCopy(sides%film_before, sides%film%state, ierr))
    call sides%film%give()
  end subroutine repeat_loops

  !> Film and shaft above the fixed foil; where they have no answer, the foil is displaced by less.
  subroutine solve_film(sides, may_shorten, solved)
    type(partitioned_type), target, intent(inout) :: sides
    logical, intent(in) :: may_shorten !! there is a film above the foil of one loop ago
    type(newton_report_type), intent(out) :: solved
    PetscErrorCode :: ierr
    integer :: halving

    do halving = 0, merge(halvings, 0, may_shorten)
      if (halving > 0) then
        call sides%log%detail('half the displacement of the foil: '//solved%reason)
        PetscCallA(VecAXPBY(sides%kept, 0.5_wp, 0.5_wp, sides%kept_before, ierr))
        PetscCallA(VecCopy(sides%film_before, sides%film%state, ierr))
      end if
      call put_foil(sides, sides%kept)
      call solve_newton(sides%film_newton, solved)
      if (solved%converged) exit
    end do
    if (solved%converged) call sides%film%give()
  end subroutine solve_film

  !> The foil under the fixed film, and its change from what the film was solved with.
  subroutine solve_foil(bearing, sides, solved)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(partitioned_type), target, intent(inout) :: sides
    type(newton_report_type), intent(out) :: solved
    real(wp) :: before(size(sides%asked))
    PetscErrorCode :: ierr

    before = deflection(bearing)
    call sides%foil%fix_film()
    call solve_newton(sides%foil_newton, solved)
    if (.not. solved%converged) return
    PetscCallA(VecCopy(sides%foil%state, sides%answer, ierr))
    PetscCallA(VecWAXPY(sides%change, -1.0_wp, sides%kept, sides%answer, ierr))
    call sides%foil%give()
    sides%asked = deflection(bearing) - before
  end subroutine solve_foil

  !> Makes a state of the foil that of the bearing.
  subroutine put_foil(sides, state)
    type(partitioned_type), intent(inout) :: sides
    Vec, intent(in) :: state
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(state, sides%foil%state, ierr))
    call sides%foil%give()
  end subroutine put_foil

  !> Deflection of the film nodes that this rank owns [m].
  function deflection(bearing)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), allocatable :: deflection(:)
    real(wp) :: unknown(bearing%local_size())
    integer :: i

    call bearing%get_unknowns(unknown)
    allocate (deflection(0))
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        deflection = [deflection, pack(pad%foil%deflection(unknown(pad%first + 1:pad%last)), pad%mesh%owned)]
      end associate
    end do
  end function deflection

  !> What the film is solved with next, not too far away.
  subroutine choose_next(bearing, sides, first)
    type(bearing_system_type), intent(in) :: bearing !! with the foil's answer
    type(partitioned_type), intent(inout) :: sides
    logical, intent(in) :: first !! of these loops
    real(wp) :: displacement(size(sides%asked)), stretch
    PetscErrorCode :: ierr

    call accelerate(sides%anderson, first, sides%kept, sides%change, sides%asked)
    displacement = sides%asked - deflection(bearing)
    call put_foil(sides, sides%kept)
    displacement = displacement + deflection(bearing)
    stretch = longest_displacement*bearing%clearance/max(largest(displacement), tiny(1.0_wp))
    if (stretch < 1.0_wp) then
      PetscCallA(VecAXPBY(sides%kept, 1.0_wp - stretch, stretch, sides%kept_before, ierr))
    end if
  end subroutine choose_next

  !> Largest size over all ranks.
  function largest(values)
    real(wp), intent(in) :: values(:) !! this rank's
    real(wp) :: largest, whole(1)

    whole = largest_over_ranks([maxval([0.0_wp, abs(values)])])
    largest = whole(1)
  end function largest

  !> A line of the table of loops.
  subroutine show_loop(bearing, sides, loop, change)
    type(bearing_system_type), intent(in) :: bearing
    type(partitioned_type), intent(in) :: sides
    integer, intent(in) :: loop
    real(wp), intent(in) :: change !! that the foil asks for, over the clearance [1]
    real(wp) :: position(2)

    position = bearing%eccentricity()/bearing%clearance
    call sides%log%detail('loop '//text(loop)//': change '//text(change, 3)//' C, e/C ('//text(position(1), 8)// &
                          ', '//text(position(2), 8)//')')
  end subroutine show_loop

  !> Forgets the factors of both sides; may be called without ever having been created.
  subroutine forget_partitioned(sides)
    type(partitioned_type), intent(inout) :: sides !! may be ones that were never created

    if (.not. sides%created) return
    call forget_factors(sides%film_newton)
    call forget_factors(sides%foil_newton)
  end subroutine forget_partitioned

  !> Frees what PETSc holds; may be called without ever having been created.
  subroutine destroy_partitioned(sides)
    type(partitioned_type), intent(inout) :: sides !! may be ones that were never created
    PetscErrorCode :: ierr

    if (.not. sides%created) return
    call destroy_newton(sides%film_newton)
    call destroy_newton(sides%foil_newton)
    call sides%film%destroy()
    call sides%foil%destroy()
    PetscCallA(VecDestroy(sides%film_before, ierr))
    PetscCallA(VecDestroy(sides%kept, ierr))
    PetscCallA(VecDestroy(sides%answer, ierr))
    PetscCallA(VecDestroy(sides%change, ierr))
    PetscCallA(VecDestroy(sides%kept_before, ierr))
    call destroy_anderson(sides%anderson)
    if (allocated(sides%asked)) deallocate (sides%asked)
    sides%created = .false.
  end subroutine destroy_partitioned
end module gfb_partitioned
