"""A plan as files: what is played is the plan's command, and logs of a bench whose answer is known are read back."""

from pathlib import Path

import nptdms
import numpy as np
import pytest

from pysim.bench import Plan, read_plan, write_commands
from pysim.cli import main
from pysim.identify import measured_responses
from pysim.io import read_dataset, read_signal
from pysim.types import BadInput

LAG = 0.02  # s of the bench: first order
PLAN = """
[plan]
name = "short"
[signals.u]
role = "input"
unit = "%"
[signals.follower]
role = "input"
unit = "bar"
follows = "u"
ratio = 0.5
[signals.y]
role = "output"
unit = "%"
noise = 0.01
[logging]
rate = 1000
[[tests]]
kind = "frequency-response"
outputs = ["y"]
points = [[20, 5]]
frequencies = [1, 4]
"""


@pytest.fixture
def plan(tmp_path: Path) -> Plan:
    file = tmp_path / "short.toml"
    file.write_text(PLAN)
    return read_plan(file)


def rows_of(folder: Path) -> list[dict[str, str]]:
    heads, *rows = (line.split(",") for line in (folder / "commands" / "index.csv").read_text().splitlines())
    return [dict(zip(heads, row, strict=True)) for row in rows]


def test_text_holds_the_command_below_its_header(plan: Plan, tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    write_commands(plan, folder, form="csv")
    for run, row in zip(plan.runs(), rows_of(folder), strict=True):
        text = (folder / row["file"]).read_text().splitlines()
        assert text[0] == "time [s],u [%],follower [bar]"
        own = folder / "one.csv"
        own.write_text("\n".join(line.rpartition(",")[0] for line in text))
        times = np.arange(int(row["samples"])) / float(row["rate [Hz]"])
        assert read_signal(own, "test").value(times) == pytest.approx(run.command.signal().value(times), abs=1e-6)
        assert float(row["log from [s]"]) == run.log_from
        along = np.array([float(line.rpartition(",")[2]) for line in text[1:]])
        assert along == pytest.approx(0.5 * run.command.signal().value(times), abs=1e-6)


def test_a_generator_s_samples_lie_between_its_ends(plan: Plan, tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    write_commands(plan, folder, form="generator", sampling_hz=500)
    for run, row in zip(plan.runs(), rows_of(folder), strict=True):
        samples = np.loadtxt(folder / row["file"])
        assert (samples.min(), samples.max(), samples.size) == (-1.0, 1.0, int(row["samples"]))
        played = float(row["offset"]) + float(row["scale"]) * samples
        expected = run.command.signal().value(np.arange(samples.size) / 500)
        assert played == pytest.approx(expected, abs=1e-5)


def answered(folder: Path, row: dict[str, str]) -> None:
    """A bench that plays a TDMS file and logs it with its own answer, y' = (u - y) / LAG along straight lines."""
    with nptdms.TdmsFile.open(folder / row["file"]) as file:
        channels = {channel.name: channel for channel in file["command"].channels()}
        u, follower = channels["u"][:], channels["follower"][:]
        step = channels["u"].properties["wf_increment"]
        assert channels["u"].properties["unit_string"] == "%"
    y, share = np.zeros_like(u), np.exp(-step / LAG)
    for k in range(1, u.size):
        slope = (u[k] - u[k - 1]) / step
        y[k] = u[k] - LAG * slope + (y[k - 1] - u[k - 1] + LAG * slope) * share
    time = step * np.arange(u.size)
    kept = (time >= float(row["log from [s]"])) & (time <= float(row["log to [s]"]))
    path = folder / row["log"]
    path.parent.mkdir(parents=True, exist_ok=True)
    columns = {"time": time, "u": u, "follower": follower, "y": y}
    with nptdms.TdmsWriter(path) as writer:
        writer.write_segment([nptdms.ChannelObject("log", name, values[kept]) for name, values in columns.items()])


def test_logs_of_a_first_order_bench_are_read_back_by_one_command(plan: Plan, tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    write_commands(plan, folder, form="tdms")
    assert main(["data", "check", str(folder)]) == 2  # the logs are not there yet
    for row in rows_of(folder):
        answered(folder, row)
    assert main(["data", "check", str(folder)]) == 0
    (response,) = [one.response for one in measured_responses(read_dataset(folder), output="y")]
    exact = 1 / (1 + 2j * np.pi * response.frequency * LAG)
    assert response.gain == pytest.approx(np.abs(exact), rel=1e-3)
    assert response.phase == pytest.approx(np.angle(exact), abs=1e-3)


def test_what_cannot_be_written_is_refused(plan: Plan, tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    for words, match in (({"form": "wav"}, "choose of"), ({"sampling_hz": 7.0}, "do not show 4 Hz")):
        with pytest.raises(BadInput, match=match):
            write_commands(plan, folder, **words)  # type: ignore[arg-type]
        assert not folder.exists()  # though 7 rows per second do show the first sine
    write_commands(plan, tmp_path / "there")
    with pytest.raises(BadInput, match="something is there already"):
        write_commands(plan, tmp_path / "there")
