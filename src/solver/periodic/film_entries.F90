#include "gfb_petsc.h"
!> What a bearing's film and foils remember, as entries of a point of a map over a period: their unknowns now and one step
!> ago; slips of contacts that rub; and, now and one step ago, what springs remember beside the unknowns.
module gfb_film_entries
  use petscvec
  use gfb_kinds, only: wp
  use gfb_spring_history, only: spring_history_type, begin_springs
  use gfb_march_state, only: march_settings_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_contact_memory, only: slips_of, put_slips, slip_entries
  use gfb_map_springs, only: remembered_by, pack_springs, unpack_springs
  implicit none (type)
  private
  public :: film_entries, pack_film, unpack_film, take_back_springs, rest_of_springs

  !> Where they stand.
  type, public :: film_entries_type
    type(bearing_system_type), pointer :: bearing => null()
    integer :: first = 0             !! entries of a point before those of this bearing
    integer :: owned = 0             !! unknowns of this rank
    real(wp) :: share = 1.0_wp       !! weight of one unknown [1]
    real(wp) :: length = 1.0_wp      !! of slips and ways of springs [m]
    logical :: rubs = .false.        !! contacts have friction, whose slips are part of the state
    integer, allocatable, private :: remembered(:) !! what springs remember beside the unknowns
    integer, private :: slips = 0    !! of this rank's contacts, where they rub
    integer, private :: springs = 0  !! entries of what they remember
  contains
    procedure :: entries
  end type film_entries_type

contains

  !> The entries of a bearing; where they begin, and their weight, are its map's.
  function film_entries(settings, bearing) result(film)
    type(march_settings_type), intent(in) :: settings !! what dissipates in the foils
    type(bearing_system_type), target, intent(in) :: bearing !! the bearing
    type(film_entries_type) :: film
    PetscInt :: owned
    PetscErrorCode :: ierr

    film%bearing => bearing
    film%length = bearing%clearance
    PetscCallA(VecGetLocalSize(bearing%state, owned, ierr))
    film%owned = int(owned)
    film%rubs = rubs(bearing)
    if (film%rubs) film%slips = slip_entries*contacts_of(bearing)
    film%remembered = remembered_by(settings, bearing)
    film%springs = 2*film%owned*size(film%remembered)
  end function film_entries

  !> How many there are on this rank.
  pure integer function entries(self)
    class(film_entries_type), intent(in) :: self
    entries = 2*self%owned + self%slips + self%springs
  end function entries

  !> Springs at rest in a state.
  function rest_of_springs(film, unknown) result(rest)
    type(film_entries_type), intent(in) :: film !! the entries
    real(wp), intent(in) :: unknown(:) !! of the bearing [SI]
    type(spring_history_type) :: rest(size(film%bearing%pad)) !! of all pads
    integer :: i

    do i = 1, merge(size(rest), 0, film%springs > 0)
      associate (pad => film%bearing%pad(i))
        call begin_springs(unknown(pad%first + 1:pad%last), pad%foil, rest(i))
      end associate
    end do
  end function rest_of_springs

  !> Unknowns now and one step ago, slips and springs as entries of a point.
  subroutine pack_film(film, unknown, x, springs)
    type(film_entries_type), intent(in) :: film !! its bearing is left at the newest state
    real(wp), intent(in) :: unknown(:, :) !! (local unknowns, 2) [SI]
    real(wp), intent(inout) :: x(:) !! the point [1]
    type(spring_history_type), intent(in), optional :: springs(:) !! of all pads, where they have dampers
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: k, first

    do k = 2, 1, -1
      call film%bearing%set_unknowns(unknown(:, k))
      PetscCallA(GFB_VecGetArrayRead(film%bearing%state, values, ierr))
      x(film%first + (k - 1)*film%owned + 1:film%first + k*film%owned) = film%share*values(:film%owned)
      PetscCallA(GFB_VecRestoreArrayRead(film%bearing%state, values, ierr))
    end do
    first = film%first + film%entries()
    if (film%springs > 0) then
      call pack_springs(film%remembered, film%share/film%length, film%bearing, springs, x(first - film%springs + 1:first))
    end if
    if (film%slips == 0) return
    first = film%first + 2*film%owned
    do k = 1, size(film%bearing%pad)
      associate (contacts => film%bearing%pad(k)%foil%contacts)
        x(first + 1:first + slip_entries*size(contacts%point)) = film%share/film%length*slips_of(contacts)
        first = first + slip_entries*size(contacts%point)
      end associate
    end do
  end subroutine pack_film

  !> The reverse, but for springs, which `take_back_springs` brings once they have begun.
  subroutine unpack_film(film, x, place, unknown)
    type(film_entries_type), intent(in) :: film !! its bearing's state and contacts are overwritten
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp), intent(in) :: place(:, :) !! (unknown coordinates of the sleeve, 2) now and one step ago [m], [rad]
    real(wp), intent(out) :: unknown(:, :) !! (local unknowns, 2) [SI]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: k, first

    associate (bearing => film%bearing)
      do k = 1, 2
        PetscCallA(GFB_VecGetArray(bearing%state, values, ierr))
        values(:film%owned) = x(film%first + (k - 1)*film%owned + 1:film%first + k*film%owned)/film%share
        PetscCallA(GFB_VecRestoreArray(bearing%state, values, ierr))
        call bearing%get_unknowns(unknown(:, k))
        unknown(bearing%first_shaft + 1:bearing%first_shaft + size(place, 1), k) = place(:, k)
      end do
    end associate
    if (film%slips == 0) return
    first = film%first + 2*film%owned
    do k = 1, size(film%bearing%pad)
      associate (pad => film%bearing%pad(k), many => slip_entries*size(film%bearing%pad(k)%foil%contacts%point))
        call put_slips(x(first + 1:first + many)*film%length/film%share, &
                       pad%foil%own_part(unknown(pad%first + 1:pad%last, 1)), pad%foil%contacts)
        first = first + many
      end associate
    end do
  end subroutine unpack_film

  !> Springs remember what a point has of them.
  subroutine take_back_springs(film, x, unknown)
    type(film_entries_type), intent(in) :: film !! its bearing's dampers have begun
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp), intent(in) :: unknown(:, :) !! (local unknowns, 2) now and one step ago [SI]
    integer :: last

    last = film%first + film%entries()
    if (film%springs > 0) call unpack_springs(film%remembered, film%length/film%share, x(last - film%springs + 1:last), unknown, &
                                              film%bearing)
  end subroutine take_back_springs

  !> Whether contacts rub.
  pure function rubs(bearing)
    type(bearing_system_type), intent(in) :: bearing
    logical :: rubs

    rubs = .false.
    if (bearing%has_contacts()) rubs = any(bearing%pad(1)%foil%contacts%law%friction > 0.0_wp)
  end function rubs

  !> Contacts of this rank.
  pure function contacts_of(bearing) result(many)
    type(bearing_system_type), intent(in) :: bearing
    integer :: many, i

    many = 0
    do i = 1, size(bearing%pad)
      many = many + size(bearing%pad(i)%foil%contacts%point)
    end do
  end function contacts_of
end module gfb_film_entries
