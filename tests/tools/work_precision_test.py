"""Tests of tools/bench work-precision on made-up figures: references, errors, fronts, branches, kept runs, the page."""

import os
import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(os.environ["GFB_SOURCE"])/"tools"))

from gfb.bench import work_precision as bench  # noqa: E402 (found only now)
from gfb.bench.work_precision import errors, page, scenes  # noqa: E402
import numpy  # noqa: E402

FORCE = scenes.Quantity("force", ("force_x", "force_y"))
PLACE = scenes.Quantity("place", ("eccentricity_x",), scale=2.0)


def row(cpu, *, converged=True, **numbers):
    """A kept run."""
    counts = {"unknowns": 10.0, "newton_iterations": 5.0, "factorizations": 2.0, "peak_memory": 1e6*cpu}
    return {"cpu": [2.0*cpu, cpu], "converged": converged, "summary": {**counts, **numbers}}


class Made:
    """A store that knows made-up runs by the name of their case."""

    def __init__(self, rows):
        self.rows = rows

    def row(self, groups):
        return self.rows[groups["scene"]["title"]]


def case(name):
    """Groups that only have a name."""
    return {"scene": {"title": name}}


def made_scene():
    """A simple model that ends 5 % off, and the whole one, that converges with order 2."""
    values = {"simple 1": 1.07, "simple 2": 1.055, "simple 3": 1.05, "whole 1": 1.04, "whole 2": 1.01,
              "fine 1": 1.0 + 0.16*0.01, "fine 2": 1.0 + 0.04*0.01, "fine 3": 1.0 + 0.01*0.01}
    times = {"simple 1": 1.0, "simple 2": 2.0, "simple 3": 4.0, "whole 1": 8.0, "whole 2": 16.0}
    rows = {name: row(times.get(name, 99.0), force_x=3.0*value, force_y=4.0*value) for name, value in values.items()}
    rows["lost"] = row(1.0, converged=False)
    entries = [scenes.Entry(name.split()[0], f"mesh {name[-1]}", case(name), name in ("simple 3", "whole 2"),
                            (int(name[-1]),)) for name in times] + [scenes.Entry("other", "mesh 1", case("lost"))]
    scene = scenes.Scene("made up", "Nothing real.", (FORCE, FORCE), entries,
                         [(name, case(name)) for name in ("fine 1", "fine 2", "fine 3")], whole="whole",
                         pairs=(("simple instead of whole", "whole, mesh 2", "simple, mesh 2"),))
    return scene, Made(rows)


class References(unittest.TestCase):
    """The rule of docs/manual/accuracy.md."""

    def test_order_two(self):
        found = errors.know(FORCE, [numpy.array([3.0, 4.0])*(1.0 + 0.16*4.0**-i) for i in range(3)], 2.0)
        self.assertAlmostEqual(found.order, 2.0, places=12)
        self.assertAlmostEqual(found.doubt, 1.25*0.01/1.01, places=12)

    def test_to_and_fro(self):
        found = errors.know(PLACE, [numpy.array([one]) for one in (1.0, 1.2, 1.1)], 2.0)
        self.assertIsNone(found.order)
        self.assertAlmostEqual(found.doubt, 3.0*0.2/2.0, places=12)

    def test_too_fast_is_not_believed(self):
        found = errors.know(PLACE, [numpy.array([one]) for one in (0.0, 0.8, 0.9)], 2.0)
        self.assertAlmostEqual(found.order, 3.0, places=12)
        self.assertAlmostEqual(found.doubt, 3.0*0.1/3.0/2.0, places=12)


