import numpy as np
import pytest

from validation.real_measurements.hypotheses import LOCKED, SLOW, hypotheses
from validation.real_measurements.load import load_differences
from validation.real_measurements.reference import reference

KNOWN = {"A_p": 1.26e-3, "L": 34.2e-3, "pS": 170e5, "beta": 1.4e9, "k1": -4.67e-6, "k2": 6.6454e-6, "k3": 0.967e-6}


def test_nine_responses_with_the_misfit_of_table_4_4() -> None:
    records = reference().records
    assert len(records) == 9
    assert all(record.data.test.offset > 0 for record in records)
    at = {(r.data.test.offset, r.data.test.amplitude): r.data for r in records}[75.0, 20.0]
    deg = np.degrees(np.sqrt(at.covariance[:, 1, 1]))
    assert deg == pytest.approx(np.full(19, 4.1 * np.sqrt(np.pi / 2)))
    db = 20 / np.log(10) * np.sqrt(at.covariance[:, 0, 0]) / (at.gain * 20.0)
    assert db == pytest.approx(np.full(19, 0.15 * np.sqrt(np.pi / 2)))


def test_each_hypothesis_changes_one_thing() -> None:
    found = list(hypotheses(KNOWN))
    assert [h.name for h in found if h.kind == "as it is"] == ["locked"]
    assert len({h.name for h in found}) == len(found)
    assert not {p.name for h in found if h.kind == "known number" for p in h.freed} & set(LOCKED)
    assert len([h for h in found if h.kind == "effect"]) == 18 - len(SLOW)
    alike = next(h for h in found if h.name == "K(u)")
    assert {tie.name: tie.factor for tie in alike.ties} == pytest.approx({"k1": -4.67 / 6.6454, "k3": 0.967 / 6.6454})


def test_what_the_load_changes_is_what_the_two_tables_print() -> None:
    small, large = load_differences()
    assert (small.amplitude, large.amplitude) == (5.0, 10.0)
    s = 2j * np.pi * 15.0
    loaded = 81114e6 / np.polyval([1, 231, 97740, 13468e3, 1630e6, 79655e6], s)  # Table 4.3, digit for digit
    place = large.frequency.tolist().index(15.0)
    own = {(r.data.test.offset, r.data.test.amplitude): r.data for r in reference().records}[75.0, 10.0]
    deg = np.degrees(np.angle(loaded) - own.phase[place])
    assert (deg - large.deg[place]) % 360 == pytest.approx(0.0, abs=1e-6) or (
        deg - large.deg[place]
    ) % 360 == pytest.approx(360.0)
    assert np.abs(large.db).max() == pytest.approx(0.59, abs=0.01)
