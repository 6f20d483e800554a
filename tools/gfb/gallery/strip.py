"""Pages of [Gu2020] section 4.1: what condensation saves, strips under pressure, loops between plates."""

import json
import pathlib

import numpy

from gfb.bench import strip as bench_strip
from gfb.gallery.page import STRIP_FRAME, Page, change_words, input_link, percent
from gfb.plot import strip as plot_strip
from gfb.results import read_json
from gfb.tool import ROOT

REFERENCE = ROOT/"tests/verification/reference/strip.json"
PAPER_FULL, PAPER_REDUCED, PAPER_RATIO = 38505, 7905, 7.0
MICRO, MILLI = 1.0e6, 1.0e3
# Criteria of the judgements.
SAME = 0.001         # of the independent deflections' largest: beyond it they do not agree
RATIO_WITHIN = 1.0   # of the time ratio: "approximately one-seventh"
MESH_WITHIN = 0.02   # of the deflections: "mesh independence had been checked"
LOOP_WITHIN = 0.01   # of travel, stiffness and lost work
ROUNDS = 3           # of the times
FRICTIONS = (0.0, 0.05, 0.1, 0.2, 0.5)
DOUBLE_MESH = {"mesh.arc_elements": 24, "mesh.flat_elements": 6, "mesh.axial_elements": 100}


def independent():
    """The independent program's numbers."""
    return read_json(REFERENCE)


# --- what condensation saves ---

def draw_cost(runs, folder):
    """Unknowns of the full and the condensed strip, and the times of both."""
    page = Page("section41", "[Gu2020] section 4.1: what condensation saves", folder, STRIP_FRAME)
    case = "gu2020_strip_case1_uniform"
    full, reduced = page.took([runs.run(case, {"model.reduction": way}) for way in ("none", "guyan")])
    scenes, measured = bench_strip.SCENES[:2], timed(runs)
    both = [found(reduced, name) for name in ("foil_unknowns_full", "foil_unknowns_retained")]
    apart = crest_difference(full, reduced)
    ratios = [bench_strip.gain(one, "reduced, full width") for one in measured]
    halves = [bench_strip.gain(one, bench_strip.LEAST) for one in measured]
    page.judge(f"the full model has {PAPER_FULL:,}, the reduced one {PAPER_REDUCED:,} unknowns.",
               both == [PAPER_FULL, PAPER_REDUCED], f"gfb: {both[0]:,.0f} and {both[1]:,.0f}, before supports.")
    page.judge("the reduction introduces no error in statics.", apart < 1.0e-9,
               f"Full and reduced deflections differ by {apart:.0e} of the largest (criterion: 1e-9).")
    page.judge("the reduced model needs about one seventh of the full one's time.",
               any(abs(one - PAPER_RATIO) <= RATIO_WITHIN for one in ratios),
               f"Condensation alone gives {ratios[0]:.1f} (case 1) and {ratios[1]:.1f} (case 2); with half the width, "
               f"which the symmetry of load and strip allows, {halves[0]:.1f} and {halves[1]:.1f} (criterion: 6 to 8 "
               "by condensation alone).")
    page.short = (f"{both[0]:,.0f} to {both[1]:,.0f} unknowns as in the paper; the time's ratio is {ratios[0]:.1f}, "
                  f"with half the width {halves[0]:.1f}; the paper says about 7.")
    picture = f"{page.name}.png"
    bench_strip.draw(scenes, measured, folder/picture)
    page.say(f"![CPU time of each model and its parts, over that of full order and full width]({picture})")
    title, heads, rows = bench_strip.cost_table(scenes, measured)
    page.table(f"CPU times of whole processes, medians of {ROUNDS} rounds on one machine; "
               + " ".join(title.split()), heads, rows, words=2)
    page.tell_verdicts()
    page.head("What the paper leaves open")
    page.items([
        "Which scene was timed, with which solver, and what of set-up, condensation and files is in the time. Here: "
        "the strip of fig. 7a with friction on both sides in ten load steps, and the loop of fig. 8a; everything is in "
        "it; MUMPS factors both models in an order of little fill.",
        "Whether the full model was solved with a sparse order as good as the reduced one's. A condensed bump is a "
        "dense block between two lines, so on this mesh both factorizations need about as much work: "
        "[bench_strip.md](../bench_strip.md) counts it, and shows finer meshes, where condensation saves more.",
        "The times depend on the machine and on what else runs there; ratios inside a round hardly do."])
    page.parameters(reduced, f"The strip of {input_link(case)}, whose unknowns are counted; `reduction = 'none'` keeps "
                             "all. The timed scenes stand in `tools/bench_strip.py`.")
    return page


