!> A sample whose members are divided among groups of ranks: one set of results.
!>
!> Every group takes the next member that is left; a member's answer does not depend on its group.
module gfb_divided_sample
  use gfb_bearing_summary, only: cost_type
  use gfb_c_library, only: peak_memory
  use gfb_errors, only: error_type
  use gfb_group_log, only: close_group_log, group_log_path, open_group_log
  use gfb_job_groups, only: job_type
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_petsc_session, only: wall_time
  use gfb_provenance, only: version_text
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_run_context, only: run_context_type
  use gfb_sample, only: sample_type
  use gfb_sample_writing, only: write_sample
  use gfb_scene, only: scene_type
  use gfb_table_file, only: visit_member
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: run_divided_sample

  integer, parameter :: writer = 1 !! the group that writes
  integer, parameter :: status_unconverged = 2

contains

  !> Computes the members side by side, and writes them as one run would.
  subroutine run_divided_sample(scene, study, context, job, status)
    type(scene_type), intent(in) :: scene !! with `&sample`
    type(sample_type), intent(inout) :: study !! of this group, as it was created
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(job_type), target, intent(inout) :: job !! that is divided
    integer, intent(out) :: status !! exit status of the program
    type(run_context_type) :: own
    type(archive_type) :: mine
    type(archive_type), allocatable :: all(:)
    type(error_type), allocatable :: error
    real(wp) :: total(4)
    integer :: number

    call show_division(scene, context, job)
    own = context
    call open_group_log(group_log_path(context%folder, scene%name, job%group), job, own, error)
    if (.not. allocated(error)) call study%prepare(scene, own%log)
    if (.not. allocated(error)) call study%check(scene, error)
    status = 0
    if (allocated(error)) then
      status = error%status
      call own%log%complaint(error%message)
    end if
    status = job%largest(status)
    if (status == 0) then
      job%total = scene%sample%count
      job%counted = scene%sample%count
      call job%next_member(number)
      do while (number <= scene%sample%count)
        call study%solve_member(scene, own, number)
        call mine%visit('number', number)
        call visit_member(mine, study%member(number))
        call job%next_member(number)
      end do
      ! Counts of a group are on each of its ranks.
      total = job%total_of(merge(1.0_wp, 0.0_wp, [.true., job%leads, job%leads, job%leads])* &
                           [peak_memory(), real(study%iterations, wp), &
                            real(study%factorizations, wp), real(study%factorizations_finest, wp)])
      study%unknowns = job%largest(study%unknowns)
      call job%collect(mine, writer, all)
      if (job%group == writer) then
        call read_members(all, study)
        call write_all(scene, context, job, study, total, status)
      end if
      status = job%largest(status)
    else if (job%group == writer .and. allocated(error)) then
      call context%log%complaint(error%message)
    end if
    call close_group_log(own%log)
    call study%discard()
  end subroutine run_divided_sample

  !> What is divided.
  subroutine show_division(scene, context, job)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job

    associate (log => context%log)
      call log%line(version_text())
      call log%line(scene%file//': '//scene%general%title)
      call log%line('results go to '//context%folder//', '//text(job%ranks)//' rank(s) in '// &
                    text(job%groups)//' group(s), logs '// &
                    group_log_path(context%folder, scene%name, 1)//', ...')
      call log%line(text(scene%sample%count)//' members, each group takes the next one')
      call log%line('')
    end associate
  end subroutine show_division

  !> The members that the groups have sent.
  subroutine read_members(all, study)
    type(archive_type), intent(inout) :: all(:)
    type(sample_type), intent(inout) :: study
    integer :: i, number

    do i = 1, size(all)
      do while (.not. all(i)%is_used_up())
        number = 0
        call all(i)%visit('number', number)
        if (number < 1 .or. number > size(study%member)) then
          error stop 'what a group of ranks has sent is no member of the sample'
        end if
        call visit_member(all(i), study%member(number))
      end do
    end do
  end subroutine read_members

  !> Writes all members, and tells the terminal.
  subroutine write_all(scene, context, job, study, total, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job
    type(sample_type), intent(inout) :: study
    real(wp), intent(in) :: total(4) !! memory [B], iterations, factorizations of all groups
    integer, intent(inout) :: status
    type(run_context_type) :: terminal
    type(quantity_type), allocatable :: origin(:), summary(:)
    type(error_type), allocatable :: error
    integer :: i

    terminal = context
    terminal%log%active = job%leads
    terminal%log%verbose = .false.
    call study%judge()
    if (.not. study%converged) status = status_unconverged
    origin = context%origin()
    do i = 1, size(origin)
      if (origin(i)%name == 'ranks') origin(i)%number = real(job%ranks, wp)
    end do
    call add_result(origin, 'groups', job%groups)
    call terminal%take_case(scene%name, error)
    if (.not. allocated(error)) then
      call write_sample(scene, terminal, study%member, origin, job%ranks, &
                        cost_type(study%unknowns, nint(total(2)), nint(total(3)), nint(total(4)), &
                                  wall_time() - job%begun, total(1)), summary, error)
    end if
    call terminal%give_back()
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%log%complaint(error%message)
  end subroutine write_all
end module gfb_divided_sample
