#!/usr/bin/env python3
"""The notebook of a design study: stored without outputs, and every cell runs from the first to the last."""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
NOTEBOOK = PROJECT/"docs/manual/design_study.ipynb"
MISSING = [name for name in ("xarray", "matplotlib", "pandas") if not importlib.util.find_spec(name)]
# What a design's choice must be, whatever the numbers are.
CLAIMS = """
assert set(tables) == {0.0, 0.2} and tables[0.0].sizes == {"bump_foil%thickness": 3, "bearing%clearance": 3}
assert float(film.sel({"bump_foil%thickness": best["bump_foil%thickness"], "bearing%clearance": best["bearing%clearance"]}).min()) >= 11e-6
assert float(best.squeeze()) == float(stiffness.where(film >= 11e-6).max()) > 0
assert len(plt.get_fignums()) == 2
before = {path: path.stat().st_mtime_ns for path in __import__("pathlib").Path("design_study").iterdir()}
assert len([path for path in before if path.suffix == ".summary"]) == 18
gfb.study(case, {"bump_foil%thickness": thickness, "bearing%clearance": clearance}, folder="design_study", name="friction_0.2")
assert before == {path: path.stat().st_mtime_ns for path in before}, "what is there was computed again"
"""


class Notebook(unittest.TestCase):
    def setUp(self):
        self.notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))

    def test_stored_without_outputs(self):
        for cell in self.notebook["cells"]:
            if cell["cell_type"] == "code":
                self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))

    @unittest.skipUnless(importlib.util.find_spec("nbformat"), "nbformat is not installed")
    def test_format(self):
        import nbformat
        nbformat.validate(nbformat.read(NOTEBOOK, as_version=4))

    @unittest.skipIf(MISSING, f"not installed: {', '.join(MISSING)}")
    def test_every_cell_runs(self):
        code = "\n".join("".join(cell["source"]) for cell in self.notebook["cells"] if cell["cell_type"] == "code")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-c", code + CLAIMS], cwd=folder, capture_output=True, text=True, check=False,
                                  env={**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": str(PROJECT/"tools")})
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        self.assertIn("angular stiffness", done.stdout)


if __name__ == "__main__":
    unittest.main()
