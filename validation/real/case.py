"""Base models and right effects of five real machines against least squares made independently."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from validation.findings import Finding
from validation.real.fits import fitted
from validation.real.machines import ENVIRONMENT, MACHINES, measured_folder

FITTED, HELD_OUT = 1.03, 1.05  # times the independent error: other optimisers, bounds and sampling


@dataclass(frozen=True)
class Known:
    """An error that was found independently.

    Args:
        machine: name of it.
        effects: in the model, none for the base model.
        error: root mean square residual, fitted and held out, in the unit of the log.
        unit: that unit.
        starts: where the search begins, where nominal sizes do not lead there.
    """

    machine: str
    effects: tuple[str, ...]
    error: tuple[float, float]
    unit: str
    starts: Mapping[str, float] = field(default_factory=dict)


KNOWN = (
    Known("pendulum", (), (3.96e-3, 12.4e-3), "rad"),
    Known("pendulum", ("pendulum.dry_friction",), (3.96e-3, 12.4e-3), "rad"),
    Known("pendulum", ("pendulum.drag",), (2.90e-3, 14.3e-3), "rad"),
    Known("pendulum", ("pendulum.dry_friction", "pendulum.drag"), (1.41e-3, 6.3e-3), "rad"),
    Known("coupled-drives", (), (1.474, 0.876), "V"),
    Known("coupled-drives", ("counter.absolute",), (0.468, 0.638), "V"),
    Known("coupled-drives", ("counter.absolute", "drives.deadband"), (0.324, 0.516), "V"),
    Known("coupled-drives", ("counter.absolute", "drives.rising_gain"), (0.324, 0.297), "V"),
    Known("motor-generator", (), (787.0, 967.0), "1"),
    Known("motor-generator", ("generator.open_circuit",), (128.0, 110.0), "1"),
    Known("motor-generator", ("generator.open_circuit", "generator.friction"), (45.0, 59.0), "1"),
    Known("hair-dryer", (), (0.390, 0.414), "V"),
    Known("hair-dryer", ("dryer.dead_time",), (0.120, 0.145), "V"),
    Known(
        "hair-dryer",
        ("dryer.dead_time", "thermocouple.lag"),
        (0.093, 0.120),
        "V",
        {"dryer.dead_time.tau": 0.16, "T": 0.26, "thermocouple.lag.T_2": 0.13},
    ),
    Known("hydraulic-actuator", (), (0.697, 1.039), "1"),
    Known("hydraulic-actuator", ("valve.direction",), (0.593, 0.736), "1"),
)


def run(root: Path | None = None) -> Iterator[Finding]:
    """Each model is fitted and tried on the logs that are held out.

    Args:
        root: holds the folders of logs; the one that the environment names where None.
    """
    folder = measured_folder(root)
    for known in KNOWN:
        what = f"{known.machine}, {' and '.join(known.effects) or 'base model'}"
        if folder is None:
            skipped = f"no folder with the logs in the environment's {ENVIRONMENT}"
            yield Finding(f"{what}: errors as known", math.nan, FITTED, "", skipped=skipped)
            continue
        error = fitted(MACHINES[known.machine], folder, known.effects, known.starts).error
        for part, of, one, limit in zip(("fitted", "held-out"), known.error, error, (FITTED, HELD_OUT), strict=True):
            claim = f"{what}: {part} error {one:.4g} {known.unit}, known {of:.4g}"
            yield Finding(claim, one / of, limit, "times that")
