!> Forces of a contact: a unilateral normal force and Coulomb friction, with their exact
!> derivatives.
!>
!> A contact is described by its approach \( a = (s_1, s_2, \delta) \): slip in the tangent plane,
!> and penetration. The force \( b = (t_1, t_2, f_n) \) acts on the slave: friction along the
!> tangents, pressure along the normal that points from the master to the slave.
!>
!> $$ f_n = l k \max(\delta, 0)^e, \qquad t = -\mu f_n g(|s|/u_{max}) \frac{s}{|s|} $$
!>
!> Source: [Gu2020] eqs. 9 and 10, with friction as a vector and the stiffness per length of contact
!> line. \( g \) is tanh, or min(x, 1) for the law `coulomb`: an elastic stick up to the sliding
!> limit, whose return mapping is the slip carried along (see `carried_slip`).
!>
!> In these laws the friction of a contact that sticks follows the normal force. A contact in motion
!> keeps its friction while it sticks, whatever the normal force does within the limit: with the
!> normal force \( f_0 \) that its stiffness is of,
!>
!> $$ t = -\mu \min\left(f_0 \frac{|s|}{u_{max}}, f_n\right) \frac{s}{|s|} $$
!>
!> Source: penalty regularisation of Coulomb's law with its return mapping, [SimoLaursen1992].
!>
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
module gfb_contact_law
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  implicit none (type, external)
  private
  public :: normal_force, friction_force, contact_force, carried_slip, next_place, contact_state, &
            keep_friction, slip_of_friction, friction_stiffness

  integer, parameter, public :: law_tanh_drag = 1  !! tanh; what slid is dragged along
  integer, parameter, public :: law_tanh_reset = 2 !! tanh; the shift is reset where sliding turns
  integer, parameter, public :: law_coulomb = 3    !! elastic up to the sliding limit

  integer, parameter, public :: state_open = 0
  integer, parameter, public :: state_stick = 1
  integer, parameter, public :: state_slip = 2

  real(wp), parameter :: dragged = 3.0_wp       !! stick lengths that tanh needs to reach its limit
  real(wp), parameter :: tiny_ratio = 1.0e-8_wp    !! below it the slope of g serves for g(x)/x
  !> of a slip that ends at the drag length, relative
  real(wp), parameter :: rounding = 1.0e-9_wp

  !> What two surfaces are to each other.
  type, public :: contact_law_type
    real(wp) :: normal_stiffness = 0.0_wp !! k, per metre of contact line [N/m^(1+e)]
    real(wp) :: exponent = 1.0_wp         !! e
    real(wp) :: friction = 0.0_wp         !! mu
    real(wp) :: stick_length = 0.0_wp     !! u_max [m]
    integer :: friction_law = law_tanh_drag
    real(wp) :: adhesion = 0.0_wp         !! stiffness against opening over k, of a homotopy [1]
    logical :: one_way = .false.          !! along the first tangent alone, as planar models rub
    !> f_0, the normal force that the stiffness of sticking is of; 0: that which presses [N]
    real(wp) :: stick_pressing = 0.0_wp
  end type contact_law_type

  integer, parameter :: samples = 64 !! of a cycle
  integer, parameter :: cycles = 2   !! the first one fills the law's memory
  real(wp), parameter :: no_area = 1.0e-13_wp !! of a loop without an area, over the stiffness

