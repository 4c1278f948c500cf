"""A candidate that cannot be built is refused, so that a diagnosis goes on without it."""

from types import SimpleNamespace
from typing import Any

import pytest

import fmu_build
from fmu_build.pack import CompilerError
from pysim.cli._variants import Variants
from pysim.types import BadInput
from tests.pysim.diagnose.toy import CATALOGUE, library

LAW = SimpleNamespace(slot="force", text="", probes=())


@pytest.mark.parametrize("error", [CompilerError("linux: the C compiler failed."), fmu_build.BuildError("too much")])
def test_what_does_not_compile_is_refused(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def build(*arguments: Any, **options: Any) -> None:
        raise error

    monkeypatch.setattr(fmu_build, "build", build)
    variants = Variants("Toy.Mass", [library()])
    with pytest.raises(BadInput, match=str(error)):
        variants([CATALOGUE["toy.friction"]])
    assert not variants.built
    with pytest.raises(BadInput, match=str(error)):
        variants.probed([], LAW)
