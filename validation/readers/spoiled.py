"""Inputs that are nearly right, which is where a reader goes wrong."""

from __future__ import annotations

import numpy as np

_MOST_EDITS = 4
_WORDS = (
    *(
        b"(",
        b")",
        b"[",
        b"]",
        b"{",
        b"}",
        b"<",
        b">",
        b'"',
        b"'",
        b"=",
        b";",
        b",",
        b".",
        b":",
        b"\\",
        b"/",
        b"&",
        b"#",
    ),
    *(b"\0", b"\xff", b"\xfe\xff", b"\xef\xbb\xbf", b"\r", b"\n", b"\n\n", b"\t", b" ", b"\xe2\x80\xa8"),
    *(b"0", b"-1", b"1e40", b"1e400", b"-1e-400", b"nan", b"inf", b"99999999999999999999", b"1,5", b"0x10", b"1_0"),
    *(b"true", b"end", b"/*", b"//", b"<!--", b"]]>", b"[[", b"[a]\n", b"= {", b"../", b"..\\", b"%00", b"\xc3\xa9"),
)


def spoiled(data: bytes, seed: int) -> bytes:
    """`data` with one to four edits: a piece taken out, doubled or moved, a word or bytes put in, a number changed."""
    random = np.random.default_rng(seed)
    for _ in range(min(int(random.geometric(0.6)), _MOST_EDITS)):
        data = _EDITS[random.integers(len(_EDITS))](data, random)
    return data


def _piece(data: bytes, random: np.random.Generator) -> tuple[int, int]:
    """A place and the end of a piece there, mostly a short one."""
    at = int(random.integers(len(data) + 1))
    return at, min(len(data), at + int(random.geometric(0.1 if random.random() < 0.8 else 0.005)))


def _removed(data: bytes, random: np.random.Generator) -> bytes:
    at, end = _piece(data, random)
    return data[:at] + data[end:]


def _cut(data: bytes, random: np.random.Generator) -> bytes:
    return data[: random.integers(len(data) + 1)]


def _doubled(data: bytes, random: np.random.Generator) -> bytes:
    at, end = _piece(data, random)
    return data[:end] + data[at:]


def _moved(data: bytes, random: np.random.Generator) -> bytes:
    at, end = _piece(data, random)
    rest = data[:at] + data[end:]
    to = int(random.integers(len(rest) + 1))
    return rest[:to] + data[at:end] + rest[to:]


def _word(data: bytes, random: np.random.Generator) -> bytes:
    at, end = _piece(data, random)
    over = end if random.random() < 0.5 else at
    return data[:at] + _WORDS[random.integers(len(_WORDS))] + data[over:]


def _bytes(data: bytes, random: np.random.Generator) -> bytes:
    at = int(random.integers(len(data) + 1))
    return data[:at] + random.bytes(int(random.integers(1, 5))) + data[at + 1 :]


def _number(data: bytes, random: np.random.Generator) -> bytes:
    """Another number in place of one of its digits."""
    digits = [k for k, byte in enumerate(data) if 48 <= byte < 58]
    if not digits:
        return data
    at = digits[random.integers(len(digits))]
    return data[:at] + _WORDS[random.integers(len(_WORDS))] + data[at + 1 :]


_EDITS = (_removed, _cut, _doubled, _moved, _word, _word, _bytes, _number)
