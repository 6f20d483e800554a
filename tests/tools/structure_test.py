#!/usr/bin/env python3
"""Tests of tools/structure on small trees made here: what is counted, and that a passed limit fails."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(os.environ.get("GFB_SOURCE", pathlib.Path(__file__).parents[2]))/"tools/structure"
KINDS = "module gfb_kinds\n  implicit none\nend module gfb_kinds\n"
GAP = """module gfb_gap
  use gfb_kinds, only: wp
  implicit none
  private
  public :: gap
contains
  pure function gap(angle, clearance, &
                    tilt) result(h)
    real(wp), intent(in) :: angle !! theta [rad]
    !> C [m]
    real(wp), intent(in) :: clearance
    real(wp), intent(in) :: tilt(2)
    real(wp) :: h
    h = clearance*cos(angle)
  end function gap
  pure function inner(unexplained) result(h)
    real(wp), intent(in) :: unexplained
    real(wp) :: h
    h = unexplained
  end function inner
end module gfb_gap
"""
TEST = "module gap_test\n  use gfb_kinds, only: wp\n  use gfb_gap, only: gap\nend module gap_test\n"
FOIL = """module gfb_asks
  use gfb_gap, only: gap
contains
  subroutine ask(bearing)
    select type (foil => bearing%foil)
    end select
  end subroutine ask
