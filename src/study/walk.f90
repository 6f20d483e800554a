!> A walk from answer to answer: the points of a sweep, or the load steps of a strip.
module gfb_walk
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_petsc_session, only: stop_is_asked
  use gfb_reasons, only: reason_type, reason_stopped
  implicit none (type, external)
  private
  public :: take_walk

  !> What is asked of a model at every point.
  type, abstract, public :: walk_type
  contains
    procedure(reach_point), deferred :: reach      !! finds its answer from the last point's
    procedure(end_point), deferred :: record_point !! records it
    procedure(end_point), deferred :: save_point   !! for a restart, where that is due
    procedure :: save_stopped => save_nothing      !! for a restart, where the walk is stopped
  end type walk_type

  abstract interface
    !> Finds the answer of a point; without one the model is left at the last state it has reached.
    subroutine reach_point(self, point, reason)
      import :: walk_type, reason_type
      implicit none (type, external)
      class(walk_type), target, intent(inout) :: self !! the walk
      integer, intent(in) :: point             !! number, from 1
      type(reason_type), intent(out) :: reason !! why there is no answer
    end subroutine reach_point

    !> Does what is to be done at a point that has its answer.
    subroutine end_point(self, point)
      import :: walk_type
      implicit none (type, external)
      class(walk_type), target, intent(inout) :: self !! the walk
      integer, intent(in) :: point !! number, from 1
    end subroutine end_point
  end interface

contains

  !> A walk that cannot be resumed where it is stopped.
  subroutine save_nothing(self, point)
    class(walk_type), target, intent(inout) :: self !! the walk
    integer, intent(in) :: point !! number of the last one that has an answer
  end subroutine save_nothing

  !> Walks from a point to another; the first without an answer ends the walk, and so does a signal.
  subroutine take_walk(walk, first, last, reason)
    class(walk_type), target, intent(inout) :: walk !! left at the last answer
    integer, intent(in) :: first, last       !! points; none where the last lies before the first
    type(reason_type), intent(out) :: reason !! why the walk has ended before its last point
    integer :: point

    do point = first, last
      if (.not. stop_is_asked()) call walk%reach(point, reason)
      if (stop_agreed()) then
        reason%code = reason_stopped
        reason%detail = stop_words()
        call walk%save_stopped(point - 1)
      end if
      if (reason%is_given()) return
      call walk%record_point(point)
      call walk%save_point(point)
    end do
  end subroutine take_walk
end module gfb_walk
