"""The native loop against FMPy's CVODE loop: the free set's 18 tests at 19 frequencies, on the same FMU.

`python -m validation.benchmarks.native_loop [FMU]`; without a file, Examples.SteppedSine is built. In that model the
command is part of the FMU, because FMPy 0.3.32 sets inputs at communication points and holds them in between: no
tolerance would bring it within 0.01 percent of a smooth command. FMPy is timed at the loosest half decade of tolerance
that holds this limit, the native loop at half the tolerance that would do, so that rounding alone cannot spoil it;
FMPy keeps its instance and its model description from run to run. The ratio is one of wall-clock times and means
something on an otherwise idle machine only.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

import numpy as np
from fmpy import instantiate_fmu, read_model_description, simulate_fmu

import fmu_build
from pysim.identify.stepped_sine import SteppedSine, stepped_sine
from pysim.io import extracted, read_model
from pysim.simulate import Rk45, Rodas, simulate_many
from pysim.thesis import FREQUENCIES_HZ
from pysim.types import Experiment, Model, Record, SineTest
from validation.findings import Finding

CLASS = "HydraulicTestBench.Examples.SteppedSine"
RATIO, LIMIT = 20.0, 0.01  # at least; percent of the angle's range, root mean square, at most

# Rodas holds the limit in every run at 5e-4 and misses it at 1e-3, CVODE misses it at 1e-4.
NATIVE = Rodas(rtol=2.5e-4, atol=2.5e-4)
CVODE_TOLERANCE = 3e-5

_REPEATS = 5  # of the native side, which takes a fraction of a second: the median counts

_TIGHT = Rk45(rtol=1e-9, atol=1e-9)


@dataclass(frozen=True)
class Result:
    """Wall-clock time in s of both sides, and their worst rms difference to the reference in percent of the range."""

    native: float
    cvode: float
    native_rms: float
    cvode_rms: float

    @property
    def ratio(self) -> float:
        """How many times faster the native loop is."""
        return self.cvode / self.native

    def __str__(self) -> str:
        return (
            f"native loop {self.native:8.2f} s, {self.native_rms:.4f} percent rms at worst\n"
            f"FMPy CVODE  {self.cvode:8.2f} s, {self.cvode_rms:.4f} percent rms at worst\n"
            f"ratio       {self.ratio:8.1f} on {os.cpu_count()} cores"
        )


def run() -> Iterator[Finding]:
    """The claim on this machine, as it is busy now."""
    result = benchmark(read_model(fmu_build.build(CLASS)), experiments())
    yield Finding("native loop: rms difference to a tight run at worst", result.native_rms, LIMIT, "%")
    yield Finding("FMPy CVODE: rms difference to a tight run at worst", result.cvode_rms, LIMIT, "%")
    times = f"{result.native:.2f} s against {result.cvode:.2f} s on {os.cpu_count()} cores"
    yield Finding(f"native loop against FMPy CVODE, {times}", 1.0 / result.ratio, 1.0 / RATIO, "of its time")


def experiments(frequencies: Sequence[float] = FREQUENCIES_HZ) -> list[Experiment]:
    """Both signs of three offsets, three amplitudes, every frequency; the model makes the command."""
    return [
        _self_driven(SineTest(sign * offset, amplitude, "pump.alphaCMD", "pump.alphaPercent"), f)
        for sign in (1, -1)
        for offset in (25, 50, 75)
        for amplitude in (5, 10, 20)
        for f in frequencies
    ]


def _self_driven(test: SineTest, frequency: float) -> Experiment:
    plan = SteppedSine()
    command = {
        "command.offset": test.offset,
        "command.amplitude": test.amplitude,
        "command.f": frequency,
        "command.t_ramp": plan.rest,
        "command.t_hold": plan.rest + plan.ramp,
        "command.t_sine": plan.onset,
    }
    return replace(stepped_sine(test, frequency, plan=plan), inputs={}, overrides=command)


def benchmark(model: Model, runs: Sequence[Experiment]) -> Result:
    """Both sides, one after the other, and how far each is off."""
    simulate_many(model, runs[:1], solver=NATIVE)  # machine code is compiled once per machine, not once per benchmark
    times = []
    for _ in range(_REPEATS):
        started = time.perf_counter()
        records = simulate_many(model, runs, solver=NATIVE)
        times.append(time.perf_counter() - started)
    started = time.perf_counter()
    tables = run_fmpy(model, runs)
    cvode = time.perf_counter() - started
    return Result(median(times), cvode, _worst(model, runs, records), _worst(model, runs, tables))


def _worst(model: Model, runs: Sequence[Experiment], results: Sequence[Record]) -> float:
    """Largest rms difference to a tight run at the same times; infinite if a run stopped early."""
    same = [replace(run, times=result.time) for run, result in zip(runs, results, strict=True)]
    references = simulate_many(model, same, solver=_TIGHT)
    worst = 0.0
    for run, result, reference in zip(runs, results, references, strict=True):
        if result.time.size < run.times.size - 1:  # FMPy's own grid may leave out one point at an end
            return float("inf")
        worst = max(worst, float(np.sqrt(np.mean((result.values - reference.values) ** 2))))
    return worst


def run_fmpy(model: Model, runs: Sequence[Experiment]) -> list[Record]:
    """`simulate_fmu` for each, with everything prepared that it lets us prepare."""
    folder = str(extracted(model.path))
    description = read_model_description(folder, validate=False)
    fmu = instantiate_fmu(folder, description, fmi_type="ModelExchange")
    records = []
    for run in runs:
        fmu.reset()
        table = simulate_fmu(
            folder,
            validate=False,
            stop_time=float(run.times[-1]),
            solver="CVode",
            relative_tolerance=CVODE_TOLERANCE,
            output_interval=float(run.times[1] - run.times[0]),
            record_events=False,
            start_values=dict(run.overrides),
            output=list(run.record),
            fmi_type="ModelExchange",
            model_description=description,
            fmu_instance=fmu,
        )
        table = table[table["time"] >= run.times[0] - 1e-9]
        records.append(Record(table["time"].copy(), table[run.record[0]][:, None], run.record, ("%",)))
    fmu.freeInstance()
    return records


def main(argv: Sequence[str] | None = None) -> int:
    """Print both times and the ratio; 0 when the claim holds, else 1."""
    parser = argparse.ArgumentParser(prog="native_loop", description=__doc__.splitlines()[0])
    parser.add_argument("fmu", nargs="?", type=Path, help=f"{CLASS}, built before")
    fmu = parser.parse_args(argv).fmu or fmu_build.build(CLASS)
    result = benchmark(read_model(fmu), experiments())
    good = result.ratio >= RATIO and max(result.native_rms, result.cvode_rms) <= LIMIT
    print(result)
    print("holds" if good else f"FAILS: {RATIO:g} times and {LIMIT} percent are claimed")
    return 0 if good else 1


if __name__ == "__main__":
    raise SystemExit(main())
