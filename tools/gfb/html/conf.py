"""What Sphinx makes of README.md, CHANGELOG.md and docs/; the pages stay as they are, the index gets a way through them."""

import os
import re

from gfb import __version__
from gfb.tool import ROOT

project, author, copyright = "gfb", "The gfb developers", "The gfb developers"  # noqa: A001 (Sphinx's name)
version = release = __version__
extensions = ["myst_parser", "sphinx.ext.mathjax"]
include_patterns = ["README.md", "CHANGELOG.md", "docs/**"]
exclude_patterns = ["build", "results", "src", "tests", "tools"]
root_doc = "docs/README"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_update_mathjax = False  # that is for MathJax 3; Debian has 2
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"SVG": {"linebreaks": {"automatic": True}}}
html_theme = "furo"
html_title = "gfb"
html_sidebars = {"**": ["sidebar/brand.html", "version.html", "sidebar/search.html", "sidebar/scroll-start.html", "sidebar/navigation.html", "sidebar/scroll-end.html"]}
templates_path = ["templates"]
html_static_path, html_css_files = ["static"], ["manual.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_search_summary = False  # a browser reads no other page of a folder

WAY = {
    "Tutorials": ["README", "first_steps", "first_bearing", "first_thrust_bearing", "data_sheet", "first_sweep", "misaligned_shaft",
                  "three_pad_rotor", "flexible_rotor", "first_strip"],
    "Static answers": ["model_and_mesh", "bearing", "pads", "thrust", "cone", "gas_and_bore", "heat", "assembly", "capacity", "branches", "sweeps",
                       "accuracy"],
    "Dynamics": ["coefficients", "stability", "foil_damping", "state_space", "transient", "periodic"],
    "Strips": ["strip", "strips_as_built"],
    "Design and statistics": ["design", "sensitivity", "optimize", "sample"],
    "Running": ["no_answer", "failures", "restart", "ensembles", "cluster", "linear_solvers", "python", "studio", "*"],
    "Reference": ["keys", "results", "result_files", "CHANGELOG", "glossary", "references"],
    "Theory": ["frame", "equations", "method", "companions"],
    "Measured": ["gallery/README", "bearings", "comparisons", "dynamics", "work_precision", "scaling", "hard_cases", "*"],
    "Developers": ["*"],
}
MODULES = {root_doc: "../api/index.html", "docs/developer/architecture": "../../api/index.html"}  # links to FORD's pages
PLACES = {"Measured": "docs/measured", "Developers": "docs/developer"}


def place(name, part):
    """The page of a name in the way."""
    return f"/{name}" if name in ("README", "CHANGELOG") else f"/{PLACES.get(part, 'docs/manual')}/{name}"


def pages(part, names):
    """The pages of a part; * is what no part names."""
    named = {place(name, other) for other, others in WAY.items() for name in others}
    found = [place(name, part) for name in names if name != "*"]
    if "*" in names:
        every = (f"/{path.relative_to(ROOT).with_suffix('')}" for path in sorted((ROOT/PLACES.get(part, "docs/manual")).glob("*.md")))
        found += [page for page in every if page not in named]
    return found


def add_way(app, name, source):
    """Tables of contents, which browsers of Markdown would show as they are: of the index, and of the gallery."""
    if name == root_doc:
        for part, names in WAY.items():
            source[0] += "\n".join(["", "```{toctree}", ":hidden:", ":maxdepth: 1", f":caption: {part}", "", *pages(part, names), "```", ""])
    if name == "docs/measured/gallery/README":
        source[0] += "\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"
    if name in MODULES and os.environ.get("GFB_MODULES"):
        source[0] += f'\n<p><a href="{MODULES[name]}">All modules, procedures and types of the program</a>, by FORD.</p>\n'
    source[0] = re.sub(r"\[(\w+)\.md\]\(", r"[\1](", source[0])  # a page is no file here
    # A link to a folder or to a file that is no page: the words stay.
    source[0] = re.sub(r"(?<!!)\[([^\]\n]+)\]\((?!\w+://|#)([^)\s]*/|[^)\s#]*\.(?!md|png)\w+|[^)\s#]*/[^.)\s#]+|LICENSE)\)", r"\1", source[0])


def setup(app):
    """Sphinx calls this first."""
    app.connect("source-read", add_way)
