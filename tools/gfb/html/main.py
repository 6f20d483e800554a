"""tools/manual --html: the pages by Sphinx and MyST, those of the modules by FORD, equations by a MathJax beside them.

A version has a folder of its own, which may be moved or copied as a whole; the page above leads to all that stand there.
"""

import html
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from gfb import __version__
from gfb.tool import ROOT, say, stop

HERE = pathlib.Path(__file__).parent
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# What TeX drawn as SVG takes.
PARTS = ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG/autoload",
         "jax/output/SVG/jax.js", "jax/output/SVG/config.js", "jax/output/SVG/fonts/TeX")
BOOTSTRAP = pathlib.Path("/usr/share/javascript/bootstrap5")  # the style of FORD's pages
BOOTSTRAP_PARTS = ("css/bootstrap.min.css", "js/bootstrap.bundle.min.js")
BOOTSTRAP_OF_FORD = re.compile(r'(src|href)="https://[^"]*/((?:css|js)/bootstrap[^"/]*\.min\.(?:css|js))"((?: rel="stylesheet")?)[^>]*>')
MATHJAX_OF_FORD = re.compile(r'<script src="https://[^"]*/MathJax\.js\?[^>]*></script>')
START = '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>gfb</title><meta http-equiv="refresh" content="0; url=docs/README.html">\n'
INDEX = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>gfb: versions of the manual</title>
<style>body {{ font: 17px/1.5 sans-serif; color: #222; max-width: 40em; margin: 2em auto; padding: 0 1em }} a {{ color: #004b6b }}</style>
<h1>gfb</h1>
<p>The manual, by version, the newest first:</p>
<ul>
{items}
</ul>
</html>
"""


def make_manual(place):
    """Builds this version's pages anew in a folder of its own, and the page that leads to all versions."""
    foreign = [path.name for path in sorted(place.iterdir()) if path.name != "index.html" and not is_manual(path)] if place.exists() else []
    if foreign:
        stop(f"{place}: holds something else than pages of the manual, a folder a version: {', '.join(foreign)}")
    make_pages(place/__version__)
    (place/"index.html").write_text(index_of(versions_in(place)), encoding="utf-8")
    print(f"written: {place/'index.html'}")
    return 0


def is_manual(folder):
    """Whether a folder holds pages that Sphinx has made."""
    return (folder/"objects.inv").exists()


def versions_in(place):
    """The versions whose pages are there, the newest first."""
    found = [path.name for path in place.iterdir() if is_manual(path)]
    return sorted(found, key=lambda name: [(word.isdigit(), int(word) if word.isdigit() else word) for word in re.split(r"[.-]", name)], reverse=True)


def index_of(versions):
    """The page that leads to all versions."""
    return INDEX.format(items="\n".join(f'<li><a href="{html.escape(name)}/docs/README.html">Version {html.escape(name)}</a></li>' for name in versions))


def make_pages(folder):
    """Builds the pages anew; a warning, such as a link that leads nowhere, is a failure."""
    if not (MATHJAX/"MathJax.js").exists():
        stop(f"{MATHJAX} is missing; with apt:\n  apt-get install libjs-mathjax", 3)
    ford = find_ford()
    if ford and not BOOTSTRAP.exists():
        stop(f"{BOOTSTRAP} is missing, the style of FORD's pages; with apt:\n  apt-get install libjs-bootstrap5", 3)
    shutil.rmtree(folder, ignore_errors=True)
    with tempfile.TemporaryDirectory() as trees:
        command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-d", trees, "-c", str(HERE), str(ROOT), str(folder)]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, cwd=HERE,  # -m looks there first
                              env={**os.environ, "PYTHONPATH": str(ROOT/"tools"), "GFB_MODULES": "yes" if ford else ""})
    if done.returncode != 0:
        stop(f"Sphinx complains:\n{(done.stdout + done.stderr).strip()}")
    for part in PARTS:
        source, target = MATHJAX/part, folder/"_static/mathjax"/part
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if source.is_dir() else shutil.copyfile)(source, target)
    if ford:
        make_modules(ford, folder/"api")
    else:
        say("without the pages of the modules: ford is missing (pip install ford)")
    (folder/"index.html").write_text(START, encoding="utf-8")


def find_ford():
    """The command of FORD; none where it is not installed."""
    if importlib.util.find_spec("ford"):
        return [sys.executable, "-m", "ford"]
    found = shutil.which("ford")
    return [found] if found else None


def make_modules(ford, folder):
    """Pages of all modules, with the MathJax of the others and a style sheet beside it: nothing comes from the net."""
    done = subprocess.run([*ford, "--output_dir", str(folder), str(HERE/"ford.md")], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False, cwd=HERE)
    if done.returncode != 0 or not (folder/"index.html").exists():
        stop(f"FORD complains:\n{(done.stdout + done.stderr).strip()[-2000:]}")
    for part in BOOTSTRAP_PARTS:
        (folder/part).parent.mkdir(exist_ok=True)
        shutil.copyfile(BOOTSTRAP/part, folder/part)
    for page in folder.rglob("*.html"):
        root = "../"*(len(page.relative_to(folder).parts) - 1)
        text = page.read_text(encoding="utf-8")
        text = MATHJAX_OF_FORD.sub(f'<script src="{root}../_static/mathjax/MathJax.js?config=TeX-AMS_SVG" async></script>', text)
        page.write_text(BOOTSTRAP_OF_FORD.sub(rf'\1="{root}\2"\3>', text), encoding="utf-8")
