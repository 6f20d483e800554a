!> Real keys of a case file that are lists: how long they are, and what their values are.
module gfb_listed_keys
  use gfb_kinds, only: wp
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_case_keys, only: case_keys_type
  use gfb_sweep_case, only: swept_key_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: list_length, list_values, index_problem, is_gap

contains

  !> How many values a list means to have whose one value stands for all; 0 where it has as many as
  !> the file gives.
  pure function list_length(key, foil) result(length)
    type(swept_key_type), intent(in) :: key !! a list
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer :: length

    length = 0
    if (key%group /= 'bump_foil') return
    if (is_gap(key) .or. index(key%name, 'bump_') == 1) length = foil%bumps
    if (index(key%name, 'strip_') == 1) length = foil%strips
  end function list_length

  !> Whether a list has gaps at rest, which are 0 where it is absent.
  pure function is_gap(key) result(gap)
    type(swept_key_type), intent(in) :: key !! a list
    logical :: gap
    gap = key%group == 'bump_foil' .and. (key%name == 'crest_gap' .or. key%name == 'corner_gap')
  end function is_gap

  !> All values of a list; none where the file does not give it and it has no default.
  function list_values(keys, key, foil) result(list)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(swept_key_type), intent(in) :: key !! a list
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp), allocatable :: list(:) !! [their unit]
    character(len=:), allocatable :: words
    integer :: i, k, status

    allocate (list(0))
    do i = 1, keys%notes%count
      associate (met => keys%notes%met(i))
        if (met%group /= key%group .or. met%key%name /= key%name .or. .not. met%key%given) cycle
        words = met%value
      end associate
      do k = 1, len(words)
        if (words(k:k) == new_line('a')) words(k:k) = ' '
      end do
      deallocate (list)
      allocate (list(1 + count([(words(k:k) == ',', k=1, len(words))])), source=0.0_wp)
      read (words, *, iostat=status) list
      if (status /= 0) list = [real(wp) ::]
    end do
    if (size(list) == 0 .and. is_gap(key)) list = [0.0_wp]
    if (size(list) == 1) list = spread(list(1), 1, max(1, list_length(key, foil)))
  end function list_values

  !> Why an index does not choose a value of a list; empty where it does.
  function index_problem(keys, key, foil) result(problem)
    type(case_keys_type), intent(in) :: keys !! the keys of the case file, all read
    type(swept_key_type), intent(in) :: key !! a list, with an index
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    character(len=:), allocatable :: problem
    integer :: length

    problem = ''
    length = size(list_values(keys, key, foil))
    if (is_gap(key) .and. keys%meant('bump_foil', 'height_deviation')) then
      problem = key%label()//' has no effect here: height_deviation gives the gaps'
    else if (length == 0) then
      problem = key%group//'%'//key%name//' is not given'
    else if (key%element > length) then
      problem = key%label()//' does not exist: the list has '//text(length)//' values'
    end if
  end function index_problem
end module gfb_listed_keys
