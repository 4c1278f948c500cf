"""Every record beside every model of a diagnosis, in one .npz: what a picture of it takes, without running anything."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.archive import DAMAGED
from pysim.io.files import write_file
from pysim.types import BadInput, Deviation, ErrorStep, Estimate, RecordFit, ResponseFit
from pysim.types.json_number import json_number

Array = NDArray[np.float64]

_FORM = 3


@dataclass(frozen=True)
class StageFile:
    """What a file of stages holds; arrays are read when they are asked for, and never as Python objects.

    The file is open only while an array is read: Windows does not remove a folder with an open file in it.

    Args:
        path: the file.
        about: what stands in it besides arrays: per stage its step, estimates, records, responses and failures.
    """

    path: Path
    about: tuple[Mapping[str, Any], ...]

    def array(self, key: str) -> Array:
        """An array by the key that `about` names.

        Raises:
            BadInput: the file is gone.
        """
        try:
            with np.load(self.path, allow_pickle=False) as file:
                return np.asarray(file[key], dtype=np.float64)
        except OSError as error:
            raise BadInput(f"{self.path}: cannot be read ({error.strerror or error})") from error


def write_stages(path: Path, history: Sequence[ErrorStep]) -> None:
    """Write the models of an error history beside their records; the file is complete or not there.

    Raises:
        BadInput: a place that cannot be written.
    """
    arrays: dict[str, Array] = {}
    about = {"form": _FORM, "stages": [_stage(stage, k, arrays) for k, stage in enumerate(history)]}
    text = np.frombuffer(json.dumps(about, allow_nan=False).encode(), dtype=np.uint8)
    data = io.BytesIO()
    np.savez(data, about=text, **arrays)  # type: ignore[arg-type]
    try:
        write_file(path, data.getvalue())
    except OSError as error:
        raise BadInput(f"{path}: cannot write there ({error.strerror}); choose another folder") from error


def read_stages(path: Path) -> StageFile:
    """Read what `write_stages` wrote, but for its arrays.

    Raises:
        BadInput: no such file, or another one.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            about = json.loads(bytes(file["about"].tobytes()))
        if about["form"] != _FORM:
            raise ValueError(f"it has the form {about['form']}")
        return StageFile(path, tuple(about["stages"]))
    except OSError as error:
        raise BadInput(f"{path}: cannot be read ({error.strerror or error})") from error
    except (*DAMAGED, KeyError, TypeError, ValueError) as error:
        raise BadInput(f"{path} holds no stages of a diagnosis: {error}; write it again with --records") from error


def _stage(stage: ErrorStep, number: int, arrays: dict[str, Array]) -> dict[str, Any]:
    return {
        "step": stage.step,
        "estimates": [_estimate(e) for e in stage.estimates],
        "undetermined": [{"exponents": dict(d.exponents), "spread": json_number(d.spread)} for d in stage.undetermined],
        "where": [[f.record, f.signal, f.region, json_number(f.error)] for f in stage.failures],
        "records": [_record(r, f"{number}/{k}", f"0/{k}", arrays) for k, r in enumerate(stage.records)],
        "responses": [_response(r) for r in stage.responses],
    }


def _record(fit: RecordFit, own: str, first: str, arrays: dict[str, Array]) -> dict[str, Any]:
    """One record; what was measured is kept once where it stays the same from stage to stage."""
    keys = {"time": "t", "measured": "m", "simulated": "s"}
    values = {"time": fit.measured.time, "measured": fit.measured.values, "simulated": fit.simulated.values}
    for what, letter in keys.items():
        before = arrays.get(f"{letter}{first}")
        same = what != "simulated" and before is not None and np.array_equal(before, values[what])
        keys[what] = f"{letter}{first if same else own}"
        arrays[keys[what]] = values[what]
    deviations = {name: [_deviation(d) for d in own_ones] for name, own_ones in fit.deviations.items()}
    about: dict[str, Any] = {
        "index": fit.index,
        "source": fit.source,
        "kind": fit.kind,
        "use": fit.use,
        "names": list(fit.measured.names),
    }
    rms = [json_number(value) for value in fit.rms.values()]
    about |= {"units": list(fit.measured.units), "noise": list(fit.noise), "rms": rms}
    frequency = fit.harmonics[0].frequency if fit.harmonics else None
    return {**about, **keys, "frequency": frequency, "deviations": deviations}


def _response(fit: ResponseFit) -> dict[str, Any]:
    """A frequency response with gains in output unit per input unit, phases in rad."""
    one = fit.comparison
    test = one.measured.test
    about = {"offset": test.offset, "amplitude": test.amplitude, "input": test.input, "output": test.output}
    sides = {"measured": one.measured, "simulated": one.simulated}
    found = {
        name: None if side is None else {"gain": side.gain.tolist(), "phase": side.phase.tolist()}
        for name, side in sides.items()
    }
    about |= {"use": fit.use, "frequency": one.measured.frequency.tolist(), "passes": one.passes}
    return {**about, **found, "message": one.message, "deviations": [_deviation(d) for d in one.deviations]}


def _deviation(one: Deviation) -> dict[str, Any]:
    c = one.criterion
    return {"name": c.name, "symbol": c.symbol, "limit": c.limit, "unit": c.unit, "value": json_number(one.value)}


def _estimate(e: Estimate) -> dict[str, Any]:
    numbers = {"value": e.value, "start": e.start, "lower": e.lower, "upper": e.upper, "low": e.interval[0]}
    found = {name: json_number(value) for name, value in (*numbers.items(), ("high", e.interval[1]))}
    return {"name": e.name, "unit": e.unit, "at": e.at, "determined": e.determined, **found}
