"""A model and its measurements on a command line: `MODEL --data DATASET` or `DATASET --model MODEL`, either for all."""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path

MODEL, DATA = "MODEL", "DATASET"


def add_model_and_data(parser: argparse.ArgumentParser, first: str, model: str, *, several: bool = False) -> None:
    """Both, in either order; they end as `model` (text) and `data` (a path, or paths).

    Args:
        first: MODEL or DATA, what stands without an option in the help; the other stands there where this is named.
        model: what it may be, for the help.
        several: whether `--data` may be repeated.
    """
    data = "folder with a dataset.toml"
    about, other = (model, DATA) if first == MODEL else (data, MODEL)
    parser.add_argument("place", metavar=first, nargs="?", help=f"{about}; or the {other.lower()}, see below")
    parser.add_argument("--model", metavar=MODEL, help=f"{model}, where the data set stands without an option")
    data += ", where the model stands without an option"
    if several:
        parser.add_argument("--data", metavar=DATA, type=Path, action="append", default=[], help=f"{data}; repeat")
    else:
        parser.add_argument("--data", metavar=DATA, type=Path, help=data)
    parser.set_defaults(finish=partial(_finish, first))


def _finish(first: str, args: argparse.Namespace) -> None:
    """Put what stands without an option where it belongs."""
    place = vars(args).pop("place")
    forms = ["MODEL --data DATASET", "DATASET --model MODEL"]
    form = " or ".join(forms if first == MODEL else forms[::-1])
    if place is None and args.model and args.data:
        return
    if place is None or bool(args.model) == bool(args.data):
        raise argparse.ArgumentTypeError(f"one model and its measurements are needed: {form}")
    if args.data:
        args.model = place
    else:
        args.data = [Path(place)] if isinstance(args.data, list) else Path(place)
