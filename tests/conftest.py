"""How hypothesis works here, and what is done about a machine that gives a test no time.

A busy machine is no fault of an example, and `make quick` takes fewer of them. `make test` takes the same examples each
time, so that what it says is about the change and not about luck; every other run searches anew.

A test that is about when things happen (`real`, `slow` or `browser`) and fails is tried again, twice at most, where the
machine was seen to give it no time; how is said with each. On a machine that does, its first failure counts.
"""

import os

import pytest
from hypothesis import HealthCheck, settings
from starved import Sleeper, Watched

settings.register_profile("roslens", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("quick", settings.get_profile("roslens"), max_examples=25)
settings.register_profile("same", settings.get_profile("roslens"), derandomize=True, database=None)
if os.environ.get("ROSLENS_QUICK"):
    settings.load_profile("quick")
else:
    settings.load_profile("same" if os.environ.get("ROSLENS_SAME_EXAMPLES") else "roslens")

IN_TIME = ("real", "slow", "browser")
TRIES_MORE = 2
TRIED_AGAIN = "tried again"


class TriedAgain:
    """Tries tests again for which the machine had no time, and says at the end what it had seen."""

    def __init__(self):
        self._sleeper = Sleeper()
        self._watched = Watched(self._sleeper)
        self._why = ""

    def pytest_collection_modifyitems(self, config, items):
        again = pytest.mark.flaky(reruns=TRIES_MORE, condition=self._starved)
        for item in items:
            if not any(item.get_closest_marker(name) for name in IN_TIME):
                continue
            item.add_marker(again)
            # One clock runs for all tries.
            own = item.get_closest_marker("timeout")
            one_try_s = own.args[0] if own else float(config.getini("timeout"))
            item.add_marker(pytest.mark.timeout(one_try_s * (1 + TRIES_MORE)), append=False)

    def pytest_runtest_logstart(self):
        self._watched.begin()

    def _starved(self):
        self._why = self._watched.starved()
        return bool(self._why)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logreport(self, report):
        if report.outcome == "rerun" and self._why:
            report.sections.append((TRIED_AGAIN, self._why))

    def pytest_terminal_summary(self, terminalreporter):
        for report in terminalreporter.stats.get("rerun", ()):
            why = [text for title, text in report.sections if title == TRIED_AGAIN]
            terminalreporter.write_line(f"{TRIED_AGAIN}: {report.nodeid}: {' '.join(why)}")

    def pytest_unconfigure(self):
        self._sleeper.end()


def pytest_configure(config):
    config.pluginmanager.register(TriedAgain())
