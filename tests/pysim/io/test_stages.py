"""The stages of a diagnosis in a file: the same numbers back, and nothing that could run."""

import os
from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_stages, write_stages
from pysim.types import BadInput
from tests.pysim.diagnosis_answer import found_offset

_HANDLES = Path("/proc/self/fd")


def test_every_record_comes_back_bit_for_bit(tmp_path: Path) -> None:
    stages = found_offset().history
    write_stages(tmp_path / "a.npz", stages)
    file = read_stages(tmp_path / "a.npz")
    assert [about["step"] for about in file.about] == ["prior", "refit", "toy.offset"]
    for stage, about in zip(stages, file.about, strict=True):
        for fit, own in zip(stage.records, about["records"], strict=True):
            for what in ("measured", "simulated"):
                sent = getattr(fit, what)
                assert np.array_equal(file.array(own[what]), sent.values)
                assert np.array_equal(file.array(own["time"]), sent.time)
            assert (own["source"], own["use"], tuple(own["noise"])) == (fit.source, fit.use, fit.noise)
            assert own["index"] == fit.index
            assert own["rms"] == list(fit.rms.values())


def test_estimates_keep_their_intervals_and_what_is_not_determined(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", found_offset().history)
    refit = read_stages(tmp_path / "a.npz").about[1]
    m, k, _ = refit["estimates"]
    assert (m["name"], m["determined"]) == ("m", False)
    assert (k["value"], k["low"], k["high"]) == (3.0, 2.7, 3.3)
    assert refit["undetermined"][0]["exponents"] == {"m": 1.0, "k": 2.0}


@pytest.mark.parametrize("content", [b"no archive", b""])
def test_another_file_is_refused(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(BadInput, match="holds no stages of a diagnosis"):
        read_stages(tmp_path / "a.npz")


def test_objects_are_never_unpacked(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", about=np.array([{"form": 1}], dtype=object))
    with pytest.raises(BadInput, match="holds no stages"):
        read_stages(tmp_path / "a.npz")


def test_a_missing_file_is_said(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="cannot be read"):
        read_stages(tmp_path / "none.npz")


@pytest.mark.skipif(not _HANDLES.is_dir(), reason="the system does not list open files")
def test_no_file_stays_open_when_an_array_was_read(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", found_offset().history)
    file = read_stages(tmp_path / "a.npz")
    file.array("t0/0")
    assert os.path.realpath(file.path) not in {os.path.realpath(handle) for handle in _HANDLES.iterdir()}


def test_a_file_that_was_removed_since_is_said(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", found_offset().history)
    file = read_stages(tmp_path / "a.npz")
    file.path.unlink()
    with pytest.raises(BadInput, match=r"a\.npz: cannot be read"):
        file.array("t0/0")
