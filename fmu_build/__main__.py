"""`python -m fmu_build` is `fmu-build`."""

import sys

from .cli import main

sys.exit(main())
