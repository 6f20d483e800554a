#include "gfb_petsc.h"
!> What damped springs of an elastic foundation remember beside the unknowns, as entries of a point of a map over a period.
!>
!> Under local pressures deflections have no unknowns, and pressures alone do not give them where dampers or Maxwell arms feel
!> how fast they change. The ways of the arms' dashpots never have any. Both are there now and one step ago.
module gfb_map_springs
  use petscvec
  use gfb_kinds, only: wp
  use gfb_spring_history, only: spring_history_type, put_deflections
  use gfb_march_state, only: march_settings_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: remembered_by, pack_springs, unpack_springs

  integer, parameter :: deflections = 1, dashpots = 2 !! what may be remembered

contains

  !> What springs remember.
  function remembered_by(settings, bearing) result(remembered)
    type(march_settings_type), intent(in) :: settings !! with dampers and arms of the springs
    type(bearing_system_type), intent(in) :: bearing !! on them, or on other foils
    integer, allocatable :: remembered(:) !! each has two entries for each of this rank's unknowns

    allocate (remembered(0))
    if (settings%damps() .and. bearing%pad(1)%foil%local_unknowns() == 0) remembered = [deflections]
    if (settings%arm%is_present()) remembered = [remembered, dashpots]
  end function remembered_by

  !> What springs remember as entries.
  subroutine pack_springs(remembered, scale, bearing, springs, entries)
    integer, intent(in) :: remembered(:) !! of `remembered_by`
    real(wp), intent(in) :: scale !! entries over ways [1/m]
    type(bearing_system_type), intent(in) :: bearing !! on the springs
    type(spring_history_type), intent(in) :: springs(:) !! of all pads
    real(wp), intent(out) :: entries(:) !! of this rank [1]
    real(wp) :: moved(bearing%local_size(), 2)
    PetscScalar, pointer :: values(:)
    Vec :: vector
    PetscErrorCode :: ierr
    integer :: i, k, kind, first, owned

    PetscCallA(VecDuplicate(bearing%state, vector, ierr))
    owned = size(entries)/(2*size(remembered))
    first = 0
    do kind = 1, size(remembered)
      moved = 0.0_wp
      do i = 1, size(bearing%pad)
        moved(bearing%pad(i)%first + 1:bearing%pad(i)%last, :) = memory_of(remembered(kind), springs(i))
      end do
      do k = 1, 2
        call bearing%exchange%put(moved(:, k), vector)
        PetscCallA(GFB_VecGetArrayRead(vector, values, ierr))
        entries(first + 1:first + owned) = scale*values(:owned)
        PetscCallA(GFB_VecRestoreArrayRead(vector, values, ierr))
        first = first + owned
      end do
    end do
    PetscCallA(VecDestroy(vector, ierr))
  end subroutine pack_springs

  !> The reverse.
  subroutine unpack_springs(remembered, scale, entries, unknown, bearing)
    integer, intent(in) :: remembered(:) !! of `remembered_by`
    real(wp), intent(in) :: scale !! ways over entries [m]
    real(wp), intent(in) :: entries(:) !! of this rank [1]
    real(wp), intent(in) :: unknown(:, :) !! (local unknowns, 2) now and one step ago [SI]
    type(bearing_system_type), intent(inout) :: bearing !! its dampers have begun, and get them; foils are without after that
    real(wp) :: moved(size(unknown, 1), 2)
    PetscScalar, pointer :: values(:)
    Vec :: vector
    PetscErrorCode :: ierr
    integer :: i, k, kind, first, owned

    PetscCallA(VecDuplicate(bearing%state, vector, ierr))
    owned = size(entries)/(2*size(remembered))
    first = 0
    do kind = 1, size(remembered)
      do k = 1, 2
        PetscCallA(GFB_VecGetArray(vector, values, ierr))
        values(:owned) = scale*entries(first + 1:first + owned)
        PetscCallA(GFB_VecRestoreArray(vector, values, ierr))
        call bearing%exchange%get(vector, moved(:, k))
        first = first + owned
      end do
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), springs => bearing%dampers%springs(i), from => bearing%pad(i)%first + 1, &
                   to => bearing%pad(i)%last)
          if (remembered(kind) == deflections) then
            call put_deflections(moved(from:to, :), unknown(from:to, :), pad%foil, springs)
          else
            springs%relaxed = moved(from:to, :)
          end if
        end associate
      end do
    end do
    PetscCallA(VecDestroy(vector, ierr))
  end subroutine unpack_springs

  !> Deflections or ways of dashpots, now and one step ago [m].
  pure function memory_of(kind, springs) result(moved)
    integer, intent(in) :: kind !! `deflections` or `dashpots`
    type(spring_history_type), intent(in) :: springs !! of a pad
    real(wp), allocatable :: moved(:, :)

    if (kind == deflections) then
      moved = springs%deflection
    else
      moved = springs%relaxed
    end if
  end function memory_of
end module gfb_map_springs
