#!/usr/bin/env python3
"""Every command of the README and the manual: those that can are run, page by page, in one folder with coarse inputs.

A block of commands begins with ```sh. Above one that is not run stands why, `<!-- not run: hours -->`; of those, and of
the pages of docs/measured and docs/developer, the tools must be there and their options in the tools' help. Python blocks
are run, too, where what they import is installed.

commands_test.py Marks   what is not run      commands_test.py Runs [-k PAGE]   what is run
"""

import importlib.util
import os
import pathlib
import re
import shutil
import shlex
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
sys.path.insert(0, str(PROJECT/"tests/verification"))
from every_input import COARSER, FILM, SHELLS, STRIP, changed  # noqa: E402 (found only now)

PROGRAM = pathlib.Path(os.environ["GFB"])
FIRST = ("README.md", "docs/manual/first_steps.md")
PAGES = [PROJECT/name for name in FIRST] + [path for path in sorted((PROJECT/"docs/manual").glob("*.md")) if path.name != "first_steps.md"]
OTHERS = [PROJECT/"CONTRIBUTING.md", *sorted((PROJECT/"docs/developer").glob("*.md")), *sorted((PROJECT/"docs/measured").rglob("*.md"))]
BLOCK = re.compile(r"(?:^<!-- not run: ([^\n]+) -->\n)?^```(\w*)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^(?:tools/\w+(?: |$)|(?:gfb|mpiexec|cmake|cpack|apt-get|pip|sed|export|module|srun|for|\./configure|\(cd) )", re.MULTILINE)
COMPUTED = re.compile(r"results/(\w+)/")
# Coarser than in COARSER must not be what a page names steps of, draws a map of, or fits matrices to.
OF_PAGES = ((r"gu2020_strip_case2_.*", STRIP), (r"gu2020_dynamics_beam", SHELLS), (r"stability_map", {"mesh": {"axial_elements": 8}}),
            (r"gu2020_dynamics_foundation", FILM), (r"gu2020_foundation|foundation_.*", FILM),
            (r"three_pads_shell|engineer_thickness", {"mesh": {"axial_elements": 4}}), *COARSER)
SECONDS = 300  # for a block


def blocks(page):
    """(why it is not run, language, text, line) of every block of a page."""
    text = page.read_text(encoding="utf-8")
    return [(why, language, body, text.count("\n", 0, found.start()) + 1)
            for found in BLOCK.finditer(text) for why, language, body in [found.groups()]]


def calls(text):
    """The words of every call of a tool of ours in a block, without comments."""
    joined = text.replace("\\\n", " ")
    found = (shlex.split(line, comments=True) for line in re.findall(r"^ *(tools/\w+.*)$", joined, re.MULTILINE))
    return [words[:next((n for n, word in enumerate(words) if word in (">", "|", ";")), len(words))] for words in found]


def said(command, **options):
    """What a command prints."""
    return subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True, **options).stdout


class Marks(unittest.TestCase):
    """What is run and what not."""

    def test_every_block_of_commands_is_marked(self):
        for page in PAGES:
            for _, language, body, line in blocks(page):
                if not language:
                    self.assertIsNone(COMMAND.search(body), f"{page}:{line}: commands in a block without sh")

    def test_the_checker_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder)/"page.md"
            page.write_text("<!-- not run: hours -->\n```sh\ntools/a --b # c\n```\n\n```\ntext\n```\n", encoding="utf-8")
            self.assertEqual(blocks(page), [("hours", "sh", "tools/a --b # c\n", 1), (None, "", "text\n", 6)])
        self.assertEqual(calls("tools/a --b \\\n  --c d  # e\ntools/f > g"), [["tools/a", "--b", "--c", "d"], ["tools/f"]])

    def test_tools_and_options_of_what_is_not_run(self):
        bodies = [(page, line, body) for page in PAGES + OTHERS for why, language, body, line in blocks(page)
                  if why or (page in OTHERS and language in ("", "sh"))]
        helps, seen = {}, 0
        for page, line, body in bodies:
            for words in calls(body):
                tool = PROJECT/words[0]
                if not tool.is_file():
                    self.assertTrue(tool.is_dir(), f"{page}:{line}: {words[0]} is not there")
                    continue
                named = [words[1]] if words[0] == "tools/bench" and len(words) > 1 and words[1][0] != "-" else []
                key = (words[0], *named)
                if key not in helps:
                    helps[key] = said([tool, *named, "--help"]) + (said([PROGRAM, "--help"]) if words[0] == "tools/run" else "")
                for option in (word.partition("=")[0] for word in words[1:] if word.startswith("--")):
                    self.assertIn(option, helps[key], f"{page}:{line}: {' '.join(words)}")
                    seen += 1
        self.assertGreater(seen, 10)


