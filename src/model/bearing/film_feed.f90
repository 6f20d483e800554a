!> What feeds a bearing's films in numbers: the porous wall, or orifices with their places on this
!> rank's nodes, and where their unknowns stand.
!>
!> A mouth has three unknowns, which the last rank owns: the pressure in it and the film's mean on
!> its rim, over ambient pressure, and the gap at its centre over the clearance. Two of its
!> equations are sums over nodes, to which each rank adds its own; the third fits its pressure to
!> the film's. What it feeds follows from them: with the flow as an unknown in place of its pressure
!> thin films, whose pressure is next to the supply's, had matrices whose factors filled (0.55 s for
!> 0.04).
module gfb_film_feed
  use gfb_kinds, only: wp
  use gfb_feed_law, only: porous_wall_type, orifice_type, orifice_flow, rim_balance, supply_at
  implicit none (type, external)
  private
  public :: mouth_state, add_mixing

  integer, parameter, public :: mouth_pressure = 1, mouth_mean = 2, mouth_gap = 3
  integer, parameter, public :: mouth_unknowns = 3

  !> Nodes of an element of this rank that get gas, and how much of what each gets mixes with the
  !> film at each: \( \sum_i N_a N_b/n \) over the points where gas enters. Of a node of given
  !> pressure, which gets nothing, the others have that part at themselves.
  type, public :: mixing_type
    integer, allocatable :: node(:)      !! of the pad
    real(wp), allocatable :: share(:, :) !! (nodes, nodes) symmetric [1]
  end type mixing_type

  !> A mouth on this rank; places are those of a pad's local nodes that the rank owns.
  type, public :: fed_mouth_type
    integer :: pad = 1
    integer :: number = 1 !! of the orifice, row by row
    integer :: mirror = 1 !! the same of its mirror image on the other half of the width; itself
    real(wp) :: angle = 0.0_wp, along = 0.0_wp !! of its centre on the first pad [rad], [m]
    integer, allocatable :: node(:), centre_node(:)
    real(wp), allocatable :: weight(:), centre_weight(:) !! [1]
    real(wp) :: lack = 0.0_wp !! beta, see `gfb_fed_mouth` [1]
    real(wp) :: part = 1.0_wp !! of its flow that enters the mesh [1]
    type(mixing_type), allocatable :: mixing(:) !! where the film has heat
  end type fed_mouth_type

  !> A piece of a row of orifices that are spread evenly: the side of an element of this rank.
  type, public :: fed_line_type
    integer :: pad = 1
    integer, allocatable :: node(:)       !! of the pad
    real(wp), allocatable :: shape(:, :)  !! (nodes, points) [1]
    real(wp), allocatable :: orifices(:)  !! (points) how many each point stands for [1]
    real(wp), allocatable :: motion(:, :) !! (5, points) of the gap by the shaft
    real(wp), allocatable :: motion_excess(:, :) !! the same over what the nodes' values give
    real(wp), allocatable :: past(:)      !! (points) what earlier steps of time store [Pa m3/s]
  end type fed_line_type

  !> A mouth at a state, and derivatives of what it feeds.
  type, public :: mouth_state_type
    real(wp) :: pressure = 0.0_wp         !! p_d [Pa]
    real(wp) :: flow = 0.0_wp             !! q into the film [Pa m3/s]
    real(wp) :: flow_by_pressure = 0.0_wp !! [m3/s]
    real(wp) :: flow_by_gap = 0.0_wp      !! [Pa m2/s]
    real(wp) :: balance = 0.0_wp          !! zero where its pressure fits the film's [Pa2]
    real(wp) :: by(mouth_unknowns) = 0.0_wp !! derivatives of that by its unknowns [Pa], [Pa2/m]
    real(wp) :: by_flow = 0.0_wp          !! and by the flow alone [Pa s/m3]
  end type mouth_state_type

  !> What feeds the films.
  type, public :: film_feed_type
    type(porous_wall_type) :: wall
    type(orifice_type) :: orifice
    real(wp) :: supply = 0.0_wp       !! p_s, to which gas is compressed [Pa]
    real(wp) :: push = 0.0_wp         !! of each tube on the foil, with all of the supply [N]
    real(wp) :: volume = 0.0_wp       !! of a pocket, of gas that counts as the film's [m3]
    real(wp) :: ambient = 0.0_wp      !! p_a [Pa]
    real(wp) :: energy = 0.0_wp       !! flow in the film's unit over mass [J/kg]
    real(wp) :: work = 0.0_wp         !! to compress the gas, over its flow in that unit [1]
    real(wp) :: temperature = 0.0_wp  !! T_s, with which gas enters a film with heat [K]
    real(wp) :: size(mouth_unknowns) = 1.0_wp !! of a mouth's unknowns [SI]
    type(fed_mouth_type), allocatable :: mouth(:)
    type(fed_line_type), allocatable :: line(:)
    integer :: first = 0              !! local unknowns before those of the mouths
    real(wp) :: storage = 0.0_wp      !! a_0 of a step of time; 0: a steady state [1/s]
    !> (mouths and points of lines, 2) gas in their pockets now and one step ago, over time [Pa m3]
    real(wp), allocatable :: content(:, :)
    real(wp), allocatable :: past(:)  !! (mouths) what earlier steps store in pockets [Pa m3/s]
  contains
    procedure, non_overridable :: place, orifice_at
  end type film_feed_type

