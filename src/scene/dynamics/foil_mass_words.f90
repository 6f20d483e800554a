!> Whether foils that move have their mass: what a key may say.
module gfb_foil_mass_words
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  integer, parameter, public :: mass_auto = 1 !! the foil has its mass where it counts
  integer, parameter, public :: mass_on = 2   !! it has it
  integer, parameter, public :: mass_off = 3  !! it has none
  character(len=*), parameter, public :: mass_words(*) = [character(len=4) :: 'auto', 'on', 'off']
  real(wp), parameter, public :: most_foil_modes = 1000.0_wp !! in a piece
  character(len=*), parameter, public :: foil_modes_words = &
    'fixed-interface modes kept inside each condensed piece of the bumps that has its mass'
end module gfb_foil_mass_words
