"""Where the server is, who may start it, and what it gives beside the page."""

import http.client
import os
import re
import signal
import socket
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import urlsplit

import pytest

from pysim import present
from pysim.app import server as routes_of
from pysim.app.answers import Answer
from pysim.app.jobs import DONE, Job, Work
from pysim.app.lock import held
from pysim.app.server import free_port, overlay_of, page_address, serve
from pysim.app.upload import Limits
from pysim.io import read_stages, write_stages
from pysim.types import BadInput
from tests.pysim.app.browser import Show, asked, base, server
from tests.pysim.diagnosis_answer import dataset, found_offset

_WAVE = 2  # number of the log wave.txt in the data set


def test_a_record_whose_result_was_removed_meanwhile_is_none(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", found_offset().history)
    job = Job(Work("diagnose", "Find", ("diagnose",)), DONE, 1.0, 2.0, "")
    answer = Answer(job, tmp_path, present.data(found_offset()), read_stages(tmp_path / "a.npz"))
    check, answers = SimpleNamespace(dataset=dataset()), SimpleNamespace(all=(answer,))
    desk: Any = SimpleNamespace(check=check, answers=answers)
    overlay = overlay_of(desk, "diagnose", _WAVE)
    assert overlay is not None
    assert overlay.names == ("x",)
    (tmp_path / "a.npz").unlink()
    assert overlay_of(desk, "diagnose", _WAVE) is None


def test_of_two_records_of_one_file_the_one_that_was_asked_for_is_given(tmp_path: Path) -> None:
    """As a .tdms or .parquet file holds them: the same file, other columns."""
    told = found_offset()
    wave = told.history[0].records[_WAVE]
    names = {_WAVE: "x", _WAVE + 1: "y"}
    stages = []
    for stage in told.history:
        records = list(stage.records[:_WAVE])
        for k, name in names.items():
            measured, simulated = (replace(r, names=(name,), values=k + 0 * r.values) for r in (wave.measured,) * 2)
            records.append(replace(wave, index=k, source="a.tdms", measured=measured, simulated=simulated))
        stages.append(replace(stage, records=tuple(records)))
    write_stages(tmp_path / "a.npz", stages)
    logs = list(dataset().records)
    for k, name in names.items():
        data: Any = logs[_WAVE].data
        logs[k] = replace(logs[_WAVE], source="a.tdms", data=replace(data, names=("F", name)))
    job = Job(Work("diagnose", "Find", ("diagnose",)), DONE, 1.0, 2.0, "")
    answer = Answer(job, tmp_path, present.data(found_offset()), read_stages(tmp_path / "a.npz"))
    check = SimpleNamespace(dataset=replace(dataset(), records=tuple(logs)))
    desk: Any = SimpleNamespace(check=check, answers=SimpleNamespace(all=(answer,)))
    for k, name in names.items():
        overlay = overlay_of(desk, "diagnose", k)
        assert overlay is not None
        assert overlay.names == (name,)
        assert overlay.lines[0].values[0] == 1000 * k  # mm


@pytest.mark.parametrize(
    ("host", "address"),
    [
        ("127.0.0.1", "http://127.0.0.1:80"),
        ("localhost", "http://127.0.0.1:80"),
        ("0.0.0.0", "http://127.0.0.1:80"),
        ("::1", "http://[::1]:80"),
        ("::", "http://[::1]:80"),
        ("192.168.0.7", "http://192.168.0.7:80"),
        ("fd00::7", "http://[fd00::7]:80"),
        ("bench.example", "http://bench.example:80"),
    ],
)
def test_the_address_is_where_it_answers(host: str, address: str) -> None:
    assert page_address(host, 80) == address


def test_a_second_server_touches_nothing_and_tells_where_the_first_is(tmp_path: Path) -> None:
    running, coming = tmp_path / "p/results/try/job.json", tmp_path / "p/uploads/half/a.txt"
    for path in (tmp_path / "p/project.toml", running, coming):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("")
    running.write_text(
        '{"work": {"name": "try", "title": "", "words": [], "effects": []}, "state": "running", "begun": 1, '
        '"ended": null, "fingerprint": "", "message": ""}'
    )
    before = running.read_bytes()
    with held(tmp_path / "p") as tell:
        tell("http://127.0.0.1:8080")
        with pytest.raises(BadInput, match=r"p: a workbench on it runs at http://127.0.0.1:8080 \(process \d+\); use"):
            serve(tmp_path / "p", show=False, limits=Limits())
    assert running.read_bytes() == before
    assert coming.exists()


def test_a_port_that_another_has_is_refused() -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        number = other.getsockname()[1]
        with pytest.raises(BadInput, match=rf"--port {number} at 127.0.0.1: .*; name another, or leave it out"):
            free_port("127.0.0.1", number)


@pytest.fixture
def six() -> str:
    """The loopback of IPv6, where there is one."""
    try:
        with socket.socket(socket.AF_INET6) as probe:
            probe.bind(("::1", 0))
    except OSError:
        pytest.skip("there is no IPv6 here")
    return "::1"


def test_a_killed_server_makes_room_for_the_next_and_ipv6_is_answered(tmp_path: Path, six: str) -> None:
    with server(tmp_path / "p", "--host", six) as address:
        assert base(address).startswith("http://[::1]:")
        assert status(address) == 303
        cookie = f'a,b=1; theme={{"dark": true}}; pysim_app_{urlsplit(address).port}={address.partition("token=")[2]}'
        assert status(f"{base(address)}/", Cookie=cookie) == 200
        assert status(f"{base(address)}/_nicegui_ws/socket.io/?EIO=4&transport=polling", Cookie=cookie) == 200
        with pytest.raises(BadInput, match=re.escape(f"runs at {base(address)} (process ")) as refused:
            serve(tmp_path / "p", show=False, limits=Limits())
        os.kill(int(str(refused.value).partition("(process ")[2].partition(")")[0]), signal.SIGKILL)
        _until(lambda: _free(tmp_path / "p"))


def _free(folder: Path) -> bool:
    """Whether the next server gets a project."""
    try:
        with held(folder):
            return True
    except BadInput:
        return False


def test_a_drop_that_the_disk_refuses_is_told_in_a_sentence(show: Show, tmp_path: Path) -> None:
    (tmp_path / "p/data").mkdir(parents=True)
    (tmp_path / "p/project.toml").write_text("")
    (tmp_path / "p/earlier").write_text("where the data set should go")
    address = show(tmp_path / "p")
    _, name = asked(address, "POST", "/upload")
    assert asked(address, "PUT", f"/upload/{name}?name=a.csv", b"0,1\n") == (200, "kept")
    code, words = asked(address, "POST", f"/upload/{name}/done?files=1")
    assert (code, words.partition(";")[0]) == (507, f"{tmp_path / 'p/earlier'}: File exists")
    assert list((tmp_path / "p/uploads").iterdir()) == []


def test_a_file_that_comes_twice_ends_the_drop_and_nothing_of_it_stays(show: Show, tmp_path: Path) -> None:
    address = show(tmp_path / "p")
    _, name = asked(address, "POST", "/upload")
    many = b"0,1\n" * 10**6  # comes in many pieces
    assert asked(address, "PUT", f"/upload/{name}?name=d/a.csv", many) == (200, "kept")
    told = (422, "d/A.csv and d/a.csv would be one file; rename one of them, or drop one at a time")
    assert asked(address, "PUT", f"/upload/{name}?name=d/A.csv", b"0,2\n") == told
    assert asked(address, "POST", f"/upload/{name}/done?files=1")[0] == 409
    assert list((tmp_path / "p/uploads").iterdir()) == []
    assert not (tmp_path / "p/data").exists()


def test_an_upload_that_breaks_off_is_not_taken_for_a_whole_one(show: Show, tmp_path: Path) -> None:
    address = show(tmp_path / "p")
    parts = urlsplit(address)
    _, name = asked(address, "POST", "/upload")
    head = (
        f"PUT /upload/{name}?name=a.csv HTTP/1.1", f"Host: {parts.netloc}", "Content-Length: 400",
        f"Cookie: pysim_app_{parts.port}={address.partition('token=')[2]}", "", "",
    )  # fmt: skip
    with socket.create_connection((parts.hostname or "", parts.port or 0)) as half:
        half.sendall("\r\n".join(head).encode() + b"0,1\n" * 50)
        _until(lambda: any(path.is_file() for path in (tmp_path / "p/uploads").rglob("*")))
    _until(lambda: not any((tmp_path / "p/uploads").iterdir()))
    assert asked(address, "POST", f"/upload/{name}/done?files=1")[0] == 409
    _, name = asked(address, "POST", "/upload")
    assert asked(address, "PUT", f"/upload/{name}?name=a.csv", b"0,1\n") == (200, "kept")
    assert asked(address, "POST", f"/upload/{name}/done?files=2") == (409, "1 of 2 files arrived; drop them again")
    assert list((tmp_path / "p/uploads").iterdir()) == []
    assert not (tmp_path / "p/data").exists()


def _until(met: Callable[[], bool]) -> None:
    begun = time.monotonic()
    while not met():
        assert time.monotonic() - begun < 60
        time.sleep(0.01)


def status(address: str, **headers: str) -> int:
    """Of a page, whatever it leads to."""
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=60)
    connection.request("GET", f"{parts.path}?{parts.query}", headers=headers)
    return connection.getresponse().status


