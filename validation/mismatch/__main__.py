"""A table of answers: `python -m validation.mismatch FOLDER SET ...`, of data sets in that folder.

With --unspecified the diagnosis is not given the noise that the data sets specify, with --unnamed it is given no
catalogue, so that it can only learn laws.
"""

import sys
from pathlib import Path

from validation.mismatch.answer import answer
from validation.mismatch.judge import judged
from validation.mismatch.tasks import read_task

words = [word for word in sys.argv[1:] if word not in ("--unspecified", "--unnamed")]
if len(words) < 2:
    sys.exit(__doc__)
for name in words[1:]:
    task = read_task(Path(words[0]), name, specified="--unspecified" not in sys.argv)
    print(judged(task, answer(task, named="--unnamed" not in sys.argv)), flush=True)
