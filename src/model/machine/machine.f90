!> A machine: a shaft that bends, where its journals are, and what acts on it.
!>
!> The shaft's place is (x, y) along it, its rotations (theta_x, theta_y). Journal i stands in its
!> sleeve, which is off the line by an offset and turned by a misalignment, with the eccentricity
!> and the tilt
!>
!> $$ e_i = o_i - (x, y), \quad t_i = m_i - (\theta_x, \theta_y). $$
!>
!> Its film feels some of these; that of a thrust bearing tilts, and how the shaft, which is rigid
!> along z, moves there. The motions that any film feels are the machine's held motions a, each
!> once: those of a journal are some of a, with signs. A bearing that faces -z is the mirror image
!> in z of the one in its file: z and the tilts have the other sign.
module gfb_machine
  use gfb_kinds, only: wp
  use gfb_machine_case, only: machine_case_type
  use gfb_operation_case, only: angular_speed
  use gfb_film_surface, only: shaft_coordinates, translations
  use gfb_bearing_row, only: bearing_row_type
  use gfb_moving_sleeves, only: moving_sleeve_type, true_motions, forces_on_motions, &
                                true_of_relative
  use gfb_shaft_element, only: shaft_section
  use gfb_shaft, only: shaft_type, segment_type, disc_type, motions, build_shaft, journal_places, &
                       node_at
  use gfb_shaft_equations, only: shaft_equations_type, shaft_equations
  use gfb_held_shaft, only: held_shaft_type, hold_shaft
  use gfb_shaft_heat, only: shaft_heat_type
  implicit none (type, external)
  private
  public :: build_machine, machine_shaft, hold_at_rest, place_of_sleeve, bearing_loads, &
            across_at_journals, line_of_shaft, places_along

  integer, parameter :: ways = 2 !! a journal's motions across its axis: x, y

  !> A journal of the shaft, and the sleeve around it.
  type, public :: journal_type
    real(wp) :: position = 0.0_wp !! z of its middle [m]
    real(wp) :: facing = 1.0_wp   !! -1: the mirror image in z of that in its file
    !> Of its sleeve against the machine, as the bearing's file has its axes, see
    !> `shaft_coordinates` [m], [rad].
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
    integer :: along = 0                  !! place of the shaft's motion along z; 0: it has none
    type(moving_sleeve_type), allocatable :: sleeve(:) !! those that have supports
    type(shaft_heat_type) :: heat         !! along the shaft, where it conducts
    real(wp), allocatable :: support(:)   !! stiffness of each motion behind the shaft's [N/m]
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
  pure function build_machine(asked, positions, kind) result(machine)
    type(machine_case_type), intent(in) :: asked !! what the case file asks for
    real(wp), intent(in) :: positions(:) !! z of unbalances [m]
    type(bearing_row_type), intent(in), optional :: kind(:) !! of each bearing; default: a journal's
    type(machine_type) :: machine
    type(bearing_row_type) :: row
    integer :: i

    machine%shaft = machine_shaft(asked, positions)
    machine%equations = shaft_equations(machine%shaft)
    machine%speed = angular_speed(asked%speed_rpm)
    if (present(kind)) then
      if (any(kind%moves_along)) machine%along = machine%shaft%coordinates() + 1
    end if
    allocate (machine%journal(size(asked%bearing_position)))
    do i = 1, size(machine%journal)
      if (present(kind)) row = kind(i)
      call build_journal(asked, i, row, machine)
    end do
    call list_held(machine)
    call find_sleeves(asked, machine)
    call put_forces(asked, machine)
    call join_motions(asked, machine)
    machine%station = [(node_at(machine%shaft, asked%disc_position(i)), &
                        i=1, size(asked%disc_position)), &
                       (node_at(machine%shaft, asked%station(i)), i=1, size(asked%station))]
  end function build_machine

  !> A journal, and the motions that its film feels.
  pure subroutine build_journal(asked, number, kind, machine)
    type(machine_case_type), intent(in) :: asked
    integer, intent(in) :: number !! of the bearing
    type(bearing_row_type), intent(in) :: kind !! of it
    type(machine_type), intent(inout) :: machine
    real(wp) :: sign(motions), signs(shaft_coordinates)
    integer :: i, node(motions), places(shaft_coordinates)

    associate (journal => machine%journal(number), tilts => asked%journal_tilts)
      journal%position = asked%bearing_position(number)
      journal%facing = asked%facing(number)
      call journal_places(machine%shaft, node_at(machine%shaft, journal%position), node, sign)
      journal%sleeve = [asked%offset(:, number), journal%facing* &
                        [asked%axial_offset(number), asked%misalignment(:, number)]]
      places = [node(:ways), machine%along, node(ways + 1:)]
      signs = [sign(:ways), journal%facing*[1.0_wp, sign(ways + 1:)]]
      journal%coordinate = pack([(i, i=1, shaft_coordinates)], &
                                [spread(kind%moves_across, 1, ways), kind%moves_along, &
                                 spread(tilts, 1, shaft_coordinates - translations)])
      journal%place = places(journal%coordinate)
      journal%sign = signs(journal%coordinate)
    end associate
  end subroutine build_journal

  !> Numbers the motions of sleeves that have supports.
  pure subroutine find_sleeves(asked, machine)
    type(machine_case_type), intent(in) :: asked
    type(machine_type), intent(inout) :: machine
    integer :: i, first

    allocate (machine%sleeve(0))
    first = max(machine%along, machine%shaft%coordinates())
    do i = 1, size(machine%journal)
      if (.not. has_support(asked, i)) cycle
      machine%sleeve = [machine%sleeve, moving_sleeve_type([first + 1, first + ways], &
                                                           machine%journal(i)%place(:ways))]
      first = first + ways
    end do
  end subroutine find_sleeves

  !> Whether the sleeve of a bearing has a support that gives way.
  pure logical function has_support(asked, number) result(has)
    type(machine_case_type), intent(in) :: asked
    integer, intent(in) :: number !! of the bearing
    has = any(asked%support_stiffness(:, number) > 0.0_wp)
  end function has_support

  !> Weight and loads.
  pure subroutine put_forces(asked, machine)
    type(machine_case_type), intent(in) :: asked
    type(machine_type), intent(inout) :: machine
    integer :: i, place(motions)
    real(wp) :: sign(motions)

    machine%force = [asked%gravity(1)*machine%shaft%weight, asked%gravity(2)*machine%shaft%weight]
    do i = 1, size(asked%load_position)
      call journal_places(machine%shaft, node_at(machine%shaft, asked%load_position(i)), &
                          place, sign)
      machine%force(place) = machine%force(place) + sign*[asked%force(:, i), asked%moment(:, i)]
    end do
    if (machine%along > 0) machine%force = [machine%force, -asked%axial_load]
    do i = 1, size(machine%journal)
      if (.not. has_support(asked, i)) cycle
      machine%force = [machine%force, asked%gravity*asked%support_mass(i)]
    end do
    machine%force = forces_on_motions(machine%sleeve, machine%force)
  end subroutine put_forces

  !> Puts the motions of the shaft along z and of sleeves behind those of the shaft across.
  pure subroutine join_motions(asked, machine)
    type(machine_case_type), intent(in) :: asked
    type(machine_type), intent(inout) :: machine
    real(wp), allocatable :: mass(:), damping(:), stiffness(:)
    integer :: i

    allocate (mass(0), damping(0), stiffness(0))
    if (machine%along > 0) then
      associate (body => machine%shaft%body())
        mass = [body%mass]
      end associate
      damping = [0.0_wp]
      stiffness = [0.0_wp]
    end if
    do i = 1, size(machine%journal)
      if (.not. has_support(asked, i)) cycle
      mass = [mass, spread(asked%support_mass(i), 1, ways)]
      damping = [damping, asked%support_damping(:, i)]
      stiffness = [stiffness, asked%support_stiffness(:, i)]
    end do
    machine%support = stiffness
    if (size(mass) > 0) call machine%equations%add_motions(mass, damping, stiffness)
    if (size(machine%sleeve) == 0) return
    machine%equations = machine%equations%reduced( &
                        true_of_relative(machine%sleeve, size(machine%force)))
  end subroutine join_motions

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
  !>
  !> What is left of the equations by rounding goes into S and g of `hold_shaft` in the first
  !> power: where elements are short ten digits stay. With Y, the motions that follow unit ones of
  !> journals, and w, where the loads alone bring the rest,
  !>
  !> $$ S = Y^T H Y, \quad g = Y^T (r - H w), $$
  !>
  !> in which it goes in the second power, as errors of a motion go into its energy, and products
  !> with H are those of strains.
  pure subroutine hold_at_rest(machine, place, held, regular)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: place(:) !! of the motions that are held among all
    type(held_shaft_type), intent(out) :: held
    logical, intent(out) :: regular !! else nothing holds it
    real(wp) :: motion(size(machine%force), size(place) + 1)
    real(wp) :: product(size(place) + 1, size(place) + 1)
    integer :: k

    call hold_shaft(real(machine%equations%dynamic_stiffness((0.0_wp, 0.0_wp), &
                         machine%speed), wp), machine%force, place, held, regular)
    if (.not. regular) return
    motion = 0.0_wp
    motion(held%free, :size(place)) = held%follows
    motion(held%free, size(place) + 1) = held%rest
    do k = 1, size(place)
      motion(place(k), k) = 1.0_wp
    end do
    product = stiffness_products(machine, motion)
    held%stiffness = product(:size(place), :size(place))
    held%force = matmul(machine%force, motion(:, :size(place))) - &
                 product(:size(place), size(place) + 1)
  end subroutine hold_at_rest

  !> \( U^T H U \) of motions at rest, with the circulation of the shaft's material.
  pure function stiffness_products(machine, motion) result(product)
    type(machine_type), intent(in) :: machine
    !> U (motion, column), journals relative to sleeves [m], [1]
    real(wp), intent(in) :: motion(:, :)
    real(wp) :: product(size(motion, 2), size(motion, 2)) !! [J]
    real(wp) :: true(size(motion, 1), size(motion, 2))
    integer :: k, n

    do k = 1, size(motion, 2)
      true(:, k) = true_motions(machine%sleeve, motion(:, k))
    end do
    n = machine%shaft%coordinates()/2
    associate (x => true(:n, :), y => true(n + 1:2*n, :), further => true(2*n + 1:, :), &
               shaft => machine%shaft)
      product = shaft%strain_products(x, x) + shaft%strain_products(y, y) + &
                machine%speed*shaft%material_damping* &
                (shaft%strain_products(x, y) - shaft%strain_products(y, x)) + &
                matmul(transpose(further), spread(machine%support, 2, size(further, 2))*further)
    end associate
  end function stiffness_products

  !> Eccentricity and tilt of a sleeve against its journal, as its film feels them.
  pure function place_of_sleeve(journal, motion) result(place)
    type(journal_type), intent(in) :: journal
    real(wp), intent(in) :: motion(:) !! a, of the machine [m], [rad]
    real(wp) :: place(size(journal%at)) !! of the journal's coordinates [m], [rad]
    place = journal%sleeve(journal%coordinate) - journal%sign*motion(journal%at)
  end function place_of_sleeve

  !> Motions of the shaft across its axis, of all motions of the machine.
  pure function line_of_shaft(machine, motion) result(line)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: motion(:) !! all [m], [1]
    real(wp), allocatable :: line(:) !! both planes [m], [1]

    line = true_motions(machine%sleeve, motion)
    line = line(:machine%shaft%coordinates())
  end function line_of_shaft

  !> Where the shaft's axis is: x and y of each node.
  pure function places_along(machine, motion, node) result(place)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: motion(:) !! all of the machine [m], [1]
    integer, intent(in) :: node(:)
    real(wp) :: place(2*size(node)) !! [m]
    real(wp), allocatable :: line(:)
    real(wp) :: sign(motions)
    integer :: i, at(motions)

    line = line_of_shaft(machine, motion)
    do i = 1, size(node)
      call journal_places(machine%shaft, node(i), at, sign)
      place(2*i - 1:2*i) = sign(:2)*line(at(:2))
    end do
  end function places_along

  !> Loads of the journal bearings, as if each held its journal in the middle of its sleeve and
  !> turned with it: of two bearings by levers.
  pure subroutine bearing_loads(machine, load, regular)
    type(machine_type), intent(in) :: machine
    real(wp), allocatable, intent(out) :: load(:, :) !! (x and y, bearing) [N]
    logical, intent(out) :: regular !! else nothing holds it
    type(held_shaft_type) :: held
    real(wp), allocatable :: middle(:), force(:)
    integer :: i, first

    allocate (load(ways, size(machine%journal)), source=0.0_wp)
    call hold_at_rest(machine, across_at_journals(machine), held, regular)
    if (.not. regular) return
    middle = [(pack(machine%journal(i)%sleeve(machine%journal(i)%coordinate), &
                    holds_shaft(machine, machine%journal(i))), i=1, size(machine%journal))]
    if (machine%along > 0) middle = [middle, 0.0_wp]
    force = held%force - matmul(held%stiffness, middle)
    first = 0
    do i = 1, size(machine%journal)
      if (.not. any(machine%journal(i)%coordinate == 1)) cycle
      load(:, i) = force(first + 1:first + ways)
      first = first + ways
    end do
  end subroutine bearing_loads

  !> Which motions of a journal hold the shaft across its axis: its translations, and of a bearing
  !> that does so alone its tilts.
  pure function holds_shaft(machine, journal) result(holds)
    type(machine_type), intent(in) :: machine
    type(journal_type), intent(in) :: journal
    logical :: holds(size(journal%coordinate))
    integer :: i, others

    others = count([(any(machine%journal(i)%coordinate == 1), i=1, size(machine%journal))]) - 1
    holds = journal%coordinate <= ways
    if (others == 0 .and. any(holds)) holds = holds .or. journal%coordinate > translations
  end function holds_shaft

  !> Places of the motions that hold the shaft across its axis among all, and of that along z.
  pure function across_at_journals(machine) result(place)
    type(machine_type), intent(in) :: machine
    integer, allocatable :: place(:)
    integer :: i

    allocate (place(0))
    do i = 1, size(machine%journal)
      associate (journal => machine%journal(i))
        place = [place, pack(journal%place, holds_shaft(machine, journal))]
      end associate
    end do
    if (machine%along > 0) place = [place, machine%along]
  end function across_at_journals
end module gfb_machine
