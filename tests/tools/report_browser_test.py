#!/usr/bin/env python3
"""A page of tools/report in Chromium without a window: no complaint, every picture there, nothing wider than the page."""

import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]/"tools"))
import gfb  # noqa: E402
from gfb.tool import ROOT  # noqa: E402
from report_test import SMALL, SOUGHT  # noqa: E402

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
WIDTH = 1300
# What the browser made of the page, written into it.
PROBE = """<script>addEventListener("load", () => {
  const pictures = Array.from(document.images, (image) => image.naturalWidth);
  document.body.dataset.seen = [document.documentElement.scrollWidth, pictures.length, Math.min(...pictures)].join(" ");
});</script></body>"""

NARROW = 420  # less than a window of Chromium's can be: a frame in one
FRAME = """<body><iframe width="{width}" height="900" frameborder="0" srcdoc="{page}"></iframe><script>addEventListener("load", () => {{
  const inside = document.querySelector("iframe").contentDocument;
  const bars = Array.from(inside.querySelectorAll(".bars i"), (bar) => bar.getBoundingClientRect().width);
  document.body.dataset.seen = [inside.documentElement.scrollWidth, ...bars].join(" ");
}});</script></body>"""


@unittest.skipUnless(BROWSER, "Chromium is not installed")
class BrowserTest(unittest.TestCase):
    def browse(self, folder, page, *options):
        """What is printed and what is logged where the browser opens a page."""
        done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--enable-logging=stderr",
                               f"--user-data-dir={folder/'profile'}", f"--window-size={WIDTH},2000", *options, page.as_uri()],
                              capture_output=True, text=True, check=True, timeout=900)
        return done.stdout, done.stderr

    def test_a_page_of_two_results(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            folder = pathlib.Path(place)
            case = gfb.Case(SMALL)
            gfb.run(case, folder, "first")
            case["sweep%parameter"], case["sweep%values"] = "load", (10.0, 20.0)
            gfb.run(case, folder, "second")
            page = folder/"page.html"
            subprocess.run([sys.executable, ROOT/"tools/report", folder/"first", folder/"second", "-o", page], check=True, capture_output=True)
            text = page.read_text(encoding="utf-8")
            page.write_text(text.replace("</body>", PROBE), encoding="utf-8")
            shown, logged = self.browse(folder, page, "--dump-dom")
            self.assertNotIn("CONSOLE", logged)
            seen = re.search(r'data-seen="(\d+) (\d+) (\d+)"', shown)
            self.assertIsNotNone(seen, "the page did not load")
            wide, pictures, narrowest = map(int, seen.groups())
            self.assertLessEqual(wide, WIDTH)
            self.assertEqual(pictures, 7)  # of each the film, around and on the shaft, and the points of the sweep
            self.assertGreater(narrowest, 400)
            self.assertRegex(shown, r'<th class="n">load \[N\]</th><th class="n">converged')
            shot = folder/"page.png"
            self.browse(folder, page, f"--screenshot={shot}")
            self.assertGreater(shot.stat().st_size, 20000, "an empty page")

    def test_bars_of_sensitivities_on_a_narrow_screen(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            folder = pathlib.Path(place)
            gfb.run(gfb.Case(SMALL | {"sensitivity": SOUGHT}), folder, "first")
            page = folder/"page.html"
            subprocess.run([sys.executable, ROOT/"tools/report", folder/"first", "-o", page], check=True, capture_output=True)
            page.write_text(FRAME.format(width=NARROW, page=html.escape(page.read_text(encoding="utf-8"))), encoding="utf-8")
            shown, _ = self.browse(folder, page, "--dump-dom")
            seen = re.search(r'data-seen="(.*?)"', shown)
            self.assertIsNotNone(seen, "the page did not load")
            wide, *bars = map(float, seen[1].split())
            self.assertLessEqual(wide, NARROW)
            self.assertEqual(len(bars), 3)
            self.assertEqual(bars, sorted(bars, reverse=True))
            self.assertGreater(bars[0], 50.0)  # long enough to be compared

    def test_a_complaint_is_seen(self):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            page = pathlib.Path(place)/"bad.html"
            page.write_text("<body><script>nothing.here()</script></body>", encoding="utf-8")
            self.assertIn("CONSOLE", self.browse(pathlib.Path(place), page, "--dump-dom")[1])


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
