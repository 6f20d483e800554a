"""Tests of the documentation: every link and picture exists, every page is reachable from the index."""

import os
import pathlib
import re
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
LINK = re.compile(r"\]\(([^)\s]*)\)")
BLOCK = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)


def links(page):
    """(target, anchor) of the links and pictures in a page that are not on the net."""
    text = BLOCK.sub("", page.read_text(encoding="utf-8"))
    return [target.partition("#")[::2] for target in LINK.findall(text) if "://" not in target]


def anchors(page):
    """Names of a page's headings, as a browser of Markdown makes them."""
    heads = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def broken(page):
    """The links of a page that lead nowhere."""
    found = []
    for target, anchor in links(page):
        path = page.parent/target if target else page
        if not path.exists() or (anchor and anchor not in anchors(path)):
            found.append(f"{target}#{anchor}" if anchor else target)
    return found


def reachable(start):
    """All pages to which links lead from a page."""
    found, new = set(), [start.resolve()]
    while new:
        page = new.pop()
        if page in found or not page.exists():
            continue
        found.add(page)
        new += [(page.parent/target).resolve() for target, _ in links(page) if target.endswith(".md")]
    return found


class Links(unittest.TestCase):
    """The checker itself."""

    def test_what_is_missing_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder)/"page.md"
            page.write_text("# One head\n[a](page.md#one-head) [b](#two) ![c](none.png) [d](https://a.b/c) `[e](f)`\n",
                            encoding="utf-8")
            self.assertEqual(broken(page), ["#two", "none.png"])
            self.assertEqual(reachable(page), {page.resolve()})


class Documentation(unittest.TestCase):
    """README.md and docs/."""

    def setUp(self):
        self.index = PROJECT/"docs/README.md"
        self.pages = sorted((PROJECT/"docs").rglob("*.md"))
        self.assertGreater(len(self.pages), 15)

    def test_every_link_leads_somewhere(self):
        for page in [PROJECT/"README.md", *self.pages]:
            self.assertEqual(broken(page), [], page)

    def test_every_page_is_reachable_from_the_index(self):
        found = reachable(self.index)
        self.assertIn((PROJECT/"README.md").resolve(), found)
        self.assertEqual([page for page in self.pages if page.resolve() not in found], [])

    def test_every_picture_is_shown(self):
        shown = {(page.parent/target).resolve() for page in [PROJECT/"README.md", *self.pages] for target, _ in links(page)}
        self.assertEqual([path for path in (PROJECT/"docs").rglob("*.png") if path.resolve() not in shown], [])


if __name__ == "__main__":
    unittest.main()
