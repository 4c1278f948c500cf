"""One stored answer for each command that takes seconds; every test that looks at one reads it."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.pysim.cli.ran import Ran, ran, undraw


@pytest.fixture(autouse=True)
def _undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    undraw(monkeypatch)


@pytest.fixture(scope="session")
def undrawn() -> Iterator[None]:
    """For fixtures that outlive a test."""
    with pytest.MonkeyPatch.context() as patch:
        undraw(patch)
        yield


@pytest.fixture(scope="session")
def diagnosed(undrawn: None, rubbing: Path, toy: list[str], tmp_path_factory: pytest.TempPathFactory) -> Ran:
    """`pysim diagnose`, of two effects the right one."""
    words = ["diagnose", str(rubbing), *toy, "--effects", "toy.friction,toy.bias"]
    return ran(words, tmp_path_factory.mktemp("diagnosed"))


@pytest.fixture(scope="session")
def compared(rubbing: Path, toy: list[str], tmp_path_factory: pytest.TempPathFactory) -> Ran:
    """`pysim compare --refit`; nothing is plotted."""
    from pysim.present import diagnosis

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(diagnosis, "figures", lambda result: iter(()))
        return ran(["compare", str(rubbing), *toy, "--refit"], tmp_path_factory.mktemp("compared"))


@pytest.fixture(scope="session")
def lag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with Lag.mo, Lag.fmu, and data of K = 2 and T = 0.7 s."""
    import fmu_build
    from pysim.io import write_dataset
    from tests.pysim.identify.greybox import measurements as m
    from tests.pysim.identify.greybox.conftest import LAG

    folder = tmp_path_factory.mktemp("lag")
    (folder / "Lag.mo").write_text(LAG)
    fmu_build.build("Lag", folder / "Lag.fmu", libraries=[folder / "Lag.mo"])
    records = [m.ramp_log(2.0, 0.7, seed=2), *(m.sine_log(2.0, 0.7, f, seed=1) for f in (0.5, 1.0))]
    write_dataset(folder / "data", m.dataset(records))
    return folder


@pytest.fixture(scope="session")
def fitted(undrawn: None, lag: Path, tmp_path_factory: pytest.TempPathFactory) -> Ran:
    """`pysim fit` of gain and time constant."""
    words = ["fit", str(lag / "data"), "--model", str(lag / "Lag.fmu"), "--free", "K,T", "--set", "g=1"]
    return ran(words, tmp_path_factory.mktemp("fitted"))
