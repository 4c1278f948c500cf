"""The HTML page: well formed, self-contained, complete."""

import base64
import re
from dataclasses import replace
from html.parser import HTMLParser

from pysim.present import Drawing
from pysim.present.comparison import Comparisons
from pysim.present.comparison import page as comparison_page
from pysim.present.page import paragraph, picture
from tests.pysim.comparisons import comparison

_VOID = {"meta", "img", "br", "link", "input", "hr"}


class Checker(HTMLParser):
    """Keeps the open elements and every address the page refers to."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.addresses: list[str] = []
        self.text = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in _VOID:
            self.open.append(tag)
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href")]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


def checked(html: str) -> Checker:
    checker = Checker()
    checker.feed(html)
    assert not checker.open
    return checker


def test_page_is_whole_and_needs_no_network() -> None:
    sets = [comparison("A"), comparison("B <odd>", error_db=3.0, fails=1)]
    html = comparison_page(
        Comparisons("Title & all", tuple(sets), ("<p>x</p>",)), [Drawing("a", "A picture", b"<svg/>")], "pysim demo"
    )
    page = checked(html)
    assert [address for address in page.addresses if not address.startswith("data:")] == []
    assert "url(" not in html
    for words in ("Title & all", "(4 of 4 rows)", "(0 of 4 rows)", "B <odd>", "at 5 Hz: stopped", "pysim demo"):
        assert words in page.text
    assert page.text.count("Take it <with> care.") == 3  # beside the verdicts, and below each table
    assert "Set beforehand for A: k = 2.5." in page.text


def test_the_page_says_what_it_takes_to_do_it_again() -> None:
    free = replace(
        comparison("free"),
        conditions={"solver": "Rodas(rtol=1e-05)"},
        parameters={"K_p": (42.445, "1"), "rho": (875.0, "kg/m3")},
    )
    locked = replace(free, label="locked", parameters={"K_p": (40.0, "1"), "rho": (875.0, "kg/m3")})
    html = comparison_page(Comparisons("t", (free, locked)), [], "")
    checked(html)
    assert '<tr><td>K_p</td><td>1</td><td class="differs">42.445</td><td class="differs">40</td></tr>' in html
    assert "<tr><td>rho</td><td>kg/m3</td><td>875</td><td>875</td></tr>" in html
    assert html.count("Rodas(rtol=1e-05)") == 2


def test_what_stands_for_the_measurements_is_named() -> None:
    one = comparison("A")
    tests = tuple(replace(t, measured=replace(t.measured, origin="transfer function, Table 9")) for t in one.tests)
    text = checked(comparison_page(Comparisons("t", (replace(one, tests=tests),)), [], "")).text
    assert "The model is held against: transfer function, Table 9." in text
    assert "absolute deviation from transfer function, Table 9" in text
    assert "measured" not in text.replace("not measured", "")


def test_what_is_beyond_a_limit_is_marked() -> None:
    html = comparison_page(Comparisons("t", (comparison("B", error_db=3.0),)), [], "")
    assert re.findall(r'<td class="beyond">([\d.]+)</td>', html) == ["2.25", "3.00"] * 4
    assert html.count('<td class="fail">fail</td>') == 4


def test_pictures_are_inside() -> None:
    html = picture(b"<svg>1</svg>", 'a "quoted" caption')
    data = re.search(r"base64,([^\"]+)", html)
    assert data is not None
    assert base64.b64decode(data[1]) == b"<svg>1</svg>"
    checked(html)


def test_text_is_escaped() -> None:
    assert paragraph("<script>", note=True) == '<p class="note">&lt;script&gt;</p>'
