!> What a run remembers, component by component: one routine of a type both packs and unpacks it.
!>
!> The routine of a type visits each component under its name:
!> `call memory%visit('load', point%load)`. While a memory packs, a visit adds a line with name,
!> kind and shape to the memory's words and the values, with all their bits, to its numbers; a text
!> follows its line. While it unpacks, a visit takes both off again, in the same order. A component
!> that does not fit, and every one after it, stays as it was and leaves `failed` behind.
module gfb_memory
  use gfb_kinds, only: wp, long
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: open_memory

  character(len=1), parameter :: line_end = new_line('a')
  character(len=*), parameter :: missing = ' none' !! instead of the shape of what is not allocated

  !> Numbers, and words that say what they are. A new one packs.
  type, public :: memory_type
    logical :: packs = .true.   !! otherwise it unpacks
    logical :: failed = .false. !! something did not fit while it was unpacked
    real(wp), allocatable, private :: number(:)          !! with room for more while it packs
    character(len=:), allocatable, private :: letters    !! with room for more while it packs
    integer, private :: numbers_done = 0, letters_done = 0 !! packed or unpacked so far
  contains
    procedure :: part
    !> Packs or unpacks a component whose shape is known; a text is of any length.
    generic :: visit => visit_real, visit_reals, visit_matrix, visit_integer, &
      visit_integer_matrix, visit_logical, visit_text
    !> Packs or unpacks an allocatable array with its shape.
    generic :: visit_sized => visit_sized_reals, visit_sized_matrix, visit_sized_integers
    procedure :: is_used_up
    procedure :: finish
    procedure :: numbers
    procedure :: words
    procedure, private :: visit_real, visit_reals, visit_matrix, visit_integer, &
      visit_integer_matrix, visit_logical, visit_text
    procedure, private :: visit_sized_reals, visit_sized_matrix, visit_sized_integers
    procedure, private :: pass_line, pass_shape, pass_numbers, pass_whole_numbers
    procedure, private :: add_letters, next_line
  end type memory_type

