"""What an FMU says, kept without Python: the last messages, none of them twice, and nothing that says all is well."""

import ctypes

from pysim.simulate import Mailbox
from pysim.simulate._messages import joined
from pysim.simulate.kernel.layout import ERROR, LINE_LENGTH, LINES, OK
from pysim.simulate.kernel.library import kernel

_LOG = ctypes.CFUNCTYPE(
    None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_int
)


def say(mailbox: Mailbox, text: str, status: int = ERROR) -> None:
    """As an FMI 2 FMU does."""
    _LOG(kernel().log_2)(mailbox.log.address, b"model", status, b"logAll", text.encode(), 7)


def test_messages_in_their_order_and_once_each() -> None:
    mailbox = Mailbox(2)
    for text in ("one", "two", "one"):
        say(mailbox, text)
    say(mailbox, "all is well", OK)
    say(mailbox, "")
    assert mailbox.text() == "; one; two"
    mailbox.empty()
    assert mailbox.text() == ""


def test_the_last_ones_are_kept() -> None:
    mailbox = Mailbox(2)
    for number in range(LINES + 5):
        say(mailbox, f"message {number}")
    assert mailbox.text() == joined([f"message {number}" for number in range(5, LINES + 5)])


def test_a_long_message_is_cut_and_nothing_is_written_without_a_log() -> None:
    mailbox = Mailbox(2)
    say(mailbox, "x" * 5 * LINE_LENGTH)
    assert mailbox.text() == "; " + "x" * (LINE_LENGTH - 1)
    _LOG(kernel().log_2)(None, b"model", ERROR, b"logAll", b"to nobody", 7)