def found(result, name):
    """A number of the summary."""
    return result.summary[name]


def timed(runs):
    """Measurements of tools/bench strip's first two scenes, kept with the runs."""
    kept = pathlib.Path(runs.folder)/"section41_times.json"
    before = read_json(kept) if runs.reuse and kept.exists() else None
    if isinstance(before, dict) and before.get("program") == runs.program:
        measured = before["measured"]
    else:
        runs.folder.mkdir(parents=True, exist_ok=True)
        scenes = bench_strip.SCENES[:2]
        measured = [{model: [] for model in bench_strip.MODELS} for _ in scenes]
        for turn in range(ROUNDS):
            print(f"  times the strips, round {turn + 1} of {ROUNDS}", flush=True)
            for scene, of_scene in zip(scenes, measured):
                for model in bench_strip.MODELS:
                    one = bench_strip.measure(runs.gfb, scene, model, runs.folder)
                    one["answers"] = {name: values.tolist() for name, values in one["answers"].items()}
                    of_scene[model].append(one)
        kept.write_text(json.dumps({"program": runs.program, "measured": measured}), encoding="utf-8")
    for one in (one for of_scene in measured for several in of_scene.values() for one in several):
        one["answers"] = {name: numpy.asarray(values) for name, values in one["answers"].items()}
    return measured


# --- strips under pressure ---

def crests(result):
    """Mean deflection of each crest line under the full load [um]."""
    count = sum(name.startswith("crest_deflection_") for name in result.summary)
    return numpy.array([MICRO*result[f"crest_deflection_{n}"] for n in range(1, count + 1)])


def crest_difference(one, other):
    """Largest difference of crest deflections over the largest of them."""
    return numpy.abs(crests(one) - crests(other)).max()/numpy.abs(crests(other)).max()


def draw_uniform(runs, folder):
    """Fig. 7a."""
    known = independent()["case1"]["crest_deflection_um"]
    known = [known["friction 0"], known["friction_sleeve 0.1, crest free to slide"],
             known["friction 0.1 at sleeve and at the crest (immobile top plate)"]]
    page = Page("fig7a", "[Gu2020] fig. 7a: ten bumps under a uniform pressure of 0.2 MPa", folder, STRIP_FRAME)
    return draw_pressed(runs, page, "gu2020_strip_case1_uniform", known, "0.2 MPa * pitch * width on every crest line")


def draw_increasing(runs, folder):
    """Fig. 7b."""
    known = independent()["case1"]["increasing_decreasing_peak_0.4MPa_um"]
    known = [known["friction 0"], known["friction_sleeve 0.1"], None]
    page = Page("fig7b", "[Gu2020] fig. 7b: ten bumps under an increasing and decreasing pressure, 0.4 MPa at most",
                folder, STRIP_FRAME)
    page = draw_pressed(runs, page, "gu2020_strip_case1_increasing_decreasing", known,
                        "0.4 MPa * min(n, 11 - n)/5 * pitch * width on the crest line of bump n")
    return page


