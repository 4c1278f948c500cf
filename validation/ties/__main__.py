"""Answer the first plants by this commit and show the shares: `python -m validation.ties [COUNT]`."""

import sys

from validation.ties.answer import COUNT
from validation.ties.case import answer_ties, shares

for share in shares(answer_ties(int(sys.argv[1]) if len(sys.argv) > 1 else COUNT)):
    print(share)