class Judgement(unittest.TestCase):
    """Errors, the front, targets, what models converge to."""

    def setUp(self):
        self.scene, store = made_scene()
        self.facts = errors.known(self.scene, store)
        self.judged = errors.judge(self.scene, store, self.facts)

    def test_errors(self):
        self.assertAlmostEqual(self.judged[0].errors[0], 1.07/1.0001 - 1.0, places=12)
        self.assertEqual(self.judged[-1].state, "no answer")

    def test_front(self):
        front = errors.front(self.judged, self.facts, 0, lambda one: one.cpu)
        self.assertEqual([one.entry.words for one in front],
                         ["simple, mesh 1", "simple, mesh 2", "simple, mesh 3", "whole, mesh 1", "whole, mesh 2"])
        self.assertEqual(len(errors.front(self.judged, self.facts, 0, lambda one: -one.cpu)), 1)

    def test_targets(self):
        self.assertEqual(errors.cheapest(self.judged, self.facts, [0], 0.053).entry.words, "simple, mesh 3")
        self.assertEqual(errors.cheapest(self.judged, self.facts, [0], 0.02).entry.words, "whole, mesh 2")
        self.assertIsNone(errors.cheapest(self.judged, self.facts, [0], 0.0099))

    def test_luck(self):
        self.assertEqual([one.luck for one in self.judged], [()]*6)
        scene, store = made_scene()
        store.rows["simple 1"]["summary"] |= {"force_x": 3.12, "force_y": 4.16}
        judged = errors.judge(scene, store, self.facts)
        self.assertEqual(judged[0].luck, ())
        store.rows["simple 1"]["summary"] |= {"force_x": 3.03, "force_y": 4.04}
        judged = errors.judge(scene, store, self.facts)
        self.assertEqual(judged[0].luck, (0, 1))
        self.assertEqual(errors.cheapest(judged, self.facts, [0], 0.02).entry.words, "whole, mesh 2")
        self.assertNotIn(judged[0], errors.front(judged, self.facts, 0, lambda one: one.cpu))

    def test_page(self):
        scene, store = made_scene()
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            page.write({"made": scene}, store, types.SimpleNamespace(quick=False, repetitions=3), place)
            said = (place/"work_precision.md").read_text(encoding="utf-8")
            self.assertTrue((place/"work_precision_made.png").exists())
        self.assertIn("| simple | mesh 3 | 4.00 | 5.0 | 5.0 | 0.50, 0.50 |", said)
        self.assertIn("| simple instead of whole | mesh 2 | 16.00 to 2.00 | 8.00 |", said)
        self.assertIn("simple, mesh 1: 1.00 s", said)
        self.assertIn("Not compared: other, mesh 1: no answer.", said)


class Branches(unittest.TestCase):
    """Another equilibrium is no error."""

    def state(self, **changed):
        base = {"eccentricity_x": 1.0, "leading_edge_lift": 0.0, "trailing_edge_lift": 4e-5, "lifted_length": 0.28}
        fact = errors.Known(PLACE, numpy.array([1.0]), 2.0, 2.0, 1e-3)
        return errors.other_branch(base | changed, base, [fact])

    def test_states(self):
        self.assertEqual(self.state(eccentricity_x=1.1, trailing_edge_lift=4.5e-5), "")
        for changed in ({"leading_edge_lift": 2.1e-5}, {"lifted_length": 0.42}, {"eccentricity_x": 1.5}):
            self.assertEqual(self.state(**changed), "another equilibrium")
        fact = errors.Known(PLACE, numpy.array([1.0]), 2.0, 2.0, 1e-3)
        self.assertEqual(errors.other_branch({"eccentricity_x": 9.0}, {}, [fact]), "")


class Cases(unittest.TestCase):
    """Every scene can be told from every other, and is coarser than its reference."""

    def test_entries(self):
        for quick in (False, True):
            for make in bench.SCENES.values():
                scene = make(quick)
                keys = [scenes.key_of(groups) for groups in [*(entry.groups for entry in scene.entries),
                                                            *(groups for _, groups in scene.reference)]]
                self.assertGreaterEqual(len(set(keys)), len(keys) - 2)  # an entry may be the reference's neighbour
                self.assertEqual(len({entry.words for entry in scene.entries}), len(scene.entries))
                self.assertNotIn(keys[-1], keys[:-1])

    def test_pairs(self):
        for make in bench.SCENES.values():
            scene = make(False)
            words = {entry.words for entry in scene.entries}
            self.assertTrue(any(dear in words and cheap in words for _, dear, cheap in scene.pairs))


class Kept(unittest.TestCase):
    """Runs outlive a run of the tool."""

    def test_reuse(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            program = folder/"gfb"
            program.write_text("#!/bin/sh\nfor last; do :; done\ncat >\"$4.used\"\n"
                               "printf 'unknowns = 7\\nforce_x = 2.0 [N]\\n' >\"$3/case.summary\"\n", encoding="utf-8")
            program.chmod(0o755)
            before, bench.STORE = bench.STORE, folder/"rows/kept.json"
            try:
                first = bench.Store(str(program), False)
                for _ in range(3):
                    first.measure(case("one"), folder, 2, "one")
                again = bench.Store(str(program), True)
                self.assertEqual(len(again.row(case("one"))["cpu"]), 2)
                self.assertEqual(again.row(case("one"))["summary"]["force_x"], 2.0)
                self.assertIsNone(again.row(case("two")))
                program.write_text(program.read_text(encoding="utf-8") + "# another build\n", encoding="utf-8")
                self.assertEqual(bench.Store(str(program), True).rows, {})
            finally:
                bench.STORE = before


if __name__ == "__main__":
    unittest.main()
