!> Numbers, rotations and products of vectors for the tests.
module sample_vectors
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: numbers, rotation, cross

contains

  !> Numbers between -1 and 1 that are the same in every run.
  pure function numbers(count, seed) result(values)
    integer, intent(in) :: count, seed
    real(wp) :: values(count)
    integer :: i

    do i = 1, count
      values(i) = 2.0_wp*modulo(43758.5453_wp*sin(12.9898_wp*i + 78.233_wp*seed), 1.0_wp) - 1.0_wp
    end do
  end function numbers

  !> Matrix of the rotation by a vector, by Rodrigues' formula.
  pure function rotation(vector) result(matrix)
    real(wp), intent(in) :: vector(3) !! axis times angle [rad]
    real(wp) :: matrix(3, 3)
    real(wp) :: angle, axis(3), unit(3)
    integer :: i

    angle = norm2(vector)
    axis = vector/angle
    do i = 1, 3
      unit = 0.0_wp
      unit(i) = 1.0_wp
      matrix(:, i) = cos(angle)*unit + sin(angle)*cross(axis, unit) &
        + (1.0_wp - cos(angle))*axis(i)*axis
    end do
  end function rotation

  !> Vector product.
  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)

    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross
end module sample_vectors
