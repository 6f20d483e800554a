!> The heat of a bearing in numbers: its walls, and where its unknowns stand.
!>
!> Unknowns of a film node are the temperatures of gas and top foil. Those of all walls stand behind
!> those of all pads, on the last rank: of the shaft (one, or one a row), the sleeve, each pad's
!> slit, the mean of each pad's top foil (where the modulus of foils follows it), the channel along
!> the bumps (one a row).
module gfb_bearing_heat
  use gfb_kinds, only: wp
  use gfb_heated_film, only: heated_gas_type, wall_given, wall_fin
  use gfb_modulus_law, only: modulus_law_type
  use gfb_gas_film, only: gas_film_type
  use gfb_operating_point, only: operating_point_type
  implicit none (type, external)
  private
  public :: number_heat, growth_of, moduli_at, temperatures_at, heat_sizes, row_of

  real(wp), parameter, public :: heat_scale = 100.0_wp !! size of a temperature [K]
  !> the modulus of top foil, bumps: by the sleeve's temperature as by that of the top foil
  logical, parameter, public :: softens_with_sleeve(2) = [.false., .true.]

  !> A wall of one temperature.
  type, public :: wall_type
    integer :: kind = wall_given !! as the scene has it
    real(wp) :: temperature = 0.0_wp !! where it is given [K]
    real(wp) :: conductance = 0.0_wp !! to what is far [W/K]
    real(wp) :: far = 0.0_wp         !! temperature there [K]
    real(wp) :: growth = 0.0_wp      !! of its radius by its temperature [m/K]
  end type wall_type

  !> What a bearing's heat depends on, and where its unknowns stand.
  type, public :: film_heat_type
    logical :: present = .false.
    type(heated_gas_type) :: gas
    real(wp) :: ambient = 0.0_wp     !! T_a, of the gas that is drawn in [K]
    real(wp) :: reference = 0.0_wp   !! at which the clearance is given [K]
    real(wp) :: carry_over = 0.0_wp  !! part of what leaves a pad that enters the next [1]
    type(wall_type) :: shaft, sleeve
    real(wp) :: fin = 0.0_wp         !! k A of a shaft that conducts along [W m/K]
    real(wp) :: end_conductance(2) = 0.0_wp !! of its ends, at -L/2 and L/2 [W/K]
    real(wp) :: end_temperature(2) = 0.0_wp !! beyond them [K]
    real(wp) :: centrifugal = 0.0_wp !! growth of the shaft's radius by its speed squared [m s2]
    logical :: sheet = .true.        !! the top foil conducts, else its temperature is given
    real(wp) :: foil_temperature = 0.0_wp !! then [K]
    real(wp) :: sheet_conductance = 0.0_wp !! k_f t_f [W/K]
    real(wp) :: bumps = 0.0_wp       !! foil to sleeve [W/(m2 K)]
    real(wp) :: channel = 0.0_wp        !! foil to the cooling gas [W/(m2 K)]
    real(wp) :: channel_sleeve = 0.0_wp !! sleeve to it [W/(m2 K)]
    real(wp) :: cooling = 0.0_wp     !! w c_p of it [W/K]
    real(wp) :: cooling_temperature = 0.0_wp !! where it enters [K]
    real(wp) :: arc = 0.0_wp         !! of all pads together, of sectors outside [m]
    type(modulus_law_type) :: modulus !! of the foils over their temperature
    logical :: has_orifices = .false. !! that feed the films
    integer, allocatable :: first(:) !! local unknowns of the bearing before those of each pad
    integer :: first_wall = 0        !! the same of the walls
    integer :: walls = 0             !! unknowns
    integer :: shafts = 1, channels = 0 !! unknowns of shaft and channel
  contains
    procedure, non_overridable :: place_of_gas, place_of_foil, place_of_shaft, place_of_channel
    procedure, non_overridable :: place_of_sleeve, place_of_slit
    procedure, non_overridable :: place_of_mean, last, grows, softens, closing
  end type film_heat_type

