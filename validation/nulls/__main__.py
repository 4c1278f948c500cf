"""Answer the first nulls by this commit and show the shares: `python -m validation.nulls [COUNT]`."""

import sys

from validation.nulls.case import answer_nulls, shares
from validation.nulls.data import COUNT

for share in shares(answer_nulls(int(sys.argv[1]) if len(sys.argv) > 1 else COUNT)):
    print(share)
