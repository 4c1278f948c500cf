"""`python -m fmu_build` is `fmu-build`."""

import sys

from fmu_build.cli import main

sys.exit(main())
