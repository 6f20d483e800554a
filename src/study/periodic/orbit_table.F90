!> What is kept of orbits that close after a period: a line an orbit, the orbit itself, and its multipliers.
module gfb_orbit_table
  use gfb_kinds, only: wp
  use gfb_case_file, only: case_array_type, add_array
  implicit none (type, external)
  private
  public :: words_of_place

  integer, parameter :: columns = 9
  integer, parameter :: before = 5 !! columns that stand before those of the places
  integer, parameter, public :: leading = 4 !! multipliers that are kept
  integer, parameter, public :: in_period = 4, in_ratio = 5, in_gap = 6 !! columns of these
  integer, parameter, public :: in_largest = 7 !! column of the largest multiplier
  character(len=*), parameter :: names(columns) = [character(len=18) :: &
    'speed', 'unbalance', 'mass', 'period', 'frequency_ratio', 'minimum_gap', 'largest_multiplier', &
    'stable', 'periods']

  character(len=*), parameter :: units(columns) = [character(len=5) :: &
    'rad/s', 'kg m', 'kg', 's', '1', 'm', '1', '1', '1']

  character(len=*), parameter :: meanings(columns) = [character(len=88) :: &
    'speed of the shaft', 'unbalance', 'mass of the shaft', 'period of the orbit', &
    'frequency of the orbit over the speed', 'smallest film thickness in a period', &
    'size of the largest multiplier, without the one that a free orbit always has', &
    '1: disturbances of the orbit die out', 'periods marched so far']

  character(len=1), parameter :: axes(2) = ['x', 'y']

  !> One orbit.
  type, public :: orbit_type
    real(wp) :: value(columns) = 0.0_wp        !! by `names` [SI]
    complex(wp) :: multiplier(leading) = 0.0_wp !! the largest first [1]
    !> (x and y of each place, steps + 1) over the period: of the sleeve, or of the shaft's axis [m]
    real(wp), allocatable :: place(:, :)
  contains
    procedure :: extent
  end type orbit_type

  !> The orbits so far.
  type, public :: orbit_table_type
    type(orbit_type), allocatable :: orbit(:)
    character(len=32), allocatable :: place(:) !! where they are shown: `disc_1`, ...; empty: in the one bearing
  contains
    procedure :: add => add_orbit, add_arrays => add_orbit_arrays, name_of
    procedure, private :: add_places, words_at
  end type orbit_table_type

