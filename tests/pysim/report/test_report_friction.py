"""What the report says of a friction fit: open ends, bounds, what was left out."""

import json
import math
from dataclasses import replace

import numpy as np

from pysim.identify.friction import FrictionFit, FrictionSamples
from pysim.report import friction_data, friction_page, friction_table, friction_text

ONE = np.ones(12)
SAMPLES = FrictionSamples(
    np.arange(12.0), np.linspace(-6, 5.5, 12), 0 * ONE, ONE, ONE, ONE, (("ends of the filter", 7), ("unused", 0))
)
FIT = FrictionFit(
    {"r": 3.0, "omega_0": 8.0, "tau_c": 15.0, "tau_s": 500.0},
    {"r": (1.25, math.inf), "omega_0": (7.0, 9.0), "tau_c": (14.0, 16.0), "tau_s": (400.0, 500.0)},
    ("r",),
    np.diag([0.0, 0.25, 0.25, 100.0]),
    0.5 * ONE,
    6.0,
    ("tau_s",),
    True,
    (SAMPLES,),
)


def test_text_does_not_claim_what_is_bounded() -> None:
    text = friction_text(FIT)
    row = next(line for line in text.splitlines() if line.split()[0] == "r")
    assert row.split()[1:4] == ["-", "above", "1.25"]
    joined = " ".join(text.split())
    for told in ("above 1.25 s/rad", "0.273 rad/s", "7 samples (ends of the filter)", "0.5 N.m, 12 samples worth 6"):
        assert told in joined
    assert "unused" not in joined


def test_a_measured_steepness_is_printed_as_a_number() -> None:
    fit = replace(FIT, bounded=(), intervals={**FIT.intervals, "r": (2.5, 3.5)})
    assert "3.0000   2.5000 ... 3.5000" in friction_text(fit)


def test_data_is_json_with_open_ends_as_none() -> None:
    data = json.loads(json.dumps(friction_data(FIT), allow_nan=False))
    assert data["parameters"]["r"]["interval"] == [1.25, None]
    assert data["parameters"]["r"]["bounded_only"]
    assert data["parameters"]["tau_s"]["at_bound"]
    assert data["dropped"] == {"ends of the filter": 7}
    assert data["objective"] == "weighted least squares"


def test_page_shows_both_fits_and_escapes() -> None:
    text = friction_page(
        FIT, replace(FIT, weighted=False), about="a < b", pictures={"curve": b"<svg/>"}, redo="pysim friction x"
    )
    assert "a &lt; b" in text
    assert text.count(friction_table(FIT)) == 2
    assert "pysim friction x" in text
