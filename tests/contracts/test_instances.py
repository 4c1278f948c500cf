"""Many instances of a model, side by side and one after another."""

import sys
from pathlib import Path

import numpy as np
import pytest

from tests.cases import BY_NAME, Case
from tests.contracts.fmu import Fmu

CYCLES = 2000
PAGE = 4096


def resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * PAGE


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize("kind", ["me", "cs"])
@pytest.mark.parametrize("case", [BY_NAME["sampled"]], ids=["sampled"])  # what allocates is the same for all
def test_instances_leave_nothing_behind(fmu: Fmu, kind: str) -> None:
    instance = fmu.open(kind)
    raw = instance.raw

    def cycle(count: int) -> None:
        for _ in range(count):
            raw.freeInstanceOnly()
            instance._instantiate({})

    raw.freeInstanceOnly = lambda: getattr(raw, f"fmi{fmu.fmi}FreeInstance")(raw.component)
    cycle(200)
    before = resident_bytes()
    cycle(CYCLES)
    grown = resident_bytes() - before
    raw.freeInstance()
    # an instance is some kB: had they stayed, this would be several MB
    assert grown < 1_000_000


def test_instances_do_not_know_each_other(fmu: Fmu, case: Case) -> None:
    size, names = case.stop / 10, [v.name for v in fmu.description.modelVariables]
    with fmu.open("cs") as alone:
        alone.start(case.settings)
        for k in range(5):
            alone.step(k * size, size)
        expected = alone.get(names)
    with fmu.open("cs") as first, fmu.open("cs") as second:
        first.start(case.settings)
        second.start(case.settings)
        for k in range(5):
            first.step(k * size, size)
            for j in range(2):
                second.step((k + j / 2) * size, size / 2)
        np.testing.assert_array_equal(first.get(names), expected)
