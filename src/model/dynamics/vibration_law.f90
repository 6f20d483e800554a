!> How the equations of a foil that vibrates depend on the frequency.
!>
!> In a motion \( e^{\lambda t} \) a foil has the stiffness
!>
!> $$ k (1 + l), \quad l = i \eta \, sgn \, \omega + \frac{c}{k} \lambda
!>    + \frac{k_m}{k} \frac{\lambda\tau}{1 + \lambda\tau}, $$
!>
!> with a loss factor, dampers, and a Maxwell arm (`gfb_maxwell_arm`). This is the only place where
!> a foil's stiffness depends on the frequency.
!>
!> Laws weight the matrices of the equations. What films store goes with \( \lambda \), springs that
!> have unknowns of their own with l. Springs without unknowns deflect by \( 1/(1 + l) \) of what
!> they do at rest: what follows from a film's gap goes with \( 1/(1 + l) - 1 \), and with
!> \( \lambda \) times that.
module gfb_vibration_law
  use gfb_kinds, only: wp
  use gfb_maxwell_arm, only: maxwell_arm_type, arm_stiffness, arm_stiffness_rate
  implicit none (type, external)
  private
  public :: weights_at, weight_rates_at, is_linear

  !> Laws by which parts are weighted, see `weights_type`; of local springs, which a node's pressure
  !> moves, the last two.
  integer, parameter, public :: by_rate = 1, by_springs = 2, by_local_springs = 3, &
                                by_rate_of_local_springs = 4

  !> What a foil does under vibration.
  type, public :: vibration_type
    logical :: stick = .true.           !! contacts that rub stick; else they slide on as they did
    real(wp) :: loss_factor = 0.0_wp    !! eta of the foil's stiffness [1]
    !> c/k, viscous damping of its springs or of meshed foils over the stiffness [s]
    real(wp) :: damping_time = 0.0_wp
    type(maxwell_arm_type) :: arm       !! beside its springs, its stiffness over theirs [1]
  contains
    procedure :: dissipates
  end type vibration_type

  !> What the matrices are multiplied with in a motion \( e^{\lambda t} \), or the derivatives of
  !> that by \( \lambda \).
  type, public :: weights_type
    complex(wp) :: squeeze, mass   !! lambda, lambda squared [1/s], [1/s2]
    complex(wp) :: springs         !! l, what the foil adds to its stiffness, over it [1]
    complex(wp) :: flow_by_gap     !! of local springs 1/(1 + l) - 1 [1]
    complex(wp) :: squeeze_by_gap  !! the same times lambda [1/s]
  contains
    procedure :: of_law
  end type weights_type

contains

  !> Whether the foil's stiffness is complex.
  pure logical function dissipates(self)
    class(vibration_type), intent(in) :: self !! what the foil does
    dissipates = self%loss_factor > 0.0_wp .or. self%damping_time > 0.0_wp .or. &
                 self%arm%is_present()
  end function dissipates

  !> Weights of the matrices in a motion \( e^{\lambda t} \).
  pure function weights_at(vibration, rate) result(weights)
    type(vibration_type), intent(in) :: vibration !! of the foil
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type) :: weights

    weights%squeeze = rate
    weights%mass = rate**2
    weights%springs = cmplx(0.0_wp, sign(vibration%loss_factor, aimag(rate)), wp) &
                      + rate*vibration%damping_time
    if (vibration%arm%is_present()) then
      weights%springs = weights%springs + arm_stiffness(vibration%arm, rate)
    end if
    weights%flow_by_gap = 1.0_wp/(1.0_wp + weights%springs) - 1.0_wp
    weights%squeeze_by_gap = rate*weights%flow_by_gap
  end function weights_at

  !> That of a law.
  pure complex(wp) function of_law(self, law) result(weight)
    class(weights_type), intent(in) :: self !! the weights, or their derivatives
    integer, intent(in) :: law !! of a part

    select case (law)
    case (by_rate)
      weight = self%squeeze
    case (by_springs)
      weight = self%springs
    case (by_local_springs)
      weight = self%flow_by_gap
    case default
      weight = self%squeeze_by_gap
    end select
  end function of_law

  !> Their derivatives by \( \lambda \); a loss factor stays what it is.
  pure function weight_rates_at(vibration, rate) result(rates)
    type(vibration_type), intent(in) :: vibration !! of the foil
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type) :: rates, weights

    weights = weights_at(vibration, rate)
    rates%squeeze = 1.0_wp
    rates%mass = 2.0_wp*rate
    rates%springs = vibration%damping_time
    if (vibration%arm%is_present()) then
      rates%springs = rates%springs + arm_stiffness_rate(vibration%arm, rate)
    end if
    rates%flow_by_gap = -rates%springs/(1.0_wp + weights%springs)**2
    rates%squeeze_by_gap = weights%flow_by_gap + rate*rates%flow_by_gap
  end function weight_rates_at

  !> Whether a law is linear in \( \lambda \): that of springs is not with a loss factor or a
  !> Maxwell arm, those of local springs are not where these lose.
  pure logical function is_linear(law, vibration) result(linear)
    integer, intent(in) :: law !! of a part
    type(vibration_type), intent(in) :: vibration !! of the foil

    select case (law)
    case (by_rate)
      linear = .true.
    case (by_springs)
      linear = .not. (vibration%loss_factor > 0.0_wp .or. vibration%arm%is_present())
    case default
      linear = .not. vibration%dissipates()
    end select
  end function is_linear
end module gfb_vibration_law
