"""Every note has words, and they name what the note is of."""

import pytest

from pysim.present.notes import words
from pysim.types.note import Note, NoteCode

VALUES = {
    NoteCode.NOISE_ESTIMATED: {"dataset": "bench", "signal": "p", "value": 1e5, "unit": "Pa"},
    NoteCode.NOISE_ASSUMED: {"dataset": "bench", "magnitude": 0.22, "phase": 1.0},
    NoteCode.RECORD_LEFT_OUT: {"record": "a.csv", "reason": "too short"},
    NoteCode.NOT_COMPARED: {"record": "a.csv"},
    NoteCode.NOT_SETTLED: {"record": "a.csv", "others": 2.0},
    NoteCode.NOT_SIMULATED: {"record": "a.csv", "reason": "stiff. No step is short enough."},
    NoteCode.NOT_TRIED: {"effect": "axis.friction", "reason": "no slot takes it"},
    NoteCode.HELD: {"parameter": "m"},
    NoteCode.AT_BOUND: {"parameter": "p_0", "bound": 2e5, "value": 2e5, "unit": "Pa"},
    NoteCode.USED_TO_CHOOSE: {"records": "a.csv, b.csv"},
    NoteCode.INTERVAL_CONDITIONAL: {},
    NoteCode.TABLES_LEFT_OUT: {"count": 2.0},
    NoteCode.HELD_AS_SET: {"parameters": "m, d"},
    NoteCode.BUILT_WITH: {"parameters": "m, d"},
    NoteCode.NO_EFFECT_FITS: {"model": "Lib.Axis"},
    NoteCode.CLASS_UNKNOWN: {"model": "Lib.Axis"},
    NoteCode.SEEN_FROM_OUTSIDE: {"model": "Axis.fmu", "inputs": "u", "outputs": "x, v", "states": 3.0},
    NoteCode.INTERVAL_WIDTHS: {"m": 2.3, "d": 0.4},
    NoteCode.FEW_BLOCKS: {"fewest": 8.0},
    NoteCode.OTHER: {"text": "as it stands"},
}


@pytest.mark.parametrize("code", NoteCode)
def test_each_code_has_words_with_its_names(code: NoteCode) -> None:
    values: dict[str, float | str] = dict(VALUES[code])  # type: ignore[arg-type]
    said = words(Note(code, values))
    assert [value for value in values.values() if isinstance(value, str) and value not in ("Pa", "1", said)] == [
        value for value in values.values() if isinstance(value, str) and value in said and value != said
    ]


def test_numbers_are_shown_in_the_units_of_people() -> None:
    assert "1 bar" in words(Note(NoteCode.NOISE_ESTIMATED, VALUES[NoteCode.NOISE_ESTIMATED]))  # type: ignore[arg-type]
    assert "2 bar" in words(Note(NoteCode.AT_BOUND, VALUES[NoteCode.AT_BOUND]))  # type: ignore[arg-type]


def test_each_parameter_stands_with_its_number() -> None:
    assert "m 2.3, d 0.4" in words(Note(NoteCode.INTERVAL_WIDTHS, {"m": 2.3, "d": 0.4}))
    assert "a.csv and 2 more:" in words(Note(NoteCode.NOT_SETTLED, {"record": "a.csv", "others": 2.0}))
    assert words(Note(NoteCode.NOT_SETTLED, {"record": "a.csv", "others": 0.0})).startswith("a.csv: ")
