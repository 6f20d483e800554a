!> The flow of a film: gas and speed.
!>
!> All that holds a film holds this type, and is compiled anew with whatever is public here.
module gfb_film_flow
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: flow_here

  !> The gas between the surfaces, and how its equation is weighted, see `gfb_upwind_weight`.
  type, public :: film_flow_type
    real(wp) :: viscosity = 0.0_wp        !! dynamic viscosity of the gas [Pa s]
    real(wp) :: entraining_speed = 0.0_wp !! U, half the shaft's surface speed [m/s]
    logical :: upwind = .false.           !! SUPG instead of Galerkin weighting
  end type film_flow_type

contains

  !> The flow where the surface is faster than where its speed is given.
  elemental function flow_here(flow, stretch) result(here)
    type(film_flow_type), intent(in) :: flow !! at the radius where arcs are measured
    real(wp), intent(in) :: stretch !! see `gfb_film_surface` [1]
    type(film_flow_type) :: here

    here = flow
    here%entraining_speed = stretch*flow%entraining_speed
  end function flow_here
end module gfb_film_flow
