"""How hypothesis works here, and what is done about a machine that gives a test no time.

A busy machine is no fault of an example, and `make quick` takes fewer of them, `make nightly` ten times as many. `make
test` takes the same examples each time, so that what it says is about the change and not about luck; every other run
searches anew.

A test that is about when things happen (`timed`, `real`, `slow` or `browser`) is tried again, see `tried_again.py`.
"""

import os
import signal
import tempfile

import pytest
from hypothesis import HealthCheck, settings
from tried_again import TriedAgain

from roslens.intake.user_folder import user_folder, user_secret, write_private

settings.register_profile("roslens", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("quick", settings.get_profile("roslens"), max_examples=25)
settings.register_profile("nightly", settings.get_profile("roslens"), max_examples=1000)
settings.register_profile("same", settings.get_profile("roslens"), derandomize=True, database=None)
if os.environ.get("ROSLENS_QUICK"):
    settings.load_profile("quick")
elif os.environ.get("ROSLENS_NIGHTLY"):
    settings.load_profile("nightly")
else:
    settings.load_profile("same" if os.environ.get("ROSLENS_SAME_EXAMPLES") else "roslens")


def pytest_configure(config):
    # What roslens keeps for a user is not that of the user who runs the tests.
    own = tempfile.TemporaryDirectory(prefix="roslens-user-")
    config.add_cleanup(own.cleanup)
    # But for the secret: the examples may have results of that user, and of the other processes of a run.
    secret = user_secret(os.environ)
    write_private(user_folder({"XDG_CONFIG_HOME": own.name}) / "secret", secret)
    os.environ["XDG_CONFIG_HOME"] = own.name
    config.pluginmanager.register(TriedAgain())
    # A shell that starts something in the background has it ignore Ctrl-C, and with it all that tests start and end so.
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Put what waits for nodes first in the share of one worker, and what waits for a browser in that of the next.

    So two workers mostly wait while the others compute, and those that are done first take what is left of the rest.
    Whole robots wait longest, and even longer where one is tried again: the run would end with one of them alone.
    """
    real = [item for item in items if item.get_closest_marker("real")]
    real.sort(key=lambda item: "scenarios" not in item.path.parts)
    browser = [item for item in items if item.get_closest_marker("browser") and not item.get_closest_marker("real")]
    waiting = {*real, *browser}
    rest = [item for item in items if item not in waiting]
    share = len(items) // int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    first = max(share - len(real), 0)
    items[:] = [*real, *rest[:first], *browser, *rest[first:]]


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config):
    """Return how many workers `-n auto` means: two more than there are processors, as two of them mostly wait."""
    return len(os.sched_getaffinity(0)) + 2
