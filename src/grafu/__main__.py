"""`python -m grafu` is the command `grafu`."""

import sys

from grafu.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
