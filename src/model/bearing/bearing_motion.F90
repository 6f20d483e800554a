#include "gfb_petsc.h"
!> A bearing in motion, through its list of blocks. Over a step of time: the step is prepared, has an end, is saved, is recalled. In
!> a small vibration: blocks add the parts of its equations that depend on the frequency.
!>
!> Blocks that move foils alone: they have no unknowns, but forces, or a memory, over a step of time, and do nothing until that
!> is begun. Momentum and losses of meshed foils are forces in scaled vectors; dampers and Maxwell arms of a foundation are drag and
!> pull of its springs, which the foil's own equations have. In a vibration both are parts of its equations by the same laws.
!>
!> Two things that change in time are no blocks. The gas that films store is a part of each film's own equations
!> (`past` of `gfb_gas_film`), and the shaft's inertia a part of its operating point: both are the march's (`gfb_time_march`). In a
!> vibration the gas is a part like those of blocks.
module gfb_bearing_motion
  use petscmat
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_natural_order, only: natural_order_type, visit_vector
  use gfb_text, only: text
  use gfb_spring_history, only: begin_springs, damp_springs, follow_springs, recall_springs
  use gfb_bearing, only: bearing_type, bearing_block_type
  use gfb_film_rates, only: fill_film, fill_springs, squeeze, squeeze_by_gap, flow_by_gap
  use gfb_vibration_law, only: by_rate, by_springs, by_local_springs, by_rate_of_local_springs
  use gfb_vibration_equations, only: vibration_equations_type, add_part
  implicit none (type)
  private
  public :: momentum_block, losses_block, dampers_block, begin_dampers
  public :: prepare_step, end_step, recall_step, visit_motion, end_motion, add_vibrations

