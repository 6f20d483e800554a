"""Tests of tools/bench profile on made-up figures: ratios, what differs, the page, and what --before may be."""

import os
import pathlib
import sys
import types
import unittest

sys.path.insert(0, str(pathlib.Path(os.environ["GFB_SOURCE"])/"tools"))

from gfb.bench import profile as bench_profile  # noqa: E402 (found only now)
from gfb.bench.runs import PARTS  # noqa: E402
from gfb.build import program_of  # noqa: E402


def row(factorization, peak, **summary):
    """A measured row with one rank."""
    figures = {"unknowns": 1000.0, "newton_iterations": 30.0, "factorizations": 28.0, "peak_memory": 2.0**30,
               "converged": "yes", "maximum_pressure": peak, "force_x": 1e-14*peak, "torque_x": 0.0}
    parts = dict.fromkeys(PARTS, 0.01) | {"factorization": factorization}
    return {"stopped": "", "cpu": sum(parts.values()), "parts": [parts], "summary": figures | summary}


MEASURED = {"a job": {"before": [row(4.0, 2.0e5), row(3.0, 2.0e5)], "after": [row(1.5, 2.0e5*(1.0 + 1.0e-10))]}}


class Profile(unittest.TestCase):
    """What the tables and the page say."""

    def test_times(self):
        lines = {line[1]: line for line in bench_profile.time_table(MEASURED)[2]}
        self.assertEqual(lines["factorization"][2:5], ["3.000", "1.500", "2.00"])
        self.assertEqual(lines["solve"][4], "")  # too short for a ratio
        self.assertEqual(lines["whole"][2:5], ["3.060", "1.560", "1.96"])

    def test_answers(self):
        self.assertAlmostEqual(bench_profile.difference(row(1, 3.0)["summary"], row(2, 3.3)["summary"]), 0.1)
        self.assertEqual(bench_profile.difference(row(1, 3.0)["summary"], row(1, 3.0, force_x=9.0)["summary"]), 0.0)
        self.assertEqual(bench_profile.work_table(MEASURED)[2][0][-1], "1e-10")

    def test_page(self):
        tables = [bench_profile.time_table(MEASURED), bench_profile.work_table(MEASURED)]
        page = bench_profile.page(MEASURED, tables, types.SimpleNamespace(repetitions=1), ("gfb 1", "gfb 2"))
        self.assertIn("**a job**: 1.96 times less CPU time; most of what changed is in factorization", page)
        self.assertIn("Now most goes to factorization (96 %)", page)

    def test_before(self):
        self.assertEqual(program_of(__file__, "--before"), os.path.abspath(__file__))
        with self.assertRaises(SystemExit):
            program_of("no/such/revision", "--before")


if __name__ == "__main__":
    unittest.main()
