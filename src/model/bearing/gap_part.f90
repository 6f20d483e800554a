!> Parts of a film's rigid gap as the film holds them: what each takes off at nodes and Gauss
!> points, and on what that depends.
!>
!> $$ h = h_f + \Bigl(C - \sum_p I_p\Bigr) + b \cdot \Bigl(q + \sum_p e_p\Bigr)
!>        - \sum_p (h_p + g_p \Omega^2), \quad
!>    \frac{\partial h}{\partial q} = b, \quad \frac{dh}{dt} = -2 \Omega \dot\Omega \sum_p g_p $$
!>
!> with the foil's deflection \( h_f \) and the motions b of the film's surface. Inside an element,
!> springs of its own add \( (c_p - c) (p - p_a) \) to the deflection of its nodes. Narrow grooves
!> take nothing off: h is the gap of their ridges, and `gfb_groove_film` has what they do to the
!> film.
module gfb_gap_part
  use gfb_kinds, only: wp
  use gfb_groove_film, only: groove_type
  implicit none (type, external)
  private
  public :: put_part, level_of, shift_of

  !> A part. What is not given takes off nothing.
  type, public :: gap_part_type
    character(len=16) :: name = ''   !! its own among those of a film
    real(wp) :: level = 0.0_wp       !! I, off the gap all around [m]
    real(wp) :: shift(2) = 0.0_wp    !! e of the pad's centre, adds to the eccentricity [m]
    real(wp) :: by_speed = 0.0_wp    !! g, off the gap by the speed squared [m s2]
    real(wp), allocatable :: height(:)      !! off the gap at the nodes [m]
    real(wp), allocatable :: excess(:, :)   !! (points, elements) of it over the nodes' [m]
    real(wp), allocatable :: softness(:, :) !! (nodes, elements) compliance over the nodes' [m/Pa]
    type(groove_type), allocatable :: groove(:) !! of the elements: the gap is that of their ridges
  end type gap_part_type

contains

  !> Puts a part in the place of the one of its name, or behind all others.
  pure subroutine put_part(part, list)
    type(gap_part_type), intent(in) :: part !! with a name
    type(gap_part_type), allocatable, intent(inout) :: list(:) !! of a film
    type(gap_part_type), allocatable :: longer(:)
    integer :: i

    do i = 1, size(list)
      if (list(i)%name /= part%name) cycle
      list(i) = part
      return
    end do
    allocate (longer(size(list) + 1))
    longer(:size(list)) = list
    longer(size(longer)) = part
    call move_alloc(longer, list)
  end subroutine put_part

  !> What is left of a clearance all around [m].
  pure real(wp) function level_of(list, clearance) result(level)
    type(gap_part_type), intent(in) :: list(:) !! parts of a film
    real(wp), intent(in) :: clearance !! C [m]
    integer :: i

    level = clearance
    do i = 1, size(list)
      level = level - list(i)%level
    end do
  end function level_of

  !> An eccentricity with the shifts of the pad's centre [m].
  pure function shift_of(list, eccentricity) result(shifted)
    type(gap_part_type), intent(in) :: list(:) !! parts of a film
    real(wp), intent(in) :: eccentricity(2) !! of the shaft [m]
    real(wp) :: shifted(2)
    integer :: i

    shifted = eccentricity
    do i = 1, size(list)
      shifted = shifted + list(i)%shift
    end do
  end function shift_of
end module gfb_gap_part
