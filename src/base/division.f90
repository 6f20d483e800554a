!> Things in a row, divided as evenly as can be among some that take a block each.
module gfb_division
  implicit none (type, external)
  private
  public :: block_ends, owner_of

contains

  !> First and last number of one's block; the first few take one more where it does not come out
  !> even, and there is nothing (a last before the first) for some where things are too few.
  pure function block_ends(items, takers, taker) result(ends)
    integer, intent(in) :: items  !! in the row, numbered from 1
    integer, intent(in) :: takers !! among whom they are shared
    integer, intent(in) :: taker  !! number of the one asked about, from 1
    integer :: ends(2)

    associate (each => items/takers, more => modulo(items, takers))
      ends(1) = (taker - 1)*each + min(taker - 1, more) + 1
      ends(2) = taker*each + min(taker, more)
    end associate
  end function block_ends

  !> Who takes a thing of the row.
  pure integer function owner_of(item, items, takers) result(taker)
    integer, intent(in) :: item !! number in the row, from 1
    integer, intent(in) :: items, takers !! what is shared, and among how many

    associate (each => items/takers, more => modulo(items, takers))
      if (item <= more*(each + 1)) then
        taker = (item - 1)/(each + 1) + 1
      else
        taker = more + (item - more*(each + 1) - 1)/each + 1
      end if
    end associate
  end function owner_of
end module gfb_division
