!> The mistakes of one case file, collected so that all are reported at once.
module gfb_complaints
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: complaints_type, shown

  integer, parameter :: most_shown = 50    !! more than these help nobody
  integer, parameter :: most_kept = 10000  !! bounds the memory a spoilt file can take
  integer, parameter :: longest_shown = 60 !! characters of a value as typed

  !> One mistake.
  type :: complaint_type
    integer :: line = 0                   !! of the file, 0 where it has no place
    character(len=:), allocatable :: words
  end type complaint_type

  !> All mistakes of a file.
  type :: complaints_type
    character(len=:), allocatable :: file    !! its name, as the user gave it
    integer :: count = 0                     !! mistakes found
    type(complaint_type), allocatable, private :: kept(:)
  contains
    procedure, non_overridable :: add => add_complaint, add_new => add_new_complaints
    procedure, non_overridable :: report => report_complaints
  end type complaints_type

contains

  !> Adds a mistake.
  pure subroutine add_complaint(self, line, words)
    class(complaints_type), intent(inout) :: self !! the mistakes so far
    integer, intent(in) :: line           !! of the file, 0 where it has no place
    character(len=*), intent(in) :: words !! what is wrong, and the rule
    type(complaint_type), allocatable :: longer(:)

    if (.not. allocated(self%kept)) allocate (self%kept(16))
    self%count = self%count + 1
    if (self%count > most_kept) return
    if (self%count > size(self%kept)) then
      allocate (longer(2*size(self%kept)))
      longer(:size(self%kept)) = self%kept
      call move_alloc(longer, self%kept)
    end if
    self%kept(self%count)%line = line
    self%kept(self%count)%words = words
  end subroutine add_complaint

  !> Adds those mistakes of another reading of the file that one reading of it has not.
  pure subroutine add_new_complaints(self, other, known, line, label)
    class(complaints_type), intent(inout) :: self !! the mistakes so far
    type(complaints_type), intent(in) :: other !! the mistakes of the other reading
    type(complaints_type), intent(in) :: known !! those that are not new
    integer, intent(in) :: line !! of the file, to which they are due
    character(len=*), intent(in) :: label !! what each begins with
    integer :: i, k
    logical :: is_new

    do i = 1, min(other%count, most_kept)
      is_new = .true.
      do k = 1, min(known%count, most_kept)
        if (known%kept(k)%line /= other%kept(i)%line) cycle
        if (known%kept(k)%words == other%kept(i)%words) is_new = .false.
      end do
      if (is_new) call self%add(line, label//other%kept(i)%words)
    end do
  end subroutine add_new_complaints

  !> The mistakes in the order of their lines, one a line.
  pure function report_complaints(self, label) result(words)
    class(complaints_type), intent(in) :: self !! the mistakes so far
    character(len=*), intent(in), optional :: label !! what each line begins with
    character(len=:), allocatable :: words
    character(len=:), allocatable :: name
    integer, allocatable :: order(:)
    integer :: i

    name = shown_name(self%file)
    if (present(label)) name = label//name
    words = ''
    call sort_by_line(self, order)
    do i = 1, min(size(order), most_shown)
      if (i > 1) words = words//new_line('a')
      associate (complaint => self%kept(order(i)))
        words = words//name//':'
        if (complaint%line > 0) words = words//text(complaint%line)//':'
        words = words//' '//complaint%words
      end associate
    end do
    if (self%count > most_shown) then
      words = words//new_line('a')//name//': ... and '// &
              text(self%count - most_shown)//' more'
    end if
  end function report_complaints

  !> Indices of the mistakes sorted by line; those without a place come last.
  pure subroutine sort_by_line(self, order)
    type(complaints_type), intent(in) :: self
    integer, allocatable, intent(out) :: order(:)
    integer :: i, j, line

    allocate (order(min(self%count, most_kept)))
    do i = 1, size(order)
      line = place(self%kept(i)%line)
      do j = i, 2, -1
        if (place(self%kept(order(j - 1))%line) <= line) exit
        order(j) = order(j - 1)
      end do
      order(j) = i
    end do
  end subroutine sort_by_line

  !> A line's rank in the report.
  pure function place(line)
    integer, intent(in) :: line
    integer :: place
    place = merge(line, huge(line), line > 0)
  end function place

  !> What the user typed, fit for a terminal: printable, on one line and not too long.
  pure function shown(words) result(clean)
    character(len=*), intent(in) :: words !! as the user typed them
    character(len=:), allocatable :: clean
    integer :: i, code
    logical :: gap

    clean = ''
    gap = .false.
    do i = 1, len(words)
      code = iachar(words(i:i))
      if (code == 32 .or. (code >= 9 .and. code <= 13)) then
        gap = .true.
        cycle
      end if
      if (code > 127 .and. code < 192) cycle ! UTF-8: the character has begun before
      if (gap .and. len(clean) > 0) clean = clean//' '
      gap = .false.
      clean = clean//merge(words(i:i), '?', code > 32 .and. code < 127)
      if (len(clean) > longest_shown) then
        clean = clean(1:longest_shown)//'...'
        exit
      end if
    end do
  end function shown

  !> A file's name with its control characters replaced.
  pure function shown_name(file) result(clean)
    character(len=*), intent(in) :: file
    character(len=len(file)) :: clean
    integer :: i

    clean = file
    do i = 1, len(file)
      if (iachar(file(i:i)) < 32 .or. iachar(file(i:i)) == 127) clean(i:i) = '?'
    end do
  end function shown_name
end module gfb_complaints
