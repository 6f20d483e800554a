#include "gfb_petsc.h"
!> Small vibrations whose frequencies are divided among groups of ranks: one set of results.
!>
!> Every group finds the same answer for itself, and vibrates about it with its own frequencies. The first group
!> also looks for the critical mass and the rotor's modes; so it has fewer frequencies.
module gfb_divided_frequencies
  use petscsys
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_division, only: block_ends
  use gfb_c_library, only: peak_memory
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_scene, only: scene_type
  use gfb_petsc_session, only: wall_time
  use gfb_bearing_summary, only: cost_type
  use gfb_dynamics_record, only: dynamics_record_type, dynamics_point_type, visit_dynamics
  use gfb_dynamics_writing, only: record_arrays, write_coefficients
  use gfb_restart, only: drop_restart
  use gfb_provenance, only: version_text
  use gfb_run_context, only: run_context_type
  use gfb_bearing_study, only: bearing_study_type
  use gfb_bearing_writing, only: bearing_result_type, write_bearing
  use gfb_job_groups, only: job_type
  use gfb_group_log, only: group_log_path, open_group_log, close_group_log
  implicit none (type)
  private
  public :: run_divided_frequencies

  integer, parameter :: writer = 1 !! the group that looks for the critical mass and writes
  integer, parameter :: search = 13 !! frequencies that take as long as the search for the critical mass
  integer, parameter :: status_unconverged = 2

  !> What a group has found.
  type :: share_type
    integer :: status = 0 !! exit status that gfb would have had
    integer :: iterations = 0, factorizations = 0, factorizations_finest = 0
    character(len=:), allocatable :: reason !! why it has no answer, else empty
    type(dynamics_record_type) :: dynamics
  end type share_type

