!> Pi, and what is reckoned in angles, speeds and lengths other than the SI's.
module gfb_units
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: pi, turn, degree, degrees, rpm, micrometres, ice_point

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: turn = 2.0_wp*pi      !! [rad]
  real(wp), parameter :: degree = pi/180.0_wp  !! [rad]
  real(wp), parameter :: degrees = 1.0_wp/degree !! in a radian
  real(wp), parameter :: rpm = pi/30.0_wp      !! turn a minute [rad/s]
  real(wp), parameter :: micrometres = 1.0e6_wp !! in a metre
  real(wp), parameter :: ice_point = 273.15_wp  !! 0 degrees Celsius [K]
end module gfb_units
