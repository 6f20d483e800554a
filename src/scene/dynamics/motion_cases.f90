!> What is asked of a shaft that moves: the types of its groups, for the scene.
module gfb_motion_cases
  use gfb_periodic_case, only: periodic_case_type
  use gfb_transient_case, only: transient_case_type
  implicit none (type, external)
  private
  public :: periodic_case_type, transient_case_type
end module gfb_motion_cases
