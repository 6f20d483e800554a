#!/usr/bin/env python3
"""tools/manual --html: a folder a version, every page is there, links lead somewhere, equations are drawn from files beside them, each page's
text begins in the first screen and no page is wider than its window, and the net is never asked."""

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
sys.path.insert(0, str(PROJECT/"tools"))
from chromium import BROWSER, Browser  # noqa: E402
from gfb.html.main import index_of, versions_in  # noqa: E402

VERSION = re.search(r"project\(gfb VERSION ([\d.]+)", (PROJECT/"CMakeLists.txt").read_text(encoding="utf-8"))[1]
OLDER = "0.0.9"
WIDTHS = 360, 400, 1024, 1300, 1920  # of telephones, a tablet, a laptop and a screen
NARROWEST = 300  # of what stands below a title [pixels]
# Where that begins, whether its first line is seen there, and how wide it is.
FIRST = """(() => {
  const text = Array.from(document.querySelectorAll('h1 ~ *')).find((one) => one.clientHeight > 0), box = text.getBoundingClientRect();
  const seen = document.elementFromPoint(box.left + 5, box.top + 5);
  return [box.top, seen !== null && text.contains(seen) && box.top + 20 < innerHeight, text.clientWidth];
})()"""
FORD = importlib.util.find_spec("ford") or shutil.which("ford")
THERE = (all(importlib.util.find_spec(name) for name in ("sphinx", "myst_parser", "furo"))
         and pathlib.Path("/usr/share/javascript/mathjax/MathJax.js").exists())