contains

  !> Normal force and its derivative by the penetration, [Gu2020] eq. 9.
  pure subroutine normal_force(law, length, penetration, force, slope)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: length      !! of contact line the node stands for [m]
    real(wp), intent(in) :: penetration !! [m]
    real(wp), intent(out) :: force      !! [N]
    real(wp), intent(out) :: slope      !! [N/m]

    force = 0.0_wp
    slope = 0.0_wp
    if (penetration < 0.0_wp) then
      if (.not. law%adhesion > 0.0_wp) return
      slope = length*law%normal_stiffness*law%exponent*(-penetration)**(law%exponent - 1.0_wp)
      slope = law%adhesion*slope
      force = -law%adhesion*length*law%normal_stiffness*(-penetration)**law%exponent
      return
    end if
    ! At first touch the closed side's slope is taken: a strip at rest is supported by its contacts.
    slope = length*law%normal_stiffness*law%exponent*penetration**(law%exponent - 1.0_wp)
    force = length*law%normal_stiffness*penetration**law%exponent
  end subroutine normal_force

  !> Friction and its derivatives by slip and normal force, [Gu2020] eq. 10.
  pure subroutine friction_force(law, slip, pressing, force, by_slip, by_pressing)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: slip(2)         !! s = u - u_s; the second is zero for a one-way law [m]
    real(wp), intent(in) :: pressing        !! normal force, not negative [N]
    real(wp), intent(out) :: force(2)       !! [N]
    real(wp), intent(out) :: by_slip(2, 2)  !! [N/m]
    real(wp), intent(out) :: by_pressing(2) !! [1]
    real(wp) :: distance, direction(2), level, slope, secant

    if (law%stick_pressing > 0.0_wp) then
      call kept_friction(law, slip, pressing, force, by_slip, by_pressing)
      return
    end if
    distance = norm2(slip)
    call mobilised(law, distance/law%stick_length, level, slope, secant)
    by_pressing = -law%friction*secant*slip/law%stick_length
    force = pressing*by_pressing
    by_slip = 0.0_wp
    by_slip(1, 1) = secant
    by_slip(2, 2) = secant
    if (distance > 0.0_wp) then
      direction = slip/distance
      by_slip = by_slip + (slope - secant)*spread(direction, 2, 2)*spread(direction, 1, 2)
    end if
    by_slip = -law%friction*pressing/law%stick_length*by_slip
    if (law%one_way) by_slip(2, :) = 0.0_wp
  end subroutine friction_force

  !> Friction that does not follow the normal force while the contact sticks, and its derivatives.
  pure subroutine kept_friction(law, slip, pressing, force, by_slip, by_pressing)
    type(contact_law_type), intent(in) :: law !! with its `stick_pressing`
    real(wp), intent(in) :: slip(2)         !! [m]
    real(wp), intent(in) :: pressing        !! normal force, not negative [N]
    real(wp), intent(out) :: force(2)       !! [N]
    real(wp), intent(out) :: by_slip(2, 2)  !! [N/m]
    real(wp), intent(out) :: by_pressing(2) !! [1]
    real(wp) :: stiffness, size, direction(2)

    stiffness = law%friction*law%stick_pressing/law%stick_length
    force = -stiffness*slip
    by_slip = -stiffness*reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
    by_pressing = 0.0_wp
    size = norm2(force)
    associate (limit => law%friction*pressing)
      ! What has slid begins to stick where it stopped, at the limit to round-off.
      if (size > limit*(1.0_wp + rounding)) then
        direction = force/size
        force = limit*direction
        by_slip = limit/size*(by_slip + stiffness*spread(direction, 2, 2)*spread(direction, 1, 2))
        by_pressing = law%friction*direction
      end if
    end associate
    if (law%one_way) by_slip(2, :) = 0.0_wp
  end subroutine kept_friction

  !> Share of the sliding limit that is mobilised, g(x), with g'(x) and g(x)/x.
  pure subroutine mobilised(law, ratio, level, slope, secant)
    type(contact_law_type), intent(in) :: law
    real(wp), intent(in) :: ratio !! slip in stick lengths
    real(wp), intent(out) :: level, slope, secant

    if (law%friction_law == law_coulomb) then
      level = min(ratio, 1.0_wp)
      slope = merge(1.0_wp, 0.0_wp, ratio <= 1.0_wp)
    else
      level = tanh(ratio)
      slope = 1.0_wp - level**2
    end if
    secant = slope
    if (ratio > tiny_ratio) secant = level/ratio
  end subroutine mobilised

  !> Force of a contact and its derivative by the approach.
  pure subroutine contact_force(law, length, approach, force, derivative)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: length            !! of contact line the node stands for [m]
    real(wp), intent(in) :: approach(3)       !! (s_1, s_2, delta) [m]
    real(wp), intent(out) :: force(3)         !! (t_1, t_2, f_n) [N]
    real(wp), intent(out) :: derivative(3, 3) !! (force, approach) [N/m]
    real(wp) :: slope, by_pressing(2)

    force = 0.0_wp
    derivative = 0.0_wp
    call normal_force(law, length, approach(3), force(3), slope)
    derivative(3, 3) = slope
    if (.not. law%friction > 0.0_wp .or. force(3) < 0.0_wp) return
    call friction_force(law, approach(:2), force(3), force(:2), derivative(:2, :2), by_pressing)
    derivative(:2, 3) = by_pressing*slope
  end subroutine contact_force

  !> Slip that a contact takes along from one load step to the next.
  !>
  !> Tanh with drag, and Coulomb: the part that fits into the law's rise. So no reversal need be
  !> found, and with steps far above the stick length the answer is Coulomb's. With reset, as
  !> [Gu2020] has it: none where the sliding has turned, else all of it. An open contact forgets.
  pure function carried_slip(law, slip, moved, pressing) result(carried)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: slip(2)  !! at the end of the step [m]
    real(wp), intent(in) :: moved(2) !! change of the slip within the step [m]
    real(wp), intent(in) :: pressing !! normal force [N]
    real(wp) :: carried(2)           !! [m]
    real(wp) :: distance

    carried = 0.0_wp
    if (.not. pressing > 0.0_wp) return
    carried = slip
    if (law%friction_law == law_tanh_reset) then
      if (dot_product(slip, moved) < 0.0_wp) carried = 0.0_wp
      return
    end if
    distance = norm2(slip)
    associate (longest => drag_length(law, pressing))
      if (distance > longest) carried = slip*(longest/distance)
    end associate
  end function carried_slip

  !> What a contact in motion has after a step: the slip of its friction, and the normal force that
  !> its stiffness is of from then on.
  !>
  !> That is the present one where it has slid, and the largest one since while it sticks: so what
  !> sticks is a spring, and none that is softer than its normal force makes it. An open contact
  !> forgets.
  pure subroutine keep_friction(law, slip, pressing, kept, stick_pressing)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: slip(2)  !! at the end of the step [m]
    real(wp), intent(in) :: pressing !! normal force [N]
    real(wp), intent(out) :: kept(2) !! that slip as the stiffness has it from then on [m]
    real(wp), intent(out) :: stick_pressing !! f_0 from then on [N]
    real(wp) :: force(2), by_slip(2, 2), by_pressing(2)

    kept = 0.0_wp
    stick_pressing = 0.0_wp
    if (.not. pressing > 0.0_wp .or. .not. law%friction > 0.0_wp) return
    call friction_force(law, slip, pressing, force, by_slip, by_pressing)
    stick_pressing = pressing
    if (contact_state(law, norm2(slip), pressing) == state_stick) then
      stick_pressing = max(pressing, law%stick_pressing)
    end if
    kept = slip_of_friction(law, force, stick_pressing)
  end subroutine keep_friction

  !> The slip at which a contact that sticks has a friction.
  pure function slip_of_friction(law, force, stick_pressing) result(slip)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: force(2)          !! within the limit [N]
    real(wp), intent(in) :: stick_pressing    !! f_0, positive [N]
    real(wp) :: slip(2)                       !! [m]
    slip = -force*law%stick_length/(law%friction*stick_pressing)
  end function slip_of_friction

  !> Slip from which on a contact slides [m].
  elemental real(wp) function drag_length(law, pressing) result(length)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: pressing          !! normal force [N]

    length = merge(1.0_wp, dragged, law%friction_law == law_coulomb)*law%stick_length
    if (law%stick_pressing > 0.0_wp) length = law%stick_length*pressing/law%stick_pressing
  end function drag_length

  !> Whether a contact is open, sticks or slips.
  elemental integer function contact_state(law, distance, pressing) result(state)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: distance !! length of the slip [m]
    real(wp), intent(in) :: pressing !! normal force [N]

    if (.not. pressing > 0.0_wp) then
      state = state_open
    else if (distance <= drag_length(law, pressing)*(1.0_wp + rounding) .and. &
             law%friction > 0.0_wp) then
      state = state_stick
    else
      state = state_slip
    end if
  end function contact_state

  !> Where on its law a contact is linearised next.
  !>
  !> At its approach, but where a sliding contact turned back it is first taken to stick: from one
  !> sliding direction to the other the law has no slope that would show the path between.
  pure function next_place(law, place, approach) result(next)
    type(contact_law_type), intent(in) :: law !! stiffness and friction of the contact
    real(wp), intent(in) :: place(3)    !! where it was linearised [m]
    real(wp), intent(in) :: approach(3) !! where that led to [m]
    real(wp) :: next(3)

    next = approach
    if (.not. law%friction > 0.0_wp) return
    associate (was => place(:2), is => approach(:2))
      if (norm2(was) <= law%stick_length) return
      if (dot_product(was, is) < 0.0_wp) next(:2) = 0.0_wp
    end associate
  end function next_place

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
    if (aimag(stiffness) < no_area*real(stiffness, wp)) stiffness = real(stiffness, wp)
  end function friction_stiffness

  !> The same motion begun where it is farthest out.
  pure function along_axis(amplitude) result(path)
    complex(wp), intent(in) :: amplitude(2)
    complex(wp) :: path(2), square

    path = amplitude
    square = sum(amplitude**2)
    if (abs(square) > 0.0_wp) path = amplitude/sqrt(square/abs(square))
  end function along_axis
end module gfb_contact_law
