!> Rows of named quantities in an HDF5 file, from which they read back as they were.
module gfb_history_store
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_case_file, only: history_row_type
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type
  implicit none (type, external)
  private
  public :: put_rows, read_rows

  character(len=1), parameter :: between = achar(9)      !! the words of a quantity
  character(len=1), parameter :: line_end = new_line('a')
  integer, parameter :: columns = 3 !! of an entry: row, number of its words, value

contains

  !> Adds a group that holds rows.
  subroutine put_rows(file, group, rows)
    type(result_file_type), intent(inout) :: file !! the file being written
    character(len=*), intent(in) :: group !! of the file
    type(history_row_type), intent(in) :: rows(:) !! a row a step or point
    type(quantity_type), allocatable :: known(:)
    real(wp), allocatable :: entry(:, :)
    character(len=:), allocatable :: words
    integer :: row, i, filled, place, entries

    entries = sum([(size(rows(row)%quantity), row=1, size(rows))])
    call file%group(group)
    call file%put_scalar(group//'/rows', real(size(rows), wp), '1', 'number of rows')
    call file%put_scalar(group//'/entries', real(entries, wp), '1', 'numbers in all rows')
    if (entries == 0) return
    allocate (entry(columns, entries), known(0))
    place = 0
    filled = 0
    do row = 1, size(rows)
      do i = 1, size(rows(row)%quantity)
        associate (one => rows(row)%quantity(i))
          call find_words(one, known, place)
          filled = filled + 1
          entry(:, filled) = [real(row, wp), real(place, wp), one%number]
        end associate
      end do
    end do
    words = ''
    do i = 1, size(known)
      words = words//words_of(known(i))
    end do
    call file%put_text(group//'/words', words, &
                       'kind, name, unit, meaning and word of quantities, one a line')
    call file%put_block(group//'/entry', entry(:, :merge(entries, 0, file%first_rank)), 0, &
                        entries, '1', 'row, line of the words, value in its unit')
  end subroutine put_rows

  !> Looks for a quantity's words from the last place on, where rows that are alike have them; adds
  !> them where they are new.
  subroutine find_words(one, known, place)
    type(quantity_type), intent(in) :: one
    type(quantity_type), allocatable, intent(inout) :: known(:)
    integer, intent(inout) :: place
    integer :: i

    do i = 1, size(known)
      place = modulo(place, size(known)) + 1
      if (is_alike(known(place), one)) return
    end do
    known = [known, one]
    place = size(known)
  end subroutine find_words

  !> Whether all but the value of two quantities is the same.
  pure function is_alike(one, other) result(alike)
    type(quantity_type), intent(in) :: one, other
    logical :: alike

    alike = one%kind == other%kind .and. one%name == other%name .and. one%unit == other%unit .and. &
      one%meaning == other%meaning .and. one%word == other%word
  end function is_alike

  !> The words of a quantity as a line.
  pure function words_of(one) result(line)
    type(quantity_type), intent(in) :: one
    character(len=:), allocatable :: line

    line = text(one%kind)//between//one%name//between//one%unit//between//one%meaning//between// &
      one%word//line_end
  end function words_of

  !> Reads a group that holds rows; none where something cannot be read.
  subroutine read_rows(file, group, rows)
    type(stored_file_type), intent(inout) :: file !! the file being read
    character(len=*), intent(in) :: group !! of the file
    type(history_row_type), allocatable, intent(out) :: rows(:) !! a row a step or point
    type(quantity_type), allocatable :: known(:)
    type(quantity_type) :: one
    real(wp), allocatable :: entry(:, :)
    integer :: i, entries

    allocate (rows(max(0, file%count(group//'/rows'))))
    do i = 1, size(rows)
      allocate (rows(i)%quantity(0))
    end do
    entries = file%count(group//'/entries')
    if (entries < 1 .or. file%failed) return
    call read_words(file%words(group//'/words'), known, file%failed)
    entry = file%block(group//'/entry', columns, 0, entries)
    if (any(nint(entry(1, :)) < 1 .or. nint(entry(1, :)) > size(rows) .or. &
            nint(entry(2, :)) < 1 .or. nint(entry(2, :)) > size(known))) file%failed = .true.
    if (file%failed) return
    do i = 1, entries
      one = known(nint(entry(2, i)))
      one%number = entry(3, i)
      associate (row => rows(nint(entry(1, i))))
        row%quantity = [row%quantity, one]
      end associate
    end do
  end subroutine read_rows

  !> Takes the lines of quantities' words apart.
  subroutine read_words(words, known, failed)
    character(len=*), intent(in) :: words
    type(quantity_type), allocatable, intent(out) :: known(:)
    logical, intent(inout) :: failed !! they are none
    type(quantity_type) :: one
    character(len=:), allocatable :: kind_words
    integer :: place, status

    allocate (known(0))
    place = 1
    do while (place <= len(words))
      kind_words = next_word(words, place, between)
      read (kind_words, *, iostat=status) one%kind
      if (status /= 0) failed = .true.
      one%name = next_word(words, place, between)
      one%unit = next_word(words, place, between)
      one%meaning = next_word(words, place, between)
      one%word = next_word(words, place, line_end)
      known = [known, one]
    end do
  end subroutine read_words

  !> What stands from a place on before the next separator; the place moves behind that.
  function next_word(words, place, separator) result(word)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: place
    character(len=1), intent(in) :: separator
    character(len=:), allocatable :: word
    integer :: length

    length = index(words(min(place, len(words) + 1):), separator) - 1
    if (length < 0) length = max(0, len(words) + 1 - place)
    word = words(place:place + length - 1)
    place = place + length + 1
  end function next_word
end module gfb_history_store
