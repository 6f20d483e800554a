#!/usr/bin/env python3
"""tools/manual --html: every page is there, links lead somewhere, equations are drawn from files beside them."""

import html.parser
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FORD = importlib.util.find_spec("ford") or shutil.which("ford")
THERE = (all(importlib.util.find_spec(name) for name in ("sphinx", "myst_parser"))
         and pathlib.Path("/usr/share/javascript/mathjax/MathJax.js").exists())


class Page(html.parser.HTMLParser):
    """What a page refers to, what refers to nothing on the net unless it is a link to follow, and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.targets, self.loaded, self.anchors = [], [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.anchors.add(found.get("id"))
        if tag in ("script", "img", "link"):
            self.loaded += [found[name] for name in ("src", "href") if name in found]
        elif found.get("href") and "://" not in found["href"]:
            self.targets.append(found["href"])


@unittest.skipUnless(THERE, "Sphinx, MyST and MathJax are not installed (python3-sphinx, python3-myst-parser, libjs-mathjax)")
class HtmlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(place.cleanup)
        cls.place = pathlib.Path(place.name)
        cls.folder = cls.place/"manual"
        cls.done = subprocess.run([sys.executable, PROJECT/"tools/manual", "--html", cls.folder], capture_output=True, text=True, check=False)

    def test_without_a_warning(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)

    def test_every_page_and_every_link(self):
        sources = [PROJECT/"README.md", PROJECT/"CHANGELOG.md", *(PROJECT/"docs").rglob("*.md")]
        self.assertEqual([path for path in sources if not (self.folder/path.relative_to(PROJECT)).with_suffix(".html").exists()], [])
        pages = {path: Page(path) for path in self.folder.rglob("*.html")
                 if path.name not in ("search.html", "genindex.html") and self.folder/"api" not in path.parents}
        broken = []
        for path, page in pages.items():
            self.assertEqual([name for name in page.loaded if "://" in name], [], f"{path} needs the net")
            for target in page.targets:
                name, _, anchor = urllib.parse.unquote(target).partition("#")
                other = (path.parent/name).resolve() if name else path
                if not other.exists() or (anchor and other in pages and anchor not in pages[other].anchors):
                    broken.append((path.name, target))
        self.assertEqual(broken, [])

    @unittest.skipUnless(FORD, "FORD is not installed (pip install ford)")
    def test_modules(self):
        """Every module has a page that the manual leads to, with equations by the manual's own MathJax."""
        modules = {re.match(r"module (gfb_\w+)", line, re.IGNORECASE)[1] for path in (PROJECT/"src").rglob("*.[fF]90")
                   if "bench" not in path.parts for line in path.read_text(encoding="utf-8").splitlines() if re.match(r"module gfb_\w+ *$", line)}
        self.assertGreater(len(modules), 200)
        self.assertEqual([name for name in sorted(modules) if not (self.folder/f"api/module/{name}.html").exists()], [])
        page = (self.folder/"api/module/gfb_contact_law.html").read_text(encoding="utf-8")
        for path in (self.folder/"api").rglob("*.html"):
            loaded = Page(path).loaded
            self.assertEqual([name for name in loaded if "://" in name], [], f"{path} needs the net")
            self.assertEqual([name for name in loaded if "bootstrap" in name and not (path.parent/name).exists()], [], path)
        self.assertIn("../../_static/mathjax/MathJax.js", page)
        self.assertIn('href="../api/index.html"', (self.folder/"docs/README.html").read_text(encoding="utf-8"))

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_equations_in_a_browser(self):
        page = self.folder/"docs/manual/companions.html"
        done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--enable-logging=stderr",
                               f"--user-data-dir={self.place/'profile'}", "--virtual-time-budget=30000", "--dump-dom", page.as_uri()],
                              capture_output=True, text=True, check=True, timeout=120)
        self.assertNotIn("CONSOLE", done.stderr)
        equations = len(re.findall(r'class="math ', page.read_text(encoding="utf-8")))
        self.assertGreater(equations, 40)
        self.assertEqual(done.stdout.count('class="MathJax_SVG"') + done.stdout.count('class="MathJax_SVG MathJax'), equations)
        self.assertNotRegex(done.stdout, r"class=\"[^\"]*(merror|noError)")

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_pages_fit_a_telephone(self):
        """No page scrolls to the side, on a telephone or on a screen; a table that is wider does by itself."""
        for name in ("README", "manual/keys", "manual/results", "manual/three_pad_rotor"):
            for width in (360, 1300):
                frame = self.folder/"docs/frame.html"
                self.addCleanup(frame.unlink, missing_ok=True)
                frame.write_text(f'<iframe src="{name}.html" width={width} height=900 style="border:0"></iframe><p></p><script>onload = () => {{'
                                 "const page = document.querySelector('iframe').contentDocument.documentElement;"
                                 "document.querySelector('p').textContent = `wide ${page.scrollWidth} of ${page.clientWidth}`}</script>", encoding="utf-8")
                done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--allow-file-access-from-files",
                                       f"--user-data-dir={self.place/'profile'}", "--virtual-time-budget=30000", "--window-size=1400,1000", "--dump-dom",
                                       frame.as_uri()], capture_output=True, text=True, check=True, timeout=120)
                wide, of = map(int, re.search(r"wide (\d+) of (\d+)", done.stdout).groups())
                self.assertLessEqual(wide, of, f"{name} at {width}")
                self.assertGreater(of, width - 20)

    def test_another_folder_stays(self):
        other = self.place/"other"
        other.mkdir()
        (other/"letter.txt").write_text("mine", encoding="utf-8")
        done = subprocess.run([sys.executable, PROJECT/"tools/manual", "--html", other], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, "something else" in done.stderr, (other/"letter.txt").exists()), (1, True, True), done.stderr)


if __name__ == "__main__":
    unittest.main()
