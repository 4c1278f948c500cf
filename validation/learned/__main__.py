"""`python -m validation.learned [PATTERN ...]`: a line for each case of these names, all without one, and the shares.

What this commit has answered is not asked again.
"""

import sys

from validation.learned.case import answer_cases, shares

answers = answer_cases(sys.argv[1:] or ["*"])
print(*answers, sep="\n")
for share in shares(answers):
    print(share)
