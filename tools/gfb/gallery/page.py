"""Pages of the gallery: one Markdown file per result of [Gu2020], always with the same parts."""

import re
import textwrap

from matplotlib import pyplot

from gfb.gallery.runs import AMBIGUOUS
from gfb.namelist import namelist_value

# What every page and table rests on; docs/manual/frame.md has it in full.
BEARING_FRAME = (
    "theta grows from the x axis towards y, and the shaft turns in +theta; x = R theta runs along its motion, z along "
    "the axis, 0 at the midplane. (e_x, e_y) and (phi_x, phi_y) are the sleeve's relative to the shaft: the film is "
    "thinnest near the direction of -e. gap = C + (e_x + z phi_y) cos(theta) + (e_y - z phi_x) sin(theta) + h_f: phi_x "
    "and phi_y are exchanged against Eq. 12 as [Gu2020] prints it. A deflection h_f is positive towards the sleeve, a "
    "lift of an edge towards the shaft. M (Eq. 16) is the film's torque on the shaft; it restores where it grows with "
    "the tilt.")
STRIP_FRAME = (
    "x runs along the strip, on which bump 1 has the smallest x; z along the width. A deflection is positive towards "
    "the sleeve, a force where it presses the strip. There is no shaft: no rotation, and no exchange of phi_x and "
    "phi_y as in the bearing's Eq. 12.")
# Groups and keys that say nothing of the answer.
UNSAID = {"scene", "solver", "output"}
UNSAID_KEYS = {"foundation_pressure"}
UNSAID_OF_STRIPS = {"foundation_pressure", "coupling", "film_scheme", "circumferential_elements", "align_crests"}
SHORT = "**In short:** "
BARE = ("rigid", "elastic_foundation")  # foils without a mesh
UNSAID_OF_BARE = {"arc_elements", "flat_elements", "align_crests", "coupling", "foil_mass"}
PARTLY = "partly"  # a statement that some answers agree with
WIDTH = 118  # letters of a line
DOTS = 110  # a picture's, an inch


