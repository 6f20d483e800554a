!> What is kept of orbits that close after a period: a line an orbit, the orbit itself, and its multipliers.
module gfb_orbit_table
  use gfb_kinds, only: wp
  use gfb_case_file, only: case_array_type, add_array
  implicit none (type, external)
  private
  public :: extent_of

  integer, parameter :: columns = 13
  integer, parameter, public :: leading = 4 !! multipliers that are kept
  integer, parameter, public :: in_period = 4, in_ratio = 5, in_gap = 10 !! columns of these
  integer, parameter, public :: in_largest = 11 !! column of the largest multiplier
  character(len=*), parameter :: names(columns) = [character(len=18) :: &
    'speed', 'unbalance', 'mass', 'period', 'frequency_ratio', 'orbit_x', 'orbit_y', 'center_x', &
    'center_y', &
    'minimum_gap', 'largest_multiplier', 'stable', 'periods']

  character(len=*), parameter :: units(columns) = [character(len=5) :: &
    'rad/s', 'kg m', 'kg', 's', '1', 'm', 'm', 'm', 'm', 'm', '1', '1', '1']

  character(len=*), parameter :: meanings(columns) = [character(len=88) :: &
    'speed of the shaft', 'unbalance', 'mass of the shaft', 'period of the orbit', &
    'frequency of the orbit over the speed', 'extent of e_x in a period', &
    'extent of e_y in a period', &
    'mean of e_x in a period', 'mean of e_y in a period', 'smallest film thickness in a period', &
    'size of the largest multiplier, without the one that a free orbit always has', &
    '1: disturbances of the orbit die out', 'periods marched so far']

  !> One orbit.
  type, public :: orbit_type
    real(wp) :: value(columns) = 0.0_wp        !! by `names` [SI]
    complex(wp) :: multiplier(leading) = 0.0_wp !! the largest first [1]
    real(wp), allocatable :: place(:, :)       !! (2, steps + 1) of the sleeve over the period [m]
  end type orbit_type

  !> The orbits so far.
  type, public :: orbit_table_type
    type(orbit_type), allocatable :: orbit(:)
  contains
    procedure :: add => add_orbit, add_arrays => add_orbit_arrays
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
    real(wp), allocatable :: rows(:, :)
    integer :: i, k
    character(len=1), parameter :: axis(2) = ['x', 'y']

    if (.not. allocated(self%orbit)) return
    associate (orbit => self%orbit, many => size(self%orbit))
      rows = reshape([(orbit(k)%value, k=1, many)], [columns, many])
      do i = 1, columns
        call add_array(arrays, '/periodic/'//trim(names(i)), trim(units(i)), trim(meanings(i)), &
                       rows(i:i, :), is_column=.true.)
      end do
      call add_array(arrays, '/periodic/multipliers_real', '1', &
                     'largest Floquet multipliers, real part', &
                     reshape([(real(orbit(k)%multiplier), k=1, many)], [leading, many]))
      call add_array(arrays, '/periodic/multipliers_imaginary', '1', &
                     'largest Floquet multipliers, imaginary part', &
                     reshape([(aimag(orbit(k)%multiplier), k=1, many)], [leading, many]))
      do i = 1, 2
        call add_array(arrays, '/periodic/eccentricity_'//axis(i), 'm', &
                       'e_'//axis(i)//' over a period, in equal steps of time', &
                       reshape([(orbit(k)%place(i, :), k=1, many)], &
                               [size(orbit(many)%place, 2), many]))
      end do
    end associate
  end subroutine add_orbit_arrays

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
