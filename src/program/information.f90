!> What the program tells of itself, without a case.
module gfb_information
  use gfb_errors, only: error_type, fail
  use gfb_key_book, only: key_type, no_default
  use gfb_result_names, only: find_result, result_words, row_names, results_text
  use gfb_result_table, only: result_type
  use gfb_scene_reading, only: all_keys, key_table
  use gfb_text, only: lower_case, nearest_word, plain_text
  use gfb_case_template, only: template_text
  use gfb_command_line, only: command_line_type, help_text
  use gfb_provenance, only: version_text
  implicit none (type, external)
  private
  public :: information

  character(len=1), parameter :: next = new_line('a')
  integer, parameter :: longest_name = 64

contains

  !> All that is known of a word: keys of that name, keys of the group, the result.
  !>
  !> Fails with the names that are near where there is none.
  subroutine explanation(asked, words, error)
    character(len=*), intent(in) :: asked !! as typed: `group%key`, key, group or result
    character(len=:), allocatable, intent(out) :: words !! to be printed
    type(error_type), allocatable, intent(out) :: error !! why nothing is known
    type(key_type), allocatable :: keys(:)
    type(result_type) :: row
    character(len=:), allocatable :: name
    integer :: i

    name = lower_case(trim(asked))
    if (index(name, '&') == 1) name = name(2:)
    keys = all_keys()
    words = ''
    do i = 1, size(keys)
      if (keys(i)%group == name) words = words//key_line(keys(i))
    end do
    if (words /= '') words = '&'//name//' has the keys'//next//words
    do i = 1, size(keys)
      if (name == keys(i)%name .or. name == trim(keys(i)%group)//'%'//trim(keys(i)%name)) then
        words = words//key_words(keys(i))
      end if
    end do
    call find_result(name, row)
    if (row%name /= '') words = words//result_words(name)
    if (words /= '') then
      words = words(:len(words) - 1)
    else
      call fail(error, 'gfb: there is no key, group or result '//trim(asked)//near(name, keys)// &
                '; gfb --keys and gfb --results have all')
    end if
  end subroutine explanation

  !> A key on one line.
  pure function key_line(one) result(words)
    type(key_type), intent(in) :: one
    character(len=:), allocatable :: words

    words = '  '//trim(one%name)
    if (one%unit /= '' .and. one%unit /= '1') words = words//' ['//one%unit//']'
    words = words//': '//plain_text(one%meaning)//next
  end function key_line

  !> All that is known of a key.
  pure function key_words(one) result(words)
    type(key_type), intent(in) :: one
    character(len=:), allocatable :: words

    words = 'key '//trim(one%name)//' of &'//trim(one%group)//next// &
            '  meaning  '//plain_text(one%meaning)//next// &
            '  value    '//plain_text(one%type_words)//next
    if (one%unit /= '' .and. one%unit /= '1') then
      words = words//'  unit     '//one%unit//next
    end if
    if (one%shown_default == no_default) then
      words = words//'  default  none'//next
    else
      words = words//'  default  '//plain_text(one%shown_default)//next
    end if
  end function key_words

  !> The names that are nearest to an unknown one, as a question.
  pure function near(name, keys) result(words)
    character(len=*), intent(in) :: name
    type(key_type), intent(in) :: keys(:)
    character(len=:), allocatable :: words
    character(len=longest_name) :: full(size(keys)), short(size(keys))
    character(len=:), allocatable :: found(:)
    integer :: i

    do i = 1, size(keys)
      full(i) = trim(keys(i)%group)//'%'//trim(keys(i)%name)
      short(i) = keys(i)%name
    end do
    found = [character(len=longest_name) :: nearest_word(name, full), nearest_word(name, short), &
             nearest_word(name, row_names())]
    words = ''
    do i = 1, size(found)
      if (found(i) == '' .or. any(found(:i - 1) == found(i))) cycle
      if (words /= '') words = words//' or'
      words = words//' '//trim(found(i))
    end do
    if (words /= '') words = ', did you mean'//words//'?'
  end function near

  !> The text that is asked for; empty where a case is to be computed.
  !>
  !> Fails where nothing is known of what is asked for.
  subroutine information(line, words, error)
    type(command_line_type), intent(in) :: line !! what was typed
    character(len=:), allocatable, intent(out) :: words !! to be printed
    type(error_type), allocatable, intent(out) :: error !! why there is none

    words = ''
    if (line%help) then
      words = help_text()
    else if (line%version) then
      words = version_text()
    else if (line%keys) then
      words = key_table()
    else if (line%results) then
      words = results_text()
    else if (line%template /= '') then
      call template_text(line%template, words, error)
    else if (line%explain /= '') then
      call explanation(line%explain, words, error)
    end if
  end subroutine information
end module gfb_information
