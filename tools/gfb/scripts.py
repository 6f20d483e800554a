"""Commands of an installed package, `gfb-plot`, `gfb-report`, `gfb-coefficients`: those of tools/ with the same names."""

import importlib

from gfb.tool import run


def plot():
    """Draws results."""
    return run(lambda: importlib.import_module("gfb.plot.main").main())


def report():
    """Makes a page of results."""
    return run(lambda: importlib.import_module("gfb.report.main").main())


def coefficients():
    """Writes stiffness and damping for other programs."""
    return run(lambda: importlib.import_module("gfb.coefficients").main())
