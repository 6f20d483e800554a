!> Heat along the shaft of a machine, which its films feed.
!>
!> The shaft conducts along itself, loses heat from its ends, from its surface where no bearing is
!> around it, and from its discs. At each bearing it has one temperature under the film. Condensed
!> to these, T, with the heat q of the films [Guyan1965],
!>
!> $$ S T = g + q. $$
module gfb_shaft_heat
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_fin, only: fin_conductances
  use gfb_machine_case, only: machine_case_type
  use gfb_shaft, only: shaft_type, node_at
  use gfb_held_shaft, only: held_shaft_type, hold_shaft, free_motions
  implicit none (type, external)
  private
  public :: build_shaft_heat, heat_at_ends, heat_from_surface, heat_from_discs

  !> A shaft that conducts.
  type, public :: shaft_heat_type
    logical :: present = .false.
    integer, allocatable :: at(:)     !! of each bearing its place among the temperatures, or 0
    type(held_shaft_type) :: held     !! condensed: S [W/K], g [W]
    real(wp), allocatable :: lost(:)  !! from each node through the surface [W/K]
    real(wp) :: surroundings = 0.0_wp !! temperature around the surface [K]
    integer, allocatable :: disc(:)   !! nodes of discs
    real(wp), allocatable :: disc_conductance(:) !! from them to what is around [W/K]
    real(wp), allocatable :: disc_temperature(:) !! of that [K]
    real(wp) :: end_conductance(2) = 0.0_wp !! of the first and the last end [W/K]
    real(wp) :: end_temperature(2) = 0.0_wp !! beyond them [K]
  contains
    procedure :: line
  end type shaft_heat_type

