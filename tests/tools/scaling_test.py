"""Tests of tools/bench scaling on made-up figures and small processes: limits, logs, growth, aims, kept rows."""

import json
import os
import pathlib
import signal
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(os.environ["GFB_SOURCE"])/"tools"))

from gfb.bench import runs as bench_runs  # noqa: E402 (found only now)
from gfb.bench import scaling as bench_scaling  # noqa: E402
from gfb.bench import scaling_page as bench_scaling_page  # noqa: E402

ROOMY = bench_runs.Limits(60.0, 2.0**32)
SPIN = "while True: pass"


def python(words):
    """A command that runs Python."""
    return [sys.executable, "-c", words]


def row(unknowns, cpu, memory, factorization=0.5, stopped=""):
    """A measured row with one rank."""
    parts = dict.fromkeys(bench_runs.PARTS, 0.0) | {"factorization": factorization*cpu, "solve": (1-factorization)*cpu}
    return {"stopped": stopped, "over": bool(stopped), "mesh": "m", "target": unknowns, "full_unknowns": unknowns,
            "cpu": cpu, "memory": memory, "parts": [parts],
            "summary": {"unknowns": unknowns, "newton_iterations": 10.0, "factorizations": 2.0}}


class Limited(unittest.TestCase):
    """Processes end by themselves or at a limit."""

    def test_end(self):
        ended = bench_runs.run_limited(python("print('done')"), ROOMY)
        self.assertEqual((ended.stopped, ended.said.strip()), ("", "done"))

    def test_failure_is_told(self):
        ended = bench_runs.run_limited(python("import sys; print('there is no such file'); sys.exit(3)"), ROOMY)
        self.assertIn("status 3: there is no such file", ended.stopped)
        self.assertFalse(ended.over)

    def test_cpu_time(self):
        ended = bench_runs.run_limited(python(SPIN), bench_runs.Limits(0.5, ROOMY.memory))
        self.assertTrue(ended.over)
        self.assertIn("CPU time", ended.stopped)

    def test_memory_of_a_child(self):
        child = "import time; x = b'1'*4*10**8; time.sleep(60)"
        grow = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {child!r}])"
        ended = bench_runs.run_limited(python(grow), bench_runs.Limits(60.0, 2.0**28))
        self.assertTrue(ended.over)
        self.assertIn("GiB", ended.stopped)

    def test_interrupted(self):
        def interrupt(*_):
            if place.exists() and place.read_text(encoding="utf-8").endswith("\n"):  # the child runs
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                raise InterruptedError

        before = signal.signal(signal.SIGALRM, interrupt)
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)/"process"
            signal.setitimer(signal.ITIMER_REAL, 0.1, 0.1)
            with self.assertRaises(InterruptedError):
                bench_runs.run_limited(python(f"import os, time; print(os.getpid(), file=open({str(place)!r}, 'w'), "
                                              "flush=True); time.sleep(60)"), ROOMY)
            with self.assertRaises(ProcessLookupError):
                os.kill(int(place.read_text(encoding="utf-8")), 0)
        signal.signal(signal.SIGALRM, before)


class Logs(unittest.TestCase):
    """PETSc's log in detail."""

    def test_parts(self):
        lines = ['Stages["Main Stage"]["summary"][0] = {"time" : 5., "numMessages" : 40., "messageLength" : 1e3, '
                 '"numReductions" : 7., "flop" : 0.}',
                 'Stages["Main Stage"]["MatLUFactorNum"][0] = {"count" : 2, "time" : 1., "flop" : 0.}',
                 'Stages["Main Stage"]["MatLUFactorNum"][0] = {"count" : 1, "time" : 0.5, "flop" : 0.}',
                 'Stages["Main Stage"]["KSPSolve"][0] = {"count" : 4, "time" : 0.5, "flop" : 0.}',
                 'Stages["Main Stage"]["SNESFunctionEval"][0] = {"count" : 0, "time" : 9., "flop" : 0.}',
                 'Stages["stiffness"]["summary"][0] = {"time" : 0.25, "numMessages" : 0.}',
                 'Stages["condensation"]["summary"][0] = {"time" : 0.75, "numMessages" : 0.}']
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder)/"counts.log.1"
            log.write_text("\n".join(lines), encoding="utf-8")
            stages = bench_runs.read_log(log)
        self.assertEqual(bench_runs.parts_of(stages), {
            "set-up": 0.0, "condensation": 0.75, "assembly": 0.25, "factorization": 1.5, "solve": 0.5, "output": 0.0,
            "rest": 3.0})
        self.assertEqual(bench_runs.messages_of(stages), {"messages": 20.0, "bytes": 500.0, "collectives": 7.0})


