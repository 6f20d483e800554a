"""Published bearings: the case files of inputs/bearings/ beside the numbers of their papers (three minutes).

What was published, what is assumed and what is expected stands in the first comments of each case file, in lines of
`! word: text` that go on in lines of `!   text`. Each is run as it is, and again with each of its `varied` keys.
"""

import dataclasses
import pathlib
import re
import tempfile
import textwrap

from gfb.case import Case
from gfb.namelist import python_value
from gfb.program import call
from gfb.running import run_file
from gfb.tables import markdown_table, plain_table, readable_unit
from gfb.tool import ROOT, stop

FOLDER = ROOT/"inputs/bearings"
PAGE = ROOT/"docs/measured/bearings.md"
SECONDS = 600  # no case takes that long
WORDS = {"source": 1, "published": 1, "number": 1, "expected": 1, "assumed": 1, "varied": 0, "differs": 0, "more": 0}  # at least so often
NUMBER = re.compile(r"(?P<name>\w+) = (?P<value>[-+.\de]+) (?P<unit>.+?), (?P<meaning>.+)")
EXPECTED = re.compile(r"within a factor of (?P<factor>[\d.]+), (?P<reason>.+)")
VARIED = re.compile(r"(?P<key>\w+%\w+) = (?P<values>[^,]+), (?P<meaning>.+)")
HEAD = """# Published bearings

Written by `tools/bench bearings --docs` from the case files of [inputs/bearings](../../inputs/bearings/), which are run as they are, on coarse
meshes; a [finer one](comparisons.md) moves the load of [Heshmat1982]'s journal bearing by a tenth.

- *Published* is a number that was read in the source named; where its text has another unit or form, the bearing's section says how it
  was turned into a result of gfb. Nothing was read off a curve, quoted from memory or fitted.
- *Second-hand*: not the report was read, but what a digest of it says, which seems to be written by a language model; its numbers were not held
  against the report itself.
- No source that could be read has all sizes: abstracts name diameters, speeds and loads, digests some foils. What they leave out is
  *assumed*, the same for all where that is possible: the foils and the clearance of [Gu2020]'s journal bearing, pads and springs of gfb's own
  thrust bearings.
- *Expected* is the same for all: a factor of 3 either way, because so much is assumed. *As expected* is therefore an agreement of
  orders, no validation; *differs* is a difference beyond it, and the section says what may be behind it.
- *Varied*: what the answer becomes with one key changed. Where this spreads wider than the difference, the difference says little.
"""
SAID = """
## What the lines say

- **Journal bearings** come within about a factor of 2 of what was measured of load and stiffness, from 35 to 100 mm; top foil, clearance and
  the film at which a test ends move them as much. gfb's loads are below those of good bearings, and above that of a simple one made from what is
  public. The film alone brakes less than a rig measures.
- **Thrust bearings whose foils are alike everywhere** bear {least:.2f} to {most:.2f} of what is published of good ones, rigid pads more than
  that: the published loads lie between. How stiff the foils are, and how that is spread over a pad, decides; no abstract gives it. Of
  [Dykas2008]'s bearing, a modest one, the stiffness was measured, and the load agrees. That proves little: from the least to the largest
  stiffness measured, gfb's load grows several times.

## Elsewhere

- [Ruscitto1978]'s bearing and [Larsen2014]'s strips, whose sizes [Gu2020] prints and whose measurements are curves only:
  [gallery](gallery/README.md), figs. 8 to 10.
- Capacity and drag of two of these bearings with other foils, meshes and heat: [comparisons.md](comparisons.md).

## Looked for, and left out

Searched were stored web pages, of which the search shows the beginning alone, and files of public repositories, by the names of authors, titles,
sizes and words of the field in several languages.

- Only the abstract, or its beginning, could be read, and it has no size of the bearing, or no number to compare: a third-generation bearing
  under 222 N at 20,000 to 40,000 rpm (Radil and Batcho 2011), power loss in helium, nitrogen and carbon dioxide up to 4.83 MPa (Briggs and
  others 2008), a thrust bearing that takes off at 18,000 rpm and bears 80 kPa (Kim and Park 2018), one of 120 to 170 kPa (a thesis at Arlington,
  2018), one under 83 N at 80,000 rpm in nitrogen (Behera and Sahoo 2018), a ring of metal mesh of 28 mm (San Andres and Chirathadam 2010),
  air-cycle machines at 90,000 rpm (Heshmat 1993), turbochargers up to 130,000 rpm (Lee and others 2012; Ryu and others 2015), polymer-coated
  foils (Coatings 12:1252), lift-off of three pads (Lubricants 13:75), a compressor for fuel cells (Lubricants 13:181), heat of a thrust bearing
  (Lubricants 12:143).
- A digest has sizes, but what was measured is a curve or relative: clearances that bear most (Radil, Howard and Dykas 2002), power loss of a
  bearing of 50 mm over its load (DellaCorte and Bruckner, performance map), thrust bearings in air [Bruckner2012].
- Programs in public repositories have sizes of foils without a measured number beside them: a bearing of 35 mm of Zhang and others 2023.
- The text could not be read here at all: [Heshmat1983], [SongKim2007], the tests behind [DellaCorteValco2000], Heshmat 1994, Rubio and San Andres
  2006, Kim and San Andres 2008, the theses of Dykas, Bruckner and von Osmanski behind their first page, and the report [Ruscitto1978] itself.
"""


