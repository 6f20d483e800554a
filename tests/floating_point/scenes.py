"""Small scenes of every analysis and every model, which all builds of gfb must answer alike."""

import dataclasses
import pathlib
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent/name) for name in ("verification", "hard")]

from hard_trial import BEAMS, CLEARANCE, GU2020, SHEET, STRIP, merged  # noqa: E402

HELD = {"analysis": "fixed_position"}
BALANCED = {"analysis": "equilibrium"}
PLACE = {"eccentricity": (0.3*CLEARANCE, 0.5*CLEARANCE)}
LOAD = {"load": (-60.0, 10.0)}
TILT = {"tilt": (1.0e-4, -1.0e-4)}
RING = {"leading_edge_condition": "periodic"}
RIGID = {**GU2020, "scene": BALANCED, "model": {"foil": "rigid"},
         "mesh": {"circumferential_elements": 48, "axial_elements": 8}}
SPRINGS = merged(RIGID, model={"foil": "elastic_foundation", "foundation_stiffness": 5.0e9,
                               "foundation_pressure": "local"})
MEAN = merged(SPRINGS, model={"foundation_pressure": "axial_mean"})
BEAM = merged(BEAMS, scene=BALANCED)
# Six bumps under a small bearing: shells that are quick, slow steps left out.
SHELL = merged(BEAMS, scene=BALANCED, model={"foil": "shell"}, bearing={"radius": 5.0e-3, "length": 8.0e-3},
               bump_foil={"bumps": 6}, operation={"load": (-4.0, 0.5)},
               mesh={"circumferential_elements": 24, "arc_elements": 4, "align_crests": False})
RUBBING = {"friction_top": 0.2, "friction_sleeve": 0.2}
SMOOTH = {"friction_top": 0.0, "friction_sleeve": 0.0}
LINES = {"arc_elements": 4, "flat_elements": 2, "axial_elements": 4}
PLATES = merged(STRIP, bump_foil={"bumps": 2}, mesh=LINES, contact=RUBBING)
PRESSED = merged(PLATES, bump_foil={"fixed_edge": "leading"}, contact={"friction_top": 0.0},
                 strip_load={"kind": "crest_pressure", "pressure": 0.2e6, "maximum_force": None, "steps_up": 3})
VIBRATING = {"scene": {"analysis": "modes"}, "modes": {"count": 4}, "mesh": LINES,
         "bump_foil": {**PRESSED["bump_foil"], "density": 8440.0}}
ROUGH = {"roughness": 1.0e-6, "pressure": 5.0e7, "friction": 0.12}
# A rotor on few elements, over time and about an equilibrium.
COARSE = {"circumferential_elements": 24, "axial_elements": 4}
ROTOR = merged(SPRINGS, operation={"load": (-60.0, 0.0)}, rotor={"mass": 1.5}, mesh=COARSE)
HEAVY = merged(SHELL, model={"foil": "beam"}, top_foil={"density": 8440.0}, bump_foil={"density": 8440.0},
               operation={"speed_rpm": 60000.0}, rotor={"mass": 0.1})
FREQUENCIES = {"frequency_ratios": (0.5, 1.0)}
PADS = {"scene": BALANCED, "bearing": {"kind": "thrust", "outer_radius": 0.05, "inner_radius": 0.025}, "pads": {"count": 3, "arc": 0.8},
        "ramp": {"part": 0.3, "height": 2.0e-5}, "gas": {"viscosity": 1.85e-5, "ambient_pressure": 101325.0},
        "operation": {"speed_rpm": 40000.0, "axial_load": 60.0}, "model": {"foil": "plate", "crest_stiffness": 3.0e7},
        "top_foil": {"thickness": 1.5e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29},
        "bump_foil": {"pitch": 5.0e-3, "half_length": 1.5e-3}, "mesh": {"circumferential_elements": 12, "radial_elements": 4}}

# Why answers differ, and how far they may.
FILM, FOILS, SLOPES, REBUILT, MODES, PATH, FOLDS = "film", "foils", "slopes", "rebuilt", "modes", "path", "folds"
TOLERANCE = {FILM: 1.0e-10, FOILS: 1.0e-9, SLOPES: 1.0e-8, REBUILT: 1.0e-7, MODES: 1.0e-8, PATH: 1.0e-8, FOLDS: 1.0e-5}


