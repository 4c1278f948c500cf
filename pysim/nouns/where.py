"""Where a model fails: by log, signal, time, frequency, and range of the signals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pysim.nouns.table import Shown, Table
from pysim.types.answer import Failure


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

    def plot(self, *, interactive: bool = False) -> Any:
        """The worst of them as bars; a Plotly figure where `interactive`."""
        from pysim.present.charts import as_plotly
        from pysim.present.overlay import regions_chart, regions_figure

        return as_plotly(regions_chart(self.failures)) if interactive else regions_figure(self.failures)
