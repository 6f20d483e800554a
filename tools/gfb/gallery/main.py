"""Makes the gallery: what gfb says to every result of [Gu2020], a page each, with picture, numbers and judgement.

Runs the cases it needs (ten minutes and more for all pages; some shells take 1 GB) and writes pages and pictures.
"""

import argparse
import pathlib

from gfb.tool import MEASURED, ROOT, draw_into_files, stop

draw_into_files()

from gfb.gallery import contact, field, film, frame, orbit, position, strip, tilt, torque  # noqa: E402 (after the kind of picture)
from gfb.gallery.page import Page, write_index  # noqa: E402
from gfb.gallery.runs import Runs  # noqa: E402
from gfb.program import find_gfb  # noqa: E402

PAGES = {  # name: what makes the page; frame, contact: pictures of docs/manual/frame.md and equations.md
    "frame": frame.draw_frame,
    "contact": contact.draw_contact,
    "section41": strip.draw_cost,
    "fig7a": strip.draw_uniform,
    "fig7b": strip.draw_increasing,
    "fig8a": strip.draw_four,
    "fig8b": strip.draw_six,
    "fig9": film.draw_fig9,
    "fig10": film.draw_fig10,
    "positions": position.draw,
    "section43": tilt.draw_statements,
    "fig11a": torque.draw_about_x,
    "fig11b": torque.draw_about_y,
    "fig12": field.draw_pressures,
    "fig13": field.draw_films,
    "orbit": orbit.draw,
}


def main():
    parser = argparse.ArgumentParser(prog="tools/gallery", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="NAME[,NAME...]", type=page_names, default=list(PAGES),
                        help=f"only these of the pages: {', '.join(PAGES)}")
    parser.add_argument("--reuse", action="store_true", help="take runs of the same case text and program from --runs")
    parser.add_argument("--jobs", metavar="N", type=int, default=1,
                        help="runs at a time, at most; default: %(default)s")
    parser.add_argument("--quick", action="store_true", help="without the tables of what the paper leaves open, and without finer meshes")
    parser.add_argument("--gfb", metavar="PROGRAM", help="the program; default: build/release/gfb")
    parser.add_argument("--output", metavar="DIR", type=pathlib.Path,
                        help="folder of pages and pictures; default: docs/measured/gallery of this checkout")
    parser.add_argument("--runs", metavar="DIR", type=pathlib.Path, default=ROOT/"build/gallery",
                        help="folder of the runs; default: build/gallery of this checkout")
    options = parser.parse_args()
    if options.quick and options.output is None:
        parser.error("--quick needs --output: the gallery itself is complete")
    options.output = options.output or MEASURED/"gallery"
    if options.jobs < 1:
        stop("--jobs: at least 1")
    runs = Runs(find_gfb(options.gfb), options.runs, options.reuse, options.jobs, options.quick)
    for folder in (options.output, options.runs):
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            stop(f"{folder}: {error.strerror}", 3)
    for name in options.only:
        print(f"{name}:", flush=True)
        try:
            made = PAGES[name](runs, options.output)
            path = made.write() if isinstance(made, Page) else made
        except OSError as error:  # a run that --reuse has found among them
            stop(str(error))
        print(f"  written: {path}", flush=True)
    write_index(options.output, PAGES)
    return 0


def page_names(text):
    """The names of --only, in the order of the gallery."""
    names = text.split(",")
    unknown = [name for name in names if name not in PAGES]
    if unknown:
        raise argparse.ArgumentTypeError(f"no page {', '.join(unknown)}; there are: {', '.join(PAGES)}")
    return [name for name in PAGES if name in names]
