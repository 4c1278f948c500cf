"""Co-simulation: coupled oscillators in closed form, the rig against its monolithic model, cost of a step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from matplotlib.figure import Figure

from validation.cosim import bench, oscillators, speed
from validation.cosim.pictures import bench_figure, order_figure
from validation.findings import Finding


def run() -> Iterator[Finding]:
    """All claims."""
    yield from oscillators.findings()
    yield from bench.findings()
    yield from speed.findings()


def pictures() -> Mapping[str, Figure]:
    """Convergence, and the rig's run with its difference to the monolithic model."""
    return {
        "Largest error and energy residual of two coupled oscillators over the communication step": order_figure(),
        "The rig under its controllers, and what differs from the monolithic model": bench_figure(),
    }