contains

  !> Adds a point where gas enters to the mixing of an element.
  pure subroutine add_mixing(shape, part, fixed, share)
    real(wp), intent(in) :: shape(:) !! functions there [1]
    real(wp), intent(in) :: part     !! of the gas [1]
    logical, intent(in) :: fixed(:)  !! nodes of given pressure
    real(wp), intent(inout) :: share(:, :) !! see `mixing_type`
    integer :: a

    do a = 1, size(shape)
      if (fixed(a)) cycle
      share(:, a) = share(:, a) + part*merge(0.0_wp, shape, fixed)*shape(a)
      share(a, a) = share(a, a) + part*shape(a)*sum(shape, fixed)
    end do
  end subroutine add_mixing

  !> Local unknown of a mouth.
  elemental integer function place(self, mouth, which)
    class(film_feed_type), intent(in) :: self !! with its numbers
    integer, intent(in) :: mouth !! from 1
    integer, intent(in) :: which !! `mouth_pressure`, `mouth_mean`, `mouth_gap`
    place = self%first + mouth_unknowns*(mouth - 1) + which
  end function place

  !> The orifices with as much of their supply as counts.
  pure type(orifice_type) function orifice_at(self, part) result(orifice)
    class(film_feed_type), intent(in) :: self !! what feeds the films
    real(wp), intent(in) :: part !! of what the supply has above ambient pressure [1]

    orifice = self%orifice
    orifice%supply_pressure = supply_at(orifice%supply_pressure, self%ambient, part)
  end function orifice_at

  !> A mouth at a state: what its orifice lets through, less what its pocket takes, and how its
  !> pressure fits that of the film.
  !>
  !> $$ q = q_o(p_d, h) - V \frac{dp_d}{dt}, \quad p_d^2 - p_0^2 - \beta q/k = 0 $$
  !>
  !> The gas in the pocket has the supply's temperature. Where each rank has a share of the
  !> viscosity the one that owns the equation has the pressures.
  pure type(mouth_state_type) function mouth_state(feed, mouth, unknown, part, viscosity, owns) &
    result(state)
    type(film_feed_type), intent(in) :: feed !! with its numbers
    integer, intent(in) :: mouth !! from 1
    real(wp), intent(in) :: unknown(:) !! of the bearing, local
    real(wp), intent(in) :: part       !! of the supply that counts [1]
    real(wp), intent(in) :: viscosity  !! of the film, or this rank's share of it [Pa s]
    logical, intent(in), optional :: owns !! this rank owns the equation; default: as if it did
    real(wp) :: here(mouth_unknowns)
    integer :: first

    first = feed%place(mouth, 1)
    here = unknown(first:first + mouth_unknowns - 1)*feed%size
    state%pressure = here(mouth_pressure)
    call orifice_flow(feed%orifice_at(part), state%pressure, here(mouth_gap), state%flow, &
                      state%flow_by_pressure, state%flow_by_gap)
    if (allocated(feed%past)) then
      state%flow = state%flow - feed%storage*feed%volume*state%pressure - feed%past(mouth)
      state%flow_by_pressure = state%flow_by_pressure - feed%storage*feed%volume
    end if
    call rim_balance(feed%mouth(mouth)%lack, viscosity, state%pressure, here(mouth_mean), &
                     here(mouth_gap), state%flow, state%balance, state%by(mouth_pressure), &
                     state%by(mouth_mean), state%by(mouth_gap), state%by_flow)
    if (present(owns)) then
      if (.not. owns) then
        state%balance = state%by_flow*state%flow
        state%by([mouth_pressure, mouth_mean]) = 0.0_wp
      end if
    end if
    state%by(mouth_pressure) = state%by(mouth_pressure) + state%by_flow*state%flow_by_pressure
    state%by(mouth_gap) = state%by(mouth_gap) + state%by_flow*state%flow_by_gap
  end function mouth_state
end module gfb_film_feed
