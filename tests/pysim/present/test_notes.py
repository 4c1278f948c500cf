"""Every note has words, and they name what the note is of."""

import math

import pytest

from pysim.present.notes import direction_words, sentences, words
from pysim.types import Direction
from pysim.types.note import Note, NoteCode

VALUES = {
    NoteCode.NOISE_ESTIMATED: {"dataset": "bench", "signal": "p", "value": 1e5, "unit": "Pa"},
    NoteCode.NOISE_ASSUMED: {"dataset": "bench", "magnitude": 0.22, "phase": 1.0},
    NoteCode.NOT_COMPARED: {"record": "a.csv"},
    NoteCode.NOT_WIRED: {"outputs": "pi.v", "inputs": "mass.F", "output": "pi.v", "input": "mass.F"},
    NoteCode.NOT_SETTLED: {"record": "a.csv", "others": 2.0},
    NoteCode.NOT_SIMULATED: {"record": "a.csv", "reason": "stiff. No step is short enough."},
    NoteCode.NOT_TRIED: {"effect": "axis.friction", "reason": "no slot takes it"},
    NoteCode.HELD: {"parameter": "m"},
    NoteCode.AT_BOUND: {"parameter": "p_0", "bound": 2e5, "value": 2e5, "unit": "Pa"},
    NoteCode.BEYOND_BOUND: {"effect": "mass.friction"},
    NoteCode.POOR_FIT: {"signal": "x", "factor": 8.17},
    NoteCode.INTERCHANGEABLE: {"m": 1.0, "k": 1.0, "@spread": 0.4},
    NoteCode.CORRELATED: {"first": "m", "second": "k", "correlation": 0.991},
    NoteCode.NOT_AT_REST: {"record": "a.csv"},
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
    NoteCode.SEARCH_GAVE_UP: {"evaluations": 200.0},
    NoteCode.BEYOND_NOISE: {"factor": 12.34},
    NoteCode.DEAD_TIME_AT_BOUND: {"end": "largest", "seconds": 0.02},
    NoteCode.DEAD_TIME_AMBIGUOUS: {"seconds": 0.5},
    NoteCode.EDGE_OF_STABILITY: {},
    NoteCode.INTEGRATOR: {"frequency": 0.01},
    NoteCode.UNSTABLE: {"count": 1.0, "poles": 3.0},
    NoteCode.NOT_DETERMINED: {"names": "b0, a2"},
    NoteCode.CANCELLING: {"pole": 3.0, "zero": 3.1},
    NoteCode.UNBOUNDED: {"parameters": "m, d"},
    NoteCode.NO_NEXT_TEST: {"reason": "no log over time"},
    NoteCode.NO_LAW: {"law": "force: h(force.x)"},
    NoteCode.LAW_VETOED: {"law": "force: h(force.x)"},
    NoteCode.NO_LAW_RUNS: {"places": "force, supply"},
    NoteCode.LAWS_NOT_TRIED: {"effects": "axis.backlash"},
    NoteCode.TRANSIENTS: {"seconds": 0.8},
    NoteCode.NO_HARMONICS: {"begin": 3.4, "end": 3.6},
    NoteCode.FEW_HARMONICS: {"begin": 3.4, "end": 3.6, "kept": 1.0, "count": 10.0},
    NoteCode.DRIFTING: {"percent": 2.5},
    NoteCode.MEMORY: {},
    NoteCode.MEMORY_IN_HARMONICS: {},
    NoteCode.HARMONICS: {"count": 1.0, "points": 2.0, "frequency": 5.0, "percent": 3.0},
    NoteCode.LOST_IN_NOISE: {"frequency": 12.0},
    NoteCode.FAST_SWEEP: {"frequency": 1.4},
    NoteCode.FEW_SAMPLES: {"samples": 5.0},
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


def test_a_note_of_one_frequency_stands_behind_it() -> None:
    assert words(Note(NoteCode.DRIFTING, {"percent": 2.5, "at": 0.5})).startswith("0.5 Hz: the sine changes by 2.5")


@pytest.mark.parametrize(
    ("exponents", "spread", "said"),
    [
        ({"K": 1.0, "g": -1.0}, math.inf, ["K and g apart", "K may be 10 % larger if g is 9.1 % smaller"]),
        (
            {"m": 1.0, "J": -0.27, "c": 0.11},
            math.log(1.5),
            ["m, J and c", "50 % larger if J is 10 % smaller and c is 4.6 %"],
        ),
        ({"a": 1.0, "b": 2.0}, math.log(3.0), ["a may be 3 times as large if b is 9 times as large"]),
        ({"a": 1.0, "b": -1.0}, math.log(4.0), ["if b is 4 times smaller"]),
        ({"d": 1.0}, math.log(1.25), ["hardly determine d", "25 % larger"]),
        ({"d": 1.0}, math.inf, ["do not determine d"]),
    ],
)
def test_what_is_not_told_apart_comes_with_its_sizes(
    exponents: dict[str, float], spread: float, said: list[str]
) -> None:
    text = direction_words(Direction(exponents, spread))
    assert all(one in text for one in said)


@pytest.mark.parametrize(
    ("exponents", "spread", "reach", "said"),
    [
        ({"T": 1.0, "k": 2.0}, 57.0, (0.1, 7.0), ["T may be 7 times as large if k is 49 times as large"]),
        ({"T": 1.0, "k": -2.0}, 57.0, (0.1, 1.0), ["T may be 10 times smaller if k is 1e+02 times as large"]),
        ({"T": 1.0, "k": 1.0}, 57.0, (1.0, 1.0), ["tell T and k apart. Fix"]),
        ({"T": 1.0, "k": 1.0}, 99.0, (0.0, math.inf), ["T may be more than 1000 times as large"]),
        ({"T": 1.0}, 0.6, (1.0, 5.6), ["it may be 5.6 times as large."]),
        ({"T": 1.0}, 0.6, (0.5, 1.4), ["it may be 2 times smaller or 40 % larger."]),
        ({"k": 1.0}, math.inf, (0.0, 20.0), ["any value within its bounds"]),
        ({"k": 1.0}, 80.0, (0.0, 20.0), ["it may be 20 times as large."]),
    ],
)
def test_what_is_not_told_apart_is_said_up_to_the_ends_of_the_intervals(
    exponents: dict[str, float], spread: float, reach: tuple[float, float], said: list[str]
) -> None:
    one = Direction(exponents, spread, reach)
    note = Note(NoteCode.INTERCHANGEABLE, {**exponents, "@spread": spread, "@low": reach[0], "@high": reach[1]})
    assert all(part in direction_words(one) for part in said)
    assert words(note) == direction_words(one)


def test_parameters_at_their_bounds_share_a_sentence() -> None:
    ends = [
        Note(NoteCode.AT_BOUND, {"parameter": name, "bound": 60.0, "value": 60.0, "unit": "kg"}) for name in ("m", "n")
    ]
    other = Note(NoteCode.NOT_COMPARED, {"record": "a.txt"})
    assert sentences([other, *ends, other]) == [
        words(other),
        "m (60 kg) and n (60 kg) stopped at their bounds: widen those beyond which values make sense, or fix the "
        "parameters.",
        words(other),
    ]
    assert sentences(ends[:1]) == [words(ends[0])]
