!> Numbers that carry their derivatives by a few variables: a formula written once gives both.
module gfb_dual_number
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: variable, dual_of, operator(+), operator(-), operator(*), operator(/), sqrt

  !> Variables of a point of a film, see `gfb_heated_film`.
  integer, parameter, public :: variables = 14

  !> A number and its derivatives by the variables.
  type, public :: dual_type
    real(wp) :: v = 0.0_wp            !! its value
    real(wp) :: d(variables) = 0.0_wp !! derivatives
  end type dual_type

  interface operator(+)
    module procedure plus, plus_real, real_plus
  end interface
  interface operator(-)
    module procedure minus, minus_real, real_minus, negative
  end interface
  interface operator(*)
    module procedure times, times_real, real_times
  end interface
  interface operator(/)
    module procedure over, over_real, real_over
  end interface
  interface sqrt
    module procedure square_root
  end interface

contains

  !> A variable itself.
  elemental type(dual_type) function variable(value, number) result(c)
    real(wp), intent(in) :: value !! of it
    integer, intent(in) :: number !! which it is
    c%v = value
    c%d(number) = 1.0_wp
  end function variable

  !> A function of one number whose derivative is known.
  elemental type(dual_type) function dual_of(value, slope, a) result(c)
    real(wp), intent(in) :: value     !! of the function
    real(wp), intent(in) :: slope     !! by the number
    type(dual_type), intent(in) :: a  !! the number
    c = dual_type(value, slope*a%d)
  end function dual_of

  elemental type(dual_type) function plus(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c = dual_type(a%v + b%v, a%d + b%d)
  end function plus

  elemental type(dual_type) function plus_real(a, b) result(c)
    type(dual_type), intent(in) :: a
    real(wp), intent(in) :: b
    c = dual_type(a%v + b, a%d)
  end function plus_real

  elemental type(dual_type) function real_plus(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c = dual_type(a + b%v, b%d)
  end function real_plus

  elemental type(dual_type) function minus(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c = dual_type(a%v - b%v, a%d - b%d)
  end function minus

  elemental type(dual_type) function minus_real(a, b) result(c)
    type(dual_type), intent(in) :: a
    real(wp), intent(in) :: b
    c = dual_type(a%v - b, a%d)
  end function minus_real

  elemental type(dual_type) function real_minus(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c = dual_type(a - b%v, -b%d)
  end function real_minus

  elemental type(dual_type) function negative(a) result(c)
    type(dual_type), intent(in) :: a
    c = dual_type(-a%v, -a%d)
  end function negative

  elemental type(dual_type) function times(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c = dual_type(a%v*b%v, a%v*b%d + b%v*a%d)
  end function times

  elemental type(dual_type) function times_real(a, b) result(c)
    type(dual_type), intent(in) :: a
    real(wp), intent(in) :: b
    c = dual_type(a%v*b, b*a%d)
  end function times_real

  elemental type(dual_type) function real_times(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c = dual_type(a*b%v, a*b%d)
  end function real_times

  elemental type(dual_type) function over(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c%v = a%v/b%v
    c%d = (a%d - c%v*b%d)/b%v
  end function over

  elemental type(dual_type) function over_real(a, b) result(c)
    type(dual_type), intent(in) :: a
    real(wp), intent(in) :: b
    c = dual_type(a%v/b, a%d/b)
  end function over_real

  elemental type(dual_type) function real_over(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c%v = a/b%v
    c%d = -(c%v/b%v)*b%d
  end function real_over

  elemental type(dual_type) function square_root(a) result(c)
    type(dual_type), intent(in) :: a
    c%v = sqrt(a%v)
    c%d = a%d/(2.0_wp*c%v)
  end function square_root
end module gfb_dual_number
