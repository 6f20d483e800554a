!> The operating point that a case file asks for.
module gfb_scene_point
  use gfb_kinds, only: wp
  use gfb_film_surface, only: axial_coordinate
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_operating_point, only: operating_point_type
  implicit none (type, external)
  private
  public :: operating_point, operating_point_type

contains

  !> Where the scene puts the shaft, in SI.
  pure function operating_point(operation) result(point)
    type(operation_case_type), intent(in) :: operation !! the scene's
    type(operating_point_type) :: point

    point%speed = angular_speed(operation%speed_rpm)
    point%load(:2) = operation%load
    point%place(:2) = operation%eccentricity
    point%place(4:5) = operation%tilt
    if (abs(operation%axial_load) > 0.0_wp) point%load(axial_coordinate) = -operation%axial_load
    point%place(axial_coordinate) = operation%axial_eccentricity
    if (operation%axial_gap > 0.0_wp) point%place(axial_coordinate) = -operation%axial_gap
    if (operation%moment_given) point%load(4:5) = operation%moment
  end function operating_point
end module gfb_scene_point