class Page(html.parser.HTMLParser):
    """What a page refers to, what refers to nothing on the net unless it is a link to follow, and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.targets, self.outside, self.loaded, self.anchors = [], [], [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.anchors.add(found.get("id"))
        if tag in ("script", "img", "link"):
            self.loaded += [found[name] for name in ("src", "href") if name in found]
        elif found.get("href"):
            (self.outside if "://" in found["href"] else self.targets).append(found["href"])


@unittest.skipUnless(THERE, "Sphinx, MyST, Furo and MathJax are not installed (tools/requirements.txt, libjs-mathjax)")
class HtmlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(place.cleanup)
        cls.place = pathlib.Path(place.name)
        cls.manual = cls.place/"manual"
        cls.folder = cls.manual/VERSION
        (cls.manual/OLDER).mkdir(parents=True)
        (cls.manual/OLDER/"objects.inv").write_text("of an older version\n", encoding="utf-8")
        cls.done = subprocess.run([sys.executable, PROJECT/"tools/manual", "--html", cls.manual], capture_output=True, text=True, check=False)

    def test_without_a_warning(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)

    def test_versions(self):
        """The page above leads to this version and to what stood there; each page says of which version it is and leads back."""
        index = Page(self.manual/"index.html")
        self.assertEqual(index.targets, [f"{VERSION}/docs/README.html", f"{OLDER}/docs/README.html"])
        self.assertTrue((self.manual/OLDER/"objects.inv").exists())
        for path in self.pages():
            text = path.read_text(encoding="utf-8")
            self.assertIn(f"Version {VERSION};", text, path)
            self.assertIn(f'href="{os.path.relpath(self.manual/"index.html", path.parent)}"', text, path)

    def test_the_newest_version_comes_first(self):
        place = self.place/"several"
        for name in ("0.9.0", "0.10.0", "0.2.11"):
            (place/name).mkdir(parents=True)
            (place/name/"objects.inv").touch()
        self.assertEqual(versions_in(place), ["0.10.0", "0.9.0", "0.2.11"])
        self.assertIn('<a href="0.10.0/docs/README.html">Version 0.10.0</a>', index_of(versions_in(place)))

    def pages(self):
        """What Sphinx has made."""
        return [path for path in sorted(self.folder.rglob("*.html")) if self.folder/"api" not in path.parents and path != self.folder/"index.html"]

    def test_every_page_and_every_link(self):
        sources = [PROJECT/"README.md", PROJECT/"CHANGELOG.md", *(PROJECT/"docs").rglob("*.md")]
        self.assertEqual([path for path in sources if not (self.folder/path.relative_to(PROJECT)).with_suffix(".html").exists()], [])
        pages = {path: Page(path) for path in self.pages()}
        broken = []
        for path, page in pages.items():
            for target in [*page.targets, *(name.partition("?")[0] for name in page.loaded)]:
                name, _, anchor = urllib.parse.unquote(target).partition("#")
                other = (path.parent/name).resolve() if name else path
                if "://" in target or not other.exists() or (anchor and other in pages and anchor not in pages[other].anchors):
                    broken.append((path.name, target))
        self.assertEqual(broken, [])

    def test_links_to_the_net_are_addresses(self):
        outside = {target for path in self.pages() for target in Page(path).outside}
        self.assertTrue(outside)
        for target in outside:
            self.assertRegex(target, r"^https?://[\w-]+(\.[\w-]+)+(/[^\s\"<>]*)?$")

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

    def open(self, browser, path, width=1300, query=""):
        """A page as it is when its equations are drawn."""
        page = browser.page(path.as_uri() + query, width)
        page.wait("document.readyState === 'complete'")
        page.run("new Promise((done) => window.MathJax ? MathJax.Hub.Queue(() => done(1)) : done(1))")
        return page

    def browser(self):
        """One with a profile of its own, ended with the test."""
        browser = Browser(tempfile.mkdtemp(dir=self.place))
        self.addCleanup(browser.close)
        return browser

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_equations_in_a_browser(self):
        path = self.folder/"docs/manual/companions.html"
        page = self.open(self.browser(), path)
        equations = len(re.findall(r'class="math ', path.read_text(encoding="utf-8")))
        self.assertGreater(equations, 40)
        self.assertEqual(page.run("document.querySelectorAll('.MathJax_SVG').length"), equations)
        self.assertEqual(page.run("document.querySelectorAll('.merror, .noError').length"), 0)

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_every_width(self):
        """Text begins in the first screen of every page and has room, whatever the width of the window. Tables, equations and commands that
        are wider scroll by themselves. Nothing is asked for but files, and nothing is complained of."""
        browser = self.browser()
        for path in [self.manual/"index.html", *self.pages()]:
            page = self.open(browser, path)
            for width in WIDTHS:
                page.resize(width, 900)
                self.assertEqual(page.run("[document.documentElement.scrollWidth, document.documentElement.clientWidth]"), [width, width], path)
                if path.stem not in ("genindex", "search"):
                    top, seen, room = page.run(FIRST)
                    self.assertTrue(seen, f"{path}: at {width} pixels the text begins at {top}, or something lies over it")
                    self.assertGreater(room, NARROWEST, f"{path} at {width} pixels")
            self.assertEqual(page.complaints(), [], path)
            self.assertEqual([address for address in page.asked() if not address.startswith(("file://", "data:"))], [], path)
            self.assertEqual(page.run("Array.from(document.images).filter((image) => !image.naturalWidth).map((image) => image.src)"), [], path)
            page.close()

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_the_way_is_reached(self):
        """The last entry beside a long page on a screen; on a telephone it comes by the button above the page."""
        browser, path = self.browser(), self.folder/"docs/manual/keys.html"
        seen = "(({left, top, bottom}) => left >= 0 && top >= 0 && bottom <= innerHeight)((%s).getBoundingClientRect())"
        first, last = "document.querySelector('.sidebar-tree li a')", "Array.from(document.querySelectorAll('.sidebar-tree li a')).at(-1)"
        page = self.open(browser, path)
        self.assertFalse(page.run(seen % last))
        page.run(f"{last}.scrollIntoView({{block: 'center'}})")
        self.assertTrue(page.run(seen % last))
        page = self.open(browser, path, 400)
        self.assertFalse(page.run(seen % first))
        page.run("document.querySelector('.mobile-header label[for=__navigation]').click()")
        page.wait(seen % first, 10)

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_search(self):
        page = self.open(self.browser(), self.folder/"search.html", query="?q=foundation_stiffness")
        page.wait("document.querySelectorAll('ul.search li a').length > 1")
        self.assertIn("keys.html", page.run("Array.from(document.querySelectorAll('ul.search li a'), (found) => found.href).join()"))
        self.assertEqual(page.complaints(), [])

    def test_another_folder_stays(self):
        other = self.place/"other"
        other.mkdir()
        (other/"letter.txt").write_text("mine", encoding="utf-8")
        done = subprocess.run([sys.executable, PROJECT/"tools/manual", "--html", other], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, "something else" in done.stderr, (other/"letter.txt").exists()), (1, True, True), done.stderr)


if __name__ == "__main__":
    unittest.main()
