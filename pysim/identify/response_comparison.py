"""Compare a model with measured frequency responses (thesis Sections 2.1.1, 2.3 and 2.7)."""

from __future__ import annotations

import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from fmu_build.version import DISTRIBUTION, version
from pysim.identify.accuracy import frequency_deviations
from pysim.identify.frequency_response import THESIS_REFERENCE_HZ, frequency_response, magnitude_db
from pysim.identify.settling import TOLERANCE, SteadyRun, run_until_settled
from pysim.identify.stepped_sine import SteppedSine, stepped_sine
from pysim.simulate import Rodas, Solver, simulate_many
from pysim.types import (
    BadInput,
    Comparison,
    Dataset,
    Experiment,
    FrequencyResponse,
    Model,
    Record,
    ResponseComparison,
    SineTest,
)
from pysim.types.record_kind import RESPONSE_TABLE

# A stiff solver takes long steps where nothing happens. At these tolerances the four deviations of the pump's tests are
# within 0.002 dB and 0.01 degrees of those at 1e-8.
SOLVER = Rodas(rtol=1e-5, atol=1e-5)

Progress = Callable[[int, int], None]


def compare_responses(
    model: Model,
    dataset: Dataset,
    *,
    overrides: Mapping[str, float] | None = None,
    label: str = "",
    about: str = "",
    reference_hz: float | None = THESIS_REFERENCE_HZ,
    plan: SteppedSine | None = None,
    solver: Solver | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Comparison:
    """Repeat every measured stepped-sine test with the model, at the measured frequencies, and compare the responses.

    Args:
        model: has a variable for each signal of the measured responses, in the same unit. An input named like the
            command with `_t` behind it is taken as the command's rate and gets its exact derivative.
        dataset: its frequency responses are used.
        overrides: parameters to set first, in the variables' units.
        label: name of the parameter set, for tables and plots.
        about: what the parameter set is and where its values are from.
        reference_hz: frequency at which both gains count as 0 dB (Eq. 2.12); None compares absolute gains.
        plan: how the tests are run; a run that has not settled is repeated with longer settling.
        solver: of pysim.simulate; SOLVER where None.
        workers: runs at a time; all cores by default.
        progress: called with the number of runs done and of all runs; counts from 0 again where runs are repeated.
    Returns:
        simulated responses and the deviations of Table 1.3 per test. A test fails, with its reason, if one of its
        runs fails, does not settle or does not move.
    Raises:
        BadInput: no responses, one without the reference frequency, an unknown variable, or a unit that differs
            between model and data set; all before the first run.
    """
    responses = dataset.responses()
    if not responses:
        logs = f" ({len(dataset.logs())} logs over time)" if dataset.logs() else ""
        raise BadInput(
            f"data set {dataset.name!r} holds no frequency responses{logs}; "
            f'add records of the kind "{RESPONSE_TABLE.name}"'
        )
    if reference_hz is not None:
        for response in responses:  # now, not after minutes of runs
            magnitude_db(response, reference_hz)
    plan = plan or SteppedSine()
    solver = solver or SOLVER
    tests = [_model_test(model, dataset, response.test) for response in responses]

    def make(test: SineTest, frequency: float, plan: SteppedSine) -> Experiment:
        rate = model.rate_input(test.input)
        return stepped_sine(test, frequency, plan=plan, rate_input=rate, overrides=overrides)

    def run(experiments: Sequence[Experiment]) -> Sequence[Record]:
        return simulate_many(model, experiments, solver=solver, workers=workers, progress=progress)

    points = [(test, f) for test, m in zip(tests, responses, strict=True) for f in m.frequency.tolist()]
    runs = iter(run_until_settled(points, make, run, plan))
    return Comparison(
        model=model.name,
        label=label or model.name,
        dataset=dataset.name,
        note=_note(dataset),
        tests=tuple(_judge(m, t, runs, plan, reference_hz) for m, t in zip(responses, tests, strict=True)),
        overrides=overrides or {},
        reference_hz=reference_hz,
        command_unit=dataset.signal(responses[0].test.input).unit,
        conditions=_conditions(model, plan, solver, about),
        parameters=_parameters(model, overrides or {}),
    )


def _note(dataset: Dataset) -> str:
    """The data set's description, and which of its logs were not compared."""
    logs = [record.source for record in dataset.logs()]
    if not logs:
        return dataset.description
    more = ", ..." if len(logs) > 3 else ""
    which = f"{len(logs)} log{'s' if len(logs) > 1 else ''} over time ({', '.join(logs[:3])}{more})"
    return f"{dataset.description} Not compared: {which}.".removeprefix("- ")


def _model_test(model: Model, dataset: Dataset, test: SineTest) -> SineTest:
    """The measured test with the model's variable names; raises BadInput if a unit differs."""
    signals = (dataset.signal(test.input), dataset.signal(test.output))
    names = [model.measured(signal, f"data set {dataset.name!r}").name for signal in signals]
    return replace(test, input=names[0], output=names[1])


def _judge(
    measured: FrequencyResponse,
    test: SineTest,
    runs: Iterator[SteadyRun],
    plan: SteppedSine,
    reference_hz: float | None,
) -> ResponseComparison:
    """Take the test's own runs from `runs`, one per frequency in order, and compare them with the measurement."""
    frequencies = measured.frequency.tolist()
    own = [next(runs) for _ in frequencies]
    for frequency, run in zip(frequencies, own, strict=True):
        if run.trouble:
            return ResponseComparison(measured, None, (), f"at {frequency:g} Hz: {run.trouble}")
    simulated = frequency_response([run.record for run in own], frequencies, test, onset=plan.onset)
    return ResponseComparison(measured, simulated, frequency_deviations(simulated, measured, reference_hz=reference_hz))


def _conditions(model: Model, plan: SteppedSine, solver: Solver, about: str) -> dict[str, str]:
    """Parameter set, FMU, solver, plan and versions; nothing that changes from one run to the next."""
    return {
        "parameter set": about or "as the FMU holds it",
        "FMU": f"{model.path.name}, FMI {model.abilities.fmi}, identifier {model.token}",
        "solver": repr(solver),
        "test": f"rest {plan.rest:g} s, ramp {plan.ramp:g} s, hold {plan.hold:g} s, then the sine",
        "settling": f"{plan.settle_time:g} s of the sine, at least {plan.settle_periods} periods; doubled up to "
        f"{plan.settle_limit:g} s while the output changes by more than {TOLERANCE:g} of its amplitude over the fit",
        "fit": f"{plan.fit_periods} whole periods of {plan.points} points",
        "versions": versions(),
    }


def versions() -> str:
    """Versions of this project, Python and NumPy."""
    return f"{DISTRIBUTION} {version()}, Python {platform.python_version()}, NumPy {np.__version__}"


def _parameters(model: Model, overrides: Mapping[str, float]) -> dict[str, tuple[float, str]]:
    """Name -> value and unit of every parameter in these runs."""
    return {
        v.name: (overrides.get(v.name, v.start), v.unit)
        for v in model.variables
        if v.causality == "parameter" and v.start is not None
    }
