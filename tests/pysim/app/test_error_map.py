"""Where the error is: every record in its cell."""

from pathlib import Path

from pysim.app.error_map import error_maps
from pysim.io import read_stages, write_stages
from tests.pysim.diagnosis_story import dataset, story


def test_sines_go_by_working_point_and_frequency_and_logs_by_signal(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", story().stages)
    stage = read_stages(tmp_path / "a.npz").about[1]
    sines, logs = error_maps(stage, dataset())
    assert (sines.rows, sines.columns, sines.title) == (("50 ± 10",), ("1", "5"), "Frequency (Hz)")
    assert sines.sources == (("sines/1Hz.txt", "sines/5Hz.txt"),)
    assert (logs.rows, logs.columns) == (("wave.txt (fitted)", "held.txt (held out)"), ("x",))
    told = {record["source"]: record["rms"][0] for record in stage["records"]}
    for one in (sines, logs):
        for row, own in zip(one.sources, one.values, strict=True):
            assert [told[source] for source in row] == list(own)
