"""The workbench: a page in the browser on a project folder. A name is imported when it is first used."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.app.server import serve
    from pysim.app.upload import Limits

_HOMES = {"Limits": "pysim.app.upload", "serve": "pysim.app.server"}
__all__ = ["Limits", "serve"]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
