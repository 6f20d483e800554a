#include "gfb_petsc.h"
!> All that has a past in a march of a bearing, on this rank, as one list of numbers: of each a stage of `gfb_runge_kutta` is
!> taken alike.
!>
!> In its order: the sleeve's place and its rate, the gas of all pads, deflections of damped springs and ways of their arms, gas in
!> pockets of orifices; of foils
!> with mass or losses the scaled state, with mass its rate, and amplitudes of modes inside pieces and theirs. What an algebraic
!> equation gives has no past.
module gfb_stage_memory
  use petscvec
  use gfb_kinds, only: wp
  use gfb_film_load, only: film_forces
  use gfb_march_state, only: march_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: read_memory, put_memory, place_entries

  integer, parameter :: place_entries(2) = [1, film_forces] !! first and last of the sleeve's place

contains

  !> The list as march and bearing have it now, the foils' state aside.
  function read_memory(march, bearing, state) result(value)
    type(march_type), intent(inout) :: march !! stays
    type(bearing_system_type), intent(inout) :: bearing !! stays
    Vec, intent(in) :: state !! scaled, of the foils
    real(wp), allocatable :: value(:) !! [SI]

    allocate (value(0))
    call visit_memory(march, bearing, state, .false., value)
  end function read_memory

  !> Makes a list the newest past of march and bearing.
  subroutine put_memory(value, march, bearing, state)
    real(wp), intent(in) :: value(:) !! as `read_memory` has it [SI]
    type(march_type), intent(inout) :: march !! gets place, rate and gas
    type(bearing_system_type), intent(inout) :: bearing !! its blocks get theirs
    Vec, intent(in) :: state !! gets the foils' state where that has a past
    real(wp), allocatable :: list(:)

    list = value
    call visit_memory(march, bearing, state, .true., list)
  end subroutine put_memory

  !> Goes through the list, and puts its numbers or takes them.
  subroutine visit_memory(march, bearing, state, puts, value)
    type(march_type), intent(inout) :: march
    type(bearing_system_type), intent(inout) :: bearing
    Vec, intent(in) :: state
    logical, intent(in) :: puts
    real(wp), allocatable, intent(inout) :: value(:) !! the whole of it where they are put, else nothing before
    integer :: at, i

    at = 0
    call visit_part(march%place(:, 1))
    call visit_part(march%velocity(:, 1))
    do i = 1, size(bearing%pad)
      call visit_gas(march%pad(i)%stored(:, :, 1))
    end do
    do i = 1, bearing%dampers%pads()
      call visit_part(bearing%dampers%springs(i)%deflection(:, 1))
      call visit_part(bearing%dampers%springs(i)%relaxed(:, 1))
    end do
    if (has_pockets(bearing)) call visit_part(bearing%feed%content(:, 1))
    if (bearing%momentum%present .or. bearing%losses%present) call visit_state(state)
    if (.not. bearing%momentum%present) return
    call visit_state(bearing%momentum%rate(1))
    if (.not. bearing%momentum%inner%present) return
    call visit_part(bearing%momentum%inner%amplitude(:, 1))
    call visit_part(bearing%momentum%inner%rate(:, 1))

  contains

    !> The next numbers.
    subroutine visit_part(part)
      real(wp), intent(inout) :: part(:)

      if (puts) then
        part = value(at + 1:at + size(part))
      else
        value = [value, part]
      end if
      at = at + size(part)
    end subroutine visit_part

    !> Those of points in elements.
    subroutine visit_gas(part)
      real(wp), intent(inout) :: part(:, :)
      integer :: k

      do k = 1, size(part, 2)
        call visit_part(part(:, k))
      end do
    end subroutine visit_gas

    !> Those of a vector.
    subroutine visit_state(vector)
      Vec, intent(in) :: vector
      PetscScalar, pointer :: values(:)
      PetscErrorCode :: ierr

      PetscCallA(GFB_VecGetArray(vector, values, ierr))
      call visit_part(values)
      PetscCallA(GFB_VecRestoreArray(vector, values, ierr))
    end subroutine visit_state
  end subroutine visit_memory

  !> Whether pockets of orifices store gas.
  pure logical function has_pockets(bearing) result(has)
    type(bearing_system_type), intent(in) :: bearing

    has = allocated(bearing%feed)
    if (has) has = allocated(bearing%feed%content)
  end function has_pockets
end module gfb_stage_memory
