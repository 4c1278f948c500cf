"""A batch of made-up cases: `double` has an answer, `refuse` an error, `die` ends its process."""

import os
import sys

from validation.batch import Line, serve


def answer(name: str) -> Line:
    word, _, number = name.partition("-")
    if word == "die":
        os._exit(3)
    if word == "refuse":
        raise ValueError("no such number")
    return {"value": 2 * int(number)}


if __name__ == "__main__":
    serve(answer, sys.argv[1:])