contains

  !> Begins to unpack.
  pure subroutine open_memory(numbers, words, memory)
    real(wp), intent(in) :: numbers(:) !! as `numbers` gave them, each in its component's unit [SI]
    character(len=*), intent(in) :: words !! as `words` gave them
    type(memory_type), intent(out) :: memory !! unpacks these, from the first on

    memory%packs = .false.
    memory%number = numbers
    memory%letters = words
  end subroutine open_memory

  !> All numbers that were packed.
  pure function numbers(self) result(list)
    class(memory_type), intent(in) :: self !! the memory
    real(wp), allocatable :: list(:) !! each in its component's unit

    allocate (list(0))
    if (allocated(self%number)) list = self%number(:self%numbers_done)
  end function numbers

  !> Names, kinds and shapes that were packed, one a line, and the texts.
  pure function words(self) result(lines)
    class(memory_type), intent(in) :: self !! the memory
    character(len=:), allocatable :: lines

    lines = ''
    if (allocated(self%letters)) lines = self%letters(:self%letters_done)
  end function words

  !> Whether all that was packed has been taken.
  pure function is_used_up(self) result(empty)
    class(memory_type), intent(in) :: self !! the memory
    logical :: empty
    empty = self%numbers_done == size(self%number) .and. self%letters_done == len(self%letters)
  end function is_used_up

  !> Ends unpacking: something that is left over does not fit either.
  pure subroutine finish(self)
    class(memory_type), intent(inout) :: self !! the memory

    if (.not. self%packs) self%failed = self%failed .or. .not. self%is_used_up()
  end subroutine finish

  !> Says whose components follow, where a memory holds several of a type.
  pure subroutine part(self, name)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the part
    call self%pass_line('in '//name)
  end subroutine part

  !> A real number.
  pure subroutine visit_real(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    real(wp), intent(inout) :: value !! written on unpacking, in its unit [SI]
    real(wp) :: number(1)

    number = value
    call self%pass_line(name//' real')
    call self%pass_numbers(number)
    value = number(1)
  end subroutine visit_real

  !> Real numbers.
  pure subroutine visit_reals(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    real(wp), intent(inout) :: value(:) !! written on unpacking, in its unit [SI]

    call self%pass_line(name//' real'//extents(shape(value)))
    call self%pass_numbers(value)
  end subroutine visit_reals

  !> A matrix of real numbers.
  pure subroutine visit_matrix(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name   !! of the component
    real(wp), intent(inout) :: value(:, :) !! written on unpacking, in its unit [SI]
    real(wp) :: number(size(value))

    number = reshape(value, shape(number))
    call self%pass_line(name//' real'//extents(shape(value)))
    call self%pass_numbers(number)
    value = reshape(number, shape(value))
  end subroutine visit_matrix

  !> A whole number.
  pure subroutine visit_integer(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    integer, intent(inout) :: value !! written on unpacking
    integer :: number(1)

    number = value
    call self%pass_line(name//' integer')
    call self%pass_whole_numbers(number)
    value = number(1)
  end subroutine visit_integer

  !> A matrix of whole numbers.
  pure subroutine visit_integer_matrix(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    integer, intent(inout) :: value(:, :)
    integer :: number(size(value))

    number = reshape(value, shape(number))
    call self%pass_line(name//' integer'//extents(shape(value)))
    call self%pass_whole_numbers(number)
    value = reshape(number, shape(value))
  end subroutine visit_integer_matrix

  !> Yes or no.
  pure subroutine visit_logical(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    logical, intent(inout) :: value
    integer :: number(1)

    number = merge(1, 0, value)
    call self%pass_line(name//' logical')
    call self%pass_whole_numbers(number)
    value = number(1) /= 0
  end subroutine visit_logical

  !> A text of any length, or none.
  pure subroutine visit_text(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    character(len=:), allocatable, intent(inout) :: value
    integer :: length(1)
    logical :: there

    there = allocated(value)
    length = 0
    if (there) length = len(value)
    call self%pass_shape(name//' text', length, there)
    if (self%packs) then
      if (there) call self%add_letters(value//line_end)
      return
    end if
    if (self%failed) return
    if (allocated(value)) deallocate (value)
    if (.not. there) return
    if (length(1) + 1 > len(self%letters) - self%letters_done) then
      self%failed = .true.
      return
    end if
    value = self%letters(self%letters_done + 1:self%letters_done + length(1))
    self%letters_done = self%letters_done + length(1) + 1
  end subroutine visit_text

  !> Real numbers, as many as there are.
  pure subroutine visit_sized_reals(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name                !! of the component
    real(wp), allocatable, intent(inout) :: value(:) !! allocated on unpacking, in its unit [SI]
    integer :: extent(1)
    logical :: there

    there = allocated(value)
    extent = 0
    if (there) extent = shape(value)
    call self%pass_shape(name//' real', extent, there)
    if (self%failed) return
    if (.not. self%packs) then
      if (allocated(value)) deallocate (value)
      if (there) allocate (value(extent(1)))
    end if
    if (there) call self%pass_numbers(value)
  end subroutine visit_sized_reals

  !> A matrix of real numbers, as large as it is.
  pure subroutine visit_sized_matrix(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name                   !! of the component
    real(wp), allocatable, intent(inout) :: value(:, :) !! allocated on unpacking, in its unit [SI]
    real(wp), allocatable :: number(:)
    integer :: extent(2)
    logical :: there

    there = allocated(value)
    extent = 0
    if (there) extent = shape(value)
    call self%pass_shape(name//' real', extent, there)
    if (self%failed) return
    if (.not. self%packs) then
      if (allocated(value)) deallocate (value)
      if (there) allocate (value(extent(1), extent(2)))
    end if
    if (.not. there) return
    number = reshape(value, [size(value)])
    call self%pass_numbers(number)
    value = reshape(number, extent)
  end subroutine visit_sized_matrix

  !> Whole numbers, as many as there are.
  pure subroutine visit_sized_integers(self, name, value)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: name !! of the component
    integer, allocatable, intent(inout) :: value(:) !! allocated on unpacking
    integer :: extent(1)
    logical :: there

    there = allocated(value)
    extent = 0
    if (there) extent = shape(value)
    call self%pass_shape(name//' integer', extent, there)
    if (self%failed) return
    if (.not. self%packs) then
      if (allocated(value)) deallocate (value)
      if (there) allocate (value(extent(1)))
    end if
    if (there) call self%pass_whole_numbers(value)
  end subroutine visit_sized_integers

  !> Adds a line, or takes the next one, which must be the same.
  pure subroutine pass_line(self, line)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: line !! name, kind and shape

    if (self%packs) then
      call self%add_letters(line//line_end)
    else if (.not. self%failed) then
      self%failed = self%next_line() /= line
      if (.not. self%failed) self%letters_done = self%letters_done + len(line) + 1
    end if
  end subroutine pass_line

  !> Adds a line with a shape, or takes the next one, which must be the same but for the extents.
  pure subroutine pass_shape(self, start, extent, there)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: start !! name and kind
    integer, intent(inout) :: extent(:)   !! read while the memory unpacks
    logical, intent(inout) :: there       !! it is allocated; read while the memory unpacks
    character(len=:), allocatable :: line
    integer :: status

    if (self%packs) then
      line = start//missing
      if (there) line = start//extents(extent)
      call self%add_letters(line//line_end)
      return
    end if
    if (self%failed) return
    line = self%next_line()
    there = line /= start//missing
    extent = 0
    if (there) then
      status = 1
      if (index(line, start//' ') == 1) read (line(len(start) + 1:), *, iostat=status) extent
      if (status /= 0) extent = -1
      self%failed = any(extent < 0) .or. line /= start//extents(extent)
      if (index(start, ' text') == 0) self%failed = self%failed .or. &
        product(int(extent, long)) > size(self%number) - self%numbers_done
    end if
    if (.not. self%failed) self%letters_done = self%letters_done + len(line) + 1
  end subroutine pass_shape

  !> Adds numbers, or takes the next ones.
  pure subroutine pass_numbers(self, value)
    class(memory_type), intent(inout) :: self !! the memory
    real(wp), intent(inout) :: value(:) !! written on unpacking, in its unit [SI]
    real(wp), allocatable :: more(:)
    integer :: last

    if (self%failed) return
    last = self%numbers_done + size(value)
    if (self%packs) then
      if (.not. allocated(self%number)) allocate (self%number(0))
      if (last > size(self%number)) then
        allocate (more(2*last))
        more(:self%numbers_done) = self%number(:self%numbers_done)
        call move_alloc(more, self%number)
      end if
      self%number(self%numbers_done + 1:last) = value
    else if (last > size(self%number)) then
      self%failed = .true.
      return
    else
      value = self%number(self%numbers_done + 1:last)
    end if
    self%numbers_done = last
  end subroutine pass_numbers

  !> Adds whole numbers, or takes the next ones.
  pure subroutine pass_whole_numbers(self, value)
    class(memory_type), intent(inout) :: self !! the memory
    integer, intent(inout) :: value(:) !! written on unpacking
    real(wp) :: number(size(value))

    number = real(value, wp)
    call self%pass_numbers(number)
    if (.not. all(abs(number) <= real(huge(value), wp))) self%failed = .true. ! none of ours, or NaN
    if (.not. self%failed) value = nint(number)
  end subroutine pass_whole_numbers

  !> Adds to the words.
  pure subroutine add_letters(self, letters)
    class(memory_type), intent(inout) :: self !! the memory
    character(len=*), intent(in) :: letters !! to be added at the end
    character(len=:), allocatable :: more
    integer :: last

    if (.not. allocated(self%letters)) self%letters = ''
    last = self%letters_done + len(letters)
    if (last > len(self%letters)) then
      allocate (character(len=2*last) :: more)
      more(:self%letters_done) = self%letters(:self%letters_done)
      call move_alloc(more, self%letters)
    end if
    self%letters(self%letters_done + 1:last) = letters
    self%letters_done = last
  end subroutine add_letters

  !> The next line of the words; empty where there is none.
  pure function next_line(self) result(line)
    class(memory_type), intent(in) :: self !! the memory
    character(len=:), allocatable :: line
    integer :: length

    length = index(self%letters(self%letters_done + 1:), line_end) - 1
    line = self%letters(self%letters_done + 1:self%letters_done + length)
  end function next_line

  !> A shape in words, each extent with a blank before it.
  pure function extents(extent) result(line)
    integer, intent(in) :: extent(:)
    character(len=:), allocatable :: line
    integer :: i

    line = ''
    do i = 1, size(extent)
      line = line//' '//text(extent(i))
    end do
  end function extents
end module gfb_memory
