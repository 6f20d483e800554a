!> The table of all names under which results are written.
!>
!> A new name is a row here and a call of `add_result` (module gfb_result_names) where its value is
!> known. `<a>`, `<b>` and `<state>` in a name stand for one name each of what `marker_words` has,
!> `<n>` for a number, `<key>` for a key of the case file, `<quantity>` for a name that `&accuracy`
!> may ask for. What stands in braces in a meaning may be replaced by one of the phrases.
!>
!> The table lies in the lowest layer: the scene, which knows no bearing, needs the names that
!> `&accuracy` may ask for, and the output, which knows no scene, units and meanings.
module gfb_result_table
  use gfb_quantity, only: number => quantity_number, total => quantity_count, &
                          word => quantity_word, truth => quantity_truth
  implicit none (type, external)
  private

  !> Phrases that take the place of the braces in a meaning.
  character(len=*), parameter, public :: &
    film_and_contact = 'film and solid contact', &
    film_and_contact_brake = 'film and solid contact brake', &
    all_modes_found = 'all modes asked for were found', &
    of_pads = 'of the pads against the runner', of_cone = 'film force along +z on the shaft', &
    of_foil = 'largest deflection of the foil', &
    all_members = 'all members have an answer', of_this_step = 'of this step', &
    seed_and_reason = 'seed of the member, and why it has no answer', &
    of_all_steps = 'of all load steps', of_shifted_stiffness = 'of the shifted stiffness', &
    of_whole_table = 'of the whole table', travel_of_plate = 'travel of the plate', &
    with_stretches = 'of ranks, each with a stretch of the sweep', &
    at_this_point = 'at this point', at_first_point = 'at the sweep''s first point', &
    at_fixed_equilibrium = 'in the equilibrium at which the shaft is held', &
    at_begin_of_time = 'where the time begins', &
    load_kept = '; the load is kept', shaft_fixed = '; the shaft is held', &
    linearised_there = ', contact and friction linearised there'
  !> By the axis of the sweep.
  character(len=*), parameter, public :: over_tilt(2) = ['tilt_x = 0, over tilt_x', &
                                                         'tilt_y = 0, over tilt_y']

  integer, parameter, public :: name_length = 64
  !> What has a result of a name: a bit each, and its words in the manual.
  integer, parameter, public :: bearing = 1, sweep = 2, tilting = 4, branch = 8, strip = 16, &
                                load_step = 32, modes = 64, accuracy = 128, ensemble = 256, &
                                origin = 512, sample = 1024, transient = 2048, periodic = 4096, &
                                machine = 8192
  character(len=*), parameter, public :: study_words(*) = [character(len=22) :: &
    'bearing', 'history of a sweep', 'sweep of tilt', '`--branches`', 'strip', &
    'history of a strip', 'modes', '`&accuracy`', 'table of cases', '`/provenance`', '`&sample`', &
    '`&transient`', '`&periodic`', '`&shaft`']

  !> A row of the table.
  type, public :: result_type
    character(len=name_length) :: name
    character(len=16) :: unit     !! SI, or '1'; empty for words; `own_unit`
    integer :: kind               !! `quantity_number`, ...
    integer :: studies            !! sum of the bits of those that have it
    character(len=112) :: meaning !! attribute in the result files, one line
    character(len=272) :: manual = '' !! the manual's words; empty: the meaning says it all
    logical :: asked = .false.    !! it may be the quantity of `&accuracy`
    logical :: compared = .false. !! where groups of ranks meet, to see that answers are the same
    logical :: varies = .false.   !! with the machine and from run to run
    logical :: joins = .false.    !! in the manual it shares the line above
    logical :: nodal = .false.    !! the largest or smallest of values at nodes, or bound to it
    logical :: changes_sign = .false. !! at a fold of a branch, where factors give no digit of it
  end type result_type

  character(len=*), parameter, public :: own_unit = 'its own' !! of `<quantity>`, or of a key
  character(len=*), parameter, public :: own_square = 'squared' !! the square of that
  character(len=*), parameter, public :: own_quotient = 'ratio' !! that over the key's

  type(result_type), parameter :: every_study(*) = [ &
    result_type('analysis', '', word, bearing + strip + modes + machine, 'kind of analysis'), &
    result_type('converged', '1', truth, bearing + strip + modes + machine + ensemble + sample, &
      'whether {the answer was found}'), &
    result_type('outcome', '', word, bearing + strip + modes + machine + sample, &
      'how the run ended that has no answer', &
      'of a run without an answer: `stopped` by a signal, `out_of_time` by `--time-limit`, '// &
      '`refused`: shown that there is none, `lost`: nothing shows why, `gave_up` at a bound of '// &
      'its work, `not_reached`: less than was asked for, `failed` in a part'), &
    result_type('reason', '', word, bearing + strip + modes + machine + sample + ensemble, &
      'why there is no answer; empty where there is'), &
    result_type('program', '', word, bearing + strip + modes + machine + sample + ensemble, &
      'that computed it: its version and commit', varies=.true.)]

  type(result_type), parameter :: sweeps(*) = [ &
    result_type('load', 'N', number, sweep, 'what the sweep changes', &
      'the `parameter` of `&sweep`, where it is none of the names above'), &
    result_type('load_angle', 'deg', number, sweep, 'what the sweep changes', joins=.true.), &
    result_type('speed_rpm', 'rpm', number, sweep, 'what the sweep changes', joins=.true.), &
    result_type('tilt_<a>', 'rad', number, bearing + sweep, '{what the sweep changes}', &
      'what the sweep changes; of a thrust bearing the tilt of its pads against the runner'), &
    result_type('key_value', own_unit, number, sweep, &
      'value of {the keys that the sweep changes}', &
      'where the `parameter` of `&sweep` is keys: their value, in their unit'), &
    result_type('started_anew', '1', truth, sweep, &
      'found from nothing: no path led there from the point before', &
      '1 at a point to which no path led from the one before, and that was found from nothing: '// &
      'of keys at every point, else where there is such a point'), &
    result_type('branch_changed', '1', truth, sweep, &
      'the answer is on another branch than the one before', &
      'foils with a free leading edge: 1 at a point on another branch of equilibria than the '// &
      'one before ([branches.md](branches.md#a-sweep-that-changes-its-branch))'), &
    result_type('fold', '1', truth, sweep, 'what the sweep changes turns back there', &
      'with `turn_folds`: 1 in the rows where the parameter turns back'), &
    result_type('branch', '1', total, branch, 'number of the equilibrium', &
      'history: number of the equilibrium, by rising lift of the top foil'), &
    result_type('branches', '1', total, branch, 'equilibria found; those above are the first''s', &
      'equilibria found; the rest of the summary is of the first one')]

  type(result_type), parameter :: bearings(*) = [ &
    result_type('eccentricity_<a>', 'm', number, bearing, &
      'e_<a>, of the sleeve relative to the shaft', &
      'of the sleeve relative to the shaft, at the midplane', asked=.true., compared=.true.), &
    result_type('axial_eccentricity', 'm', number, bearing, &
      'e_z, of the sleeve relative to the shaft', &
      'of a cone: e_z, of the sleeve relative to the shaft', asked=.true., compared=.true.), &
    result_type('attitude_angle', 'deg', number, bearing, &
      'from the load to the shaft''s centre, -e, positive in +theta', &
      'from the load''s direction to -e, that of the shaft''s centre, positive in +theta. A '// &
      'plain, aligned journal is thinnest there; with pads, preload, a bore, foils or a tilt '// &
      'the log and the pages name the place', asked=.true.), &
    result_type('force_<a>', 'N', number, bearing, '{film} force on the sleeve, <a>', &
      'force of the film, and of solid contact, on the sleeve; in equilibrium equal to `load`', &
      asked=.true.), &
    result_type('force_<a>_<n>', 'N', number, bearing + machine, &
      'share of pad n in the force on the sleeve, <a>; of a machine of bearing n', &
      'of several pads: share of each in `force_x`, `force_y`'), &
    result_type('torque_<a>', 'N m', number, bearing, '{film} torque on the shaft about <a>', &
      'torque of the film, and of solid contact, on the shaft', asked=.true.), &
    result_type('torque_<a>_without_suction', 'N m', number, bearing, &
      'torque_<a> of the pressure above ambient', 'the same of the pressure above ambient only'), &
    result_type('friction_torque', 'N m', number, bearing, &
      'torque with which {the film brakes} the shaft', &
      'torque with which the film, and solid contact, brake the shaft', asked=.true.), &
    result_type('power_loss', 'W', number, bearing + machine, &
      'friction torque times speed; of a machine of all bearings', asked=.true.), &
    result_type('minimum_gap', 'm', number, bearing, 'smallest film thickness', &
      asked=.true., compared=.true., nodal=.true.), &
    result_type('film_margin', '1', number, bearing, &
      'smallest film, over time where the shaft moves, over smallest_gap; below 1 too thin', &
      'with `smallest_gap` of `&capacity` where no limit is looked for: `minimum_gap` over it, '// &
      'of a shaft that moves `minimum_gap_over_time`, of a sweep its worst point; below 1 the '// &
      'film is thinner than wanted', nodal=.true.), &
    result_type('temperature_margin', '1', number, bearing, &
      'rise up to highest_temperature over that of film and top foil; below 1 too hot', &
      'with `highest_temperature` of `&capacity`: how far it is above `ambient_temperature`, '// &
      'over how far film or top foil are at most, of a sweep at its worst point; below 1 too hot', &
      nodal=.true.), &
    result_type('stress_margin', '1', number, bearing, &
      'largest_stress over the largest of the foils; below 1 too much', &
      'with `largest_stress` of `&capacity`: it over the largest of the foils, of a sweep at '// &
      'its worst point; below 1 the stress is too large', nodal=.true.), &
    result_type('minimum_gap_<n>', 'm', number, bearing + machine, &
      'smallest film thickness over pad n; of a machine of bearing n', &
      'of several pads: smallest film thickness over each', nodal=.true.), &
    result_type('minimum_gap_midplane', 'm', number, bearing, 'smallest film thickness at z = 0', &
      'smallest film thickness at z = 0 and at the bearing''s edges', asked=.true., nodal=.true.), &
    result_type('minimum_gap_edge', 'm', number, bearing, &
      'smallest film thickness at the bearing edges', asked=.true., joins=.true., nodal=.true.), &
    result_type('maximum_pressure', 'Pa', number, bearing, 'largest absolute pressure', &
      'largest and smallest absolute pressure', asked=.true., nodal=.true.), &
    result_type('minimum_pressure', 'Pa', number, bearing, 'smallest absolute pressure', &
      asked=.true., joins=.true., nodal=.true.), &
    result_type('maximum_peclet', '1', number, bearing, 'largest cell Peclet number of the film'), &
    result_type('leading_edge_lift', 'm', number, bearing, &
      'displacement of the top foil''s edge towards the shaft, at z = 0', &
      'foils of shells or beams: displacement of the top foil''s edge towards the shaft, at '// &
      'z = 0, and (`_edge`) at the ends of the bearing; of several pads the mean', &
      compared=.true.), &
    result_type('leading_edge_lift_edge', 'm', number, bearing, &
      'displacement of the top foil''s edge towards the shaft, at the ends of the bearing', &
      compared=.true., joins=.true.), &
    result_type('leading_edge_lift_<n>', 'm', number, bearing, 'leading_edge_lift of pad n'), &
    result_type('leading_edge_lift_edge_<n>', 'm', number, bearing, 'the same at the ends'), &
    result_type('trailing_edge_lift', 'm', number, bearing, &
      'displacement of the top foil''s edge towards the shaft, at z = 0', &
      compared=.true., joins=.true.), &
    result_type('trailing_edge_lift_edge', 'm', number, bearing, &
      'displacement of the top foil''s edge towards the shaft, at the ends of the bearing', &
      compared=.true., joins=.true.), &
    result_type('axial_gap', 'm', number, bearing + sweep, &
      'from the land of the pads to the runner, on the axis, foils at rest', &
      'of a thrust bearing: from the land of its pads to its runner, on the axis, foils at rest', &
      asked=.true., compared=.true.), &
    result_type('axial_force', 'N', number, bearing, '{film force that lifts the runner}', &
      'of a thrust bearing: force that lifts the runner; of a cone: along +z on the shaft; in '// &
      'equilibrium equal to `axial_load`', &
      asked=.true.), &
    result_type('axial_force_<n>', 'N', number, bearing, 'share of pad n in axial_force'), &
    result_type('axial_load', 'N', number, sweep, 'what the sweep changes'), &
    result_type('opposite_gap', 'm', number, bearing, &
      'of the bearing on the runner''s other side, on the axis', &
      'with `axial_play`: of the bearing on the runner''s other side, on the axis', &
      compared=.true.), &
    result_type('opposite_force', 'N', number, bearing, &
      'of the bearing on the runner''s other side, which presses it back', joins=.true.), &
    result_type('opposite_minimum_gap', 'm', number, bearing, &
      'of the bearing on the runner''s other side', joins=.true., nodal=.true.), &
    result_type('mean_pressure', 'Pa', number, bearing, &
      'axial_force over the area of the pads of one side', &
      asked=.true.), &
    result_type('minimum_gap_radius', 'm', number, bearing, 'where the film is thinnest', &
      'of a thrust bearing: where the film is thinnest', nodal=.true.), &
    result_type('minimum_gap_angle', 'rad', number, bearing, 'where the film is thinnest', &
      joins=.true., nodal=.true.), &
    result_type('centre_radius', 'm', number, bearing, 'centre of the pressure on pad 1', &
      'of a thrust bearing: centre of the pressure on pad 1, its angle from the leading edge', &
      asked=.true.), &
    result_type('centre_angle', 'rad', number, bearing, &
      'centre of the pressure on pad 1, from its leading edge', joins=.true., asked=.true.), &
    result_type('deflection_trailing_inner', 'm', number, bearing, &
      'of the top foil away from the runner, at the corners of its trailing edge', &
      'of a thrust bearing: of the top foil of pad 1, away from the runner, at the corners of '// &
      'its trailing edge'), &
    result_type('deflection_trailing_outer', 'm', number, bearing, &
      'of the top foil away from the runner, at the corners of its trailing edge', joins=.true.), &
    result_type('line_force_<n>', 'N', number, bearing, &
      'of crest n on the plate of pad 1, or a thrust bearing''s shells, all strips; crests '// &
      'from the leading edge on'), &
    result_type('pads_solved', '1', total, bearing, 'others are the same, turned'), &
    result_type('lifted_length', '1', number, bearing, &
      'crest length without contact over all of it', &
      'foils of shells, beams or plates: crest length without contact, over all of it', &
      compared=.true.), &
    result_type('maximum_top_foil_stress', 'Pa', number, bearing, &
      'largest von Mises stress of the top foil', &
      'foils of shells, beams or plates: largest von Mises stress at the corners of elements, '// &
      'of all pads, on either face', asked=.true., nodal=.true.), &
    result_type('maximum_bump_foil_stress', 'Pa', number, bearing + strip, &
      'largest von Mises stress of the bump foil', &
      'the same of shells or beams of the bump foil; of a strip at the full load', asked=.true., &
      nodal=.true.), &
    result_type('solid_contact_force_<a>', 'N', number, bearing, &
      'share of force_<a> that the solid contact carries', &
      'with `&shaft_contact`: share of `force_x`, `force_y` that the asperities carry'), &
    result_type('solid_contact_torque', 'N m', number, bearing, &
      'share of friction_torque that the solid contact has', &
      'the same: share of `friction_torque`; at rest what the shaft must overcome to turn'), &
    result_type('maximum_solid_contact_pressure', 'Pa', number, bearing, &
      'largest pressure of the solid contact', 'the same: largest pressure of the asperities')]

  type(result_type), parameter :: feeds(*) = [ &
    result_type('supply_flow', 'kg/s', number, bearing, 'of gas that is fed into the film', &
      'with `&feed`: gas that the whole bearing takes from its supply', asked=.true., &
      compared=.true.), &
    result_type('supply_power', 'W', number, bearing, &
      'to compress that gas from ambient pressure, isothermal', asked=.true.), &
    result_type('choked_orifices', '1', total, bearing, 'whose flow is as fast as sound'), &
    result_type('backflow_orifices', '1', total, bearing, 'through which gas leaves the film'), &
    result_type('orifice_flow_<n>', 'kg/s', number, bearing, &
      'of orifice n into the film, row by row', &
      'with `spread = ''rim''`: of orifice n into the film, row by row; of equal sectors those '// &
      'of the first'), &
    result_type('mouth_pressure_<n>', 'Pa', number, bearing, 'in the mouth of orifice n')]

  type(result_type), parameter :: groovings(*) = [ &
    result_type('pumped_pressure', 'Pa', number, bearing, &
      'to which grooves raise the film over ambient', &
      'with `&grooves`: largest mean along the motion of the pressure over ambient'), &
    result_type('flow_low', 'Pa m^3/s', number, bearing, &
      'of gas out of the end of lower z, or radius', &
      'the same: p times the volume of gas a time that leaves the end of lower z, or the inner '// &
      'radius; over `Rg T` it is the mass flow'), &
    result_type('flow_high', 'Pa m^3/s', number, bearing, &
      'of gas out of the end of higher z, or radius', &
      'the same of the end of higher z, or the outer radius'), &
    result_type('groove_end_loss', '1', number, bearing, &
      'part of the pumped pressure that the ends of bands cost', &
      'with `model = ''narrow_with_ends''`: what the jumps at the ends of a band take off the '// &
      'pressure, in the mean of the bands, over the pressure that would be pumped up without')]

  type(result_type), parameter, public :: heats(*) = [ &
    result_type('film_temperature', 'K', number, bearing, 'mean of the gas in the film', &
      'with `&thermal`: mean over the gas in the film', asked=.true.), &
    result_type('film_temperature_<n>', 'K', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n'), &
    result_type('maximum_film_temperature', 'K', number, bearing, &
      'largest mean over the gap', asked=.true., nodal=.true.), &
    result_type('maximum_film_temperature_<n>', 'K', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n', &
      nodal=.true.), &
    result_type('top_foil_temperature', 'K', number, bearing, 'mean of the top foil', &
      asked=.true.), &
    result_type('top_foil_temperature_<n>', 'K', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n'), &
    result_type('maximum_top_foil_temperature', 'K', number, bearing, &
      'largest of the top foil', asked=.true., nodal=.true.), &
    result_type('maximum_top_foil_temperature_<n>', 'K', number, bearing, 'the same of pad n', &
      nodal=.true.), &
    result_type('shaft_temperature', 'K', number, bearing, &
      'of the shaft under the film', 'of the shaft; of one that conducts along the axis the mean', &
      asked=.true.), &
    result_type('sleeve_temperature', 'K', number, bearing, 'of the sleeve', asked=.true.), &
    result_type('inlet_temperature', 'K', number, bearing, &
      'of the gas that feeds the leading edge', &
      'of the gas that feeds the leading edge; of several pads the mean', asked=.true.), &
    result_type('inlet_temperature_<n>', 'K', number, bearing, 'the same of pad n'), &
    result_type('cooling_outlet_temperature', 'K', number, bearing, &
      'of the cooling gas where it leaves', asked=.true.), &
    result_type('heat_to_shaft', 'W', number, bearing, 'from the film into the shaft', &
      asked=.true.), &
    result_type('heat_to_shaft_<n>', 'W', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n'), &
    result_type('heat_to_top_foil', 'W', number, bearing, 'from the film into the top foil', &
      asked=.true.), &
    result_type('heat_to_top_foil_<n>', 'W', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n'), &
    result_type('heat_through_bumps', 'W', number, bearing, &
      'from the top foil through the bumps into the sleeve', asked=.true.), &
    result_type('heat_through_bumps_<n>', 'W', number, bearing, 'the same of pad n'), &
    result_type('heat_to_channel', 'W', number, bearing, &
      'from the top foil into the cooling gas', asked=.true.), &
    result_type('heat_to_channel_<n>', 'W', number, bearing, 'the same of pad n'), &
    result_type('heat_by_gas', 'W', number, bearing, &
      'that the gas of the film carries out, less what it brings in', asked=.true.), &
    result_type('heat_by_gas_<n>', 'W', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n'), &
    result_type('heat_by_supply', 'W', number, bearing, &
      'that gas which is fed in brings, over gas at ambient temperature', &
      'with `&feed`: that gas which is fed in brings, less what gas carries back into the '// &
      'supply; both, and `heat_by_gas`, over gas at `ambient_temperature`', asked=.true.), &
    result_type('heat_by_supply_<n>', 'W', number, bearing + machine, &
      'the same of pad n; of a machine of bearing n'), &
    result_type('mass_flow_leading_edge', 'kg/s', number, bearing, &
      'that enters the film over the leading edges', asked=.true.), &
    result_type('mass_flow_trailing_edge', 'kg/s', number, bearing, &
      'that leaves it over the trailing edges', asked=.true.), &
    result_type('mass_flow_sides', 'kg/s', number, bearing, 'that leaves it over the sides', &
      asked=.true.), &
    result_type('running_clearance', 'm', number, bearing, &
      'clearance less what shaft and sleeve grow by temperature and speed', asked=.true.), &
    result_type('running_play', 'm', number, bearing, &
      'running_clearance less the preload of pads and of assembly', &
      'of pads with a preload, or foils with `assembly_interference`: `running_clearance` less '// &
      'both, the play of the warm shaft on foils at rest; below 0 it presses on them'), &
    result_type('energy_imbalance', '1', number, bearing + machine, &
      'power less all heat out of the film, over the power', &
      'power less all heat out of the film, over the power: what the solver left open; of a '// &
      'machine whose shaft conducts of all films and the shaft; with `&feed` the heat of '// &
      'the supply counts, over the largest of all heats'), &
    result_type('modulus_ratio_top_foil', '1', number, bearing, &
      'modulus of the top foil over its youngs_modulus', &
      'modulus of the top foil at its mean temperature, over its `youngs_modulus`; of several '// &
      'pads the mean', asked=.true.), &
    result_type('modulus_ratio_top_foil_<n>', '1', number, bearing, 'the same of pad n'), &
    result_type('modulus_ratio_bumps', '1', number, bearing, &
      'modulus of the bumps over their youngs_modulus', &
      'modulus of the bumps, halfway between top foil and sleeve, over their `youngs_modulus`; '// &
      'of several pads the mean', asked=.true.), &
    result_type('modulus_ratio_bumps_<n>', '1', number, bearing, 'the same of pad n')]

  type(result_type), parameter :: transients(*) = [ &
    result_type('time', 's', number, transient + machine, &
      'computed; eccentricity, forces, film and foils are of its end'), &
    result_type('turns', '1', number, transient + machine, 'of the shaft in that time'), &
    result_type('time_steps', '1', total, transient + machine, 'that were taken'), &
    result_type('orbit_<a>', 'm', number, transient + periodic, 'extent in a turn or period'), &
    result_type('orbit_<a>_<n>', 'm', number, transient, 'extent in one of two bearings'), &
    result_type('orbit_tilt_<a>', 'rad', number, transient, 'extent of a tilt in a turn'), &
    result_type('minimum_gap_over_time', 'm', number, transient + periodic + machine, &
      'smallest one'), &
    result_type('ending', '', word, transient + periodic + machine, &
      'why it ended before its end'), &
    result_type('not_reached', '', word, transient + periodic + machine, &
      'what was asked for and not reached', &
      'what was asked for and not reached: turns, a speed, a steady orbit, the end of a '// &
      'branch; `converged` is then false and the exit status 2'), &
    result_type('frequency_ratio', '1', number, periodic, 'of the last orbit over the speed'), &
    result_type('largest_multiplier', '1', number, periodic, 'of that orbit, which judges it'), &
    result_type('orbit_stable', '1', truth, periodic, 'whether disturbances of it die out'), &
    result_type('stability_loss', '', word, periodic, 'how they grow, where they do'), &
    result_type('subcritical', '1', truth, periodic, 'cycles begin where rest is stable')]

  !> Columns of a shaft over time, datasets `/transient/<name>` of the result file, in the order of
  !> the table of values.
  !>
  !> Their names lie in a group of their own: `time` of the summary is another number than the
  !> column's.
  type(result_type), parameter :: planar_columns(*) = [ &
    result_type('time', 's', number, transient, 'time from the beginning'), &
    result_type('turns', '1', number, transient, 'turns of the shaft so far'), &
    result_type('speed', 'rad/s', number, transient, 'speed of the shaft'), &
    result_type('eccentricity_x', 'm', number, transient, &
      'e_x, of the sleeve relative to the shaft'), &
    result_type('eccentricity_y', 'm', number, transient, &
      'e_y, of the sleeve relative to the shaft'), &
    result_type('velocity_x', 'm/s', number, transient, 'rate of e_x'), &
    result_type('velocity_y', 'm/s', number, transient, 'rate of e_y'), &
    result_type('force_x', 'N', number, transient, 'film force on the sleeve, x'), &
    result_type('force_y', 'N', number, transient, 'film force on the sleeve, y'), &
    result_type('load_x', 'N', number, transient, &
      'outer force on the shaft, x: load, unbalance, pulse, base'), &
    result_type('load_y', 'N', number, transient, &
      'outer force on the shaft, y: load, unbalance, pulse, base'), &
    result_type('minimum_gap', 'm', number, transient, 'smallest film thickness'), &
    result_type('maximum_pressure', 'Pa', number, transient, 'largest absolute pressure'), &
    result_type('minimum_pressure', 'Pa', number, transient, 'smallest absolute pressure'), &
    result_type('friction_torque', 'N m', number, transient, &
      'torque with which the film brakes the shaft'), &
    result_type('step', 's', number, transient, 'step of time that led here'), &
    result_type('stored_gas', 'Pa m^3', number, transient, &
      'p h integrated over the film (in a real gas density times p_a over that at p_a, '// &
      'times h)'), &
    result_type('gas_outflow', 'Pa m^3/s', number, transient, &
      'that leaves the film through its edges, a time'), &
    result_type('steps', '1', total, transient, 'steps so far'), &
    result_type('newton_iterations', '1', total, transient, &
      'Newton iterations so far, with those of the start'), &
    result_type('factorizations', '1', total, transient, &
      'factorizations so far, with those of the start')]

  !> Those beside them of a rotor that tilts on two bearings.
  type(result_type), parameter :: tilting_columns(*) = [ &
    result_type('tilt_x', 'rad', number, transient, &
      'tilt of the sleeves relative to the rotor about x'), &
    result_type('tilt_y', 'rad', number, transient, &
      'tilt of the sleeves relative to the rotor about y'), &
    result_type('tilt_velocity_x', 'rad/s', number, transient, 'rate of tilt_x'), &
    result_type('tilt_velocity_y', 'rad/s', number, transient, 'rate of tilt_y'), &
    result_type('torque_x', 'N m', number, transient, &
      'torque of the films on the rotor about its centre of mass, x'), &
    result_type('torque_y', 'N m', number, transient, &
      'torque of the films on the rotor about its centre of mass, y'), &
    result_type('outer_torque_x', 'N m', number, transient, &
      'outer torque on the rotor, x: couple unbalance, pulse'), &
    result_type('outer_torque_y', 'N m', number, transient, &
      'outer torque on the rotor, y: couple unbalance, pulse'), &
    result_type('eccentricity_x_1', 'm', number, transient, 'e_x in a bearing: 1 at +z, 2 at -z'), &
    result_type('eccentricity_y_1', 'm', number, transient, 'e_y in a bearing: 1 at +z, 2 at -z'), &
    result_type('eccentricity_x_2', 'm', number, transient, 'e_x in a bearing: 1 at +z, 2 at -z'), &
    result_type('eccentricity_y_2', 'm', number, transient, 'e_y in a bearing: 1 at +z, 2 at -z'), &
    result_type('minimum_gap_1', 'm', number, transient, &
      'smallest film thickness of a bearing: 1 at +z, 2 at -z'), &
    result_type('minimum_gap_2', 'm', number, transient, &
      'smallest film thickness of a bearing: 1 at +z, 2 at -z')]

  type(result_type), parameter, public :: time_columns(*) = [planar_columns, tilting_columns]
  !> Those of a shaft that does not tilt.
  integer, parameter, public :: planar_time_columns = size(planar_columns)

  type(result_type), parameter :: tilts(*) = [ &
    result_type('angular_stiffness_<a><b>', 'N m/rad', number, tilting, &
      'slope of torque_<a> over tilt_<b>, {'//at_this_point//load_kept//'}', &
      'slope of the torque (first letter) over the tilt (second), in the summary where the '// &
      'sweep begins, in the history at every point; with the shaft fixed, or else with the '// &
      'load kept; contact and friction are linearised there'), &
    result_type('secant_stiffness_<a>', 'N m/rad', number, tilting, &
      'torque_<a> less that at {'//over_tilt(1)//'}; the slope where that is zero', &
      'history: the torque, less that at zero tilt, over the tilt; the slope where that is zero'), &
    result_type('held_force_<a>', 'N', number, tilting, &
      'film force on the sleeve '//at_fixed_equilibrium, &
      'with `hold_position`: film force in the equilibrium at which the shaft is fixed (its '// &
      'place is the eccentricity)'), &
    result_type('held_leading_edge_lift', 'm', number, tilting, &
      'leading_edge_lift '//at_fixed_equilibrium, &
      'the same on shells or beams: what `leading_edge_lift`, ... are in that equilibrium'), &
    result_type('held_leading_edge_lift_edge', 'm', number, tilting, &
      'leading_edge_lift_edge '//at_fixed_equilibrium, joins=.true.), &
    result_type('held_lifted_length', '1', number, tilting, &
      'lifted_length '//at_fixed_equilibrium, joins=.true.)]

  type(result_type), parameter :: judgements(*) = [ &
    result_type('stability', '1', total, bearing, &
      'negative eigenvalues of the foils'' stiffness with the film eliminated, shaft held; '// &
      '0: stable', &
      'foils of shells or beams, with `stability` in `&solver`: negative eigenvalues of the '// &
      'foils'' stiffness in SI with the film eliminated, shaft fixed; 0: stable'), &
    result_type('growing_modes', '1', total, bearing, &
      'modes that grow where the gas resists the top foil''s motion, shaft held', &
      'the same: modes that grow where the gas resists the top foil''s motion'), &
    result_type('stability_margin', '1', number, bearing, &
      'stiffness over p_a/C of the mode nearest to a change; negative: it grows', &
      'the same: stiffness of the mode nearest to a change, pressure over deflection, over '// &
      'p_a / C; negative where it grows; next to neutral within 0.01'), &
    result_type('determinant_sign', '1', total, bearing, &
      'sign of the determinant of all equations; it changes at folds', &
      'where the shaft is balanced: sign of the determinant of all equations; along a branch '// &
      'it changes at a fold, 0 in the row of one', changes_sign=.true.), &
    result_type('edge_stiffness', 'N/m', number, bearing, &
      'force that lifts the top foil''s free edge over its displacement; negative: unstable', &
      'the same, with a free edge: force that lifts it over its mean displacement, while '// &
      'film, foils and shaft follow; near zero the equilibrium is nearly neutral, below it '// &
      'is unstable; of several pads the least one', changes_sign=.true.), &
    result_type('edge_stiffness_<n>', 'N/m', number, bearing, &
      'force that lifts the free edge of pad n over its displacement', &
      'of several pads: the same of each', changes_sign=.true.), &
    result_type('hammer_frequency', 'rad/s', number, bearing, &
      'at which a runner of the critical mass grows along the axis', &
      'of a thrust bearing with `&feed` or `&grooves`: at which a runner of the critical mass '// &
      'grows along the axis; absent where the film damps all', asked=.true.), &
    result_type('critical_mass', 'kg', number, bearing, &
      'mass on this bearing above which a rigid shaft whirls or hammers, {at this load and '// &
      'speed}', &
      'with `analysis = ''linear_dynamics''`: mass on this bearing above which a rigid shaft '// &
      'whirls, or with `&feed` a runner hammers along the axis, at this load and speed; absent '// &
      'where none does; with `&transient` that of the point where it begins', asked=.true.), &
    result_type('whirl_ratio', '1', number, bearing, &
      'frequency of that whirl over the speed of the shaft', &
      'the same: frequency of that whirl over the speed of the shaft', asked=.true.), &
    result_type('stiffness_<a><b>', 'N/m', number, bearing, &
      'real part of K + i omega C at the first frequency: force <a> over displacement <b>', &
      'the same: entries of K and C for x and y, at the first of the frequencies; those of all '// &
      'frequencies are in `/dynamics`', asked=.true.), &
    result_type('damping_<a><b>', 'N s/m', number, bearing, &
      'imaginary part of K + i omega C over omega at the first frequency: force <a> over '// &
      'velocity <b>', asked=.true., joins=.true.), &
    result_type('stiffness_zz', 'N/m', number, bearing, &
      'real part of K + i omega C at the first frequency: axial force over displacement', &
      'of a thrust bearing: the same along the axis, and of tilts', asked=.true.), &
    result_type('damping_zz', 'N s/m', number, bearing, &
      'imaginary part of K + i omega C over omega at the first frequency, along the axis', &
      asked=.true., joins=.true.), &
    result_type('stiffness_phi<a>phi<b>', 'N m/rad', number, bearing, &
      'real part of K + i omega C at the first frequency: torque <a> over rotation <b>', &
      asked=.true., joins=.true.), &
    result_type('damping_phi<a>phi<b>', 'N m s/rad', number, bearing, &
      'imaginary part of K + i omega C over omega: torque <a> over angular velocity <b>', &
      asked=.true., joins=.true.), &
    result_type('coefficients', '1', number, bearing, &
      'stiffness and damping at all frequencies, each entry over the largest of its block', &
      'stiffness and damping at all frequencies, each entry over the largest of its 2 x 2 '// &
      'block: as `coefficients_error` and `coefficients_order` only', asked=.true.), &
    result_type('growth_rate', '1/s', number, bearing + machine, &
      'growth of the rotor''s least damped mode, exp(growth t); negative: it dies out', &
      'with `&rotor`: growth of its least damped mode, exp(growth t); negative: it dies out'), &
    result_type('whirl_frequency', 'rad/s', number, bearing + machine, &
      'circular frequency of that mode', 'the same: circular frequency of that mode'), &
    result_type('damping_ratio', '1', number, bearing, &
      'damping of that mode over critical damping; negative: it grows', &
      'the same: damping of that mode over critical damping; negative: it grows'), &
    result_type('axial_frequency', 'rad/s', number, bearing, &
      'circular frequency of the rotor''s mode along its axis', &
      'with `&rotor` on a thrust bearing: circular frequency of its mode along the axis, whose '// &
      'growth and damping `growth_rate` and `damping_ratio` are'), &
    result_type('largest_growth_rate', '1/s', number, bearing, &
      'growth of the least damped mode of any kind, of rotor, foil or film', &
      'with `&rotor`: growth of the least damped mode of any kind, of rotor, foil or film'), &
    result_type('largest_growth_frequency', 'rad/s', number, bearing, &
      'circular frequency of that mode', 'the same: circular frequency of that mode'), &
    result_type('onset_speed_rpm', 'rpm', number, bearing + machine, &
      'speed at which growth_rate changes its sign, or critical_mass passes the rotor''s; the '// &
      'first along the sweep', &
      'with `&rotor` in a sweep of `speed_rpm`: speed at which `growth_rate` changes its sign, '// &
      'with a loss factor at which the critical mass passes the rotor''s, the first along the '// &
      'sweep; absent where it does not'), &
    result_type('load_capacity', 'N', number, bearing, &
      'load at which film or heat is at the limit asked for', &
      'with `analysis = ''load_capacity''`: load, in the direction of `load`, at which the '// &
      'smallest film has come down to `smallest_gap`, or film or top foil are at '// &
      '`highest_temperature`', asked=.true., nodal=.true.), &
    result_type('load_capacity_coefficient', 'lbf/(in^3 krpm)', number, bearing, &
      'that load over L D . D . N: length, diameter, speed', &
      'that load over L D . D . N, with length and diameter in inches, N in 1000 rpm'), &
    result_type('load_capacity_coefficient_si', 'N s/m^3', number, bearing, &
      'that load over L D . D . Omega, with Omega in rad/s', &
      'that load over L D . D . Omega, with Omega in rad/s'), &
    result_type('lift_off_speed_rpm', 'rpm', number, bearing, &
      'speed at which the asperities carry the part of the load asked for', &
      'with `analysis = ''lift_off''`: speed at which the asperities carry `contact_part` of '// &
      'the load', asked=.true.), &
    result_type('lift_off_supply_pressure', 'Pa', number, bearing, &
      'lowest absolute supply pressure that leaves the film asked for', &
      'with `lift_off_by = ''supply_pressure''`: absolute supply pressure, at the speed that '// &
      'is given, at which the smallest film has come down to `smallest_gap`', asked=.true., &
      nodal=.true.), &
    result_type('misalignment_allowance', 'rad', number, bearing, &
      'tilt at which film or heat is at the limit asked for', &
      'with `analysis = ''misalignment_allowance''`: tilt about `tilt_axis` at which the '// &
      'smallest film has come down to `smallest_gap`, or film or top foil are at '// &
      '`highest_temperature`', asked=.true., nodal=.true.), &
    result_type('limit_reached', '1', truth, bearing, &
      'whether the limit asked for is reached; 0: the branch of answers ends before', &
      'of the last three analyses: 1 where film or asperities are at the limit asked for, 0 '// &
      'where the branch of answers ends before, and the end is the result'), &
    result_type('d_<quantity>_d_<key>', own_quotient, number, bearing, &
      'derivative of {<quantity> by a key of the case file}', &
      'of `&sensitivity`: derivative of a quantity by a key, `_` in the place of its `%`; unit '// &
      'of the quantity over unit of the key ([sensitivity.md](sensitivity.md))'), &
    result_type('standard_deviation_<quantity>', own_unit, number, bearing, &
      'of <quantity>, that the tolerances of the keys cause', &
      'of `&sensitivity` with `tolerances`: standard deviation and variance of a quantity that '// &
      'they cause, to first order; the variance in the square of the unit'), &
    result_type('variance_<quantity>', own_square, number, bearing, &
      'of <quantity>, that the tolerances of the keys cause', joins=.true.), &
    result_type('<quantity>_error', own_unit, number, accuracy, &
      'estimated from nested meshes, absolute', &
      'estimated error of that quantity, absolute; order of convergence that the meshes show, '// &
      '0: none'), &
    result_type('<quantity>_order', '1', number, accuracy, &
      'observed order of convergence; 0: not known', joins=.true.), &
    result_type('accuracy_met', '1', truth, accuracy, &
      'whether the estimated error of {the quantity} is as small as asked for', &
      'whether the estimate is within the target; meshes that were tried'), &
    result_type('meshes', '1', total, accuracy, 'that were tried, each twice as fine', &
      joins=.true.)]

  type(result_type), parameter :: strips(*) = [ &
    result_type('crest_deflection_<n>', 'm', number, strip + load_step, &
      'mean deflection of a crest line towards the sleeve', &
      'mean over crest line n, towards the sleeve; bump 1 at the smallest x'), &
    result_type('maximum_deflection', 'm', number, bearing + strip, '{largest crest deflection}', &
      'at the full load: largest crest deflection, or travel of the plate; force on all '// &
      'crests; their ratio', asked=.true.), &
    result_type('maximum_force', 'N', number, strip, 'force on all crests', asked=.true., &
      joins=.true.), &
    result_type('loading_stiffness', 'N/m', number, strip, &
      'maximum force over maximum deflection', asked=.true., joins=.true.), &
    result_type('deflection_round_off', '1', number, strip, &
      'relative error of deflections that round-off leaves, about', &
      'relative error of deflections that round-off leaves, about, where it is above 1e-8'), &
    result_type('dissipated_energy', 'J', number, strip, 'work of the load over the cycle', &
      'strips that are unloaded again: work of the load over the cycle', asked=.true.), &
    result_type('step', '1', total, load_step, 'load step, 0: unloaded'), &
    result_type('load_factor', '1', number, load_step, 'share of the full load'), &
    result_type('force', 'N', number, load_step, 'on all crests'), &
    result_type('plate_travel', 'm', number, load_step, &
      'travel of the upper plate towards the sleeve'), &
    result_type('sleeve_<state>', '1', total, load_step, 'contact nodes in this state', &
      'contact nodes on corner (`sleeve`) and crest lines (`top`) in this state'), &
    result_type('top_<state>', '1', total, load_step, 'contact nodes in this state', &
      joins=.true.), &
    result_type('external_work', 'J', number, load_step, 'of the load, since the start'), &
    result_type('strain_energy', 'J', number, load_step, 'in the foil'), &
    result_type('penalty_energy', 'J', number, load_step, 'in the penetrations'), &
    result_type('friction_work', 'J', number, load_step, 'done against friction, since the start')]

  type(result_type), parameter :: vibrations(*) = [ &
    result_type('frequency_<n>', 'Hz', number, modes, 'natural frequency', &
      'natural frequencies, and how many of them are motions without strain'), &
    result_type('rigid_modes', '1', total, modes, 'modes without strain among those found', &
      joins=.true.), &
    result_type('frequency_round_off', '1', number, modes, &
      'relative error that round-off leaves, at most about', &
      'very thin foils: relative error of `frequency_<n>` that round-off leaves, at most '// &
      'about, where the matrix had lost digits'), &
    result_type('craig_bampton_frequency_<n>', 'Hz', number, modes, &
      'natural frequency of the reduced strip', &
      'strips: natural frequencies from their reduced matrices')]

  type(result_type), parameter :: costs(*) = [ &
    result_type('foil_unknowns_full', '1', total, bearing + strip, &
      'of the bump foil, whole width, before constraints', &
      'bump foil of shells or beams: of the whole width, before supports'), &
    result_type('foil_unknowns_retained', '1', total, bearing + strip, &
      'of its retained lines, whole width, before constraints', &
      'bump foil of shells: the same on the lines that are retained'), &
    result_type('distinct_super_elements', '1', total, bearing + strip, 'condensed once each', &
      'bump foil of shells: kinds of super-element, condensed once each'), &
    result_type('unknowns', '1', total, bearing + strip + modes + machine, &
      'unknowns of the equations', &
      'of the equations'), &
    result_type('newton_iterations', '1', total, bearing + machine + strip + load_step, &
      '{iterations of all solves}', &
      'of all solves, those on coarse meshes too; in a bearing''s history from the start of '// &
      'the run on, in a strip''s of that step'), &
    result_type('factorizations', '1', total, bearing + machine + strip + load_step + modes, &
      '{matrix factorizations of all solves}', &
      'the same of factorizations of matrices; modes: of the shifted stiffness'), &
    result_type('factorizations_finest', '1', total, bearing + machine, &
      '{matrix factorizations on the finest mesh}', 'those of them on the finest mesh'), &
    result_type('wall_time', 's', number, bearing + strip + modes + machine + ensemble, &
      '{from start to answer}', 'from start to answer', varies=.true.), &
    result_type('peak_memory', 'B', number, bearing + strip + modes + machine, &
      'sum over ranks of the largest held', varies=.true.)]

  !> Of a machine: n is a bearing, in the order of its list.
  type(result_type), parameter :: machines(*) = [ &
    result_type('mass', 'kg', number, machine, 'of shaft and discs'), &
    result_type('centre_of_mass', 'm', number, machine, 'z of it'), &
    result_type('transverse_inertia', 'kg m^2', number, machine, &
      'about an axis across, through the centre of mass'), &
    result_type('polar_inertia', 'kg m^2', number, machine, 'about the axis of the shaft'), &
    result_type('eccentricity_<a>_<n>', 'm', number, machine, &
      'e_<a> of bearing n, of the sleeve relative to the shaft'), &
    result_type('eccentricity_z_<n>', 'm', number, machine, &
      'e_z of thrust bearing n, minus its axial gap, as its file has its axes'), &
    result_type('force_z_<n>', 'N', number, machine, &
      'force of the film of thrust bearing n that lifts its runner'), &
    result_type('tilt_<a>_<n>', 'rad', number, machine, &
      'of the sleeve of bearing n against its journal, about <a>'), &
    result_type('torque_<a>_<n>', 'N m', number, machine, &
      'torque of the film of bearing n on the shaft about <a>'), &
    result_type('maximum_pressure_<n>', 'Pa', number, machine, 'largest pressure of bearing n'), &
    result_type('power_loss_<n>', 'W', number, machine, 'of bearing n'), &
    result_type('critical_speed_<n>', 'rpm', number, machine, &
      'speed at which the response to unbalance is largest, the n-th one up', &
      'with `&unbalance` at three speeds or more: speed at which the response to it is '// &
      'largest, where it is largest; the n-th one up'), &
    result_type('amplification_factor_<n>', '1', number, machine, &
      'critical_speed_<n> over the speeds between which the response there is above 0.707 of it', &
      'of `critical_speed_<n>`: that over the width between the speeds at which the response '// &
      'has 0.707 of it, as API 617 has it; absent where one of them is beyond the speeds'), &
    result_type('orbit_<a>_bearing_<n>', 'm', number, machine, 'extent at bearing n, last turns', &
      'over time: extent of the motion of the shaft''s axis in the last five turns, at '// &
      'bearing n'), &
    result_type('orbit_<a>_disc_<n>', 'm', number, machine, 'extent at disc n, last turns', &
      'the same at disc n'), &
    result_type('orbit_<a>_station_<n>', 'm', number, machine, 'extent at station n, last turns', &
      'the same at station n of `&machine`'), &
    result_type('shaft_temperature_<n>', 'K', number, machine, &
      'of the shaft under the film of bearing n, with `&thermal` in its file'), &
    result_type('sleeve_temperature_<n>', 'K', number, machine, 'of the sleeve of bearing n'), &
    result_type('running_clearance_<n>', 'm', number, machine, &
      'clearance of bearing n less what shaft and sleeve grow by temperature and speed'), &
    result_type('energy_imbalance_<n>', '1', number, machine, &
      'power of bearing n less all heat out of its film, over the power'), &
    result_type('heat_from_shaft_ends', 'W', number, machine, &
      'heat that leaves the shaft through its ends, with shaft_conductivity'), &
    result_type('heat_from_shaft_surface', 'W', number, machine, &
      'heat that leaves the shaft through its surface'), &
    result_type('heat_from_discs', 'W', number, machine, &
      'heat that leaves the shaft through its discs, with heat_conductances')]

  type(result_type), parameter :: ensembles(*) = [ &
    result_type('member', '', word, ensemble, 'name of the case file', &
      'history: name of the case file'), &
    result_type('exit_status', '1', total, ensemble + sample, &
      'that gfb would have had with this case alone', &
      'history: exit status that gfb would have had with this case alone'), &
    result_type('group', '1', total, ensemble, 'of ranks that computed it', &
      'history: group of ranks that computed it', varies=.true.), &
    result_type('members', '1', total, ensemble + sample, &
      'cases of the table, draws of the sample'), &
    result_type('converged_members', '1', total, ensemble + sample, 'of them', &
      'of them, those that have an answer'), &
    result_type('groups', '1', total, ensemble + origin, '{of ranks}', &
      'of ranks, each with cases, a stretch of the sweep, or some of the frequencies'), &
    result_type('member_<n>', '', word, ensemble + sample, '{case file}', &
      'name of the case, and how it ended; of a sample seed and reason of a member without '// &
      'answer'), &
    result_type('seed', '1', total, sample, 'that chooses what is random', &
      'history: seed that chooses the random heights of the member, and its values of the '// &
      '`parameters` of `&sample`'), &
    result_type('value_of_<key>', own_unit, number, sample, &
      'of {a key that the members have other values of}', &
      'history: value of a key among the `parameters` of `&sample`, `_` in the place of its `%`'), &
    result_type('<quantity>_mean', own_unit, number, sample, 'mean over the members', &
      'mean, standard deviation and quantiles (in percent) of that quantity over the members '// &
      'that have an answer'), &
    result_type('<quantity>_deviation', own_unit, number, sample, &
      'standard deviation of the members', joins=.true.), &
    result_type('<quantity>_q<n>', own_unit, number, sample, &
      'quantile of the members, its percentage in the name', joins=.true.)]

  type(result_type), parameter :: origins(*) = [ &
    result_type('program_version', '', word, origin, 'version of gfb'), &
    result_type('commit', '', word, origin, 'commit of its sources'), &
    result_type('compiler', '', word, origin, 'compiler that built it'), &
    result_type('build', '', word, origin, 'kind of build'), &
    result_type('libraries', '', word, origin, 'versions of the solver libraries'), &
    result_type('blas', '', word, origin, 'BLAS library, and its kernel where it is OpenBLAS'), &
    result_type('command', '', word, origin, 'command line', varies=.true.), &
    result_type('petsc_options', '', word, origin, 'options of PETSc that were given', &
      'options of PETSc from `PETSC_OPTIONS`, an options file or `--petsc`, where they can '// &
      'change the answer or its cost; absent without them'), &
    result_type('reduction', '', word, origin, 'reduction that was chosen', &
      'what reduction = ''auto'' chose, and why; absent where reduction was given'), &
    result_type('host', '', word, origin, 'machine of the first rank', varies=.true.), &
    result_type('date', '', word, origin, 'when it was written', varies=.true.), &
    result_type('ranks', '1', total, origin + ensemble, 'processes of the job'), &
    result_type('stretches', '', word, origin, 'how they fit together', &
      'sweeps on several groups: how the groups'' stretches fit together')]

  type(result_type), parameter, public :: result_rows(*) = [ &
    every_study, bearings, feeds, groovings, heats, transients, tilts, judgements, strips, &
    vibrations, costs, machines, sweeps, ensembles, origins]
end module gfb_result_table