contains

  !> Computes the frequencies of each group side by side, and writes what they have found as one.
  subroutine run_divided_frequencies(scene, context, job, status)
    type(scene_type), intent(in) :: scene !! with all frequencies and no sweep
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(job_type), target, intent(inout) :: job !! that is divided
    integer, intent(out) :: status !! exit status of the program
    type(bearing_study_type), allocatable, target :: study
    type(run_context_type) :: own
    type(share_type), allocatable :: mine
    type(share_type), allocatable :: shares(:)
    type(error_type), allocatable :: error
    real(wp) :: memory(1)

    allocate (study, mine)
    call show_division(scene, context, job)
    job%total = job%groups
    job%counted = 0
    own = context
    mine%reason = ''
    call open_group_log(group_log_path(context%folder, scene%name, job%group), job, own, error)
    if (.not. allocated(error)) call compute(scene, job, own, study, mine, error)
    if (allocated(error)) then
      mine%status = error%status
      mine%reason = error%message
    end if
    call job%report(trim(merge('done     ', 'no answer', mine%status == 0)), 1)
    memory = job%total_of([peak_memory()])
    status = job%largest(merge(mine%status, 0, job%group == writer .and. allocated(error)))
    if (status == 0) then
      call gather(job, mine, shares)
      if (job%group == writer) call write_all(scene, context, job, memory(1), study, shares, mine%status)
    else if (job%group == writer) then
      own%log%active = job%leads
      call own%log%complaint('group '//text(writer)//': '//mine%reason)
    end if
    status = job%largest(mine%status)
    if (status == 0) call drop_restart(own%restart)
    call own%give_back()
    call close_group_log(own%log)
    call study%discard()
  end subroutine run_divided_frequencies

  !> First and last frequency of a group; the last is before the first where it has none.
  pure function frequencies_of_group(frequencies, groups, group) result(ends)
    integer, intent(in) :: frequencies !! in all, as many as groups at least
    integer, intent(in) :: groups      !! of the job
    integer, intent(in) :: group       !! from 1
    integer :: ends(2), first_share

    ends = [1, frequencies]
    if (groups == 1) return
    first_share = max(1, (frequencies + search)/groups - search)
    if (group == 1) then
      ends(2) = first_share
    else
      ends = first_share + block_ends(frequencies - first_share, groups - 1, group - 1)
    end if
  end function frequencies_of_group

  !> Which group has which frequencies.
  subroutine show_division(scene, context, job)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job
    integer :: group, ends(2), ranks(2)

    associate (log => context%log, frequency => scene%dynamics%frequencies)
      call log%line(version_text())
      call log%line(scene%file//': '//scene%general%title)
      call log%line('results go to '//context%folder//', '//text(job%ranks)//' rank(s) in '//text(job%groups)//' group(s)')
      do group = 1, job%groups
        ends = frequencies_of_group(size(frequency), job%groups, group)
        ranks = block_ends(job%ranks, job%groups, group)
        call log%line('group '//text(group)//': '//text(ranks(2) - ranks(1) + 1)//' rank(s), '//text(frequency(ends(1)))// &
                      ' to '//text(frequency(ends(2)))//' rad/s, '//text(ends(2) - ends(1) + 1)//' frequencies, log '// &
                      group_log_path(context%folder, scene%name, group))
      end do
      call log%line('every group finds the answer about which the shaft vibrates')
      call log%line('')
    end associate
  end subroutine show_division

  !> The answer, and this group's frequencies about it.
  subroutine compute(scene, job, context, study, mine, error)
    type(scene_type), intent(in) :: scene
    type(job_type), intent(in) :: job
    type(run_context_type), intent(inout) :: context !! of this group
    type(bearing_study_type), target, intent(inout) :: study
    type(share_type), intent(inout) :: mine
    type(error_type), allocatable, intent(out) :: error
    type(scene_type) :: own
    integer :: ends(2)

    ends = frequencies_of_group(size(scene%dynamics%frequencies), job%groups, job%group)
    own = scene
    ! What it may write while it runs is its own, and that of as many groups.
    own%name = scene%name//'.group'//text(job%group)//'of'//text(job%groups)
    associate (dynamics => own%dynamics)
      dynamics%frequencies = scene%dynamics%frequencies(ends(1):ends(2))
      if (size(dynamics%ratios) > 0) dynamics%ratios = scene%dynamics%ratios(ends(1):ends(2))
      dynamics%stability = job%group == writer
    end associate
    call context%log%line(version_text())
    call context%log%line(scene%file//': '//scene%general%title)
    call study%prepare(scene, context%log)
    call study%check(scene, error)
    if (.not. allocated(error)) call context%take_case(own%name, error)
    if (.not. allocated(error)) call context%find_restart(own, error)
    if (allocated(error)) return
    call context%log%heading('solution')
    call study%solve(own, context, error)
    if (allocated(error)) return
    mine%iterations = study%iterations
    mine%factorizations = study%factorizations
    mine%factorizations_finest = study%factorizations_finest
    mine%dynamics = study%sweep%record%dynamics
    if (study%converged) return
    mine%status = status_unconverged
    mine%reason = study%reason%words()
  end subroutine compute

  !> Brings all shares to the group that writes.
  subroutine gather(job, mine, shares)
    type(job_type), intent(in) :: job
    type(share_type), intent(inout) :: mine
    type(share_type), allocatable, intent(out) :: shares(:) !! nothing in the other groups
    type(archive_type) :: archive
    type(archive_type), allocatable :: sent(:)
    integer :: i

    call visit_share(archive, mine)
    call job%collect(archive, writer, sent)
    allocate (shares(size(sent)))
    do i = 1, size(shares)
      call visit_share(sent(i), shares(i))
      call sent(i)%finish()
      if (sent(i)%failed) error stop 'what a group of ranks has sent is no share of the frequencies'
    end do
  end subroutine gather

  !> Saves or restores a share.
  subroutine visit_share(archive, share)
    type(archive_type), intent(inout) :: archive
    type(share_type), intent(inout) :: share

    call archive%visit('status', share%status)
    call archive%visit('iterations', share%iterations)
    call archive%visit('factorizations', share%factorizations)
    call archive%visit('factorizations_finest', share%factorizations_finest)
    call archive%visit('reason', share%reason)
    call archive%part('dynamics')
    call visit_dynamics(archive, share%dynamics)
  end subroutine visit_share

  !> Writes all frequencies with this group's answer, and tells the terminal.
  subroutine write_all(scene, context, job, memory, study, shares, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job
    real(wp), intent(in) :: memory !! of all ranks [B]
    type(bearing_study_type), target, intent(inout) :: study
    type(share_type), intent(in) :: shares(:)
    integer, intent(inout) :: status
    type(run_context_type) :: terminal
    type(bearing_result_type) :: result
    type(quantity_type), allocatable :: summary(:)
    type(error_type), allocatable :: error
    integer :: i

    terminal = context
    terminal%log%active = job%leads
    terminal%log%verbose = .false.
    call terminal%take_case(scene%name, error)
    result%converged = all(shares%status == 0)
    result%upwind = study%plan%upwind
    result%peclet = study%plan%peclet
    result%cells = study%plan%circumferential
    result%cost = cost_type(study%unknowns, sum(shares%iterations), sum(shares%factorizations), &
                            sum(shares%factorizations_finest), wall_time() - job%begun, memory)
    result%ranks = job%ranks
    result%origin = context%origin()
    do i = 1, size(result%origin)
      if (result%origin(i)%name == 'ranks') result%origin(i)%number = real(job%ranks, wp)
    end do
    call add_result(result%origin, 'groups', job%groups)
    associate (record => study%sweep%record)
      if (result%converged) call join_frequencies(shares, record%dynamics%point)
      result%contacts = record_arrays(scene, study%sweep%bearing, record, size(record%history))
      if (.not. allocated(error)) call write_bearing(scene, terminal, study%sweep, result, summary, error)
      if (.not. allocated(error)) call write_coefficients(record, scene, terminal, error)
    end associate
    call terminal%give_back()
    do i = 1, size(shares)
      if (shares(i)%status /= 0) call terminal%log%line('group '//text(i)//': '//shares(i)%reason)
    end do
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%log%complaint(error%message)
  end subroutine write_all

  !> All groups' frequencies in their order; what else was found is the first group's.
  subroutine join_frequencies(shares, point)
    type(share_type), intent(in) :: shares(:) !! each with an answer
    type(dynamics_point_type), intent(inout) :: point(:) !! the first group's
    complex(wp), allocatable :: coefficient(:, :, :)
    integer :: i, first, last

    point(1)%frequency = [(shares(i)%dynamics%point(1)%frequency, i=1, size(shares))]
    associate (old => point(1)%coefficient)
      allocate (coefficient(size(old, 1), size(old, 2), size(point(1)%frequency)))
    end associate
    first = 1
    do i = 1, size(shares)
      associate (part => shares(i)%dynamics%point(1)%coefficient)
        last = first + size(part, 3) - 1
        coefficient(:, :, first:last) = part
      end associate
      first = last + 1
    end do
    call move_alloc(coefficient, point(1)%coefficient)
  end subroutine join_frequencies
end module gfb_divided_frequencies
