"""One frequency response test: which signal swings how, and which one answers."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pysim.types.errors import BadInput


@dataclass(frozen=True)
class SineTest:
    """The command is `amplitude` sin(2 pi f t) + `offset`, at one frequency f after the other (thesis Eq. 2.1).

    Args:
        offset: what the command swings around, in the input's unit.
        amplitude: positive, in the input's unit.
        input: name of the commanded signal.
        output: name of the responding signal.
    Raises:
        BadInput: an amplitude that is not positive, or a number that is not finite.
    """

    offset: float
    amplitude: float
    input: str
    output: str

    def __post_init__(self) -> None:
        if not (self.amplitude > 0 and math.isfinite(self.amplitude) and math.isfinite(self.offset)):
            raise BadInput(
                f"sine test: the amplitude must be positive and both numbers finite, "
                f"got amplitude {self.amplitude} at offset {self.offset}"
            )

    @property
    def label(self) -> str:
        """Short name with signs, as in the thesis' file names: O+25 A5."""
        return self.label_in(1.0)

    def label_in(self, factor: float) -> str:
        """The same in another unit, of which the input's unit is that many."""
        return f"O{factor * self.offset:+g} A{factor * self.amplitude:g}"
