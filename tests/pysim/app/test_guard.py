"""Who comes in, seen without a server."""

import asyncio
import socket
from collections.abc import MutableMapping
from typing import Any

import pytest

from pysim.app.guard import Guard, host_names
from pysim.app.server import opened, own_names

Message = MutableMapping[str, Any]


def asked(kind: str, query: str = "", path: str = "/a b", open_at: str = "", **headers: str) -> list[Message]:
    """What a request of that kind is answered with by a server that says "inside".

    Args:
        open_at: the host to listen at; this machine alone by default.
    """
    sent: list[Message] = []

    async def inside(scope: Message, receive: Any, send: Any) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"inside"})

    async def send(message: Message) -> None:
        sent.append(message)

    async def receive() -> Message:
        return {"type": "http.request"}

    own = {"host": "127.0.0.1:80", **headers}
    scope = {"type": kind, "path": path, "method": "GET", "query_string": query.encode()}
    scope["headers"] = [(key.encode(), value.encode("latin-1")) for key, value in own.items()]
    names = own_names(open_at) if open_at else ["127.0.0.1"]
    guard = Guard(inside, "secret", host_names(names, 80), "own", numbers=bool(open_at))
    asyncio.run(guard(scope, receive, send))
    return sent


def test_the_token_in_the_address_becomes_a_cookie_and_leaves_the_address() -> None:
    start, _ = asked("http", "x=1&token=secret")
    headers = dict(start["headers"])
    assert start["status"] == 303
    assert headers[b"location"] == b"/a%20b?x=1"
    assert headers[b"set-cookie"] == b"own=secret; Path=/; HttpOnly; SameSite=Strict"


def test_the_cookie_lets_in_and_the_policy_goes_along() -> None:
    start, body = asked("http", cookie="other=1; own=secret")
    assert (start["status"], body["body"]) == (200, b"inside")
    policy = dict(start["headers"])[b"content-security-policy"].decode()
    assert "default-src 'self'" in policy
    assert "http:" not in policy


@pytest.mark.parametrize(
    "foreign",
    [
        'theme={"dark": true}',
        "a,b=1",
        "foo[bar]=1",
        "version=1",
        "odd",
        "=",
        '"',
        "path=/x",
        "ö=ü",
        "own=of a deeper path",
    ],
)
def test_cookies_of_other_ports_lock_nobody_out(foreign: str) -> None:
    for cookie in (f"{foreign}; own=secret", f"own=secret; {foreign}", f"{foreign};own=secret;{foreign}"):
        start, body = asked("http", cookie=cookie)
        assert (start["status"], body["body"]) == (200, b"inside"), cookie
    start, _ = asked("http", cookie=foreign)
    assert start["status"] == 403


@pytest.mark.parametrize(
    ("path", "place"),
    [
        ("//evil.example", b"/evil.example"),
        ("/\\evil.example", b"/%5Cevil.example"),  # which a browser takes for //
        ("/Größe €?", b"/Gr%C3%B6%C3%9Fe%20%E2%82%AC%3F"),
        ("/\udc80", b"/%3F"),
    ],
)
def test_it_leads_to_the_place_that_was_asked_for_and_never_to_another_host(path: str, place: bytes) -> None:
    start, _ = asked("http", "token=secret", path)
    assert (start["status"], dict(start["headers"])[b"location"]) == (303, place)


def test_a_browser_leaves_the_port_of_http_out() -> None:
    assert host_names(["localhost"], 80) == {"localhost", "localhost:80"}
    assert host_names(["localhost"], 8080) == {"localhost:8080"}
    start, body = asked("http", cookie="own=secret", host="127.0.0.1", origin="http://127.0.0.1")
    assert (start["status"], body["body"]) == (200, b"inside")


@pytest.mark.parametrize(
    ("query", "headers"),
    [
        ("", {}),
        ("token=secre", {}),
        ("", {"cookie": "own=secre"}),
        ("", {"cookie": "other=secret"}),
        ("", {"cookie": 'other="; own=secre'}),
        ("", {"cookie": "own="}),
        ("token=secret", {"host": "evil.example:80"}),
        ("token=secret", {"origin": "http://evil.example"}),
        ("", {"cookie": "own=secret", "origin": "null"}),
        ("", {"cookie": "own=secret", "origin": "http://["}),
        ("token=secret", {"origin": "http://["}),
    ],
)
def test_all_others_stay_outside(query: str, headers: dict[str, str]) -> None:
    start, body = asked("http", query, **headers)
    assert start["status"] == 403
    assert b"inside" not in body["body"]
    (closed,) = asked("websocket", query, **headers)
    assert (closed["type"], closed["code"]) == ("websocket.close", 4403)


@pytest.mark.parametrize(
    ("listens", "host"),
    [
        ("0.0.0.0", "192.168.0.7:80"),
        ("0.0.0.0", "localhost:80"),
        ("0.0.0.0", f"{socket.gethostname()}:80"),
        ("::", "[fd00::7]:80"),
        ("192.168.0.7", "192.168.0.7"),
        ("bench.example", "bench.example:80"),
    ],
)
def test_a_server_for_others_goes_by_its_own_names_alone(listens: str, host: str) -> None:
    start, body = asked("http", open_at=listens, cookie="own=secret", host=host)
    assert (start["status"], body["body"]) == (200, b"inside")
    for foreign in ("evil.example:80", "192.168.0.7.evil.example", "[evil]", ""):
        start, _ = asked("http", open_at=listens, cookie="own=secret", host=foreign)
        assert start["status"] == 403, foreign


def test_opening_to_the_network_is_said_in_a_line() -> None:
    assert opened("127.0.0.1") == opened("localhost") == ""
    assert opened("0.0.0.0").count("\n") == 1
    assert "network" in opened("192.168.0.7")


def test_an_address_with_a_zero_byte_is_none() -> None:
    for path in ("/result/a/\0", "/static/\0"):
        start, body = asked("http", path=path, cookie="own=secret")
        assert start["status"] == 400
        assert b"inside" not in body["body"]
    (closed,) = asked("websocket", path="/\0", cookie="own=secret")
    assert closed["type"] == "websocket.close"
