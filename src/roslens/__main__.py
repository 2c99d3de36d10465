"""``python -m roslens``: the command line of the Python that has roslens, wherever its scripts are."""

from __future__ import annotations

import sys

from roslens.cli.entry import main

if __name__ == "__main__":
    sys.exit(main())
