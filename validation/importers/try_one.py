"""`python -m validation.importers.try_one IMPORTER NAME FMI`: one importer in a process of its own, as JSON.

{"values": rows} at the communication points, or {"error": text}; a crash of the importer ends this process only. What
integrates by Euler gives the rows of two runs, the second with half the step.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.importers import fmusim
from validation.importers.exported import EXPORTED, Exported

Array = NDArray[np.float64]
_TIGHT, _DEFAULT = 1e-9, 1e-6
EULER_STEP = 2e-5  # s, of the first of two runs


def ours(exported: Exported, fmi: int) -> Array:
    """pysim.simulate, model exchange, at its usual tolerance."""
    from pysim.io import read_model
    from pysim.simulate import Rodas, simulate
    from pysim.types import Experiment, Signal

    inputs = {name: Signal.steps([0.0], [value]) for name, value in exported.inputs.items()}
    experiment = Experiment(exported.times, exported.outputs, inputs)
    return simulate(read_model(exported.build(fmi)), experiment, solver=Rodas(rtol=1e-6, atol=1e-6)).values


def fmpy_model_exchange(exported: Exported, fmi: int) -> Array:
    """FMPy with its CVODE."""
    return _fmpy(exported, fmi, "ModelExchange", relative_tolerance=_TIGHT)


def fmpy_co_simulation(exported: Exported, fmi: int) -> Array:
    """FMPy's co-simulation loop."""
    return _fmpy(exported, fmi, "CoSimulation", relative_tolerance=_DEFAULT)


def fmpy_euler(exported: Exported, fmi: int) -> Array:
    """FMPy's explicit Euler, which makes one step per output interval."""
    return _by_euler(
        lambda step: _fmpy(exported, fmi, "ModelExchange", solver="Euler", step_size=step, output_interval=step)
    )


def _by_euler(run: Callable[[float], Array]) -> Array:
    """Two runs, the second with half the step (2, n_t, n_outputs)."""
    return np.array([run(EULER_STEP), run(EULER_STEP / 2)])


def fmusim_cvode(exported: Exported, fmi: int) -> Array:
    """fmusim with its CVODE."""
    words = ("--interface-type", "me", "--solver", "cvode", "--tolerance", repr(_TIGHT))
    return fmusim.simulated(exported, fmi, *words, step=exported.step)


def fmusim_euler(exported: Exported, fmi: int) -> Array:
    """fmusim with its explicit Euler, which makes one step per output interval."""
    words = ("--interface-type", "me", "--solver", "euler")
    return _by_euler(lambda step: fmusim.simulated(exported, fmi, *words, step=step))


def fmusim_co_simulation(exported: Exported, fmi: int) -> Array:
    """fmusim's co-simulation loop."""
    words = ("--interface-type", "cs", "--tolerance", repr(_DEFAULT))
    return fmusim.simulated(exported, fmi, *words, step=exported.step)


def _fmpy(exported: Exported, fmi: int, kind: str, **options: Any) -> Array:
    from fmpy import simulate_fmu

    names = list(exported.inputs)
    kinds = np.dtype([("time", np.float64), *((name, np.float64) for name in names)])
    signals = np.array([(0.0, *exported.inputs.values())], dtype=kinds) if names else None
    result = simulate_fmu(
        str(exported.build(fmi)),
        fmi_type=kind,
        start_time=0.0,
        stop_time=exported.stop,
        input=signals,
        output=list(exported.outputs),
        record_events=False,
        **{"output_interval": exported.step, **options},
    )
    return np.column_stack([np.interp(exported.times, result["time"], result[name]) for name in exported.outputs])


def libcosimpy(exported: Exported, fmi: int) -> Array:
    """libcosim's fixed-step master with one slave."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    from pysim.io import read_model

    model = read_model(exported.build(fmi))
    execution = CosimExecution.from_step_size(round(exported.step * 1e9))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(model.path), instance_name="slave"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    for name, value in exported.inputs.items():
        execution.real_initial_value(slave, model[name].reference, value)
    rows, references = [], [model[name].reference for name in exported.outputs]
    for _ in exported.times:
        if not execution.step():
            raise RuntimeError("a step was refused")
        rows.append(observer.last_real_values(slave, references))
    return np.array(rows)


def casadi(exported: Exported, fmi: int) -> Array:
    """CasADi's FMU import, integrated by its CVODES."""
    from validation.importers.casadi_import import integrated

    return integrated(exported, fmi)


def casadi_partials(exported: Exported, fmi: int) -> Array:
    """Right-hand side and Jacobian by CasADi's FMU import."""
    from validation.importers.derivatives import by_casadi

    return by_casadi(exported, fmi)


IMPORTERS: Mapping[str, Callable[[Exported, int], Array]] = {
    "pysim": ours,
    "FMPy, model exchange, CVODE": fmpy_model_exchange,
    "FMPy, co-simulation": fmpy_co_simulation,
    "fmusim, model exchange, CVODE": fmusim_cvode,
    "fmusim, co-simulation": fmusim_co_simulation,
    "libcosimpy, co-simulation": libcosimpy,
    "CasADi, model exchange, CVODES": casadi,
}
# Two runs each, from which the error of first order is taken
EULERS: Mapping[str, Callable[[Exported, int], Array]] = {
    "FMPy, model exchange, Euler": fmpy_euler,
    "fmusim, model exchange, Euler": fmusim_euler,
}
# Values of another kind: derivatives and their partial derivatives, a row per point (derivatives.py)
EVALUATORS: Mapping[str, Callable[[Exported, int], Array]] = {"CasADi, partials": casadi_partials}


def main(words: Sequence[str]) -> None:
    """Nothing but the answer goes to standard output."""
    channel = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    exported = next(e for e in EXPORTED if e.name == words[1])
    answer: dict[str, Any]
    try:
        answer = {"values": {**IMPORTERS, **EULERS, **EVALUATORS}[words[0]](exported, int(words[2])).tolist()}
    except Exception as error:  # what an importer says is what is to be known
        answer = {"error": f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"}
    channel.write(json.dumps(answer))
    channel.flush()
    os._exit(0)  # an importer that crashes while it cleans up has answered already


if __name__ == "__main__":
    main(sys.argv[1:])