ROUTES = re.findall(r'@app\.(get|post|put)\("([^"]+)"', Path(routes_of.__file__).read_text(encoding="utf-8"))


@pytest.mark.parametrize(("method", "route"), [*ROUTES, ("get", "/"), ("get", "/static/app.css"), ("get", "/compare")])
def test_no_route_lets_in_who_has_no_token_comes_from_elsewhere_or_asks_by_another_name(
    method: str, route: str, show: Show, tmp_path: Path
) -> None:
    """Each route that the server has, also those that are added later."""
    assert {path for _, path in ROUTES} >= {"/notebook", "/series", "/upload", "/commands/{name}"}
    address = show(tmp_path / "p", idle=True)
    parts, path = urlsplit(address), re.sub(r"{[^}]*}", "x", route)
    cookie = {"Cookie": f"pysim_app_{parts.port}={address.partition('token=')[2]}"}
    wrong: list[dict[str, str]] = [
        {},
        {"Cookie": f"pysim_app_{parts.port}=guessed"},
        {"Origin": "http://evil.example", **cookie},
    ]
    for headers in [*wrong, {"Host": "evil.example", **cookie}, {"Host": f"evil.example:{parts.port}", **cookie}]:
        connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=60)
        connection.request(method.upper(), path, headers=headers)
        answer = connection.getresponse()
        assert (answer.status, b"token" in answer.read()) == (403, True), headers
    assert not (tmp_path / "p/uploads").exists()
    assert asked(address, method.upper(), path)[0] != 403


