!> A machine: a shaft that bends, where its journals are, and what acts on it.
!>
!> The shaft's place is (x, y) along it, its rotations (theta_x, theta_y). Journal i stands in its
!> sleeve, which is off the line by an offset and turned by a misalignment, with the eccentricity
!> and the tilt
!>
!> $$ e_i = o_i - (x, y), \quad t_i = m_i - (\theta_x, \theta_y). $$
!>
!> Its film feels some of these. The motions that any film feels are the machine's held motions a,
!> each once: those of a journal are some of a, with signs.
module gfb_machine
  use gfb_kinds, only: wp
  use gfb_machine_case, only: machine_case_type
  use gfb_operation_case, only: angular_speed
  use gfb_film_surface, only: shaft_coordinates, journal_coordinates
  use gfb_shaft_element, only: shaft_section
  use gfb_shaft, only: shaft_type, segment_type, disc_type, motions, build_shaft, journal_places, &
                       node_at
  use gfb_shaft_equations, only: shaft_equations_type, shaft_equations
  use gfb_held_shaft, only: held_shaft_type, hold_shaft
  implicit none (type, external)
  private
  public :: build_machine, machine_shaft, hold_at_rest, place_of_sleeve, bearing_loads, &
            across_at_journals

  integer, parameter :: ways = 2 !! a journal's motions across its axis: x, y

  !> A journal of the shaft, and the sleeve around it.
  type, public :: journal_type
    real(wp) :: position = 0.0_wp !! z of its middle [m]
    !> Of its sleeve against the machine, see `shaft_coordinates` [m], [rad].
    real(wp) :: sleeve(shaft_coordinates) = 0.0_wp
    integer, allocatable :: coordinate(:) !! of the shaft's five, those that its film feels
    integer, allocatable :: place(:)      !! of these motions among all of the machine
    real(wp), allocatable :: sign(:)      !! which they have there [1]
    integer, allocatable :: at(:)         !! their places among the machine's held motions
  end type journal_type

  !> The machine.
  type, public :: machine_type
    type(shaft_type) :: shaft
    type(shaft_equations_type) :: equations !! of all that moves
    type(journal_type), allocatable :: journal(:)
    integer, allocatable :: held(:)       !! places of the held motions among all
    real(wp), allocatable :: force(:)     !! on the shaft: weight and loads [N], [N m]
    real(wp) :: speed = 0.0_wp            !! [rad/s]
    integer, allocatable :: station(:)    !! nodes of discs and further places
  end type machine_type

