"""Each example by the native loop against its stored result."""

from __future__ import annotations

from collections.abc import Iterator

from fmu_build import CannotCompile
from pysim.io import read_model
from validation.examples import stored
from validation.examples.catalogue import REFUSED, Example, examples
from validation.examples.runs import built, native, off
from validation.findings import Finding


def run() -> Iterator[Finding]:
    """A finding per example: the variable that is furthest off."""
    for example in examples():
        yield compared(example)


def compared(example: Example) -> Finding:
    """The example as it is now against its stored result."""
    limit = example.limit
    claim = f"{example.short} to {example.times[-1]:g} s"
    try:
        model = read_model(built(example))
    except LookupError as missing:
        return Finding(claim, 0.0, limit.tolerance, "of the span", skipped=str(missing))
    except CannotCompile as error:
        if example.short not in REFUSED:
            raise
        why = f"for OpenModelica only: {REFUSED[example.short]} ({error.message})"
        return Finding(claim, 0.0, limit.tolerance, "of the span", skipped=why)
    expected = stored.read(example)
    time = expected["time"]
    names = tuple(name for name in expected if name != "time")
    record = native(model, time, names)
    furthest = {name: off(record[name], expected[name], model[name].nominal) for name in names}
    worst = max(furthest, key=furthest.__getitem__)
    return Finding(f"{claim}: {worst}, of {len(names)}", furthest[worst], limit.tolerance, "of the span")
