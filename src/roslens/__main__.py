"""``python -m roslens``: the command line of the Python that has roslens, wherever its scripts are.

``python -m`` searches the current folder first: it is taken off before anything else is imported, even by
``from __future__``. The folder of roslens stays.
"""

import os
import sys

if __name__ == "__main__":
    own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120 - no import
    if not getattr(sys.flags, "safe_path", False) and sys.path[:1] != [own]:
        del sys.path[0]
    from roslens.cli.entry import main

    sys.exit(main())
