!> What is stored and read back, component by component: one routine of a type both saves and
!> restores it.
!>
!> The routine of a type visits each component under its name:
!> `call archive%visit('load', point%load)`. While an archive saves, a visit adds a line with name,
!> kind and shape to the archive's words and the values, with all their bits, to its numbers; a text
!> follows its line. While it restores, a visit takes both off again, in the same order. A component
!> that does not fit, and every one after it, stays as it was, leaves `failed` behind, and names
!> itself in `problem`.
!>
!> An archive lies in memory: it is sent from one group of ranks to another, or becomes a group of a
!> restart file (`gfb_restart_file`). Numbers and words are the same on all ranks; of a field each
!> rank has a block.
!>
!> What comes from a file may be anybody's: then each number must be one, and of a size that gfb's
!> own numbers have; what they say together is judged by whom they belong to.
module gfb_archive
  use gfb_kinds, only: wp, long
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: open_archive

  character(len=1), parameter :: line_end = new_line('a')
  character(len=*), parameter :: missing = ' none' !! instead of the shape of what is not allocated

  integer, parameter :: most_letters = 60 !! of a line that does not fit, in words
  !> No number of a state or a result is larger, in any unit; its square is a number all the same.
  real(wp), parameter, public :: largest_stored = 1.0e30_wp

  !> A rank's block of a field.
  type, public :: archive_field_type
    character(len=:), allocatable :: name
    integer :: total = 0                 !! entries on all ranks
    integer :: offset = 0                !! before those of this rank
    real(wp), allocatable :: block(:, :) !! (components, entries of this rank), in any unit
  end type archive_field_type

  !> Numbers, words that say what they are, and fields. A new one saves.
  type, public :: archive_type
    logical :: saves = .true.   !! otherwise it restores
    logical :: failed = .false. !! something did not fit while it restored
    character(len=:), allocatable :: name    !! of the archive among others
    character(len=:), allocatable :: problem !! which component did not fit first, where one did not
    type(archive_field_type), allocatable :: field(:)
    real(wp), allocatable, private :: number(:)          !! with room for more while it saves
    character(len=:), allocatable, private :: letters    !! with room for more while it saves
    integer, private :: numbers_done = 0, letters_done = 0, fields_done = 0 !! saved or restored
    logical, private :: judged = .false. !! what it restores may be anybody's
    character(len=:), allocatable, private :: passing !! the line that was taken last
  contains
    procedure, non_overridable :: part
    !> Saves or restores a component whose shape is known; a text is of any length.
    generic :: visit => visit_real, visit_reals, visit_matrix, visit_integer, visit_integers, &
      visit_integer_matrix, visit_logical, visit_text
    !> Saves or restores an allocatable array with its shape.
    generic :: visit_sized => visit_sized_reals, visit_sized_matrix, visit_sized_integers
    procedure, non_overridable :: visit_count, visit_block, require
    procedure, non_overridable :: is_used_up, finish, numbers, words
    procedure, non_overridable, private :: visit_real, visit_reals, visit_matrix
    procedure, non_overridable, private :: visit_integer, visit_integers
    procedure, non_overridable, private :: visit_integer_matrix, visit_logical, visit_text
    procedure, non_overridable, private :: visit_sized_reals, visit_sized_matrix
    procedure, non_overridable, private :: visit_sized_integers, pass_line
    procedure, non_overridable, private :: pass_shape, pass_numbers, pass_whole_numbers
    procedure, non_overridable, private :: add_letters, next_line, odd
  end type archive_type

