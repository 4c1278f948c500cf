"""Packed signals, when several threads share them."""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from pysim.simulate.kernel.signals import Packs
from pysim.types import Experiment, Signal

PIECES = 64  # of a signal, so that its pack is worth keeping
SIGNALS = 12  # more than are kept
LOOKS = 8000  # of each thread


@pytest.mark.slow
def test_threads_may_share_packs() -> None:
    """Each thread gets its own signals' breaks while others push the oldest packs out."""
    times = np.linspace(0.0, 1.0, PIECES)
    experiments = [
        Experiment(np.array([0.0, 1.0]), ("y",), {"u": Signal.steps(times, np.arange(PIECES) + k)})
        for k in range(SIGNALS)
    ]
    packs = Packs()
    expected = [Packs().breaks([one], [1.0]).structures["count"][0] for one in experiments]

    def ask(first: int) -> bool:
        numbers = np.random.default_rng(first).integers(0, SIGNALS, LOOKS).tolist()
        return all(packs.breaks([experiments[k]], [1.0]).structures["count"][0] == expected[k] for k in numbers)

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(6) as pool:
            assert all(pool.map(ask, range(6)))
    finally:
        sys.setswitchinterval(interval)
