"""One pass of 342 orbits with their slopes, over what its derivative calls alone would take."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from statistics import median

from pysim.simulate import Esdirk, open_runs
from pysim.thesis import pump_model
from pysim.types import Outcome
from validation.benchmarks.measurement import Measurement, timed
from validation.sensitivity.case import PARAMETERS, orbits

AIM, CALL_NS = 12.0, 45.0  # the pump's right-hand side as one C function, called without FMI
_TOLERANCES = (1e-4, 1e-5)  # on the way to the optimum, and at it
_MISMATCH = 1e-2  # amplitudes: what a search leaves to first order


def measure(pairs: int) -> Iterator[Measurement]:
    """From the orbits nearby and with the FMU open, as every pass of a fit but the first."""
    wanted = orbits()
    for tolerance in _TOLERANCES:
        solver = Esdirk(tolerance, tolerance)
        with open_runs(pump_model("free")) as runs:
            one_pass = partial(runs.orbits, wanted, PARAMETERS, solver=solver, mismatch=_MISMATCH)
            guesses = [orbit.state for orbit in one_pass()]
            found = one_pass(guesses=guesses)
            times = [timed(partial(one_pass, guesses=guesses)) for _ in range(pairs)]
        if any(orbit.outcome is not Outcome.DONE or not orbit.iterations for orbit in found):
            raise RuntimeError("an orbit was not found by shooting")
        calls = sum(orbit.record.statistics["derivatives"] * orbit.iterations for orbit in found)
        cpu = median(t.cpu for t in times)
        words = f"{cpu:.2f} s of CPU over {calls} derivative calls at {CALL_NS:g} ns"
        yield Measurement(
            f"342 orbits with slopes, tolerance {tolerance:g}: {words}", cpu / (calls * CALL_NS * 1e-9), AIM
        )
