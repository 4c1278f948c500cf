"""The compiler runs in the process of the tests here; `front/test_session.py` shows it in a process of its own."""

import pytest

from fmu_build.front.rumoca import session
from tests.fmu_build.lower.compiling import ask_in_this_process


@pytest.fixture(autouse=True)
def compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(session, "_ask_rumoca", ask_in_this_process)
