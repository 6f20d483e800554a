!> What feeds a bearing's films in numbers: the porous wall, or orifices with their places on this
!> rank's nodes, and where their unknowns stand.
!>
!> A mouth has three unknowns, which the last rank owns: the flow into the film over the size of
!> one, the mean pressure on its rim over the ambient one, the gap at its centre over the clearance.
!> Two of its equations are sums over nodes, to which each rank adds its own; the third is the
!> law of the orifice, of these three alone.
module gfb_film_feed
  use gfb_kinds, only: wp
  use gfb_feed_law, only: porous_wall_type, orifice_type, orifice_flow, rim_pressure, supply_at
  implicit none (type, external)
  private
  public :: mouth_law, mouth_state

  integer, parameter, public :: mouth_flow = 1, mouth_mean = 2, mouth_gap = 3, mouth_unknowns = 3

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

  !> What feeds the films.
  type, public :: film_feed_type
    type(porous_wall_type) :: wall
    type(orifice_type) :: orifice
    real(wp) :: volume = 0.0_wp       !! of a pocket [m3]
    real(wp) :: ambient = 0.0_wp      !! p_a [Pa]
    real(wp) :: energy = 0.0_wp       !! Rg T_s, flow in the film's unit over mass [J/kg]
    real(wp) :: flow_size = 1.0_wp    !! of an orifice's flow [Pa m3/s]
    real(wp) :: size(mouth_unknowns) = 1.0_wp !! of a mouth's unknowns [SI]
    type(fed_mouth_type), allocatable :: mouth(:)
    type(fed_line_type), allocatable :: line(:)
    integer :: first = 0              !! local unknowns before those of the mouths
    real(wp) :: storage = 0.0_wp      !! a_0 of a step of time; 0: a steady state [1/s]
    !> (mouths and points of lines, 2) gas in their pockets now and one step ago, over time [Pa m3]
    real(wp), allocatable :: content(:, :)
    real(wp), allocatable :: past(:)  !! (mouths) what earlier steps store in pockets [Pa m3/s]
  contains
    procedure, non_overridable :: place, supply_pressure, orifice_at
  end type film_feed_type

contains

  !> Local unknown of a mouth.
  elemental integer function place(self, mouth, which)
    class(film_feed_type), intent(in) :: self !! with its numbers
    integer, intent(in) :: mouth !! from 1
    integer, intent(in) :: which !! `mouth_flow`, `mouth_mean`, `mouth_gap`
    place = self%first + mouth_unknowns*(mouth - 1) + which
  end function place

  !> Absolute pressure of the supply [Pa].
  pure real(wp) function supply_pressure(self) result(pressure)
    class(film_feed_type), intent(in) :: self !! what feeds the films
    pressure = merge(self%wall%supply_pressure, self%orifice%supply_pressure, self%wall%present)
  end function supply_pressure

  !> The orifices with as much of their supply as counts.
  pure type(orifice_type) function orifice_at(self, part) result(orifice)
    class(film_feed_type), intent(in) :: self !! what feeds the films
    real(wp), intent(in) :: part !! of what the supply has above ambient pressure [1]

    orifice = self%orifice
    orifice%supply_pressure = supply_at(orifice%supply_pressure, self%ambient, part)
  end function orifice_at

  !> The law of one of a bearing's mouths at a state: its value and derivatives by flow, mean
  !> and gap, then those of the pressure in it, in SI.
  pure subroutine mouth_state(feed, mouth, unknown, part, viscosity, law, pressure)
    type(film_feed_type), intent(in) :: feed !! with its numbers
    integer, intent(in) :: mouth !! from 1
    real(wp), intent(in) :: unknown(:) !! of the bearing, local
    real(wp), intent(in) :: part       !! of the supply that counts [1]
    real(wp), intent(in) :: viscosity  !! of the film [Pa s]
    real(wp), intent(out) :: law(7)    !! value, three derivatives, three of the pressure
    real(wp), intent(out) :: pressure  !! in the mouth [Pa]
    real(wp) :: here(mouth_unknowns), past
    integer :: first

    first = feed%place(mouth, 1)
    here = unknown(first:first + mouth_unknowns - 1)*feed%size
    past = 0.0_wp
    if (allocated(feed%past)) past = feed%past(mouth)
    call mouth_law(feed, feed%orifice_at(part), feed%mouth(mouth)%lack, viscosity, here(mouth_flow), here(mouth_mean), &
                   here(mouth_gap), past, law(1), law(2), law(3), law(4), pressure, law(5), &
                   law(6), law(7))
  end subroutine mouth_state

  !> The law of an orifice with its pocket: what enters the film, less what its hole lets through
  !> and its pocket gives; the pressure in the mouth; and the derivatives of both.
  !>
  !> $$ q - q_o(p_d, h) + V \frac{dp_d}{dt} = 0 $$
  !>
  !> The gas in the pocket has the supply's temperature, as the film has.
  elemental subroutine mouth_law(feed, orifice, lack, viscosity, flow, mean, gap, past, value, by_flow, &
                                 by_mean, by_gap, pressure, pressure_by_flow, pressure_by_mean, &
                                 pressure_by_gap)
    type(film_feed_type), intent(in) :: feed !! with `storage` of a step of time
    type(orifice_type), intent(in) :: orifice !! with the supply that there is
    real(wp), intent(in) :: lack      !! beta of the mouth [1]
    real(wp), intent(in) :: viscosity !! of the film [Pa s]
    real(wp), intent(in) :: flow      !! q into the film [Pa m3/s]
    real(wp), intent(in) :: mean      !! pressure on the rim [Pa]
    real(wp), intent(in) :: gap       !! h [m]
    real(wp), intent(in) :: past      !! what earlier steps store [Pa m3/s]
    real(wp), intent(out) :: value    !! of the equation [Pa m3/s]
    real(wp), intent(out) :: by_flow, by_mean, by_gap !! [1], [m3/s], [Pa m2/s]
    real(wp), intent(out) :: pressure !! p_d [Pa]
    !> [s/m3], [1], [Pa/m]
    real(wp), intent(out) :: pressure_by_flow, pressure_by_mean, pressure_by_gap
    real(wp) :: through, by_pressure, direct

    call rim_pressure(lack, viscosity, mean, flow, gap, pressure, pressure_by_mean, &
                      pressure_by_flow, pressure_by_gap)
    call orifice_flow(orifice, pressure, gap, through, by_pressure, direct)
    associate (by_p => feed%storage*feed%volume - by_pressure)
      value = flow - through + feed%storage*feed%volume*pressure + past
      by_flow = 1.0_wp + by_p*pressure_by_flow
      by_mean = by_p*pressure_by_mean
      by_gap = by_p*pressure_by_gap - direct
    end associate
  end subroutine mouth_law
end module gfb_film_feed
