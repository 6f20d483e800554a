!> What a scene needs, and no more; each choice with its reason.
module gfb_bearing_plan
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, pad_length, pad_area
  use gfb_foundation_foil, only: foundation_stiffness
  use gfb_gas_case, only: gas_case_type
  use gfb_model_case, only: reduction_guyan, half_width_auto, half_width_yes, film_scheme_supg, &
                            film_scheme_auto, film_order_biquadratic, &
                            foundation_pressure_axial_mean, springs_two_sided
  use gfb_crest_lines, only: crest_line_type, crest_lines
  use gfb_operation_case, only: angular_speed
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: bump_stiffness
  use gfb_sweep_case, only: sweep_load, sweep_speed, sweep_axial_load
  use gfb_text, only: text
  use gfb_petsc_session, only: rank_count
  use gfb_scene_rules, only: is_symmetric, heat_mirrors, solves_one_pad
  use gfb_shell_geometry, only: node_unknowns
  use gfb_general_film, only: film_flow_type, general_peclet
  use gfb_film_surface, only: entraining_speed
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_aligned_mesh, only: largest_change, most_change
  use gfb_bearing_builder, only: film_mesh_of
  use gfb_film_mesh, only: film_mesh_type
  use gfb_units, only: degrees
  use gfb_foil_plan, only: film_elements, solved_rows, count_bumps, show_strips, strips_mirror
  use gfb_mesh_case, only: linear_solver_out_of_core, linear_solver_iterative
  use gfb_memory_check, only: show_memory
  use gfb_memory_laws, only: film_memory, plate_memory, bearing_memory, study_share, heated_memory
  implicit none (type, external)
  private
  public :: plan_bearing

  integer, parameter :: digits = 3 !! shown
  !> of the film: a rank that has fewer waits more than it computes
  integer, parameter :: few_nodes = 200

