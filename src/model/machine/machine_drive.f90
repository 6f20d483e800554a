!> What drives a machine over time: its speed, weight and loads, unbalances along the shaft, a push,
!> and a base that moves.
module gfb_machine_drive
  use gfb_kinds, only: wp
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_shaft, only: motions, journal_places, node_at
  use gfb_machine, only: machine_type
  use gfb_moving_sleeves, only: moving_sleeve_type, forces_on_motions, relative_motions
  use gfb_operation_case, only: angular_speed, operation_case_type
  use gfb_motion_cases, only: transient_case_type, unbalance_case_type, duration_of
  implicit none (type, external)
  private
  public :: machine_drive

  !> Something that acts on a node of the shaft.
  type :: push_type
    type(shaft_drive_type) :: drive
    integer :: place(motions) = 0       !! of the node's motions among all
    real(wp) :: sign(motions) = 0.0_wp  !! of these [1]
  end type push_type

  !> The drive.
  type, public :: machine_drive_type
    type(shaft_drive_type) :: clock          !! speed, and when something changes
    type(push_type), allocatable :: push(:)  !! unbalances, and a push that acts at one place
    real(wp), allocatable, private :: force(:)     !! steady [N], [N m]
    type(shaft_drive_type), private :: base        !! that moves, of all mass, over it
    type(shaft_drive_type), private :: spread      !! a push on all of the shaft, over its mass
    type(moving_sleeve_type), allocatable, private :: sleeve(:) !! those that have supports
    real(wp), allocatable, private :: mass(:, :)   !! (motion, x and y) of all [kg], [kg m]
    real(wp), allocatable, private :: weight(:, :) !! the same of the shaft
  contains
    procedure :: force_at, turn_with, first_unbalance
  end type machine_drive_type

contains

  !> The drive of a machine; all of it begins at 0.
  pure function machine_drive(machine, unbalance, transient, operation) result(drive)
    type(machine_type), intent(in) :: machine
    type(unbalance_case_type), intent(in) :: unbalance !! what `&unbalance` says
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(operation_case_type), intent(in) :: operation !! with the machine's speed
    type(machine_drive_type) :: drive
    real(wp), allocatable :: even(:, :)
    integer :: i, n

    n = size(machine%shaft%weight)
    drive%force = machine%force
    drive%sleeve = machine%sleeve
    allocate (drive%weight(size(drive%force), 2), source=0.0_wp)
    drive%weight(:n, 1) = machine%shaft%weight
    drive%weight(n + 1:2*n, 2) = machine%shaft%weight
    even = 0.0_wp*drive%weight ! motions of all as one
    even(1:n:2, 1) = 1.0_wp
    even(n + 1:2*n:2, 2) = 1.0_wp
    do i = 1, size(drive%sleeve)
      even(drive%sleeve(i)%place(1), 1) = 1.0_wp
      even(drive%sleeve(i)%place(2), 2) = 1.0_wp
    end do
    drive%mass = matmul(machine%equations%mass, relative_motions(drive%sleeve, even))
    associate (clock => drive%clock)
      clock%speed = angular_speed(operation%speed_rpm)
      clock%ramp = duration_of(transient, operation)
      if (transient%ramp_time > 0.0_wp) clock%ramp = transient%ramp_time
      clock%acceleration = (angular_speed(transient%final_speed_rpm) - clock%speed)/clock%ramp
      clock%pulse_start = transient%pulse_start
      clock%pulse_length = transient%pulse_length
      clock%base_time = transient%base_time
      allocate (clock%base_acceleration(2, size(clock%base_time)), source=0.0_wp)
      if (size(transient%base_acceleration_x) > 0) clock%base_acceleration(1, :) = &
        transient%base_acceleration_x
      if (size(transient%base_acceleration_y) > 0) clock%base_acceleration(2, :) = &
        transient%base_acceleration_y
    end associate
    drive%base = drive%clock
    drive%base%mass = 1.0_wp
    drive%spread = drive%clock
    deallocate (drive%spread%base_time, drive%spread%base_acceleration)
    allocate (drive%push(0))
    do i = 1, size(unbalance%position)
      call add_push(machine, unbalance%position(i), drive)
      associate (push => drive%push(size(drive%push))%drive)
        push%unbalance = unbalance%value(i)
        push%unbalance_angle = unbalance%angles(i)
      end associate
    end do
    if (transient%pulse_is_placed) then
      call add_push(machine, transient%pulse_position, drive)
      associate (push => drive%push(size(drive%push))%drive)
        push%pulse = transient%pulse
        push%couple_pulse = transient%couple_pulse
      end associate
    else ! through the centre of mass, spread as the weight is
      drive%spread%pulse = transient%pulse/sum(machine%shaft%weight(1::2))
    end if
  end function machine_drive

  !> Room for what acts on the node next to a place.
  pure subroutine add_push(machine, position, drive)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: position !! z [m]
    type(machine_drive_type), intent(inout) :: drive
    type(push_type) :: push

    push%drive = drive%clock
    deallocate (push%drive%base_time, push%drive%base_acceleration)
    call journal_places(machine%shaft, node_at(machine%shaft, position), push%place, push%sign)
    drive%push = [drive%push, push]
  end subroutine add_push

  !> Another speed, and unbalances in proportion to the first one.
  pure subroutine turn_with(self, speed, unbalance)
    class(machine_drive_type), intent(inout) :: self !! the drive
    real(wp), intent(in) :: speed     !! [rad/s]
    real(wp), intent(in) :: unbalance !! the first one [kg m]

    self%clock%speed = speed
    self%base%speed = speed
    self%spread%speed = speed
    self%push%drive%speed = speed
    if (.not. self%first_unbalance() > 0.0_wp) return
    associate (share => unbalance/self%first_unbalance())
      self%push%drive%unbalance = share*self%push%drive%unbalance
    end associate
  end subroutine turn_with

  !> The first unbalance of the list; 0 where there is none.
  pure real(wp) function first_unbalance(self) result(first)
    class(machine_drive_type), intent(in) :: self !! the drive

    first = 0.0_wp
    if (size(self%push) > 0) first = self%push(1)%drive%unbalance
  end function first_unbalance

  !> All outer forces on the motions of the machine: weight and loads, pushes at their places or on
  !> all of the shaft, and minus mass times the acceleration of the base.
  pure function force_at(self, time) result(force)
    class(machine_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: force(size(self%force)) !! [N], [N m]
    integer :: i

    force = matmul(self%weight, self%spread%load_at(time))
    do i = 1, size(self%push)
      associate (push => self%push(i))
        force(push%place) = force(push%place) + &
                            push%sign*[push%drive%load_at(time), push%drive%torque_at(time)]
      end associate
    end do
    force = self%force + matmul(self%mass, self%base%load_at(time)) + &
            forces_on_motions(self%sleeve, force)
  end function force_at
end module gfb_machine_drive
