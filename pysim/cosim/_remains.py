"""What a run leaves behind in a block beside the state that it gives: the next run would begin from it, unsaid."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pysim.control import Block
from pysim.types import BadInput

Numbers = Mapping[str, NDArray[np.float64]]


class Remains:
    """A block's attributes that are numbers, as its last run found them and as it left them.

    What somebody else has set in between is his to set. A row that has grown is a log, and no run's beginning.
    """

    def __init__(self) -> None:
        self._found: Numbers = {}
        self._left: Numbers = {}

    def begin(self, name: str, block: Block, initial: tuple[float, ...]) -> None:
        """Put a block into its initial state.

        Raises:
            BadInput: a number that the run before has changed is not brought back by that.
        """
        before = _numbers(block)
        block.restore(initial)
        now = _numbers(block)
        for attribute, value in now.items():
            untouched = _same(before.get(attribute), self._left.get(attribute))
            found = self._found.get(attribute)
            if untouched and found is not None and found.shape == value.shape and not _same(found, value):
                raise BadInput(
                    f"{name}: the run before has changed its {attribute}, which restore does not bring back; return "
                    f"{attribute} from state too, and set it in restore"
                )
        self._found = now

    def end(self, block: Block) -> None:
        """The run is over."""
        self._left = _numbers(block)


def _same(one: NDArray[np.float64] | None, other: NDArray[np.float64] | None) -> bool:
    return one is not None and other is not None and np.array_equal(one, other, equal_nan=True)


def _numbers(block: Block) -> Numbers:
    found = {}
    for name, value in getattr(block, "__dict__", {}).items():
        try:
            found[name] = np.array(value, dtype=np.float64)
        except (TypeError, ValueError, OverflowError):
            continue
    return found
