"""The library under OpenModelica, where it is installed: it loads, is balanced, and simulates as our FMUs do."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fmu_build.openmodelica import what_is_missing
from fmu_build.openmodelica.session import quoted

LIBRARY = Path(__file__).parents[2] / "modelica" / "HydraulicTestBench"
MODELS = sorted(
    ".".join(["HydraulicTestBench", *path.relative_to(LIBRARY).with_suffix("").parts])
    for folder in ("Examples", "Validation")
    for path in (LIBRARY / folder).rglob("*.mo")
    if path.name != "package.mo" and not re.search(r"^partial ", path.read_text(encoding="utf-8"), re.MULTILINE)
)
PUMPS = ("HydraulicTestBench.Pump.FreeGreyBox", "HydraulicTestBench.Pump.LockedGreyBox")

MISSING = what_is_missing()

pytestmark = pytest.mark.skipif(bool(MISSING), reason=MISSING)


@pytest.fixture(scope="module")
def omc(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    session = pytest.importorskip("OMPython").OMCSessionLocal()
    assert session.sendExpression(f"cd({quoted(tmp_path_factory.mktemp('omc'))})")
    assert session.sendExpression(f"loadFile({quoted(LIBRARY / 'package.mo')})")
    yield session
    session.sendExpression("quit()")


@pytest.mark.parametrize("name", [*PUMPS, *MODELS])
def test_class_is_balanced(omc: Any, name: str) -> None:
    report = omc.sendExpression(f"checkModel({name})")
    counts = re.search(r"has (\d+) equation\(s\) and (\d+) variable\(s\)", report)
    assert counts, report
    assert counts[1] == counts[2], report


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_example_simulates_as_our_fmu_does(omc: Any, name: str, tmp_path: Path) -> None:
    """Every state at the end of the example's own experiment, both tools at a tight tolerance."""
    fmu_build = pytest.importorskip("fmu_build")
    from pysim.io import read_model
    from pysim.simulate import simulate
    from pysim.types import Experiment

    model = read_model(fmu_build.build(name, tmp_path / "model.fmu"))
    start, stop, _tolerance, _intervals, _step = omc.sendExpression(f"getSimulationOptions({name})")
    states = model.abilities.states
    ours = simulate(model, Experiment(times=np.array([float(stop)]), record=states, start=float(start)))
    result = omc.sendExpression(f'simulate({name}, tolerance=1e-9, outputFormat="mat")')
    assert result["resultFile"], result["messages"]
    for state in states:
        theirs = omc.sendExpression(f"val({state}, {stop})")
        scale = max(abs(theirs), model[state].nominal or 1.0)
        assert abs(ours[state][-1] - theirs) < 1e-4 * scale, state
