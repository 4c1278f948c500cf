"""`pysim fit`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import choice, names, number, switch, text
from pysim.cli.options import (
    BOUNDS,
    DATASETS,
    FREE,
    JSON,
    LIBRARY,
    MODEL,
    OUTPUT,
    PARAMETERS,
    REFERENCE_HZ,
    SET,
    assigned,
    parameters_of,
    settable,
)
from pysim.cli.outputs import LOG

if TYPE_CHECKING:
    from pysim.identify.greybox import Problem
    from pysim.present.fit import Fitted
    from pysim.types import Dataset, Model


def run(given: Given) -> Fitted:
    """The estimates, with exact intervals where these were asked for."""
    from pysim.identify.greybox import (
        OBJECTIVES,
        Effort,
        GaussNewton,
        InteriorPoint,
        Processes,
        Simulation,
        of_outputs,
        profile,
    )
    from pysim.io import in_model_units
    from pysim.present.fit import Fitted
    from pysim.present.progress import Searching, Working, announce_compilation
    from pysim.workflow import fitted

    model = given.model
    datasets = tuple(in_model_units(of_outputs(one, given.signal), model) for one in given.dataset)
    problem = _problem(given, model, datasets)
    _refuse_unprofiled(problem, given.profile)
    simulation = Simulation(workers=Processes()) if given.isolate else Simulation()
    log = given.output / LOG if given.output else None
    optimiser = {"gauss-newton": GaussNewton(), "interior-point": InteriorPoint(), None: None}[given.optimiser]
    announce_compilation()
    with given.going_on("fit"), Searching("Fitting") as shown:
        found = fitted(
            problem,
            objective=OBJECTIVES[given.objective],
            optimiser=optimiser,
            simulation=simulation,
            effort=Effort(given.starts, given.seed, log=log, resume=log is not None),
            progress=shown,
        )
    result = Fitted(found, datasets)
    for name in given.profile:  # each may take as long as the fit
        given.keep(result)
        with Working(f"Profile of {name}"):
            more = profile(problem, found, name, simulation=simulation)
        result = replace(result, profiles=(*result.profiles, more))
    return result


def _forget(given: Given, _: Fitted) -> None:
    """Nothing is left to go on with; the lines of the log stay."""
    from pysim.identify.greybox.checkpoint import STATE

    for state in (given.output / LOG).glob(f"*/{STATE}") if given.output else ():
        state.unlink()


def _refuse_unprofiled(problem: Problem, profiled: Sequence[str]) -> None:
    """What the search for intervals would refuse, before anything is fitted."""
    from pysim.types import BadInput

    keys = problem.space.keys
    for name in profiled:
        if name not in keys:
            raise BadInput(f"--profile {name}: not a free parameter; choose of {', '.join(keys)}")
        if len(keys) == 1:
            raise BadInput(f"--profile {name}: it is the only free parameter; its interval needs no profile")


def _problem(given: Given, model: Model, datasets: Sequence[Dataset]) -> Problem:
    from pysim.identify.greybox import Tie
    from pysim.workflow import fit_problem, reference_of

    unit = "the parameter's unit"
    return fit_problem(
        model,
        datasets,
        free=given.free,
        bounds=given.bounds,
        values=settable(parameters_of(given.parameters), model) if given.parameters else {},
        fixed=assigned(given.set, "--set", unit),
        starts=assigned(given.start, "--start", unit),
        ties=[Tie(*_tie(word)) for word in given.tie],
        reference_hz=reference_of((r for one in datasets for r in one.responses()), given.reference_hz),
    )


def _tie(word: str) -> tuple[str, str, float]:
    """A=B or A=F*B."""
    from pysim.types import BadInput

    name, _, right = (part.strip() for part in word.partition("="))
    factor, star, of = (part.strip() for part in right.rpartition("*"))
    try:
        value = float(factor) if star else 1.0
    except ValueError:
        value = None
    if not name or not of or value is None:
        raise BadInput(f"--tie {word}: write A=B or A=2.5*B")
    return name, of, value


def _objectives() -> Iterable[str]:
    from pysim.identify.greybox import OBJECTIVES

    return OBJECTIVES


COMMAND = Command(
    "fit",
    "Fit parameters of a model to data sets, and say how well they are known.",
    run,
    options=(
        DATASETS,
        MODEL,
        LIBRARY,
        FREE,
        replace(PARAMETERS, about="start values of fitted parameters, and values of others; --start and --set win"),
        SET,
        text("--tie", "A=[F*]B", "let A follow the fitted B; repeat", repeated=True),
        text("--start", "NAME=VALUE", "start value of a fitted parameter; repeat", repeated=True),
        BOUNDS,
        choice("--objective", "noise", _objectives, "objective to minimise"),
        choice("--optimiser", None, ("gauss-newton", "interior-point"), "search method; gauss-newton fits noise"),
        names("--signal", "compare only these outputs"),
        REFERENCE_HZ,
        number("--starts", "N", 0, "further searches from random starts between the bounds", convert=int),
        number("--seed", "S", None, "random seed for --starts", convert=int),
        names("--profile", "parameters that get exact intervals"),
        switch("--isolate", "run the FMU in processes of its own, in case it crashes"),
        JSON,
        replace(OUTPUT, about="write report.html, parameters.toml, plots, log here; a stopped fit goes on from it"),
    ),
    passes=lambda result: bool(result.fit.outcome.name == "CONVERGED"),
    done=_forget,
    goes_on=(LOG,),
)
