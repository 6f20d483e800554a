!> `<case>.h5`: the scene, where it was computed, its summary and its history.
module gfb_case_file
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_archive, only: archive_type
  use gfb_quantity, only: quantity_type, quantity_word, quantity_number, place_of, &
                          number_quantity, number_in, visit_description, are_alike
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file
  use gfb_text, only: exact_text, text
  implicit none (type, external)
  private
  public :: write_case_file, write_quantities, write_history, summary_text, fill_array, &
            add_array, table_csv, with_decimal_commas, history_values, visit_rows, visit_arrays

  !> One row of the history: the quantities of a sweep point or load step.
  type, public :: history_row_type
    type(quantity_type), allocatable :: quantity(:)
  end type history_row_type

  !> A matrix that a scene adds under a path of its own.
  type, public :: case_array_type
    character(len=:), allocatable :: path, unit, meaning
    real(wp), allocatable :: values(:, :) !! (columns, rows) of the file
    logical :: by_step = .false.          !! a row is a load step or sweep point
    logical :: is_column = .false.        !! of the table of comma-separated values
    !> in the file where one rank alone has any; 0: all ranks have all
    integer :: rows = 0
    !> a row is a square matrix of that order, row by row, or, by step, several of them
    integer :: order = 0
  end type case_array_type

  !> Whether and how a table of comma-separated values is written.
  type, public :: csv_settings_type
    logical :: wanted = .false. !! of what is no sweep, too, which has one anyway
    logical :: decimal_comma = .false. !! in numbers; semicolons are between them
  end type csv_settings_type

