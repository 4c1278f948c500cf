"""Hold a model against measured frequency responses (thesis Sections 2.1.1, 2.3 and 2.7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from pysim.identify import SteppedSine, frequency_deviations, frequency_response, stepped_sine
from pysim.simulate import Rodas, Solver, simulate_many
from pysim.types import (
    BadInput,
    Comparison,
    Dataset,
    FrequencyResponse,
    Model,
    Outcome,
    Record,
    ResponseComparison,
    SineTest,
)

# The stiff method takes long steps where nothing happens; at these tolerances the four numbers of the pump's tests are
# within 0.002 dB and 0.01 degrees of those at 1e-8.
SOLVER = Rodas(rtol=1e-5, atol=1e-5)

Progress = Callable[[int, int], None]


def compare(
    model: Model,
    dataset: Dataset,
    *,
    overrides: Mapping[str, float] | None = None,
    label: str = "",
    plan: SteppedSine | None = None,
    solver: Solver | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Comparison:
    """Repeat every measured stepped-sine test with the model, at the measured frequencies, and judge the difference.

    Args:
        model: has a variable for each signal of the measured responses, in the same unit. An input named like the
            command with `_t` behind it is taken as the command's rate and gets its exact derivative.
        dataset: its frequency responses are used; 0 dB is the gain at 0.1 Hz on both sides (Eq. 2.12).
        overrides: parameters to set first, in the variables' units.
        label: name of the parameter set, for tables and plots.
        plan: how the tests are run.
        solver: of pysim.simulate; SOLVER where None.
        workers: runs at a time; all cores by default.
        progress: called with runs done and runs in all.
    Returns:
        simulated responses and the deviations of Table 1.3 per test; a run that failed fails its test, with its reason.
    Raises:
        BadInput: no responses, an unknown variable, or a unit that differs between model and data set.
    """
    responses = dataset.responses()
    if not responses:
        raise BadInput(f"data set {dataset.name!r} holds no frequency responses; add records of that kind")
    plan = plan or SteppedSine()
    tests = [_model_test(model, dataset, response.test) for response in responses]
    experiments = [
        stepped_sine(test, f, plan=plan, rate_input=_rate_input(model, test.input), overrides=overrides)
        for test, response in zip(tests, responses, strict=True)
        for f in response.frequency.tolist()
    ]
    records = iter(simulate_many(model, experiments, solver=solver or SOLVER, workers=workers, progress=progress))
    return Comparison(
        model=model.name,
        label=label or model.name,
        dataset=dataset.name,
        note=dataset.description,
        tests=tuple(_judge(m, test, records, plan) for m, test in zip(responses, tests, strict=True)),
        overrides=overrides or {},
    )


def _model_test(model: Model, dataset: Dataset, test: SineTest) -> SineTest:
    """The measured test in the model's names, once the units are known to agree."""
    names = []
    for column, causality in ((test.input, "input"), (test.output, None)):
        signal = dataset.signal(column)
        variable = model[signal.variable]
        if causality is not None and variable.causality != causality:
            raise BadInput(
                f"{model.path.name}: {variable.name} is no input but a {variable.causality}; name the command"
            )
        if variable.unit != signal.unit:
            raise BadInput(
                f"signal {column!r} of data set {dataset.name!r} is in {signal.unit!r}, {variable.name} of "
                f"{model.path.name} in {variable.unit!r}; give both the same unit"
            )
        names.append(variable.name)
    return replace(test, input=names[0], output=names[1])


def _rate_input(model: Model, command: str) -> str | None:
    """The input that wants the command's derivative, by the naming of thesis Appendix F (u, u_t, u_tt)."""
    name = f"{command}_t"
    return name if any(v.name == name and v.causality == "input" for v in model.variables) else None


def _judge(
    measured: FrequencyResponse, test: SineTest, records: Iterator[Record], plan: SteppedSine
) -> ResponseComparison:
    """Take this test's records off the row and compare."""
    frequencies = measured.frequency.tolist()
    own = [next(records) for _ in frequencies]
    for frequency, record in zip(frequencies, own, strict=True):
        if record.outcome is not Outcome.DONE:
            reason = f"at {frequency:g} Hz: {record.outcome.value}. {record.message}".strip()
            return ResponseComparison(measured, None, (), reason)
    simulated = frequency_response(own, frequencies, test, onset=plan.onset)
    return ResponseComparison(measured, simulated, frequency_deviations(simulated, measured))
