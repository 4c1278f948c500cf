"""Where a model fails: by log, signal, time, frequency, and range of the signals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pysim.nouns.table import Table
from pysim.types.answer import Failure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class Where:
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

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame."""
        return self.table.to_dataframe()

    def plot(self) -> Figure:
        """The worst of them as bars."""
        from pysim.present.overlay import regions_figure

        return regions_figure(self.failures)

    def __repr__(self) -> str:
        return repr(self.table)

    def _repr_html_(self) -> str:
        return self.table.html()
