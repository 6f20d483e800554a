#!/usr/bin/env python3
"""Tests of tools/mutants: what is drawn of a small module. Building and killing are tried by whoever calls it."""

import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ.get("GFB_SOURCE", pathlib.Path(__file__).parents[2]))
LOADER = importlib.machinery.SourceFileLoader("mutants", str(PROJECT/"tools/mutants"))
mutants = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutants", LOADER))
LOADER.exec_module(mutants)

MODULE = """module gfb_gap
  implicit none
  real(wp), parameter :: half = 0.5_wp
contains
  !> C + e cos(theta) - a text
  pure subroutine set_gap(clearance, &
                          gap)
    real(wp), intent(in) :: clearance(2 + 1)
    real(wp), intent(out) :: gap !! a + b
    character(9) :: word = 'a + b'
    gap = clearance(1) + clearance(i + 1) ! a - b
    if (gap < 0.0_wp .and. word == 'a - b') call warn('a - b')
    gap = gap*clearance(2) &
      - 0.25_wp
    PetscCallA(VecSet(gap - 1, ierr))
    if (allocated(gap)) call destroy_gap(gap + 1)
    words = 'gap'//text(gap - 1)
    self%reason%detail = text(gap*2.0_wp)
    call context%log%line(text(gap + 1))
    if (gap > 1.0_wp) call report%ending%add_words(text(gap - 1), 'b')
    call show_gap(gap + 1)
    call leave_stage()
  end subroutine set_gap
end module gfb_gap
"""
EXPECTED = {
    (11, "sign", "gap = clearance(1) - clearance(i + 1) ! a - b"),
    (11, "sign", "gap = clearance(1) + clearance(i - 1) ! a - b"),
    (11, "index", "gap = clearance(1) + clearance(i) ! a - b"),
    (12, "comparison", "if (gap >= 0.0_wp .and. word == 'a - b') call warn('a - b')"),
    (12, "comparison", "if (gap < 0.0_wp .and. word /= 'a - b') call warn('a - b')"),
    (12, "condition", "if (gap < 0.0_wp .or. word == 'a - b') call warn('a - b')"),
    (12, "factor", "if (gap < (1.5_wp*0.0_wp + 0.1_wp) .and. word == 'a - b') call warn('a - b')"),
    (12, "call", "continue ! if (gap < 0.0_wp .and. word == 'a - b') call warn('a - b')"),
    (13, "factor", "gap = gap/clearance(2) &"),
    (14, "factor", "- (1.5_wp*0.25_wp + 0.1_wp)"),
}


class Mutants(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.path = self.root/"src/model/gap.f90"
        self.path.parent.mkdir(parents=True)
        self.path.write_text(MODULE, encoding="utf-8")

    def test_one_statement_of_a_body_changes(self):
        """Neither declarations, heads, comments, texts, words of messages nor calls of PETSc do."""
        found = {(mutant.line, mutant.kind, mutant.after.strip()) for mutant in mutants.mutants_of(self.path, self.root)}
        self.assertEqual(found, EXPECTED)

    def test_a_seed_draws_the_same(self):
        self.assertEqual(mutants.draw([self.path], 4, 3, self.root), mutants.draw([self.path.parent], 4, 3, self.root))
        self.assertNotEqual(mutants.draw([self.path], 4, 3, self.root), mutants.draw([self.path], 4, 4, self.root))
        self.assertEqual(mutants.unit_of(pathlib.Path("src/model/bearing/pad.F90")), "unit_model_bearing")

    def test_every_folder_has_tests(self):
        """A folder whose mutants nothing would be run for ends the whole draw; src/bench is no part of the program."""
        for folder in {path.parent for path in (PROJECT/"src").glob("*/**/*.[fF]90")} - {PROJECT/"src/bench"}:
            unit = mutants.unit_of((folder/"a.f90").relative_to(PROJECT))
            tests = [path.parent for path in (PROJECT/"tests/unit").rglob("*_test.pf")]
            self.assertIn(unit, {"unit_" + "_".join(path.relative_to(PROJECT/"tests/unit").parts) for path in tests})

    def test_only_sources_are_changed(self):
        done = subprocess.run([sys.executable, PROJECT/"tools/mutants", "--list", PROJECT/"tests"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("no file or folder of", done.stderr)
        for mutant in mutants.draw([PROJECT/"src/formulas"], 100, 1):
            self.assertNotEqual(mutant.before, mutant.after, mutant)
            self.assertEqual((PROJECT/mutant.path).read_text(encoding="utf-8").splitlines()[mutant.line - 1], mutant.before)


if __name__ == "__main__":
    unittest.main()
