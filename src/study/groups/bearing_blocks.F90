!> What groups of ranks have of a bearing's sweep, or of its frequencies, put together: a block each, one set of results.
module gfb_bearing_blocks
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_archive, only: archive_type
  use gfb_quantity, only: quantity_type, place_of, number_in
  use gfb_result_names, only: compared_names, result_unit, add_result
  use gfb_result_table, only: with_stretches, name_length
  use gfb_scene, only: scene_type
  use gfb_case_file, only: history_row_type, case_array_type, visit_rows, visit_arrays
  use gfb_grid_series, only: grid_series_type, join_series, visit_series
  use gfb_dynamics_record, only: dynamics_record_type, dynamics_point_type, visit_dynamics
  use gfb_tilt_response, only: tilt_axis
  use gfb_bearing_record, only: sweep_name, sweep_unit
  use gfb_reasons, only: reason_type
  implicit none (type, external)
  private
  public :: visit_block, merge_histories, merge_arrays, merge_series, merge_dynamics, merge_frequencies, add_origin, seam_words, &
            place_text

  !> Two paths to one answer differ by less, over the clearance [1].
  real(wp), parameter :: same_answer = 1.0e-5_wp
  character(len=1), parameter :: axes(2) = ['x', 'y']
  character(len=*), parameter :: secants(2) = 'secant_stiffness_'//axes

  !> What a group of ranks has found of a bearing.
  type, public :: group_result_type
    !> numbers of its values in the whole sweep, or of its frequencies
    integer :: first = 1, last = 0
    integer :: status = 0          !! exit status that gfb would have had
    integer :: iterations = 0              !! of Newton's method
    integer :: factorizations = 0
    integer :: factorizations_finest = 0   !! those of the finest mesh's matrix
    type(reason_type) :: reason    !! why it ended before its last value, or has no answer
    type(history_row_type), allocatable :: row(:)  !! its points
    !> The first point of the block behind, from its own last one; none where there is none.
    type(history_row_type), allocatable :: next(:)
    type(case_array_type), allocatable :: contacts(:)
    real(wp) :: first_slope(2, 2) = 0.0_wp     !! where it begins [N m/rad]
    type(dynamics_record_type) :: dynamics !! coefficients at its points, onset of whirl
    type(grid_series_type) :: series       !! film and foils at its points
  end type group_result_type

