"""`python -m validation.diagnosis [NAME ...]`: answer the sets and keep the answers."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from validation.diagnosis.answers import answered, kept, read_answers, write_answers
from validation.diagnosis.sets import NAMES


def main(names: Sequence[str]) -> int:
    """0 when done, 2 for wrong use."""
    wrong = [name for name in names if name not in NAMES]
    if wrong:
        print(f"no set named {', '.join(wrong)}; there are {', '.join(NAMES)}", file=sys.stderr)
        return 2
    for name in names or NAMES:
        answer = kept(answered(name))
        write_answers({**read_answers(), name: answer})  # each at once: a kill costs one
        print(f"{name}: {answer.verdict} {', '.join(answer.added)}, held out {answer.validate[1]:g}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
