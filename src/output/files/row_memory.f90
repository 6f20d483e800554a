!> How rows of a history and arrays are packed and unpacked: for restart files, between groups.
module gfb_row_memory
  use gfb_kinds, only: wp
  use gfb_memory, only: memory_type
  use gfb_quantity, only: quantity_type
  use gfb_case_file, only: history_row_type, case_array_type
  implicit none (type, external)
  private
  public :: remember_rows, remember_arrays

contains

  !> Packs or unpacks rows: what rows that are alike say of their numbers is packed once.
  pure subroutine remember_rows(memory, rows)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    !> written where the memory unpacks
    type(history_row_type), allocatable, intent(inout) :: rows(:)
    type(quantity_type), allocatable :: known(:)
    real(wp), allocatable :: number(:)
    integer, allocatable :: length(:), which(:)
    integer :: i, described

    if (memory%packs) call take_apart(rows, length, which, number, known)
    call memory%visit_sized('row_lengths', length)
    call memory%visit_sized('descriptions', which)
    call memory%visit_sized('numbers', number)
    described = 0
    if (memory%packs) described = size(known)
    call memory%visit('number_of_descriptions', described)
    if (memory%failed) return
    if (.not. memory%packs) allocate (known(max(0, min(described, size(number)))))
    do i = 1, size(known)
      call remember_description(memory, known(i))
      if (memory%failed) return
    end do
    if (memory%packs) return
    memory%failed = any(length < 0) .or. any(which < 1) .or. any(which > size(known)) .or. &
      sum(length) /= size(which) .or. size(number) /= size(which)
    if (.not. memory%failed) call put_together(length, which, number, known, rows)
  end subroutine remember_rows

  !> Packs or unpacks all but the number of a quantity.
  pure subroutine remember_description(memory, one)
    type(memory_type), intent(inout) :: memory
    type(quantity_type), intent(inout) :: one !! written where the memory unpacks

    call memory%visit('name', one%name)
    call memory%visit('unit', one%unit)
    call memory%visit('meaning', one%meaning)
    call memory%visit('kind', one%kind)
    call memory%visit('word', one%word)
  end subroutine remember_description

  !> Lists of all numbers of rows and of what is said of them.
  pure subroutine take_apart(rows, length, which, number, known)
    type(history_row_type), allocatable, intent(in) :: rows(:)
    integer, allocatable, intent(out) :: length(:) !! quantities of each row
    integer, allocatable, intent(out) :: which(:)  !! number of each quantity's description
    real(wp), allocatable, intent(out) :: number(:) !! of each quantity, in its unit
    type(quantity_type), allocatable, intent(out) :: known(:) !! descriptions
    integer :: row, i, filled, at

    allocate (length(0), known(0))
    if (allocated(rows)) length = [(lengths(rows(row)), row=1, size(rows))]
    allocate (which(sum(length)), number(sum(length)))
    filled = 0
    at = 0
    do row = 1, size(length)
      do i = 1, length(row)
        filled = filled + 1
        call find_description(rows(row)%quantity(i), known, at)
        which(filled) = at
        number(filled) = rows(row)%quantity(i)%number
      end do
    end do
  end subroutine take_apart

  !> Quantities of a row.
  pure function lengths(row) result(length)
    type(history_row_type), intent(in) :: row
    integer :: length

    length = 0
    if (allocated(row%quantity)) length = size(row%quantity)
  end function lengths

  !> The reverse of `take_apart`.
  pure subroutine put_together(length, which, number, known, rows)
    integer, intent(in) :: length(:) !! quantities of each row
    integer, intent(in) :: which(:)  !! number of each quantity's description
    real(wp), intent(in) :: number(:) !! of each quantity, in its unit
    type(quantity_type), intent(in) :: known(:) !! descriptions
    type(history_row_type), allocatable, intent(out) :: rows(:)
    integer :: row, i, filled

    allocate (rows(size(length)))
    filled = 0
    do row = 1, size(rows)
      allocate (rows(row)%quantity(length(row)))
      do i = 1, length(row)
        filled = filled + 1
        rows(row)%quantity(i) = known(which(filled))
        rows(row)%quantity(i)%number = number(filled)
      end do
    end do
  end subroutine put_together

  !> Looks for a quantity's description from the last one on, where rows that are alike have it;
  !> adds it where it is new.
  pure subroutine find_description(one, known, at)
    type(quantity_type), intent(in) :: one
    type(quantity_type), allocatable, intent(inout) :: known(:)
    integer, intent(inout) :: at
    integer :: i

    do i = 1, size(known)
      at = modulo(at, size(known)) + 1
      if (is_alike(known(at), one)) return
    end do
    known = [known, one]
    at = size(known)
  end subroutine find_description

  !> Whether all but the number of two quantities is the same.
  pure function is_alike(one, other) result(alike)
    type(quantity_type), intent(in) :: one, other
    logical :: alike

    alike = one%kind == other%kind .and. one%name == other%name .and. one%unit == other%unit .and. &
      one%meaning == other%meaning .and. one%word == other%word
    ! Fortran takes blanks at the end for nothing.
    if (alike) alike = len(one%meaning) == len(other%meaning) .and. len(one%word) == len(other%word)
  end function is_alike

  !> Packs or unpacks arrays.
  pure subroutine remember_arrays(memory, arrays)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    !> written where the memory unpacks
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    integer :: i, number

    number = 0
    if (allocated(arrays)) number = size(arrays)
    call memory%visit('number_of_arrays', number)
    if (memory%failed) return
    if (.not. memory%packs) then
      if (allocated(arrays)) deallocate (arrays)
      allocate (arrays(max(0, number)))
    end if
    do i = 1, number
      call memory%visit('path', arrays(i)%path)
      call memory%visit('unit', arrays(i)%unit)
      call memory%visit('meaning', arrays(i)%meaning)
      call memory%visit_sized('values', arrays(i)%values)
      call memory%visit('by_step', arrays(i)%by_step)
      call memory%visit('rows', arrays(i)%rows)
      call memory%visit('order', arrays(i)%order)
      if (memory%failed) return
    end do
  end subroutine remember_arrays
end module gfb_row_memory
