#!/usr/bin/env python3
"""Completion of shells and the man page name every option of the program; bash completes them."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SHARE = pathlib.Path(os.environ["GFB_SOURCE"])/"share"


def complete(*words, folder):
    """What bash offers for the last word."""
    script = (f"source '{SHARE}/bash-completion/completions/gfb'; COMP_WORDS=({' '.join(map(repr, words))}); "
              f"COMP_CWORD={len(words) - 1}; _gfb; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True, cwd=folder)
    return done.stdout.split()


class ShellTest(unittest.TestCase):
    def test_every_option_is_there(self):
        said = subprocess.run([os.environ["GFB"], "--help"], capture_output=True, text=True, check=True).stdout
        options = re.findall(r"^  --([a-z][a-z-]+)", said, re.MULTILINE)
        self.assertGreater(len(options), 15)
        for path in (file for file in SHARE.rglob("*") if file.is_file()):
            text = path.read_text(encoding="utf-8").replace("\\-", "-")
            missing = [name for name in options if not re.search(rf"(--|-l ){name}\b", text) and (name, path.suffix) != ("petsc", ".fish")]
            self.assertEqual(missing, [], path)

    def test_bash_completes(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for file in ("one.nml", "two.txt"):
                (folder/file).touch()
            (folder/"there").mkdir()
            self.assertEqual(complete("gfb", "--ver", folder=folder), ["--verbose", "--version"])
            self.assertEqual(complete("gfb", "--template", "s", folder=folder), ["strip"])
            self.assertEqual(sorted(complete("gfb", "", folder=folder)), ["one.nml", "there"])
            self.assertEqual(complete("gfb", "--output", "", folder=folder), ["there"])
            self.assertEqual(complete("gfb", "--groups", "", folder=folder), [])


if __name__ == "__main__":
    unittest.main()
