"""What the preprocessor of .pf files must refuse, and what it must write."""
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "pf_to_f90.py")
GOOD = """module one_test
  use funit
  implicit none (type, external)
contains
  @test
  subroutine first()
    @assertEqual(1, 1)
  end subroutine first
end module one_test
"""


class Preprocessor(unittest.TestCase):

    def translate(self, text, *options, what="module", name="one_test.pf"):
        """Exit status, error text and output of one run."""
        with tempfile.TemporaryDirectory() as folder:
            path, output = os.path.join(folder, name), os.path.join(folder, "out.f90")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            run = subprocess.run([sys.executable, SCRIPT, what, path, "--output", output, *options],
                                 stderr=subprocess.PIPE, text=True, check=False)
            written = ""
            if os.path.exists(output):
                with open(output, encoding="utf-8") as file:
                    written = file.read()
            return run.returncode, run.stderr, written

    def refused(self, text, line, words, *options, **keys):
        status, error, written = self.translate(text, *options, **keys)
        self.assertNotEqual(status, 0)
        self.assertIn(f"one_test.pf:{line}: error: ", error)
        self.assertIn(words, error)
        self.assertEqual(written, "")

    def test_lines_stay_where_they_were(self):
        status, _, written = self.translate(GOOD)
        self.assertEqual(status, 0)
        lines = written.splitlines()
        self.assertRegex(lines[0], r'^#line 1 ".*one_test.pf"$')
        self.assertEqual(len(lines), len(GOOD.splitlines()) + 1)
        self.assertEqual(lines[7].strip(),
                         "call assertEqual(1, 1, location=SourceLocation('one_test.pf', 7));"
                         " if (anyExceptions()) return")

    def test_unknown_annotation(self):
        self.refused(GOOD.replace("@test", "@testCase"), 5, "unknown annotation @testcase")

    def test_unknown_assert(self):
        self.refused(GOOD.replace("@assertEqual", "@assertEqal"), 7,
                     "unknown annotation @asserteqal")

    def test_unknown_argument_of_test(self):
        self.refused(GOOD.replace("@test", "@test(cases=[1])"), 5, "npes")

    def test_disable_before_test(self):
        self.refused(GOOD.replace("@test", "@disable\n  @test"), 5, "must follow @test")

    def test_annotation_without_subroutine(self):
        self.refused(GOOD.replace("subroutine first", "integer function first"), 6,
                     "expected the subroutine")

    def test_assert_of_all_ranks_without_npes(self):
        self.refused(GOOD.replace("@assertEqual", "@mpiAssertEqual"), 7, "needs a test with npes")

    def test_continued_assert(self):
        self.refused(GOOD.replace("(1, 1)", "(1, &\n 1)"), 7, "one line")

    def test_comment_after_assert(self):
        self.refused(GOOD.replace("(1, 1)", "(1, 1) ! why"), 7, "nothing may follow")

    def test_assert_in_a_helper(self):
        helper = ("  subroutine helper()\n    @assertTrue(.true.)\n  end subroutine helper\n"
                  "end module")
        self.refused(GOOD.replace("end module", helper), 10, "must stand in a @test")

    def test_module_named_unlike_its_file(self):
        self.refused(GOOD.replace("module one_test", "module two_test"), 1,
                     "must be named one_test")

    def test_private_module(self):
        self.refused(GOOD.replace("contains", "  private\ncontains"), 4, "public")

    def test_argument_without_npes(self):
        self.refused(GOOD.replace("first()", "first(this)"), 6, "only if, it has npes")

    def test_npes_without_argument(self):
        self.refused(GOOD.replace("@test", "@test(npes=[1])"), 6, "only if, it has npes")

    def test_file_without_tests(self):
        text = GOOD.replace("  @test\n", "").replace("    @assertEqual(1, 1)\n", "")
        self.refused(text, 7, "no @test")

    def test_two_tests_of_one_name(self):
        again = "  @test\n  subroutine FIRST()\n  end subroutine FIRST\nend module"
        self.refused(GOOD.replace("end module", again), 9, "second test named FIRST")

    def test_ranks_without_max_pes(self):
        text = GOOD.replace("@test", "@test(npes=[2])").replace("first()", "first(this)")
        self.refused(text, 5, "MAX_PES", "--name", "p", what="driver")

    def test_before_that_differs_from_its_tests(self):
        before = "  @before\n  subroutine prepare(this)\n  end subroutine prepare\nend module"
        self.refused(GOOD.replace("end module", before), 9, "arguments of every test")

    def test_driver_calls_every_test_and_names_it(self):
        status, _, written = self.translate(GOOD, "--name", "p", what="driver")
        self.assertEqual(status, 0)
        self.assertIn("use one_test, only: test_1_1 => first", written)
        self.assertIn("call run_plain_test(run, 'one_test.first', test_1_1)", written)


if __name__ == "__main__":
    unittest.main()
