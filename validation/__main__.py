"""`python -m validation ...` is `pysim validate ...`."""

import sys

from pysim.cli import main

if __name__ == "__main__":
    sys.exit(main(["validate", *sys.argv[1:]]))
