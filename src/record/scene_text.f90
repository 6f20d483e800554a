!> Two scenes as texts: in what they differ.
module gfb_scene_text
  implicit none (type, external)
  private
  public :: scene_difference

  character(len=1), parameter :: line_end = new_line('a')

contains

  !> The first difference between two echoes in words; empty where all keys are the same.
  function scene_difference(there, here) result(words)
    character(len=*), intent(in) :: there !! text of a scene with every value used
    character(len=*), intent(in) :: here  !! the same of the present scene
    character(len=:), allocatable :: words
    character(len=:), allocatable :: line, other, group
    integer :: position, other_position

    words = ''
    group = ''
    position = 1
    other_position = 1
    do
      line = next_line(there, position)
      other = next_line(here, other_position)
      if (line == '' .and. other == '') return
      if (line /= other) exit
      if (line(1:1) == '&') group = line//': '
    end do
    if (line == '' .or. line == '/') line = 'nothing more'
    if (other == '' .or. other == '/') other = 'nothing more'
    words = group//line//' there, '//other//' here'
  end function scene_difference

  !> The next line that says something, without its comment; empty at the end.
  function next_line(words, position) result(line)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: position !! where to look; moves behind the line
    character(len=:), allocatable :: line
    integer :: length

    line = ''
    do while (line == '' .and. position <= len(words))
      length = index(words(position:), line_end) - 1
      if (length < 0) length = len(words) - position + 1
      line = trim(adjustl(without_comment(words(position:position + length - 1))))
      position = position + length + 1
    end do
  end function next_line

  !> A line up to its comment, which no quotes hold.
  pure function without_comment(line) result(part)
    character(len=*), intent(in) :: line
    character(len=:), allocatable :: part
    integer :: i
    logical :: quoted

    quoted = .false.
    part = line
    do i = 1, len(line)
      if (line(i:i) == '''') quoted = .not. quoted
      if (line(i:i) == '!' .and. .not. quoted) then
        part = line(:i - 1)
        return
      end if
    end do
  end function without_comment
end module gfb_scene_text