contains

  !> Begins to restore.
  pure subroutine open_archive(numbers, words, archive, judged)
    real(wp), intent(in) :: numbers(:) !! as `numbers` gave them, each in its component's unit [SI]
    character(len=*), intent(in) :: words !! as `words` gave them
    type(archive_type), intent(out) :: archive !! restores these, from the first on
    logical, intent(in), optional :: judged !! they may be anybody's

    archive%saves = .false.
    archive%number = numbers
    archive%letters = words
    archive%passing = ''
    if (present(judged)) archive%judged = judged
  end subroutine open_archive

  !> Whether numbers are some that a file of gfb's may hold, where the archive is judged.
  pure logical function are_plain(self, number) result(plain)
    class(archive_type), intent(in) :: self
    real(wp), intent(in) :: number(:)
    plain = .true.
    if (self%judged) plain = all(abs(number) <= largest_stored) ! not so for NaN
  end function are_plain

  !> What was read must fulfil a condition: the first that it does not is the archive's problem.
  pure subroutine require(self, fulfilled, words)
    class(archive_type), intent(inout) :: self !! the archive
    logical, intent(in) :: fulfilled           !! the condition is
    character(len=*), intent(in) :: words      !! that name what does not fit

    if (fulfilled .or. self%failed) return
    self%failed = .true.
    self%problem = words
  end subroutine require

  !> All numbers that were saved.
  pure function numbers(self) result(list)
    class(archive_type), intent(in) :: self !! the archive
    real(wp), allocatable :: list(:) !! each in its component's unit

    allocate (list(0))
    if (allocated(self%number)) list = self%number(:self%numbers_done)
  end function numbers

  !> Names, kinds and shapes that were saved, one a line, and the texts.
  pure function words(self) result(lines)
    class(archive_type), intent(in) :: self !! the archive
    character(len=:), allocatable :: lines

    lines = ''
    if (allocated(self%letters)) lines = self%letters(:self%letters_done)
  end function words

  !> Whether all that was saved has been taken.
  pure logical function is_used_up(self) result(empty)
    class(archive_type), intent(in) :: self !! the archive
    empty = self%numbers_done == size(self%number) .and. self%letters_done == len(self%letters)
    if (allocated(self%field)) empty = empty .and. self%fields_done == size(self%field)
  end function is_used_up

  !> Ends restoring: something that is left over does not fit either.
  pure subroutine finish(self)
    class(archive_type), intent(inout) :: self !! the archive

    if (self%saves) return
    call self%require(self%is_used_up(), "'"//self%next_line()//"' is left over")
  end subroutine finish

  !> Says whose components follow, where an archive holds several of a type.
  pure subroutine part(self, name)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the part
    call self%pass_line('in '//name)
  end subroutine part

  !> A real number.
  pure subroutine visit_real(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    real(wp), intent(inout) :: value !! written on restoring, in its unit [SI]
    real(wp) :: number(1)

    number = value
    call self%pass_line(name//' real')
    call self%pass_numbers(1, number)
    value = number(1)
  end subroutine visit_real

  !> Real numbers.
  pure subroutine visit_reals(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    real(wp), intent(inout) :: value(:) !! written on restoring, in its unit [SI]

    call self%pass_line(name//' real'//extents(shape(value)))
    call self%pass_numbers(size(value), value)
  end subroutine visit_reals

  !> A matrix of real numbers.
  pure subroutine visit_matrix(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name   !! of the component
    real(wp), intent(inout) :: value(:, :) !! written on restoring, in its unit [SI]

    call self%pass_line(name//' real'//extents(shape(value)))
    call self%pass_numbers(size(value), value)
  end subroutine visit_matrix

  !> A whole number.
  pure subroutine visit_integer(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    integer, intent(inout) :: value !! written on restoring
    integer :: number(1)

    number = value
    call self%pass_line(name//' integer')
    call self%pass_whole_numbers(1, number)
    value = number(1)
  end subroutine visit_integer

  !> Whole numbers.
  pure subroutine visit_integers(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    integer, intent(inout) :: value(:) !! written on restoring

    call self%pass_line(name//' integer'//extents(shape(value)))
    call self%pass_whole_numbers(size(value), value)
  end subroutine visit_integers

  !> A matrix of whole numbers.
  pure subroutine visit_integer_matrix(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    integer, intent(inout) :: value(:, :)

    call self%pass_line(name//' integer'//extents(shape(value)))
    call self%pass_whole_numbers(size(value), value)
  end subroutine visit_integer_matrix

  !> Yes or no.
  pure subroutine visit_logical(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    logical, intent(inout) :: value !! written on restoring, before which it need not be defined
    integer :: number(1)

    number = 0
    if (self%saves) number = merge(1, 0, value)
    call self%pass_line(name//' logical')
    call self%pass_whole_numbers(1, number)
    call self%require(number(1) == 0 .or. number(1) == 1, self%odd())
    value = number(1) /= 0
  end subroutine visit_logical

  !> How many components follow: what an archive does not hold cannot be that many.
  pure subroutine visit_count(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of what is counted
    integer, intent(inout) :: value !! written on restoring; 0 where it does not fit

    call self%visit(name, value)
    if (self%saves) return
    if (.not. self%failed) then
      call self%require(value >= 0 .and. value <= len(self%letters), "the number of '"//name//"'")
    end if
    if (self%failed) value = 0
  end subroutine visit_count

  !> A text of any length, or none.
  pure subroutine visit_text(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    character(len=:), allocatable, intent(inout) :: value
    integer :: length(1)
    logical :: there

    there = allocated(value)
    length = 0
    if (there) length = len(value)
    call self%pass_shape(name//' text', length, there)
    if (self%saves) then
      if (there) call self%add_letters(value//line_end)
      return
    end if
    if (self%failed) return
    if (allocated(value)) deallocate (value)
    if (.not. there) return
    call self%require(length(1) + 1 <= len(self%letters) - self%letters_done, &
                      "the text '"//name//"' is not whole")
    if (self%failed) return
    value = self%letters(self%letters_done + 1:self%letters_done + length(1))
    self%letters_done = self%letters_done + length(1) + 1
  end subroutine visit_text

  !> Real numbers, as many as there are.
  pure subroutine visit_sized_reals(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name                !! of the component
    real(wp), allocatable, intent(inout) :: value(:) !! allocated on restoring, in its unit [SI]
    integer :: extent(1)
    logical :: there

    there = allocated(value)
    extent = 0
    if (there) extent = shape(value)
    call self%pass_shape(name//' real', extent, there)
    if (self%failed) return
    if (.not. self%saves .and. allocated(value)) deallocate (value)
    if (.not. there) return
    if (.not. self%saves) allocate (value(extent(1)))
    call self%pass_numbers(size(value), value)
  end subroutine visit_sized_reals

  !> A matrix of real numbers, as large as it is.
  pure subroutine visit_sized_matrix(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name                   !! of the component
    real(wp), allocatable, intent(inout) :: value(:, :) !! allocated on restoring, in its unit [SI]
    integer :: extent(2)
    logical :: there

    there = allocated(value)
    extent = 0
    if (there) extent = shape(value)
    call self%pass_shape(name//' real', extent, there)
    if (self%failed) return
    if (.not. self%saves .and. allocated(value)) deallocate (value)
    if (.not. there) return
    if (.not. self%saves) allocate (value(extent(1), extent(2)))
    call self%pass_numbers(size(value), value)
  end subroutine visit_sized_matrix

  !> Whole numbers, as many as there are.
  pure subroutine visit_sized_integers(self, name, value)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the component
    integer, allocatable, intent(inout) :: value(:) !! allocated on restoring
    integer :: extent(1)
    logical :: there

    there = allocated(value)
    extent = 0
    if (there) extent = shape(value)
    call self%pass_shape(name//' integer', extent, there)
    if (self%failed) return
    if (.not. self%saves .and. allocated(value)) deallocate (value)
    if (.not. there) return
    if (.not. self%saves) allocate (value(extent(1)))
    call self%pass_whole_numbers(size(value), value)
  end subroutine visit_sized_integers

  !> A rank's block of a field.
  pure subroutine visit_block(self, name, total, offset, block)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: name !! of the field, of its own in the archive
    integer, intent(in) :: total !! entries on all ranks
    integer, intent(in) :: offset !! entries before those of this rank
    !> (components, entries of this rank), written on restoring, in any unit [SI]
    real(wp), intent(inout) :: block(:, :)
    type(archive_field_type) :: field

    call self%pass_line(name//' field'//extents([size(block, 1), total]))
    if (self%failed) return
    if (.not. allocated(self%field)) allocate (self%field(0))
    self%fields_done = self%fields_done + 1
    if (self%saves) then
      field%name = name
      field%total = total
      field%offset = offset
      field%block = block
      self%field = [self%field, field]
      return
    end if
    call self%require(self%fields_done <= size(self%field), "the field '"//name//"' is missing")
    if (self%failed) return
    associate (found => self%field(self%fields_done))
      call self%require(found%name == name .and. all(shape(found%block) == shape(block)), &
                        "the field '"//name//"'")
      call self%require(are_plain(self, reshape(found%block, [size(found%block)])), self%odd())
      if (.not. self%failed) block = found%block
    end associate
  end subroutine visit_block

  !> Adds a line, or takes the next one, which must be the same.
  pure subroutine pass_line(self, line)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: line !! name, kind and shape

    if (self%saves) then
      call self%add_letters(line//line_end)
    else if (self%failed) then
      return
    else if (self%next_line() == line) then
      self%letters_done = self%letters_done + len(line) + 1
      self%passing = line
    else
      call self%require(.false., misfit(line, self%next_line()))
    end if
  end subroutine pass_line

  !> Adds a line with a shape, or takes the next one, which must be the same but for the extents.
  pure subroutine pass_shape(self, start, extent, there)
    class(archive_type), intent(inout) :: self !! the archive
    character(len=*), intent(in) :: start !! name and kind
    integer, intent(inout) :: extent(:)   !! read while the archive restores
    logical, intent(inout) :: there       !! it is allocated; read while the archive restores
    character(len=:), allocatable :: line
    integer :: status
    logical :: fits

    if (self%saves) then
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
      fits = all(extent >= 0) .and. line == start//extents(extent)
      if (index(start, ' text') == 0) fits = fits .and. &
        product(int(extent, long)) <= size(self%number) - self%numbers_done
      call self%require(fits, misfit(start, line))
    end if
    if (self%failed) return
    self%letters_done = self%letters_done + len(line) + 1
    self%passing = line
  end subroutine pass_shape

  !> Adds numbers of any shape, or takes the next ones.
  pure subroutine pass_numbers(self, many, value)
    class(archive_type), intent(inout) :: self !! the archive
    integer, intent(in) :: many !! numbers
    real(wp), intent(inout) :: value(many) !! written on restoring, in its unit [SI]
    real(wp), allocatable :: more(:)
    integer :: last

    if (self%failed) return
    last = self%numbers_done + many
    if (self%saves) then
      if (.not. allocated(self%number)) allocate (self%number(0))
      if (last > size(self%number)) then
        allocate (more(2*last))
        more(:self%numbers_done) = self%number(:self%numbers_done)
        call move_alloc(more, self%number)
      end if
      self%number(self%numbers_done + 1:last) = value
    else if (last > size(self%number)) then
      call self%require(.false., 'numbers are missing at its end')
      return
    else if (.not. are_plain(self, self%number(self%numbers_done + 1:last))) then
      call self%require(.false., self%odd())
      return
    else
      value = self%number(self%numbers_done + 1:last)
    end if
    self%numbers_done = last
  end subroutine pass_numbers

  !> Adds whole numbers, or takes the next ones.
  pure subroutine pass_whole_numbers(self, many, value)
    class(archive_type), intent(inout) :: self !! the archive
    integer, intent(in) :: many !! numbers
    integer, intent(inout) :: value(many) !! written on restoring
    real(wp) :: number(many)

    number = real(value, wp)
    call self%pass_numbers(many, number)
    call self%require(all(abs(number) <= real(huge(value), wp)), & ! none of ours, or NaN
                      'a number that is not whole')
    if (.not. self%failed) then
      call self%require(all(abs(number - anint(number)) <= 0.0_wp), 'a number that is not whole')
    end if
    if (.not. self%failed) value = nint(number)
  end subroutine pass_whole_numbers

  !> Whose numbers are none that gfb writes, in words.
  pure function odd(self) result(words)
    class(archive_type), intent(in) :: self !! the archive
    character(len=:), allocatable :: words

    words = ''
    if (allocated(self%passing)) words = self%passing(:min(len(self%passing), most_letters))
    words = "'"//words//"' holds what is no number of gfb's"
  end function odd

  !> Adds to the words.
  pure subroutine add_letters(self, letters)
    class(archive_type), intent(inout) :: self !! the archive
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
    class(archive_type), intent(in) :: self !! the archive
    character(len=:), allocatable :: line
    integer :: length

    length = index(self%letters(self%letters_done + 1:), line_end) - 1
    line = self%letters(self%letters_done + 1:self%letters_done + length)
  end function next_line

  !> What stands in the place of a component, in words.
  pure function misfit(line, found) result(words)
    character(len=*), intent(in) :: line  !! name, kind and shape that should be next
    character(len=*), intent(in) :: found !! that are; empty where nothing is left
    character(len=:), allocatable :: words

    words = "'"//line//"' is missing"
    if (found /= '') words = words//", there is '"//found(:min(len(found), most_letters))//"'"
  end function misfit

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
end module gfb_archive
