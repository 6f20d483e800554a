!> Signals and the time limit that ask the program to stop at the next point where it can.
!>
!> A rank sees a signal at a moment of its own. Whether the run stops is agreed by all ranks at the
!> same point (`stop_is_asked` of the PETSc session); what was agreed is the same on all of them.
module gfb_signals
  use, intrinsic :: iso_c_binding, only: c_int
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: catch_signals, limit_time, hold_clock, received_signal, agree_on_signal, &
            agreed_signal, stop_agreed, out_of_time, stop_status, stop_words

  !> Signals by their numbers on Linux, and their names.
  integer, parameter :: number(6) = [1, 2, 10, 14, 15, 24]
  integer, parameter :: time_limit = 14 !! SIGALRM, which `limit_time` asks for
  character(len=7), parameter :: name(6) = &
    ['SIGHUP ', 'SIGINT ', 'SIGUSR1', 'SIGALRM', 'SIGTERM', 'SIGXCPU']
  !> a shell's status of what a signal has ended, less the signal's number
  integer, parameter :: status_of_signals = 128
  integer, parameter :: status_time_limit = 124   !! as that of timeout(1)

  interface
    !> Notes signals from now on; a second one ends the process at once. After SIGINT, SIGTERM or
    !> SIGHUP a process that does not come to ask for `received_signal` is ended by a clock.
    subroutine catch_signals() bind(c, name='gfb_catch_signals')
      implicit none (type, external)
    end subroutine catch_signals

    subroutine c_limit_time(seconds) bind(c, name='gfb_limit_time')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: seconds
    end subroutine c_limit_time

    subroutine c_hold_clock(on) bind(c, name='gfb_hold_clock')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: on
    end subroutine c_hold_clock

    function c_received_signal() result(signal) bind(c, name='gfb_received_signal')
      import :: c_int
      implicit none (type, external)
      integer(c_int) :: signal
    end function c_received_signal

    function c_agreed_signal() result(signal) bind(c, name='gfb_agreed_signal')
      import :: c_int
      implicit none (type, external)
      integer(c_int) :: signal
    end function c_agreed_signal

    subroutine c_agree_on_signal(signal) bind(c, name='gfb_agree_on_signal')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: signal
    end subroutine c_agree_on_signal
  end interface

contains

  !> Asks the run to stop when so much time has passed from now on.
  subroutine limit_time(seconds)
    integer, intent(in) :: seconds !! from now [s]
    call c_limit_time(int(seconds, c_int))
  end subroutine limit_time

  !> No clock ends the process while it writes results: where it is begun and ended.
  subroutine hold_clock(on)
    logical, intent(in) :: on !! it is begun
    call c_hold_clock(merge(1_c_int, 0_c_int, on))
  end subroutine hold_clock

  !> The signal that this rank has received, 0 for none.
  integer function received_signal() result(signal)
    signal = int(c_received_signal())
  end function received_signal

  !> The run stops because of a signal; to be called with the same one on all ranks.
  subroutine agree_on_signal(signal)
    integer, intent(in) :: signal !! its number; 0: it goes on
    call c_agree_on_signal(int(signal, c_int))
  end subroutine agree_on_signal

  !> The signal because of which the run stops, 0 where it goes on; the same on all ranks.
  integer function agreed_signal() result(signal)
    signal = int(c_agreed_signal())
  end function agreed_signal

  !> Whether the run stops; the same on all ranks.
  logical function stop_agreed() result(stops)
    stops = agreed_signal() /= 0
  end function stop_agreed

  !> Whether what stops the run is its time limit; the same on all ranks.
  logical function out_of_time()
    out_of_time = agreed_signal() == time_limit
  end function out_of_time

  !> Exit status of a run that was stopped.
  integer function stop_status() result(status)

    status = status_of_signals + agreed_signal()
    if (out_of_time()) status = status_time_limit
  end function stop_status

  !> Why the run stops.
  function stop_words() result(words)
    character(len=:), allocatable :: words
    integer :: signal, at

    signal = agreed_signal()
    at = findloc(number, signal, 1)
    if (signal == time_limit) then
      words = 'stopped by the time limit'
    else if (at > 0) then
      words = 'stopped by '//trim(name(at))
    else
      words = 'stopped by signal '//text(signal)
    end if
  end function stop_words
end module gfb_signals
