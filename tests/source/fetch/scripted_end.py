"""``python scripted_end.py MOMENT SIGNAL WORD…``: roslens, which is sent a signal at a moment that a number names.

The moment is a number of audit events of Python (files, processes, sockets, imports…), counted in all threads from the
first after roslens handles signals; the clock at that moment is written to standard output. With moment 0 nothing is
sent, and how many moments there were is written at the end.
"""

import atexit
import os
import signal
import sys
import time

from roslens.cli.main import main

MOMENT, NUMBER = int(sys.argv[1]), int(sys.argv[2])
came = 0


def heard(_event, _arguments):
    global came
    if not came and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        return
    came += 1
    if came == MOMENT:
        os.write(1, f"{time.monotonic()}\n".encode())
        os.kill(os.getpid(), NUMBER)


if MOMENT == 0:
    atexit.register(lambda: os.write(1, f"{came}\n".encode()))
sys.addaudithook(heard)
sys.argv[1:] = sys.argv[3:]
sys.exit(main())
