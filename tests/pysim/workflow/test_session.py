"""A model and its measurements, opened by their names and paths."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import pysim
from pysim.types import BadInput, FrequencyResponse, MeasuredRecord, NoteCode, SineTest
from pysim.workflow import (
    SessionParts,
    data_of,
    effects_of,
    inside,
    model_of,
    open_session,
    reference_of,
    session_parts,
)
from tests.toy import CATALOGUE, library, measured


def parts(*, model: Path | str = "Toy.Mass", effects: tuple[str, ...] | None = None) -> SessionParts:
    return session_parts(
        model_of(model, [library()]),
        measured(1, "toy.friction", F_c=0.4),
        libraries=[library()],
        bounds={"m": (0.5, 5.0)},
        values={},
        effects=effects,
        reference_hz=None,
    )


def test_names_and_paths_are_enough(rubbing: Path) -> None:
    session = open_session("Toy.Mass", rubbing, library=library(), free=["m", "d"], values={"d": 0.5, "k": 19.0})
    assert (session.model["d"].start, [p.name for p in session.parameters]) == (0.5, ["m", "d"])
    assert {effect.name for effect in session.catalogue} == set(CATALOGUE)
    assert session.data.overrides == {"k": 19.0}
    none = open_session("Toy.Mass", rubbing, library=library(), free=["m", "d"], effects=[])
    assert (none.catalogue, session.catalogue == ()) == ((), False)


def test_the_package_opens_a_session_itself(rubbing: Path) -> None:
    with pytest.raises(pysim.BadInput, match="nowhere"):
        pysim.open_session("Toy.Mass", rubbing, library="nowhere.mo")
    with pytest.raises(AttributeError):
        pysim.nothing  # noqa: B018


def test_what_is_open_already_is_taken_as_it_is(rubbing: Path) -> None:
    model = model_of("Toy.Mass", [library()])
    named = open_session("Toy.Mass", str(rubbing), library=[library()])
    opened = open_session(model, data_of(rubbing / "dataset.toml"), library=library())
    assert (opened.parameters, opened.catalogue, opened.notes) == (named.parameters, named.catalogue, named.notes)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"values": {"kk": 1.0}}, "kk"),
        ({"free": ["kk"]}, "kk"),
        ({"bounds": {"k": (1.0, 2.0)}, "free": ["m"]}, "k has bounds but is not free"),
        ({"effects": ["toy.fricton"]}, "did you mean toy.friction"),
        ({"effects": ["valve.deadband"]}, "no slot of Toy.Mass takes it"),
    ],
)
def test_a_wrong_name_is_refused(rubbing: Path, more: dict[str, object], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        open_session("Toy.Mass", rubbing, library=library(), **more)  # type: ignore[arg-type]


def test_the_parts_of_a_class_and_of_a_closed_fmu(foreign: Path) -> None:
    known, closed = parts(effects=("toy.bias",)), parts(model=foreign)
    assert [effect.name for effect in known.catalogue] == ["toy.bias"]
    assert known.variants is not None
    assert [slot.name for slot in known.inside.slots] == [slot.name for slot in known.variants.slots] == ["force"]
    assert known.notes == ()
    assert (closed.variants, closed.inside.slots) == (None, ())
    assert [note.code for note in closed.notes] == [NoteCode.CLASS_UNKNOWN, NoteCode.SEEN_FROM_OUTSIDE]
    with pytest.raises(BadInput, match="its class is in none of the libraries"):
        effects_of(["toy.bias"], closed)


def test_effects_come_in_the_order_of_their_names() -> None:
    assert [one.name for one in effects_of(["toy.twin", "toy.bias"], parts())] == ["toy.twin", "toy.bias"]
    with pytest.raises(BadInput, match=r"toy\.bias: named twice"):
        effects_of(["toy.bias", "toy.bias"], parts())


def test_inside_a_model_are_its_slots_and_what_they_take() -> None:
    found = inside(model_of("Toy.Mass", [library()]), [library()])
    assert (found.class_name, [slot.name for slot in found.slots]) == ("Toy.Mass", ["force"])
    assert {effect.name for effect in found.taken} == set(CATALOGUE)
    assert {effect.name for effect in found.catalogue} > set(CATALOGUE)


@pytest.mark.parametrize(
    ("text", "is_pump"),
    [
        ("model Mine extends HydraulicTestBench.Pump.A4VSG; end Mine;", True),
        ("model Half extends HydraulicTestBench.Pump.FreeGreyBox; end Half; model Mine extends Half; end Mine;", True),
        ("model Mine HydraulicTestBench.Pump.A4VSG pump; end Mine;", False),
        ("model Mine Real x = time; end Mine;", False),
    ],
)
def test_limits_of_the_thesis_hold_for_its_pump_and_what_extends_it(text: str, is_pump: bool, tmp_path: Path) -> None:
    (tmp_path / "Mine.mo").write_text(text)
    model = replace(model_of("Toy.Mass", [library()]), name="Mine")
    assert inside(model, [tmp_path / "Mine.mo"]).is_thesis_pump is is_pump


def response(*frequencies: float) -> FrequencyResponse:
    ones = np.ones(len(frequencies))
    return FrequencyResponse(np.array(frequencies), ones, -ones, SineTest(0.0, 1.0, "F", "x"), "measured")


def test_gains_are_relative_to_the_frequency_of_the_thesis_where_all_tests_have_it() -> None:
    assert reference_of([response(0.1, 1.0), response(0.1, 2.0)]) == 0.1
    assert reference_of([response(0.1, 1.0), response(0.2, 2.0)]) is None
    assert reference_of([response(0.1)], 3.0) == 3.0
    assert reference_of([response(0.1)], None) is None


def test_a_table_beside_logs_is_left_out() -> None:
    data = measured(1, "toy.friction", F_c=0.4)
    table = MeasuredRecord("t", "frequency-response-table", "fit", response(0.1, 1.0), offset=0.0, amplitude=1.0)
    both = replace(data, records=(*data.records, table))
    found = session_parts(
        model_of("Toy.Mass", [library()]), both, libraries=[library()], bounds={}, values={}, reference_hz=None
    )
    assert len(found.dataset.records) == len(data.records)
    assert [(note.code, dict(note.values)) for note in found.notes] == [(NoteCode.TABLES_LEFT_OUT, {"count": 1})]
