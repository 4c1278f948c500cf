"""Simulate FMUs fast, compare them with a test bench, and find the physical effect they lack.

    session = pysim.open_session("MyLib.Axis", "measurements", library="MyLib")

A name is imported when it is first used.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.types import BadInput
    from pysim.workflow import open_session

__all__ = ["BadInput", "open_session"]


def __getattr__(name: str) -> Any:
    if name == "open_session":
        from pysim.workflow import open_session

        return open_session
    if name == "BadInput":
        from pysim.types import BadInput

        return BadInput
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
