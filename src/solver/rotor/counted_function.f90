!> A function whose zeros are counted along a circle (`gfb_zero_count`): the determinant of a rotor,
!> or of a machine, with films and foils.
module gfb_counted_function
  use gfb_kinds, only: wp
  use gfb_zero_count, only: mode_count_type
  implicit none (type, external)
  private
  public :: begin_circle, count_missing

  !> The function.
  type, abstract, public :: counted_function_type
  contains
    procedure(evaluate), deferred :: evaluate
  end type counted_function_type

  abstract interface
    !> Logarithm of the function at a rate, up to multiples of 2 pi i.
    subroutine evaluate(self, rate, logarithm, found)
      import :: counted_function_type, wp
      implicit none (type, external)
      class(counted_function_type), intent(inout) :: self !! the function
      complex(wp), intent(in) :: rate !! lambda [1/s]
      complex(wp), intent(out) :: logarithm !! of scaled equations [1]
      logical, intent(out) :: found !! the matrices could be factorized
    end subroutine evaluate
  end interface

contains

  !> Visits the first places of a circle.
  subroutine begin_circle(function, count, found)
    class(counted_function_type), intent(inout) :: function !! whose zeros are counted
    type(mode_count_type), intent(inout) :: count !! along the circle
    logical, intent(out) :: found !! the matrices could be factorized
    complex(wp) :: logarithm
    real(wp) :: angle
    integer :: i

    do i = 0, count%steps
      angle = count%next()
      call function%evaluate(count%place(angle), logarithm, found)
      if (.not. found) return
      call count%tell(angle, logarithm)
    end do
  end subroutine begin_circle

  !> Counts the modes in a circle about a real rate that are not known.
  subroutine count_missing(function, count, missing, found)
    class(counted_function_type), intent(inout) :: function !! whose zeros are counted
    type(mode_count_type), intent(inout) :: count !! the circle, and the modes that are known
    integer, intent(out) :: missing !! each of a conjugate pair counts
    !> the matrices could be factorized, and the circle runs through no mode
    logical, intent(out) :: found
    complex(wp) :: logarithm
    real(wp) :: angle

    missing = 0
    do
      angle = count%next()
      if (angle < 0.0_wp) exit
      call function%evaluate(count%place(angle), logarithm, found)
      if (.not. found) return
      call count%tell(angle, logarithm)
    end do
    found = .not. count%failed
    if (found) missing = count%missing()
  end subroutine count_missing
end module gfb_counted_function
