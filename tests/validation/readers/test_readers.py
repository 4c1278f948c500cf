"""A reader of untrusted text gives an answer or one sentence; the case `readers` tries 10,000 inputs of each."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from validation.readers.case import trouble
from validation.readers.kinds import KINDS, Kind
from validation.readers.spoiled import spoiled

EXAMPLES = {"Modelica": 10, "SSP": 25, "system": 40}  # those that start a process or unpack an archive each time


@pytest.mark.parametrize("name", KINDS)
def test_the_right_input_is_taken(name: str) -> None:
    assert trouble(KINDS[name], KINDS[name].right()) is None


@pytest.mark.parametrize("name", KINDS)
def test_a_spoiled_input_ends_in_an_answer_or_one_sentence(name: str) -> None:
    kind, right = KINDS[name], KINDS[name].right()

    @settings(max_examples=EXAMPLES.get(name, 60))
    @given(st.integers(0, 2**32 - 1))
    def ends_well(seed: int) -> None:
        assert not trouble(kind, spoiled(right, seed))

    ends_well()


@pytest.mark.parametrize("name", ["data set", "log", "FMU description", "plan", "system"])
def test_any_bytes_end_in_an_answer_or_one_sentence(name: str) -> None:
    @settings(max_examples=30)
    @given(st.binary(max_size=200))
    def ends_well(data: bytes) -> None:
        assert not trouble(KINDS[name], data)

    ends_well()


def test_a_traceback_or_several_lines_are_trouble() -> None:
    def fails(data: bytes, folder: Path) -> object:
        return data.decode("ascii")

    assert trouble(Kind(lambda: b"", fails), b"a") is None
    assert "UnicodeDecodeError" in str(trouble(Kind(lambda: b"", fails), b"\xff"))


def test_the_same_seed_spoils_in_the_same_way() -> None:
    right = KINDS["log"].right()
    assert spoiled(right, 7) == spoiled(right, 7)
    assert len({spoiled(right, seed) for seed in range(50)}) > 40
