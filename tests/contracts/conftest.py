"""Unpacks each model under test once per FMI version; the FMUs are those of the store that all tests share."""

import pytest

from tests.cases import CASES, Case
from tests.contracts.building import Built, build_case
from tests.contracts.fmu import Fmu


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    """An FMU of a case, unpacked once."""
    made: dict[tuple[str, int], Fmu] = {}
    folder = tmp_path_factory.mktemp("fmus")

    def get(case: Case, fmi: int) -> Fmu:
        key = case.name, fmi
        if key not in made:
            made[key] = Fmu.unpack(build_case(case, fmi, folder), folder / f"{case.name}_{fmi}", fmi)
        return made[key]

    return get


@pytest.fixture(params=CASES, ids=lambda case: case.name)
def case(request: pytest.FixtureRequest) -> Case:
    return request.param


@pytest.fixture(params=[2, 3], ids=["fmi2", "fmi3"])
def fmi(request: pytest.FixtureRequest) -> int:
    return request.param


@pytest.fixture
def fmu(built: Built, case: Case, fmi: int) -> Fmu:
    return built(case, fmi)
