!> The stretches of a sweep that groups of ranks have computed, put together again.
module gfb_sweep_stretch
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type, number_quantity, count_quantity, word_quantity, &
                          add_quantity
  use gfb_result_names, only: compared_names, result_unit
  use gfb_result_table, only: name_length
  use gfb_scene, only: scene_type
  use gfb_case_file, only: history_row_type, case_array_type
  use gfb_row_packing, only: pack_rows, unpack_rows
  use gfb_tilt_response, only: tilt_response_type, tilt_axis
  use gfb_bearing_record, only: sweep_name, sweep_unit
  implicit none (type, external)
  private
  public :: stretch_words, read_stretch, merge_histories, merge_arrays, number_of, seam_words, &
            place_text

  !> Two ways to one answer differ by less, over the clearance [1].
  real(wp), parameter :: same_answer = 1.0e-5_wp

  !> What a group has found.
  type, public :: stretch_type
    integer :: first = 1, last = 0 !! numbers of its values in the whole sweep
    integer :: status = 0          !! exit status that gfb would have had
    integer :: iterations = 0      !! of Newton
    integer :: factorizations = 0
    character(len=:), allocatable :: reason    !! why it ended before its last value, if it did
    type(history_row_type), allocatable :: row(:)  !! its points
    !> The first point of the stretch behind, from its own last one; none where there is none.
    type(history_row_type), allocatable :: next(:)
    type(case_array_type), allocatable :: contacts(:)
    real(wp) :: first_slope(2, 2) = 0.0_wp     !! where it begins [N m/rad]
  end type stretch_type

