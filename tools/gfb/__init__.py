"""gfb from Python: `gfb.read`, `gfb.Case`, `gfb.run`, `gfb.study`, `gfb.compare_models`, `gfb.design`, `gfb.optimize`,
`gfb.ross_bearings`; and what is behind the commands of tools/.

What a name needs is imported where it is asked for: the commands of tools/ do without xarray."""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gfb import results as results
    from gfb.case import Case, CaseError
    from gfb.design_study import Design, design
    from gfb.flexible_rotor import Mode, ross_bearings, ross_modes
    from gfb.models import Models, compare_models
    from gfb.optimum import Optimum, optimize
    from gfb.reading import read
    from gfb.running import Result, run
    from gfb.studies import study
    from gfb.tool import RunError

__all__ = ["Case", "CaseError", "Design", "Mode", "Models", "Optimum", "Result", "RunError", "compare_models", "design", "optimize",
           "read", "ross_bearings", "ross_modes", "run", "study"]
__version__ = "0.2.0"

_HOMES = {"gfb.case": ("Case", "CaseError"), "gfb.design_study": ("Design", "design"),
          "gfb.flexible_rotor": ("Mode", "ross_bearings", "ross_modes"), "gfb.models": ("Models", "compare_models"),
          "gfb.optimum": ("Optimum", "optimize"), "gfb.reading": ("read",), "gfb.running": ("Result", "run"), "gfb.studies": ("study",),
          "gfb.tool": ("RunError",)}


def __getattr__(name: str) -> object:
    for home, names in _HOMES.items():
        if name in names:
            try:
                return getattr(importlib.import_module(home), name)
            except ModuleNotFoundError as error:
                from gfb.tool import without  # only now: whoever imports gfb waits for nothing
                raise without(f"gfb.{name}", error) from None
    if name == "results":
        return importlib.import_module("gfb.results")
    raise AttributeError(f"module 'gfb' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
