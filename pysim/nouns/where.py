"""Where a model fails: by log, signal, time, frequency, and range of the signals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from pysim.nouns.table import Shown, Table
from pysim.types.answer import Failure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class Where(Shown):
    """Regions of the measurements, the worst first.

    Args:
        failures: each with its residual in standard deviations of the noise.
    """

    failures: tuple[Failure, ...]

    @property
    def table(self) -> Table:
        """Log, signal, region and residual over noise."""
        rows = [(one.record, one.signal, one.region, one.error) for one in self.failures]
        return Table.of(("log", "signal", "region", "residual over noise"), rows)

    def plot(self) -> Figure:
        """The worst of them as bars."""
        from pysim.present.overlay import regions_figure

        return regions_figure(self.failures)
