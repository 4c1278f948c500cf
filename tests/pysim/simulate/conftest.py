from collections.abc import Callable

import pytest

from pysim.io import read_model
from pysim.types import Model
from tests.pysim.simulate import fixture_fmus


@pytest.fixture(scope="session")
def fixture_model(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Model]:
    """A hand-written FMU as a Model, compiled at first use."""
    folder = tmp_path_factory.mktemp("fixture_fmus")
    return lambda fixture, fmi=2: read_model(fixture_fmus.build(fixture, fmi, folder))
