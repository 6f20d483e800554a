#include "gfb_petsc.h"
!> From a scene to its equations on a mesh, with the list of foil models: what each word of `&model foil` builds.
!>
!> The words, what they mean and what each foil has are the rows of `gfb_foil_row`. A new model is a row there, a type of its own
!> that extends `foil_model_type`, which is the rigid one, and a case of `build_foil`.
module gfb_bearing_builder
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, add_context
  use gfb_scene, only: scene_type
  use gfb_scene_rules, only: solves_one_pad
  use gfb_bearing_case, only: surface_of, pad_angle, pad_turn, preload_angle, inner_edge_sealed
  use gfb_foil_row, only: foil_rigid, foil_elastic_foundation, foil_shell, foil_beam, foil_plate
  use gfb_model_case, only: reduction_guyan
  use gfb_film_mesh, only: film_mesh_type, uniform_film_mesh, film_mesh_at, sector_film_mesh, cell_nodes
  use gfb_crest_lines, only: plate_sides
  use gfb_foil_builder, only: plate_stations, stations_follow_crests, sector_sides, shape_on_pad, gaps_beside, strip_on_pad, &
                              section_of, plate_section, middle_of_straight
  use gfb_foil_places, only: top_height
  use gfb_foil_mesh, only: top_mesh, dividing_stations
  use gfb_foil_structure, only: element_geometry, element_section
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_shell_geometry, only: shell_section_type, check_shell
  use gfb_partition, only: division_type, divide, no_chain
  use gfb_part_chains, only: film_chain, film_columns, strip_chain
  use gfb_petsc_session, only: rank_count, any_rank
  use gfb_aligned_mesh, only: align_stations, align_graded
  use gfb_gap_shape, only: gap_shape_item_type, kinks_of
  use gfb_gap_shapes, only: find_shapes
  use gfb_gap_part, only: gap_part_type
  use gfb_gas_film, only: gas_film_type, create_gas_film, put_strips, freeze_film, frozen_heat_type
  use gfb_heat_switch, only: follow_frozen
  use gfb_changed_foil, only: take_foil_numbers
  use gfb_feed_builder, only: find_feed
  use gfb_feed_numbers, only: take_feed_numbers
  use gfb_film_refinement, only: refine_at_holes, meet_bands
  use gfb_groove_mesh, only: lay_along_grooves
  use gfb_groove_case, only: groove_case_type
  use gfb_groove_film, only: groove_type
  use gfb_solid_contact, only: solid_contact_type, contact_left
  use gfb_foil_model, only: foil_model_type, create_rigid_foil
  use gfb_scene_point, only: operating_point
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_units, only: pi, turn
  use gfb_gas_law, only: gas_constant, density_table
  use gfb_heated_film, only: heated_gas_type
  use gfb_bearing_heat, only: film_heat_type, wall_type
  use gfb_thermal_case, only: foil_sheet
  use gfb_pad, only: pad_type, pad_place_type, create_pad_film, shift_pad, move_crests
  use gfb_bearing_system, only: bearing_system_type, create_bearing_system
  use gfb_mesh_case, only: linear_solver_iterative
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_foundation_foil, only: foundation_foil_type, build_foundation
  use gfb_shell_foil, only: shell_foil_type, create_shell_foil
  use gfb_beam_foil, only: beam_foil_type, create_beam_foil
  use gfb_plate_foil, only: plate_foil_type, create_plate_foil
  implicit none (type)
  private
  public :: check_meshes, build_bearing, build_opposite, build_like, build_changed, take_numbers, divide_bearing, film_mesh_of, heat_of

  !> Points of a measured bore that are nearer to both neighbours are a curve's: with sides of elements on a hundred of them a mesh
  !> of 128 elements, some half as long as the others, was three times as far from the curve's answer as an even one.
  real(wp), parameter :: elements_of_a_curve = 2.0_wp

