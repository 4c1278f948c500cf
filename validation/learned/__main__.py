"""`python -m validation.learned [PATTERN ...]`: cases of these names, all without one, and a page of their figures.

What this commit has answered is not asked again.
"""

import sys

from fmu_build.version import this_commit
from validation.learned.case import answer_cases
from validation.learned.figures import page

answers = answer_cases(sys.argv[1:] or ["*"])
print("\n".join(page(answers, f"Learned laws by commit {this_commit()}")))
