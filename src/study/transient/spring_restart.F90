#include "gfb_petsc.h"
!> What dampers and Maxwell arms of a foundation remember, in the restart file of a shaft over time.
!>
!> Deflections of stations are unknowns; those of local springs follow from the pressures and the dampers' pull.
module gfb_spring_restart
  use petscvec
  use gfb_kinds, only: wp
  use gfb_natural_order, only: bearing_order
  use gfb_bearing_system, only: bearing_system_type
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type
  use gfb_restart_fields, only: put_vector, read_vector
  use gfb_march_state, only: march_type
  implicit none (type)
  private
  public :: keep_springs, recall_past_springs

  character(len=*), parameter :: pulls(2) = [character(len=25) :: '/march/spring_pull', '/march/spring_pull_before']
  character(len=*), parameter :: ways(2) = [character(len=25) :: '/march/arm', '/march/arm_before']

contains

  !> Writes what the states do not say.
  subroutine keep_springs(bearing, march, file)
    type(bearing_system_type), intent(in) :: bearing !! at the newest state
    type(march_type), intent(in) :: march !! its past
    type(result_file_type), intent(inout) :: file !! that is being written
    real(wp) :: value(bearing%local_size(), 2)
    Vec :: vector
    PetscErrorCode :: ierr
    integer :: i, step

    if (.not. march%settings%damps()) return
    PetscCallA(VecDuplicate(bearing%state, vector, ierr))
    value = 0.0_wp
    if (march%pad(1)%springs%local) then
      do i = 1, size(bearing%pad)
        value(bearing%pad(i)%first + 1:bearing%pad(i)%last, :) = march%pad(i)%springs%pull
      end do
      do step = 1, 2
        call put(trim(pulls(step)), 'that dampers have of earlier deflections [Pa]')
      end do
    end if
    if (march%settings%arm%is_present()) then
      do i = 1, size(bearing%pad)
        value(bearing%pad(i)%first + 1:bearing%pad(i)%last, :) = march%pad(i)%springs%relaxed
      end do
      do step = 1, 2
        call put(trim(ways(step)), 'ways of the dashpots of Maxwell arms [m]')
      end do
    end if
    PetscCallA(VecDestroy(vector, ierr))

  contains

    subroutine put(path, meaning)
      character(len=*), intent(in) :: path, meaning

      call bearing%exchange%put(value(:, step), vector)
      call put_vector(bearing_order(bearing), vector, path, meaning, file)
    end subroutine put
  end subroutine keep_springs

  !> Reads it again.
  subroutine recall_past_springs(bearing, file, march)
    type(bearing_system_type), intent(in) :: bearing !! at the newest state
    type(stored_file_type), intent(inout) :: file !! that is being read
    type(march_type), intent(inout) :: march !! that has begun anew; gets it
    real(wp) :: value(bearing%local_size())
    Vec :: vector
    PetscErrorCode :: ierr
    integer :: i, step

    if (.not. march%settings%damps()) return
    PetscCallA(VecDuplicate(bearing%state, vector, ierr))
    PetscCallA(VecSet(vector, 0.0_wp, ierr))
    do step = 1, 2
      if (march%pad(1)%springs%local) then
        call get(trim(pulls(step)))
        do i = 1, size(bearing%pad)
          march%pad(i)%springs%recalled = .true.
          march%pad(i)%springs%pull(:, step) = value(bearing%pad(i)%first + 1:bearing%pad(i)%last)
        end do
      end if
      if (march%settings%arm%is_present()) then
        call get(trim(ways(step)))
        do i = 1, size(bearing%pad)
          march%pad(i)%springs%relaxed(:, step) = value(bearing%pad(i)%first + 1:bearing%pad(i)%last)
        end do
      end if
    end do
    PetscCallA(VecDestroy(vector, ierr))

  contains

    subroutine get(path)
      character(len=*), intent(in) :: path

      call read_vector(bearing_order(bearing), path, file, vector)
      call bearing%exchange%get(vector, value)
    end subroutine get
  end subroutine recall_past_springs
end module gfb_spring_restart