contains

  !> Adds an orbit.
  subroutine add_orbit(self, orbit)
    class(orbit_table_type), intent(inout) :: self !! gets it
    type(orbit_type), intent(in) :: orbit !! complete

    if (.not. allocated(self%orbit)) allocate (self%orbit(0))
    self%orbit = [self%orbit, orbit]
  end subroutine add_orbit

  !> Adds the arrays of the result file.
  subroutine add_orbit_arrays(self, arrays)
    class(orbit_table_type), intent(in) :: self !! the orbits
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file
    integer :: i, k

    if (.not. allocated(self%orbit)) return
    associate (orbit => self%orbit, many => size(self%orbit))
      do i = 1, columns
        if (i == before + 1) call self%add_places(arrays)
        call add_array(arrays, '/periodic/'//trim(names(i)), trim(units(i)), trim(meanings(i)), &
                       reshape([(orbit(k)%value(i), k=1, many)], [1, many]), is_column=.true.)
      end do
      call add_array(arrays, '/periodic/multipliers_real', '1', &
                     'largest Floquet multipliers, real part', &
                     reshape([(real(orbit(k)%multiplier), k=1, many)], [leading, many]))
      call add_array(arrays, '/periodic/multipliers_imaginary', '1', &
                     'largest Floquet multipliers, imaginary part', &
                     reshape([(aimag(orbit(k)%multiplier), k=1, many)], [leading, many]))
      do i = 1, 2*size(self%place)
        call add_array(arrays, '/periodic/'//self%name_of(trim(merge('eccentricity_', '             ', &
                       self%place(1) == '')), i), 'm', self%words_at(i)//' over a period, in equal steps of time', &
                       reshape([(orbit(k)%place(i, :), k=1, many)], &
                               [size(orbit(many)%place, 2), many]))
      end do
    end associate
  end subroutine add_orbit_arrays

  !> The columns of the places: extents, then means.
  subroutine add_places(self, arrays)
    class(orbit_table_type), intent(in) :: self !! the orbits
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file
    integer :: i, k

    associate (orbit => self%orbit, many => size(self%orbit))
      do i = 1, 2*size(self%place)
        call add_array(arrays, '/periodic/'//self%name_of('orbit_', i), 'm', 'extent of '//self%words_at(i)//' in a period', &
                       reshape([(orbit(k)%extent(i), k=1, many)], [1, many]), is_column=.true.)
      end do
      do i = 1, 2*size(self%place)
        call add_array(arrays, '/periodic/'//self%name_of('center_', i), 'm', 'mean of '//self%words_at(i)//' in a period', &
                       reshape([(mean_of(orbit(k)%place(i, :)), k=1, many)], [1, many]), is_column=.true.)
      end do
    end associate
  end subroutine add_places

  !> Name of what belongs to an axis of a place: `orbit_x`, `orbit_x_disc_1`.
  pure function name_of(self, what, number) result(name)
    class(orbit_table_type), intent(in) :: self !! the table
    character(len=*), intent(in) :: what !! `orbit_`, ...
    integer, intent(in) :: number !! of the axis: x, y of the first place, ...
    character(len=:), allocatable :: name

    name = what//axes(2 - modulo(number, 2))
    associate (place => self%place((number + 1)/2))
      if (place /= '') name = name//'_'//trim(place)
    end associate
  end function name_of

  !> That axis in words.
  pure function words_at(self, number) result(words)
    class(orbit_table_type), intent(in) :: self !! the table
    integer, intent(in) :: number !! of the axis
    character(len=:), allocatable :: words

    words = axes(2 - modulo(number, 2))
    associate (place => self%place((number + 1)/2))
      if (place == '') words = 'e_'//words
      if (place /= '') words = words//' of the shaft''s axis at '//words_of_place(place)
    end associate
  end function words_at

  !> `bearing_1` as words.
  pure function words_of_place(place) result(words)
    character(len=*), intent(in) :: place
    character(len=:), allocatable :: words

    words = trim(place)
    associate (k => index(words, '_'))
      words = words(:k - 1)//' '//words(k + 1:)
    end associate
  end function words_of_place

  !> Extent of an axis of a place.
  pure real(wp) function extent(self, number)
    class(orbit_type), intent(in) :: self !! the orbit
    integer, intent(in) :: number !! of the axis: x, y of the first place, ...
    extent = extent_of(self%place(number, :))
  end function extent

  !> Mean of equal steps over a period.
  pure real(wp) function mean_of(value) result(mean)
    real(wp), intent(in) :: value(:) !! the last one is the first again [m]
    mean = sum(value(:size(value) - 1))/(size(value) - 1)
  end function mean_of

  !> Smallest and largest value of equal steps over a period, on parabolas through three of them.
  pure function extent_of(value) result(extent)
    real(wp), intent(in) :: value(:) !! the last one is the first again [m]
    real(wp) :: extent               !! largest less smallest [m]
    extent = peak_of(value) + peak_of(-value)
  end function extent_of

  !> The largest value.
  pure function peak_of(value) result(peak)
    real(wp), intent(in) :: value(:)
    real(wp) :: peak, slope, bend
    integer :: i, many

    many = size(value) - 1
    i = maxloc(value(:many), 1)
    associate (before => value(1 + modulo(i - 2, many)), after => value(1 + modulo(i, many)))
      slope = 0.5_wp*(after - before)
      bend = after - 2.0_wp*value(i) + before
    end associate
    peak = value(i)
    if (bend < 0.0_wp) peak = peak - 0.5_wp*slope**2/bend
  end function peak_of
end module gfb_orbit_table
