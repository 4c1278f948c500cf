"""What is given is taken as the kind that is needed, and nothing else is."""

from pathlib import Path

import numpy as np
import pytest

from pysim.types import BadInput
from pysim.types.kinds import mapping_of, names_of, number_of, path_of, whole_number_of


def test_one_name_is_no_row_of_letters_and_lists_are_laid_flat() -> None:
    assert names_of("zyl.seal", "effects") == ("zyl.seal",)
    assert names_of((["a", "b"], "c"), "names") == ("a", "b", "c")
    assert names_of((), "names") == ()


def test_numbers_paths_and_mappings_stay_what_they_are() -> None:
    assert whole_number_of(np.float64(3.0), "starts") == 3
    found = number_of(np.float32(0.5), "hz")
    assert (found, type(found)) == (0.5, float)
    assert path_of("a/b", "folder") == path_of(Path("a/b"), "folder") == Path("a/b")
    assert (mapping_of(None, "units"), mapping_of({"x": "mm"}, "units")) == ({}, {"x": "mm"})


@pytest.mark.parametrize(
    ("take", "given"),
    [
        (number_of, "0.5"), (number_of, None), (number_of, [1.0, 2.0]), (names_of, 3), (names_of, {"a": 1}),
        (names_of, ["a", 3]), (path_of, 3), (path_of, ["a"]), (mapping_of, "mm"),
        (whole_number_of, 1.5), (whole_number_of, float("nan")), (whole_number_of, "2"), (mapping_of, ["x"]),
    ],
)  # fmt: skip
def test_another_kind_is_refused_and_the_argument_named(take, given) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(BadInput, match=r"^hz: .*; write ") as refused:
        take(given, "hz")
    assert refused.value.argument == "hz"
