!> What an engineer reads off the bearing's state, over all ranks.
module gfb_bearing_answer
  use gfb_kinds, only: wp
  use gfb_memory, only: memory_type
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  use gfb_film_load, only: film_forces
  use gfb_film_measures, only: force_without_suction, film_drag, film_integral, film_peclet, &
                               film_midplane_gap
  use gfb_bearing, only: film_values
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type, external)
  private
  public :: bearing_answer, film_block, full_rows
  public :: remember_answer

  !> change of the gap along a cell that counts as rough [1]
  real(wp), parameter :: rough_step = 0.1_wp

  !> Numbers of one state.
  type, public :: bearing_answer_type
    real(wp) :: eccentricity(2) = 0.0_wp           !! [m]
    real(wp) :: force(film_forces) = 0.0_wp        !! F_x, F_y on the sleeve, M_x, M_y on the shaft;
    !! with the asperities'
    real(wp) :: force_without_suction(film_forces) = 0.0_wp !! the same, p > p_a only
    real(wp) :: friction_torque = 0.0_wp           !! that brakes the shaft [N m]
    real(wp) :: power_loss = 0.0_wp                !! [W]
    real(wp) :: minimum_gap = 0.0_wp               !! at the nodes [m]
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
  end type bearing_answer_type

contains

  !> Reads the answer off the present state.
  function bearing_answer(bearing) result(answer)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    type(bearing_answer_type) :: answer

    real(wp) :: unknown(bearing%local_size()), largest(7)
    real(wp) :: gap(bearing%film_nodes()), pressure(bearing%film_nodes())
    real(wp) :: total(2*film_forces + 1)

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    pressure = unknown(:size(gap))
    associate (film => bearing%pad(1)%film, whole => bearing%pad(1)%whole)
      total = sum_over_ranks([film%force(pressure), force_without_suction(film, pressure), &
                              film_drag(film, pressure, gap, bearing%position(unknown))])
      largest(1) = -minval(gap)
      largest(2) = -film_midplane_gap(film, gap)
      largest(3) = -minval(gap, abs(film%axial) >= whole%row_axial(whole%rows()))
      largest(4) = maxval(pressure)
      largest(5) = -minval(pressure)
      largest(6) = film_peclet(film, bearing%point, pressure, gap, 0.0_wp)
      largest(7) = film_peclet(film, bearing%point, pressure, gap, rough_step)
      largest = largest_over_ranks(largest)
    end associate
    if (bearing%pad(1)%foil%is_meshed()) call read_lifts(bearing, unknown, answer)
    if (bearing%pad(1)%contact%present) call read_solid_contact(bearing, unknown, answer)
    answer%eccentricity = bearing%eccentricity()
    answer%force = total(1:film_forces) + answer%solid_force
    answer%force_without_suction = total(film_forces + 1:2*film_forces) + answer%solid_force
    answer%friction_torque = total(size(total))*bearing%pad(1)%film%radius + answer%solid_torque
    answer%power_loss = answer%friction_torque*bearing%point%speed
    answer%minimum_gap = -largest(1)
    answer%minimum_gap_midplane = -largest(2)
    answer%minimum_gap_edge = -largest(3)
    answer%maximum_pressure = largest(4)
    answer%minimum_pressure = -largest(5)
    answer%maximum_peclet = largest(6)
    answer%rough_peclet = largest(7)
  end function bearing_answer

  !> What the shaft's asperities carry, and how they rub: the shaft turns, or begins to.
  subroutine read_solid_contact(bearing, unknown, answer)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(bearing_answer_type), intent(inout) :: answer
    real(wp) :: pressure(size(bearing%pad(1)%mesh%mesh_node)), sums(film_forces + 1), largest(1)

    pressure = bearing%solid_pressure(unknown)
    associate (film => bearing%pad(1)%film)
      sums(:film_forces) = film%force(film%ambient_pressure + pressure)
      sums(film_forces + 1) = film_integral(film, pressure)
      sums = sum_over_ranks(sums)
      largest = largest_over_ranks([maxval(pressure)])
      answer%has_solid_contact = .true.
      answer%solid_force = sums(:film_forces)
      answer%solid_torque = bearing%pad(1)%contact%friction*film%radius*sums(film_forces + 1)
      answer%maximum_solid_pressure = largest(1)
    end associate
  end subroutine read_solid_contact

  !> How far the edges of the top foil stand off the bumps, and how much of the crests touches
  !> nothing.
  subroutine read_lifts(bearing, unknown, answer)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(bearing_answer_type), intent(inout) :: answer
    real(wp) :: lift(size(bearing%pad(1)%mesh%mesh_node)), middle, share(2), sums(8)
    integer :: i, station, row

    lift = -bearing%pad(1)%foil%deflection(unknown)
    sums = 0.0_wp
    associate (whole => bearing%pad(1)%whole)
      middle = minval(abs(whole%row_axial))
      do i = 1, size(lift)
        if (.not. bearing%pad(1)%mesh%owned(i)) cycle
        station = (bearing%pad(1)%mesh%mesh_node(i) - 1)/whole%rows() + 1
        row = bearing%pad(1)%mesh%mesh_node(i) - (station - 1)*whole%rows()
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
    sums = sum_over_ranks(sums)
    answer%has_foils = .true.
    answer%leading_edge_lift = sums(:2)/sums(3:4)
    answer%trailing_edge_lift = sums(5:6)/sums(7:8)
    share = sum_over_ranks(bearing%pad(1)%foil%crest_lengths())
    if (share(2) > 0.0_wp) answer%lifted_length = share(1)/share(2)
  end subroutine read_lifts

  !> Rows of the whole width, also where half of it is solved.
  pure function full_rows(bearing) result(position)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    real(wp), allocatable :: position(:) !! z [m]

    associate (z => bearing%pad(1)%whole%row_axial)
      if (bearing%pad(1)%whole%half) then
        position = [-z(size(z):2:-1), z]
      else
        position = z
      end if
    end associate
  end function full_rows

  !> This rank's consecutive part of a film field on the whole pad: station by station, rows of the
  !> whole width, a ring closed by its first station.
  subroutine film_block(bearing, value, first, last, block)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    real(wp), intent(in) :: value(:)   !! at the local film nodes, in any unit [SI]
    integer, intent(in) :: first, last !! nodes of the pad this rank takes, from 1
    real(wp), allocatable, intent(out) :: block(:) !! of these nodes, in the same unit [SI]

    integer, allocatable :: wanted(:)
    integer :: i, rows, row, station

    rows = size(full_rows(bearing))
    allocate (wanted(last - first + 1))
    do i = first, last
      station = modulo((i - 1)/rows, bearing%pad(1)%whole%stations())
      row = modulo(i - 1, rows) + 1
      if (bearing%pad(1)%whole%half) row = abs(row - bearing%pad(1)%whole%rows()) + 1
      wanted(i - first + 1) = station*bearing%pad(1)%whole%rows() + row
    end do
    block = film_values(bearing, value, wanted)
  end subroutine film_block

  !> Packs or unpacks an answer.
  pure subroutine remember_answer(memory, answer)
    type(memory_type), intent(inout) :: memory !! packs or unpacks
    type(bearing_answer_type), intent(inout) :: answer !! written where the memory unpacks

    call memory%visit('eccentricity', answer%eccentricity)
    call memory%visit('force', answer%force)
    call memory%visit('force_without_suction', answer%force_without_suction)
    call memory%visit('friction_torque', answer%friction_torque)
    call memory%visit('power_loss', answer%power_loss)
    call memory%visit('minimum_gap', answer%minimum_gap)
    call memory%visit('minimum_gap_midplane', answer%minimum_gap_midplane)
    call memory%visit('minimum_gap_edge', answer%minimum_gap_edge)
    call memory%visit('maximum_pressure', answer%maximum_pressure)
    call memory%visit('minimum_pressure', answer%minimum_pressure)
    call memory%visit('maximum_peclet', answer%maximum_peclet)
    call memory%visit('has_foils', answer%has_foils)
    call memory%visit('leading_edge_lift', answer%leading_edge_lift)
    call memory%visit('trailing_edge_lift', answer%trailing_edge_lift)
    call memory%visit('lifted_length', answer%lifted_length)
    call memory%visit('has_solid_contact', answer%has_solid_contact)
    call memory%visit('solid_force', answer%solid_force)
    call memory%visit('solid_torque', answer%solid_torque)
    call memory%visit('maximum_solid_pressure', answer%maximum_solid_pressure)
    call memory%visit('rough_peclet', answer%rough_peclet)
  end subroutine remember_answer
end module gfb_bearing_answer