def draw_pressed(runs, page, case, known, load):
    """A strip under crest pressures: without friction, with it on the sleeve, and on the crests too."""
    top = {"contact.friction_top": 0.1}
    motion = {"contact.friction_direction": "motion"}
    three = page.took([runs.run(f"{case}_frictionless"), runs.run(case), runs.run(case, top)])
    plain = [three[0], runs.run(case, motion), runs.run(case, {**top, **motion})]
    off = [None if values is None else numpy.abs(crests(one) - values).max() for one, values in zip(three, known)]
    off_plain = [None if values is None else numpy.abs(crests(one) - values).max() for one, values in zip(plain, known)]
    names = ("no friction", "sleeve 0.1", "sleeve and crests 0.1")
    opened = [(one.path, one.open()) for one in three]
    page.picture(plot_strip.draw([path for path, _ in opened], [file for _, file in opened], "bumps", []),
                 "Mean deflection of each crest line")
    heads, columns = ["bump"], [[str(n) for n in range(1, len(crests(three[0])) + 1)]]
    for name, one, values in zip(names, three, known):
        heads.append(name)
        columns.append([f"{value:.3f}" for value in crests(one)])
        if values is not None:
            heads += ["independent", "difference"]
            columns += [[f"{value:.3f}" for value in values],
                        [f"{value:+.4f}" for value in crests(one) - numpy.array(values)]]
    page.table("Mean deflection of crest lines [um]; independent: another program's shells on the same mesh, contact "
               "stiffness 1e11 N/m^2", heads, [list(row) for row in zip(*columns)], words=0)
    spans = [(name, one, other) for name, one, other in zip(names, off, off_plain) if one is not None]
    largest = max(numpy.abs(values).max() for values in known if values is not None)
    page.say("The independent program lets friction act along x alone. Largest differences from it, in um, friction as "
             "a vector (gfb's default) and along x alone (`friction_direction = 'motion'`): "
             + "; ".join(f"{name} {one:.4f} and {other:.4f}" for name, one, other in spans) + ".")
    page.judge("the reduced model agrees with an analytical model and a finite element analysis (of [LeLez2007]; "
               "printed as curves only).", None, "No numbers are printed.")
    page.judge("(independent solution) the crest deflections are the same.",
               max(off_plain_known(off_plain)) < SAME*largest,
               f"At most {max(off_plain_known(off_plain)):.3f} um off with friction along x (criterion: "
               f"{SAME*largest:.3f} um, {100*SAME:.1f} % of the largest deflection).")
    if not runs.quick:
        change = crest_difference(three[1], runs.run(case, DOUBLE_MESH))
        page.judge("the mesh is fine enough, by comparison with a mesh twice as fine.", change < MESH_WITHIN,
                   f"On twice the elements in every direction the deflections change by up to {100.0*change:.1f} % of the "
                   f"largest (criterion: {100.0*MESH_WITHIN:.0f} %; the paper names none).")
    page.tell_verdicts()
    page.short = (f"within {max(off_plain_known(off_plain)):.3f} um of the independent solution; friction lowers bump "
                  f"1 from {crests(three[0])[0]:.2f} to {crests(three[1])[0]:.2f} um and bump {len(crests(three[0]))} "
                  f"from {crests(three[0])[-1]:.2f} to {crests(three[1])[-1]:.2f} um; the paper prints curves only.")
    tell_open_pressed(runs, page, case, load)
    page.parameters(three[1], f"{input_link(case)}, and {input_link(case + '_frictionless')}. Changed in the third "
                              f"column: {change_words(top)}, on a plate at rest that presses with the crest's load.")
    return page


def off_plain_known(values):
    """Differences there are."""
    return [value for value in values if value is not None]


