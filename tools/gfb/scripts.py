"""Commands of an installed package, `gfb-plot`, `gfb-report`, `gfb-design`, `gfb-coefficients`, `gfb-models`, `gfb-studio`: those of tools/ with the same names."""

import importlib

from gfb.tool import run


def plot():
    """Draws results."""
    return run(lambda: importlib.import_module("gfb.plot.main").main())


def report():
    """Makes a page of results."""
    return run(lambda: importlib.import_module("gfb.report.main").main())


def design():
    """The whole study of a bearing."""
    return run(lambda: importlib.import_module("gfb.design_study").main())


def coefficients():
    """Writes stiffness and damping for other programs."""
    return run(lambda: importlib.import_module("gfb.coefficients").main())


def models():
    """Models of a foil side by side."""
    return run(lambda: importlib.import_module("gfb.models").main())


def studio():
    """A page in the browser."""
    return run(lambda: importlib.import_module("gfb.studio.main").main())
