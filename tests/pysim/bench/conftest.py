import pytest

from pysim.io import read_model
from pysim.types import Model
from tests.pysim.simulate.fixture_fmus import OSCILLATOR, build


@pytest.fixture(scope="session")
def oscillator(tmp_path_factory: pytest.TempPathFactory) -> Model:
    """x'' = u - 2 D w x' - w^2 x with w = 2 rad/s, u in N, x in m."""
    return read_model(build(OSCILLATOR, 2, tmp_path_factory.mktemp("oscillator")))
