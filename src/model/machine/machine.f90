!> A machine: a shaft that bends, where its journals are, and what acts on it.
!>
!> The shaft's place is (x, y) along it, its rotations (theta_x, theta_y). Journal i stands in its
!> sleeve, which is off the line by an offset and turned by a misalignment, with the eccentricity
!> and the tilt
!>
!> $$ e_i = o_i - (x, y), \quad t_i = m_i - (\theta_x, \theta_y). $$
module gfb_machine
  use gfb_kinds, only: wp
  use gfb_machine_case, only: machine_case_type
  use gfb_operation_case, only: angular_speed
  use gfb_shaft_element, only: shaft_section
  use gfb_shaft, only: shaft_type, segment_type, disc_type, motions, build_shaft, journal_places, &
                       node_at
  use gfb_shaft_equations, only: shaft_equations_type, shaft_equations
  use gfb_held_shaft, only: held_shaft_type, hold_shaft
  implicit none (type, external)
  private
  public :: build_machine, machine_shaft, hold_at_rest, place_of_sleeve, bearing_loads

  integer, parameter :: ways = 2 !! a journal's motions across its axis: x, y

  !> A journal of the shaft, and the sleeve around it.
  type, public :: journal_type
    real(wp) :: position = 0.0_wp        !! z of its middle [m]
    real(wp) :: offset(2) = 0.0_wp       !! of its sleeve, x and y [m]
    real(wp) :: misalignment(2) = 0.0_wp !! of its sleeve, about x and y [rad]
    integer :: place(motions) = 0        !! of its motions among the shaft's
    real(wp) :: sign(motions) = 0.0_wp   !! which they have there [1]
  end type journal_type

  !> The machine.
  type, public :: machine_type
    type(shaft_type) :: shaft
    type(shaft_equations_type) :: equations !! of all that moves
    type(journal_type), allocatable :: journal(:)
    integer :: count = motions            !! motions of a journal that its film feels
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
    integer :: i, place(motions)
    real(wp) :: sign(motions)

    machine%shaft = machine_shaft(asked, positions)
    machine%equations = shaft_equations(machine%shaft)
    machine%speed = angular_speed(asked%speed_rpm)
    machine%count = merge(motions, ways, asked%journal_tilts)
    allocate (machine%journal(size(asked%bearing_position)))
    do i = 1, size(machine%journal)
      associate (journal => machine%journal(i))
        journal%position = asked%bearing_position(i)
        journal%offset = asked%offset(:, i)
        journal%misalignment = asked%misalignment(:, i)
        call journal_places(machine%shaft, node_at(machine%shaft, journal%position), &
                            journal%place, journal%sign)
      end associate
    end do
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

  !> The shaft at rest, held at its journals.
  pure subroutine hold_at_rest(machine, count, held, regular)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: count !! motions of each journal that are held
    type(held_shaft_type), intent(out) :: held
    logical, intent(out) :: regular !! else nothing holds it
    integer :: i

    call hold_shaft(real(machine%equations%dynamic_stiffness((0.0_wp, 0.0_wp), &
                         machine%speed), wp), machine%force, &
                    [(machine%journal(i)%place(:count), i=1, size(machine%journal))], &
                    [(machine%journal(i)%sign(:count), i=1, size(machine%journal))], held, regular)
  end subroutine hold_at_rest

  !> Eccentricity and tilt of a sleeve against its journal, whose motions are given.
  pure function place_of_sleeve(journal, motion) result(place)
    type(journal_type), intent(in) :: journal
    real(wp), intent(in) :: motion(:) !! of the journal: x, y, and its rotations [m], [rad]
    real(wp) :: place(motions) !! e_x, e_y, tilt about x and y [m], [rad]

    place = [journal%offset, journal%misalignment]
    place(:size(motion)) = place(:size(motion)) - motion
    if (size(motion) < motions) place(ways + 1:) = 0.0_wp
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

    call hold_at_rest(machine, ways, held, regular)
    if (.not. regular) return
    middle = reshape([(machine%journal(i)%offset, i=1, size(machine%journal))], shape(middle))
    load = reshape(held%force - matmul(held%stiffness, pack(middle, .true.)), shape(middle))
  end subroutine bearing_loads
end module gfb_machine
