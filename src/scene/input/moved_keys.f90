!> Keys that had another group, or several, in the version before: there they are still read, and
!> the user gets the new one.
module gfb_moved_keys
  implicit none (type, external)
  private
  public :: home_of

  !> Keys that have moved.
  type :: moved_type
    character(len=9) :: from  !! group
    character(len=12) :: home !! group that has them now
    character(len=55) :: keys !! between blanks
  end type moved_type

  type(moved_type), parameter :: moved(*) = [ &
    moved_type('dynamics', 'foil_damping', &
               ' foundation_damping maxwell_stiffness maxwell_time '), &
    moved_type('transient', 'foil_damping', &
               ' foundation_damping maxwell_stiffness maxwell_time '), &
    moved_type('periodic', 'foil_damping', &
               ' foundation_damping maxwell_stiffness maxwell_time '), &
    moved_type('dynamics', 'foil_damping', ' foil_mass foil_modes '), &
    moved_type('transient', 'foil_damping', ' foil_mass foil_modes '), &
    moved_type('transient', 'unbalance', ' unbalance unbalance_angle '), &
    moved_type('periodic', 'unbalance', ' unbalance unbalance_angle '), &
    moved_type('transient', 'unbalance', ' couple_unbalance couple_unbalance_angle ')]

contains

  !> The group that has a key now: the same where it has not moved.
  pure function home_of(group, key) result(home)
    character(len=*), intent(in) :: group, key !! names, as they were typed, in lower case
    character(len=:), allocatable :: home
    integer :: i

    home = group
    do i = 1, size(moved)
      if (moved(i)%from == group .and. index(moved(i)%keys, ' '//key//' ') > 0) then
        home = trim(moved(i)%home)
      end if
    end do
  end function home_of
end module gfb_moved_keys