end module gfb_asks
"""


class Structure(unittest.TestCase):
    """The tool on sources of three modules."""

    def run_tool(self, *options, files=None, test=TEST):
        """Output and exit status."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (files or {"base/kinds.f90": KINDS, "film/gap.f90": GAP}).items():
                path = pathlib.Path(folder, "src", name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            pathlib.Path(folder, "tests/unit/film").mkdir(parents=True)
            pathlib.Path(folder, "tests/unit/film/gap_test.pf").write_text(test)
            run = subprocess.run([sys.executable, TOOL, "--sources", f"{folder}/src", *options],
                                 capture_output=True, text=True, check=False)
        return run.stdout + run.stderr, run.returncode

    def test_comments_of_public_procedures_are_counted(self):
        words, _ = self.run_tool()
        self.assertIn("dummy arguments with a comment: 66.7 %, of 3", words)
        self.assertIn("real dummy arguments with a unit: 66.7 %", words)

    def test_what_is_missing_is_named(self):
        words, _ = self.run_tool("--missing")
        self.assertEqual(words.strip(), "src/film/gap.f90:7: gap: tilt has no comment")

    def test_a_passed_limit_fails(self):
        self.assertEqual(self.run_tool("--check")[1], 0)
        long = GAP.replace("    h = unexplained\n", "    h = unexplained\n"*78)
        words, status = self.run_tool("--check", files={"base/kinds.f90": KINDS, "film/gap.f90": long})
        self.assertIn("! lines of a procedure, at most: 82 (limit 80)", words)
        self.assertEqual(status, 1)

    def test_a_variable_of_a_module_is_seen(self):
        kept = GAP.replace("contains\n", "  real(wp), parameter :: half = 0.5_wp\n  real(wp), save :: last = 0.0_wp !! a state\ncontains\n", 1)
        words, status = self.run_tool("--check", files={"base/kinds.f90": KINDS, "film/gap.f90": kept})
        self.assertIn("! variables of modules: 1 (limit 0), gap.f90:7", words)
        self.assertEqual(status, 1)

    def test_circles_and_calls_upwards_are_seen(self):
        circle = {"base/kinds.f90": KINDS.replace("implicit none", "use gfb_size, only: size_of\n  implicit none"), "film/gap.f90": GAP,
                  "film/size.f90": "module gfb_size\nend module gfb_size\n"}
        words, status = self.run_tool("--check", files=circle)
        self.assertIn("! circles of folders: 2 (limit 0), base, film", words)
        self.assertEqual(status, 1)
        layers = "gfb_layer(base NEEDS LAPACK::LAPACK)\ngfb_layer(film USES base NEEDS gfb::petsc)\n"
        words, _ = self.run_tool(files={**circle, "../CMakeLists.txt": layers})
        self.assertIn("! uses of a folder that is not below: 1 (limit 0), base of film", words)

    def test_a_module_of_two_parts_is_seen(self):
        part = "  subroutine {0}()\n" + "    print *, '{0}'\n"*60 + "  end subroutine {0}\n"
        glued = "module gfb_both\ncontains\n" + part.format("one") + part.format("other") + "end module gfb_both\n"
        self.assertIn("modules glued of parts: 1 (limit 6), both.f90", self.run_tool(files={"film/both.f90": glued})[0])
        joined = glued.replace("print *, 'one'", "call other()", 1)
        self.assertIn("modules glued of parts: 0 (limit 6)", self.run_tool(files={"film/both.f90": joined})[0])

    def test_what_passes_the_blocks_of_a_bearing_by_is_seen(self):
        block = "module gfb_walls\ncontains\n  subroutine create(block)\n    block%add_gap => grow\n  end subroutine create\n" \
                "  subroutine grow()\n    print *, pad%gap(1)\n  end subroutine grow\nend module gfb_walls\n"
        words, status = self.run_tool("--check", files={"film/walls.f90": block, "film/bearing.F90": block.replace("gfb_walls", "gfb_bearing")})
        self.assertIn("! calls past the blocks of a bearing: 1 (limit 0), walls.f90:7", words)
        self.assertEqual(status, 1)
        user = "module gfb_user\n  use gfb_walls, only: grow\nend module gfb_user\n"
        words = self.run_tool(files={"film/walls.f90": block.replace("pad%gap", "bearing%gap"), "film/user.f90": user})[0]
        self.assertIn("! calls past the blocks of a bearing: 1 (limit 0), user.f90: grow", words)
        words = self.run_tool(files={"film/walls.f90": block.replace("pad%gap", "bearing%gap"), "film/user.f90": user.replace("grow", "create")})[0]
        self.assertIn("  calls past the blocks of a bearing: 0 (limit 0)", words)

    def test_public_names_that_only_tests_use_are_named(self):
        self.assertEqual(self.run_tool("--for-tests")[0].strip(), "src/film/gap.f90: gap")
        self.assertEqual(self.run_tool("--for-tests", files={"base/kinds.f90": KINDS, "film/gap.f90": GAP, "run/asks.f90": FOIL})[0], "")

    def test_a_choice_is_one_name_and_goes_with_the_values_that_others_use(self):
        choice = GAP.replace("public :: gap", "public :: gap\n  integer, parameter, public :: open = 1, closed = 2\n"
                                              "  integer, parameter, public :: worn = 3")
        asked = TEST.replace("only: gap", "only: gap, open, worn")
        self.assertNotEqual((choice, asked), (GAP, TEST))
        words = self.run_tool("--for-tests", files={"base/kinds.f90": KINDS, "film/gap.f90": choice, "run/asks.f90": FOIL}, test=asked)[0]
        self.assertEqual(words.strip(), "src/film/gap.f90: open")
        user = FOIL.replace("only: gap", "only: gap, closed")
        self.assertNotEqual(user, FOIL)
        self.assertEqual(self.run_tool("--for-tests", files={"base/kinds.f90": KINDS, "film/gap.f90": choice, "run/asks.f90": user}, test=asked)[0], "")

    def test_a_type_goes_with_the_type_that_has_it(self):
        types = GAP.replace("public :: gap", "public :: gap\n  type, public :: edge_type\n    integer :: i = 0\n  end type edge_type\n"
                                             "  type, public :: pad_type\n    type(edge_type) :: edge\n  end type pad_type")
        asked = TEST.replace("only: gap", "only: gap, edge_type")
        self.assertEqual(self.run_tool("--for-tests", files={"base/kinds.f90": KINDS, "film/gap.f90": types, "run/asks.f90": FOIL}, test=asked)[0], "")

    def test_modules_without_a_unit_test_are_counted_and_named(self):
        one = TEST.replace("  use gfb_gap, only: gap\n", "")
        self.assertIn("! modules that a unit test names: 50.0 % (at least 92 %), 1 that none names", self.run_tool(test=one)[0])
        self.assertEqual(self.run_tool("--untested", test=one)[0].strip(), "src/film/gap.f90: gfb_gap")
        self.assertEqual(self.run_tool("--untested", "base", test=one)[0], "")
        self.assertIn("! modules that a unit test names: 0.0 %", self.run_tool(test="module gap_test\nend module gap_test\n")[0])

    def test_chains_and_types_of_foils_are_seen(self):
        words, _ = self.run_tool(files={"base/kinds.f90": KINDS, "film/gap.f90": GAP, "run/asks.f90": FOIL})
        self.assertIn("longest chain of use: 3\n", words)
        self.assertIn("select type on foil models outside src/model/foil: 1, asks.f90", words)

    def test_arrays_of_chance_size_are_seen(self):
        work = """module gfb_work
contains
  subroutine carry(self, other)
    real :: newest(size(self%free)), known(size(other%free))
    real, allocatable :: later(:)
    if (.not. self%present) return
  end subroutine carry
end module gfb_work
"""
        words, _ = self.run_tool(files={"base/work.f90": work})
        self.assertIn("arrays as large as what may not be there: 1, work.f90:6", words)
        words, _ = self.run_tool(files={"base/work.f90": work.replace("newest(size(self%free)), ", "")})
        self.assertIn("arrays as large as what may not be there: 0", words)


if __name__ == "__main__":
    unittest.main()