contains

  !> Bearing number, load, clearance and stiffness of the bumps, as far as the scene has them.
  subroutine show_numbers(scene, log)
    type(scene_type), intent(in) :: scene !! of a bearing
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp) :: stiffness !! of the bumps [N/m^3]
    real(wp) :: p_a, area !! [Pa], [m^2]
    character(len=1) :: symbol !! of the gap

    p_a = scene%gas%ambient_pressure
    area = pad_area(scene%bearing)
    symbol = scene%bearing%row%gap_symbol
    call log%line('numbers without unit:')
    if (scene%bearing%row%has_sectors) then
      call log%line('  inner over outer radius: '// &
                    text(scene%bearing%inner_radius/scene%bearing%radius, digits))
      call log%line('  size of the gap h (axial_gap, or half of the ramp) over outer radius R: '// &
                    text(scene%bearing%clearance/scene%bearing%radius, digits))
    else
      call log%line('  clearance over radius C/R: '// &
                    text(scene%bearing%clearance/scene%bearing%radius, digits))
    end if
    call log%line('  bearing number 6 mu Omega/p_a (R/'//symbol//')^2: '// &
                  spread_text(scene, sweep_speed, scene%operation%speed_rpm, &
                              bearing_number(scene%bearing, scene%gas, 1.0_wp)))
    if (scene%general%analysis%floats .and. .not. scene%bearing%row%moves_across) then
      call log%line('  load over p_a times the pads'' area: '// &
                    spread_text(scene, sweep_axial_load, scene%operation%axial_load, &
                                1.0_wp/(p_a*area)))
    else if (scene%general%analysis%floats) then
      call log%line('  load over p_a D L: '// &
                    spread_text(scene, sweep_load, norm2(scene%operation%load), 1.0_wp/(p_a*area)))
    end if
    stiffness = 0.0_wp
    if (scene%model%foil%has_foundation) then
      stiffness = foundation_stiffness(scene%model, scene%bump_foil)
    else if (scene%model%foil%has_bumps) then
      stiffness = bump_stiffness(scene%bump_foil)
    end if
    if (stiffness > 0.0_wp) then
      call log%line('  bump stiffness times '//symbol//' over p_a: '// &
                    text(stiffness*scene%bearing%clearance/p_a, digits))
    end if
  end subroutine show_numbers

  !> Bearing number 6 mu Omega / p_a (R / C)^2 [1].
  elemental real(wp) function bearing_number(bearing, gas, speed_rpm) result(number)
    type(bearing_case_type), intent(in) :: bearing !! the pad
    type(gas_case_type), intent(in) :: gas !! its gas
    real(wp), intent(in) :: speed_rpm !! of the shaft [rpm]

    number = 6.0_wp*gas%viscosity*angular_speed(speed_rpm)/gas%ambient_pressure* &
             (bearing%radius/bearing%clearance)**2
  end function bearing_number

  !> A number in proportion to what a sweep may change: one value, or the range of the sweep.
  function spread_text(scene, parameter, value, factor) result(words)
    type(scene_type), intent(in) :: scene
    integer, intent(in) :: parameter !! of the sweep that changes it
    real(wp), intent(in) :: value    !! without such a sweep [its unit]
    real(wp), intent(in) :: factor   !! number over value [1/its unit]
    character(len=:), allocatable :: words

    words = text(factor*value, digits)
    if (.not. scene%sweep%present .or. scene%sweep%parameter /= parameter) return
    words = text(factor*minval(scene%sweep%values), digits)//' to '// &
            text(factor*maxval(scene%sweep%values), digits)
  end function spread_text

  !> Chooses width, weighting and unknowns, and logs why.
  subroutine plan_bearing(scene, log, plan)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_plan_type), intent(out) :: plan !! what was chosen
    character(len=:), allocatable :: asked
    integer :: nodes, films, sides

    plan%order = scene%model%film_order
    plan%circumferential = film_elements(scene)
    plan%axial = scene%mesh%axial_elements
    plan%floats = scene%general%analysis%floats
    call log%heading('what the scene needs')
    call show_numbers(scene, log)
    call describe_foil(scene, log)
    if (scene%thermal%present) call describe_heat(scene, log)
    if (scene%feed%present) call describe_supply(scene, log)
    if (scene%bearing%row%has_half_width) call choose_width(scene, log, plan)
    call choose_scheme(scene, log, plan)
    if (plan%floats .and. scene%operation%moment_given) then
      call log%line('runner: axial gap and tilt are unknowns, balanced with load and moment')
    else if (plan%floats) then
      call log%line(trim(scene%bearing%row%unknowns)//', balanced with the load')
    else
      call log%line('shaft: position given, no shaft unknowns')
    end if
    if (rank_count() > plan%circumferential .and. .not. scene%model%foil%has_shell_bumps) then
      call log%warning(text(rank_count() - plan%circumferential)//' of '//text(rank_count())// &
                       ' ranks have nothing to do: the pad has '//text(plan%circumferential)// &
                       ' columns of elements to share out')
    end if
    call show_mesh(scene, plan, log, nodes)
    sides = scene%bearing%all_pads()/scene%bearing%pads
    if (sides > 1) then
      call log%line('runner between two bearings: a mirror image of this one faces its '// &
                    'other side; both gaps are '//text(scene%bearing%play)//' m together')
    end if
    if (scene%bearing%pads > 1) then
      if (solves_one_pad(scene)) then
        call log%line('pads: '//text(scene%bearing%pads)// &
                      trim(merge(' a side', '       ', sides > 1))// &
                      ', equal under an aligned runner: one is solved for all')
      else
        call log%line('pads: '//text(scene%bearing%all_pads())// &
                      ', each with such a film and foils of its own')
      end if
    end if
    films = scene%bearing%all_pads()
    if (scene%rotor%distance_in_time > 0.0_wp) films = 2*films ! two bearings
    if (solves_one_pad(scene)) films = sides
    call show_few(films*nodes, scene, log)
    plan%memory = film_memory(films*nodes, rank_count())
    if (scene%model%foil%has_crest_springs) plan%memory = plate_memory(films*nodes)
    if (scene%model%foil%has_shell_bumps) call show_foil_sizes(scene, films, nodes, plan, log)
    plan%memory = plan%memory*study_share(scene, plan%half)
    if (scene%solver%linear_solver == linear_solver_out_of_core) then
      call log%line('linear solver: LU with factors in files, as linear_solver asks')
    else if (scene%solver%linear_solver == linear_solver_iterative) then
      asked = 'as linear_solver asks'
      if (scene%solver%solver_chosen) asked = 'as there are many unknowns'
      call log%line('linear solver: GMRES on two levels, '//asked//'; smaller '// &
                    'systems on the way get factors')
    end if
    if (scene%thermal%present) plan%memory = heated_memory(scene, nodes, plan%memory)
    call show_memory(plan%memory, log)
    if (scene%sweep%friction_memory) then
      call log%line('sweep: '//text(size(scene%sweep%values))// &
                    ' points, friction carries its slip along from one to the next')
    else if (scene%sweep%present) then
      call log%line('sweep: '//text(size(scene%sweep%values))//' points')
    end if
  end subroutine plan_bearing

  !> Says what mesh the film has.
  subroutine show_mesh(scene, plan, log, nodes)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(run_log_type), intent(in) :: log
    integer, intent(out) :: nodes !! that are solved
    type(film_mesh_type) :: mesh
    character(len=:), allocatable :: finer

    nodes = (plan%order*plan%circumferential + 1)*solved_rows(scene, plan%half)
    mesh = film_mesh_of(scene, plan)
    finer = ''
    if (scene%feed%has_orifices() .and. mesh%nodes() > nodes) then
      finer = ', finer at orifices'
      nodes = mesh%nodes()
    end if
    call log%line('film mesh: '//text(plan%circumferential)//' x '//text(plan%axial)// &
                  trim(merge(' biquadratic', '            ', &
                             plan%order == film_order_biquadratic))// &
                  ' elements over the whole pad'//finer//', '//text(nodes)//' nodes solved')
    call warn_of_change(mesh, scene%bearing%row%coordinate, log)
  end subroutine show_mesh

  !> Warns of elements of the film that are out of proportion to those beside them.
  subroutine warn_of_change(mesh, coordinate, log)
    type(film_mesh_type), intent(in) :: mesh !! of the film
    character(len=*), intent(in) :: coordinate !! of its rows
    type(run_log_type), intent(in) :: log
    real(wp) :: change(2), place(2)

    call largest_change(mesh, change, place)
    if (change(1) > most_change) then
      call log%warning('the film''s elements beside '//text(place(1)*degrees, digits)// &
                       ' deg differ by a factor of '//text(change(1), digits)//': what a side '// &
                       'of them lies on there is too near to the next; answers may be rough')
    end if
    if (change(2) > most_change) then
      call log%warning('rows of elements of the film beside '//coordinate//' = '// &
                       text(place(2), digits)//' m differ by a '// &
                       'factor of '//text(change(2), digits)//': answers may be rough')
    end if
  end subroutine warn_of_change

  !> Says that a scene is too small for its ranks.
  subroutine show_few(nodes, scene, log)
    integer, intent(in) :: nodes !! of all films
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log

    if (rank_count() == 1 .or. scene%model%foil%has_shell_bumps) return
    if (nodes >= few_nodes*rank_count()) return
    call log%line('ranks: '//text(nodes/rank_count())//' nodes of the film on each, where '// &
                  text(few_nodes)//' are few: one rank is about as fast, and --groups computes '// &
                  'points of a sweep side by side')
  end subroutine show_few

  !> Sizes of foils of shells, and their memory.
  subroutine show_foil_sizes(scene, films, nodes, plan, log)
    type(scene_type), intent(in) :: scene
    integer, intent(in) :: films !! each with foils of its own
    integer, intent(in) :: nodes !! of a film, and of its top foil
    type(bearing_plan_type), intent(inout) :: plan
    type(run_log_type), intent(in) :: log
    integer :: rows, stations
    real(wp) :: unknowns
    logical :: reduced

    rows = solved_rows(scene, plan%half)
    reduced = scene%model%reduction == reduction_guyan
    call count_bumps(scene, rows, reduced, stations, unknowns)
    plan%memory = films*bearing_memory(nodes, unknowns, rows, reduced, scene%solver%linear_solver)
    if (allocated(scene%model%reduction_reason)) then
      call log%line('bumps: '//scene%model%reduction_reason)
    end if
    call log%line('foils: about '// &
                  text(films*(nint(unknowns) + node_unknowns*nodes))// &
                  ' unknowns before supports')
  end subroutine show_foil_sizes

  !> The foil model and what it is made of.
  subroutine describe_foil(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: source, pressure

    if (scene%model%foil%has_foundation) then
      source = 'by Walowit-Anno from &bump_foil'
      if (scene%model%foundation_stiffness > 0.0_wp) source = 'as given'
      pressure = 'local pressure'
      if (scene%model%foundation_pressure == foundation_pressure_axial_mean) then
        pressure = trim(scene%bearing%row%width)//' mean pressure'
      end if
      call log%line('foil: '//trim(scene%model%foil%meaning)//', '// &
                    text(foundation_stiffness(scene%model, scene%bump_foil)*1.0e-9_wp, 5)// &
                    ' N/mm^3 '//source//', '//pressure)
      if (scene%bump_foil%present .and. scene%model%foundation_stiffness > 0.0_wp) then
        call log%line('  &bump_foil is not used: foundation_stiffness is given')
      end if
    else if (scene%model%foil%has_bumps) then
      call log%line('foil: top foil and '//text(scene%bump_foil%bumps)//' bumps '// &
                    trim(scene%model%foil%meaning))
      call show_strips(scene%bump_foil, log)
    else if (scene%model%foil%has_crest_springs) then
      call describe_plate(scene, log)
    else
      call log%line('foil: '//trim(scene%model%foil%meaning))
      if (scene%bump_foil%present) then
        call log%line('  &bump_foil is not used by a '//trim(scene%model%foil%word)//' foil')
      end if
    end if
  end subroutine describe_foil

  !> A plate, and the springs that it lies on.
  subroutine describe_plate(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(crest_line_type), allocatable :: lines(:)
    character(len=:), allocatable :: source, springs

    lines = crest_lines(scene)
    source = 'by Walowit-Anno from &bump_foil'
    if (scene%model%crest_stiffness > 0.0_wp) source = 'as given'
    springs = 'that push it'
    if (scene%model%crest_springs == springs_two_sided) springs = 'that push and pull it'
    if (scene%model%spring_pitch > 0.0_wp) then
      springs = springs//', at points '//text(scene%model%spring_pitch*1.0e3_wp, 4)//' mm apart'
    end if
    call log%line('foil: '//trim(scene%model%foil%meaning))
    call log%line('  '//text(maxval(lines%number))//' crests of '// &
                  text(lines(1)%stiffness*1.0e-6_wp, 5)//' N/mm^2 '//source//', springs '//springs)
  end subroutine describe_plate

  !> The supply's temperature, where nothing is said of it.
  subroutine describe_supply(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log

    if (scene%feed%temperature_given) return
    call log%line('supply: gas at '//text(scene%feed%supply_temperature, 5)// &
                  ' K, as supply_temperature is not given')
  end subroutine describe_supply

  !> What heat flows through, and what of it is only estimated.
  subroutine describe_heat(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log

    associate (thermal => scene%thermal)
      call log%line('heat: gas drawn in at '//text(thermal%ambient_temperature, 5)// &
                    ' K, molar mass '//text(scene%gas%molar_mass, 6)//' kg/mol')
      if (.not. thermal%bump_conductance_estimated) return
      call log%line('  bump_conductance '//text(thermal%bump_conductance, 3)// &
                    ' W/(m2 K): estimated, a factor of 2 either way; temperatures follow it')
    end associate
  end subroutine describe_heat

  !> Half or whole width.
  subroutine choose_width(scene, log, plan)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_plan_type), intent(inout) :: plan
    logical :: symmetric

    if (scene%model%half_width == half_width_auto) then
      symmetric = is_symmetric(scene) .and. &
                  .not. scene%rotor%distance_in_time > 0.0_wp
      plan%half = symmetric .and. modulo(plan%axial, 2) == 0
      plan%half = plan%half .and. strips_mirror(scene)
      if (scene%bearing%row%ends_differ) then
        call log%line('width: whole, because the ends of a cone are not alike')
      else if (.not. strips_mirror(scene)) then
        call log%line('width: whole, because the strips do not mirror each other')
      else if (.not. heat_mirrors(scene)) then
        call log%line('width: whole, because heat leaves one end otherwise than the other')
      else if (.not. scene%feed%mirrors()) then
        call log%line('width: whole, because the rows of orifices do not mirror each other')
      else if (.not. scene%grooves%mirrors()) then
        call log%line('width: whole, because the bands of grooves do not mirror each other')
      else if (plan%half) then
        call log%line('width: half, with symmetry at z = 0, because nothing tilts')
      else if (symmetric) then
        call log%line('width: whole, because axial_elements is odd')
      else
        call log%line('width: whole, because the shaft tilts')
      end if
    else
      plan%half = scene%model%half_width == half_width_yes
      call log%line('width: '//trim(merge('half ', 'whole', plan%half))//', as half_width asks')
    end if
  end subroutine choose_width

  !> Galerkin or SUPG weighting of the film.
  subroutine choose_scheme(scene, log, plan)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_plan_type), intent(inout) :: plan

    plan%peclet = concentric_peclet(scene, plan)
    if (plan%order == film_order_biquadratic) then
      call log%line('film: Galerkin, because upwinding is for bilinear elements')
      return
    end if
    if (scene%grooves%present) then
      call log%line('film: Galerkin, because upwinding is for smooth surfaces')
      return
    end if
    plan%upwind = scene%model%film_scheme == film_scheme_supg
    plan%may_upwind = scene%model%film_scheme == film_scheme_auto
    if (.not. plan%may_upwind) then
      call log%line('film: '//trim(merge('SUPG    ', 'Galerkin', plan%upwind))// &
                    ', as film_scheme asks')
      return
    end if
    plan%upwind = plan%peclet > scene%bearing%row%galerkin_limit
    call log%line('film: '//trim(merge('SUPG    ', 'Galerkin', plan%upwind))// &
                  ', because the cell Peclet number of the concentric film is '// &
                  text(plan%peclet, 3)// &
                  trim(merge(' > ', ' < ', plan%upwind))//' '// &
                  text(scene%bearing%row%galerkin_limit))
  end subroutine choose_scheme

  !> Cell Peclet number of the film at ambient pressure between concentric surfaces.
  pure function concentric_peclet(scene, plan) result(peclet)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    real(wp) :: peclet !! [1]
    type(film_flow_type) :: flow
    real(wp) :: speed_rpm

    speed_rpm = scene%operation%speed_rpm
    if (scene%sweep%present .and. scene%sweep%parameter == sweep_speed) then
      speed_rpm = maxval(scene%sweep%values)
    end if
    flow%viscosity = scene%gas%viscosity
    flow%entraining_speed = entraining_speed(angular_speed(speed_rpm), scene%bearing%radius)
    peclet = general_peclet(scene%gas%law, flow, &
                            pad_length(scene%bearing)/real(plan%circumferential, wp), &
                            scene%gas%ambient_pressure, scene%bearing%clearance)
  end function concentric_peclet
end module gfb_bearing_plan
