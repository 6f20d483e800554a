!> What of a bearing a key of the case file acts on: from it follow how a derivative by the key is
!> made, and what is built anew where the key changes.
module gfb_key_effect
  implicit none (type, external)
  private
  public :: moves_point

  integer, parameter, public :: acts_on_nothing = 0  !! it says what is computed, or how
  integer, parameter, public :: acts_on_point = 1    !! where the bearing runs, or is held
  integer, parameter, public :: acts_on_film = 2     !! gap, gas, walls, asperities: foils stay
  integer, parameter, public :: acts_on_contacts = 3 !! of the foils
  integer, parameter, public :: acts_on_gaps = 4     !! at rest between foils, 0 where not given
  integer, parameter, public :: acts_on_sheets = 5   !! of the foils: thickness, material
  integer, parameter, public :: acts_on_shapes = 6   !! of the foils: their meshes lie elsewhere
  integer, parameter, public :: acts_on_all = 7      !! the bearing is built anew
  !> of the point, what derivatives and sweeps move by itself
  integer, parameter, public :: acts_on_speed = 8
  integer, parameter, public :: acts_on_load = 9       !! across the axis, its direction kept
  integer, parameter, public :: acts_on_axial_load = 10
  integer, parameter, public :: acts_on_axial_gap = 11 !! that is held

contains

  !> Whether a key moves the operating point alone, not the bearing.
  elemental logical function moves_point(acts_on) result(moves)
    integer, intent(in) :: acts_on !! `acts_on_film`, ...

    select case (acts_on)
    case (acts_on_point, acts_on_speed, acts_on_load, acts_on_axial_load, acts_on_axial_gap)
      moves = .true.
    case default
      moves = .false.
    end select
  end function moves_point
end module gfb_key_effect