class Growth(unittest.TestCase):
    """Exponents, what is foreseen, and the aims."""

    def test_exponents(self):
        rows = [row(size, 1e-6*size**1.5, 3.0*size**1.1) for size in (3e4, 1e5, 3e5)]
        found = bench_scaling_page.exponents([row(1e3, 100.0, 1e9)] + rows)
        self.assertAlmostEqual(found["cpu"], 1.5, places=10)
        self.assertAlmostEqual(found["memory"], 1.1, places=10)
        self.assertEqual(found["rows"], 3)

    def test_foreseen(self):
        rows = [row(size, 1e-5*size, 5e3*size) for size in (1e5, 3e5)]
        self.assertEqual(bench_scaling.foreseen(rows, 1e6, ROOMY), "would need about 5 GiB by the growth so far "
                         "(from 0.5 to 1.4), of 4 allowed")
        self.assertEqual(bench_scaling.foreseen(rows, 8e5, ROOMY), "")
        self.assertIn("CPU time", bench_scaling.foreseen(rows, 1e6, bench_runs.Limits(5.0, 2.0**40)))

    def test_aims(self):
        growth = {"strip reduced": [row(size, 1e-6*size**1.4, 5e3*size) for size in (1e5, 1e6)],
                  "strip frictionless full": [row(1e5, 1.0, 3e8), row(1.1e6, 9.0, 3.9e9), row(3e6, 0, 0, stopped="x")]}
        aims = {line[0]: line[3] for line in bench_scaling_page.aim_table({"growth": growth})[2]}
        self.assertEqual(aims["exponent of the CPU time, strip, reduced, friction"], "**no**")
        self.assertEqual(aims["strip, full order, no friction, 1,100,000 unknowns"], "yes")
        self.assertEqual(aims["memory an unknown from 90,000 unknowns on, strip, reduced, friction"], "yes")


class Kept(unittest.TestCase):
    """Rows outlive a run of the tool."""

    def bench(self, folder, **changed):
        settings = {"gfb": str(folder/"gfb"), "seconds": 10.0, "memory": 1e9, "reuse": True}
        return bench_scaling.Bench(types.SimpleNamespace(**(settings | changed)), folder)

    def test_rows(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for program in ("gfb", "gfb_bench_varied_strip"):
                (folder/program).write_text("#!/bin/sh\n", encoding="utf-8")
                (folder/program).chmod(0o755)
            bench_runs.STORE = folder/"rows/scaling.json"
            first = self.bench(folder)
            first.row("good", lambda: row(1.0, 2.0, 3.0))
            first.row("stopped", lambda: row(1.0, 2.0, 3.0, stopped="more than 10 s"))
            self.assertEqual(set(json.loads(bench_runs.STORE.read_text(encoding="utf-8"))["rows"]), {"good", "stopped"})
            again, more = self.bench(folder), self.bench(folder, seconds=20.0)
            self.assertEqual(again.row("good", self.fail)["cpu"], 2.0)
            self.assertTrue(again.row("stopped", self.fail)["over"])
            self.assertEqual(more.row("stopped", lambda: row(1.0, 15.0, 3.0))["cpu"], 15.0)
            (folder/"gfb").write_text("#!/bin/sh\nanother build\n", encoding="utf-8")
            self.assertEqual(self.bench(folder).rows, {})


if __name__ == "__main__":
    unittest.main()