contains

  !> The equations of a scene on a mesh of given size.
  !>
  !> Fails when the mesh cannot be cut into parts.
  subroutine build_bearing(scene, plan, bearing, error, frozen)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_plan_type), intent(in) :: plan !! what was decided about it
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    type(error_type), allocatable, intent(out) :: error !! why it failed
    logical, intent(in), optional :: frozen !! heat does not change: all is at ambient temperature; default: it is solved for
    type(scene_type) :: without

    call enter_stage('set-up')
    without = scene
    if (present(frozen)) without%thermal%present = scene%thermal%present .and. .not. frozen
    call build_on_mesh(without, film_mesh_of(scene, plan), plan%upwind, plan%floats, bearing, error)
    if (allocated(error)) return
    if (scene%thermal%present .and. .not. without%thermal%present) call freeze_at_ambient(heat_of(scene), bearing)
    bearing%point = operating_point(scene%operation)
    call leave_stage()
  end subroutine build_bearing

  !> Measures the elements of film and foils, as their equations would, and keeps nothing of them.
  !>
  !> Fails where one is folded over, degenerate, or too thick for its curvature.
  subroutine check_meshes(scene, plan, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_plan_type), intent(in) :: plan !! what was decided about it
    type(error_type), allocatable, intent(out) :: error !! which mesh has such an element, and why it cannot be
    type(film_mesh_type) :: film

    film = film_mesh_of(scene, plan)
    call check_film(scene, film, error)
    call add_context(error, scene%file//': mesh of the film')
    if (allocated(error) .or. .not. scene%model%foil%has_shells) return
    call check_elements(top_mesh(film, merge(top_height(scene), 0.0_wp, scene%model%foil%has_shell_bumps), &
                                 middle=middle_of_straight(scene%bearing, scene%bump_foil)), plate_section(scene), error)
    call add_context(error, scene%file//': mesh of the top foil')
    if (allocated(error) .or. .not. scene%model%foil%has_shell_bumps) return
    associate (window => [1, maxval(dividing_stations(shape_on_pad(scene)))])
      call check_elements(strip_on_pad(scene, film, window), section_of(scene%bump_foil), error)
    end associate
    call add_context(error, scene%file//': mesh of the bump foil')
  end subroutine check_meshes

  !> Elements of the film: stations and rows make a grid, so that one row and one station of it show whether any is folded.
  subroutine check_film(scene, film, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(error_type), allocatable, intent(out) :: error
    type(film_mesh_type) :: strip

    strip = film
    strip%row_axial = film%row_axial(:film%order + 1)
    call measure(strip)
    if (allocated(error)) return
    strip = film
    strip%periodic = .false.
    strip%station_angle = film%station_angle(:film%order + 1)
    call measure(strip)

  contains

    !> Measures all elements of a part of the film.
    subroutine measure(part)
      type(film_mesh_type), intent(in) :: part
      type(gas_film_type) :: gas
      integer :: cells(4, part%circumferential()*part%axial()), column, row

      do column = 1, part%circumferential()
        do row = 1, part%axial()
          cells(:, (column - 1)*part%axial() + row) = cell_nodes(column, row, part%stations(), part%rows())
        end do
      end do
      call create_gas_film(part, [(row, row=1, part%nodes())], cells, scene%bearing%clearance, scene%gas%ambient_pressure, &
                           scene%gas%viscosity, .false., gas, error)
    end subroutine measure
  end subroutine check_film

  !> Elements of a foil.
  pure subroutine check_elements(mesh, section, error)
    type(quad_mesh_type), intent(in) :: mesh
    type(shell_section_type), intent(in) :: section !! thickness and material
    type(error_type), allocatable, intent(out) :: error
    integer :: element

    do element = lbound(mesh%element_nodes, 2), ubound(mesh%element_nodes, 2)
      call check_shell(element_geometry(mesh, element), element_section(mesh, section, element), error)
      if (allocated(error)) return
    end do
  end subroutine check_elements

  !> Films that are as warm as the gas that is drawn in.
  pure subroutine freeze_at_ambient(heat, bearing)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(bearing_system_type), intent(inout) :: bearing !! without it
    type(frozen_heat_type) :: film
    integer :: i

    film%gas = heat%gas
    film%centrifugal = heat%centrifugal
    do i = 1, size(bearing%pad)
      associate (nodes => size(bearing%pad(i)%film%angle))
        film%field = spread([heat%ambient, heat%ambient, heat%ambient, 0.0_wp], 1, nodes)
        call freeze_film(bearing%pad(i)%film, film)
      end associate
    end do
  end subroutine freeze_at_ambient

  !> The equations of a bearing on half the width for motions against those of the other half's mirror.
  !>
  !> Fails when the mesh cannot be cut into parts.
  subroutine build_opposite(scene, bearing, opposite, error)
    type(scene_type), intent(in) :: scene !! that the bearing is of
    type(bearing_system_type), intent(in) :: bearing !! on half the width
    type(bearing_system_type), intent(inout) :: opposite !! at no answer yet
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(film_mesh_type) :: film

    film = bearing%mesh
    film%opposite = .true.
    call build_on_mesh(scene_of(scene, bearing), film, bearing%upwinds(), bearing%floats, opposite, error)
    if (.not. allocated(error)) call follow_frozen(bearing, opposite)
  end subroutine build_opposite

  !> The scene, without heat where the bearing's temperatures stay as they are.
  pure type(scene_type) function scene_of(scene, bearing) result(here)
    type(scene_type), intent(in) :: scene !! that the bearing is of
    type(bearing_system_type), intent(in) :: bearing

    here = scene
    here%thermal%present = scene%thermal%present .and. bearing%heat%present
  end function scene_of

  !> The equations of a bearing that differs in numbers, on a mesh with as many elements, at the same point.
  !>
  !> Fails when the mesh cannot be cut into parts.
  subroutine build_like(scene, bearing, other, error, bearing_distance)
    type(scene_type), intent(in) :: scene !! of the other bearing
    type(bearing_system_type), intent(in) :: bearing !! of a scene like it
    type(bearing_system_type), intent(inout) :: other !! its state is that at rest
    type(error_type), allocatable, intent(out) :: error !! why it failed
    !> of two bearings like that one, which the other is; default: it is one [m]
    real(wp), intent(in), optional :: bearing_distance
    type(bearing_plan_type) :: plan

    associate (whole => bearing%mesh)
      plan%half = whole%half
      plan%order = whole%order
      plan%circumferential = whole%planned(1)
      plan%axial = whole%planned(2)
    end associate
    if (present(bearing_distance)) plan%bearing_distance = bearing_distance
    call build_on_mesh(scene_of(scene, bearing), film_mesh_of(scene, plan), bearing%upwinds(), bearing%floats, &
                       other, error)
    if (allocated(error)) return
    call follow_frozen(bearing, other)
    other%point = bearing%point
    other%shaft_fixed = bearing%shaft_fixed
  end subroutine build_like

  !> Another bearing on a mesh like this one's, in the same state; contacts are linearised where they are.
  subroutine build_changed(there, bearing, unknown, other, problem, error)
    type(scene_type), intent(in) :: there !! of the other bearing
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    real(wp), intent(in) :: unknown(:) !! of it, local, in SI
    type(bearing_system_type), intent(inout) :: other !! there is none where there is a problem or an error
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(error_type), allocatable, intent(out) :: error !! why it cannot be built

    problem = ''
    call build_like(there, bearing, other, error)
    if (allocated(error)) return
    if (is_alike(bearing, other)) then
      call take_contacts(bearing, other)
      call other%set_unknowns(unknown)
    else
      problem = 'the mesh changes with it'
      call other%destroy()
    end if
  end subroutine build_changed

  !> Whether two bearings have the same unknowns and contacts.
  logical function is_alike(bearing, other) result(alike)
    type(bearing_system_type), intent(in) :: bearing, other

    alike = bearing%local_size() == other%local_size() .and. bearing%film_nodes() == other%film_nodes() .and. &
      size(bearing%pad(1)%foil%contacts%point) == size(other%pad(1)%foil%contacts%point)
    if (alike) alike = all(bearing%mesh_nodes() == other%mesh_nodes())
    alike = .not. any_rank(.not. alike)
  end function is_alike

  !> Contacts of a bearing are linearised where those of another are.
  subroutine take_contacts(bearing, other)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_system_type), intent(inout) :: other
    integer :: i

    do i = 1, size(bearing%pad)
      if (.not. bearing%pad(i)%foil%has_contacts()) cycle
      call other%pad(i)%foil%contacts%settle_like(bearing%pad(i)%foil%contacts)
    end do
  end subroutine take_contacts

  !> The equations on a mesh of the film.
  !>
  !> Fails when it cannot be cut into parts.
  subroutine build_on_mesh(scene, film, upwind, floats, bearing, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    logical, intent(in) :: upwind !! SUPG instead of Galerkin
    logical, intent(in) :: floats !! the shaft's position is unknown
    type(bearing_system_type), intent(out) :: bearing
    type(error_type), allocatable, intent(out) :: error
    class(foil_model_type), allocatable :: foil
    type(division_type) :: division
    type(pad_place_type), allocatable :: place(:)

    call divide_bearing(scene, film, rank_count(), division, error)
    if (allocated(error)) return
    allocate (bearing%pad(1))
    call create_pad_film(film, scene%bearing%clearance, scene%gas%ambient_pressure, scene%gas%viscosity, upwind, &
                         bearing%pad(1), error, division%film)
    if (allocated(error)) return
    associate (pad => bearing%pad(1))
      pad%contact = scene%shaft_contact ! the matrix makes room for them
      call build_foil(scene, pad%whole, pad%mesh, pad%film%element_nodes, division, foil, error)
    end associate
    if (allocated(error)) return
    call find_places(scene, film%surface%offset, place)
    if (scene%thermal%present) bearing%heat = heat_of(scene)
    call find_feed(scene, film, size(place), bearing%pad(1), bearing%feed)
    bearing%plane = .not. scene%model%foil%has_shells
    call create_bearing_system(bearing, foil, floats, scene%operation%moment_given, place)
    if (scene%solver%linear_solver == linear_solver_iterative) call bearing%find_motions()
    call take_film_numbers(scene, bearing)
  end subroutine build_on_mesh

  !> Heat, as the scene has it.
  !>
  !> The group itself is not passed: a third of these numbers are products of it with gas or geometry, and equations of heat are asked,
  !> and tested, without a scene.
  pure function heat_of(scene) result(heat)
    type(scene_type), intent(in) :: scene !! with heat
    type(film_heat_type) :: heat !! its unknowns are not numbered
    real(wp) :: across !! how far a radius that grows closes the gap, over its strain [m]

    associate (given => scene%thermal, bearing => scene%bearing, ambient => scene%gas%ambient_pressure)
      across = bearing%radius*cos(bearing%half_angle) ! a cone's gap is normal to its surface
      heat%present = .true.
      heat%gas = heated_gas_type(law=scene%gas%law, reference=given%ambient_temperature, &
                                 density=scene%gas%molar_mass/(gas_constant*given%ambient_temperature), &
                                 specific_heat=given%specific_heat, prandtl=given%prandtl, &
                                 viscosity=scene%gas%viscosity_law, exponent=scene%gas%viscosity_temperature_exponent)
      heat%gas%law%ambient_pressure = ambient
      heat%gas%law%viscosity = scene%gas%viscosity
      if (heat%gas%law%density == density_table) heat%gas%density = 1.0_wp/heat%gas%law%unit
      heat%ambient = given%ambient_temperature
      heat%reference = given%reference_temperature
      heat%carry_over = given%carry_over
      heat%shaft = wall_type(given%shaft, given%shaft_temperature, given%shaft_conductance, given%shaft_far_temperature, &
                             across*given%shaft_expansion)
      heat%sleeve = wall_type(given%sleeve, given%sleeve_temperature, given%sleeve_conductance, given%sleeve_far_temperature, &
                              across*given%sleeve_expansion)
      heat%fin = given%shaft_conductivity*pi*(bearing%radius**2 - given%shaft_inner_radius**2)
      heat%centrifugal = given%growth(bearing%radius, 1.0_wp)*cos(bearing%half_angle)
      heat%end_conductance = given%shaft_end_conductance
      heat%end_temperature = given%shaft_end_temperature
      heat%sheet = given%top_foil == foil_sheet
      heat%foil_temperature = given%top_foil_temperature
      heat%sheet_conductance = given%foil_conductivity*scene%top_foil%thickness
      heat%bumps = given%bump_conductance
      heat%channel = given%channel_conductance
      heat%channel_sleeve = given%channel_sleeve_conductance
      heat%cooling = given%cooling_flow*given%specific_heat
      heat%cooling_temperature = given%cooling_temperature
      heat%arc = bearing%radius*pad_angle(bearing)*real(bearing%pads, wp)
      heat%modulus = given%modulus
      heat%has_orifices = scene%feed%has_orifices()
    end associate
  end function heat_of

  !> Parts of the gap, gas and asperities that are not known where the pads are created.
  subroutine take_film_numbers(scene, bearing)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(inout) :: bearing
    type(gap_shape_item_type), allocatable :: shape(:)
    type(groove_case_type) :: grooves
    integer :: i, k

    grooves = scene%grooves
    call grooves%weigh_ends()
    bearing%asperities = scene%shaft_contact
    call take_feed_numbers(scene, bearing)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call find_shapes(scene%bearing, scene%bore, pad%whole%station_angle(1), pad%film%surface%facing, shape)
        do k = 1, size(shape)
          call pad%film%put_shape(shape(k)%name, shape(k)%shape)
        end do
        if (scene%model%has_strips()) then
          call put_strips(scene%model%cut_radii, scene%model%strip_stiffness, pad%foil%rate, pad%film)
        end if
        call pad%film%put(gap_part_type(name='interference', level=scene%bearing%interference))
        if (grooves%present) call put_grooves(grooves, pad)
        if (grooves%present .and. scene%shaft_contact%present) call share_contact(grooves, scene%shaft_contact, pad)
        pad%film%law = scene%gas%law
        pad%contact = scene%shaft_contact
      end associate
    end do
  end subroutine take_film_numbers

  !> Grooves of a film's elements, each of which lies in one band or between two; where each groove is meshed, in one or on a ridge.
  subroutine put_grooves(grooves, pad)
    type(groove_case_type), intent(in) :: grooves !! whose ends are weighed
    type(pad_type), intent(inout) :: pad
    type(gap_part_type) :: part
    real(wp) :: middle
    integer :: element

    part%name = 'grooves'
    associate (film => pad%film)
      allocate (part%groove(size(film%element_nodes, 2)))
      if (grooves%are_resolved()) part%excess = spread(0.0_wp*film%shape(1, :), 2, size(part%groove))
      do element = 1, size(part%groove)
        associate (nodes => film%element_nodes(:, element))
          middle = 0.5_wp*(minval(film%axial(nodes)) + maxval(film%axial(nodes)))
          part%groove(element) = grooves%groove_at(middle)
          if (.not. grooves%are_resolved()) cycle
          if (.not. abs(grooves%line_angle(middle)) > 0.0_wp) cycle
          if (lies_in_groove(grooves, pad, element)) part%excess(:, element) = -grooves%depth
        end associate
      end do
    end associate
    call pad%film%put(part)
  end subroutine put_grooves

  !> What narrow grooves leave of the asperities' pressure at a pad's nodes: that of ridges and of the deeper grooves, over that of a
  !> smooth surface; at the end of a band the mean by the lengths on both sides.
  pure subroutine share_contact(grooves, contact, pad)
    type(groove_case_type), intent(in) :: grooves
    type(solid_contact_type), intent(in) :: contact !! whose pressure falls exponentially with the gap
    type(pad_type), intent(inout) :: pad
    real(wp) :: of_row(pad%whole%rows()), length(2), share(2)
    type(groove_type) :: groove
    integer :: row, k

    associate (rows => pad%whole%row_axial)
      do row = 1, size(rows)
        length = 0.0_wp
        share = 0.0_wp
        do k = max(1, row - 1), min(size(rows) - 1, row)
          associate (side => k - row + 2)
            length(side) = rows(k + 1) - rows(k)
            groove = grooves%groove_at(0.5_wp*(rows(k) + rows(k + 1)))
            share(side) = contact_left(contact, groove%share, groove%depth)
          end associate
        end do
        of_row(row) = dot_product(length, share)/sum(length)
      end do
      pad%contact_share = of_row(modulo(pad%mesh%mesh_node - 1, size(rows)) + 1)
    end associate
  end subroutine share_contact

  !> Whether an element lies in a groove: the first one begins at the first station, its ridge follows.
  pure logical function lies_in_groove(grooves, pad, element) result(lies)
    type(groove_case_type), intent(in) :: grooves !! that are meshed
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element !! of this rank's film
    real(wp), parameter :: rounding = 1.0e-6_wp !! of a pitch
    integer :: station(size(pad%film%element_nodes, 1)), first
    real(wp) :: phase

    station = (pad%mesh%mesh_node(pad%film%element_nodes(:, element)) - 1)/pad%whole%rows() + 1
    first = minval(station)
    if (maxval(station) - first > pad%whole%order) first = minval(station, station > pad%whole%order) ! it closes the ring
    phase = (pad%whole%station_angle(first) - pad%whole%station_angle(1))/turn*real(grooves%count, wp) + rounding
    lies = modulo(phase, 1.0_wp) < 1.0_wp - grooves%ridge_part
  end function lies_in_groove

  !> Gives a bearing, whose foils can take them, the numbers of a scene that do not move its meshes: of film, gas, bore,
  !> asperities and contacts. What is assembled of the foils stays.
  subroutine take_numbers(scene, bearing)
    type(scene_type), intent(in) :: scene !! with the same meshes
    type(bearing_system_type), intent(inout) :: bearing !! its state and scales stay
    type(pad_place_type), allocatable :: place(:)
    integer :: i

    bearing%clearance = scene%bearing%clearance
    bearing%ambient_pressure = scene%gas%ambient_pressure
    call find_places(scene, 0.0_wp, place)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        pad%film%clearance = scene%bearing%clearance
        pad%film%ambient_pressure = scene%gas%ambient_pressure
        pad%film%flow%viscosity = scene%gas%viscosity
        call shift_pad(place(i), pad)
        call take_foil_numbers(scene, pad%whole, pad%foil)
        call move_crests(place(i), pad)
      end associate
    end do
    call take_film_numbers(scene, bearing)
    if (bearing%heat%present) call take_heat_numbers(heat_of(scene), bearing%heat)
  end subroutine take_numbers

  !> Heat with other numbers, its unknowns as they stand.
  pure subroutine take_heat_numbers(other, heat)
    type(film_heat_type), intent(in) :: other !! with as many walls, not numbered
    type(film_heat_type), intent(inout) :: heat
    type(film_heat_type) :: before

    before = heat
    heat = other
    heat%first = before%first
    heat%first_wall = before%first_wall
    heat%walls = before%walls
    heat%shafts = before%shafts
    heat%channels = before%channels
  end subroutine take_heat_numbers

  !> Where the pads stand: the preload m moves the centre of each towards the shaft, so that its gap is less by
  !> \( m C \cos(\theta - \theta_p) \). Of two bearings of a rotor that tilts the pads of the first one, at +z, come first; of
  !> two on both sides of a runner those that the load presses it on.
  !>
  !> No function: gfortran 12 leaves out the defaults of a result of this type.
  pure subroutine find_places(scene, offset, place)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: offset !! of two bearings' midplanes; 0: there is one bearing [m]
    type(pad_place_type), allocatable, intent(out) :: place(:)
    integer :: pads, i

    associate (bearing => scene%bearing)
      pads = merge(1, bearing%pads, solves_one_pad(scene))
      allocate (place(pads*merge(2, 1, offset > 0.0_wp .or. bearing%play > 0.0_wp)))
      do i = 1, pads
        place(i)%turn = pad_turn(bearing, i)
        associate (angle => preload_angle(bearing, i))
          if (bearing%preload > 0.0_wp) place(i)%shift = -bearing%preload*bearing%clearance*[cos(angle), sin(angle)]
        end associate
        if (i > 1 .and. scene%bump_foil%random%deviation > 0.0_wp) place(i)%further_gap = gaps_beside(scene%bump_foil, i)
      end do
      if (size(place) == pads) return
      do i = 1, pads
        associate (other => place(pads + i))
          other = place(i)
          place(i)%offset = offset
          other%offset = merge(bearing%play, -offset, bearing%play > 0.0_wp)
          other%facing = merge(-1.0_wp, 1.0_wp, bearing%play > 0.0_wp)
          if (bearing%play > 0.0_wp .and. scene%bump_foil%random%deviation > 0.0_wp) then
            other%further_gap = gaps_beside(scene%bump_foil, pads + i)
          end if
        end associate
      end do
    end associate
  end subroutine find_places

  !> The parts of film and foils: what touches belongs to one part.
  !>
  !> Fails when METIS does.
  subroutine divide_bearing(scene, film, parts, division, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    integer, intent(in) :: parts !! ranks
    type(division_type), intent(out) :: division !! of film and bumps
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (scene%model%foil%has_shell_bumps) then
      call divide(film_chain(film, .true.), &
                  strip_chain(shape_on_pad(scene), film%rows(), scene%model%reduction == reduction_guyan), &
                  parts, division, error)
    else
      call divide(film_chain(film, .false.), no_chain(), parts, division, error)
    end if
    if (.not. allocated(error)) division%film = film_columns(film, division%film)
  end subroutine divide_bearing

  !> The film's mesh: equal elements but for kinks of the gap, or stations above the crests.
  function film_mesh_of(scene, plan) result(mesh)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_plan_type), intent(in) :: plan !! what was decided about it
    type(film_mesh_type) :: mesh
    type(gap_shape_item_type), allocatable :: shape(:)
    real(wp), allocatable :: kink(:) !! of a sector's gap, from its leading edge [rad]
    integer :: i

    associate (bearing => scene%bearing)
      call find_shapes(bearing, scene%bore, bearing%leading_edge_angle, 1.0_wp, shape)
      allocate (kink(0))
      if (bearing%row%has_sectors) then
        do i = 1, size(shape)
          if (shape(i)%shape%of_each_pad) kink = [kink, kinks_of(shape(i:i), bearing%leading_edge_angle)]
        end do
        mesh = sector_film_mesh([bearing%inner_radius, bearing%radius], bearing%leading_edge_angle, pad_angle(bearing), &
                                kink, scene%model%cut_radii, plan%circumferential, plan%axial, &
                                merge(1.0_wp, scene%mesh%edge_refinement, scene%model%foil%has_top_foil .or. bearing%is_ring()), &
                                scene%mesh%edge_refinement, plan%order, bearing%is_ring())
        mesh%sealed = bearing%inner_edge == inner_edge_sealed
        if (solves_one_pad(scene)) mesh%repeats = bearing%pads
        if (scene%model%foil%has_shell_bumps) call align_stations(mesh, bearing%leading_edge_angle + [kink, sector_sides(scene)])
        if (scene%bore%present .and. .not. scene%model%foil%has_top_foil) call align_graded(mesh, all_kinks())
      else if (scene%model%foil%has_bumps .and. stations_follow_crests(scene)) then
        mesh = film_mesh_at(bearing%leading_edge_angle + plate_stations(scene)/bearing%radius, bearing%radius, &
                            bearing%length, plan%axial, plan%half, plan%order, scene%mesh%edge_refinement)
      else
        mesh = uniform_film_mesh(bearing%radius, bearing%length, bearing%leading_edge_angle, &
                                 pad_angle(bearing), plan%circumferential, plan%axial, &
                                 bearing%is_ring(), plan%half, plan%order, &
                                 scene%mesh%edge_refinement)
        if (size(shape) > 0 .and. .not. scene%model%foil%has_top_foil) then
          call align_stations(mesh, all_kinks())
        end if
      end if
      if (scene%model%foil%has_crest_springs) call align_stations(mesh, bearing%leading_edge_angle + plate_sides(scene, kink))
      if (.not. scene%grooves%are_resolved()) call meet_bands(scene, mesh)
      call refine_at_holes(scene, kept_sides(), mesh)
    end associate
    mesh%planned = [plan%circumferential, plan%axial]
    mesh%surface = surface_of(scene%bearing)
    mesh%surface%offset = 0.5_wp*plan%bearing_distance
    if (scene%grooves%are_resolved()) call lay_along_grooves(scene, plan%axial, mesh)

  contains

    !> Sides of elements that lie on kinks, whatever else is refined.
    function kept_sides() result(kept)
      real(wp), allocatable :: kept(:) !! [rad]

      kept = scene%bearing%leading_edge_angle + kink
      if (scene%bore%present) kept = [kept, scene%bearing%leading_edge_angle &
                                      + modulo(all_kinks() - scene%bearing%leading_edge_angle, turn)]
    end function kept_sides

    !> Kinks of all pads' gaps as if all were where the first one is.
    function all_kinks() result(kinks)
      real(wp), allocatable :: kinks(:) !! [rad]
      integer :: pad

      associate (bearing => scene%bearing)
        kinks = kinks_of(shape, 0.0_wp, pad_turn(bearing, [(pad, pad=1, bearing%pads)]), &
                         elements_of_a_curve*pad_angle(bearing)/real(plan%circumferential, wp))
      end associate
    end function all_kinks
  end function film_mesh_of

  !> The foil model that a scene asks for, under its film.
  !>
  !> Fails where an element of a foil is degenerate.
  subroutine build_foil(scene, film, mesh, element_nodes, division, foil, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh   !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)  !! (nodes, elements) its elements, local nodes
    type(division_type), intent(in) :: division !! of film and bumps
    !> of the model asked for, ready for the bearing
    class(foil_model_type), allocatable, intent(out) :: foil
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    type(foil_model_type), allocatable :: rigid
    type(foundation_foil_type), allocatable :: foundation
    type(shell_foil_type), allocatable :: shells
    type(beam_foil_type), allocatable :: beams
    type(plate_foil_type), allocatable :: plate

    select case (scene%model%foil%number)
    case (foil_rigid%number)
      allocate (rigid)
      call create_rigid_foil(size(mesh%mesh_node), rigid)
      call move_alloc(rigid, foil)
    case (foil_elastic_foundation%number)
      allocate (foundation)
      call build_foundation(scene, film, mesh, foundation)
      call move_alloc(foundation, foil)
    case (foil_shell%number)
      allocate (shells)
      call create_shell_foil(scene, film, mesh, element_nodes, division, shells, error)
      if (.not. allocated(error)) call move_alloc(shells, foil)
    case (foil_beam%number)
      allocate (beams)
      call create_beam_foil(scene, film, mesh, element_nodes, beams)
      call move_alloc(beams, foil)
    case (foil_plate%number)
      allocate (plate)
      call create_plate_foil(scene, film, mesh, element_nodes, division, plate, error)
      if (.not. allocated(error)) call move_alloc(plate, foil)
    case default
      error stop 'a foil model that nothing builds'
    end select
  end subroutine build_foil
end module gfb_bearing_builder
