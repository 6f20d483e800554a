!> What an engineer reads off the bearing's state, over all ranks.
module gfb_bearing_answer
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  use gfb_contact_measures, only: contact_measures_type, contact_extremes, contact_sums, &
                                  measures_of, extremes, summed
  use gfb_film_load, only: film_forces
  use gfb_film_surface, only: shaft_coordinates, axial_coordinate
  use gfb_film_measures, only: force_without_suction, film_drag, film_moment, film_peclet, &
                               film_midplane_gap, pressure_moments, square_integrals
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_heat_answer, only: heat_answer_type
  use gfb_largest_stress, only: surfaces, stress_place_type, find_largest_stress
  use gfb_bearing, only: bearing_type
  use gfb_feed_answer, only: feed_answer_type, feed_answer
  use gfb_groove_answer, only: groove_answer_type, groove_answer
  use gfb_heat_numbers, only: read_heat
  implicit none (type, external)
  private
  public :: bearing_answer, place_of_gap, visit_answer

  !> change of the gap along a cell that counts as rough [1]
  real(wp), parameter :: rough_step = 0.1_wp

  !> What a thrust bearing's answer has beside those of all.
  type, public :: ring_answer_type
    logical :: present = .false.
    real(wp) :: area = 0.0_wp          !! of the pads of one side [m2]
    !> of the first pad's top foil, at the inner and outer corner of its trailing edge [m]
    real(wp) :: trailing_deflection(2) = 0.0_wp
    integer :: thinnest_pad = 1        !! number of that whose film is thinnest, of all sides
    real(wp) :: thinnest_deflection(2) = 0.0_wp !! the same as `trailing_deflection` of that one [m]
    real(wp) :: centre(2) = 0.0_wp     !! of the pressure on pad 1, from its leading edge; 0: none
    integer :: pads = 1, pads_solved = 1 !! of all sides
    integer :: sides = 1 !! of the runner that bear it
    !> force of the second side, which presses the runner back, its gap on the axis and the
    !> smallest one [N], [m], [m]
    real(wp) :: opposite_force = 0.0_wp, opposite_gap = 0.0_wp, opposite_smallest = 0.0_wp
  end type ring_answer_type

  !> Numbers of one state.
  type, public :: bearing_answer_type
    real(wp) :: place(shaft_coordinates) = 0.0_wp  !! of the sleeve relative to the shaft [m], [rad]
    real(wp) :: force(film_forces) = 0.0_wp        !! F_x, F_y on the sleeve, M_x, M_y on the shaft;
    !! with the asperities'
    real(wp) :: force_without_suction(film_forces) = 0.0_wp !! the same, p > p_a only
    real(wp) :: friction_torque = 0.0_wp           !! that brakes the shaft [N m]
    real(wp) :: power_loss = 0.0_wp                !! [W]
    real(wp) :: minimum_gap = 0.0_wp               !! at the nodes [m]
    !> z, or radius, and angle where that is; zero where the answer is brief [m], [rad]
    real(wp) :: thinnest(2) = 0.0_wp
    real(wp) :: minimum_gap_midplane = 0.0_wp      !! at z = 0 [m]
    real(wp) :: minimum_gap_edge = 0.0_wp          !! at both edges [m]
    real(wp) :: maximum_pressure = 0.0_wp          !! [Pa]
    real(wp) :: minimum_pressure = 0.0_wp          !! [Pa]
    real(wp) :: maximum_peclet = 0.0_wp            !! of the film's cells [1]
    logical :: has_foils = .false.                 !! the foils are structures
    real(wp) :: leading_edge_lift(2) = 0.0_wp  !! towards the shaft, at z = 0 and at the ends [m]
    real(wp) :: trailing_edge_lift(2) = 0.0_wp     !! the same of the other edge [m]
    real(wp) :: lifted_length = 0.0_wp         !! crest length without contact over all of it [1]
    logical :: has_solid_contact = .false.         !! the shaft's asperities may touch
    real(wp) :: solid_force(film_forces) = 0.0_wp  !! their share of `force`
    real(wp) :: solid_torque = 0.0_wp              !! with which they brake the shaft [N m]
    real(wp) :: maximum_solid_pressure = 0.0_wp    !! [Pa]
    real(wp) :: rough_peclet = 0.0_wp              !! of those where the gap changes quickly [1]
    real(wp) :: maximum_deflection = 0.0_wp        !! of the foil away from the shaft [m]
    type(contact_measures_type) :: contact         !! of the foil, what judges their laws' numbers
    type(heat_answer_type) :: heat                 !! where the film carries heat
    type(feed_answer_type) :: feed                 !! of a film that is fed
    type(groove_answer_type) :: grooves            !! of a film with grooves
    type(ring_answer_type) :: ring
    logical :: moves_along = .false. !! of a cone: the axial position counts beside the eccentricity
    !> (5, pads) share of each of several pads [N], [N m]
    real(wp), allocatable :: pad_force(:, :)
    !> largest von Mises stress of top foil and bumps, where it was asked for and is known [Pa]
    real(wp), allocatable :: foil_stress(:)
    !> of springs under a plate, pad 1, one a crest from its leading edge on [N]
    real(wp), allocatable :: line_force(:)
    real(wp), allocatable :: pad_gap(:)            !! smallest gap of each of them [m]
    real(wp), allocatable :: pad_lift(:, :)        !! (2, pads) `leading_edge_lift` of each pad [m]
  end type bearing_answer_type

