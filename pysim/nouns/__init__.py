"""What a user of Python holds and does: six nouns, which are values that never change, and their verbs.

`pysim` itself shows the verbs. A noun prints in a few lines, gives tables, draws itself with `plot()`, and is a thin
face of what `pysim.workflow` opens and `pysim.present` shows.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.nouns.comparison import Comparison
    from pysim.nouns.data import Data
    from pysim.nouns.diagnosis import Diagnosis
    from pysim.nouns.effect import Effect
    from pysim.nouns.fit import Fit
    from pysim.nouns.model import Model

__all__ = ["Comparison", "Data", "Diagnosis", "Effect", "Fit", "Model"]


def __getattr__(name: str) -> Any:
    if name in __all__:
        return getattr(import_module(f"{__name__}.{name.lower()}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