@dataclasses.dataclass(frozen=True)
class Scene:
    """A case and how it is run."""

    words: str
    case: dict
    kind: str = FILM          # of the tolerance
    options: tuple = ()       # of gfb
    ranks: tuple = (1,)
    status: int = 0
    restart: bool = False     # a second run goes on where the first one ended
    groups: int = 0           # another run with so many groups of ranks
    memory: bool = False      # runs under valgrind too

    @property
    def name(self):
        """Of its files."""
        return "_".join("".join(letter if letter.isalnum() else " " for letter in self.words).split())


SWEEP = {"parameter": "load", "values": (60.0, 80.0, 100.0)}
SCENES = [
    Scene("rigid, fixed shaft, tilted", merged(RIGID, scene=HELD, operation={**PLACE, **TILT}), ranks=(1, 4), memory=True),
    Scene("rigid, under a load", merged(RIGID, operation=LOAD), memory=True),
    Scene("rigid ring, whole width", merged(RIGID, operation=LOAD, bearing=RING, model={"half_width": "no"}), ranks=(1, 4)),
    Scene("rigid, upwind elements", merged(RIGID, scene=HELD, operation={**PLACE, "speed_rpm": 120000.0},
                                           model={"film_scheme": "supg"})),
    Scene("rigid, film order 2", merged(RIGID, operation=LOAD, model={"film_order": 2}), ranks=(1, 4), memory=True),
    Scene("rigid, too heavy: no answer", merged(RIGID, operation={"load": (-1.0e6, 0.0)}), PATH, status=2),
    Scene("rigid, &accuracy", merged(RIGID, scene=HELD, operation=PLACE,
                                     accuracy={"quantity": "force_x", "target": 1.0e-2}), memory=True),
    Scene("rigid, &shaft_contact", merged(RIGID, operation={"load": (-1.0e3, 0.0), "speed_rpm": 1000.0},
                                          shaft_contact=ROUGH), FOILS, memory=True),
    Scene("springs, sweep of speed", merged(SPRINGS, operation=LOAD, sweep={
        "parameter": "speed_rpm", "values": (30000.0, 40000.0, 60000.0)}), ranks=(1, 4), memory=True),
    Scene("springs, fixed shaft, sweep of tilt", merged(MEAN, operation=LOAD, sweep={
        "parameter": "tilt_x", "values": (0.0, 1.0e-4, 2.0e-4, 3.0e-4), "hold_position": True}), ranks=(1, 4), groups=2),
    Scene("springs, film and foil in turns", merged(MEAN, scene=HELD, operation=PLACE,
                                                    model={"coupling": "partitioned"}), FOILS, memory=True),
    Scene("springs, sweep to no answer, restart", merged(MEAN, operation=LOAD, output={"restart_every": 1}, sweep={
        "parameter": "load", "values": (60.0, 100.0, 1.0e6)}), PATH, status=2, restart=True, memory=True),
    Scene("beams, 100 N", merged(BEAM, operation={"load": (-100.0, 0.0)}, solver={"stability": True}), FOILS,
          ranks=(1, 4), memory=True),
    Scene("beams, tilted", merged(BEAM, operation={"load": (-100.0, 0.0), **TILT}), FOILS, ranks=(1, 4)),
    Scene("beams, sweep that remembers friction", merged(BEAM, operation={"load": (-60.0, 0.0)}, sweep={
        **SWEEP, "friction_memory": True}), FOILS),
    Scene("beams, leading edge lifted", merged(BEAM, operation={
        "load": (-100.0, 0.0), "leading_edge_lift": 2.9e-5}, mesh={
            "axial_elements": 4, "arc_elements": 12, "flat_elements": 3, "align_crests": False}), FOILS),
    Scene("beams, all equilibria", merged(SHELL, model={"foil": "beam"}), PATH, options=("--branches",), memory=True),
    Scene("beams, round the folds of a load", merged(BEAM, operation={"load": (-100.0, 0.0)}, sweep={
        "parameter": "load", "values": (100.0, 60.0, 30.0), "turn_folds": True}), FOLDS),
    Scene("beams, &shaft_contact", merged(BEAM, operation={"load": (-300.0, 0.0), "speed_rpm": 3000.0},
                                          shaft_contact=ROUGH), FOILS),
    Scene("beams, film order 2", merged(BEAM, operation={"load": (-100.0, 0.0)}, model={"film_order": 2},
                                        mesh={"circumferential_elements": 52}), FOILS),
    Scene("shells, condensed", SHELL, FOILS, ranks=(1, 4), memory=True),
    Scene("shells, full order, out of core", merged(SHELL, model={"reduction": "none"}, solver={
        "linear_solver": "out_of_core"}), FOILS, memory=True),
    Scene("shells, fixed and tilted shaft, stability", merged(
        SHELL, scene=HELD, operation={**PLACE, **TILT, "load": None}, solver={"stability": True}), FOILS, ranks=(1, 4)),
    Scene("strip under pressure", PRESSED, FOILS, ranks=(1, 4), memory=True),
    Scene("strip between plates, loop", PLATES, FOILS, ranks=(1, 4), memory=True),
    Scene("strip, loop with the paper's reset", merged(PLATES, contact={"friction_law": "tanh_reset"}), FOILS),
    Scene("strip, loop with Coulomb's law", merged(PLATES, contact={"friction_law": "coulomb"}), FOILS),
    Scene("strip, loop, restart", merged(PLATES, output={"restart_every": 2}, solver={
        "maximum_iterations": 2, "smallest_load_step": 0.9}), FOILS, status=2, restart=True),
    Scene("strip, full order, iterative", merged(PRESSED, contact=SMOOTH, model={"reduction": "none"}, solver={
        "linear_solver": "iterative"}), FOILS, ranks=(1, 4), memory=True),
    Scene("strip, full order, out of core", merged(PRESSED, model={"reduction": "none"}, solver={
        "linear_solver": "out_of_core"}), FOILS),
    Scene("strip, exponent 1.5, plate moved", merged(
        PLATES, contact={"exponent": 1.5, "normal_stiffness": 3.0e13},
        strip_load={"maximum_force": None, "maximum_displacement": 5.0e-6}), FOILS),
    Scene("strip free at both ends, no friction", merged(PLATES, contact=SMOOTH), FOILS),
    Scene("modes of an arc", merged(VIBRATING, modes={"part": "arc"}), MODES, memory=True),
    Scene("modes of a strip, Craig-Bampton", merged(VIBRATING, modes={"substructure_modes": 3}), MODES, ranks=(1, 4), memory=True),
    Scene("modes of a top foil", {"scene": VIBRATING["scene"], "modes": {"part": "top_foil", "count": 3},
                                  "bearing": SHELL["bearing"], "top_foil": {**SHEET, "density": 8440.0},
                                  "mesh": {"circumferential_elements": 16, "axial_elements": 4}}, MODES),
    Scene("springs, load capacity", merged(MEAN, scene={"analysis": "load_capacity"}, operation={"load": (-50.0, 0.0)}, mesh=COARSE,
                                           capacity={"smallest_gap": 5.0e-6}), FOILS, memory=True),
    Scene("springs, lift-off speed", merged(MEAN, scene={"analysis": "lift_off"}, operation={"load": (-20.0, 0.0)}, mesh=COARSE,
                                            shaft_contact=ROUGH), FOILS, memory=True),
    Scene("springs, misalignment allowance", merged(
        MEAN, scene={"analysis": "misalignment_allowance"}, operation={"load": (-50.0, 0.0)}, mesh=COARSE,
        capacity={"smallest_gap": 5.0e-6}), FOILS),
    Scene("beams, two pads, small vibrations", merged(
        HEAVY, scene={"analysis": "linear_dynamics"}, pads={"count": 2, "preload": 0.2}, bump_foil={"bumps": 3}, dynamics=FREQUENCIES),
          FOILS, ranks=(1, 4), memory=True),
    Scene("shells with their mass, small vibrations", merged(
        HEAVY, scene={"analysis": "linear_dynamics"}, model={"foil": "shell"}, dynamics=FREQUENCIES,
        foil_damping={"foil_mass": "on"}),
          FOILS, memory=True),
    Scene("beams, vibration amplitudes", merged(HEAVY, scene={"analysis": "linear_dynamics"}, dynamics={
        "frequency_ratios": 0.5, "vibration_amplitudes": 1.0e-7}, foil_damping={"foil_mass": "off"}), FOILS),
    Scene("beams with their mass, rotor over time", merged(HEAVY, scene={"analysis": "transient"}, output={"restart_every": 1}, transient={
        "turns": 0.1, "steps_per_turn": 24}, unbalance={"unbalance": 2.0e-8}, foil_damping={"foil_mass": "on"}), FOILS, ranks=(1, 4),
          memory=True),
    Scene("shells, rotor over time", merged(HEAVY, scene={"analysis": "transient"}, model={"foil": "shell"}, transient={
        "turns": 0.1, "steps_per_turn": 24}, unbalance={"unbalance": 2.0e-8}, foil_damping={"foil_mass": "on"}), FOILS, memory=True),
    Scene("springs, rotor that tilts over time", merged(ROTOR, scene={"analysis": "transient"}, rotor={
        "transverse_inertia": 5.0e-3, "polar_inertia": 1.0e-3, "bearing_distance": 0.2}, transient={
            "turns": 0.5, "steps_per_turn": 30}, unbalance={"couple_unbalance": 1.0e-9}, foil_damping={
                "foundation_damping": 3.0e5, "maxwell_stiffness": 3.0e9, "maxwell_time": 1.0e-4}), SLOPES, memory=True),
    Scene("springs, forced orbits", merged(ROTOR, scene={"analysis": "periodic"}, model={"foundation_pressure": "axial_mean"},
                                           rotor={"mass": 0.3}, periodic={
        "parameter": "unbalance", "final_value": 1.5e-6, "points": 2, "steps_per_turn": 20}, unbalance={"unbalance": 1.0e-6},
                                           foil_damping={"foundation_damping": 3.0e5}), PATH, memory=True),
    Scene("springs, limit cycles", merged(ROTOR, scene={"analysis": "periodic"}, model={"foundation_pressure": "axial_mean"},
                                          operation={"speed_rpm": 12700.0, "load": (-19.62, 0.0)}, rotor={"mass": 2.0}, periodic={
        "motion": "free", "parameter": "speed_rpm", "final_value": 13250.0, "points": 2, "steps_per_turn": 20},
                                          foil_damping={"foundation_damping": 3.0e5}), PATH),
    Scene("beams, sample", merged(SHELL, model={"foil": "beam"}, bump_foil={"height_deviation": 0.5e-6, "seed": 5}, sample={"count": 2}),
          FOILS, memory=True),
    Scene("springs, sensitivities", merged(SPRINGS, operation=LOAD, mesh=COARSE, sensitivity={
        "quantity": ("eccentricity_x", "friction_torque"), "parameters": ("gas%viscosity", "bearing%clearance")}), SLOPES, memory=True),
    Scene("thrust bearing, plates under a moment", merged(PADS, operation={"moment": (0.05, 0.02)}), FOILS, ranks=(1, 4), memory=True),
    Scene("thrust bearing, plates at points, small vibrations", merged(PADS, scene={"analysis": "linear_dynamics"}, model={
        "spring_pitch": 3.0e-3, "crest_springs": "two_sided"}, rotor={"mass": 3.0}, dynamics=FREQUENCIES), FOILS),
    Scene("thrust bearing, shells on two strips", merged(PADS, scene={"analysis": "linear_dynamics"}, model={
        "foil": "shell", "crest_stiffness": None}, bump_foil={
            "bumps": 3, "pitch": None, "half_length": 1.2e-3, "height": 4.0e-4, "thickness": 1.0e-4, "youngs_modulus": 2.14e11,
            "poissons_ratio": 0.29, "strips": 2, "cut_width": 1.0e-3}, contact={"friction_top": 0.1, "friction_sleeve": 0.1},
                                                         mesh={"arc_elements": 6, "flat_elements": 1}, dynamics=FREQUENCIES), FOILS,
          ranks=(1, 2), memory=True),
    Scene("plate under a journal", merged({name: keys for name, keys in SHELL.items() if name != "contact"}, model={
        "foil": "plate"}, operation={"load": (-1.5, 0.2)}, mesh={"arc_elements": None, "align_crests": None}), FOILS, ranks=(1, 2)),
    Scene("shells, sensitivities", merged(SHELL, sensitivity={
        "quantity": ("eccentricity_x", "minimum_gap"), "parameters": ("top_foil%thickness", "bump_foil%height")}), REBUILT, memory=True),
]
