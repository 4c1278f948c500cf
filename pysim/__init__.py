"""From logs to what a model lacks: load, model, compare, fit, diagnose, locate; effects and controllers of your own.

    data = pysim.load("logs/*.csv", inputs="F", outputs="x").hold_out("run3")
    axis = pysim.model("MyLib.Axis", library="MyLib")
    why = pysim.diagnose(pysim.fit(axis, data))

A name is imported when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.nouns import Comparison, Data, Diagnosis, Effect, Fit, Model
    from pysim.nouns.comparison import compare
    from pysim.nouns.cosimulation import cosimulate
    from pysim.nouns.data import load
    from pysim.nouns.diagnosis import diagnose, locate
    from pysim.nouns.effect import effect
    from pysim.nouns.example import example
    from pysim.nouns.fit import fit
    from pysim.nouns.model import model
    from pysim.types import BadInput, SimulationError
    from pysim.workflow import open_session

_FILES = {
    "nouns": ("Comparison", "Data", "Diagnosis", "Effect", "Fit", "Model"),
    "nouns.comparison": ("compare",),
    "nouns.cosimulation": ("cosimulate",),
    "nouns.data": ("load",),
    "nouns.diagnosis": ("diagnose", "locate"),
    "nouns.effect": ("effect",),
    "nouns.example": ("example",),
    "nouns.fit": ("fit",),
    "nouns.model": ("model",),
    "types": ("BadInput", "SimulationError"),
    "workflow": ("open_session",),
}
__all__ = [
    "BadInput",
    "Comparison",
    "Data",
    "Diagnosis",
    "Effect",
    "Fit",
    "Model",
    "SimulationError",
    "compare",
    "cosimulate",
    "diagnose",
    "effect",
    "example",
    "fit",
    "load",
    "locate",
    "model",
    "open_session",
]


def __getattr__(name: str) -> Any:
    for file, names in _FILES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{file}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