class Page:
    """A page under construction."""

    def __init__(self, name, title, folder, frame=BEARING_FRAME):
        """name: of the file, without ending; folder: where it goes."""
        self.name, self.title, self.folder, self.frame = name, title, folder, frame
        self.short = ""   # what it says in one line
        self.text = ""
        self.results = []
        self.verdicts = []  # (truth, PARTLY, or None where nothing can be said; statement; numbers)

    def say(self, text):
        """A paragraph or a list."""
        self.text += text.rstrip() + "\n\n"

    def head(self, text):
        self.say(f"## {text}")

    def items(self, lines):
        self.say("\n".join(f"- {line}" for line in lines))

    def picture(self, figure, words, ending=""):
        """Saves a figure beside the page and shows it."""
        file = f"{self.name}{ending}.png"
        figure.savefig(self.folder/file, dpi=DOTS)
        pyplot.close(figure)
        self.say(f"![{words}]({file})")

    def table(self, caption, heads, rows, words=1):
        """A table; words: columns of text, at the left."""
        lines = [heads, ["---"]*words + ["---:"]*(len(heads) - words), *rows]
        self.say(f"{caption} ([frame and signs](../../manual/frame.md)):\n\n"
                 + "".join("| " + " | ".join(row) + " |\n" for row in lines))

    def variants(self, caption, runs, scenes, variants, heads, numbers):
        """A table of scenes with one thing changed a row; returns the results, row by row.

        scenes: each a case and what is always changed; variants: what is open in the paper and the changes, {} for
        the file as it is; numbers: cells of a result, under the heads of all scenes.
        """
        if runs.quick:
            self.say("(Left out by `--quick`.)")
            return []
        results = runs.run_all([(case, {**base, **changes}) for _, changes in variants for case, base in scenes],
                               may_stop=True)
        rows, before, reasons = [], None, []
        for i, (words, changes) in enumerate(variants):
            cells = []
            for result in results[i*len(scenes):(i + 1)*len(scenes)]:
                wide = len(heads)//len(scenes)
                cells += numbers(result) if result.converged else ["no answer"] + [""]*(wide - 1)
                if not result.converged:
                    reasons.append(f"{change_words(result.changes)}: {result.reason}")
            rows.append(["" if words == before else words, change_words(changes), *cells])
            before = words
        self.table(caption, ["open", "changed to", *heads], rows, words=2)
        if reasons:
            self.items(reasons)
        return results

    def took(self, results):
        """Remembers the runs a page rests on."""
        self.results += results
        return results

    def judge(self, statement, truth, numbers):
        """A statement of the paper, whether gfb's numbers agree, and these.

        truth: one, None where there is nothing to compare with, or {answer: one}.
        """
        if isinstance(truth, dict):
            true = [name for name, one in truth.items() if one]
            if 0 < len(true) < len(truth):
                numbers += f" True of: {', '.join(true)}."
            truth = len(true) == len(truth) or (PARTLY if true else False)
        self.verdicts.append((truth if truth in (None, PARTLY) else bool(truth), statement, numbers))

    def tell_verdicts(self, title="What agrees, and what does not"):
        """The judgements, as they were given."""
        words = {True: "Agrees", False: "Does not agree", PARTLY: "Agrees in part", None: "Not comparable"}
        self.head(title)
        self.say("What the paper says, and after it gfb's numbers; each criterion is the gallery's own.")
        self.items(f"**{words[truth]}**: {statement} {numbers}" for truth, statement, numbers in self.verdicts)

    def count(self):
        """Judgements in words."""
        true, partly, false = (sum(truth == wanted for truth, *_ in self.verdicts if truth is not None)
                               for wanted in (True, PARTLY, False))
        rest = len(self.verdicts) - true - partly - false
        words = f"{true} of {true + partly + false} statements agree" if true + partly + false else "nothing to judge"
        return (words + (f", {partly} in part" if partly else "")
                + (f", {rest} cannot be compared" if rest else ""))

    def parameters(self, result, words=""):
        """All keys of a run that matter for its answer."""
        groups = {}
        unsaid = UNSAID_KEYS if ("bearing", "radius") in result.used else UNSAID_OF_STRIPS
        if foil_of(result) in BARE:
            unsaid = UNSAID_OF_BARE
        for (group, key), (value, default) in result.used.items():
            if group not in UNSAID and key not in unsaid:
                groups.setdefault(group, ([], []))[default].append(f"{key} = {short_value(value)}")
        self.head("Parameters")
        self.say(words)
        rows = [[f"`&{group}`", *("<br>".join(f"`{one}`" for one in column) for column in both)]
                for group, both in groups.items()]
        self.table("All keys but those of the solver, in SI units", ["group", "in the case file", "by default"], rows,
                   words=3)

    def write(self):
        """Writes the page; returns its path."""
        path = self.folder/f"{self.name}.md"
        made = (f"Made by `tools/gallery --only {self.name}` with {versions(self.results)}. "
                f"{mesh_line(self.results)}[All pages](README.md).")
        return write_lines(path, f"# {self.title}\n\n{made}\n\n{SHORT}{self.short}\n\n"
                                 f"{frame_block(self.frame)}\n\n{self.text}")


def frame_block(frame):
    """What every page says of frame and signs."""
    return f"> **Frame and signs** ([in full](../../manual/frame.md)): {frame}"


