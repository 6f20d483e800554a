!> What was decided about a bearing's meshes before they are made.
module gfb_mesh_plan
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  !> What the program decided about a scene, and the mesh it asks for.
  type, public :: bearing_plan_type
    integer :: circumferential = 0 !! film elements along the motion
    integer :: axial = 0           !! film elements along the whole width
    logical :: half = .false.      !! half the width is solved
    logical :: upwind = .false.    !! SUPG instead of Galerkin
    logical :: may_upwind = .false. !! SUPG is allowed where Galerkin finds no answer
    logical :: floats = .false.    !! the shaft's position is unknown
    real(wp) :: peclet = 0.0_wp    !! cell Peclet number of the concentric film [1]
    integer :: order = 1           !! of film elements: bilinear, biquadratic
    !> of two equal bearings that carry a rotor which tilts; 0: one bearing [m]
    real(wp) :: bearing_distance = 0.0_wp
    real(wp) :: memory = 0.0_wp    !! that the equations take, about [B]
  contains
    procedure :: nodes
  end type bearing_plan_type

contains

  !> Nodes of the film that are solved, but for a row and a station.
  pure integer function nodes(self)
    class(bearing_plan_type), intent(in) :: self !! meshes of a bearing
    nodes = self%order**2*self%circumferential*self%axial
    if (self%half) nodes = nodes/2
  end function nodes
end module gfb_mesh_plan