contains

  !> Saves or restores a block.
  pure subroutine visit_block(archive, block)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(group_result_type), intent(inout) :: block !! written where the archive restores

    call archive%visit('first', block%first)
    call archive%visit('last', block%last)
    call archive%visit('status', block%status)
    call archive%visit('iterations', block%iterations)
    call archive%visit('factorizations', block%factorizations)
    call archive%visit('factorizations_finest', block%factorizations_finest)
    call archive%visit('reason_code', block%reason%code)
    call archive%visit('reason_at', block%reason%at)
    call archive%visit('reason_of', block%reason%of)
    call archive%visit('reason_shown', block%reason%shown)
    call archive%visit('reason_gave_up', block%reason%gave_up)
    call archive%visit('reason_detail', block%reason%detail)
    call archive%part('row')
    call visit_rows(archive, block%row)
    call archive%part('next')
    call visit_rows(archive, block%next)
    call archive%part('contacts')
    call visit_arrays(archive, block%contacts)
    call archive%visit('first_slope', block%first_slope)
    call archive%part('dynamics')
    call visit_dynamics(archive, block%dynamics)
    call archive%part('series')
    call visit_series(archive, block%series)
  end subroutine visit_block

  !> All rows in the sweep's order, counts from the sweep's first point on.
  subroutine merge_histories(scene, blocks, history)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    type(group_result_type), intent(in) :: blocks(:) !! in the sweep's order
    type(history_row_type), allocatable, intent(out) :: history(:) !! one row a point
    type(history_row_type) :: row
    integer :: i, k, iterations, factorizations ! of the blocks before

    allocate (history(0))
    iterations = 0
    factorizations = 0
    do i = 1, size(blocks)
      do k = 1, size(blocks(i)%row)
        row = blocks(i)%row(k)
        call add_to(row, 'newton_iterations', iterations)
        call add_to(row, 'factorizations', factorizations)
        if (k == 1 .and. parts(scene, blocks, i)) call add_to(row, 'branch_changed', 1)
        if (size(history) > 0) call match_secants(tilt_axis(scene%sweep), history(1), row)
        history = [history, row]
      end do
      iterations = iterations + blocks(i)%iterations
      factorizations = factorizations + blocks(i)%factorizations
    end do
  end subroutine merge_histories

  !> Whether a block begins with another answer than that to which the one before leads.
  function parts(scene, blocks, number)
    type(scene_type), intent(in) :: scene
    type(group_result_type), intent(in) :: blocks(:)
    integer, intent(in) :: number !! of the block
    logical :: parts

    parts = .false.
    if (number < 2) return
    if (.not. allocated(blocks(number - 1)%next)) return
    parts = seam_words(scene, blocks(number - 1), blocks(number)) /= ''
  end function parts

  !> Adds to a row's count, or says that something is true.
  pure subroutine add_to(row, name, number)
    type(history_row_type), intent(inout) :: row
    character(len=*), intent(in) :: name
    integer, intent(in) :: number
    integer :: place

    place = place_of(name, row%quantity)
    if (place > 0) row%quantity(place)%number = row%quantity(place)%number + real(number, wp)
  end subroutine add_to

  !> Measures a row's secant stiffness from the torque without tilt that the sweep's first point
  !> knows, as a sweep in one piece does; none where it does not know it.
  subroutine match_secants(axis, first, row)
    integer, intent(in) :: axis !! that the sweep tilts about: 1 is x, 2 is y, 0 none
    type(history_row_type), intent(in) :: first
    type(history_row_type), intent(inout) :: row
    type(quantity_type), allocatable :: kept(:)
    type(quantity_type) :: new
    real(wp) :: tilt, untilted
    integer :: i, torque

    if (axis == 0) return
    allocate (kept(0))
    do i = 1, size(row%quantity)
      if (all(row%quantity(i)%name /= secants)) kept = [kept, row%quantity(i)]
    end do
    do i = 1, size(first%quantity)
      torque = findloc(secants == first%quantity(i)%name, .true., 1)
      if (torque == 0) cycle
      new = first%quantity(i)
      ! The torque without tilt stands in the first row's secant, or is the first row's torque.
      tilt = number_in(first%quantity, 'tilt_'//axes(axis))
      untilted = number_in(first%quantity, 'torque_'//axes(torque))
      if (abs(tilt) > 0.0_wp) untilted = untilted - tilt*new%number
      tilt = number_in(row%quantity, 'tilt_'//axes(axis))
      if (abs(tilt) > 0.0_wp) then
        new%number = (number_in(row%quantity, 'torque_'//axes(torque)) - untilted)/tilt
      else
        new%number = number_in(row%quantity, 'angular_stiffness_'//axes(torque)//axes(axis))
      end if
      kept = [kept, new]
    end do
    call move_alloc(kept, row%quantity)
  end subroutine match_secants

  !> The contacts of all points in the sweep's order.
  subroutine merge_arrays(blocks, arrays)
    type(group_result_type), intent(in) :: blocks(:) !! in the sweep's order
    type(case_array_type), allocatable, intent(out) :: arrays(:) !! with all points
    real(wp), allocatable :: values(:, :)
    integer :: i, k, columns, rows

    allocate (arrays(0))
    do i = 1, size(blocks)
      if (size(arrays) == 0) then
        arrays = blocks(i)%contacts
        cycle
      end if
      do k = 1, size(blocks(i)%contacts)
        if (.not. arrays(k)%by_step) cycle
        associate (more => blocks(i)%contacts(k)%values)
          columns = size(more, 1)
          rows = size(arrays(k)%values, 2)
          allocate (values(columns, rows + size(more, 2)))
          values(:, :rows) = arrays(k)%values
          values(:, rows + 1:) = more
        end associate
        call move_alloc(values, arrays(k)%values)
      end do
    end do
  end subroutine merge_arrays

  !> Film and foils at all points in the sweep's order.
  pure subroutine merge_series(blocks, series)
    type(group_result_type), intent(in) :: blocks(:) !! in the sweep's order
    type(grid_series_type), intent(out) :: series !! of all points
    integer :: i

    do i = 1, size(blocks)
      call join_series(series, blocks(i)%series)
    end do
  end subroutine merge_series

  !> Coefficients of all points, and the first onset of whirl that any block has seen.
  pure subroutine merge_dynamics(blocks, record)
    type(group_result_type), intent(in) :: blocks(:) !! in the sweep's order
    type(dynamics_record_type), intent(inout) :: record !! of one of them, gets those of all
    type(dynamics_point_type), allocatable :: all(:)
    integer :: i

    record%onset = 0.0_wp
    do i = size(blocks), 1, -1
      if (blocks(i)%dynamics%onset > 0.0_wp) record%onset = blocks(i)%dynamics%onset
    end do
    if (.not. allocated(record%point)) return
    allocate (all(0))
    do i = 1, size(blocks)
      if (allocated(blocks(i)%dynamics%point)) all = [all, blocks(i)%dynamics%point]
    end do
    call move_alloc(all, record%point)
  end subroutine merge_dynamics

  !> Coefficients at all frequencies in their order; what else was found is the first block's.
  pure subroutine merge_frequencies(blocks, point)
    type(group_result_type), intent(in) :: blocks(:) !! each with an answer
    type(dynamics_point_type), intent(inout) :: point !! the first block's, gets all frequencies
    complex(wp), allocatable :: coefficient(:, :, :)
    integer :: i, first, last

    point%frequency = [(blocks(i)%dynamics%point(1)%frequency, i=1, size(blocks))]
    associate (old => point%coefficient)
      allocate (coefficient(size(old, 1), size(old, 2), size(point%frequency)))
    end associate
    first = 1
    do i = 1, size(blocks)
      associate (part => blocks(i)%dynamics%point(1)%coefficient)
        last = first + size(part, 3) - 1
        coefficient(:, :, first:last) = part
      end associate
      first = last + 1
    end do
    call move_alloc(coefficient, point%coefficient)
  end subroutine merge_frequencies

  !> Adds how the sweep was divided, and whether its blocks meet.
  subroutine add_origin(scene, groups, blocks, list)
    type(scene_type), intent(in) :: scene          !! with the whole sweep
    integer, intent(in) :: groups                  !! of ranks
    type(group_result_type), intent(in) :: blocks(:) !! in the sweep's order
    type(quantity_type), allocatable, intent(inout) :: list(:) !! what the files say of their origin
    character(len=:), allocatable :: words
    integer :: i

    words = 'all begin with the answer to which the stretch before leads'
    do i = 2, size(blocks)
      if (seam_words(scene, blocks(i - 1), blocks(i)) /= '') words = 'not all begin with '// &
                                                    'the answer to which the stretch before leads'
    end do
    call add_result(list, 'groups', groups, with_stretches)
    if (groups > 1) call add_result(list, 'stretches', words)
  end subroutine add_origin

  !> What is to be said of the seam between two blocks; nothing where the first leads to the same
  !> answer as that with which the second begins.
  function seam_words(scene, before, behind) result(words)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    type(group_result_type), intent(in) :: before, behind !! the seam
    character(len=:), allocatable :: words
    character(len=name_length), allocatable :: compared(:)
    real(wp) :: one, other, difference
    integer :: i

    words = ''
    if (before%status /= 0 .or. size(behind%row) == 0) return
    if (size(before%next) == 0) then
      words = 'the path from the point before finds no answer at '// &
        place_text(scene, behind%first)//': without groups the sweep would have ended there'
      return
    end if
    compared = compared_names()
    do i = 1, size(compared)
      one = number_in(before%next(1)%quantity, trim(compared(i)))
      other = number_in(behind%row(1)%quantity, trim(compared(i)))
      difference = abs(other - one)
      if (result_unit(trim(compared(i))) == 'm') difference = difference/scene%bearing%clearance
      if (difference <= same_answer) cycle
      words = 'another answer than a sweep without groups from '// &
        place_text(scene, behind%first)//' on: there '//trim(compared(i))//' is '//text(one)// &
        ' on the path from the point before, and '//text(other)//' as it was found'
      return
    end do
  end function seam_words

  !> A point of the sweep in words.
  function place_text(scene, point) result(words)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    integer, intent(in) :: point !! number of the value
    character(len=:), allocatable :: words

    words = sweep_name(scene%sweep)//' = '//text(scene%sweep%values(point))//' '// &
            sweep_unit(scene%sweep)
  end function place_text
end module gfb_bearing_blocks
