"""The answer as numbers and codes: what its verdict says, what cannot be, and its keys as JSON."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.types import (
    BadInput,
    Diagnosis,
    FloorSource,
    LearnedLaw,
    Left,
    NoiseFloor,
    Note,
    NoteCode,
    answer_data,
)
from pysim.types.factor import Factor
from tests.pysim.diagnosis_answer import LAW, estimate, found_offset, nothing

# Fixed by the contract of `--json`; `reason`, and the text of a note, are words and come from `pysim.present`.
KEYS = {
    "verdict", "added", "ranking", "confusable", "error", "parameters", "where", "missing", "next_test", "seconds",
    "files", "complete", "left", "learned", "fit_percent", "notes", "detectable",
}  # fmt: skip


def test_the_verdict_follows_from_what_was_found() -> None:
    found = found_offset()
    assert found.verdict == found.effects[0].effect.name
    assert replace(found, complete=False).verdict == found.effects[0].effect.name
    assert replace(found, effects=(), learned=(), complete=False).verdict == "unknown"
    assert replace(found, effects=(), learned=(), complete=True).verdict == "none"
    assert replace(found, effects=(), learned=(LAW,), complete=True).verdict == "unknown"


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(BadInput, match="above 0"):
        NoiseFloor(0.0, FloorSource.SPECIFIED)
    with pytest.raises(BadInput, match="3 knots need 3 coefficients"):
        LearnedLaw("force", Factor(), "v", np.arange(3.0), np.zeros(2), np.eye(3), 0.9, "m/s", "N")


def test_an_answer_does_not_change() -> None:
    values: dict[str, float | str] = {"value": 1.0}
    note = Note(NoteCode.AT_BOUND, values)
    values["value"] = 2.0
    assert note.values["value"] == 1.0
    law = LearnedLaw("force", Factor(), "v", np.arange(3.0), np.zeros(3), np.eye(3), 0.9, "m/s", "N")
    with pytest.raises(ValueError, match="read-only"):
        law.knots[0] = 1.0
    assert Left({"a x": NoiseFloor(1.0, FloorSource.REPEATS)}, None, None).floors["a x"].sd == 1.0
    assert Diagnosis((), True, Left({}, None, None), (), (), (), ()).seconds == {}


def test_moves_are_counted_on_one_scale_in_half_widths_of_the_interval_of_the_difference() -> None:
    _, before, after = found_offset().history
    scaled = before.on_the_scale_of(after)
    assert scaled == pytest.approx({"m": 1.0, "k": 0.75, "d": 1.0})  # m halved, so k by the square of that
    moves = after.moves_from(before)
    assert moves["m"] is None  # held
    assert moves["k"] == pytest.approx(0.0, abs=1e-12)
    assert moves["d"] == pytest.approx(0.5 / math.hypot(0.2, 0.1))
    assert "F_o" not in moves


def test_what_either_interval_allows_is_no_move() -> None:
    """Of a cylinder fitted without the friction of its seal and with it; the sides of an interval are not alike."""
    before = {"d": (8413.0, (8219.0, 8613.0)), "V0": (1.159e-4, (5e-5, 3.907e-4)), "E": (3.33e8, (3e8, 9.51e8))}
    after = {"d": (2603.0, (2591.0, 2616.0)), "V0": (3.581e-4, (3.465e-4, 3.701e-4)), "E": (8.955e8, (8.68e8, 9.24e8))}
    steps = []
    for fitted in (before, after):
        own = [replace(estimate(name, value, 1.0), interval=ends) for name, (value, ends) in fitted.items()]
        steps.append(replace(found_offset().history[0], estimates=tuple(own)))
    moves = {name: move or 0.0 for name, move in steps[1].moves_from(steps[0]).items()}
    assert {name for name, move in moves.items() if move > 1} == {"d"}
    open_ = replace(steps[0], estimates=tuple(replace(one, std=math.inf) for one in steps[0].estimates))
    assert set(steps[1].moves_from(open_).values()) == {None}  # nothing was known of it


def test_json_has_the_keys_of_the_contract_and_finite_numbers() -> None:
    for found in (found_offset(learned=(LAW,)), nothing()):
        data = answer_data(found)
        assert set(data) >= KEYS
        assert json.loads(json.dumps(data, allow_nan=False))["verdict"] == found.verdict


def test_where_error_and_missing_come_from_failures_history_and_laws() -> None:
    found = found_offset(learned=(LAW,), notes=(Note(NoteCode.USED_TO_CHOOSE, {"records": "held.txt"}),))
    data = json.loads(json.dumps(answer_data(found, {"report": "r.html"})))
    assert [(one["record"], one["error"]) for one in data["where"]] == [(f.record, f.error) for f in found.failures]
    assert [(one["step"], one["fit"], one["validate"], one["used_to_choose"]) for one in data["error"]] == [
        ("prior", 8.1, 8.0, True),
        ("refit", 4.2, 3.2, True),
        ("toy.offset", 1.0, 1.01, True),
    ]
    (missing,) = data["missing"]
    assert (missing["slot"], missing["share"], missing["depends_on"]) == ("force", 0.97, "v")
    shape, half = missing["shape"], 1.96 * 0.05
    assert shape["value"] == LAW.coefficients.tolist()
    assert shape["high"] == pytest.approx(LAW.coefficients + half, abs=1e-4)
    assert shape["low"] == pytest.approx(LAW.coefficients - half, abs=1e-4)
    assert data["files"] == {"report": "r.html"}


def test_a_learned_law_tells_the_error_on_unseen_logs_without_it_and_with_it() -> None:
    (law,) = answer_data(nothing(learned=(replace(LAW, held_out=(3.2, 1.6)),)))["learned"]  # type: ignore[misc]
    assert law["held_out"] == [3.2, 1.6]
    assert law["range"] == [-1.0, 1.0]
    (law,) = answer_data(nothing(learned=(LAW,)))["learned"]  # type: ignore[misc]
    assert law["held_out"] == [None, None]


def test_missing_has_laws_that_were_added_ahead_of_the_best_of_other_places() -> None:
    other, same = replace(LAW, slot="supply"), replace(LAW, share=0.5)
    data = answer_data(nothing(learned=(LAW,), missing=(other, same)))
    assert [one["slot"] for one in data["missing"]] == ["force", "supply"]  # type: ignore[attr-defined]
    assert [one["slot"] for one in data["learned"]] == ["force"]  # type: ignore[attr-defined]
    assert nothing(missing=(LAW,)).verdict == "none"  # nothing was added


def test_the_fit_in_percent_is_100_where_the_model_is_the_log() -> None:
    record = found_offset().history[-1].records[2]
    same = replace(record, simulated=record.measured)
    assert same.fit_percent == {"x": 100.0}
    still = replace(
        record, simulated=replace(record.measured, values=0 * record.measured.values + record.measured.values.mean())
    )
    assert still.fit_percent["x"] == pytest.approx(0.0, abs=1e-9)


def test_a_size_that_people_turn_over_is_given_both_ways() -> None:
    found = found_offset()
    (one,) = found.effects
    (parameter,) = one.effect.parameters
    (estimate,) = one.estimates
    turned = replace(
        one,
        effect=replace(one.effect, parameters=(replace(parameter, inverse="G"),)),
        estimates=(replace(estimate, value=0.5, interval=(0.4, 0.6)),),
    )
    (added,) = answer_data(replace(found, effects=(turned,)))["added"]  # type: ignore[misc]
    assert added["parameters"] == {"F_o": 0.5, "G": 2.0}
    assert added["intervals"] == {"F_o": [0.4, 0.6], "G": [1 / 0.6, 2.5]}
    assert added["unit"] == {"F_o": "N", "G": "1/(N)"}