@dataclasses.dataclass(frozen=True)
class Number:
    """A published number, as a result that gfb names."""

    name: str
    value: float
    unit: str
    meaning: str


@dataclasses.dataclass(frozen=True)
class Varied:
    """A key with another value, and what that assumes."""

    key: str
    value: object
    meaning: str


@dataclasses.dataclass(frozen=True)
class Bearing:
    """A case file of the corpus: what its first comments say."""

    path: pathlib.Path
    title: str
    words: dict         # of the lines that are text: source, published, expected, assumed, differs, more
    numbers: tuple
    varied: tuple
    factor: float       # expected: the answer over the published number is between 1/factor and factor


def read_bearing(path):
    """A case file's first comments; stops where a line is missing, twice or not of its form."""
    title, fields = read_head(path)
    found = {word: [text for key, text in fields if key == word] for word in WORDS}
    wrong = [word for word, _ in fields if word not in WORDS]
    wrong += [word for word, least in WORDS.items() if len(found[word]) < least or (word not in ("number", "varied") and len(found[word]) > 1)]
    if wrong:
        stop(f"{path}: lines of {', '.join(sorted(set(wrong)))}: missing, too many, or not known")
    numbers = tuple(Number(part["name"], float(part["value"]), part["unit"], part["meaning"])
                    for part in (match_of(NUMBER, text, path) for text in found["number"]))
    varied = tuple(Varied(part["key"], value_of(part["values"]), part["meaning"])
                   for part in (match_of(VARIED, text, path) for text in found["varied"]))
    texts = {word: texts[0] for word, texts in found.items() if texts and word not in ("number", "varied")}
    return Bearing(path, title, texts, numbers, varied, float(match_of(EXPECTED, texts["expected"], path)["factor"]))


