"""What a reader is told of nuisances and of how residuals are counted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pysim.diagnose.corrections import Nuisance
from pysim.diagnose.nuisance import GAIN, OFFSET
from pysim.diagnose.residuals import Ruler
from pysim.identify.greybox.time_log import TimeLog


def in_words(seen: Sequence[Nuisance], units: Mapping[str, str]) -> list[str]:
    """A sentence for each nuisance.

    Args:
        units: of the signals.
    """
    return [_sentence(n, units) for n in seen]


def _sentence(n: Nuisance, units: Mapping[str, str]) -> str:
    name, reach = n.suspect.signal, 0.5 * (n.high - n.low)
    if n.suspect.kind == GAIN:
        return f"{name} reads {100 * n.value:+.3g} +- {100 * reach:.2g} percent: a gain of its sensor"
    if n.suspect.kind == OFFSET:
        unit = units.get(name, "")
        return f"{name} is off by {n.value:+.3g} +- {reach:.2g} {unit}: an offset of its sensor".replace("  ", " ")
    return f"outputs are logged {1e3 * n.value:+.3g} +- {1e3 * reach:.2g} ms after the command: a shift of clocks"


def counting_in_words(ruler: Ruler, held: Ruler | None, units: Mapping[str, str], *, told: bool) -> list[str]:
    """What a reader must know of how residuals are counted: noise that is not as told, logs cut at their start.

    Args:
        units: of the signals.
        told: whether the data set tells the noise.
    """
    lines = []
    for (_, name), noise in ruler.noise.items():
        unit = units.get(name, "")
        if noise.coloured:
            lines.append(
                f"the noise of {name} has memory: {noise.coloured:.3g} {unit} over {1e3 * noise.memory:.2g} ms beside "
                f"{noise.white:.3g} {unit} of white noise; residuals are counted by what each sample adds"
            )
        elif told and not noise.plain:
            lines.append(
                f"the noise of {name} is told as {noise.told:.3g} {unit}; the logs show {noise.white:.3g} {unit}"
            )
    for one in (ruler, *([held] if held else [])):
        for target, skip in zip(one.targets, one.skips, strict=True):
            if skip and isinstance(target, TimeLog):
                lines.append(
                    f"{target.source}: the plant still moved when the log began; the first {skip:g} s are left out"
                )
    return lines
