"""Measurements that come along, to try everything on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.types import BadInput, Dataset, Experiment, MeasuredRecord, MeasuredSignal, Record, Signal

if TYPE_CHECKING:
    from numpy.typing import NDArray

PUMP = "HydraulicTestBench.Pump.FreeGreyBox"
_DEAD_BAND = 0.02  # half width over the valve's stroke
_NOISE = {"alphaPercent": 0.05, "u": 0.005}  # %, V
_RATE_HZ, _SECONDS = 200, 8.0
_LOGS = (("first.csv", "fit"), ("second.csv", "fit"), ("third.csv", "test"))


def example(name: str) -> Any:
    """Measurements to try: "pump", three logs of a pump whose valve has something that its model lacks.

    The logs are simulated, with noise, by a pump whose parameters differ from the model's too; the first call makes
    them, in the cache.

    Raises:
        BadInput: there is no example of that name.
    """
    if name != "pump":
        raise BadInput(f'example: there is no {name!r}; write "pump"', argument="name")
    from pysim.io import cache_folder, write_dataset
    from pysim.nouns.data import load

    folder = cache_folder("examples") / "pump-1"
    if not (folder / "dataset.toml").exists():
        write_dataset(folder, pump_logs())
    return load(folder)


def pump_logs() -> Dataset:
    """The logs: a random command from rest, and the angle that follows."""
    from pysim.simulate import Rodas, simulate
    from pysim.workflow import Variants, inside, model_of, named, with_standard

    base = model_of(PUMP)
    plant, places = Variants(PUMP, tuple(with_standard(()))).build(named(["valve.deadband"], inside(base)))
    rng, records = np.random.default_rng(1), []
    times = np.arange(0.0, _SECONDS, 1 / _RATE_HZ)
    other = {"K_p": 1.05 * (base["K_p"].start or 0.0), "A_p": 0.97 * (base["A_p"].start or 0.0)}
    other[f"{places['valve.deadband']}.u_0"] = _DEAD_BAND
    for source, use in _LOGS:
        command = _command(rng)
        drives = {"alphaCMD": command}
        run = Experiment(times, tuple(_NOISE), drives, other, start=-1.0, rates=base.rate_inputs(drives))
        clean = simulate(plant, run, solver=Rodas(rtol=1e-7, atol=1e-7))
        read = [clean[name] + sd * rng.standard_normal(times.size) for name, sd in _NOISE.items()]
        values = np.column_stack([command.value(times), *read])
        log = Record(times, values, ("alphaCMD", *_NOISE), ("%", "%", "1"), origin="simulated, with noise")
        records.append(MeasuredRecord(source, "stochastic", use, log))
    signals = (
        MeasuredSignal("alphaCMD", "input", "%", "swash plate angle wanted", "alphaCMD"),
        MeasuredSignal("alphaPercent", "output", "%", "swash plate angle", "alphaPercent", _NOISE["alphaPercent"]),
        MeasuredSignal("u", "output", "1", "command of the valve", "u", _NOISE["u"]),
    )
    about = "A pump, simulated with noise, whose valve has an overlap of 2 percent"
    return Dataset("pump-example", about, "pump", signals, tuple(records))


def _command(rng: np.random.Generator) -> Signal:
    """A smooth random wave around 40 %, from 0 % at rest."""
    knots = np.arange(0.0, _SECONDS + 0.5, 0.25)
    values: NDArray[np.float64] = 40 + 12 * rng.standard_normal(knots.size)
    values[:2] = 0.0
    return Signal.through(knots, np.clip(values, 0.0, 80.0))