def read_head(path):
    """Title and (word, text) of the comments with which a case file begins."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("!"):
            break
        lines.append(line)
    fields = []
    for line in lines[1:]:
        begins, goes_on = re.fullmatch(r"! (\w+): (.+)", line), re.fullmatch(r"!   (.+)", line)
        if begins:
            fields.append([begins[1], begins[2]])
        elif goes_on and fields:
            fields[-1][1] += " " + goes_on[1]
        elif line != "!":
            stop(f"{path}: not of the form `! word: text`: {line}")
    return lines[0].removeprefix("! "), fields


def match_of(form, text, path):
    """The parts of a line of that form."""
    found = form.fullmatch(text)
    if found is None:
        stop(f"{path}: not of its form: {text}")
    return found


def value_of(words):
    """One value of a namelist, or several between blanks."""
    values = [python_value(word)[1] for word in words.split()]
    return values[0] if len(values) == 1 else tuple(values)


def corpus():
    """All bearings, by name."""
    return [read_bearing(path) for path in sorted(FOLDER.glob("*.nml"))]


# --- runs ---

def answer_of(gfb, bearing, folder, varied=None):
    """What gfb says of a bearing, or of it with a key varied; None where there is no equilibrium."""
    path = bearing.path
    if varied:
        case = Case.read(path)
        case[varied.key] = varied.value
        if varied.key == "model%foil":
            case.groups["model"] = {"foil": varied.value}  # the other keys are another foil's
        path = case.write(pathlib.Path(folder)/path.name)
    answer = run_file(gfb, path, folder, options=("--quiet",), seconds=SECONDS)
    if answer.status not in ((0, 2) if varied else (0,)):
        stop(f"{path}: gfb ended with status {answer.status}:\n{answer.log}{answer.complaint}", 3)
    return answer if answer.status == 0 else None


def is_in_order(gfb, bearing):
    """Whether `gfb --check` takes the case file."""
    return call([gfb, "--check", bearing.path], SECONDS).status == 0


def is_as_expected(bearing, number, value):
    """Whether an answer is as near to the published number as was expected."""
    return 1.0/bearing.factor <= value/number.value <= bearing.factor


# --- the page ---

def readable(value, unit):
    """A number with three digits in the unit that people read, or that there is none."""
    if value is None:
        return "none"
    name, factor = readable_unit(unit)
    return f"{float(f'{value*factor:.3g}'):g} {name}"


def row_of(bearing, number, value):
    """A line of the first table."""
    source = bearing.words["source"].partition(";")[0]
    judged = "as expected" if is_as_expected(bearing, number, value) else "differs"
    return [f"[{bearing.path.stem}](#{bearing.path.stem})", source, f"`{number.name}`", readable(number.value, number.unit),
            readable(value, number.unit), f"{value/number.value:.2f}", judged]


HEADS = ["bearing", "source", "result", "published", "gfb", "gfb over published", "judged"]


def section_of(bearing, answer, others):
    """What was published and assumed of a bearing, and what its answer becomes where that is varied."""
    items = [f"**Source:** {bearing.words['source']}.", f"**Published:** {bearing.words['published']}."]
    items += [f"**Compared:** `{number.name}` {readable(number.value, number.unit)}, {number.meaning}." for number in bearing.numbers]
    items += [f"**{word.capitalize()}:** {bearing.words[word]}." for word in ("assumed", "expected", "differs", "more") if word in bearing.words]
    text = f"\n## {bearing.path.stem}\n\n{bearing.title}: [case file](../../inputs/bearings/{bearing.path.name}).\n\n"
    text += "".join(textwrap.fill(item, 138, initial_indent="- ", subsequent_indent="  ", break_on_hyphens=False, break_long_words=False) + "\n"
                    for item in items)
    rows = [["", "as in the case file", *(readable(answer.summary[number.name], number.unit) for number in bearing.numbers)]]
    rows += [[f"`{one.key}`", one.meaning, *(readable(other and other.summary[number.name], number.unit) for number in bearing.numbers)]
             for one, other in zip(bearing.varied, others)]
    return text + "\n" + markdown_table("", ["varied", "assumes", *(f"`{number.name}`" for number in bearing.numbers)], rows)


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--docs", action="store_true", help="write docs/measured/bearings.md")


def run(options):
    """Runs the corpus; the first table, and the page where that is asked for."""
    rows, sections, parts = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for bearing in corpus():
            answer = answer_of(options.gfb, bearing, folder)
            others = [answer_of(options.gfb, bearing, folder, one) for one in bearing.varied]
            rows += [row_of(bearing, number, answer.summary[number.name]) for number in bearing.numbers]
            sections.append(section_of(bearing, answer, others))
            parts += [answer.summary[number.name]/number.value for number in bearing.numbers if number.name == "mean_pressure"]
            print(f"{bearing.path.stem}:", *rows[-1][3:], flush=True)
    if options.docs:
        PAGE.write_text(HEAD + "\n" + markdown_table("", HEADS, rows) + "".join(sections) + SAID.format(least=min(parts), most=max(parts)),
                        encoding="utf-8")
    return plain_table("published bearings", HEADS, rows)
