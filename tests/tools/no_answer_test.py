#!/usr/bin/env python3
"""docs/manual/no_answer.md: every sentence of it is the program's, and every reason of the solvers is in it."""

import os
import pathlib
import re
import unittest

PROJECT = pathlib.Path(os.environ.get("GFB_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
SHORTEST = 12  # characters of a piece of a sentence that says something
# Where modes, growth, onset, orbits and marches over time are told of.
MOTIONS = ("study/bearing/dynamics.F90", "study/bearing/onset.F90", "solver/rotor", "solver/periodic", "study/periodic", "study/transient",
           "solver/time")
SAID = re.compile(r"(?:log%(?:line|warning)\(|\b(?:problem|reason|detail|ending|why|words) = )(.*)")
# What these files say where nothing is missing: answers, heads of tables, assumptions.
ANSWERS = ("contacts that slide to and fro, at", "amplitude [m]   Kxx", "heat: temperatures stay as they are", "contacts: closed ones stay closed",
           "losses: loss_factor acts", "losses: viscous ones of the foils", "frequency [rad/s] (over speed)", "axial mode of", "modes: frequency [rad/s]",
           "more die out in less than a turn", "frequencies put between the", "unstable, its", "least damped mode (", "the first point,", ", frequency ratio",
           ", largest multiplier", "periods marched, each in", "onset of whirl at", "restart: resumed from",
           "of them taken again shorter", "film and foils are stored at", "the orbit is steady", ", rotor and foil: the rotor has",
           "the number of steps", "of the shaft's axis at")
LITERAL = re.compile(r"'((?:[^']|'')*)'")


def flat(text):
    """Fortran text with the literals of continued lines in one piece."""
    text = re.sub(r"'\s*//\s*&\s*\n\s*&?\s*'", "", text)
    return text.replace("''", "'")


class NoAnswer(unittest.TestCase):
    def setUp(self):
        files = [path for folder in ("model", "solver", "study", "program") for path in (PROJECT/"src"/folder).rglob("*.?90")]
        self.sources = {path: flat(path.read_text(encoding="utf-8")) for path in files}
        self.page = (PROJECT/"docs/manual/no_answer.md").read_text(encoding="utf-8")

    def test_every_sentence_is_the_programs(self):
        rows = [line.split(" | ")[0] for line in self.page.splitlines() if line.startswith("| ") and "---" not in line]
        pieces = [piece for row in rows for piece in re.findall(r"`([^`]+)`", row)]
        said = "\n".join(self.sources.values())
        self.assertGreater(len(pieces), 35)
        self.assertEqual([piece for piece in pieces if piece not in said and "foundation_pressure" not in piece], [])

    def test_every_reason_is_in_the_page(self):
        missing = []
        for path, text in self.sources.items():
            if "solver" not in path.parts:
                continue
            found = re.findall(r"(?:path_lost\(|ending_type\(ending_\w+, |%why = )['\"](.+?)['\"](?:\s|//|$|,|\))", text)
            if path.name == "newton.F90":
                found += [words for words in re.findall(r"words = '(.+?)'", text) if not words.startswith("converged")]
            missing += [piece for piece in (one.strip() for one in found) if len(piece) >= SHORTEST and piece not in self.page
                        and not any(known in piece for known in re.findall(r"`([^`]+)`", self.page) if len(known) >= SHORTEST)]
        self.assertEqual(missing, [])


    def test_every_sentence_about_motions_is_in_the_page(self):
        """What is said of modes, growth, onset and orbits is an answer of the list above, or has its row."""
        known = [piece for piece in re.findall(r"`([^`]+)`", self.page) if len(piece) >= SHORTEST]
        missing, answers = [], set()
        for path in self.sources:
            if not any(str(path).startswith(str(PROJECT/"src"/place)) for place in MOTIONS):
                continue
            for pieces in sentences(path.read_text(encoding="utf-8")):
                found = [answer for answer in ANSWERS if pieces[0].startswith(answer)]
                answers.update(found)
                if not found and not any(piece in self.page or any(words in piece for words in known) for piece in pieces):
                    missing.append((path.name, pieces))
        self.assertEqual(missing, [])
        self.assertEqual(sorted(set(ANSWERS) - answers), [], "no longer said")

    def test_a_new_sentence_is_noticed(self):
        text = "call log%line('rotor: no mode is near '// &\n     text(x)//' of the speed')\nproblem = 'it''s lost for good'\nx = 'no sentence at all'\n"
        self.assertEqual(sentences(text), [["rotor: no mode is near", "of the speed"], ["it's lost for good"]])


def sentences(text):
    """What a file's statements say: of each statement its literals that are long enough, in one list."""
    joined = re.sub(r" *&\s*\n\s*&?", " ", text)
    said = ([piece.replace("''", "'") for piece in LITERAL.findall(re.sub(r"'\s*//\s*'", "", found[1]))]
            for line in joined.splitlines() if (found := SAID.search(line)))
    return [pieces for pieces in ([piece.strip() for piece in one if len(piece.strip()) >= SHORTEST] for one in said) if pieces]


if __name__ == "__main__":
    unittest.main()
