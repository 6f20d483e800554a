"""Puts the tables that gfb prints into the manual; with --check only compares.

  gfb --keys       every key of a case file    docs/manual/keys.md: a table a group
  gfb --results    every name of a result      docs/manual/results.md
                   what the files hold         docs/manual/result_files.md: found in small runs
  gfb --help       options                     share/: man page, completion of bash, zsh and fish
                   exit statuses               docs/manual/results.md
  gfb --results    names for type checkers     tools/gfb/result_names.py

  --html           all pages as HTML that reads offline   build/manual/VERSION/, and index.html above it, which leads to
                                                          all versions that are there

A table stands between two lines such as `<!-- keys -->` and `<!-- end of keys -->`. Exit status: 0 the manual is as it
should be, 1 it differs or has no such place.
"""

import argparse
import difflib
import pathlib
import re
import sys

from gfb.key_tables import key_tables
from gfb.layout import layout_tables
from gfb.program import call, find_gfb, printed_table
from gfb.result_table import names_module
from gfb.shell import pages
from gfb.tool import ROOT, need_packages, stop

TABLES = ("keys", "results")  # an option of gfb and a page each


def table_of(gfb, name):
    """What stands in a page: of the keys a table a group."""
    table = printed_table(gfb, name)
    return key_tables(table) if name == "keys" else table


def place_of(text, name, path):
    """Where the table stands in a page."""
    found = re.search(rf"(?<=^<!-- {name} -->\n)(.*?)(?=^<!-- end of {name} -->$)", text, re.MULTILINE | re.DOTALL)
    if found is None:
        stop(f"{path}: no lines '<!-- {name} -->' and '<!-- end of {name} -->'")
    return found


def main():
    parser = argparse.ArgumentParser(prog="tools/manual", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing, show what differs")
    parser.add_argument("--gfb", metavar="PROGRAM", help="the program; default: build/release/gfb")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT/"docs/manual", metavar="DIR",
                        help="folder of the pages; default: docs/manual of this checkout")
    parser.add_argument("--share", type=pathlib.Path, default=ROOT/"share", metavar="DIR",
                        help="folder of man page and completions; default: share of this checkout")
    parser.add_argument("--names", type=pathlib.Path, default=ROOT/"tools/gfb/result_names.py", metavar="FILE",
                        help="names of results for type checkers; default: tools/gfb/result_names.py of this checkout")
    parser.add_argument("--html", type=pathlib.Path, nargs="?", const=ROOT/"build/manual", metavar="DIR",
                        help="only make this version's HTML pages in DIR, by default build/manual; needs Sphinx, MyST, Furo and MathJax")
    options = parser.parse_args()
    if options.html:
        need_packages("sphinx", "myst_parser", "furo")
        from gfb.html.main import make_manual  # what else tools/manual does needs no Sphinx
        return make_manual(options.html.resolve())
    gfb = find_gfb(options.gfb)
    differ = [name for name in TABLES if not renew(gfb, name, options.folder/f"{name}.md", options.check)]
    if not renew(gfb, "exit statuses", options.folder/"results.md", options.check, statuses_of(gfb)):
        differ.append("exit statuses")
    if not renew(gfb, "result files", options.folder/"result_files.md", options.check, layout_tables(gfb)):
        differ.append("result files")
    differ += [path for path, content in made_of_help(gfb).items() if not renew_file(options.share/path, content, options.check)]
    if not renew_file(options.names, names_module(printed_table(gfb, "results")), options.check):
        differ.append(str(options.names))
    if differ:
        stop(f"these are not those of gfb: {', '.join(differ)}; call tools/manual")
    return 0


def made_of_help(gfb):
    """{path in share: content}."""
    done, version = call([gfb, "--help"]), call([gfb, "--version"])
    if done.status != 0 or version.status != 0:
        stop(f"{gfb} --help ended with status {done.status}:\n{done.complaint}", 3)
    return pages(done.log, version.log.split()[1])


def renew_file(path, content, only_check):
    """Writes a file that is not as it should be, or says so; whether it is."""
    if path.exists() and path.read_text(encoding="utf-8") == content:
        return True
    if not only_check:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")
        print(f"{path}: written")
    return not only_check


def statuses_of(gfb):
    """Table of the exit statuses that gfb --help names, with a comma between two of them."""
    done = call([gfb, "--help"])
    listed = re.search(r"^exit status: (.*)\Z", done.log, re.MULTILINE | re.DOTALL)
    told = listed[1] if listed else ""
    rows = re.findall(r"(\d+(?: \+ N)?) (\D.*?)(?=, \d|$)", " ".join(re.sub(r"\(.*?\)", "", told).split()))
    if done.status != 0 or not rows:
        stop(f"{gfb} --help: no exit statuses; is it gfb?")
    examples = re.findall(r"(\d+) by ([^\s,)]+)", told)
    more = "; " + ", ".join(f"{number}: by {signal}" for number, signal in examples) if examples else ""
    return "| exit status | meaning |\n| ---: | --- |\n" + "".join(
        f"| {status} | {meaning.strip()}{more if 'N' in status else ''} |\n" for status, meaning in rows)


def renew(gfb, name, path, only_check, table=None):
    """Brings a page up to date, or shows how it differs; whether it is as it should be."""
    text, table = path.read_text(encoding="utf-8"), table or table_of(gfb, name)
    found = place_of(text, name, path)
    if table == found[0]:
        return True
    if only_check:
        sys.stdout.writelines(difflib.unified_diff(found[0].splitlines(True), table.splitlines(True), str(path),
                                                   f"gfb --{name}"))
        return False
    path.write_text(text[:found.start()] + table + text[found.end():], encoding="utf-8")
    print(f"{path}: table renewed")
    return True
