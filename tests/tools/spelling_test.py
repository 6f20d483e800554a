#!/usr/bin/env python3
"""Spelling of README, changelog and docs/ by hunspell's British dictionary; words.txt has the field's own words, one a line."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
PAGES = [*sorted(PROJECT.glob("*.md")), *sorted((PROJECT/"docs").rglob("*.md"))]
OWN = pathlib.Path(__file__).with_name("words.txt")
# Blocks, code, targets of links, equations, addresses, [Author2020], and what holds digits, dots or the like within.
NO_WORDS = re.compile(r"^ *```.*?^ *```$|`[^`\n]*`|\]\([^)]*\)|\$\$.*?\$\$|\$[^$\n]*\$|<[^>\n]*>|https?://\S+|\[\w+\d{4}\]"
                      r"|\b[\w/.*%\\-]*[_\d=/\\%&*]\w[\w.%=/-]*|\w+\.\w{1,7}\b", re.MULTILINE | re.DOTALL)


def words_of(text):
    """The words of a page's sentences."""
    return {word.strip("'") for word in re.findall(r"\b[A-Za-z][A-Za-z']+\b", NO_WORDS.sub(" ", text))}


def unknown(words):
    """Those of them that no dictionary has."""
    own = set(OWN.read_text(encoding="utf-8").casefold().split())
    left = [word for word in foreign(words) if re.sub("'s$", "", word).casefold() not in own]
    # Some releases of the dictionary have -ise alone.
    other = {word: re.sub(r"iz(?=e|i|at)", "is", word) for word in left}
    wrong = foreign(other.values())
    return sorted(word for word in left if other[word] in wrong)


def foreign(words):
    """Those of them that hunspell's British dictionary does not have."""
    return set(subprocess.run(["hunspell", "-d", "en_GB", "-l"], input="\n".join(sorted(words)), capture_output=True, text=True,
                              check=True).stdout.split())


def has_dictionary():
    """Whether hunspell and its British dictionary are here."""
    return shutil.which("hunspell") and subprocess.run(["hunspell", "-d", "en_GB", "-l"], input="", capture_output=True, text=True,
                                                       check=False).returncode == 0


@unittest.skipUnless(has_dictionary(), "hunspell and its British dictionary are not installed (hunspell, hunspell-en-gb)")
class Spelling(unittest.TestCase):
    def test_the_checker_itself(self):
        text = "A foill's film, `nocode` [a](b/targt.md) 3.5xyz\n```\nblokk\n```\n[Gu2020] a_b tools/xyzz."
        self.assertEqual(unknown(words_of(text)), ["foill's"])
        self.assertEqual(unknown({"linearize", "factorization", "factorizzation", "optimizes"}), ["factorizzation"])

    def test_every_page(self):
        found = {page: words_of(page.read_text(encoding="utf-8")) for page in PAGES}
        wrong = unknown(set().union(*found.values()))
        self.assertEqual([(page.name, word) for page, words in found.items() for word in wrong if word in words], [],
                         f"misspelt, or missing in {OWN.name}")


if __name__ == "__main__":
    unittest.main()
