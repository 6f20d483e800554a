!> Stiffness and damping under small vibrations, and the rotor's modes: what is kept of them, as
!> arrays and as a table.
!>
!> Z = K + i w C, with the circular frequency w, is the force of the film that brings the shaft
!> back over its displacement; rows and columns are those of e_x, e_y, phi_x, phi_y, or of e_z,
!> phi_x, phi_y of a runner.
module gfb_dynamics_record
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_film_surface, only: shaft_coordinates, translations, journal_coordinates
  use gfb_text, only: exact_text, join
  use gfb_case_file, only: case_array_type, add_array
  implicit none (type, external)
  private
  public :: stiffness_of, damping_of, add_dynamics_arrays, dynamics_table, visit_dynamics, &
            coefficients_of, motion_names

  !> Of a mode: frequency [rad/s], growth [1/s], damping ratio, rotor's share, kind, sense, foil's
  !> share, rotor's share of what moves, whose it is [1].
  integer, parameter, public :: mode_numbers = 9
  character(len=*), parameter :: mode_names(mode_numbers) = &
    [character(len=13) :: 'frequency', 'growth_rate', 'damping_ratio', 'shaft_share', 'kind', &
                          'sense', 'foil_share', 'moving_share', 'owner']
  character(len=*), parameter :: mode_units(mode_numbers) = &
    [character(len=5) :: 'rad/s', '1/s', '1', '1', '1', '1', '1', '1', '1']
  character(len=*), parameter :: mode_meanings(mode_numbers) = [character(len=120) :: &
    'circular frequency of the modes of film, foil and rotor, growth falling', &
    'growth of the amplitude, exp(growth t); negative: the mode dies out', &
    'minus the growth over the modulus of growth + i frequency; negative: it grows', &
    'share of the rotor, against film and foil by energy and against the foil by mass; below '// &
    '0.02: of film or foil', &
    '1: cylindrical, both bearings move alike; 2: conical, the rotor turns about its centre', &
    '1: a circle with the speed, -1: a circle against it, 0: to and fro', &
    'share of the foil''s strain and kinetic energy, against rotor and film', &
    'share of the rotor in what moves, rotor and foil: its participation, without losses that '// &
    'of kinetic energy', &
    'whose the mode is: 1 the rotor''s, 2 the foil''s, 3 the film''s, 4 both the rotor''s and '// &
    'the foil''s']

  !> Stiffness and damping.
  character(len=*), parameter :: kinds(2) = [character(len=9) :: 'stiffness', 'damping']
  character(len=*), parameter :: units(2) = [character(len=36) :: &
    'N/m, N/rad; N m/m, N m/rad', 'N s/m, N s/rad; N m s/m, N m s/rad']

  !> The shaft's coordinates: in names of columns, and as symbols.
  character(len=4), parameter :: coordinate_names(shaft_coordinates) = &
    [character(len=4) :: 'x', 'y', 'z', 'phix', 'phiy']
  character(len=5), parameter :: coordinate_symbols(shaft_coordinates) = &
    [character(len=5) :: 'e_x', 'e_y', 'e_z', 'phi_x', 'phi_y']

  !> At one answer.
  type, public :: dynamics_point_type
    integer, allocatable :: motion(:) !! the shaft's coordinates that the film's surface has
    real(wp), allocatable :: frequency(:)          !! [rad/s]
    complex(wp), allocatable :: coefficient(:, :, :) !! (row, column, frequency) Z in SI
    !> of lines between neighbours, if frequencies were put between those given; NaN: could not [1]
    real(wp), allocatable :: interpolation_miss
    real(wp), allocatable :: mode(:, :)            !! (number, mode) of the rotor, if there is one
    real(wp), allocatable :: amplitude(:)          !! of the shaft, if any is asked for [m]
    !> (row, column, amplitude, frequency) Z in SI
    complex(wp), allocatable :: at_amplitude(:, :, :, :)
    real(wp), allocatable :: friction_loss(:, :, :) !! (x or y, amplitude, frequency) [J]
    !> Of stiffness and damping, from nested meshes, in the order of `coefficients_of` [SI]
    real(wp), allocatable :: error(:)
  end type dynamics_point_type

  !> At all answers so far; none without an answer.
  type, public :: dynamics_record_type
    type(dynamics_point_type), allocatable :: point(:)
    real(wp) :: onset = 0.0_wp !! speed at which a sweep has seen growth begin or end; 0: none [rpm]
    character(len=:), allocatable :: problem !! a matrix that could not be factorized
  end type dynamics_record_type

