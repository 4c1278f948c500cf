"""The toy as its user has it: a library, and logs of a mass with dry friction that the model lacks."""

import pytest

import pysim
from pysim.nouns.diagnosis import Diagnosis
from pysim.nouns.fit import Fit
from pysim.nouns.model import Model
from pysim.types import Dataset
from tests.toy import library, measured

FRICTION = 0.4  # N
TRUE = {"m": 1.05, "d": 0.75, "k": 21.0}  # of the plant, as tests/toy.py has them


@pytest.fixture(scope="session")
def mass() -> Model:
    return pysim.model("Toy.Mass", library=library())


@pytest.fixture(scope="session")
def data() -> Dataset:
    """One log to fit and one held out."""
    return measured(1, "toy.friction", F_c=FRICTION)


@pytest.fixture(scope="session")
def fitted(mass: Model, data: Dataset) -> Fit:
    """Without friction."""
    return pysim.fit(mass, data)


@pytest.fixture(scope="session")
def why(fitted: Fit) -> Diagnosis:
    return pysim.diagnose(fitted, effects=["toy.friction", "toy.hardening", "toy.bias"])