def write_index(folder, names):
    """The gallery's first page, from the pages there are; returns its path."""
    rows = []
    for name in names:
        path = folder/f"{name}.md"
        if path.exists():
            text = path.read_text(encoding="utf-8")
            short = re.search(re.escape(SHORT) + r"(.*?)\n\n", text, re.DOTALL)[1]
            rows.append(f"| [{text.splitlines()[0].removeprefix('# ').removeprefix('[Gu2020] ')}]({path.name}) | "
                        f"{' '.join(short.split())} |")
    return write_lines(folder/"README.md", "\n".join([
        "# Gallery: gfb beside [Gu2020]", "",
        "A page for every result of [Gu2020] section 4: picture, numbers, parameters, what agrees with the paper's "
        "text and what does not, what the paper leaves open and what that does to the answer. The paper prints curves "
        "and few numbers; no curve was digitised. All numbers and judgements are computed, by criteria the pages name. The last "
        "page is beside the paper: a shaft over time.",
        "",
        "One command makes everything here (`--only NAME,...` some pages, `--reuse` without running again what was "
        "run):", "",
        "```", "tools/gallery", "```", "", frame_block(BEARING_FRAME), "",
        "| page | in short |", "| --- | --- |", *rows, "",
        "The main job and what is beside the paper: [bearing.md](../../manual/bearing.md), [strip.md](../../manual/strip.md); mesh "
        "convergence: [bearing_mesh.md](../bearing_mesh.md); costs: [bench_bearing.md](../bench_bearing.md), "
        "[bench_strip.md](../bench_strip.md)."]))


def write_lines(path, text):
    """Writes Markdown with broken lines; returns its path."""
    path.write_text("\n".join(map(wrapped, text.rstrip().splitlines())) + "\n", encoding="utf-8")
    return path


def wrapped(line):
    """A line of Markdown, broken where that means nothing."""
    start = re.match(r"(> |- )?", line)[0]
    if line.startswith(("|", "!", "#")):
        return line
    return textwrap.fill(line, WIDTH, subsequent_indent={"- ": "  "}.get(start, start), break_long_words=False,
                         break_on_hyphens=False)


def versions(results):
    """Programs the results come from."""
    found = {f"gfb {one.provenance['program_version']} ({one.provenance['commit']}, "
             f"{one.provenance['libraries']}, {one.provenance['compiler']})" for one in results}
    return " and ".join(sorted(found)) or "gfb"


def mesh_line(results):
    """Mesh of a page's first result."""
    return f"Mesh, where nothing else is said: {mesh_words(results[0])}. " if results else ""


def mesh_words(result):
    """A mesh in words, as it was solved."""
    def key(name):
        return result.used["mesh", name][0]
    if foil_of(result) in BARE:
        return f"{key('circumferential_elements')} x {key('axial_elements')} elements of the film"
    bumps = f"{key('arc_elements')} + {key('flat_elements')} elements of an arc and a flat"
    if ("bearing", "radius") not in result.used:
        return f"{bumps}, {key('axial_elements')} over the width"
    film = result.film
    lines = "crests on lines of nodes" if key("align_crests") == ".true." else "crests inside elements"
    return f"{len(film.theta) - 1} x {len(film.z) - 1} elements of film and top foil, {lines}; bumps of {bumps}"


def foil_of(result):
    """The model of the foils of a bearing; empty for a strip."""
    return result.used.get(("model", "foil"), ("",))[0].strip("'")


def short_value(value):
    """A namelist's value with at most six digits."""
    return value if "'" in value else re.sub(r"-?\d+\.\d*(?:e[+-]?\d+)?|-?\d+e[+-]?\d+", short_number, value)


def short_number(found):
    """The number a regular expression found."""
    value = float(found[0])
    if value == 0.0 or 1.0e-3 <= abs(value) < 1.0e5:
        return f"{value:.6g}"
    mantissa, exponent = f"{value:.5e}".split("e")
    return f"{float(mantissa):g}e{int(exponent)}"


def input_link(case):
    """A link to a case file."""
    return f"[inputs/{case}.nml](../../../inputs/{case}.nml)"


def change_words(changes):
    """Changed keys as a case file has them."""
    return ", ".join(f"`{name.split('.')[1]} = {short_value(namelist_value(value))}`"
                     + (f" in `&{name.split('.')[0]}`" if name in AMBIGUOUS else "") for name, value in changes.items())


def percent(one, other):
    """How far a value lies from another."""
    return f"{100.0*(one/other - 1.0):+.2f} %"
