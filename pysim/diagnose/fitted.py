"""A model of the story at its best point."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.diagnose.subject import Extended
from pysim.identify.greybox.residuals import Point


@dataclass(frozen=True)
class Fitted:
    """A model with or without effects, refitted.

    Args:
        what: the model and its free numbers.
        point: the best one found, with residuals (n_r,) and slopes (n_r, n).
        rough: length of what the smallest change does to the residuals, where that is none of the integration.
    """

    what: Extended
    point: Point
    rough: float = 0.0

    @property
    def name(self) -> str:
        """What the model is made of."""
        return " + ".join(["base", *(e.name for e in self.what.effects)])