contains

  !> The shaft that a case file describes, with nodes at all that is on it.
  pure function machine_shaft(asked, positions) result(shaft)
    type(machine_case_type), intent(in) :: asked !! what the case file asks for
    real(wp), intent(in) :: positions(:) !! z of further nodes [m]
    type(shaft_type) :: shaft
    type(segment_type) :: segment(size(asked%length))
    type(disc_type) :: disc(size(asked%disc_position))
    integer :: i

    do i = 1, size(segment)
      segment(i) = segment_type(asked%length(i), shaft_section( &
        asked%outer_diameter(i), asked%inner_diameter(i), asked%youngs_modulus(i), &
        asked%shear_modulus(i), asked%density(i), asked%shear_coefficient(i)), asked%elements)
    end do
    do i = 1, size(disc)
      disc(i) = disc_type(asked%disc_position(i), asked%disc_mass(i), asked%transverse_inertia(i), &
                          asked%polar_inertia(i))
    end do
    shaft = build_shaft(segment, disc, [asked%bearing_position, asked%load_position, &
                                       asked%station, positions], asked%material_damping)
  end function machine_shaft

  !> The machine that a case file describes.
  pure function build_machine(asked, positions) result(machine)
    type(machine_case_type), intent(in) :: asked !! what the case file asks for
    real(wp), intent(in) :: positions(:) !! z of unbalances [m]
    type(machine_type) :: machine
    integer :: felt, i, place(motions)
    real(wp) :: sign(motions)

    machine%shaft = machine_shaft(asked, positions)
    machine%equations = shaft_equations(machine%shaft)
    machine%speed = angular_speed(asked%speed_rpm)
    felt = merge(motions, ways, asked%journal_tilts)
    allocate (machine%journal(size(asked%bearing_position)))
    do i = 1, size(machine%journal)
      associate (journal => machine%journal(i))
        journal%position = asked%bearing_position(i)
        journal%sleeve(journal_coordinates) = [asked%offset(:, i), asked%misalignment(:, i)]
        call journal_places(machine%shaft, node_at(machine%shaft, journal%position), &
                            place, sign)
        journal%coordinate = journal_coordinates(:felt)
        journal%place = place(:felt)
        journal%sign = sign(:felt)
      end associate
    end do
    call list_held(machine)
    machine%force = [asked%gravity(1)*machine%shaft%weight, asked%gravity(2)*machine%shaft%weight]
    do i = 1, size(asked%load_position)
      call journal_places(machine%shaft, node_at(machine%shaft, asked%load_position(i)), &
                          place, sign)
      machine%force(place) = machine%force(place) + sign*[asked%force(:, i), asked%moment(:, i)]
    end do
    machine%station = [(node_at(machine%shaft, asked%disc_position(i)), &
                        i=1, size(asked%disc_position)), &
                       (node_at(machine%shaft, asked%station(i)), i=1, size(asked%station))]
  end function build_machine

  !> Lists the motions that any film feels, each once.
  pure subroutine list_held(machine)
    type(machine_type), intent(inout) :: machine !! gets the list, and journals' places in it
    integer :: i, k

    allocate (machine%held(0))
    do i = 1, size(machine%journal)
      associate (journal => machine%journal(i))
        do k = 1, size(journal%place)
          if (any(machine%held == journal%place(k))) cycle
          machine%held = [machine%held, journal%place(k)]
        end do
        journal%at = [(findloc(machine%held, journal%place(k), 1), &
                       k=1, size(journal%place))]
      end associate
    end do
  end subroutine list_held

  !> The shaft at rest, held at its journals.
  pure subroutine hold_at_rest(machine, place, held, regular)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: place(:) !! of the motions that are held among all
    type(held_shaft_type), intent(out) :: held
    logical, intent(out) :: regular !! else nothing holds it

    call hold_shaft(real(machine%equations%dynamic_stiffness((0.0_wp, 0.0_wp), &
                         machine%speed), wp), machine%force, place, held, regular)
  end subroutine hold_at_rest

  !> Eccentricity and tilt of a sleeve against its journal, as its film feels them.
  pure function place_of_sleeve(journal, motion) result(place)
    type(journal_type), intent(in) :: journal
    real(wp), intent(in) :: motion(:) !! a, of the machine [m], [rad]
    real(wp) :: place(size(journal%at)) !! of the journal's coordinates [m], [rad]
    place = journal%sleeve(journal%coordinate) - journal%sign*motion(journal%at)
  end function place_of_sleeve

  !> Loads of the bearings, as if each held its journal in the middle of its sleeve and turned
  !> with it: of two bearings by levers.
  pure subroutine bearing_loads(machine, load, regular)
    type(machine_type), intent(in) :: machine
    real(wp), allocatable, intent(out) :: load(:, :) !! (x and y, bearing) [N]
    logical, intent(out) :: regular !! else nothing holds it
    type(held_shaft_type) :: held
    real(wp) :: middle(ways, size(machine%journal))
    integer :: i

    call hold_at_rest(machine, across_at_journals(machine), held, regular)
    if (.not. regular) return
    middle = reshape([(machine%journal(i)%sleeve(:ways), i=1, size(machine%journal))], &
                     shape(middle))
    load = reshape(held%force - matmul(held%stiffness, pack(middle, .true.)), shape(middle))
  end subroutine bearing_loads

  !> Places of the journals' translations among all motions.
  pure function across_at_journals(machine) result(place)
    type(machine_type), intent(in) :: machine
    integer :: place(ways*size(machine%journal))
    integer :: i
    place = [(machine%journal(i)%place(:ways), i=1, size(machine%journal))]
  end function across_at_journals
end module gfb_machine