contains

  !> Writes the file under its temporary name.
  !>
  !> Fails when it cannot be written.
  subroutine write_case_file(path, communicator, first_rank, verbatim, echo, &
                             provenance, summary, history, arrays, file, error, columns, parts)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: communicator !! MPI's
    logical, intent(in) :: first_rank !! this rank leads
    character(len=*), intent(in) :: verbatim         !! text of the case file
    character(len=*), intent(in) :: echo             !! every key with the value used
    type(quantity_type), intent(in) :: provenance(:) !! program, machine, command
    type(quantity_type), intent(in) :: summary(:) !! the answer
    type(history_row_type), intent(in) :: history(:) !! a row a step or point
    type(case_array_type), intent(in) :: arrays(:)   !! their groups are made as needed
    type(result_file_type), intent(out) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    type(history_row_type), intent(in), optional :: columns(:) !! that a history without a row has
    type(quantity_type), intent(in), optional :: parts(:) !! texts of further case files, by name
    integer :: i

    call open_result_file(path, communicator, first_rank, file, error)
    if (allocated(error)) return
    call file%group('/scene')
    call file%put_text('/scene/case_file', verbatim, 'the case file as it was read')
    call file%put_text('/scene/used', echo, 'every key with the value used; it can be run again')
    if (present(parts)) then
      do i = 1, size(parts)
        call file%put_text('/scene/'//parts(i)%name, parts(i)%word, parts(i)%meaning)
      end do
    end if
    call write_quantities(file, '/provenance', provenance)
    call write_quantities(file, '/summary', summary)
    call write_history(file, history, columns)
    call write_arrays(file, arrays)
    call close_result_file(file, error)
  end subroutine write_case_file

  !> Fills an array of a scene's.
  !>
  !> Component by component: of a structure constructor gfortran never frees the copies, and it
  !> reads beyond the end of values that are a part of a larger array.
  subroutine fill_array(path, unit, meaning, values, array, by_step)
    character(len=*), intent(in) :: path, unit, meaning !! where it goes; of the numbers; a sentence
    real(wp), intent(in) :: values(:, :) !! (columns, rows) of the file, in `unit` [SI]
    type(case_array_type), intent(out) :: array !! path, unit, meaning and values
    logical, intent(in), optional :: by_step         !! a row is a load step or sweep point

    array%path = path
    array%unit = unit
    array%meaning = meaning
    array%values = values
    if (present(by_step)) array%by_step = by_step
  end subroutine fill_array

  !> Puts an array at the end of a list; an array constructor would not free all that it copies.
  subroutine add_array(list, path, unit, meaning, values, by_step, order, is_column)
    type(case_array_type), allocatable, intent(inout) :: list(:) !! gets it behind its own
    character(len=*), intent(in) :: path, unit, meaning !! where it goes; of the numbers; a sentence
    real(wp), intent(in) :: values(:, :) !! (columns, rows) of the file, in `unit` [SI]
    logical, intent(in), optional :: by_step !! a row is a load step or sweep point
    integer, intent(in), optional :: order !! a row is a square matrix of that order, or several
    logical, intent(in), optional :: is_column !! of the table of comma-separated values
    type(case_array_type), allocatable :: grown(:)
    integer :: i

    allocate (grown(size(list) + 1))
    do i = 1, size(list)
      call move_alloc(list(i)%path, grown(i)%path)
      call move_alloc(list(i)%unit, grown(i)%unit)
      call move_alloc(list(i)%meaning, grown(i)%meaning)
      call move_alloc(list(i)%values, grown(i)%values)
      grown(i)%by_step = list(i)%by_step
      grown(i)%is_column = list(i)%is_column
      grown(i)%rows = list(i)%rows
      grown(i)%order = list(i)%order
    end do
    call fill_array(path, unit, meaning, values, grown(size(grown)), by_step)
    if (present(order)) grown(size(grown))%order = order
    if (present(is_column)) grown(size(grown))%is_column = is_column
    call move_alloc(grown, list)
  end subroutine add_array

  !> One dataset an array, in groups one or two levels deep.
  subroutine write_arrays(file, arrays)
    type(result_file_type), intent(inout) :: file
    type(case_array_type), intent(in) :: arrays(:)
    integer, allocatable :: extent(:)
    integer :: i, mine, total

    do i = 1, size(arrays)
      associate (one => arrays(i))
        call file%need_group(one%path(:index(one%path(2:), '/')))
        call file%need_group(one%path(:index(one%path, '/', back=.true.) - 1))
        mine = size(one%values, 2)
        total = merge(one%rows, mine, one%rows > 0)
        if (one%rows == 0 .and. .not. file%first_rank) mine = 0
        if (one%order == 0) then
          call file%put_block(one%path, one%values(:, :mine), 0, total, one%unit, one%meaning)
        else
          extent = [one%order, one%order, size(one%values, 1)/one%order**2]
          if (.not. one%by_step) extent = extent(:2)
          call file%put_block(one%path, one%values(:, :mine), 0, total, one%unit, one%meaning, &
                              extent)
        end if
      end associate
    end do
  end subroutine write_arrays

  !> One dataset a quantity.
  subroutine write_quantities(file, group, quantity)
    type(result_file_type), intent(inout) :: file !! the file being written
    character(len=*), intent(in) :: group !! of the file
    type(quantity_type), intent(in) :: quantity(:) !! to be written, a dataset each
    integer :: i

    call file%group(group)
    do i = 1, size(quantity)
      associate (one => quantity(i))
        if (one%kind == quantity_word) then
          call file%put_text(group//'/'//one%name, one%word, one%meaning)
        else
          call file%put_scalar(group//'/'//one%name, one%number, one%unit, one%meaning)
        end if
      end associate
    end do
  end subroutine write_quantities

  !> One dataset a name, one entry a row; a row without the name has NaN there.
  subroutine write_history(file, history, columns)
    type(result_file_type), intent(inout) :: file !! the file being written
    type(history_row_type), intent(in) :: history(:) !! a row a step or point
    type(history_row_type), intent(in), optional :: columns(:) !! that a history without a row has
    type(quantity_type), allocatable :: column(:)
    integer :: i

    call file%group('/history')
    call collect_columns(history, column, columns)
    do i = 1, size(column)
      call file%put_numbers('/history/'//column(i)%name, history_values(history, column(i)%name), &
                            column(i)%unit, column(i)%meaning)
    end do
  end subroutine write_history

  !> Comma-separated values, with names and units in the first line: those of a motion or of orbits
  !> where arrays are columns of such a table, else the history.
  function table_csv(history, arrays, columns) result(words)
    type(history_row_type), intent(in) :: history(:) !! a row a step or point
    type(case_array_type), intent(in) :: arrays(:) !! of the same file, on the rank that writes
    type(history_row_type), intent(in), optional :: columns(:) !! that a history without a row has
    character(len=:), allocatable :: words
    type(quantity_type), allocatable :: column(:)
    real(wp), allocatable :: values(:, :)
    integer, allocatable :: chosen(:)
    integer :: i

    chosen = pack([(i, i=1, size(arrays))], [(arrays(i)%is_column, i=1, size(arrays))])
    if (size(chosen) > 0) then
      allocate (column(size(chosen)), values(size(chosen), size(arrays(chosen(1))%values, 2)))
      do i = 1, size(chosen)
        associate (one => arrays(chosen(i)))
          column(i) = number_quantity(one%path(index(one%path, '/', back=.true.) + 1:), 0.0_wp, &
                                      one%unit, one%meaning)
          values(i, :) = one%values(1, :)
        end associate
      end do
    else
      call collect_columns(history, column, columns)
      allocate (values(size(column), size(history)))
      do i = 1, size(column)
        values(i, :) = history_values(history, column(i)%name)
      end do
    end if
    words = csv_lines(column, values)
  end function table_csv

  !> Comma-separated lines; what is no number stays empty.
  function csv_lines(column, values) result(words)
    type(quantity_type), intent(in) :: column(:) !! names, units and kinds
    real(wp), intent(in) :: values(:, :) !! (columns, rows) [their units]
    character(len=:), allocatable :: words
    character(len=:), allocatable :: buffer, line
    integer :: i, row, used

    line = ''
    do i = 1, size(column)
      if (i > 1) line = line//','
      line = line//column(i)%name//' ['//column(i)%unit//']'
    end do
    used = 0
    buffer = ''
    call put_line()
    do row = 1, size(values, 2)
      line = ''
      do i = 1, size(column)
        if (i > 1) line = line//','
        if (ieee_is_nan(values(i, row))) cycle
        if (column(i)%kind == quantity_number) line = line//exact_text(values(i, row))
        if (column(i)%kind /= quantity_number) line = line//text(nint(values(i, row)))
      end do
      call put_line()
    end do
    words = buffer(:used)

  contains

    !> Puts the line behind the others. The room is doubled: a text that grows line by line is
    !> copied as often.
    subroutine put_line()
      integer :: length

      length = len(line) + 1
      if (used + length > len(buffer)) buffer = buffer(:used)//repeat(' ', used + length)
      buffer(used + 1:used + length) = line//new_line('a')
      used = used + length
    end subroutine put_line
  end function csv_lines

  !> Comma-separated values with commas in their numbers, and semicolons between them, as
  !> spreadsheets of many countries read them.
  pure function with_decimal_commas(table) result(other)
    character(len=*), intent(in) :: table !! lines whose names and units have neither
    character(len=len(table)) :: other
    integer :: i

    other = table
    do i = 1, len(table)
      if (table(i:i) == ',') other(i:i) = ';'
      if (table(i:i) == '.') other(i:i) = ','
    end do
  end function with_decimal_commas

  !> The numbers of a name, a row each; NaN where a row has none [their unit].
  function history_values(history, name) result(values)
    type(history_row_type), intent(in) :: history(:) !! a row a step or point
    character(len=*), intent(in) :: name !! of the result
    real(wp) :: values(size(history))
    integer :: row
    real(wp) :: none

    none = ieee_value(none, ieee_quiet_nan)
    values = [(number_in(history(row)%quantity, name, none), row=1, size(history))]
  end function history_values

  !> Every numeric name that any row has.
  recursive subroutine collect_columns(history, column, columns)
    type(history_row_type), intent(in) :: history(:)
    type(quantity_type), allocatable, intent(out) :: column(:)
    type(history_row_type), intent(in), optional :: columns(:)
    integer :: row, i

    if (present(columns) .and. size(history) == 0) then
      call collect_columns(columns, column)
      return
    end if
    allocate (column(0))
    do row = 1, size(history)
      do i = 1, size(history(row)%quantity)
        associate (one => history(row)%quantity(i))
          if (one%kind == quantity_word) cycle
          if (place_of(one%name, column) == 0) column = [column, one]
        end associate
      end do
    end do
  end subroutine collect_columns

  !> `name = value [unit]`, one a line.
  function summary_text(summary) result(words)
    type(quantity_type), intent(in) :: summary(:) !! the answer
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    do i = 1, size(summary)
      words = words//summary(i)%line()//new_line('a')
    end do
  end function summary_text

  !> Saves or restores rows: what a quantity says of its number is not repeated where the row before
  !> says the same.
  pure subroutine visit_rows(archive, rows)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    !> written where the archive restores
    type(history_row_type), allocatable, intent(inout) :: rows(:)
    real(wp), allocatable :: number(:)
    integer, allocatable :: new(:) ! quantities that say something else than those of the row before
    integer :: count, row, known, i

    count = 0
    if (allocated(rows)) count = size(rows)
    call archive%visit_count('rows', count)
    if (.not. archive%saves) then
      if (allocated(rows)) deallocate (rows)
      allocate (rows(count))
    end if
    known = 0
    do row = 1, count
      if (archive%saves) then
        if (.not. allocated(rows(row)%quantity)) allocate (rows(row)%quantity(0))
        number = rows(row)%quantity%number
        new = [(i, i=1, size(number))]
        if (row > 1) new = pack(new, [(is_new(rows(row - 1)%quantity, i, rows(row)%quantity(i)), &
                                       i=1, size(number))])
      end if
      call archive%visit_sized('row', number)
      call archive%visit_sized('new', new)
      if (.not. archive%saves) then
        call archive%require(allocated(number) .and. allocated(new), 'a row')
      end if
      if (.not. archive%saves .and. .not. archive%failed) then
        allocate (rows(row)%quantity(size(number)))
        known = min(known, size(number))
        if (row > 1) rows(row)%quantity(:known) = rows(row - 1)%quantity(:known)
        call archive%require(all(new >= 1 .and. new <= size(number)) .and. &
                             all([(any(new == i), i=known + 1, size(number))]), &
                             'what a row says of its numbers')
        known = size(number)
      end if
      if (archive%failed) return
      do i = 1, size(new)
        call visit_description(archive, rows(row)%quantity(new(i)))
      end do
      rows(row)%quantity%number = number
    end do

  contains

    !> Whether a quantity of a row says something else than that of the row before.
    pure logical function is_new(before, i, quantity)
      type(quantity_type), intent(in) :: before(:), quantity
      integer, intent(in) :: i !! its number in the row
      is_new = i > size(before)
      if (.not. is_new) is_new = .not. are_alike(before(i), quantity)
    end function is_new
  end subroutine visit_rows

  !> Saves or restores arrays.
  pure subroutine visit_arrays(archive, arrays)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    !> written where the archive restores
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    integer :: i, number

    number = 0
    if (allocated(arrays)) number = size(arrays)
    call archive%visit_count('arrays', number)
    if (.not. archive%saves) then
      if (allocated(arrays)) deallocate (arrays)
      allocate (arrays(number))
    end if
    do i = 1, number
      call archive%visit('path', arrays(i)%path)
      call archive%visit('unit', arrays(i)%unit)
      call archive%visit('meaning', arrays(i)%meaning)
      call archive%visit_sized('values', arrays(i)%values)
      call archive%visit('by_step', arrays(i)%by_step)
      call archive%visit('is_column', arrays(i)%is_column)
      call archive%visit('rows', arrays(i)%rows)
      call archive%visit('order', arrays(i)%order)
      if (archive%failed) return
    end do
  end subroutine visit_arrays
end module gfb_case_file
