"""The toy with its measurements, for tests of the commands and of what they open."""

from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def toy() -> list[str]:
    """The model's words: a mass with a slot for a force."""
    from tests.toy import library

    return ["--model", "Toy.Mass", "--library", str(library())]


@pytest.fixture(scope="session")
def rubbing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Logs of the mass with dry friction of 0.4 N; one is held out."""
    from pysim.io import write_dataset
    from tests.toy import measured

    return write_dataset(tmp_path_factory.mktemp("data") / "toy", measured(1, "toy.friction", F_c=0.4)).parent


@pytest.fixture(scope="session")
def foreign(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The mass as an FMU of another tool: no derivatives, no bounds, and its class in no library."""
    from fmu_build import build
    from tests.foreign import made_foreign
    from tests.toy import library

    return made_foreign(build("Toy.Mass", libraries=[library()]), tmp_path_factory.mktemp("fmu") / "foreign.fmu")
