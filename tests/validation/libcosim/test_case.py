import importlib.util

import numpy as np
import pytest

from validation.benchmarks import cosim_speed
from validation.libcosim import bench, case


def test_differences_are_shares_of_what_a_column_does() -> None:
    known = np.array([[0.0, 2.0], [4.0, 2.0]])
    np.testing.assert_allclose(case.difference(known + np.array([[0.0, 0.0], [0.4, 0.1]]), known), [0.1, 0.05])


def test_without_libcosim_its_claims_are_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(case, "find_spec", lambda name: None)
    monkeypatch.setattr(bench, "STEPS", 5)
    findings = list(case.run())
    assert len(findings) == 9
    assert all("libcosimpy is not installed" in finding.skipped for finding in findings)


@pytest.mark.skipif(importlib.util.find_spec("libcosimpy") is None, reason="libcosimpy is not installed")
def test_libcosim_sees_a_wire_that_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    from validation.libcosim import peer

    pair = cosim_speed.systems()[1]
    both = peer.wired(pair.models, {}, pair.wires, 1e-3).rows(50)
    one = peer.wired(pair.models, {}, pair.wires[:1], 1e-3).rows(50)
    assert case.difference(one, both).max() > 0.5