def test_no_address_leads_out_of_the_project(show: Show, tmp_path: Path) -> None:
    address = show(tmp_path / "p", idle=True)
    secret = tmp_path / "secret.txt"
    secret.write_text("only for me")
    _, name = asked(address, "POST", "/upload")
    up = ("..", "%2e%2e", "%2e.", "..%2f..%2f..", "..%5c..%5c..", "%252e%252e")
    for start in ("/result/x", "/result", "/commands", "/static", "/notebook", "/series", f"/upload/{name}"):
        for one in up:
            for place in (f"{start}/{one}/{one}/{one}/secret.txt", f"{start}/{one}", f"{start}/{secret}"):
                assert "only for me" not in asked(address, "GET", place)[1], place
    for one in ("../../a.txt", "/tmp/a.txt", "..%5c..%5ca.txt", "a/../../../a.txt", "C:%5ca.txt", "%00.txt"):
        _, name = asked(address, "POST", "/upload")
        assert asked(address, "PUT", f"/upload/{name}?name={one}", b"0 1")[0] == 422, one
    assert {path.name for path in tmp_path.iterdir()} == {"p", "secret.txt"}


def test_a_file_of_a_result_is_given_from_any_depth_of_its_folder_and_from_nowhere_else(
    show: Show, tmp_path: Path
) -> None:
    address = show(tmp_path / "project")
    place = tmp_path / "project" / "results" / "add" / "report"
    place.mkdir(parents=True)
    (place / "Better.fmu").write_bytes(b"an FMU")
    (tmp_path / "project" / "secret.txt").write_text("not a result")
    assert asked(address, "GET", "/result/add/report/Better.fmu") == (200, "an FMU")
    for path in ("/result/add/report/none.fmu", "/result/add/report", "/result/add/..%2F..%2Fsecret.txt"):
        assert asked(address, "GET", path)[0] == 404
