import json
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.present.report import MARKER
from tests.pysim.cli.ran import refused


def test_gains_of_the_load_controller(tmp_path: Path) -> None:
    words = ["tune", "load", "--crossover", "3.0", "--phase-margin", "60", "--json", str(tmp_path / "t.json")]
    assert main([*words, "--output", str(tmp_path / "out"), "--gains", "2e-9,0.05"]) == 0
    found = json.loads((tmp_path / "t.json").read_text())
    assert list(found) == ["tuned", "MATLAB tuned (Table 6.1)", "manually tuned (Table 6.1)", "2e-9,0.05"]
    assert found["tuned"]["K_p"] == pytest.approx(1.01e-9, rel=0.05)
    assert found["tuned"]["phase_margin_deg"] == pytest.approx(60)
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"tuning.png", "tuning.svg", "report.html", MARKER}


def test_a_plant_of_ones_own_with_dead_time(tmp_path: Path) -> None:
    words = ["tune", "own", "--numerator", "2", "--denominator", "0.5,1", "--delay", "0.05"]
    assert main([*words, "--json", str(tmp_path / "t.json")]) == 0
    found = json.loads((tmp_path / "t.json").read_text())["tuned"]
    assert found["stable"]
    assert found["phase_margin_deg"] >= 60.0
    assert found["gain_margin_db"] >= 6.0
    assert main([*words, "--gains", "50,1"]) == 1


@pytest.mark.parametrize(("dt", "code"), [("0.3", 0), ("0.6", 1)])
def test_a_loop_that_diverges_as_it_is_sampled_is_a_no(dt: str, code: int, tmp_path: Path) -> None:
    words = ["tune", "own", "--numerator", "2", "--denominator", "0.5,1", "--delay", "0.05", "--dt", dt]
    assert main([*words, "--json", str(tmp_path / "t.json")]) == code
    found = json.loads((tmp_path / "t.json").read_text())["tuned"]
    assert found["stable"] == (code == 0)
    assert found["stable_unsampled"]


def test_loops_of_the_thesis_are_beside_the_question(tmp_path: Path) -> None:
    """With 0.2 s of dead time, which none of them was tuned for, both are unstable."""
    assert main(["tune", "load", "--delay", "0.2", "--json", str(tmp_path / "t.json")]) == 0
    found = json.loads((tmp_path / "t.json").read_text())
    assert [loop["stable"] for loop in found.values()] == [True, False, False]


@pytest.mark.parametrize("gains", ["-1e-9,0.5", "-.5,1", "-2E1,1"])
def test_gains_may_be_negative(gains: str, tmp_path: Path) -> None:
    assert main(["tune", "load", "--gains", gains, "--json", str(tmp_path / "t.json")]) == 1  # the wrong sign
    assert json.loads((tmp_path / "t.json").read_text())[gains]["K_p"] == float(gains.split(",")[0])


def test_an_unstable_loop_is_a_no() -> None:
    """Behind the resonance the phase is beyond half a turn whatever the controller."""
    assert main(["tune", "speed", "--crossover", "8", "--phase-margin", "-60"]) == 1


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["own"], "give both, or name a plant"),
        (["load", "--numerator", "1"], "give both, or name a plant"),
        (["own", "--numerator", "1,x", "--denominator", "1,1"], "write numbers"),
        (["load", "--dt", "0"], "--dt: 0 is not above 0; give a positive number"),
        (["load", "--gains", "1"], "write 2 numbers"),
        (["speed", "--crossover", "0.1", "--phase-margin", "60"], "out of a PI controller's reach"),
    ],
)
def test_wrong_use(words: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    refused(["tune", *words], capsys, told)