contains

  !> Names of motions in matrices.
  elemental function motion_names(motion) result(name)
    integer, intent(in) :: motion !! one of the shaft's coordinates
    character(len=4) :: name
    name = coordinate_names(motion)
  end function motion_names

  !> Motions of an answer's matrices.
  pure integer function motions_of(point) result(motions)
    type(dynamics_point_type), intent(in) :: point
    motions = size(point%motion)
  end function motions_of

  !> The order of arrays, for their description.
  pure function order_of(point) result(words)
    type(dynamics_point_type), intent(in) :: point
    character(len=:), allocatable :: words
    words = 'frequency, row, column] in the order '// &
            join(coordinate_symbols(point%motion), ', ')//': '
  end function order_of

  !> The film's force along the motions that are translations.
  pure function force_words(point) result(words)
    type(dynamics_point_type), intent(in) :: point
    character(len=:), allocatable :: words
    integer, allocatable :: along(:)

    along = pack(point%motion, point%motion <= translations)
    words = 'film force ('//join(coordinate_names(along), ', ')//')'
    if (size(along) == 1) words = 'film force along '//trim(coordinate_names(along(1)))
  end function force_words

  !> K at one of the frequencies.
  pure function stiffness_of(point, i) result(stiffness)
    type(dynamics_point_type), intent(in) :: point !! an answer
    integer, intent(in) :: i !! number of the frequency
    real(wp), allocatable :: stiffness(:, :)
    stiffness = real(point%coefficient(:, :, i), wp)
  end function stiffness_of

  !> C at one of the frequencies.
  pure function damping_of(point, i) result(damping)
    type(dynamics_point_type), intent(in) :: point !! an answer
    integer, intent(in) :: i !! number of the frequency
    real(wp), allocatable :: damping(:, :)
    damping = aimag(point%coefficient(:, :, i))/point%frequency(i)
  end function damping_of

  !> All stiffness behind each other, then all damping.
  pure function coefficients_of(point) result(values)
    type(dynamics_point_type), intent(in) :: point !! an answer
    real(wp), allocatable :: values(:) !! [SI] (row, column, frequency, stiffness or damping)
    integer :: i

    associate (n => size(point%frequency))
      values = [(stiffness_of(point, i), i=1, n), (damping_of(point, i), i=1, n)]
    end associate
  end function coefficients_of

  !> Errors of stiffness (1) or damping (2) at one of the frequencies.
  pure function error_of(point, part, i) result(error)
    type(dynamics_point_type), intent(in) :: point
    integer, intent(in) :: part !! 1 or 2
    integer, intent(in) :: i !! number of the frequency
    real(wp), allocatable :: error(:, :)
    integer :: first

    associate (motions => motions_of(point))
      first = ((part - 1)*size(point%frequency) + i - 1)*motions**2
      error = reshape(point%error(first + 1:first + motions**2), [motions, motions])
    end associate
  end function error_of

  !> The entries of a matrix, row by row.
  pure function by_rows(matrix) result(list)
    real(wp), intent(in) :: matrix(:, :)
    real(wp) :: list(size(matrix))
    list = reshape(transpose(matrix), [size(matrix)])
  end function by_rows

  !> Adds the arrays of the result file; none without an answer. Those of a sweep have its points
  !> first.
  subroutine add_dynamics_arrays(record, sweeps, points, arrays)
    type(dynamics_record_type), intent(in) :: record !! of a run
    logical, intent(in) :: sweeps !! the answers are those of a sweep
    integer, intent(in) :: points !! of the record, from the first
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file
    real(wp), allocatable, dimension(:, :) :: frequency, stiffness, damping
    character(len=:), allocatable :: axes
    integer :: i, k, n, motions, entries

    if (.not. allocated(record%point)) return
    if (min(points, size(record%point)) == 0) return
    n = size(record%point(1)%frequency)
    motions = motions_of(record%point(1))
    entries = motions**2
    allocate (frequency(n, points), stiffness(n*entries, points))
    allocate (damping, mold=stiffness)
    do k = 1, points
      associate (point => record%point(k))
        frequency(:, k) = point%frequency
        stiffness(:, k) = [(by_rows(stiffness_of(point, i)), i=1, n)]
        damping(:, k) = [(by_rows(damping_of(point, i)), i=1, n)]
      end associate
    end do
    axes = ', [point, '//order_of(record%point(1))
    if (.not. sweeps) then
      axes = ', ['//order_of(record%point(1))
      frequency = transpose(frequency)
      stiffness = reshape(stiffness, [entries, n])
      damping = reshape(damping, [entries, n])
    end if
    call add_array(arrays, '/dynamics/frequency', 'rad/s', 'circular frequency of the vibration', &
                   frequency, sweeps)
    call add_array(arrays, '/dynamics/stiffness', trim(units(1)), &
                   'real part of K + i omega C'//axes//force_words(record%point(1))// &
                   ' or torque that brings the shaft back, over its displacement or rotation', &
                   stiffness, sweeps, motions)
    call add_array(arrays, '/dynamics/damping', trim(units(2)), &
                   'imaginary part of K + i omega C over omega'//axes// &
                   'the same over velocity or angular velocity', damping, sweeps, motions)
    if (allocated(record%point(1)%interpolation_miss)) then
      call add_array(arrays, '/dynamics/interpolation_miss', '1', 'how far straight lines '// &
                     'between neighbouring frequencies miss stiffness and damping at most, '// &
                     'over their largest entry; NaN: not known, frequencies are as given', &
                     reshape([record%point(1)%interpolation_miss], [1, 1]))
    end if
    if (allocated(record%point(1)%error)) call add_error_arrays(record%point(1), arrays)
    call add_mode_arrays(record, sweeps, points, arrays)
    if (allocated(record%point(1)%amplitude)) call add_amplitude_arrays(record%point(1), arrays)
  end subroutine add_dynamics_arrays

  !> Adds the errors of the coefficients; there is one answer.
  subroutine add_error_arrays(point, arrays)
    type(dynamics_point_type), intent(in) :: point
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    integer :: part, i

    do part = 1, size(kinds)
      associate (n => size(point%frequency), motions => motions_of(point))
        call add_array(arrays, '/dynamics/'//trim(kinds(part))//'_error', trim(units(part)), &
                       'error of every entry, estimated from nested meshes, absolute, ['// &
                       order_of(point)// &
                       'of '//trim(kinds(part)), &
                       reshape([(by_rows(error_of(point, part, i)), i=1, n)], [motions**2, n]), &
                       order=motions)
      end associate
    end do
  end subroutine add_error_arrays

  !> Adds what was found at the shaft's amplitudes. Tilts stay small ones: their columns are NaN.
  subroutine add_amplitude_arrays(point, arrays)
    type(dynamics_point_type), intent(in) :: point
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp), allocatable, dimension(:, :) :: stiffness, damping
    character(len=:), allocatable :: at_amplitude
    integer :: i, k

    at_amplitude = ', with contacts that slide to and fro at an amplitude, one harmonic, '// &
                   '[frequency, amplitude, row, column] in the order '// &
                   join(coordinate_symbols(point%motion), ', ')//', NaN in the columns of phi'
    associate (amplitudes => size(point%amplitude), n => size(point%frequency), &
               motions => motions_of(point))
      allocate (stiffness(motions**2*amplitudes, n))
      allocate (damping, mold=stiffness)
      do i = 1, n
        associate (z => point%at_amplitude(:, :, :, i))
          stiffness(:, i) = [(by_rows(real(z(:, :, k), wp)), k=1, amplitudes)]
          damping(:, i) = [(by_rows(aimag(z(:, :, k))), k=1, amplitudes)]/point%frequency(i)
        end associate
      end do
      call add_array(arrays, '/dynamics/amplitude', 'm', &
                     'amplitude of the shaft, along x or along y', &
                     reshape(point%amplitude, [1, amplitudes]))
      call add_array(arrays, '/dynamics/stiffness_at_amplitude', 'N/m; N m/m', &
                     'as stiffness'//at_amplitude, stiffness, .true., motions)
      call add_array(arrays, '/dynamics/damping_at_amplitude', 'N s/m; N m s/m', &
                     'as damping'//at_amplitude, damping, .true., motions)
      call add_array(arrays, '/dynamics/friction_loss_at_amplitude', 'J', 'energy that '// &
                     'contacts lose in a cycle; a row a frequency: shaft along x, y with the '// &
                     'first amplitude, x, y with the second, ...', &
                     reshape(point%friction_loss, [2*amplitudes, n]), .true.)
    end associate
  end subroutine add_amplitude_arrays

  !> Adds the rotor's modes; a point of a sweep that has fewer than others has NaN at the end.
  subroutine add_mode_arrays(record, sweeps, points, arrays)
    type(dynamics_record_type), intent(in) :: record
    logical, intent(in) :: sweeps
    integer, intent(in) :: points
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp), allocatable :: values(:, :)
    integer :: i, k, n, most

    if (.not. allocated(record%point(1)%mode)) return
    most = 1
    do k = 1, points
      if (allocated(record%point(k)%mode)) most = max(most, size(record%point(k)%mode, 2))
    end do
    if (.not. sweeps) most = size(record%point(1)%mode, 2)
    do i = 1, mode_numbers
      allocate (values(most, points), source=ieee_value(1.0_wp, ieee_quiet_nan))
      do k = 1, points
        if (.not. allocated(record%point(k)%mode)) cycle
        n = min(most, size(record%point(k)%mode, 2))
        values(:n, k) = record%point(k)%mode(i, :n)
      end do
      if (.not. sweeps) values = transpose(values)
      call add_array(arrays, '/dynamics/mode_'//trim(mode_names(i)), trim(mode_units(i)), &
                     trim(mode_meanings(i)), values, sweeps)
      deallocate (values)
    end do
  end subroutine add_mode_arrays

  !> A table for other programs: a row a frequency, comma-separated; the value of the sweep first.
  function dynamics_table(record, sweep_name, values) result(words)
    type(dynamics_record_type), intent(in) :: record !! with an answer
    character(len=*), intent(in) :: sweep_name !! what the sweep changes; empty without one
    real(wp), intent(in) :: values(:) !! of the sweep, as many as answers, in its unit
    character(len=:), allocatable :: words
    integer, allocatable :: motion(:)
    integer :: i, k

    motion = journal_coordinates
    if (size(record%point) > 0) motion = record%point(1)%motion
    words = 'frequency'
    if (sweep_name /= '') words = sweep_name//',frequency'
    words = words//heads(motion, 'k', '')//heads(motion, 'c', '')
    if (size(record%point) > 0) then
      if (allocated(record%point(1)%error)) then
        words = words//heads(motion, 'k', '_error')//heads(motion, 'c', '_error')
      end if
    end if
    words = words//new_line('a')
    do k = 1, size(record%point)
      associate (point => record%point(k))
        do i = 1, size(point%frequency)
          if (sweep_name /= '') words = words//exact_text(values(k))//','
          words = words//exact_text(point%frequency(i))//matrix_text(stiffness_of(point, i))// &
                  matrix_text(damping_of(point, i))
          if (allocated(point%error)) then
            words = words//matrix_text(error_of(point, 1, i))//matrix_text(error_of(point, 2, i))
          end if
          words = words//new_line('a')
        end do
      end associate
    end do
  end function dynamics_table

  !> Names of a matrix' columns, each behind a comma.
  pure function heads(motion, letter, ending) result(words)
    integer, intent(in) :: motion(:) !! the shaft's coordinates
    character(len=*), intent(in) :: letter, ending !! of each name
    character(len=:), allocatable :: words
    character(len=4) :: names(size(motion))
    integer :: row, column

    names = motion_names(motion)
    words = ''
    do row = 1, size(motion)
      do column = 1, size(motion)
        words = words//','//letter//trim(names(row))//trim(names(column))//ending
      end do
    end do
  end function heads

  !> A matrix row by row, each number behind a comma.
  pure function matrix_text(matrix) result(words)
    real(wp), intent(in) :: matrix(:, :)
    character(len=:), allocatable :: words
    real(wp) :: list(size(matrix))
    integer :: i

    list = by_rows(matrix)
    words = ''
    do i = 1, size(list)
      words = words//','//exact_text(list(i))
    end do
  end function matrix_text

  !> Saves or restores a record.
  pure subroutine visit_dynamics(archive, record)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(dynamics_record_type), intent(inout) :: record !! written where the archive restores
    integer :: points, i

    points = 0
    if (allocated(record%point)) points = size(record%point)
    call archive%visit_count('points', points)
    call archive%visit('onset', record%onset)
    if (.not. archive%saves) then
      if (allocated(record%point)) deallocate (record%point)
      allocate (record%point(points))
    end if
    do i = 1, points
      call visit_point(archive, record%point(i))
      if (archive%failed) return
    end do
  end subroutine visit_dynamics

  !> Saves or restores one answer's.
  pure subroutine visit_point(archive, point)
    type(archive_type), intent(inout) :: archive
    type(dynamics_point_type), intent(inout) :: point
    real(wp), allocatable :: parts(:, :)
    integer :: entries, motions

    if (archive%saves) then
      entries = motions_of(point)**2
      allocate (parts(2*entries, size(point%frequency)))
      parts(:entries, :) = reshape(real(point%coefficient, wp), [entries, size(point%frequency)])
      parts(entries + 1:, :) = reshape(aimag(point%coefficient), [entries, size(point%frequency)])
    end if
    call archive%visit_sized('frequency', point%frequency)
    call archive%visit_sized('motion', point%motion)
    call archive%visit_sized('coefficient', parts)
    call archive%visit_sized('mode', point%mode)
    if (archive%saves .or. archive%failed) return
    call archive%require(allocated(point%frequency) .and. allocated(point%motion) .and. &
                         allocated(parts), 'the coefficients')
    if (archive%failed) return
    motions = motions_of(point)
    entries = motions**2
    call archive%require(size(parts, 1) == 2*entries .and. &
                         size(parts, 2) == size(point%frequency) .and. &
                         all(point%motion >= 1 .and. point%motion <= shaft_coordinates), &
                         'the coefficients')
    if (allocated(point%mode)) then
      call archive%require(any(size(point%mode, 1) == [0, mode_numbers]), 'the modes')
    end if
    if (archive%failed) return
    point%coefficient = reshape(cmplx(parts(:entries, :), parts(entries + 1:, :), wp), &
                                [motions, motions, size(parts, 2)])
  end subroutine visit_point
end module gfb_dynamics_record