contains

  !> A group's stretch, but for the contacts, as a text.
  function stretch_words(stretch, tilted) result(words)
    type(stretch_type), intent(in) :: stretch
    type(tilt_response_type), intent(in) :: tilted
    character(len=:), allocatable :: words
    type(history_row_type) :: head(1)
    integer :: i, k

    allocate (head(1)%quantity(0))
    call add('first', stretch%first)
    call add('last', stretch%last)
    call add('status', stretch%status)
    call add('iterations', stretch%iterations)
    call add('factorizations', stretch%factorizations)
    call add('rows', size(stretch%row))
    call add_quantity(head(1)%quantity, word_quantity('reason', stretch%reason, ''))
    do k = 1, 2
      do i = 1, 2
        call add_quantity(head(1)%quantity, number_quantity('slope', tilted%first_slope(i, k), &
          '', ''))
      end do
    end do
    words = pack_rows([head, stretch%row, stretch%next])

  contains

    !> Adds a count to the head.
    subroutine add(name, number)
      character(len=*), intent(in) :: name
      integer, intent(in) :: number
      call add_quantity(head(1)%quantity, count_quantity(name, number, ''))
    end subroutine add
  end function stretch_words

  !> The stretch of a text.
  subroutine read_stretch(words, stretch)
    character(len=*), intent(in) :: words
    type(stretch_type), intent(out) :: stretch
    type(history_row_type), allocatable :: rows(:)
    integer :: points

    call unpack_rows(words, rows)
    associate (head => rows(1)%quantity)
      stretch%first = nint(head(1)%number)
      stretch%last = nint(head(2)%number)
      stretch%status = nint(head(3)%number)
      stretch%iterations = nint(head(4)%number)
      stretch%factorizations = nint(head(5)%number)
      points = nint(head(6)%number)
      stretch%reason = head(7)%word
      stretch%first_slope = reshape(head(8:11)%number, [2, 2])
    end associate
    stretch%row = rows(2:points + 1)
    stretch%next = rows(points + 2:)
  end subroutine read_stretch

  !> All rows in the sweep's order, counts from the sweep's first point on.
  subroutine merge_histories(scene, stretches, history)
    type(scene_type), intent(in) :: scene
    type(stretch_type), intent(in) :: stretches(:)
    type(history_row_type), allocatable, intent(out) :: history(:)
    type(history_row_type) :: row
    integer :: i, k, axis, before(2)

    allocate (history(0))
    axis = tilt_axis(scene%sweep)
    before = 0
    do i = 1, size(stretches)
      do k = 1, size(stretches(i)%row)
        row = stretches(i)%row(k)
        call add_to(row, 'newton_iterations', before(1))
        call add_to(row, 'factorizations', before(2))
        if (size(history) > 0 .and. axis > 0) call match_secants(history(1), axis, row)
        history = [history, row]
      end do
      before = before + [stretches(i)%iterations, stretches(i)%factorizations]
    end do
  end subroutine merge_histories

  !> Adds to a row's count.
  pure subroutine add_to(row, name, number)
    type(history_row_type), intent(inout) :: row
    character(len=*), intent(in) :: name
    integer, intent(in) :: number
    integer :: i

    do i = 1, size(row%quantity)
      if (row%quantity(i)%name /= name) cycle
      row%quantity(i)%number = row%quantity(i)%number + real(number, wp)
    end do
  end subroutine add_to

  !> Measures a row's secant stiffness from the torque without tilt that the sweep's first point
  !> knows, as a sweep in one piece does; none where it does not know it.
  subroutine match_secants(first, axis, row)
    type(history_row_type), intent(in) :: first
    integer, intent(in) :: axis !! that the sweep tilts about: 1 is x, 2 is y
    type(history_row_type), intent(inout) :: row
    character(len=1), parameter :: axes(2) = ['x', 'y']
    type(quantity_type), allocatable :: kept(:)
    type(quantity_type) :: new
    character(len=:), allocatable :: swept, torque
    real(wp) :: tilt, untilted
    integer :: i, of

    allocate (kept(0))
    do i = 1, size(row%quantity)
      if (secant_axis(row%quantity(i)%name) == 0) kept = [kept, row%quantity(i)]
    end do
    swept = 'tilt_'//axes(axis)
    do i = 1, size(first%quantity)
      new = first%quantity(i)
      of = secant_axis(new%name)
      if (of == 0) cycle
      torque = 'torque_'//axes(of)
      ! The torque without tilt stands in the first row's secant, or is the first row's torque.
      tilt = number_of(first, swept)
      untilted = number_of(first, torque)
      if (abs(tilt) > 0.0_wp) untilted = untilted - tilt*new%number
      tilt = number_of(row, swept)
      if (abs(tilt) > 0.0_wp) then
        new%number = (number_of(row, torque) - untilted)/tilt
      else
        new%number = number_of(row, 'angular_stiffness_'//axes(of)//axes(axis))
      end if
      kept = [kept, new]
    end do
    call move_alloc(kept, row%quantity)
  end subroutine match_secants

  !> Axis of the torque of a secant stiffness, by its name; 0: it is another result.
  pure function secant_axis(name) result(axis)
    character(len=*), intent(in) :: name
    integer :: axis
    axis = findloc([name == 'secant_stiffness_x', name == 'secant_stiffness_y'], .true., dim=1)
  end function secant_axis

  !> A row's number of a name; zero where it has none.
  pure function number_of(row, name) result(number)
    type(history_row_type), intent(in) :: row
    character(len=*), intent(in) :: name
    real(wp) :: number
    integer :: i

    number = 0.0_wp
    do i = 1, size(row%quantity)
      if (row%quantity(i)%name == name) number = row%quantity(i)%number
    end do
  end function number_of

  !> The contacts of all points in the sweep's order.
  subroutine merge_arrays(stretches, arrays)
    type(stretch_type), intent(in) :: stretches(:)
    type(case_array_type), allocatable, intent(out) :: arrays(:)
    real(wp), allocatable :: values(:, :)
    integer :: i, k, columns, rows

    allocate (arrays(0))
    do i = 1, size(stretches)
      if (size(arrays) == 0) then
        arrays = stretches(i)%contacts
        cycle
      end if
      do k = 1, size(stretches(i)%contacts)
        if (.not. arrays(k)%by_step) cycle
        associate (more => stretches(i)%contacts(k)%values)
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

  !> What is to be said of the seam between two stretches; nothing where the first leads to the same
  !> answer as that with which the second begins.
  function seam_words(scene, before, behind) result(words)
    type(scene_type), intent(in) :: scene
    type(stretch_type), intent(in) :: before, behind
    character(len=:), allocatable :: words
    character(len=name_length), allocatable :: compared(:)
    real(wp) :: one, other, difference
    integer :: i

    words = ''
    if (before%status /= 0 .or. size(behind%row) == 0) return
    if (size(before%next) == 0) then
      words = 'the way from the point before finds no answer at '// &
        place_text(scene, behind%first)//': without groups the sweep would have ended there'
      return
    end if
    compared = compared_names()
    do i = 1, size(compared)
      one = number_of(before%next(1), trim(compared(i)))
      other = number_of(behind%row(1), trim(compared(i)))
      difference = abs(other - one)
      if (result_unit(trim(compared(i))) == 'm') difference = difference/scene%bearing%clearance
      if (difference <= same_answer) cycle
      words = 'another answer than a sweep without groups from '// &
        place_text(scene, behind%first)//' on: there '//trim(compared(i))//' is '//text(one)// &
        ' on the way from the point before, and '//text(other)//' as it was found'
      return
    end do
  end function seam_words

  !> A point of the sweep in words.
  function place_text(scene, point) result(words)
    type(scene_type), intent(in) :: scene
    integer, intent(in) :: point !! number of the value
    character(len=:), allocatable :: words

    words = sweep_name(scene%sweep)//' = '//text(scene%sweep%values(point))//' '// &
            sweep_unit(scene%sweep)
  end function place_text
end module gfb_sweep_stretch
