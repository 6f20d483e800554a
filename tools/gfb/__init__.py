"""gfb from Python: `gfb.read`, `gfb.Case`, `gfb.run`, `gfb.study`, `gfb.compare_models`, `gfb.design`, `gfb.optimize`,
`gfb.ross_bearings`; and what is behind the commands of tools/.

What a name needs is imported where it is asked for: the commands of tools/ do without xarray."""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gfb.case import Case, CaseError
    from gfb.design_study import Design, design
    from gfb.door import Result, RunError, run, study
    from gfb.flexible_rotor import Mode, ross_bearings, ross_modes
    from gfb.models import Models, compare_models
    from gfb.optimum import Optimum, optimize
    from gfb.reading import read

__all__ = ["Case", "CaseError", "Design", "Mode", "Models", "Optimum", "Result", "RunError", "compare_models", "design", "optimize",
           "read", "ross_bearings", "ross_modes", "run", "study"]
__version__ = "0.2.0"

_HOMES = {"Case": "gfb.case", "CaseError": "gfb.case", "Result": "gfb.door", "RunError": "gfb.door",
          "study": "gfb.door", "read": "gfb.reading", "Models": "gfb.models", "compare_models": "gfb.models",
          "Design": "gfb.design_study", "design": "gfb.design_study",
          "Mode": "gfb.flexible_rotor", "ross_bearings": "gfb.flexible_rotor", "ross_modes": "gfb.flexible_rotor",
          "Optimum": "gfb.optimum", "optimize": "gfb.optimum"}


def missing(what: str, error: ModuleNotFoundError) -> ImportError:
    """The same error in words that say what needs the package, and where it is to be had."""
    from gfb.tool import missing_words
    return ImportError(f"{what}: {missing_words(error)}", name=error.name)


def __getattr__(name: str) -> object:
    if name == "run" or name in _HOMES:
        try:
            module = importlib.import_module(_HOMES.get(name, "gfb.run"))
        except ModuleNotFoundError as error:
            raise missing(f"gfb.{name}", error) from None
        return module if name == "run" else getattr(module, name)
    raise AttributeError(f"module 'gfb' has no attribute '{name}'")
