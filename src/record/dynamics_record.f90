!> Stiffness and damping under small vibrations: what is kept of them, as arrays and as a table.
!>
!> Z = K + i w C, with the circular frequency w, is the force of the film that brings the shaft
!> back over its displacement; rows and columns are those of e_x, e_y, phi_x, phi_y.
module gfb_dynamics_record
  use gfb_kinds, only: wp
  use gfb_text, only: exact_text
  use gfb_shaft_motion, only: shaft_coordinates
  use gfb_case_file, only: case_array_type, fill_array
  implicit none (type, external)
  private
  public :: stiffness_of, damping_of, dynamics_arrays, dynamics_table

  character(len=*), parameter :: names(shaft_coordinates) = [character(len=4) :: 'x', 'y', &
                                                             'phix', 'phiy']
  character(len=*), parameter :: order = &
    ', [frequency, row, column] in the order e_x, e_y, phi_x, phi_y: '

  !> Coefficients over frequency; none without an answer.
  type, public :: dynamics_record_type
    real(wp), allocatable :: frequency(:)          !! [rad/s]
    complex(wp), allocatable :: coefficient(:, :, :) !! (row, column, frequency) Z in SI
  end type dynamics_record_type

contains

  !> K at one of the frequencies.
  pure function stiffness_of(record, i) result(stiffness)
    type(dynamics_record_type), intent(in) :: record !! with an answer
    integer, intent(in) :: i !! number of the frequency
    real(wp) :: stiffness(shaft_coordinates, shaft_coordinates)

    stiffness = real(record%coefficient(:, :, i), wp)
  end function stiffness_of

  !> C at one of the frequencies.
  pure function damping_of(record, i) result(damping)
    type(dynamics_record_type), intent(in) :: record !! with an answer
    integer, intent(in) :: i !! number of the frequency
    real(wp) :: damping(shaft_coordinates, shaft_coordinates)

    damping = aimag(record%coefficient(:, :, i))/record%frequency(i)
  end function damping_of

  !> The arrays of the result file; none without an answer.
  function dynamics_arrays(record) result(arrays)
    type(dynamics_record_type), intent(in) :: record !! of a run
    type(case_array_type), allocatable :: arrays(:)
    real(wp), allocatable, dimension(:, :) :: stiffness, damping
    integer :: i

    allocate (arrays(merge(3, 0, allocated(record%frequency))))
    if (size(arrays) == 0) return
    allocate (stiffness(shaft_coordinates**2, size(record%frequency)))
    allocate (damping, mold=stiffness)
    do i = 1, size(record%frequency)
      stiffness(:, i) = reshape(transpose(stiffness_of(record, i)), [size(stiffness, 1)])
      damping(:, i) = reshape(transpose(damping_of(record, i)), [size(damping, 1)])
    end do
    call fill_array('/dynamics/frequency', 'rad/s', 'circular frequency of the vibration', &
                    reshape(record%frequency, [1, size(record%frequency)]), arrays(1))
    call fill_array('/dynamics/stiffness', 'N/m, N/rad; N m/m, N m/rad', &
                    'real part of K + i omega C'//order//'film force (x, y) or torque that '// &
                    'brings the shaft back, over its displacement or rotation', stiffness, &
                    arrays(2))
    call fill_array('/dynamics/damping', 'N s/m, N s/rad; N m s/m, N m s/rad', &
                    'imaginary part of K + i omega C over omega'//order// &
                    'the same over velocity or angular velocity', damping, arrays(3))
    arrays(2:)%order = shaft_coordinates
  end function dynamics_arrays

  !> A table for other programs: a row a frequency, comma-separated.
  function dynamics_table(record) result(words)
    type(dynamics_record_type), intent(in) :: record !! with an answer
    character(len=:), allocatable :: words
    integer :: i, row, column

    words = 'frequency'
    do row = 1, shaft_coordinates
      do column = 1, shaft_coordinates
        words = words//',k'//trim(names(row))//trim(names(column))
      end do
    end do
    do row = 1, shaft_coordinates
      do column = 1, shaft_coordinates
        words = words//',c'//trim(names(row))//trim(names(column))
      end do
    end do
    words = words//new_line('a')
    do i = 1, size(record%frequency)
      words = words//exact_text(record%frequency(i))//matrix_text(stiffness_of(record, i))// &
              matrix_text(damping_of(record, i))//new_line('a')
    end do
  end function dynamics_table

  !> A matrix row by row, each number behind a comma.
  pure function matrix_text(matrix) result(words)
    real(wp), intent(in) :: matrix(:, :)
    character(len=:), allocatable :: words
    integer :: row, column

    words = ''
    do row = 1, size(matrix, 1)
      do column = 1, size(matrix, 2)
        words = words//','//exact_text(matrix(row, column))
      end do
    end do
  end function matrix_text
end module gfb_dynamics_record
