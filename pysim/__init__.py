"""From logs to what a model lacks: load, model, compare, fit, diagnose, locate; effects and controllers of your own.

    data = pysim.load("logs/*.csv", inputs="F", outputs="x").hold_out("run3")
    axis = pysim.model("MyLib.Axis", library="MyLib")
    why = pysim.diagnose(pysim.fit(axis, data))

A name is imported when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.nouns.comparison import compare
    from pysim.nouns.cosimulation import cosimulate
    from pysim.nouns.data import load
    from pysim.nouns.diagnosis import diagnose, locate
    from pysim.nouns.effect import effect
    from pysim.nouns.example import example
    from pysim.nouns.fit import fit
    from pysim.nouns.model import model
    from pysim.types import BadInput
    from pysim.workflow import open_session

_HOMES = {
    "BadInput": "pysim.types",
    "compare": "pysim.nouns.comparison",
    "cosimulate": "pysim.nouns.cosimulation",
    "diagnose": "pysim.nouns.diagnosis",
    "effect": "pysim.nouns.effect",
    "example": "pysim.nouns.example",
    "fit": "pysim.nouns.fit",
    "load": "pysim.nouns.data",
    "locate": "pysim.nouns.diagnosis",
    "model": "pysim.nouns.model",
    "open_session": "pysim.workflow",
}
__all__ = [
    "BadInput",
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
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
