"""Tests of tools/gallery: measures and judgements on made-up answers, a page made by gfb, and the pages of docs/."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest

import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))

from gfb.gallery import page as gallery_page  # noqa: E402 (found only now)
from gfb.gallery import runs as gallery_runs  # noqa: E402
from gfb.gallery import tilt as gallery_tilt  # noqa: E402
from gfb.plot.film import Film  # noqa: E402
from slow import slow  # noqa: E402

AMBIENT = 1.0e5
FRAME = "(../../manual/frame.md)"
EXCHANGED = ("phi_x and phi_y are exchanged", "no exchange of phi_x and phi_y")


def call(*words):
    """tools/gallery as a user calls it: status, and what it said."""
    done = subprocess.run([sys.executable, PROJECT/"tools/gallery", "--gfb", os.environ["GFB"], *map(str, words)],
                          check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def result(**fields):
    """An answer with a film whose fields are functions of theta [deg] and z [m]."""
    theta, z = numpy.linspace(0.0, 360.0, 73), numpy.linspace(-0.02, 0.02, 9)
    made = {name: of(theta[:, None], z[None, :]) + 0.0*theta[:, None]*z[None, :] for name, of in fields.items()}
    return types.SimpleNamespace(film=Film(theta, z, made, {}), used={("gas", "ambient_pressure"): (f"{AMBIENT}",
                                                                                                    False)})


def sweep(torque):
    """A sweep of tilt_y whose torque_y is a function of the tilt."""
    tilt = numpy.linspace(0.0, 3.0e-4, 7)
    return types.SimpleNamespace(history={"tilt_y": tilt, "torque_y": torque(tilt)})


class Measures(unittest.TestCase):
    """Numbers of answers made up here, against what they must be."""

    def test_asymmetry_is_none_of_an_even_and_whole_of_a_one_sided_suction(self):
        even = result(pressure=lambda theta, z: AMBIENT - 1.0e3*numpy.cos(100.0*z)*(theta > 180.0))
        sided = result(pressure=lambda theta, z: AMBIENT - 1.0e3*(z > 0.0)*(theta > 180.0) + 500.0*(theta < 90.0))
        self.assertAlmostEqual(gallery_tilt.asymmetry(even), 0.0, places=12)
        self.assertAlmostEqual(gallery_tilt.asymmetry(sided), 1.0, places=12)

    def test_asymmetry_of_a_linear_suction_is_its_slope(self):
        # s = 1 + a z/b: the integral of 2 a |z|/b over that of 2 is a/2.
        part = result(pressure=lambda theta, z: AMBIENT - 1.0e3*(1.0 + 0.6*z/0.02))
        self.assertAlmostEqual(gallery_tilt.asymmetry(part), 0.3, places=12)

    def test_foils_that_even_out_a_third_of_the_tilt_leave_two_thirds(self):
        one = result(gap=lambda theta, z: 1.0e-5 + 2.0e-4*z*(1.0 - 1.0/3.0), deflection=lambda theta, z: -2.0e-4*z/3.0,
                     pressure=lambda theta, z: AMBIENT)
        for words, where in list(gallery_tilt.regions(one).items())[:2]:
            self.assertAlmostEqual(gallery_tilt.antisymmetric(one, where), 2.0/3.0, places=12, msg=words)

    def test_departure_from_a_line_is_that_of_the_best_one(self):
        straight, bent = sweep(lambda tilt: 5.0*tilt), sweep(lambda tilt: 5.0*tilt*(1.0 + 1.0e3*tilt))
        self.assertAlmostEqual(gallery_tilt.departure(straight, "y", "torque_y"), 0.0, places=12)
        tilt, torque = bent.history["tilt_y"], bent.history["torque_y"]
        slopes = numpy.linspace(5.0, 8.0, 30001)
        best = min(slopes, key=lambda slope: ((torque - slope*tilt)**2).sum())
        self.assertAlmostEqual(gallery_tilt.departure(bent, "y", "torque_y"),
                               numpy.abs(torque - best*tilt).max()/torque.max(), places=4)
        self.assertAlmostEqual(gallery_tilt.stiffness(bent, "y", "torque_y"), 5.0*(1.0 + 1.0e3*0.5e-4), places=9)

    def test_changed_keys_stand_once_in_their_group(self):
        text = "&top_foil ! a\n  fixed_edge = 'trailing' ! here\n/\n! &mesh\n&bump_foil\n  fixed_edge = 'trailing'\n/\n"
        self.assertEqual(gallery_runs.changed(text, {"bump_foil.fixed_edge": "leading", "mesh.axial_elements": 8,
                                                     "top_foil.thickness": 1.0e-4}),
                         "&top_foil ! a\n  fixed_edge = 'trailing' ! here\n  thickness = 0.0001\n/\n! &mesh\n"
                         "&bump_foil\n  fixed_edge = 'leading'\n/\n\n&mesh\n  axial_elements = 8\n/\n")

    def test_runs_that_differ_have_names_that_differ(self):
        changes = [{"top_foil.fixed_edge": "leading"}, {"bump_foil.fixed_edge": "leading"}, {},
                   *({"contact.friction_top": one, "contact.friction_sleeve": one, "mesh.axial_elements": 8,
                      "mesh.circumferential_elements": 104} for one in (0.1, 0.2))]
        self.assertEqual(len({gallery_runs.run_name("gu2020_bearing", one) for one in changes}), len(changes))

    def test_judgements_say_all_some_none_and_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            page = gallery_page.Page("some", "[Gu2020] some", pathlib.Path(folder))
            page.judge("one.", {"a": True, "b": True}, "1.")
            page.judge("two.", {"a": True, "b": False}, "2.")
            page.judge("three.", {"a": False, "b": False}, "3.")
            page.judge("four.", None, "4.")
            page.tell_verdicts()
            page.short = page.count()
            text = page.write().read_text(encoding="utf-8")
        self.assertIn("- **Agrees**: one. 1.\n- **Agrees in part**: two. 2. True of: a.\n- **Does not agree**: three. "
                      "3.\n"
                      "- **Not comparable**: four. 4.\n", text)
        self.assertIn("1 of 3 statements agree, 1 in part, 1 cannot be compared", text)


class Pages(unittest.TestCase):
    """Pages made here by gfb, and those of the checkout."""

    @slow
    def test_slow_a_page_has_picture_numbers_frame_and_parameters(self):
        with tempfile.TemporaryDirectory() as folder:
            output, runs = pathlib.Path(folder)/"pages", pathlib.Path(folder)/"runs"
            options = ("--only", "fig8a,frame", "--quick", "--output", output, "--runs", runs)
            status, said = call(*options)
            self.assertEqual(status, 0, said)
            self.assertIn("runs gu2020_strip_case2_four_bumps\n", said)
            text = (output/"fig8a.md").read_text(encoding="utf-8")
            name = "gu2020_strip_case2_four_bumps"
            summary = (runs/name/f"{name}.summary").read_text(encoding="utf-8")
            travel = 1.0e6*float(re.search(r"^maximum_deflection = (\S+)", summary, re.MULTILINE)[1])
            self.assertIn(f"| both ends free | {travel:.3f} | 65.623 |", text)
            self.assertIn("**Agrees**: (independent solution)", text)
            self.assertIn("| `&contact` | `friction_top = 0.2`<br>`friction_sleeve = 0.2` |", text)
            self.check_frame(output/"fig8a.md")
            for picture in ("fig8a.png", "frame.png"):
                self.assertEqual((output/picture).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
            self.assertIn("](fig8a.md) | travel", (output/"README.md").read_text(encoding="utf-8"))
            status, said = call(*options, "--reuse")
            self.assertEqual((status, "  runs " in said), (0, False), said)
            self.assertEqual((output/"fig8a.md").read_text(encoding="utf-8"), text)

    def test_wrong_calls_are_refused(self):
        for words, reason in ((("--only", "fig7c"), "no page fig7c"), (("--quick",), "--quick needs --output"),
                              (("--jobs", "0"), "--jobs: at least 1")):
            status, said = call(*words)
            self.assertNotEqual(status, 0, words)
            self.assertIn(reason, said)

    def test_the_pages_of_the_checkout_are_complete(self):
        for page in sorted((PROJECT/"docs/measured/gallery").glob("*.md")):
            self.check_frame(page)

    def check_frame(self, page):
        """A page states frame, signs, rotation and the exchange, and every table leads to them."""
        text = " ".join(page.read_text(encoding="utf-8").replace("\n> ", " ").split())
        for words in ("**Frame and signs**", "positive towards the sleeve", FRAME):
            self.assertIn(words, text, page)
        self.assertTrue(any(words in text for words in EXCHANGED), page)
        self.assertTrue("the shaft turns in +theta" in text or "no rotation" in text, page)
        if page.name != "README.md":
            self.assertGreater(text.count(f"([frame and signs]{FRAME})"), 0, page)


if __name__ == "__main__":
    unittest.main()
