#!/usr/bin/env python3
"""docs/manual/no_answer.md: every sentence of it is the program's, and every reason of the solvers is in it."""

import os
import pathlib
import re
import unittest

PROJECT = pathlib.Path(os.environ.get("GFB_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
SHORTEST = 12  # characters of a piece of a sentence that says something


def flat(text):
    """Fortran text with the literals of continued lines in one piece."""
    text = re.sub(r"'\s*//\s*&\s*\n\s*&?\s*'", "", text)
    return text.replace("''", "'")


class NoAnswer(unittest.TestCase):
    def setUp(self):
        files = [path for folder in ("solver", "study", "program") for path in (PROJECT/"src"/folder).rglob("*.?90")]
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


if __name__ == "__main__":
    unittest.main()
