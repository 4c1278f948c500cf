"""FMUs with planted faults, each made once."""

import sys
from collections.abc import Callable

import pytest

from pysim.fmu_check.checks import CHECKS
from pysim.fmu_check.result import CheckResult
from pysim.fmu_check.subject import Subject, read_subject
from tests.planted import planted

if sys.platform not in ("linux", "win32", "darwin"):
    pytest.skip("planted.c is compiled for the usual systems only", allow_module_level=True)


@pytest.fixture(scope="session")
def subject(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Subject]:
    """Fault -> FMU under test."""
    folder = tmp_path_factory.mktemp("planted")
    return lambda fault: read_subject(planted(fault, folder))


@pytest.fixture
def told(subject: Callable[[str], Subject]) -> Callable[[str, str], list[CheckResult]]:
    """(fault, check) -> what the check says that is neither "holds" nor "skipped", in this process."""

    def run(fault: str, check: str) -> list[CheckResult]:
        return [r for r in CHECKS[check](subject(fault)) if r.verdict not in ("holds", "skipped")]

    return run