contains

  !> Reads the answer off the present state.
  function bearing_answer(bearing, brief, stresses) result(answer)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    !> without the force of no suction, gaps at midplane and edge, cell Peclet numbers and lifts;
    !> default: with all of them
    logical, intent(in), optional :: brief
    logical, intent(in), optional :: stresses !! those of the foils, too; default: without
    type(bearing_answer_type) :: answer

    real(wp) :: unknown(bearing%local_size())
    real(wp) :: gap(bearing%film_nodes()), pressure(bearing%film_nodes())
    real(wp) :: sums(2*film_forces + 1, size(bearing%pad)), most(8 + extremes, size(bearing%pad))
    real(wp) :: total(size(sums, 1)), largest(size(most, 1)), contact(summed, size(bearing%pad))
    logical :: whole
    integer :: i

    whole = .true.
    if (present(brief)) whole = .not. brief
    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    pressure = bearing%film_pressure(unknown)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call read_film(bearing, pad, pressure(pad%first_node + 1:pad%last_node), &
                       gap(pad%first_node + 1:pad%last_node), bearing%position(unknown), whole, &
                       sums(:, i), most(:, i))
        if (whole) most(8, i) = maxval(pad%foil%deflection(unknown(pad%first + 1:pad%last), &
                                                             bearing%modulus(i, unknown)))
        if (whole) most(9:, i) = contact_extremes(pad%foil%contacts)
        if (whole) contact(:, i) = contact_sums(pad%foil%contacts)
      end associate
    end do
    call add_up(sums, total)
    if (whole) contact = reshape(sum_over_ranks(pack(contact, .true.)), shape(contact))
    most = reshape(largest_over_ranks(pack(most, .true.)), shape(most))
    largest = maxval(most, 2)
    if (size(bearing%pad) > 1) then
      answer%pad_force = sums(:film_forces, :)
      answer%pad_gap = -most(1, :)
    end if
    if (whole .and. bearing%is_meshed()) call read_lifts(bearing, unknown, answer)
    if (present(stresses)) then
      if (stresses .and. bearing%is_meshed()) then
        call read_stresses(bearing, unknown, answer)
      end if
    end if
    if (bearing%asperities%present) call read_solid_contact(bearing, unknown, answer)
    answer%place = bearing%shaft_place()
    answer%moves_along = size(bearing%mesh%surface%motions()) == shaft_coordinates
    answer%force = total(1:film_forces) + answer%solid_force
    answer%force_without_suction = total(film_forces + 1:2*film_forces) + answer%solid_force
    answer%friction_torque = total(size(total))*bearing%mesh%surface%radius &
                             + answer%solid_torque
    if (bearing%heat%present) then
      answer%heat = read_heat(bearing, bearing%position(unknown), unknown, gap)
      answer%friction_torque = answer%solid_torque
      if (abs(bearing%point%speed) > 0.0_wp) then
        answer%friction_torque = answer%heat%whole%power/bearing%point%speed + answer%solid_torque
      end if
    end if
    answer%power_loss = answer%friction_torque*bearing%point%speed
    call read_flows(bearing, unknown, gap, answer)
    answer%minimum_gap = -largest(1)
    if (whole) answer%thinnest = place_of_gap(bearing, gap, answer%minimum_gap)
    answer%minimum_gap_midplane = -largest(2)
    answer%minimum_gap_edge = -largest(3)
    answer%maximum_pressure = largest(4)
    answer%minimum_pressure = -largest(5)
    answer%maximum_peclet = largest(6)
    answer%rough_peclet = largest(7)
    answer%maximum_deflection = largest(8)
    if (whole) answer%contact = measures_of(largest(9:), sum(contact, 2))
    if (whole .and. bearing%mesh%surface%is_ring()) then
      answer%ring = ring_answer(bearing, pressure)
      if (answer%has_foils) call read_trailing_edges(bearing, unknown, answer)
      if (answer%ring%sides > 1) call read_other_side(bearing, answer)
    end if
  end function bearing_answer

  !> What supplies and grooves bring into the film.
  subroutine read_flows(bearing, unknown, gap, answer)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes of all films [m]
    type(bearing_answer_type), intent(inout) :: answer

    if (allocated(bearing%feed)) then
      answer%feed = feed_answer(bearing, bearing%position(unknown), unknown, gap)
    end if
    if (bearing%pad(1)%film%has_grooves()) then
      answer%grooves = groove_answer(bearing, bearing%position(unknown), unknown, gap)
    end if
  end subroutine read_flows

  !> What a thrust bearing's pads are, and where their pressure is centred.
  function ring_answer(bearing, pressure) result(answer)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: pressure(:) !! at all film nodes [Pa]
    type(ring_answer_type) :: answer
    real(wp) :: moments(3), area(2)
    integer :: i

    answer%present = .true.
    answer%pads_solved = size(bearing%pad)
    area = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        area = area + square_integrals(pad%film, pressure(pad%first_node + 1:pad%last_node))
      end associate
    end do
    area = sum_over_ranks(area)
    if (bearing%pad(size(bearing%pad))%film%surface%facing < 0.0_wp) answer%sides = 2
    answer%area = area(2)*bearing%mesh%repeats/answer%sides
    answer%pads = bearing%mesh%repeats*size(bearing%pad)
    associate (pad => bearing%pad(1))
      moments = pressure_moments(pad%film, pressure(pad%first_node + 1:pad%last_node))
      moments = sum_over_ranks(moments)
      if (abs(moments(1)) > 0.0_wp) then
        answer%centre = moments(2:)/moments(1) - [0.0_wp, pad%whole%station_angle(1)]
      end if
    end associate
  end function ring_answer

  !> What the bearing on the runner's other side does.
  subroutine read_other_side(bearing, answer)
    class(bearing_type), intent(in) :: bearing
    type(bearing_answer_type), intent(inout) :: answer !! with the shares of all pads

    associate (ring => answer%ring, first => size(answer%pad_gap)/2 + 1)
      ring%opposite_force = -sum(answer%pad_force(axial_coordinate, first:))
      ring%opposite_smallest = minval(answer%pad_gap(first:))
      ring%opposite_gap = bearing%pad(first)%film%surface%offset + answer%place(axial_coordinate)
    end associate
  end subroutine read_other_side

  !> Deflections at trailing edges: of the first pad, and of the one whose film is thinnest.
  subroutine read_trailing_edges(bearing, unknown, answer)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(bearing_answer_type), intent(inout) :: answer !! with the gaps of all pads
    real(wp), parameter :: alike = 1.0e-9_wp !! of gaps that differ by rounding: the first pad [1]
    integer :: thinnest

    associate (ring => answer%ring)
      ring%trailing_deflection = trailing_deflection(bearing, 1, unknown)
      ring%thinnest_deflection = ring%trailing_deflection
      if (.not. allocated(answer%pad_gap)) return
      thinnest = findloc(answer%pad_gap <= answer%minimum_gap + alike*abs(answer%minimum_gap), &
                         .true., dim=1)
      ring%thinnest_pad = (thinnest - 1)*bearing%mesh%repeats + 1
      ring%thinnest_deflection = trailing_deflection(bearing, thinnest, unknown)
    end associate
  end subroutine read_trailing_edges

  !> Deflection of a pad's top foil at the inner and outer corner of its trailing edge [m].
  function trailing_deflection(bearing, number, unknown) result(corner)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: number !! of the pad
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: corner(2)
    integer :: i, last

    corner = 0.0_wp
    associate (pad => bearing%pad(number))
      last = pad%whole%nodes()
      associate (moved => pad%foil%deflection(unknown(pad%first + 1:pad%last)))
        do i = 1, size(moved)
          if (.not. pad%mesh%owned(i)) cycle
          if (pad%mesh%mesh_node(i) == last - pad%whole%rows() + 1) corner(1) = moved(i)
          if (pad%mesh%mesh_node(i) == last) corner(2) = moved(i)
        end do
      end associate
    end associate
    corner = sum_over_ranks(corner)
  end function trailing_deflection

  !> Row (radius, or z) and angle of the smallest gap; of places that are alike the last one along
  !> the motion, and there the outermost of a thrust bearing, of a journal the one nearest to its
  !> midplane: an aligned one's film is alike along z.
  function place_of_gap(bearing, gap, smallest) result(place)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    real(wp), intent(in) :: gap(:)   !! at all film nodes [m]
    real(wp), intent(in) :: smallest !! of all ranks [m]
    real(wp), parameter :: alike = 1.0e-9_wp !! relative, and of angles [1], [rad]
    real(wp) :: place(2) !! [m], [rad]
    real(wp), dimension(size(gap)) :: row, outwards, angle
    real(wp) :: best(1)
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        row(pad%first_node + 1:pad%last_node) = pad%film%axial
        angle(pad%first_node + 1:pad%last_node) = pad%film%angle
      end associate
    end do
    outwards = row
    if (.not. bearing%mesh%surface%is_ring()) outwards = -abs(row)
    associate (thinnest => gap <= smallest + alike*abs(smallest)) ! which may be negative
      place(2:) = largest_over_ranks([maxval(angle, thinnest)])
      best = largest_over_ranks([maxval(outwards, thinnest .and. angle >= place(2) - alike)])
      place(:1) = largest_over_ranks([maxval(row, thinnest .and. angle >= place(2) - alike &
                                                .and. outwards >= best(1))])
    end associate
  end function place_of_gap

  !> Sums over the ranks, and over the pads.
  subroutine add_up(sums, total)
    real(wp), intent(inout) :: sums(:, :) !! (sums, pads) this rank's before
    real(wp), intent(out) :: total(:)
    integer :: i

    sums = reshape(sum_over_ranks(pack(sums, .true.)), shape(sums))
    total = sums(:, 1)
    do i = 2, size(sums, 2)
      total = total + sums(:, i)
    end do
  end subroutine add_up

  !> Sums and largest values of this rank's part of a pad's film.
  subroutine read_film(bearing, pad, pressure, gap, position, all_of_it, sums, largest)
    class(bearing_type), intent(in) :: bearing
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: pressure(:) !! at the pad's nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the pad's nodes [m]
    type(operating_point_type), intent(in) :: position !! with the shaft's position
    logical, intent(in) :: all_of_it    !! else zero where a brief answer has nothing
    real(wp), intent(out) :: sums(:)    !! force, that without suction, drag
    real(wp), intent(out) :: largest(:) !! in the order of the answer's parts

    associate (film => pad%film, whole => pad%whole)
      sums = 0.0_wp
      sums(:film_forces) = film%force(pressure)
      sums(size(sums)) = film_drag(film, pressure, gap, position)
      largest = 0.0_wp
      largest(1) = -minval(gap)
      largest(4) = maxval(pressure)
      largest(5) = -minval(pressure)
      if (.not. all_of_it) return
      sums(film_forces + 1:2*film_forces) = force_without_suction(film, pressure)
      largest(2) = -film_midplane_gap(film, gap)
      largest(3) = -minval(gap, abs(film%axial) >= whole%row_axial(whole%rows()))
      largest(6) = film_peclet(film, bearing%point, pressure, gap, 0.0_wp)
      largest(7) = film_peclet(film, bearing%point, pressure, gap, rough_step)
    end associate
  end subroutine read_film

  !> What the shaft's asperities carry, and how they rub: the shaft turns, or begins to.
  subroutine read_solid_contact(bearing, unknown, answer)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(bearing_answer_type), intent(inout) :: answer
    real(wp) :: pressure(bearing%film_nodes()), sums(film_forces + 1, size(bearing%pad))
    real(wp) :: total(film_forces + 1), largest(1)
    integer :: i

    pressure = bearing%solid_pressure(unknown)
    do i = 1, size(bearing%pad)
      associate (film => bearing%pad(i)%film, first => bearing%pad(i)%first_node + 1, &
                 last => bearing%pad(i)%last_node)
        sums(:film_forces, i) = film%force(film%ambient_pressure + pressure(first:last))
        sums(film_forces + 1, i) = film_moment(film, pressure(first:last))
      end associate
    end do
    call add_up(sums, total)
    if (allocated(answer%pad_force)) answer%pad_force = answer%pad_force + sums(:film_forces, :)
    largest = largest_over_ranks([maxval(pressure)])
    answer%has_solid_contact = .true.
    answer%solid_force = total(:film_forces)
    answer%solid_torque = bearing%asperities%friction*bearing%mesh%surface%radius* &
                          total(film_forces + 1)
    answer%maximum_solid_pressure = largest(1)
  end subroutine read_solid_contact

  !> How far the edges of the top foil stand off the bumps, and how much of the crests touches
  !> nothing.
  subroutine read_lifts(bearing, unknown, answer)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(bearing_answer_type), intent(inout) :: answer
    real(wp) :: share(2), sums(8, size(bearing%pad)), total(8)
    integer :: i

    sums = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call add_lifts(pad, -pad%foil%deflection(unknown(pad%first + 1:pad%last)), sums(:, i))
      end associate
    end do
    call add_up(sums, total)
    answer%has_foils = .true.
    answer%leading_edge_lift = total(:2)/total(3:4)
    answer%trailing_edge_lift = total(5:6)/total(7:8)
    answer%pad_lift = sums(:2, :)/sums(3:4, :)
    share = 0.0_wp
    do i = 1, size(bearing%pad)
      share = share + bearing%pad(i)%foil%crest_lengths()
    end do
    share = sum_over_ranks(share)
    if (share(2) > 0.0_wp .and. bearing%has_contacts()) answer%lifted_length = share(1)/share(2)
    associate (pad => bearing%pad(1))
      answer%line_force = sum_over_ranks(pad%foil%line_forces(unknown(pad%first + 1:pad%last)))
      if (pad%whole%half) answer%line_force = 2.0_wp*answer%line_force
    end associate
  end subroutine read_lifts

  !> The largest stress of each surface of the foils.
  subroutine read_stresses(bearing, unknown, answer)
    class(bearing_type), intent(in) :: bearing !! whose foils have meshes
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(bearing_answer_type), intent(inout) :: answer
    type(stress_place_type) :: place(surfaces)
    real(wp) :: largest(surfaces), most(surfaces)
    integer :: i

    most = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call find_largest_stress(pad%foil, unknown(pad%first + 1:pad%last), place, largest)
        most = max(most, largest*bearing%modulus(i, unknown))
      end associate
    end do
    answer%foil_stress = largest_over_ranks(most)
    answer%foil_stress = pack(answer%foil_stress, place%surface > 0)
  end subroutine read_stresses

  !> Adds this rank's lifts of the edges of a pad's top foil, and how many nodes they are of.
  pure subroutine add_lifts(pad, lift, sums)
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: lift(:)    !! at the pad's nodes [m]
    !> at the midplane and the ends: lifts of the leading edge, nodes; of the trailing edge, nodes
    real(wp), intent(inout) :: sums(:)
    real(wp) :: middle, share(2)
    integer :: i, station, row

    associate (whole => pad%whole)
      middle = minval(abs(whole%row_axial))
      do i = 1, size(lift)
        if (.not. pad%mesh%owned(i)) cycle
        station = (pad%mesh%mesh_node(i) - 1)/whole%rows() + 1
        row = pad%mesh%mesh_node(i) - (station - 1)*whole%rows()
        if (station /= 1 .and. station /= whole%stations()) cycle
        share = [merge(1.0_wp, 0.0_wp, abs(whole%row_axial(row)) <= middle), &
                 merge(1.0_wp, 0.0_wp, row == whole%rows() .or. (row == 1 .and. .not. whole%half))]
        if (station == 1) then
          sums(:2) = sums(:2) + share*lift(i)
          sums(3:4) = sums(3:4) + share
        else
          sums(5:6) = sums(5:6) + share*lift(i)
          sums(7:8) = sums(7:8) + share
        end if
      end do
    end associate
  end subroutine add_lifts

  !> Saves or restores an answer.
  pure subroutine visit_answer(archive, answer)
    type(archive_type), intent(inout) :: archive !! saves or restores
    type(bearing_answer_type), intent(inout) :: answer !! written where the archive restores

    call archive%visit('place', answer%place)
    call archive%visit('force', answer%force)
    call archive%visit('force_without_suction', answer%force_without_suction)
    call archive%visit('friction_torque', answer%friction_torque)
    call archive%visit('power_loss', answer%power_loss)
    call archive%visit('minimum_gap', answer%minimum_gap)
    call archive%visit('minimum_gap_midplane', answer%minimum_gap_midplane)
    call archive%visit('minimum_gap_edge', answer%minimum_gap_edge)
    call archive%visit('maximum_pressure', answer%maximum_pressure)
    call archive%visit('minimum_pressure', answer%minimum_pressure)
    call archive%visit('maximum_peclet', answer%maximum_peclet)
    call archive%visit('has_foils', answer%has_foils)
    call archive%visit('leading_edge_lift', answer%leading_edge_lift)
    call archive%visit('trailing_edge_lift', answer%trailing_edge_lift)
    call archive%visit('lifted_length', answer%lifted_length)
    call archive%visit('has_solid_contact', answer%has_solid_contact)
    call archive%visit('solid_force', answer%solid_force)
    call archive%visit('solid_torque', answer%solid_torque)
    call archive%visit('maximum_solid_pressure', answer%maximum_solid_pressure)
    call archive%visit('rough_peclet', answer%rough_peclet)
  end subroutine visit_answer
end module gfb_bearing_answer
