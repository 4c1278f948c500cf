"""The reference of a subject by FMPy's CVODE, stored once per FMU: values, and central differences by parameters."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from fmpy import read_model_description, simulate_fmu
from numpy.typing import NDArray

from pysim.io import extracted, read_model
from pysim.types import Model
from validation.kernel.subjects import Subject, recorded

Array = NDArray[np.float64]

STORE = Path(__file__).parents[2] / "results" / "kernel"
TOLERANCE, ALIKE = 1e-10, (1e-6, 1e-8)  # of CVODE: of the reference, and where it errs as our runs may
# Of a parameter's value. A wider step beside it shows what a difference leaves open. Past events, and without
# derivatives of the FMU's own, our slopes are differences too, of a step as wide as WIDE: curves and kinks lie within.
STEP, WIDER, WIDE = 1e-4, 2e-4, 1e-3
MOST, TRIED = 3, 12  # parameters by which differences are taken; tried to find those that do most
_COARSE = 201  # rows of the runs that only rank parameters
_SLOPE_ROWS = 2001
_SHORTEST, _LOOSEST = 1e-9, 1e-6  # s between two communications; tolerance
_DOES_NOTHING = 1e-4  # of its size that a parameter moves a signal by, as it is doubled


@dataclass(frozen=True)
class Reference:
    """What FMPy makes of an FMU.

    Args:
        times: (n_t,) s, of values (n_t, n_y).
        names: (n_y,) of the columns.
        slope_times: (n_s,) s, of slopes.
        parameters: (n_p,) names.
        slopes: (n_s, n_y, n_p) times the parameter's value: change of a signal as the parameter is doubled.
        open: (n_s, n_y, n_p) by how much a difference over a wider step differs from that: curvature, jumps, noise.
        nominal: (n_y,) nominal values, 1 where the FMU states none.
        alike: (2, n_t, n_y) values by CVODE at our runs' tolerances, or at a tenth of one where it gives up there.
        alike_tolerances: (2,) those tolerances.
    """

    times: Array
    names: NDArray[np.str_]
    values: Array
    slope_times: Array
    parameters: NDArray[np.str_]
    slopes: Array
    open: Array
    nominal: Array
    alike: Array
    alike_tolerances: Array

    @property
    def size(self) -> Array:
        """(n_y,) what the solvers' tolerance of a signal is a share of: its largest size and its nominal value."""
        return np.abs(self.values).max(axis=0) + self.nominal


def reference(subject: Subject, store: Path = STORE) -> Reference:
    """From the store, or made now and stored.

    Raises:
        LookupError: the model cannot be built here, or has nothing to compare.
    """
    fmu = subject.fmu()
    digest = hashlib.sha256(fmu.read_bytes() + repr((subject.stop, TOLERANCE, ALIKE, STEP, WIDE)).encode()).hexdigest()[
        :12
    ]
    file = store / f"{subject.name.split(' ')[0]}-{digest}.npz"
    if not file.is_file():
        made = _made(fmu, subject)
        store.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(".part.npz")
        np.savez_compressed(part, **{field.name: getattr(made, field.name) for field in fields(made)})
        part.replace(file)
    with np.load(file) as stored:
        return Reference(**{name: stored[name] for name in stored.files})


