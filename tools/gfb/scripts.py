"""Commands of an installed package, `gfb-plot`, `gfb-report`, `gfb-design`, `gfb-coefficients`, `gfb-models`, `gfb-studio`: those of tools/ with the same names."""

import importlib
from collections.abc import Callable

from gfb.tool import run


def main_of(module: str) -> Callable[[], int]:
    """The main of a module as a command, imported when it is called."""
    return lambda: run(lambda: importlib.import_module(module).main())


plot = main_of("gfb.plot.main")
report = main_of("gfb.report.main")
design = main_of("gfb.design_study")
coefficients = main_of("gfb.coefficients")
models = main_of("gfb.models")
studio = main_of("gfb.studio.main")
