!> Equilibria of a machine at speeds that were passed, and where the next one may be.
module gfb_machine_path
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  integer, parameter :: most_kept = 3 !! equilibria, through which a parabola goes
  !> weights of the equilibria whose sum of moduli is more mean that the place is too far away [1]
  real(wp), parameter :: most_weight = 8.0_wp
  real(wp), parameter :: same = 1.0e-12_wp !! speeds that near are one [1]

  !> The last equilibria.
  type, public :: machine_path_type
    real(wp), allocatable :: speed(:)     !! the last one first [rad/s]
    real(wp), allocatable :: motion(:, :) !! (motion of a journal, equilibrium) [m], [rad]
  contains
    procedure :: add, at
  end type machine_path_type

contains

  !> Takes an equilibrium.
  pure subroutine add(self, speed, motion)
    class(machine_path_type), intent(inout) :: self !! gets it
    real(wp), intent(in) :: speed     !! [rad/s]
    real(wp), intent(in) :: motion(:) !! of all journals [m], [rad]
    integer, allocatable :: kept(:)
    integer :: i

    if (.not. allocated(self%speed)) allocate (self%speed(0), self%motion(size(motion), 0))
    kept = pack([(i, i=1, size(self%speed))], abs(self%speed - speed) > same*abs(speed))
    kept = kept(:min(size(kept), most_kept - 1))
    self%speed = [speed, self%speed(kept)]
    self%motion = reshape([motion, self%motion(:, kept)], [size(motion), 1 + size(kept)])
  end subroutine add

  !> Where journals may be at a speed: on the parabola through the last three equilibria, or the
  !> line through the last two; where that is too far away they are where they were last.
  pure function at(self, speed) result(motion)
    class(machine_path_type), intent(in) :: self !! with an equilibrium
    real(wp), intent(in) :: speed !! [rad/s]
    real(wp) :: motion(size(self%motion, 1)) !! [m], [rad]
    real(wp), allocatable :: weight(:)
    integer :: n

    do n = size(self%speed), 1, -1
      weight = weights(self%speed(:n), speed)
      if (sum(abs(weight)) <= most_weight) exit
    end do
    motion = matmul(self%motion(:, :size(weight)), weight)
  end function at

  !> Lagrange's weights of places.
  pure function weights(place, wanted) result(weight)
    real(wp), intent(in) :: place(:) !! all different
    real(wp), intent(in) :: wanted
    real(wp) :: weight(size(place)) !! [1]
    integer :: i, k

    weight = 1.0_wp
    do i = 1, size(place)
      do k = 1, size(place)
        if (k /= i) weight(i) = weight(i)*(wanted - place(k))/(place(i) - place(k))
      end do
    end do
  end function weights
end module gfb_machine_path