def _made(fmu: Path, subject: Subject) -> Reference:
    model = read_model(fmu)
    names = recorded(model)
    if not names:
        raise LookupError("it has no number that could be recorded")
    run = _Runner(model, names)
    values = run(subject.times, {})
    alike, tolerances = zip(*(_alike(model, names, subject.times, tolerance) for tolerance in ALIKE), strict=True)
    slope_times = subject.times[:: max(1, subject.times.size // _SLOPE_ROWS)]
    nominal = np.array([model[name].nominal or 1.0 for name in names])
    size = np.abs(values).max(axis=0) + nominal
    parameters = _strongest(model, run, subject.times[:: max(1, subject.times.size // _COARSE)], size)
    exact = model.abilities.directional_derivatives
    ours_are_exact = exact and not run.meets_events(subject.times[:: max(1, subject.times.size // _COARSE)])
    wider = WIDER if ours_are_exact else WIDE
    slopes, left = np.zeros((2, slope_times.size, len(names), len(parameters)))
    for p, name in enumerate(parameters):
        slopes[:, :, p] = _difference(model, run, slope_times, name, STEP)
        left[:, :, p] = np.abs(_difference(model, run, slope_times, name, wider) - slopes[:, :, p])
    labels = np.array(parameters, dtype=np.str_)
    columns = np.array(names), values, slope_times, labels, slopes, left
    return Reference(subject.times, *columns, nominal, np.array(alike), np.array(tolerances))


def _alike(model: Model, names: Sequence[str], times: Array, tolerance: float) -> tuple[Array, float]:
    """Values (n_t, n_y) at a tolerance, or at a tenth of it where CVODE gives up there; and that of the values."""
    run = _Runner(model, names, tolerance)
    try:
        return run(times, {}), run.tolerance
    except RuntimeError:
        run = _Runner(model, names, tolerance / 10)
        return run(times, {}), run.tolerance


def _strongest(model: Model, run: Callable[..., Array], times: Array, size: Array) -> list[str]:
    """Those of some parameters, spread over all, that move the signals most."""
    candidates = [
        v.name
        for v in model.variables
        if v.causality == "parameter" and v.type in ("Real", "Float64") and v.start and np.isfinite(v.start)
    ]
    sizes = {}
    for name in candidates[:: -(-len(candidates) // TRIED) or 1]:
        moved = _difference(model, run, times, name, 10 * STEP)
        sizes[name] = float(np.max(np.abs(moved) / size))
    strong = sorted((name for name in sizes if sizes[name] > _DOES_NOTHING), key=lambda name: -sizes[name])
    return strong[:MOST]


def _difference(model: Model, run: Callable[..., Array], times: Array, name: str, step: float) -> Array:
    """Central difference (n_t, n_y) times the parameter's value."""
    value = float(model[name].start or 0.0)
    up, down = (run(times, {name: value * (1 + sign * step)}) for sign in (1, -1))
    return (up - down) / (2 * step)


class _Runner:
    """FMPy's loop over one instance: `run(times, overrides)` gives values (n_t, n_y)."""

    def __init__(self, model: Model, names: Sequence[str], tolerance: float = TOLERANCE) -> None:
        self._names, self._folder = list(names), str(extracted(model.path))
        self._description = read_model_description(self._folder, validate=False)
        self._interval, self.tolerance = np.inf, tolerance  # s between communications, at most

    def __call__(self, times: Array, overrides: Mapping[str, float]) -> Array:
        row = float(times[1] - times[0])
        while True:
            parts = max(1, round(row / self._interval))
            try:
                return self._run(times, row / parts, parts, overrides)
            except RuntimeError as error:
                if "mxstep" in str(error) and self._interval > _SHORTEST:
                    self._interval = min(row, self._interval) / 10  # CVODE gives up after 500 steps without an output
                elif "error test failed" in str(error) and self.tolerance < _LOOSEST:
                    self.tolerance *= 10  # a delay's value is interpolated, which CVODE cannot refine
                else:
                    raise

    def meets_events(self, times: Array) -> bool:
        """Whether anything jumps: FMPy then records a time twice."""
        self(times, {})  # at an interval that CVODE can take
        interval = min(float(times[1] - times[0]), self._interval)
        result = self._simulated(float(times[-1]), interval, {}, record_events=True)
        return bool(np.any(np.diff(result["time"]) == 0))

    def _run(self, times: Array, interval: float, parts: int, overrides: Mapping[str, float]) -> Array:
        result = self._simulated(float(times[-1]), interval, overrides, record_events=False)[::parts]
        got = np.asarray(result["time"])
        if got.size != times.size or np.abs(got - times).max() > 1e-9 * max(1.0, float(times[-1])):
            raise RuntimeError(f"FMPy recorded {got.size} rows, not the {times.size} asked for")
        return np.column_stack([np.asarray(result[name], dtype=np.float64) for name in self._names])

    def _simulated(
        self, stop: float, interval: float, overrides: Mapping[str, float], *, record_events: bool
    ) -> np.ndarray:
        table: np.ndarray = simulate_fmu(
            self._folder,
            validate=False,
            stop_time=stop,
            solver="CVode",
            relative_tolerance=self.tolerance,
            output_interval=interval,
            record_events=record_events,
            start_values=dict(overrides),
            output=self._names,
            fmi_type="ModelExchange",
            model_description=self._description,
            logger=lambda *words: None,
        )
        return table
