"""Parts of a page that are built anew, so that the browser keeps each element that is still there.

A click, a choice or a word that is being typed belongs to an element of the browser. If that element were replaced,
what its user does in that moment would be lost: the server knows no element that is gone. So what is built anew takes
the places of what was there. An element that is still the same keeps its number, and with it focus, text and place.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Any

from nicegui import Event, binding, json, ui
from nicegui.element import Element

news: Event[[]] = Event()  # something that pages show may be other than before


def live(key: Callable[[], object], build: Callable[[], Any], kind: str = "") -> Element:
    """A part that is built anew where there are news and its key has changed, in every tab.

    Rows of a list that look alike have a `mark`.
    """
    place = ui.element("div").classes(kind)
    known: list[object] = []

    def build_where_new() -> None:
        now = key()
        if known and known[0] == now:
            return
        known[:] = [now]
        before, place.default_slot.children = place.default_slot.children, []
        try:
            with place:
                build()
        finally:
            _follow(before, place)

    async def look() -> None:
        """Once what brought the news is done."""
        if place.is_deleted:
            news.unsubscribe(look)
        else:
            build_where_new()

    build_where_new()
    news.subscribe(look, unsubscribe_on_delete=False)
    return place


def _follow(before: list[Element], place: Element) -> None:
    """Let the content of a place be what was there before; what is there no more is removed."""
    left = [(_identity(one), one) for one in before]
    for new in place.default_slot:
        now = _identity(new)
        same = next((pair for pair in left if pair[0] == now), None)
        if same is not None:
            left.remove(same)
            _take(same[1], new)
    gone = [one for _, old in left for one in old.descendants(include_self=True)]
    for one in gone:
        _speak_from(one, place)
    place.client.remove_elements(gone)


def _identity(one: Element) -> tuple[object, ...]:
    """What makes two elements one thing for the user. A part that draws itself, and does not say that it `follows`, is
    the same only with all that it shows."""
    props = one._props
    said = one._text if one.tag in ("button", "a") else None
    heard = [(each.type, each.js_handler) for each in one._event_listeners.values()]
    shown = None if one.component is None or getattr(one, "follows", False) else json.dumps(dict(props))
    named = props.get("aria-label") or props.get("label")
    return type(one), one.tag, props.get("type"), named, said, one._markers, heard, shown, len(one.slots)


def _take(old: Element, new: Element) -> None:
    """Be the old element for the browser: under its number, with what it hears."""
    known, client = json.dumps(old._to_dict()), new.client
    if "heard" in old._props:  # the browser shows what its user has given since
        new._props["heard"] = old._props["heard"]
    _follow(old.default_slot.children, new)
    client.elements.pop(new.id)
    client.outbox.updates.pop(new.id, None)
    new.id = old.id
    client.elements[new.id] = new
    heard = zip(old._event_listeners, list(new._event_listeners.values()), strict=True)
    for id_, listener in heard:
        del new._event_listeners[listener.id]
        listener.id, listener.element_id = id_, old.id
        new._event_listeners[id_] = listener
    if json.dumps(new._to_dict()) != known or client.outbox.updates.get(old.id) is old:
        client.outbox.enqueue_update(new)
    _speak_from(old, new)
    binding.remove([old])
    old._handle_delete()
    old._deleted = True


def _speak_from(old: Element, place: Element) -> None:
    """What an element that is no more has begun, and what ends later, says so from here."""
    for slot in old.slots.values():
        slot._parent = weakref.ref(place)
