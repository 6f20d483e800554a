"""Tests of tools/bench thermal on made-up runs: iterations after the isothermal answer, ratios, aims that are missed."""

import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(os.environ["GFB_SOURCE"])/"tools"))

from gfb.bench import thermal  # noqa: E402 (found only now)

LOG = """start: the smaller system's answer
    iteration    residual        step      length  factors
            0   1.485E-05
            1   3.094E-08   3.248E-03    1.000000   new

heat
    iteration    residual        step      length  factors
            0   7.117E-05
            1   1.046E-08   2.159E-02    1.000000   new
           10   2.120E-13   2.504E-06    0.500000   lagged

answer
------
    1   1.0   1.0   1.0   new
"""


class Run(dict):
    """Results, log and time."""

    def __init__(self, cpu, finest, log=LOG):
        super().__init__(factorizations_finest=finest, unknowns=10.0, shaft_temperature=303.15)
        self.cpu, self.log = cpu, log


class ThermalTest(unittest.TestCase):
    def test_iterations_are_those_behind_the_isothermal_answer(self):
        self.assertEqual(thermal.iterations_of_heat(LOG), (2, 2))
        finer = LOG.replace("\nanswer", "film 120 x 16\n    1   1.0   1.0   1.0   new\n\nanswer")
        self.assertEqual(thermal.iterations_of_heat(finer), (3, 1))

    def test_ratios_are_of_one_round_and_without_the_start(self):
        rounds = [[Run(1.1, 2.0), Run(2.1, 3.0)], [Run(2.1, 2.0), Run(4.1, 3.0)], [Run(1.1, 2.0), Run(9.1, 3.0)]]
        self.assertAlmostEqual(thermal.ratio(rounds, 0.1), 2.0)
        row = thermal.table_of({"rigid": rounds}, 0.1)[2][0]
        self.assertEqual(row, ["rigid", "10", "10", "1.00", "4.00", "2.00", "2", "2", "2", "3", "10.0"])

    def test_missed_aims_are_named(self):
        good, bad = [[Run(1.0, 2.0), Run(1.4, 4.0)]], [[Run(1.0, 2.0), Run(1.6, 5.0, LOG.replace("answer\n", LOG*3, 1))]]
        self.assertEqual(list(thermal.missed_aims({"shells": good, "rigid": bad}, 0.0)), [
            "rigid: 3 factorizations more on the finest mesh; the aim is 2"])
        self.assertEqual(list(thermal.missed_aims({"shells": bad}, 0.0))[0], "shells: 1.60 times the time without heat; the aim is 1.5")

    def test_cases_differ_in_heat_and_foils_alone(self):
        for model in thermal.MODELS:
            cold, heated = (thermal.groups_of(model, is_heated) for is_heated in (False, True))
            self.assertEqual(heated, {**cold, "thermal": thermal.HEAT})
            self.assertEqual("contact" in cold, model in ("beams", "shells"))


if __name__ == "__main__":
    unittest.main()