contains

  !> Whether temperatures change the clearance.
  pure logical function grows(self)
    class(film_heat_type), intent(in) :: self !! heat
    grows = self%present .and. max(self%shaft%growth, self%sleeve%growth) > 0.0_wp
  end function grows

  !> Whether temperatures change the modulus of the foils.
  pure logical function softens(self)
    class(film_heat_type), intent(in) :: self !! heat
    softens = self%present .and. self%modulus%is_given()
  end function softens

  !> How much a shaft and a sleeve of given temperatures take off the gap [m].
  elemental real(wp) function closing(self, shaft, sleeve)
    class(film_heat_type), intent(in) :: self !! heat
    real(wp), intent(in) :: shaft, sleeve !! their temperatures [K]
    closing = self%shaft%growth*(shaft - self%reference) &
              - self%sleeve%growth*(sleeve - self%reference)
  end function closing

  !> Local unknown of the bearing: temperature of the gas at a node of a pad's film.
  elemental integer function place_of_gas(self, pad, node) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    integer, intent(in) :: pad  !! its number
    integer, intent(in) :: node !! of this rank
    place = self%first(pad) + 2*node - 1
  end function place_of_gas

  !> That of the top foil there.
  elemental integer function place_of_foil(self, pad, node) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    integer, intent(in) :: pad  !! its number
    integer, intent(in) :: node !! of this rank
    place = self%first(pad) + 2*node
  end function place_of_foil

  !> That of the shaft as a row of nodes sees it.
  elemental integer function place_of_shaft(self, row) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    integer, intent(in) :: row !! of the film's mesh
    place = self%first_wall + merge(row, 1, self%shafts > 1)
  end function place_of_shaft

  !> The sleeve's.
  elemental integer function place_of_sleeve(self) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    place = self%first_wall + self%shafts + 1
  end function place_of_sleeve

  !> That of the gas in a pad's slit.
  elemental integer function place_of_slit(self, pad) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    integer, intent(in) :: pad !! its number
    place = self%first_wall + self%shafts + 1 + pad
  end function place_of_slit

  !> That of the mean temperature of a pad's top foil, where the modulus follows it.
  elemental integer function place_of_mean(self, pad) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    integer, intent(in) :: pad !! its number
    place = self%place_of_slit(size(self%first)) + pad
  end function place_of_mean

  !> That of the channel at a row of nodes.
  elemental integer function place_of_channel(self, row) result(place)
    class(film_heat_type), intent(in) :: self !! heat
    integer, intent(in) :: row !! of the film's mesh
    place = self%last() - self%channels + row
  end function place_of_channel

  !> The last of all temperatures among the local unknowns; those of walls are the last ones.
  elemental integer function last(self)
    class(film_heat_type), intent(in) :: self !! heat
    last = self%first_wall + self%walls
  end function last

  !> Counts the walls' unknowns.
  pure subroutine number_heat(heat, pads, rows)
    type(film_heat_type), intent(inout) :: heat !! with its numbers
    integer, intent(in) :: pads !! of the bearing
    integer, intent(in) :: rows !! of the film's mesh

    heat%shafts = merge(rows, 1, heat%shaft%kind == wall_fin)
    heat%channels = merge(rows, 0, max(heat%cooling, heat%channel, heat%channel_sleeve) > 0.0_wp)
    heat%walls = heat%shafts + 1 + pads*merge(2, 1, heat%softens()) + heat%channels
  end subroutine number_heat

  !> Sizes of the equations of heat: conduction through a cell of the film, through all of it [W].
  pure function heat_sizes(heat, film) result(scale)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(gas_film_type), intent(in) :: film  !! of its first pad
    real(wp) :: scale(heat%first(1) + 1:heat%last())

    associate (walls => heat%first_wall)
      associate (through => heat_scale*heat%gas%law%viscosity*heat%gas%specific_heat &
                 /(heat%gas%prandtl*film%clearance), area => heat%arc*film%copies*film%width)
        scale = through*product(film%cell)
        if (.not. heat%sheet) scale(heat%place_of_foil(1, 1):walls:2) = heat_scale
        scale(walls + 1:) = through*area
        if (heat%shaft%kind == wall_given) scale(walls + 1) = heat_scale
        if (heat%sleeve%kind == wall_given) scale(heat%place_of_sleeve()) = heat_scale
        associate (pads => size(heat%first))
          scale(heat%place_of_slit(1):heat%place_of_slit(pads)) = &
            through*area/heat%gas%specific_heat
          if (heat%softens()) then
            scale(heat%place_of_mean(1):heat%place_of_mean(pads)) = heat_scale*area/real(pads, wp)
          end if
        end associate
      end associate
    end associate
  end function heat_sizes

  !> How much temperature and speed take off the gap at nodes of a film [m].
  pure function growth_of(heat, mesh_node, rows, point, unknown) result(growth)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    integer, intent(in) :: mesh_node(:) !! their numbers in its whole mesh
    integer, intent(in) :: rows !! of that
    type(operating_point_type), intent(in) :: point !! whose speed counts
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp) :: growth(size(mesh_node))
    integer :: node, row

    do node = 1, size(growth)
      row = row_of(mesh_node(node), rows)
      associate (shaft => unknown(heat%place_of_shaft(row)), &
                 sleeve => unknown(heat%place_of_sleeve()))
        growth(node) = heat%centrifugal*point%speed**2 + point%growth*heat%closing(shaft, sleeve)
      end associate
    end do
  end function growth_of

  !> Moduli of a pad's top foil and bumps over those that are typed: at its mean temperature, and at
  !> the mean of that and the sleeve's. Derivatives: of the first by its mean temperature, of the
  !> second by either.
  pure subroutine moduli_at(heat, pad, part, unknown, ratio, rate)
    type(film_heat_type), intent(in) :: heat !! of the bearing, whose foils soften
    integer, intent(in) :: pad !! its number
    real(wp), intent(in) :: part !! of what temperatures do [1]
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(out) :: ratio(2), rate(2)

    associate (mean => unknown(heat%place_of_mean(pad)), &
               sleeve => unknown(heat%place_of_sleeve()))
      associate (top => heat%modulus%at(mean), bumps => heat%modulus%at(0.5_wp*(mean + sleeve)))
        ratio = 1.0_wp + part*([top(1), bumps(1)] - 1.0_wp)
        rate = part*[top(2), 0.5_wp*bumps(2)]
      end associate
    end associate
  end subroutine moduli_at

  !> Temperatures at nodes of a pad's film: (nodes, 3) of gas, top foil and shaft [K].
  pure function temperatures_at(heat, pad, mesh_node, rows, unknown) result(temperature)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    integer, intent(in) :: pad !! its number
    integer, intent(in) :: mesh_node(:) !! their numbers in its whole mesh
    integer, intent(in) :: rows !! of that
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp) :: temperature(size(mesh_node), 3)
    integer :: node

    do node = 1, size(mesh_node)
      temperature(node, :) = [unknown(heat%place_of_gas(pad, node)), &
                              unknown(heat%place_of_foil(pad, node)), &
                              unknown(heat%place_of_shaft(row_of(mesh_node(node), rows)))]
    end do
  end function temperatures_at

  !> Row of a node in a film's mesh.
  elemental integer function row_of(mesh_node, rows) result(row)
    integer, intent(in) :: mesh_node !! its number there
    integer, intent(in) :: rows      !! of the mesh
    row = modulo(mesh_node - 1, rows) + 1
  end function row_of
end module gfb_bearing_heat
