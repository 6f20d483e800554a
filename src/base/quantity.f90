!> One named answer with its unit and meaning.
module gfb_quantity
  use gfb_kinds, only: wp
  use gfb_text, only: exact_text, text
  use gfb_archive, only: archive_type
  implicit none (type, external)
  private
  public :: number_quantity, add_quantity, place_of, number_in, visit_description, are_alike

  integer, parameter, public :: quantity_number = 1, quantity_count = 2, quantity_word = 3, &
                                quantity_truth = 4

  !> A number, a count, a word or a truth.
  type, public :: quantity_type
    character(len=:), allocatable :: name
    character(len=:), allocatable :: unit    !! SI, or '1'; empty for words
    character(len=:), allocatable :: meaning !! one line
    integer :: kind = quantity_number
    real(wp) :: number = 0.0_wp              !! in `unit`; a count or a truth (1, 0) too
    character(len=:), allocatable :: word
  contains
    procedure :: line => quantity_line
  end type quantity_type

  !> Puts one or several at the end of a list. An array constructor whose items are functions of
  !> this type does the same, but gfortran never frees what such items hold.
  interface add_quantity
    module procedure add_one, add_many
  end interface add_quantity

contains

  !> A real number.
  pure function number_quantity(name, number, unit, meaning) result(quantity)
    character(len=*), intent(in) :: name    !! of the result
    real(wp), intent(in) :: number          !! its value, in `unit` [SI]
    character(len=*), intent(in) :: unit    !! of SI, or '1'
    character(len=*), intent(in) :: meaning !! what the number is, in one line
    type(quantity_type) :: quantity
    quantity = quantity_type(name, unit, meaning, quantity_number, number, '')
  end function number_quantity

  !> Puts a quantity at the end of a list.
  pure subroutine add_one(list, quantity)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    type(quantity_type), intent(in) :: quantity

    if (allocated(list)) then
      list = [list, quantity]
    else
      list = [quantity]
    end if
  end subroutine add_one

  !> Puts quantities at the end of a list.
  pure subroutine add_many(list, quantities)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    type(quantity_type), intent(in) :: quantities(:)

    if (allocated(list)) then
      list = [list, quantities]
    else
      list = quantities
    end if
  end subroutine add_many

  !> Place of a name in a list; 0 where it is not there.
  pure integer function place_of(name, list) result(place)
    character(len=*), intent(in) :: name !! of a result
    type(quantity_type), intent(in) :: list(:) !! without a name twice

    do place = size(list), 1, -1
      if (list(place)%name == name) return
    end do
  end function place_of

  !> The number of a name in a list [its unit].
  pure real(wp) function number_in(list, name, missing) result(number)
    type(quantity_type), intent(in) :: list(:) !! without a name twice
    character(len=*), intent(in) :: name !! of a result
    real(wp), intent(in), optional :: missing !! where the name is not there; default: 0 [its unit]
    integer :: place

    number = 0.0_wp
    if (present(missing)) number = missing
    place = place_of(name, list)
    if (place > 0) number = list(place)%number
  end function number_in

  !> `name = value [unit]`; the number reads back exactly.
  pure function quantity_line(self) result(line)
    class(quantity_type), intent(in) :: self !! the quantity
    character(len=:), allocatable :: line

    select case (self%kind)
    case (quantity_word)
      line = self%name//' = '//self%word
    case (quantity_truth)
      line = self%name//' = '//trim(merge('true ', 'false', self%number > 0.5_wp))
    case (quantity_count)
      line = self%name//' = '//text(nint(self%number))//' [1]'
    case default
      line = self%name//' = '//exact_text(self%number)//' ['//self%unit//']'
    end select
  end function quantity_line

  !> Whether all but the number of two quantities is the same; Fortran takes blanks at the end for
  !> nothing.
  pure logical function are_alike(one, other) result(alike)
    type(quantity_type), intent(in) :: one, other !! any two

    alike = one%kind == other%kind .and. one%name == other%name .and. one%unit == other%unit .and. &
      one%meaning == other%meaning .and. one%word == other%word
    if (alike) alike = len(one%meaning) == len(other%meaning) .and. len(one%word) == len(other%word)
  end function are_alike

  !> Saves or restores all but the number of a quantity.
  pure subroutine visit_description(archive, quantity)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(quantity_type), intent(inout) :: quantity !! written where the archive restores

    call archive%visit('name', quantity%name)
    call archive%visit('unit', quantity%unit)
    call archive%visit('meaning', quantity%meaning)
    call archive%visit('kind', quantity%kind)
    call archive%visit('word', quantity%word)
    if (archive%saves) return
    call archive%require(allocated(quantity%name) .and. allocated(quantity%unit) .and. &
                         allocated(quantity%meaning) .and. allocated(quantity%word), &
                         'the words of a quantity')
  end subroutine visit_description
end module gfb_quantity
