!> `&sample`: the scene with many draws of its random heights.
module gfb_sample_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, between, from_to
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: sample_case_type, read_sample_case, percent_of

  real(wp), parameter :: usual(*) = [0.05_wp, 0.25_wp, 0.5_wp, 0.75_wp, 0.95_wp]
  integer, parameter :: most_members = 1000000
  real(wp), parameter :: rounding = 1.0e-9_wp !! of a percentage that is whole

  !> What is drawn, and what is said of it.
  type :: sample_case_type
    logical :: present = .false.          !! the case asks for it
    integer :: count = 0                  !! members
    real(wp), allocatable :: quantiles(:) !! parts of the members below them [1]
  end type sample_case_type

contains

  !> Reads the group.
  subroutine read_sample_case(keys, sample, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sample_case_type), intent(out) :: sample !! what `&sample` asks for
    character(len=*), intent(in) :: misplaced !! why the case has no use for it; empty: it has
    integer :: i

    call keys%start_group('sample', optional=.true., present_in_file=sample%present, &
                          misplaced=misplaced)
    call keys%integer_key('count', sample%count, 'members: the scene with `seed`, `seed` + 1, '// &
                          '... of `&bump_foil`', from_to(2.0_wp, real(most_members, wp)), &
                          sample%present)
    call keys%real_list_key('quantiles', sample%quantiles, 99, '1', 'quantiles of the results, '// &
                            'in whole hundredths', between(0.0_wp, 1.0_wp), .false., &
                            '0.05, 0.25, 0.5, 0.75, 0.95')
    if (size(sample%quantiles) == 0) sample%quantiles = usual
    do i = 1, size(sample%quantiles)
      associate (hundredths => 100.0_wp*sample%quantiles(i))
        if (abs(hundredths - percent_of(sample%quantiles(i))) < rounding) cycle
        call keys%complain('sample', 'quantiles', 'must be whole hundredths, which name the '// &
                           'results, not '//text(sample%quantiles(i), 4))
      end associate
    end do
  end subroutine read_sample_case

  !> A quantile in percent.
  elemental function percent_of(quantile) result(percent)
    real(wp), intent(in) :: quantile !! between 0 and 1 [1]
    integer :: percent
    percent = nint(100.0_wp*quantile)
  end function percent_of
end module gfb_sample_case
