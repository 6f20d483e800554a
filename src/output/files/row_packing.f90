!> Rows of a history and arrays as one text, to be sent from one group of ranks to another.
!>
!> Every number stands there with all its bits, so that nothing is rounded on the way.
module gfb_row_packing
  use gfb_kinds, only: wp, long
  use gfb_quantity, only: quantity_type
  use gfb_case_file, only: history_row_type, case_array_type
  implicit none (type, external)
  private
  public :: pack_rows, unpack_rows, pack_arrays, unpack_arrays

  integer, parameter :: number_length = 16 !! hexadecimal digits of a number
  integer, parameter :: count_length = 10  !! digits of a length or count

contains

  !> Rows as a text.
  pure function pack_rows(rows) result(words)
    type(history_row_type), intent(in) :: rows(:)
    character(len=:), allocatable :: words
    character(len=:), allocatable :: row
    integer :: i, k

    words = count_text(size(rows))
    do i = 1, size(rows)
      row = count_text(size(rows(i)%quantity))
      do k = 1, size(rows(i)%quantity)
        associate (one => rows(i)%quantity(k))
          row = row//with_length(one%name)//with_length(one%unit)//with_length(one%meaning)// &
            count_text(one%kind)//number_text(one%number)//with_length(one%word)
        end associate
      end do
      words = words//row
    end do
  end function pack_rows

  !> The rows of a text.
  pure subroutine unpack_rows(words, rows)
    character(len=*), intent(in) :: words
    type(history_row_type), allocatable, intent(out) :: rows(:)
    integer :: i, k, at, number

    at = 1
    call take_count(words, at, number)
    allocate (rows(number))
    do i = 1, size(rows)
      call take_count(words, at, number)
      allocate (rows(i)%quantity(number))
      do k = 1, number
        associate (one => rows(i)%quantity(k))
          call take_words(words, at, one%name)
          call take_words(words, at, one%unit)
          call take_words(words, at, one%meaning)
          call take_count(words, at, one%kind)
          call take_number(words, at, one%number)
          call take_words(words, at, one%word)
        end associate
      end do
    end do
  end subroutine unpack_rows

  !> Arrays as a text.
  pure function pack_arrays(arrays) result(words)
    type(case_array_type), intent(in) :: arrays(:)
    character(len=:), allocatable :: words
    character(len=:), allocatable :: numbers
    integer :: i, k, column, row

    words = count_text(size(arrays))
    do i = 1, size(arrays)
      associate (one => arrays(i))
        words = words//with_length(one%path)//with_length(one%unit)//with_length(one%meaning)// &
          count_text(merge(1, 0, one%by_step))//count_text(size(one%values, 1))// &
          count_text(size(one%values, 2))
        if (allocated(numbers)) deallocate (numbers)
        allocate (character(len=number_length*size(one%values)) :: numbers)
        k = 0
        do row = 1, size(one%values, 2)
          do column = 1, size(one%values, 1)
            numbers(k + 1:k + number_length) = number_text(one%values(column, row))
            k = k + number_length
          end do
        end do
        words = words//numbers
      end associate
    end do
  end function pack_arrays

  !> The arrays of a text.
  pure subroutine unpack_arrays(words, arrays)
    character(len=*), intent(in) :: words
    type(case_array_type), allocatable, intent(out) :: arrays(:)
    integer :: i, at, number, columns, rows, column, row

    at = 1
    call take_count(words, at, number)
    allocate (arrays(number))
    do i = 1, size(arrays)
      associate (one => arrays(i))
        call take_words(words, at, one%path)
        call take_words(words, at, one%unit)
        call take_words(words, at, one%meaning)
        call take_count(words, at, number)
        one%by_step = number == 1
        call take_count(words, at, columns)
        call take_count(words, at, rows)
        allocate (one%values(columns, rows))
        do row = 1, rows
          do column = 1, columns
            call take_number(words, at, one%values(column, row))
          end do
        end do
      end associate
    end do
  end subroutine unpack_arrays

  !> A word with its length before it.
  pure function with_length(word) result(words)
    character(len=*), intent(in) :: word
    character(len=:), allocatable :: words
    words = count_text(len(word))//word
  end function with_length

  !> A count, of a fixed length.
  pure function count_text(number) result(words)
    integer, intent(in) :: number
    character(len=count_length) :: words
    write (words, '(i10)') number
  end function count_text

  !> The bits of a number.
  pure function number_text(number) result(words)
    real(wp), intent(in) :: number
    character(len=number_length) :: words
    write (words, '(z16.16)') transfer(number, 0_long)
  end function number_text

  !> Takes the next count off a text.
  pure subroutine take_count(words, at, number)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: at !! where it begins; then, where the next begins
    integer, intent(out) :: number

    read (words(at:at + count_length - 1), '(i10)') number
    at = at + count_length
  end subroutine take_count

  !> Takes the next number off a text.
  pure subroutine take_number(words, at, number)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: at
    real(wp), intent(out) :: number
    integer(long) :: bits

    read (words(at:at + number_length - 1), '(z16)') bits
    number = transfer(bits, number)
    at = at + number_length
  end subroutine take_number

  !> Takes the next word, its length before it, off a text.
  pure subroutine take_words(words, at, word)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: at
    character(len=:), allocatable, intent(out) :: word
    integer :: length

    call take_count(words, at, length)
    word = words(at:at + length - 1)
    at = at + length
  end subroutine take_words
end module gfb_row_packing
