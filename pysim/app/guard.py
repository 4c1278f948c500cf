"""Who may talk to the page: this machine, with the token; and what the page itself may load."""

from __future__ import annotations

import hmac
import ipaddress
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from typing import Any
from urllib.parse import parse_qsl, quote, urlencode, urlsplit

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

_HTTP = 80
_POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' ws: wss:; worker-src 'self' blob:; "
    "object-src 'none'; base-uri 'self'; form-action 'self'; frame-ancestors 'none'"
)
_HEADERS = (
    (b"content-security-policy", _POLICY.encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
)
_REFUSED = b"This page needs the address with its token, as pysim app printed it in the terminal.\n"
_NO_PATH = b"This page has no address with a zero byte.\n"


def host_names(names: Iterable[str], port: int) -> frozenset[str]:
    """How a browser asks for a server of these names: it leaves the port out where that is the one of http."""
    return frozenset(f"{name}:{port}" for name in names) | (frozenset(names) if port == _HTTP else frozenset())


class Guard:
    """Lets through what carries the token, as a cookie or in the address, and names a host that it knows.

    A page of another site can make a browser send a cookie or look up a name of its own; so the host of every request
    and the origin of every connection are looked at as well.

    Args:
        app: behind it.
        token: that has to be shown.
        hosts: `host_names` of this server.
        cookie: name under which the browser keeps the token.
        numbers: whether any IP address is ours too, as for a server that others may reach. The check is there for a
            name of another site that leads here, and that is never an IP address.
    """

    def __init__(self, app: App, token: str, hosts: frozenset[str], cookie: str, *, numbers: bool = False) -> None:
        self._app, self._token, self._hosts, self._cookie, self._numbers = app, token, hosts, cookie, numbers

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request or connection."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        if "\0" in scope["path"]:  # no file has such a name, and asking for one raises
            await _refuse(scope, send, 400, _NO_PATH)
            return
        headers = {key.decode("latin-1").lower(): value.decode("latin-1") for key, value in scope["headers"]}
        words = parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True)
        shown = dict(words).get("token", "")
        if self._foreign(headers) or not (self._right(shown) or any(map(self._right, self._kept(scope)))):
            await _refuse(scope, send, 403, _REFUSED)
        elif shown and scope["type"] == "http" and scope["method"] == "GET":
            rest = urlencode([(key, value) for key, value in words if key != "token"])
            place = quote(scope["path"].lstrip("/"), errors="replace")
            await self._welcome(send, place + (f"?{rest}" if rest else ""))
        else:
            await self._app(scope, receive, _with_headers(send))

    def _right(self, token: str) -> bool:
        return hmac.compare_digest(token.encode(), self._token.encode())

    def _kept(self, scope: Scope) -> list[str]:
        """What the browser keeps under our name, beside cookies of every form: all ports of a machine share them."""
        lines = (value.decode("latin-1") for key, value in scope["headers"] if key.lower() == b"cookie")
        pairs = (one.strip().partition("=") for line in lines for one in line.split(";"))
        return [value for name, _, value in pairs if name == self._cookie]

    def _foreign(self, headers: dict[str, str]) -> bool:
        """Whether a name was asked for that is not ours, or another site's page asks."""
        host = headers.get("host", "")
        if host not in self._hosts and not (self._numbers and _is_number(host)):
            return True
        origin = headers.get("origin")
        try:
            return origin is not None and urlsplit(origin).netloc != host
        except ValueError:  # an address that is none
            return True

    async def _welcome(self, send: Send, place: str) -> None:
        """Keep the token as a cookie, and go on without it in the address, at a quoted place below the server's."""
        cookie = f"{self._cookie}={self._token}; Path=/; HttpOnly; SameSite=Strict"
        headers = [(b"location", f"/{place}".encode()), (b"set-cookie", cookie.encode())]
        await send({"type": "http.response.start", "status": 303, "headers": [*headers, *_HEADERS]})
        await send({"type": "http.response.body", "body": b""})


def _is_number(host: str) -> bool:
    """Whether it is an IP address, with or without a port."""
    name = host[1:].partition("]")[0] if host.startswith("[") else host.partition(":")[0]
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _with_headers(send: Send) -> Send:
    async def more(message: MutableMapping[str, Any]) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *_HEADERS]}
        await send(message)

    return more


async def _refuse(scope: Scope, send: Send, status: int, words: bytes) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 4403})
        return
    headers = [(b"content-type", b"text/plain; charset=utf-8"), *_HEADERS]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": words})
