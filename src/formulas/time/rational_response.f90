!> A rational function of the frequency through values and slopes of a response.
!>
!> The response of linear equations to a vibration, \( Z(s) = W (A_0 + s A_1)^{-1} V \), is
!> rational in s. With values \( Z_j \) and slopes \( Z'_j \) at some rates \( s_j \), Loewner's
!> matrices have the blocks
!>
!> $$ L_{ij} = \frac{Z_i - Z_j}{s_i - s_j}, \quad M_{ij} = \frac{s_i Z_i - s_j Z_j}{s_i - s_j},
!> \quad    L_{jj} = Z'_j, \quad M_{jj} = Z_j + s_j Z'_j $$
!>
!> and \( Z(s) \approx (Z_1, Z_2, ...) (M - s L)^{-1} (Z_1; Z_2; ...) \) is what the equations give
!> that are projected onto the motions at these rates, from both sides: it has the values and
!> slopes there, and its error is the product of both projections'. Where the response to a real
!> motion is real the conjugate rates are samples, too. Directions that the samples do not show
!> from round-off are left out. Source: [MayoAntoulas2007].
module gfb_rational_response
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  !> of Loewner's matrices, relative to their largest singular value [1]
  real(wp), parameter :: round_off = 1.0e-13_wp

  !> both ends and the middle, before the function says where
  integer, parameter :: first_samples = 3
  !> samples; a function that needs more costs more than they do
  integer, parameter :: most_fitted = 24

  !> Loewner's matrices, reduced to what the samples show.
  type :: fit_type
    complex(wp), allocatable :: slope(:, :), value(:, :) !! L and M
    complex(wp), allocatable :: right(:, :), left(:, :)  !! of the samples' values
    real(wp) :: unit = 1.0_wp !! of its frequencies [rad/s]
  end type fit_type

  !> Samples of a response at rates \( i \omega \), and the function through them.
  type, public :: rational_response_type
    !> of a real motion, so that it is the conjugate at the conjugate rate
    logical :: is_real = .true.
    !> omega of the samples, in the order in which they came [rad/s]
    real(wp), allocatable :: frequency(:)
    real(wp), allocatable, private :: growth(:) !! delta of their rates, 0 of vibrations [1/s]
    complex(wp), allocatable :: value(:, :, :) !! (force, motion, sample) Z [SI]
    complex(wp), allocatable :: slope(:, :, :) !! dZ/ds there [SI]
    real(wp), allocatable, private :: scale(:) !! makes the coordinates' entries alike
    type(fit_type), private :: fit, fit_before !! to all samples; to all but the last
  contains
    procedure, non_overridable :: add, has, fits, at, beside, doubt, next_sample, poles, realise
  end type rational_response_type

  interface
    !> LAPACK: singular values and vectors.
    pure subroutine zgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, rwork, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: jobu, jobvt
      integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
      complex(wp), intent(inout) :: a(lda, n)
      real(wp), intent(out) :: s(min(m, n)), rwork(5*min(m, n))
      complex(wp), intent(out) :: u(ldu, m), vt(ldvt, n), work(lwork)
      integer, intent(out) :: info
    end subroutine zgesvd

    !> LAPACK: general equations.
    pure subroutine zgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: n, nrhs, lda, ldb
      complex(wp), intent(inout) :: a(lda, n), b(ldb, nrhs)
      integer, intent(out) :: ipiv(n), info
    end subroutine zgesv

    !> LAPACK: eigenvalues alpha/beta of a pair of general matrices.
    pure subroutine zggev(jobvl, jobvr, n, a, lda, b, ldb, alpha, beta, vl, ldvl, vr, ldvr, work, &
      lwork, rwork, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: jobvl, jobvr
      integer, intent(in) :: n, lda, ldb, ldvl, ldvr, lwork
      complex(wp), intent(inout) :: a(lda, n), b(ldb, n)
      complex(wp), intent(out) :: alpha(n), beta(n), vl(ldvl, n), vr(ldvr, n), work(lwork)
      real(wp), intent(out) :: rwork(8*n)
      integer, intent(out) :: info
    end subroutine zggev
  end interface

contains

  !> Takes a sample; one at a frequency that has one already is left out.
  pure subroutine add(self, frequency, value, slope, growth)
    class(rational_response_type), intent(inout) :: self !! gets it
    real(wp), intent(in) :: frequency      !! omega, positive beside a growth [rad/s]
    complex(wp), intent(in) :: value(:, :) !! (force, motion) Z at i omega [SI]
    complex(wp), intent(in) :: slope(:, :) !! dZ/ds there [SI]
    !> delta of a sample at the rate delta + i omega [1/s]; default: 0
    real(wp), intent(in), optional :: growth
    integer :: n, k

    n = size(value, 1)
    if (.not. allocated(self%frequency)) then
      allocate (self%frequency(0), self%growth(0), self%value(n, n, 0), self%slope(n, n, 0))
      self%scale = [(1.0_wp/sqrt(max(tiny(1.0_wp), abs(value(k, k)))), k=1, n)]
    end if
    if (present(growth)) then
      self%growth = [self%growth, growth]
    else
      if (self%has(frequency)) return
      self%growth = [self%growth, 0.0_wp]
    end if
    self%frequency = [self%frequency, frequency]
    self%value = reshape([self%value, value], [n, n, size(self%frequency)])
    self%slope = reshape([self%slope, slope], [n, n, size(self%frequency)])
    if (.not. self%fits()) return
    self%fit_before = self%fit
    self%fit = fit_of(self)
  end subroutine add

  !> Whether there is a sample at a frequency.
  pure function has(self, frequency)
    class(rational_response_type), intent(in) :: self !! the response
    real(wp), intent(in) :: frequency !! [rad/s]
    logical :: has
    has = .false.
    if (allocated(self%frequency)) has = sample_at(self, frequency) > 0
  end function has

  !> Number of the sample of a vibration, 0 where there is none.
  pure integer function sample_at(self, frequency) result(number)
    class(rational_response_type), intent(in) :: self !! with samples
    real(wp), intent(in) :: frequency !! [rad/s]
    number = findloc(abs(self%frequency - frequency) + abs(self%growth) <= 0.0_wp, .true., 1)
  end function sample_at

  !> Whether the function goes through all samples; those of more than can be fitted stand for
  !> themselves alone.
  pure function fits(self)
    class(rational_response_type), intent(in) :: self !! the response
    logical :: fits
    fits = .true.
    if (allocated(self%frequency)) fits = size(self%frequency) <= most_fitted
  end function fits

  !> The response at a frequency, at a sample's that of the sample.
  pure function at(self, frequency) result(value)
    class(rational_response_type), intent(in) :: self !! with a sample
    real(wp), intent(in) :: frequency !! omega [rad/s]
    complex(wp) :: value(size(self%scale), size(self%scale)) !! (force, motion) Z [SI]

    if (self%has(frequency)) then
      value = self%value(:, :, sample_at(self, frequency))
    else
      value = scaled(value_of(self%fit, frequency), 1.0_wp/self%scale)
    end if
  end function at

  !> The response of a motion \( e^{st} \) at a complex rate, and its derivative, as the function
  !> has them; both huge at a pole.
  pure subroutine beside(self, rate, value, slope)
    class(rational_response_type), intent(in) :: self !! with samples that fit
    complex(wp), intent(in) :: rate          !! s [1/s]
    complex(wp), intent(out) :: value(:, :)  !! (force, motion) Z [SI]
    complex(wp), intent(out) :: slope(:, :)  !! dZ/ds [SI]
    complex(wp), allocatable :: matrix(:, :), motion(:, :), rise(:, :)
    integer :: pivots(size(self%fit%value, 1)), info, n

    n = size(pivots)
    matrix = self%fit%value - rate/self%fit%unit*self%fit%slope
    motion = self%fit%right
    call zgesv(n, size(motion, 2), matrix, n, pivots, motion, n, info)
    if (info == 0) then
      matrix = self%fit%value - rate/self%fit%unit*self%fit%slope
      rise = matmul(self%fit%slope, motion)/self%fit%unit
      call zgesv(n, size(rise, 2), matrix, n, pivots, rise, n, info)
      value = scaled(matmul(self%fit%left, motion), 1.0_wp/self%scale)
      slope = scaled(matmul(self%fit%left, rise), 1.0_wp/self%scale)
    end if
    if (info == 0) return
    value = huge(1.0_wp)
    slope = huge(1.0_wp)
  end subroutine beside

  !> How far the function has moved at a frequency by the last sample: the error that it had,
  !> relative to the largest entry of like coordinates.
  pure function doubt(self, frequency)
    class(rational_response_type), intent(in) :: self !! with two samples
    real(wp), intent(in) :: frequency !! omega [rad/s]
    real(wp) :: doubt !! [1]
    complex(wp) :: now(size(self%scale), size(self%scale))

    now = scaled(self%at(frequency), self%scale)
    doubt = maxval(abs(now - value_of(self%fit_before, frequency)))/ &
            max(tiny(1.0_wp), maxval(abs(now)))
  end function doubt

  !> The frequency whose sample would help most: both ends and the middle first, then where the
  !> function moved most by the last one; 0 where no wanted one needs a sample.
  pure function next_sample(self, wanted, tolerance) result(place)
    class(rational_response_type), intent(in) :: self !! the samples so far
    real(wp), intent(in) :: wanted(:) !! frequencies [rad/s]
    real(wp), intent(in) :: tolerance !! of the error before the last sample, as `doubt` has it [1]
    integer :: place !! among the wanted
    real(wp) :: need(size(wanted))
    logical :: open(size(wanted))
    integer :: i, samples

    samples = 0
    if (allocated(self%frequency)) samples = size(self%frequency)
    open = [(.not. self%has(wanted(i)), i=1, size(wanted))]
    if (samples == 0 .or. .not. self%fits()) then
      need = wanted
    else if (samples < first_samples) then
      need = [(minval(abs(wanted(i) - self%frequency)), i=1, size(wanted))]
    else
      need = [(self%doubt(wanted(i)), i=1, size(wanted))]
      open = open .and. any(need > tolerance)
    end if
    place = maxloc(need, 1, open)
  end function next_sample

  !> Rates at which the function is infinite: those of motions that die out or grow by themselves
  !> while the shaft is held, of all that the samples show.
  pure function poles(self) result(rate)
    class(rational_response_type), intent(in) :: self !! with samples that fit
    complex(wp), allocatable :: rate(:) !! [rad/s]
    complex(wp), dimension(size(self%fit%value, 1), size(self%fit%value, 1)) :: value, slope
    complex(wp) :: numerator(size(value, 1)), denominator(size(value, 1))
    complex(wp) :: work(8*size(value, 1)), no_left(1, 1), no_right(1, 1)
    real(wp) :: room(8*size(value, 1))
    integer :: info

    value = self%fit%value
    slope = self%fit%slope
    call zggev('N', 'N', size(value, 1), value, size(value, 1), slope, size(value, 1), numerator, &
      denominator, no_left, 1, no_right, 1, work, size(work), room, info)
    if (info /= 0) denominator = 0.0_wp
    associate (finite => abs(denominator) > round_off*abs(numerator))
      rate = self%fit%unit*pack(numerator, finite)/pack(denominator, finite)
    end associate
  end function poles

  !> The function as equations of states w that follow a motion q:
  !> \( (V - s S) w = R q \), and the force is \( Z(s) q = L w \).
  pure subroutine realise(self, value, slope, right, left)
    class(rational_response_type), intent(in) :: self !! with samples that fit
    complex(wp), allocatable, intent(out) :: value(:, :) !! V (state, state) [1]
    complex(wp), allocatable, intent(out) :: slope(:, :) !! S [s]
    complex(wp), allocatable, intent(out) :: right(:, :) !! R (state, motion) [SI]
    complex(wp), allocatable, intent(out) :: left(:, :)  !! L (force, state) [SI]

    value = self%fit%value
    slope = self%fit%slope/self%fit%unit
    right = self%fit%right/spread(self%scale, 1, size(value, 1))
    left = self%fit%left/spread(self%scale, 2, size(value, 1))
  end subroutine realise

  !> The function through the samples.
  pure function fit_of(self) result(fit)
    class(rational_response_type), intent(in) :: self
    type(fit_type) :: fit
    real(wp) :: unit
    complex(wp), allocatable :: rate(:), value(:, :, :), slope(:, :, :), loewner(:, :), &
      shifted(:, :), right(:, :), left(:, :)
    integer :: i, j, n

    n = size(self%scale)
    unit = max(tiny(1.0_wp), maxval(self%frequency))
    rate = cmplx(self%growth/unit, self%frequency/unit, wp)
    value = self%value
    slope = self%slope*unit
    if (self%is_real) then
      rate = [rate, conjg(rate)]
      value = reshape([value, conjg(value)], [n, n, size(rate)])
      slope = reshape([slope, conjg(slope)], [n, n, size(rate)])
    end if
    do i = 1, size(rate)
      value(:, :, i) = scaled(value(:, :, i), self%scale)
      slope(:, :, i) = scaled(slope(:, :, i), self%scale)
    end do
    allocate (loewner(n*size(rate), n*size(rate)), shifted(n*size(rate), n*size(rate)))
    do j = 1, size(rate)
      do i = 1, size(rate)
        associate (rows => n*(i - 1), columns => n*(j - 1), step => rate(i) - rate(j))
          if (i == j) then
            loewner(rows + 1:rows + n, columns + 1:columns + n) = slope(:, :, i)
            shifted(rows + 1:rows + n, columns + 1:columns + n) = value(:, :, i) + &
              rate(i)*slope(:, :, i)
          else
            loewner(rows + 1:rows + n, columns + 1:columns + n) = (value(:, :, i) - value(:, :, &
              j))/step
            shifted(rows + 1:rows + n, columns + 1:columns + n) = (rate(i)*value(:, :, &
              i) - rate(j)*value(:, :, j))/step
          end if
        end associate
      end do
    end do
    left = reshape(value, [n, n*size(rate)])
    right = reshape(reshape(value, [n, size(rate), n], order=[1, 3, 2]), [n*size(rate), n])
    fit = reduced(loewner, shifted, right, left)
    fit%unit = unit
  end function fit_of

  !> The matrices in the directions that are more than round-off.
  pure function reduced(loewner, shifted, right, left) result(fit)
    complex(wp), intent(in) :: loewner(:, :), shifted(:, :), right(:, :), left(:, :)
    type(fit_type) :: fit
    complex(wp), allocatable :: rows(:, :), columns(:, :)

    rows = conjg(transpose(leading_directions(loewner, shifted)))
    columns = leading_directions(conjg(transpose(loewner)), conjg(transpose(shifted)))
    associate (rank => min(size(rows, 1), size(columns, 2)))
      fit%slope = matmul(rows(:rank, :), matmul(loewner, columns(:, :rank)))
      fit%value = matmul(rows(:rank, :), matmul(shifted, columns(:, :rank)))
      fit%right = matmul(rows(:rank, :), right)
      fit%left = matmul(left, columns(:, :rank))
    end associate
  end function reduced

  !> Orthonormal columns that span those of two matrices beside each other, to round-off.
  pure function leading_directions(one, other) result(direction)
    complex(wp), intent(in) :: one(:, :), other(:, :)
    complex(wp), allocatable :: direction(:, :)
    complex(wp) :: both(size(one, 1), size(one, 2) + size(other, 2)), left(size(one, 1), &
      size(one, 1)), none(1, size(both, 2))
    complex(wp) :: work(8*size(both, 2))
    real(wp) :: singular(size(one, 1)), room(5*size(one, 1))
    integer :: info

    both(:, :size(one, 2)) = one
    both(:, size(one, 2) + 1:) = other
    call zgesvd('S', 'N', size(both, 1), size(both, 2), both, size(both, 1), singular, left, &
      size(left, 1), none, 1, &
                work, size(work), room, info)
    if (info /= 0) singular(2:) = 0.0_wp
    direction = left(:, :count(singular > round_off*singular(1)))
  end function leading_directions

  !> The function at a rate, of scaled coordinates; huge at a pole.
  pure function value_of(fit, frequency) result(value)
    type(fit_type), intent(in) :: fit
    real(wp), intent(in) :: frequency !! [rad/s]
    complex(wp) :: value(size(fit%left, 1), size(fit%left, 1))
    complex(wp) :: matrix(size(fit%value, 1), size(fit%value, 1)), motion(size(fit%value, 1), &
      size(value, 2))
    integer :: pivots(size(matrix, 1)), info

    matrix = fit%value - cmplx(0.0_wp, frequency/fit%unit, wp)*fit%slope
    motion = fit%right
    call zgesv(size(matrix, 1), size(motion, 2), matrix, size(matrix, 1), pivots, motion, &
      size(matrix, 1), info)
    value = matmul(fit%left, motion)
    if (info /= 0) value = huge(1.0_wp)
  end function value_of

  !> A matrix whose coordinates are scaled.
  pure function scaled(matrix, scale) result(other)
    complex(wp), intent(in) :: matrix(:, :)
    real(wp), intent(in) :: scale(:)
    complex(wp) :: other(size(matrix, 1), size(matrix, 2))
    integer :: i

    do i = 1, size(matrix, 2)
      other(:, i) = scale*matrix(:, i)*scale(i)
    end do
  end function scaled
end module gfb_rational_response
