"""What `import pysim` shows, and what a type checker sees of it."""

from pathlib import Path

import fmu_build
import pysim
from pysim import nouns

VERBS = ("compare", "cosimulate", "diagnose", "effect", "example", "fit", "load", "locate", "model")
NOUNS = ("Comparison", "Data", "Diagnosis", "Effect", "Fit", "Model")


def test_the_verbs_and_the_nouns_are_there() -> None:
    assert dir(pysim) == sorted(["BadInput", "SimulationError", "open_session", *NOUNS, *VERBS])
    for name in VERBS:
        found = getattr(pysim, name)
        assert found.__name__ == name
        assert found.__doc__, name
    assert tuple(nouns.__all__) == NOUNS
    assert [getattr(pysim, name) for name in NOUNS] == [getattr(nouns, name) for name in NOUNS]
    assert [getattr(pysim, name).__name__ for name in NOUNS] == list(NOUNS)


def test_type_checkers_are_told_that_there_are_types() -> None:
    """PEP 561: a marker in each package that is installed."""
    for package in (pysim, fmu_build):
        assert package.__file__ is not None
        assert (Path(package.__file__).parent / "py.typed").is_file()
