import json
from pathlib import Path

import pytest

from pysim.cli import main
from tests.pysim.cli.ran import refused


def test_steps_come_to_rest(tmp_path: Path) -> None:
    words = ["rig", "step", "--length", "3", "--json", str(tmp_path / "s.json"), "--output", str(tmp_path / "out")]
    assert main(words) == 0
    speed, load = json.loads((tmp_path / "s.json").read_text())
    assert (speed["kind"], load["kind"]) == ("speed", "load")
    assert abs(load["steady_error"]) < 0.01 * 40e5
    assert 0.1 < load["overshoot"] < 0.6
    for name in ("step_speed.png", "step_load.svg", "report.html"):
        assert (tmp_path / "out" / name).is_file()


@pytest.mark.slow
def test_heave_compares_controllers(tmp_path: Path) -> None:
    words = ["rig", "heave", "--length", "4", "--fmi", "3", "--interface", "model-exchange", "--dt", "0.002"]
    assert main([*words, "--json", str(tmp_path / "h.json"), "--output", str(tmp_path / "out")]) == 0
    found = json.loads((tmp_path / "h.json").read_text())
    assert list(found["controllers"]) == ["thesis", "compensated", "gain for the shaft", "both"]
    assert found["wave"]["length_s"] == 4.0
    assert all(one["pressure_rms"] > one["pressure_slow_rms"] > 0 for one in found["controllers"].values())
    assert (tmp_path / "out" / "heave_error.png").is_file()


def test_slow_controllers_are_recorded_at_their_own_steps(tmp_path: Path) -> None:
    """At 10 ms the valve's loop still holds; it overshoots more than at 1 ms, as the sampling turns the phase."""
    found = {}
    for dt in ("0.01", "0.0007", "0.001"):
        assert main(["rig", "step", "--length", "2", "--dt", dt, "--json", str(tmp_path / "s.json")]) == 0
        found[dt] = json.loads((tmp_path / "s.json").read_text())[1]
        assert abs(found[dt]["steady_error"]) < 0.05 * 40e5
    assert found["0.01"]["overshoot"] > found["0.001"]["overshoot"]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["heave", "--period", "0"], ["peak period"]),
        (["step", "--dt", "0"], ["--dt 0", "give seconds"]),
        (["step", "--speed", "0"], ["other than zero"]),
    ],
)
def test_mistakes_are_one_line(words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    refused(["rig", *words], capsys, *named)