contains

  !> From now on the equations of all blocks are those of a step of time.
  subroutine prepare_step(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: weight(0:2) !! a_0, a_1, a_2 of `gfb_backward_difference` [1/s]
    Vec, intent(in) :: now, before !! scaled states at its beginning and one step earlier
    integer :: k

    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%prepare_step)) call bearing%block(k)%prepare_step(bearing, weight, now, before)
    end do
  end subroutine prepare_step

  !> The step has led to the present state, which becomes the newest that blocks remember.
  subroutine end_step(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: weight(0:2) !! as in `prepare_step` [1/s]
    Vec, intent(in) :: now, before !! the same
    integer :: k

    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%end_step)) call bearing%block(k)%end_step(bearing, weight, now, before)
    end do
  end subroutine end_step

  !> Pads are put where a step has left them, of what was saved of it.
  subroutine recall_step(bearing, step, unknown)
    class(bearing_type), intent(inout) :: bearing !! pads and shaft
    integer, intent(in) :: step !! 1: the newest, 2: the one before
    real(wp), intent(in) :: unknown(:) !! local ones then, in SI
    integer :: k

    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%recall_step)) call bearing%block(k)%recall_step(bearing, step, unknown)
    end do
  end subroutine recall_step

  !> Saves or restores what blocks remember of a motion. All ranks ask.
  subroutine visit_motion(archive, bearing, order)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    class(bearing_type), intent(inout) :: bearing !! at a state of the motion
    type(natural_order_type), intent(in) :: order !! of its state
    integer :: k

    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%visit)) call bearing%block(k)%visit(archive, bearing, order)
    end do
  end subroutine visit_motion

  !> The motion is over; may be called twice.
  subroutine end_motion(bearing)
    class(bearing_type), intent(inout) :: bearing !! pads and shaft
    integer :: k

    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%end_motion)) call bearing%block(k)%end_motion(bearing)
    end do
  end subroutine end_motion

  !> The parts of the equations of small vibrations: of the gas that films store, and of all blocks.
  subroutine add_vibrations(bearing, equations)
    class(bearing_type), intent(in) :: bearing !! at its answer
    type(vibration_equations_type), intent(inout) :: equations !! with the steady ones, and what foils do under vibration
    Mat :: matrix
    integer :: k

    call add_part(by_rate, equations, matrix)
    call fill_film(bearing, squeeze, matrix)
    do k = 1, size(bearing%block)
      if (associated(bearing%block(k)%add_vibration)) call bearing%block(k)%add_vibration(bearing, equations)
    end do
  end subroutine add_vibrations

  !> The inertia of meshed foils.
  pure subroutine momentum_block(block)
    type(bearing_block_type), intent(out) :: block !! of any bearing

    block%name = 'momentum'
    block%add_force => momentum_force
    block%add_stiffness => momentum_stiffness
    block%prepare_step => prepare_momentum
    block%end_step => carry_momentum
    block%visit => visit_momentum
    block%end_motion => end_momentum
  end subroutine momentum_block

  !> Inertia at a state.
  subroutine momentum_force(bearing, state, residual)
    class(bearing_type), intent(inout) :: bearing
    Vec, intent(in) :: state, residual
    call bearing%momentum%add_force(state, residual)
  end subroutine momentum_force

  !> Its derivative.
  subroutine momentum_stiffness(bearing, matrix)
    class(bearing_type), intent(inout) :: bearing
    Mat, intent(in) :: matrix
    call bearing%momentum%add_stiffness(matrix)
  end subroutine momentum_stiffness

  !> Where foils would be without any force. Modes inside condensed pieces lose as the foils do.
  subroutine prepare_momentum(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    if (bearing%momentum%present) call bearing%momentum%prepare(weight, bearing%losses%time, now, before)
  end subroutine prepare_momentum

  !> Rates of the state that the step led to.
  subroutine carry_momentum(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    if (bearing%momentum%present) call bearing%momentum%carry(weight, bearing%state, now, before)
  end subroutine carry_momentum

  !> Rates, and modes inside condensed pieces.
  subroutine visit_momentum(archive, bearing, order)
    type(archive_type), intent(inout) :: archive
    class(bearing_type), intent(inout) :: bearing
    type(natural_order_type), intent(in) :: order

    if (.not. bearing%momentum%present) return
    call visit_vector(archive, 'rate', order, bearing%momentum%rate(1))
    call visit_vector(archive, 'rate_before', order, bearing%momentum%rate(2))
    call bearing%momentum%inner%visit(archive)
  end subroutine visit_momentum

  !> Foils without mass.
  subroutine end_momentum(bearing)
    class(bearing_type), intent(inout) :: bearing
    call bearing%momentum%destroy()
  end subroutine end_momentum

  !> What meshed foils lose. Of the past it needs states alone, which the march keeps.
  pure subroutine losses_block(block)
    type(bearing_block_type), intent(out) :: block !! of any bearing

    block%name = 'losses'
    block%add_force => losses_force
    block%add_stiffness => losses_stiffness
    block%prepare_step => prepare_losses
    block%end_motion => end_losses
    block%add_vibration => losses_vibration
  end subroutine losses_block

  !> What is lost at a state.
  subroutine losses_force(bearing, state, residual)
    class(bearing_type), intent(inout) :: bearing
    Vec, intent(in) :: state, residual
    call bearing%losses%add_force(state, residual)
  end subroutine losses_force

  !> Its derivative.
  subroutine losses_stiffness(bearing, matrix)
    class(bearing_type), intent(inout) :: bearing
    Mat, intent(in) :: matrix
    call bearing%losses%add_stiffness(matrix)
  end subroutine losses_stiffness

  !> Where foils would have no rates.
  subroutine prepare_losses(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    call bearing%losses%prepare(weight, now, before)
  end subroutine prepare_losses

  !> The elastic forces that lose. Each unknown of a mesh relaxes by itself, at a rate next to that of all others.
  subroutine losses_vibration(bearing, equations)
    class(bearing_type), intent(in) :: bearing
    type(vibration_equations_type), intent(inout) :: equations
    Mat :: matrix

    if (.not. (equations%vibration%dissipates() .and. bearing%is_meshed())) return
    call add_part(by_springs, equations, matrix, crowds=.true.)
    call fill_springs(bearing, matrix)
  end subroutine losses_vibration

  !> Foils without losses.
  subroutine end_losses(bearing)
    class(bearing_type), intent(inout) :: bearing
    call bearing%losses%destroy()
  end subroutine end_losses

  !> Dampers and Maxwell arms of a foundation: its springs have their forces, the block what they remember.
  pure subroutine dampers_block(block)
    type(bearing_block_type), intent(out) :: block !! of any bearing

    block%name = 'dampers'
    block%prepare_step => prepare_dampers
    block%end_step => follow_dampers
    block%recall_step => recall_dampers
    block%visit => visit_dampers
    block%end_motion => end_dampers
    block%add_vibration => dampers_vibration
  end subroutine dampers_block

  !> Dampers come beside the springs of all pads, which rest.
  subroutine begin_dampers(damping, arm, unknown, bearing)
    real(wp), intent(in) :: damping !! viscous [N s/m3]
    type(maxwell_arm_type), intent(in) :: arm !! beside the springs, or none
    real(wp), intent(in) :: unknown(:) !! of the bearing [SI]
    class(bearing_type), intent(inout) :: bearing !! on a foundation
    integer :: i

    associate (dampers => bearing%dampers)
      dampers%damping = damping
      dampers%arm = arm
      if (allocated(dampers%springs)) deallocate (dampers%springs)
      allocate (dampers%springs(size(bearing%pad)))
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i))
          call begin_springs(unknown(pad%first + 1:pad%last), pad%foil, dampers%springs(i))
        end associate
      end do
    end associate
  end subroutine begin_dampers

  !> Drag and pull of a step.
  subroutine prepare_dampers(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    integer :: i

    associate (dampers => bearing%dampers)
      do i = 1, dampers%pads()
        call damp_springs(dampers%damping, dampers%arm, weight, bearing%pad(i)%foil, dampers%springs(i))
      end do
    end associate
  end subroutine prepare_dampers

  !> Deflections and ways of dashpots where the step led.
  subroutine follow_dampers(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    real(wp), allocatable :: unknown(:)
    integer :: i

    if (bearing%dampers%pads() == 0) return
    allocate (unknown(bearing%local_size()))
    call bearing%get_unknowns(unknown)
    do i = 1, bearing%dampers%pads()
      associate (pad => bearing%pad(i))
        call follow_springs(bearing%dampers%arm, unknown(pad%first + 1:pad%last), pad%foil, bearing%dampers%springs(i))
      end associate
    end do
  end subroutine follow_dampers

  !> Springs where a step has left them.
  subroutine recall_dampers(bearing, step, unknown)
    class(bearing_type), intent(inout) :: bearing
    integer, intent(in) :: step
    real(wp), intent(in) :: unknown(:)
    integer :: i

    do i = 1, bearing%dampers%pads()
      associate (pad => bearing%pad(i))
        call recall_springs(step, unknown(pad%first + 1:pad%last), pad%foil, bearing%dampers%springs(i))
      end associate
    end do
  end subroutine recall_dampers

  !> What springs remember, now and one step ago. Deflections of stations are unknowns; those of local springs follow from the
  !> pressures and the dampers' pull.
  subroutine visit_dampers(archive, bearing, order)
    type(archive_type), intent(inout) :: archive
    class(bearing_type), intent(inout) :: bearing
    type(natural_order_type), intent(in) :: order
    real(wp) :: value(bearing%local_size(), 2)
    integer :: i

    if (bearing%dampers%pads() == 0) return
    associate (springs => bearing%dampers%springs)
      if (springs(1)%local) then
        value = 0.0_wp
        do i = 1, size(springs)
          call archive%visit('spring_drag_'//text(i), springs(i)%drag)
          value(bearing%pad(i)%first + 1:bearing%pad(i)%last, :) = springs(i)%pull
        end do
        call visit_local(archive, 'spring_pull', order, bearing, value)
        do i = 1, size(springs)
          springs(i)%pull = value(bearing%pad(i)%first + 1:bearing%pad(i)%last, :)
          if (.not. archive%saves) springs(i)%recalled = .true.
        end do
      end if
      if (.not. bearing%dampers%arm%is_present()) return
      value = 0.0_wp
      do i = 1, size(springs)
        value(bearing%pad(i)%first + 1:bearing%pad(i)%last, :) = springs(i)%relaxed
      end do
      call visit_local(archive, 'arm', order, bearing, value)
      do i = 1, size(springs)
        springs(i)%relaxed = value(bearing%pad(i)%first + 1:bearing%pad(i)%last, :)
      end do
    end associate
  end subroutine visit_dampers

  !> A value at every local unknown, now and one step ago, in two fields.
  subroutine visit_local(archive, name, order, bearing, value)
    type(archive_type), intent(inout) :: archive
    character(len=*), intent(in) :: name
    type(natural_order_type), intent(in) :: order
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(inout) :: value(:, :)
    character(len=*), parameter :: ending(2) = [character(len=7) :: '', '_before']
    Vec :: vector
    PetscErrorCode :: ierr
    integer :: step

    PetscCallA(VecDuplicate(bearing%state, vector, ierr))
    do step = 1, 2
      call bearing%exchange%put(value(:, step), vector)
      call visit_vector(archive, name//trim(ending(step)), order, vector)
      if (.not. archive%saves) call bearing%exchange%get(vector, value(:, step))
    end do
    PetscCallA(VecDestroy(vector, ierr))
  end subroutine visit_local

  !> The springs of a foundation: those of stations have unknowns, local ones change what films store and let flow by their gap.
  subroutine dampers_vibration(bearing, equations)
    class(bearing_type), intent(in) :: bearing
    type(vibration_equations_type), intent(inout) :: equations
    Mat :: matrix

    if (.not. equations%vibration%dissipates() .or. bearing%is_meshed()) return
    if (bearing%pad(1)%foil%has_local_springs()) then
      call add_part(by_local_springs, equations, matrix)
      call fill_film(bearing, flow_by_gap, matrix)
      call add_part(by_rate_of_local_springs, equations, matrix)
      call fill_film(bearing, squeeze_by_gap, matrix)
    else
      call add_part(by_springs, equations, matrix)
      call fill_springs(bearing, matrix)
    end if
  end subroutine dampers_vibration

  !> Springs without a memory; their last drag and pull stay the foil's.
  subroutine end_dampers(bearing)
    class(bearing_type), intent(inout) :: bearing
    if (allocated(bearing%dampers%springs)) deallocate (bearing%dampers%springs)
  end subroutine end_dampers
end module gfb_bearing_motion
