!> Results by their names: unit and meaning come from the table of names.
module gfb_results
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, number_quantity, count_quantity, word_quantity, &
                          truth_quantity, add_quantity, quantity_number, quantity_count, &
                          quantity_word, quantity_truth
  use gfb_result_names, only: find_result, result_unit, result_meaning
  use gfb_result_table, only: result_type
  implicit none (type, external)
  private
  public :: add_result

  !> Puts a result at the end of a list. A name that the table does not have, or has for values of
  !> another kind, is a mistake in the program, and stops it.
  interface add_result
    module procedure add_number, add_count, add_word, add_truth
  end interface add_result

contains

  !> A real number.
  pure subroutine add_number(list, name, number, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    real(wp), intent(in) :: number                   !! in the table's unit
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning

    call check_kind(name, quantity_number)
    call add_quantity(list, number_quantity(name, number, result_unit(name), &
                                            result_meaning(name, phrase)))
  end subroutine add_number

  !> A whole number.
  pure subroutine add_count(list, name, number, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    integer, intent(in) :: number
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning

    call check_kind(name, quantity_count)
    call add_quantity(list, count_quantity(name, number, result_meaning(name, phrase)))
  end subroutine add_count

  !> A word.
  pure subroutine add_word(list, name, word, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    character(len=*), intent(in) :: word
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning

    call check_kind(name, quantity_word)
    call add_quantity(list, word_quantity(name, word, result_meaning(name, phrase)))
  end subroutine add_word

  !> Yes or no.
  pure subroutine add_truth(list, name, truth, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    logical, intent(in) :: truth
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning

    call check_kind(name, quantity_truth)
    call add_quantity(list, truth_quantity(name, truth, result_meaning(name, phrase)))
  end subroutine add_truth

  !> Stops where the table says that a name has values of another kind.
  pure subroutine check_kind(name, kind)
    character(len=*), intent(in) :: name
    integer, intent(in) :: kind !! `quantity_number`, ...
    type(result_type) :: found

    call find_result(name, found)
    if (found%name /= '' .and. found%kind /= kind) then
      error stop 'a value of another kind than the table says: '//name
    end if
  end subroutine check_kind
end module gfb_results
