#!/usr/bin/env python3
"""Notebooks of the manual: stored without outputs, and every cell runs from the first to the last."""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
NOTEBOOKS = sorted((PROJECT/"docs/manual").glob("*.ipynb"))
MISSING = [name for name in ("xarray", "matplotlib", "pandas", "scipy") if not importlib.util.find_spec(name)]
# What must be right, whatever the numbers are.
CLAIMS = {"design_study": """
assert set(tables) == {0.0, 0.2} and tables[0.0].sizes == {"bump_foil%thickness": 3, "bearing%clearance": 3}
assert float(film.sel({"bump_foil%thickness": best["bump_foil%thickness"], "bearing%clearance": best["bearing%clearance"]}).min()) >= 11e-6
assert float(best.squeeze()) == float(stiffness.where(film >= 11e-6).max()) > 0
assert len(plt.get_fignums()) == 2
before = {path: path.stat().st_mtime_ns for path in __import__("pathlib").Path("design_study").iterdir()}
assert len([path for path in before if path.suffix == ".summary"]) == 18
gfb.study(case, {"bump_foil%thickness": thickness, "bearing%clearance": clearance}, folder="design_study", name="friction_0.2")
assert before == {path: path.stat().st_mtime_ns for path in before}, "what is there was computed again"
""", "grooves": """
assert sleeve.within and shaft.within
assert sleeve.results[0].after > 2.0*sleeve.results[0].before, "the gain is not there"
assert all(row.after > 1.5 for row in (shaft.results[1], shaft.finer[1])) and shaft.results[0].after < shaft.results[0].before
assert np.isnan(masses["shaft"][-1]) and max(masses["sleeve"]) < 1.0 and not np.isnan(masses["sleeve"]).any()
assert abs(masses["shaft"][0]/masses["sleeve"][0] - 1.0) < 0.05, "shallow grooves are alike"
assert len(plt.get_fignums()) == 1
""", "optimize": """
assert uniform.within and graded.within and start["bump_foil%bump_thickness"][0] == uniform.case["bump_foil%thickness"]
for rows in (graded.results, graded.finer):
    assert rows[0].after > 1.05*rows[0].before, "the gain is not there on this mesh"
assert len(graded.runs) <= 30 and min(thickness) >= low and max(thickness) <= high
assert max(free) < max(films) and as_good < 0.5*len(free), "gradients are of little use"
assert len(plt.get_fignums()) == 1
"""}
SAID = {"design_study": "angular stiffness", "grooves": "on the sleeve at most", "optimize": "by gradient: as much after"}


def cells_of(path, kind):
    """The cells of a kind of a notebook."""
    return [cell for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == kind]


class Notebook(unittest.TestCase):
    def test_each_has_claims(self):
        self.assertEqual([path.stem for path in NOTEBOOKS], sorted(CLAIMS))

    def test_stored_without_outputs(self):
        for path in NOTEBOOKS:
            for cell in cells_of(path, "code"):
                self.assertEqual((path.stem, cell["outputs"], cell["execution_count"]), (path.stem, [], None))

    @unittest.skipUnless(importlib.util.find_spec("nbformat"), "nbformat is not installed")
    def test_format(self):
        import nbformat
        for path in NOTEBOOKS:
            nbformat.validate(nbformat.read(path, as_version=4))

    @unittest.skipIf(MISSING, f"not installed: {', '.join(MISSING)}")
    def test_every_cell_runs(self):
        for path in NOTEBOOKS:
            code = "\n".join("".join(cell["source"]) for cell in cells_of(path, "code"))
            with self.subTest(path.stem), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, "-c", code + "\n" + CLAIMS[path.stem]], cwd=folder, capture_output=True, text=True, check=False,
                                      env={**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": str(PROJECT/"tools")})
                self.assertEqual(done.returncode, 0, done.stderr[-2000:])
                self.assertIn(SAID[path.stem], done.stdout)


if __name__ == "__main__":
    unittest.main()
