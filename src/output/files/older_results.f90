!> What earlier runs of a case have left beside the results of a new one.
module gfb_older_results
  use, intrinsic :: iso_c_binding, only: c_char, c_null_char
  use gfb_c_library, only: remove_file
  implicit none (type, external)
  private
  public :: remove_unanswered, has_answer

  character(len=*), parameter :: unanswered = '.unconverged'
  !> What is no surface; the summary, by which the others are known, is the last.
  character(len=*), parameter :: endings(*) = [character(len=9) :: &
                                               '.h5', '.csv', '.used.nml', '.summary']

  interface
    !> Removes the files of all surfaces, whatever their names, of the results that a stem names.
    subroutine c_remove_surfaces(stem) bind(c, name='gfb_remove_surfaces')
      import :: c_char
      implicit none (type, external)
      character(kind=c_char), intent(in) :: stem(*)
    end subroutine c_remove_surfaces
  end interface

contains

  !> Removes the state that an earlier run of a case without an answer has left: beside an answer it
  !> would be taken for it. The answer of a case that is itself called so stays.
  subroutine remove_unanswered(stem, removed)
    character(len=*), intent(in) :: stem !! folder and name of the case
    logical, intent(out) :: removed !! there was such a state
    integer :: i

    removed = says(stem//unanswered, 'converged = false')
    if (.not. removed) return
    call c_remove_surfaces(stem//unanswered//c_null_char)
    do i = 1, size(endings)
      call remove_file(stem//unanswered//trim(endings(i)))
    end do
  end subroutine remove_unanswered

  !> Whether an earlier run has left an answer of a case.
  function has_answer(stem) result(truth)
    character(len=*), intent(in) :: stem !! folder and name of the case
    logical :: truth
    truth = says(stem, 'converged = true')
  end function has_answer

  !> Whether a summary is there and has a line.
  function says(stem, line) result(truth)
    character(len=*), intent(in) :: stem !! folder and name of the summary
    character(len=*), intent(in) :: line
    logical :: truth
    character(len=40) :: words
    integer :: unit, status

    truth = .false.
    open (newunit=unit, file=stem//'.summary', action='read', status='old', iostat=status)
    if (status /= 0) return
    do while (.not. truth)
      read (unit, '(a)', iostat=status) words
      if (status /= 0) exit
      truth = words == line
    end do
    close (unit)
  end function says
end module gfb_older_results
