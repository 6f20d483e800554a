!> The equations of a shaft in both planes, and of what moves with it.
!>
!> With all motions q, those of the plane of x first, then those of the plane of y,
!>
!> $$ M \ddot q + (\Omega G + C) \dot q + (K + \Omega R) q = f, $$
!>
!> with the gyroscopic G, skew, and what the damping of a turning shaft's material makes of its
!> stiffness, R, skew too [Friswell2010] ch. 5 and 7.
module gfb_shaft_equations
  use gfb_kinds, only: wp
  use gfb_shaft, only: shaft_type
  implicit none (type, external)
  private
  public :: shaft_equations

  !> Matrices of all motions, (motion, motion) [SI].
  type, public :: shaft_equations_type
    real(wp), allocatable :: mass(:, :)        !! M
    real(wp), allocatable :: gyroscopic(:, :)  !! G, over the speed
    real(wp), allocatable :: damping(:, :)     !! C
    real(wp), allocatable :: stiffness(:, :)   !! K
    real(wp), allocatable :: circulation(:, :) !! R, over the speed
  contains
    procedure :: dynamic_stiffness, reduced, add_motions
  end type shaft_equations_type

contains

  !> The equations of a shaft that nothing holds.
  pure function shaft_equations(shaft) result(equations)
    type(shaft_type), intent(in) :: shaft
    type(shaft_equations_type) :: equations
    integer :: n

    n = 2*size(shaft%z)
    allocate (equations%mass(2*n, 2*n), equations%gyroscopic(2*n, 2*n), source=0.0_wp)
    equations%mass(:n, :n) = shaft%mass
    equations%mass(n + 1:, n + 1:) = shaft%mass
    equations%gyroscopic(:n, n + 1:) = shaft%polar
    equations%gyroscopic(n + 1:, :n) = -shaft%polar
    allocate (equations%stiffness(2*n, 2*n), equations%circulation(2*n, 2*n), source=0.0_wp)
    equations%stiffness(:n, :n) = shaft%stiffness
    equations%stiffness(n + 1:, n + 1:) = shaft%stiffness
    equations%circulation(:n, n + 1:) = shaft%material_damping*shaft%stiffness
    equations%circulation(n + 1:, :n) = -shaft%material_damping*shaft%stiffness
    equations%damping = shaft%material_damping*equations%stiffness
  end function shaft_equations

  !> What motions \( q e^{\lambda t} \) need of forces,
  !> \( \lambda^2 M + \lambda (\Omega G + C) + K + \Omega R \).
  pure function dynamic_stiffness(self, rate, speed) result(matrix)
    class(shaft_equations_type), intent(in) :: self !! the equations
    complex(wp), intent(in) :: rate !! lambda; 0 at rest [1/s]
    real(wp), intent(in) :: speed   !! Omega [rad/s]
    complex(wp), allocatable :: matrix(:, :)

    matrix = speed*(rate*self%gyroscopic + self%circulation) + &
             (rate**2*self%mass + rate*self%damping + self%stiffness)
  end function dynamic_stiffness

  !> Puts further motions behind all others, each alone with its mass, damping and stiffness.
  pure subroutine add_motions(self, mass, damping, stiffness)
    class(shaft_equations_type), intent(inout) :: self !! the equations
    real(wp), intent(in) :: mass(:)      !! one each [kg]
    real(wp), intent(in) :: damping(:)   !! [N s/m]
    real(wp), intent(in) :: stiffness(:) !! [N/m]

    call extend(self%mass, mass)
    call extend(self%gyroscopic, 0.0_wp*mass)
    call extend(self%damping, damping)
    call extend(self%stiffness, stiffness)
    call extend(self%circulation, 0.0_wp*mass)
  end subroutine add_motions

  !> A matrix with more rows and columns, which are a diagonal.
  pure subroutine extend(matrix, diagonal)
    real(wp), allocatable, intent(inout) :: matrix(:, :)
    real(wp), intent(in) :: diagonal(:)
    real(wp), allocatable :: larger(:, :)
    integer :: i, n

    n = size(matrix, 1)
    allocate (larger(n + size(diagonal), n + size(diagonal)), source=0.0_wp)
    larger(:n, :n) = matrix
    do i = 1, size(diagonal)
      larger(n + i, n + i) = diagonal(i)
    end do
    call move_alloc(larger, matrix)
  end subroutine extend

  !> The same equations in few motions, or in others, \( q = V y \).
  pure function reduced(self, basis) result(small)
    class(shaft_equations_type), intent(in) :: self !! the equations
    real(wp), intent(in) :: basis(:, :) !! V (motion, new motion)
    type(shaft_equations_type) :: small

    small%mass = project(self%mass)
    small%gyroscopic = project(self%gyroscopic)
    small%damping = project(self%damping)
    small%stiffness = project(self%stiffness)
    small%circulation = project(self%circulation)

  contains

    !> A matrix in few motions.
    pure function project(matrix) result(few)
      real(wp), intent(in) :: matrix(:, :)
      real(wp), allocatable :: few(:, :)
      few = matmul(transpose(basis), matmul(matrix, basis))
    end function project
  end function reduced
end module gfb_shaft_equations