@unittest.skipUnless(PROGRAM == PROJECT/"build/release/gfb", "tools/run builds another program than the one tested here")
class Runs(unittest.TestCase):
    """Every page from its first command to its last; results of the pages before are there."""

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        for name in ("inputs", "docs/manual", "home", "bin"):
            (cls.folder/name).mkdir(parents=True)
        (cls.folder/"tools").symlink_to(PROJECT/"tools")
        (cls.folder/"bin/gfb").symlink_to(PROGRAM)
        for path in (PROJECT/"inputs").glob("*.nml"):
            changes = next((changes for pattern, changes in OF_PAGES if re.fullmatch(pattern, path.stem)), {})
            (cls.folder/"inputs"/path.name).write_text(changed(path.read_text(encoding="utf-8"), changes), encoding="utf-8")
        shutil.copytree(PROJECT/"inputs/machines", cls.folder/"inputs/machines")
        # What a page calls CASE is any case of one's own: here a sweep on springs, small enough for eight ranks.
        sweep = (cls.folder/"inputs/foundation_tilt_sweep.nml").read_text(encoding="utf-8")
        for name in ("CASE", "CASE1", "CASE2"):
            (cls.folder/f"{name}.nml").write_text(sweep, encoding="utf-8")
        cls.environment = {**os.environ, "PATH": f"{cls.folder/'bin'}:{os.environ['PATH']}", "HOME": str(cls.folder/"home"),
                           "GFB_INSTALL": "no", "MPLBACKEND": "Agg", "PYTHONPATH": str(PROJECT/"tools")}

    def call(self, command, where):
        """Runs a command in the folder; a failure tells what it printed."""
        done = subprocess.run(command, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, timeout=SECONDS)
        self.assertEqual(done.returncode, 0, f"{where}: {done.stdout[-2000:]}")

    def prepare(self, body, where):
        """Runs the inputs whose results a block reads and does not make."""
        for name in dict.fromkeys(COMPUTED.findall(body)):
            case = self.folder/"inputs"/f"{name}.nml"
            if case.exists() and not (self.folder/"results"/name).exists() and f"inputs/{name}.nml" not in body:
                self.call(["tools/run", f"inputs/{name}.nml"], f"{where}: before it")

    def run_page(self, page):
        python = ""
        for why, language, body, line in blocks(page):
            where = f"{page.relative_to(PROJECT)}:{line}"
            if why or language not in ("sh", "python"):
                continue
            if language == "sh":
                self.prepare(body, where)
                self.call(["bash", "-euo", "pipefail", "-c", body], where)
                continue
            imported = set(re.findall(r"^ *(?:import|from) (\w+)", body, re.MULTILINE))
            imported |= {name for names in re.findall(r"^ *import (.*)$", body, re.MULTILINE) for name in names.split(", ")}
            missing = sorted(name for name in imported if name != "gfb" and not importlib.util.find_spec(name.split(" ")[0].split(".")[0]))
            if missing:
                print(f"{where}: not run, {', '.join(missing)} not installed")
                continue
            self.prepare(body, where)
            python += body  # a block goes on where the one before ended
            self.call([sys.executable, "-c", python], where)


def add_pages():
    """A test a page, in the order of reading."""
    for number, page in enumerate(PAGES):
        setattr(Runs, f"test_{number:02d}_{page.stem}", lambda self, page=page: self.run_page(page))


add_pages()
if __name__ == "__main__":
    unittest.main()
