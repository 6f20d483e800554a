"""Tests of the documentation: every link and picture exists, every page is reachable from the index, no sentence is too long."""

import os
import pathlib
import re
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
LINK = re.compile(r"\]\(([^)\s]*)\)")
BLOCK = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
EQUATION = re.compile(r"^\$\$.*?\$\$$", re.MULTILINE | re.DOTALL)
ITEM = re.compile(r"\n(?= *(?:[-*]|\d+\.) )|\n\s*\n|\||^#+ .*$", re.MULTILINE)  # a new item, paragraph, cell of a table, and headings
END = re.compile(r"(?<=[.!?])[\"')*]*\s+(?=[A-Z`*\[$0-9\"(-])")
MOST_WORDS = 44  # of a sentence


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


def long_sentences(text):
    """Sentences with too many words; code and what stands between dollars are a word each, targets of links none."""
    text = EQUATION.sub("\n\n", re.sub(r"^ *```.*?^ *```$", "\n\n", text, flags=re.MULTILINE | re.DOTALL))
    text = re.sub(r"`[^`]*`|\$[^$\n]*\$", "Code", re.sub(r"\]\([^)]*\)", "]", text))
    sentences = (sentence for part in ITEM.split(text) for sentence in END.split(part or ""))
    return [" ".join(sentence.split()) for sentence in sentences if len(re.findall(r"\S*\w\S*", sentence)) > MOST_WORDS]


class Links(unittest.TestCase):
    """The checker itself."""

    def test_what_is_missing_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder)/"page.md"
            page.write_text("# One head\n[a](page.md#one-head) [b](#two) ![c](none.png) [d](https://a.b/c) `[e](f)`\n",
                            encoding="utf-8")
            self.assertEqual(broken(page), ["#two", "none.png"])
            self.assertEqual(reachable(page), {page.resolve()})


class Sentences(unittest.TestCase):
    """The counter itself, and every page that people read."""

    def test_a_long_sentence_is_found(self):
        longest = " ".join(MOST_WORDS*["word"])
        for text in (f"{longest} more.", f"Short. {longest}\nmore. Short.", f"- item\n- {longest} `a b c`", f"| {longest} more | cell |"):
            self.assertEqual(len(long_sentences(text)), 1, text)
        for text in (f"{longest}. More.", f"- {longest}\n- more", f"| {longest} | more |", f"```\n{longest} more\n```\n",
                     f"{longest[5:]} [`a b c`](where it leads)", f"$$ {longest} more $$\n"):
            self.assertEqual(long_sentences(text), [], text)

    def test_no_sentence_is_too_long(self):
        pages = [*PROJECT.glob("*.md"), *(PROJECT/"docs").glob("*.md"), *(PROJECT/"docs/manual").glob("*.md"), *(PROJECT/"docs/developer").glob("*.md")]
        found = {str(page.relative_to(PROJECT)): long_sentences(page.read_text(encoding="utf-8")) for page in pages if page.name != "CHANGELOG.md"}
        self.assertEqual({page: sentences for page, sentences in found.items() if sentences}, {})


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


class Tables(unittest.TestCase):
    """Tables that say where a claim is held."""

    def rows(self, page, heading):
        """Links of each row behind a heading: a list of targets a cell."""
        text = (PROJECT/page).read_text(encoding="utf-8").partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
        rows = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| ") and not line.startswith("| ---")]
        self.assertGreater(len(rows), 10)
        return [[LINK.findall(cell) for cell in row] for row in rows[1:]], [row[0] for row in rows[1:]]

    def test_each_claim_names_its_script(self):
        rows, claims = self.rows("docs/developer/tests.md", "What is verified")
        self.assertEqual([claim for row, claim in zip(rows, claims) if not any("/tests/" in target for target in row[-1])], [])

    def test_each_equation_has_a_module_a_unit_test_that_uses_it_and_an_outside(self):
        folder = PROJECT/"docs/manual"
        rows, names = self.rows("docs/manual/equations.md", "Where each equation is, and what tests it")
        for (_, modules, units, outside), name in zip(rows, names):
            used = "".join((folder/unit).read_text(encoding="utf-8") for unit in units)
            self.assertTrue(modules and outside, name)
            self.assertEqual([module for module in modules if f"use gfb_{pathlib.PurePath(module).stem}," not in used], [], name)


if __name__ == "__main__":
    unittest.main()
