"""What quotation marks mean in a log."""

import pytest

from pysim.io.quotation_marks import unquoted


@pytest.mark.parametrize(
    ("text", "without"),
    [
        ('"0,001","1,5"\n"0,002", "2,5e-3"', "0.001,1.5\n0.002,2.5e-3"),
        ('"1,000","2,500"\n"2,000","12"', "1,000,2,500\n2,000,12"),  # thousands or decimals: nothing tells
        ('"1,000","2,500"\n"2,000","12,5"', "1.000,2.500\n2.000,12.5"),  # the last one is no thousand
        ('"1,234.5","2,5"', "1,234.5,2,5"),
        ('"1,5";"2"', "1,5;2"),  # other separators need no care
        ('"0;1,5;2"', "0;1,5;2"),  # a whole line between two marks
        ('1,"stop, or go; on",2', "1,stop_or_go_on,2"),
        ('"01.02.2024, 12:00:00",0.5,2', "01.02.2024_12:00:00,0.5,2"),
        ('"on; ok";1,5;2', "on_ ok;1,5;2"),
        ('1\t"on\toff"\t2', "1\ton_off\t2"),
        ('5" pipe, 3" hose', "5 pipe, 3 hose"),
        ("1,5", "1,5"),
    ],
)
def test_what_stands_between_them_does_not_separate(text: str, without: str) -> None:
    assert unquoted(text) == without
