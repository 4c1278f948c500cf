"""Whether both kinds of an FMU do the same: OpenModelica's co-simulation has been seen to step over events.

`python -m fmu_build.openmodelica.kinds FMU` prints the comparison as JSON: foreign code runs in a process of its own.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LARGEST = 1e-2  # difference as a share of a variable's range, or of its size where it stands still
_STEPS = 100
_LONGEST = 1.0  # s of model time
_LONGEST_S = 60.0  # s that the comparison may take
_SHARE = 0.2  # of an input's range or nominal value, by which it is moved off its start value
_TIGHT, _LOOSER = 1e-9, 1e-7  # CVODE's tolerances; what moves between them is no reference
_STILL = 1e-3  # of a variable's size: the least range that counts


def disagreement(fmu: Path) -> str:
    """In words how co-simulation differs from model exchange; "" where they agree, or where neither can be judged."""
    words = [sys.executable, "-m", "fmu_build.openmodelica.kinds", str(fmu)]
    paths = [str(Path(__file__).resolve().parents[2]), os.environ.get("PYTHONPATH", "")]
    surroundings = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    try:
        done = subprocess.run(
            words, capture_output=True, text=True, errors="replace", env=surroundings, timeout=_LONGEST_S, check=False
        )
    except subprocess.TimeoutExpired:
        return f"was not done after {_LONGEST_S:g} s"
    try:
        answer: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    except (ValueError, IndexError):
        return f"ended the process with {done.returncode}"
    if "failed" in answer:
        return f"stopped: {answer['failed']}"
    off = answer.get("off", 0.0)
    return f"is off by {100 * off:.2g} % of the range of {answer['name']}" if off > LARGEST else ""


def compared(fmu: Path) -> dict[str, Any]:
    """Largest difference as {"name": ..., "off": ...}; {"failed": words} of co-simulation; {} without a reference."""
    from fmpy import read_model_description

    description = read_model_description(str(fmu), validate=False)
    shown = [v.name for v in description.modelVariables if v.causality == "output" and v.type == "Real"]
    shown += [u.variable.derivative.name for u in description.derivatives if u.variable.derivative is not None]
    if not shown:
        return {}
    try:
        reference, looser = (
            _run(fmu, description, shown, "ModelExchange", tolerance) for tolerance in (_TIGHT, _LOOSER)
        )
    except Exception:  # FMPy raises what it likes; without a reference there is nothing to say
        return {}
    try:
        run = _run(fmu, description, shown, "CoSimulation", None)
    except Exception as error:
        return {"failed": " ".join(str(error).split())[:200]}
    size = np.maximum(np.ptp(reference, axis=0), np.maximum(_STILL * np.abs(reference).max(axis=0), _STILL**2))
    off, doubt = (np.abs(other - reference).max(axis=0) / size for other in (run, looser))
    off = np.where(doubt < LARGEST, off, 0.0)
    worst = int(off.argmax())
    return {"name": shown[worst], "off": float(off[worst])}


def _run(fmu: Path, description: Any, shown: list[str], kind: str, tolerance: float | None) -> Array:
    """Values (_STEPS + 1, n) at even times, inputs constant and off their starts."""
    from fmpy import simulate_fmu

    experiment = description.defaultExperiment
    start = float(experiment.startTime or 0.0) if experiment is not None else 0.0
    told = float(experiment.stopTime or 0.0) if experiment is not None else 0.0
    length = min(told - start, _LONGEST) if told > start else _LONGEST
    inputs = [v for v in description.modelVariables if v.causality == "input" and v.type == "Real"]
    kinds = np.dtype([("time", np.float64), *((v.name, np.float64) for v in inputs)])
    signals = np.array([(start, *(_moved(v) for v in inputs))], dtype=kinds) if inputs else None
    result = simulate_fmu(
        str(fmu),
        validate=False,
        fmi_type=kind,
        start_time=start,
        stop_time=start + length,
        output_interval=length / _STEPS,
        relative_tolerance=tolerance,
        input=signals,
        output=shown,
        record_events=False,
    )
    times = np.linspace(start, start + length, _STEPS + 1)
    return np.column_stack([np.interp(times, result["time"], result[name]) for name in shown])


def _moved(variable: Any) -> float:
    value = float(variable.start or 0.0)
    low, high = (None if limit in (None, "") else float(limit) for limit in (variable.min, variable.max))
    wide = high - low if low is not None and high is not None else max(abs(value), float(variable.nominal or 1.0))
    moved = value + _SHARE * wide
    return moved if high is None or moved <= high else value - _SHARE * wide


if __name__ == "__main__":
    channel = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # whatever the FMU prints goes nowhere
    channel.write(json.dumps(compared(Path(sys.argv[1]))) + "\n")
    channel.flush()
    os._exit(0)  # a library that crashes while it is unloaded has answered already
