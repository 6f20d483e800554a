!> What of a bearing a key of the case file acts on: from it follow how a derivative by the key is
!> made, and what is built anew where the key changes.
module gfb_key_effect
  implicit none (type, external)
  private

  integer, parameter, public :: acts_on_nothing = 0  !! it says what is computed, or how
  integer, parameter, public :: acts_on_point = 1    !! load, speed, or a place that is held
  integer, parameter, public :: acts_on_film = 2     !! gap, gas, walls, asperities: foils stay
  integer, parameter, public :: acts_on_contacts = 3 !! of the foils
  integer, parameter, public :: acts_on_gaps = 4     !! at rest between foils, 0 where not given
  integer, parameter, public :: acts_on_sheets = 5   !! of the foils: thickness, material
  integer, parameter, public :: acts_on_shapes = 6   !! of the foils: their meshes lie elsewhere
  integer, parameter, public :: acts_on_all = 7      !! the bearing is built anew
end module gfb_key_effect
