!> Friction of a contact that vibrates along its surface, as a complex stiffness.
!>
!> With the displacement \( u = \Re (a e^{i \theta}) \) under a constant normal force the law
!> answers with a periodic friction. What counts of it is its first harmonic, by alternating
!> frequency and time:
!>
!> $$ k = -\frac{\bar a \cdot t_1}{|a|^2}, \qquad
!> t_1 = \frac{1}{\pi} \int_0^{2 \pi} t e^{-i \theta} d\theta, $$
!>
!> so that \( \pi |a|^2 \Im k \) is the energy that a cycle loses. Source: [Cameron1989].
module gfb_vibrating_friction
  use gfb_kinds, only: wp
  use gfb_contact_law, only: contact_law_type, friction_force, carried_slip
  implicit none (type, external)
  private
  public :: friction_stiffness

  integer, parameter :: samples = 64 !! of a cycle
  integer, parameter :: cycles = 2   !! the first one fills the law's memory
  real(wp), parameter :: rounding = 1.0e-13_wp !! of a loop without an area, over the stiffness
  real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

contains

  !> Complex stiffness of a contact that has shaken down: its friction vibrates about none.
  !>
  !> Samples are the load steps of the law. One of them is the turning point of a straight path.
  pure function friction_stiffness(law, pressing, amplitude) result(stiffness)
    type(contact_law_type), intent(in) :: law !! not `law_tanh_reset`: that never sticks
    real(wp), intent(in) :: pressing        !! normal force, positive [N]
    complex(wp), intent(in) :: amplitude(2) !! along the surface; zero: the contact sticks [m]
    complex(wp) :: stiffness                !! friction against the displacement over it [N/m]

    complex(wp) :: path(2), wave, harmonic(2)
    real(wp) :: moved(2), before(2), shift(2), force(2), by_slip(2, 2), by_pressing(2), size
    integer :: i

    shift = 0.0_wp
    size = norm2([abs(amplitude)])
    if (.not. size > 0.0_wp) then
      call friction_force(law, shift, pressing, force, by_slip, by_pressing)
      stiffness = cmplx(-by_slip(1, 1), 0.0_wp, wp)
      return
    end if
    path = along_axis(amplitude/size)
    before = 0.0_wp
    harmonic = 0.0_wp
    do i = 0, cycles*samples - 1
      wave = exp(cmplx(0.0_wp, turn*real(modulo(i, samples), wp)/real(samples, wp), wp))
      moved = size*real(path*wave, wp)
      call friction_force(law, moved - shift, pressing, force, by_slip, by_pressing)
      if (i >= (cycles - 1)*samples) harmonic = harmonic - force*conjg(wave)
      shift = moved - carried_slip(law, moved - shift, moved - before, pressing)
      before = moved
    end do
    stiffness = dot_product(path, harmonic)*(2.0_wp/real(samples, wp))/size
    if (aimag(stiffness) < rounding*real(stiffness, wp)) stiffness = real(stiffness, wp)
  end function friction_stiffness

  !> The same motion begun where it is farthest out.
  pure function along_axis(amplitude) result(path)
    complex(wp), intent(in) :: amplitude(2)
    complex(wp) :: path(2), square

    path = amplitude
    square = sum(amplitude**2)
    if (abs(square) > 0.0_wp) path = amplitude/sqrt(square/abs(square))
  end function along_axis
end module gfb_vibrating_friction
