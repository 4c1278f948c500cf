"""Build a part of a page anew, so that the browser keeps each element that is still there.

A click, a choice or a word that is being typed belongs to an element of the browser. If that element were replaced,
what its user does in that moment would be lost: the server knows no element that is gone. So what is built anew takes
the places of what was there. An element that is still the same keeps its number, and with it focus, text and place.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable
from typing import Any

from nicegui import binding, json
from nicegui.element import Element


def renew(place: Element, build: Callable[[], Any]) -> None:
    """Build the content of a place anew."""
    before = list(place.default_slot.children)
    place.default_slot.children.clear()
    try:
        with place:
            build()
    finally:
        _follow(before, place.default_slot.children, place)


def _follow(before: list[Element], after: Iterable[Element], place: Element) -> None:
    """Let elements take the places of those that they are; what nobody takes the place of is removed."""
    left = list(before)
    for new in after:
        old = next((one for one in left if _same(one, new)), None)
        if old is not None:
            left.remove(old)
            _take(old, new)
    gone = [one for old in left for one in old.descendants(include_self=True)]
    slots = [slot for one in gone for slot in one.slots.values()]
    place.client.remove_elements(gone)
    for slot in slots:  # what its buttons have begun, and what takes a while, has a place to speak
        slot._parent = weakref.ref(place)


def _same(old: Element, new: Element) -> bool:
    """Whether both are one thing for the user: of one kind and name, in the same row of a list."""
    return _identity(old) == _identity(new) and (
        new.component is None or getattr(new, "follows", False) or _props(old) == _props(new)
    )


def _identity(one: Element) -> tuple[object, ...]:
    named = one._props.get("aria-label") or one._props.get("label")
    said = one._text if one.tag in ("button", "a") else None
    heard = [(on.type, on.js_handler) for on in one._event_listeners.values()]
    return type(one), one.tag, one._props.get("type"), named, said, one._markers, heard, len(one.slots)


def _props(one: Element) -> bytes | str:
    return json.dumps(dict(one._props))


def _take(old: Element, new: Element) -> None:
    """Be the old element for the browser: under its number, with what it tells and what it hears."""
    known, client = _known(old), new.client
    if "stamp" in old._props:  # the browser shows what was given since the last
        new._props["stamp"] = old._props["stamp"]
    _follow(old.default_slot.children, new.default_slot.children, new)
    client.elements.pop(new.id)
    client.outbox.updates.pop(new.id, None)
    new.id = old.id
    client.elements[new.id] = new
    for mine, its in zip(list(new._event_listeners.values()), old._event_listeners.values(), strict=True):
        del new._event_listeners[mine.id]
        mine.id, mine.element_id = its.id, old.id
        new._event_listeners[mine.id] = mine
    if _known(new) != known or client.outbox.updates.get(old.id) is old:
        client.outbox.enqueue_update(new)
    for slot, its in zip(new.slots.values(), list(old.slots.values()), strict=True):
        its._parent = weakref.ref(slot.parent)
    binding.remove([old])
    old._handle_delete()
    old._deleted = True


def _known(one: Element) -> str | bytes:
    """All that the browser is told of an element."""
    return json.dumps(one._to_dict())
