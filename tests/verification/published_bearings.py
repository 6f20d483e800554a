#!/usr/bin/env python3
"""Published bearings, inputs/bearings/: each case file is in order and has an answer, which is what docs/measured/bearings.md states.

Where the answer is within the factor that the case file expects, that is claimed; where it is not, the case file must say that it differs,
and nothing is claimed of the answer's size.
"""

import pathlib
import re
import sys
import tempfile

from gfb_run import GFB, Checks

from gfb.bench.bearings import FOLDER, PAGE, answer_of, corpus, is_as_expected, is_in_order, read_bearing, readable, row_of
from gfb.tool import ROOT

REFERENCES = ROOT/"docs/manual/references.md"
DIGITS = 0.006  # the page has three of them: half of the last one of 1.00, and a little
LEAST = 14      # cases: the corpus is there
SLOW = {"bruckner2008_pressure", "dellacorte2008_journal", "heshmat1982_journal", "nasa2009_rule", "swanson2000_large"}  # 5 s and more


def check_bearing(checks, bearing, page, folder):
    """A case file: its form, its answer, the page's lines of it."""
    name = bearing.path.stem
    checks.that(f"{name}: in order", is_in_order(GFB, bearing))
    summary = answer_of(GFB, bearing, folder).summary
    near = [is_as_expected(bearing, number, summary[number.name]) for number in bearing.numbers]
    checks.that(f"{name}: within a factor of {bearing.factor:g}, or the file says that it differs", all(near) != ("differs" in bearing.words))
    for number in bearing.numbers:
        value = summary[number.name]
        print(f"       {name}: {number.name} {value:.5g} {number.unit}, published {number.value:.5g}, over it {value/number.value:.3f}")
        stated = stated_in(page, bearing, number)
        checks.below(f"{name}: {number.name} as the page states it", abs(value/stated["gfb"] - 1.0), DIGITS)
        checks.that(f"{name}: {number.name} judged as on the page", row_of(bearing, number, value)[-1] == stated["judged"])
        checks.that(f"{name}: {number.name} published as on the page", readable(number.value, number.unit) == stated["published"])


def stated_in(page, bearing, number):
    """The line of the page's first table, its answer in SI units."""
    head = f"| [{bearing.path.stem}](#{bearing.path.stem}) |"
    line, = (line for line in page.splitlines() if line.startswith(head) and f"`{number.name}`" in line)
    _, _, _, published, answer, _, judged = (cell.strip() for cell in line.strip("| ").split("|"))
    size, _, unit = answer.partition(" ")
    factor = float(readable(1.0, number.unit).partition(" ")[0])
    assert unit == readable(1.0, number.unit).partition(" ")[2], line
    return {"published": published, "gfb": float(size)/factor, "judged": judged}


def refused(folder, text):
    """Whether a case file with other first lines is refused."""
    path = folder/"wrong.nml"
    path.write_text(text, encoding="utf-8")
    try:
        read_bearing(path)
    except SystemExit:
        return True
    return False


def check_form(checks, folder):
    """A case file without its source, with a number that is none, or with a line of no known word is refused."""
    path = next(iter(sorted(FOLDER.glob("*.nml"))))
    text = path.read_text(encoding="utf-8")
    checks.that("as it is: taken", not refused(folder, text))
    checks.that("without a source: refused", refused(folder, re.sub(r"^! source: .*\n", "", text, flags=re.MULTILINE)))
    checks.that("a published number without a value: refused", refused(folder, re.sub(r"(?<=^! number: )\w+ = \S+", "none", text, flags=re.MULTILINE)))
    checks.that("a word that is not known: refused", refused(folder, text.replace("! source:", "! origin: somewhere\n! source:", 1)))
    checks.that("expected by words alone: refused", refused(folder, text.replace("within a factor of", "about")))


def check_page(checks, bearings, page):
    """The page has a line for every number, and the sources are known."""
    references = REFERENCES.read_text(encoding="utf-8")
    checks.that(f"{len(bearings)} cases, {LEAST} at least", len(bearings) >= LEAST)
    checks.that("the page has a line for each number, and no other",
                page.count("| as expected |\n") + page.count("| differs |\n") == sum(len(bearing.numbers) for bearing in bearings))
    cited = {word for bearing in bearings for word in re.findall(r"\[\w+\d{4}\]", " ".join(bearing.words.values()))}
    checks.that(f"sources are in references.md {[word for word in cited if f'- {word} ' not in references]}",
                all(f"- {word} " in references for word in cited))


def main():
    checks = Checks()
    bearings, asked_long = corpus(), "--long" in sys.argv[1:]
    page = PAGE.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        if not asked_long:
            check_page(checks, bearings, page)
            check_form(checks, folder)
        for bearing in bearings:
            if (bearing.path.stem in SLOW) == asked_long:
                check_bearing(checks, bearing, page, folder)
    checks.close()


if __name__ == "__main__":
    main()
