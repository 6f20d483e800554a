!> Keys, results and words of the field whose names or meanings have a word that is no name itself.
module gfb_meaning_search
  use gfb_key_book, only: key_type
  use gfb_result_table, only: result_rows
  use gfb_text, only: lower_case, plain_text
  use gfb_field_words, only: field_word_type, field_word_rows, first_word
  implicit none (type, external)
  private
  public :: found_by_meaning, speaks_of

  integer, parameter :: shortest = 3 !! characters of a word that is looked for: 'of' is everywhere
  character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz0123456789'
  character(len=1), parameter :: next = new_line('a')

contains

  !> Every key, result and word of the field that speaks of what is asked for, on a line each;
  !> empty where none does.
  pure function found_by_meaning(asked, keys) result(words)
    character(len=*), intent(in) :: asked !! one word or more
    type(key_type), intent(in) :: keys(:)
    character(len=:), allocatable :: words, name, meaning
    type(field_word_type), allocatable :: rows(:)
    integer :: i

    words = ''
    rows = field_word_rows()
    do i = 1, size(rows)
      name = trim(rows(i)%words)
      meaning = trim(rows(i)%meaning)
      if (speaks_of(name//' '//meaning, asked)) then
        words = words//'topic  '//first_word(rows(i))//': '//meaning//next
      end if
    end do
    do i = 1, size(keys)
      name = trim(keys(i)%group)//'%'//trim(keys(i)%name)
      meaning = plain_text(keys(i)%meaning)
      if (speaks_of(name//' '//meaning, asked)) words = words//'key    '//name//': '//meaning//next
    end do
    do i = 1, size(result_rows)
      name = trim(result_rows(i)%name)
      meaning = plain_text(without_braces(trim(result_rows(i)%meaning)))
      if (speaks_of(name//' '//meaning//' '//trim(result_rows(i)%manual), asked)) then
        words = words//'result '//name//': '//meaning//next
      end if
    end do
  end function found_by_meaning

  !> Whether a word of the text begins with each of the words asked for, in capitals or not.
  pure logical function speaks_of(text, asked) result(speaks)
    character(len=*), intent(in) :: text, asked
    character(len=:), allocatable :: here, left
    integer :: last

    here = ' '//separated(text)
    left = trim(adjustl(separated(asked)))//' '
    speaks = len_trim(left) >= shortest
    do while (speaks .and. left /= '')
      last = index(left, ' ')
      speaks = index(here, ' '//left(:last - 1)) > 0
      left = adjustl(left(last:))
    end do
  end function speaks_of

  !> A text in small letters, with a blank in the place of whatever is no letter and no digit.
  pure function separated(text) result(words)
    character(len=*), intent(in) :: text
    character(len=len(text)) :: words
    integer :: i

    words = lower_case(text)
    do i = 1, len(words)
      if (index(letters, words(i:i)) == 0) words(i:i) = ' '
    end do
  end function separated

  !> A meaning with what stands between its braces, which is what it says by itself.
  pure function without_braces(meaning) result(words)
    character(len=*), intent(in) :: meaning
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    do i = 1, len(meaning)
      if (scan(meaning(i:i), '{}') == 0) words = words//meaning(i:i)
    end do
  end function without_braces
end module gfb_meaning_search