def tell_open_pressed(runs, page, case, load):
    """What the paper does not say of a pressed strip, and what depends on it."""
    variants = [("the file as it is", {})]
    variants += [("friction, on the sleeve (table 1: 0.1; where it acts is not said)", {"contact.friction_sleeve": one})
                 for one in FRICTIONS]
    variants += [("friction on sleeve and crests", {"contact.friction_sleeve": one, "contact.friction_top": one})
                 for one in FRICTIONS[1:]]
    variants += [("how the strip is fixed, its first line", {"bump_foil.fixed_line": one})
                 for one in ("flat", "half_flat")]
    variants += [("friction as a vector or along x", {"contact.friction_direction": "motion"}),
                 ("the friction law, its regularisation", {"contact.friction_law": "coulomb"}),
                 ("stick length u_max, a tenth", {"contact.stick_length": tenth_of_stick(runs.run(case))}),
                 ("contact stiffness", {"contact.normal_stiffness": 1.0e10}),
                 ("", {"contact.normal_stiffness": 1.0e12}),
                 ("whether the mesh is converged: twice the elements", DOUBLE_MESH)]
    last = len(crests(runs.run(case)))
    shown = (1, 2, last//2 + 1, last)
    page.head("What the paper leaves open, and what it does")
    page.say(f"The load on a crest is not said either: here {load}.")
    page.variants("Crest deflections [um], the case file with one thing changed", runs, [(case, {})], variants,
                  [f"bump {n}" for n in shown], lambda one: [f"{crests(one)[n - 1]:.3f}" for n in shown])


def tenth_of_stick(result):
    """A tenth of the stick length used [m]."""
    return float(f"{0.1*float(result.used['contact', 'stick_length'][0]):.3g}")


# --- loops between plates ---

CLAMPED = {"bump_foil.fixed_edge": "leading", "bump_foil.fixed_line": "flat"}
LOW = {"contact.friction_top": 0.1, "contact.friction_sleeve": 0.1}
ANSWERS = (("maximum_deflection", "w_max_um", MICRO, "travel [um]", 3), ("loading_stiffness", "K_load_N_per_mm", 1.0e-3,
           "stiffness [N/mm]", 1), ("dissipated_energy", "E_diss_mJ", MILLI, "lost work [mJ]", 4))


def draw_four(runs, folder):
    """Fig. 8a."""
    known = independent()["case2"]
    page = Page("fig8a", "[Gu2020] fig. 8a: four bumps between plates, loaded and unloaded", folder, STRIP_FRAME)
    strips = [("both ends free", {}, known["four_bumps_both_ends_free"]),
              ("a flat before the first bump, its edge clamped", CLAMPED, known["four_bumps_flat_edge_clamped"])]
    return draw_loop(runs, page, "gu2020_strip_case2_four_bumps", strips)


def draw_six(runs, folder):
    """Fig. 8b."""
    known = independent()["case2"]
    page = Page("fig8b", "[Gu2020] fig. 8b: six bumps between plates, loaded and unloaded", folder, STRIP_FRAME)
    strips = [("both ends free", {}, None), ("both ends free, friction 0.1", LOW,
                                            known["six_bumps_both_ends_free_friction_0.1"]),
              ("a flat before the first bump, its edge clamped", CLAMPED, None)]
    return draw_loop(runs, page, "gu2020_strip_case2_six_bumps", strips)


def draw_loop(runs, page, case, strips):
    """Loops of force and travel, and their numbers."""
    results = page.took([runs.run(case, changes) for _, changes, _ in strips])
    opened = [(one.path, one.open()) for one in results]
    page.picture(plot_strip.draw([path for path, _ in opened], [file for _, file in opened], "loop", []),
                 "Force against the upper plate's travel")
    rows, worst = [], 0.0
    for (words, _, known), one in zip(strips, results):
        row = [words]
        for name, key, scale, _, digits in ANSWERS:
            value = scale*one[name]
            row += [f"{value:.{digits}f}", "" if known is None else f"{known[key]}",
                    "" if known is None else percent(value, known[key])]
            if known is not None:
                worst = max(worst, abs(value/known[key] - 1.0))
        rows.append(row)
    heads = ["strip"] + [word for *_, head, _ in ANSWERS for word in (head, "independent", "difference")]
    page.table("Travel and stiffness at the full load, and work lost in the cycle; independent: another program's "
               "shells",
               heads, rows)
    base = results[0]
    page.judge("the loops agree with ABAQUS and with measurements of [Larsen2014] (printed as curves only).", None,
               "No numbers are printed.")
    page.judge("(independent solution) travel, stiffness and lost work are the same.", worst < LOOP_WITHIN,
               f"At most {100.0*worst:.2f} % off (criterion: {100.0*LOOP_WITHIN:.0f} %); the lost work depends on the "
               "friction law's regularisation, see below.")
    page.judge("friction makes a loop, and the work it loses is simulated.", base["dissipated_energy"] > 0.0,
               f"{MILLI*base['dissipated_energy']:.3f} mJ are lost, {100.0*lost_share(base):.0f} % of the work done "
               "under growing load.")
    if not runs.quick:
        finer = runs.run(case, DOUBLE_MESH)
        changes = [abs(base[name]/finer[name] - 1.0) for name, *_ in ANSWERS]
        page.judge("the mesh is fine enough, by comparison with a mesh twice as fine.", max(changes) < MESH_WITHIN,
                   f"On twice the elements in every direction travel, stiffness and lost work change by "
                   f"{', '.join(f'{100.0*one:.1f} %' for one in changes)} (criterion: {100.0*MESH_WITHIN:.0f} %).")
    page.tell_verdicts()
    page.short = (f"travel {MICRO*base['maximum_deflection']:.1f} um, stiffness {1.0e-3*base['loading_stiffness']:.0f} "
                  f"N/mm, {MILLI*base['dissipated_energy']:.3f} mJ lost, within {100.0*worst:.2f} % of the independent "
                  "solution where it has the strip; the paper prints curves only.")
    tell_open_loop(runs, page, case)
    page.parameters(base, f"{input_link(case)}. Clamped: {change_words(CLAMPED)}.")
    return page


def lost_share(result):
    """Lost work over the work of the load on the way up."""
    return result["dissipated_energy"]/result.history["external_work"].max()


def tell_open_loop(runs, page, case):
    """What the paper does not say of a strip between plates, and what depends on it."""
    both = [{"contact.friction_top": one, "contact.friction_sleeve": one} for one in FRICTIONS]
    variants = [("the file as it is", {})]
    variants += [("friction (table 1: 0.2)", one) for one in both]
    variants += [("how the strip is fixed", {"bump_foil.fixed_edge": "leading", "bump_foil.fixed_line": one})
                 for one in ("corner", "flat", "half_flat")]
    variants += [("the friction law, its regularisation", {"contact.friction_law": one})
                 for one in ("tanh_reset", "coulomb")]
    variants += [("stick length u_max, a tenth", {"contact.stick_length": tenth_of_stick(runs.run(case))}),
                 ("friction as a vector or along x", {"contact.friction_direction": "motion"}),
                 ("contact stiffness", {"contact.normal_stiffness": 1.0e10}),
                 ("", {"contact.normal_stiffness": 1.0e12}),
                 ("whether the mesh is converged: twice the elements", DOUBLE_MESH)]
    page.head("What the paper leaves open, and what it does")
    page.say("How far the strips are pressed is not said in numbers: here 25 N a bump. Travel scales with the force "
             "and the lost work with its square, so one load stands for all. The rule of the paper's Eq. 10 is "
             "`'tanh_reset'`; [strip.md](../../manual/strip.md#how-friction-is-solved) says why it is not the default.")
    page.variants("The case file with one thing changed", runs, [(case, {})], variants,
                  [head for *_, head, _ in ANSWERS],
                  lambda one: [f"{scale*one[name]:.{digits}f}" for name, _, scale, _, digits in ANSWERS])
