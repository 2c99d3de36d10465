"""Tries a test again that is about when things happen, where the machine was seen to give it no time.

Twice at most, and what was seen is said with each. On a machine that gives a test its time its first failure counts.

A try begins where the session began: whatever the one before left open is ended first, whatever its scope, so that a
robot that was late is not asked again, and nothing recorded while the machine stood still is judged anew. Processes
that it forgot are killed, and what it did not close is no warning in a test that comes later. Each try has its clock.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import time
import warnings
from contextlib import suppress
from pathlib import Path

import pytest
from _pytest.runner import runtestprotocol
from starved import Sleeper, Watched

IN_TIME = ("timed", "real", "slow", "browser")
TRIES = 3
MOST_RERUNS = 3
"""In CI (`$CI`), a run with more has failed: its machine shows nothing, or tests lean on being tried again."""
TITLE = "tried again"
SHARED = ("class", "module", "package")
"""Scopes of fixtures that may hold what was recorded while an earlier test ran."""


class TriedAgain:
    """The plug-in; `conftest.py` registers it."""

    def __init__(self) -> None:
        self._sleeper: Sleeper | None = None  # until a test runs: who hands tests out to workers runs none
        self._watched: Watched | None = None
        self._module: pytest.Item | pytest.Collector | None = None
        self._module_begun = 0.0
        self._clock = None
        self._too_many = 0

    @pytest.hookimpl(tryfirst=True, optionalhook=True)
    def pytest_timeout_set_timer(self, item, settings):
        """Remember the clock of a test; setting it is left to who comes next."""
        self._clock = settings

    @pytest.hookimpl
    def pytest_runtest_protocol(self, item, nextitem):
        """Run a test about time until it passes or fails where it had its time."""
        if (module := item.getparent(pytest.Module)) is not self._module:
            self._module, self._module_begun = module, time.monotonic()
        if not any(item.get_closest_marker(name) for name in IN_TIME):
            return None
        if self._watched is None:
            self._sleeper = Sleeper()
            self._watched = Watched(self._sleeper)
        hook = item.ihook
        for left in reversed(range(TRIES)):
            self._watched.begin(self._module_begun if _shares(item) else time.monotonic())
            hook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
            before = _children()
            reports = runtestprotocol(item, log=False, nextitem=nextitem)
            failed = [report for report in reports if report.failed]
            why = self._watched.starved() if failed and left else ""
            if why:
                why += self._ended(item) + _killed(_children() - before)
            for report in failed if why else reports:
                if why:
                    report.outcome = "rerun"
                    report.sections.append((TITLE, why))
                hook.pytest_runtest_logreport(report=report)
            hook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
            if not why:
                break
        return True

    def _ended(self, item) -> str:
        """End what the test and those before it left open; return what went wrong in that."""
        wrong = ""
        self._set_clock(item)
        try:
            item.session._setupstate.teardown_exact(None)
        except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - what a try left is no reason against another
            wrong = f"; what it left did not end well: {error!r}"
        item._report_sections.clear()
        for name in ("last_exc", "last_type", "last_value", "last_traceback"):
            vars(sys).pop(name, None)  # which hold the frames of the test, and all that it held
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            gc.collect()
        if getattr(item, "_instance", None) is not None:
            del item._instance
            item._obj = None
        self._module_begun = time.monotonic()
        self._set_clock(item)
        return wrong

    def _set_clock(self, item) -> None:
        # The clock stops at the first failure, and would not run for another try.
        if self._clock is not None and not self._clock.func_only:
            item.config.hook.pytest_timeout_set_timer(item=item, settings=self._clock)

    def pytest_report_teststatus(self, report):
        """Say what became of a try that is followed by another."""
        return ("rerun", "R", ("TRIED AGAIN", {"yellow": True})) if report.outcome == "rerun" else None

    def pytest_terminal_summary(self, terminalreporter) -> None:
        """Say what failed at first, how, and what was seen of the machine."""
        reports = terminalreporter.stats.get("rerun", ())
        if self._too_many:
            what = (
                f"{self._too_many} tries were repeated, at most {MOST_RERUNS} may be: give CI an idle machine, or mend"
            )
            terminalreporter.write_line(f"{TITLE}: {what} the tests below", red=True)
        for report in reports:
            terminalreporter.section(f"{TITLE}: {report.nodeid} ({report.when})", sep="-", yellow=True)
            terminalreporter.write_line(report.longreprtext)
        for report in reports:
            why = " ".join(text for title, text in report.sections if title == TITLE)
            terminalreporter.write_line(f"{TITLE}: {report.nodeid}: {why}")

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session) -> None:
        """Fail a run in CI in which too much was tried again."""
        terminal = session.config.pluginmanager.get_plugin("terminalreporter")
        reruns = len(terminal.stats.get("rerun", ())) if terminal is not None else 0
        if os.environ.get("CI") and reruns > MOST_RERUNS and session.exitstatus == pytest.ExitCode.OK:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED
            self._too_many = reruns

    def pytest_unconfigure(self) -> None:
        """End the sleeper."""
        if self._sleeper is not None:
            self._sleeper.end()


def _shares(item) -> bool:
    """Whether a test uses what was made for others too."""
    defined = item._fixtureinfo.name2fixturedefs.values()
    return any(fixture.scope in SHARED for fixtures in defined for fixture in fixtures)


def _children() -> set[int]:
    """Return the processes that this one started and that live, but for those that serve Python itself."""
    found = set()
    for place in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            state, parent = (place / "stat").read_text().rpartition(")")[2].split()[:2]
            if (
                int(parent) == os.getpid()
                and state != "Z"
                and b"multiprocessing" not in (place / "cmdline").read_bytes()
            ):
                found.add(int(place.name))
    return found


def _killed(left: set[int]) -> str:
    for pid in left:
        with suppress(OSError):
            os.kill(pid, signal.SIGKILL)
            os.kill(pid, signal.SIGCONT)
    return f"; {len(left)} processes that it left were killed" if left else ""