contains

  !> The shaft that a case file describes, where it says how it conducts.
  pure function build_shaft_heat(asked, shaft, heated, width) result(heat)
    type(machine_case_type), intent(in) :: asked !! what the case file asks for
    type(shaft_type), intent(in) :: shaft
    logical, intent(in) :: heated(:)  !! bearings whose films have heat
    real(wp), intent(in) :: width(:)  !! of bearings along the shaft [m]
    type(shaft_heat_type) :: heat
    real(wp) :: matrix(size(shaft%z), size(shaft%z)), source(size(shaft%z))
    real(wp) :: between, lost
    integer, allocatable :: node(:)
    integer :: i, n
    logical :: regular

    heat%present = size(asked%shaft_conductivity) > 0 .and. any(heated)
    if (.not. heat%present) return
    n = size(shaft%z)
    heat%surroundings = asked%shaft_film_temperature
    heat%end_conductance = asked%shaft_end_conductance
    heat%end_temperature = asked%shaft_end_temperature
    allocate (heat%lost(n), source=0.0_wp)
    matrix = 0.0_wp
    do i = 1, n - 1
      call piece_of_shaft(asked, [shaft%z(i), shaft%z(i + 1)], width, between, lost)
      matrix(i:i + 1, i:i + 1) = matrix(i:i + 1, i:i + 1) + between*reshape([1, -1, -1, 1], [2, 2])
      heat%lost(i:i + 1) = heat%lost(i:i + 1) + lost
    end do
    source = heat%lost*heat%surroundings
    source([1, n]) = source([1, n]) + heat%end_conductance*heat%end_temperature
    do i = 1, n
      matrix(i, i) = matrix(i, i) + heat%lost(i)
    end do
    matrix(1, 1) = matrix(1, 1) + heat%end_conductance(1)
    matrix(n, n) = matrix(n, n) + heat%end_conductance(2)
    heat%disc = [(node_at(shaft, asked%disc_position(i)), i=1, size(asked%disc_position))]
    heat%disc_conductance = asked%disc_conductance
    heat%disc_temperature = asked%disc_temperature
    do i = 1, size(heat%disc)
      associate (k => heat%disc(i), conductance => heat%disc_conductance(i))
        matrix(k, k) = matrix(k, k) + conductance
        source(k) = source(k) + conductance*heat%disc_temperature(i)
      end associate
    end do
    call list_nodes(asked, shaft, heated, node, heat%at)
    call hold_shaft(matrix, source, node, heat%held, regular)
  end function build_shaft_heat

  !> Conductances of a length of shaft of one section.
  pure subroutine piece_of_shaft(asked, ends, width, between, lost)
    type(machine_case_type), intent(in) :: asked
    real(wp), intent(in) :: ends(2)  !! z [m]
    real(wp), intent(in) :: width(:) !! of bearings [m]
    real(wp), intent(out) :: between, lost !! see `fin_conductances` [W/K]
    real(wp) :: covered
    integer :: i, segment

    segment = size(asked%length)
    do i = size(asked%length) - 1, 1, -1
      if (0.5_wp*sum(ends) < sum(asked%length(:i))) segment = i
    end do
    covered = 0.0_wp
    do i = 1, size(width)
      covered = covered + max(0.0_wp, min(ends(2), asked%bearing_position(i) + 0.5_wp*width(i)) - &
                              max(ends(1), asked%bearing_position(i) - 0.5_wp*width(i)))
    end do
    associate (outer => asked%outer_diameter(segment), inner => asked%inner_diameter(segment), &
               bare => max(0.0_wp, 1.0_wp - covered/(ends(2) - ends(1))))
      call fin_conductances(asked%shaft_conductivity(segment)*0.25_wp*pi*(outer**2 - inner**2), &
                            asked%shaft_film_conductance*pi*outer*bare, ends(2) - ends(1), &
                            between, lost)
    end associate
  end subroutine piece_of_shaft

  !> Nodes under bearings with heat, each once.
  pure subroutine list_nodes(asked, shaft, heated, node, at)
    type(machine_case_type), intent(in) :: asked
    type(shaft_type), intent(in) :: shaft
    logical, intent(in) :: heated(:)
    integer, allocatable, intent(out) :: node(:)
    integer, allocatable, intent(out) :: at(:) !! of each bearing its place among them, or 0
    integer :: i, here

    allocate (node(0), at(size(heated)))
    at = 0
    do i = 1, size(heated)
      if (.not. heated(i)) cycle
      here = node_at(shaft, asked%bearing_position(i))
      if (all(node /= here)) node = [node, here]
      at(i) = findloc(node, here, 1)
    end do
  end subroutine list_nodes

  !> Temperatures of all nodes of the shaft.
  pure function line(self, temperature)
    class(shaft_heat_type), intent(in) :: self !! the shaft
    real(wp), intent(in) :: temperature(:) !! T, at bearings [K]
    real(wp), allocatable :: line(:) !! [K]
    line = free_motions(self%held, temperature)
  end function line

  !> Heat that leaves the shaft through its ends [W].
  pure real(wp) function heat_at_ends(heat, line) result(out)
    type(shaft_heat_type), intent(in) :: heat
    real(wp), intent(in) :: line(:) !! temperatures of all nodes [K]
    out = dot_product(heat%end_conductance, line([1, size(line)]) - heat%end_temperature)
  end function heat_at_ends

  !> Heat that leaves it through its surface [W].
  pure real(wp) function heat_from_surface(heat, line) result(out)
    type(shaft_heat_type), intent(in) :: heat
    real(wp), intent(in) :: line(:) !! temperatures of all nodes [K]
    out = dot_product(heat%lost, line - heat%surroundings)
  end function heat_from_surface

  !> Heat that leaves it through its discs [W].
  pure real(wp) function heat_from_discs(heat, line) result(out)
    type(shaft_heat_type), intent(in) :: heat
    real(wp), intent(in) :: line(:) !! temperatures of all nodes [K]
    out = dot_product(heat%disc_conductance, line(heat%disc) - heat%disc_temperature)
  end function heat_from_discs
end module gfb_shaft_heat
