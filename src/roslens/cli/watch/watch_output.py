"""The output of `roslens watch` without a screen: a line for each change, and the final state."""

from __future__ import annotations

import argparse
import sys
from collections import deque
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, TextIO

from roslens.cli.page.watch_screen import alert_line, cause_text, event_text, screen
from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED
from roslens.cli.terminal.streams import wants_color, width_of
from roslens.cli.watch.about_nothing import lines_of
from roslens.cli.watch.never_judged import JudgedOnce, failures_of, summary_of
from roslens.live.join.note import Note, NoteKind
from roslens.live.join.session import Step
from roslens.live.publish.json_lines import cause_line, event_line, failure_line, note_line, verdict_line
from roslens.live.publish.spells import Spells, key_of
from roslens.live.reported.reported_levels import is_reported
from roslens.model.verdict import State, Verdict
from roslens.report.writing.terminal import Terminal

if TYPE_CHECKING:
    from roslens.live.join.session import Session

_ENDLESS = 10_000
_KEPT = 20


class Teller:
    """Writes to standard output or to the file of ``-o``; a context manager.

    Attributes:
        said: the latest failures and notes.
    """

    def __init__(self, options: argparse.Namespace, clock: Callable[[float], str], begin: float | None = None) -> None:
        """Write by the options; ``clock`` writes times, ``begin`` is that of a recording.

        Raises:
            OSError: the file cannot be written.
        """
        self._options = options
        self._clock = clock
        self._begin = begin
        self._spells = Spells()
        self._alarms = 0
        self._states: set[str] = set()
        self._failed = 0
        self._old_reference = False
        self._judged = JudgedOnce()
        self.said: deque[str] = deque(maxlen=_KEPT)
        self._stream: TextIO = options.output.open("w", encoding="utf-8") if options.output else sys.stdout

    def __enter__(self) -> Teller:
        """Return itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the file, where one was opened."""
        if self._options.output:
            self._stream.close()

    def count(self, step: Step) -> None:
        """Remember how a step went, without writing it."""
        self._states.update(one.state.value for one in step.changes if one.state.bad)
        self._judged.add(step.changes)
        self._alarms += sum(one.state.bad for one in step.changes)
        self._failed += len(step.failures)
        self.said.extend(str(failure) for failure in step.failures)
        self.said.extend(note.text for note in step.notes)
        for note in step.notes:
            self._old_reference = note.kind is NoteKind.KEPT

    def tell(self, step: Step) -> None:
        """Write the changes of a step."""
        self.count(step)
        lasted = self._spells.ended(step.changes)
        if self._options.format == "json":
            lines = [event_line(one, self._begin) for one in step.events]
            lines += [verdict_line(one, self._begin, lasted.get(key_of(one))) for one in step.changes]
            lines += [cause_line(one, self._begin) for one in step.causes]
            lines += [failure_line(one) for one in step.failures]
            lines += [note_line(one) for one in step.notes]
        else:
            reported = [one for one in step.changes if one.state.bad or one.of_observer or self._options.verbose]
            shown = {key_of(one): one for one in step.changes if one in reported or key_of(one) in lasted}
            terminal = self._uncut
            timed = [
                (one.since, alert_line(terminal, one, self._clock(one.since), lasted.get(key)))
                for key, one in shown.items()
            ]
            events = [one for one in step.events if self._options.verbose or is_reported(one)]
            timed += [(one.time, event_text(terminal, one, self._clock(one.time))) for one in events]
            timed += [(one.time, cause_text(terminal, one, self._clock(one.time))) for one in step.causes]
            lines = [line for _, line in sorted(timed, key=lambda one: one[0])]
            for note in step.notes:
                print(f"roslens: {note.text}", file=sys.stderr)
            for failure in step.failures:
                print(f"roslens: {failure}", file=sys.stderr)
        for line in lines:
            print(line, file=self._stream, flush=True)

    def end(self, session: Session, time: float, title: str, missed: Sequence[Note] = ()) -> None:
        """Write how it was at the end, and the constraints that were about nothing."""
        if self._options.format == "json":
            for note in missed:
                print(note_line(note), file=self._stream, flush=True)
            return
        self.tell(session.look(time))
        if self._options.quiet:
            return
        lines = screen(self.terminal, session.tree(time), (), title=title, height=_ENDLESS, clock=self._clock)
        clean = [self.terminal.clean(line) for line in lines_of(missed)]
        print(
            "",
            *lines,
            *([""] if clean else []),
            *clean,
            "",
            self._sum(session),
            sep="\n",
            file=self._stream,
            flush=True,
        )

    def tell_unjudged(self, verdicts: Sequence[Verdict], time: float) -> None:
        """Report a failure if everything, or something of severity error, was never more than unknown.

        ``verdicts`` are those that stand at the end, at ``time``.
        """
        about = [one for one in verdicts if not one.of_observer]
        if any(one.state is State.UNKNOWN for one in about):
            self._states.add(State.UNKNOWN.value)
        if failures := failures_of(self._judged.never(about), len(about)):
            self.tell(Step(time, failures=failures))

    def code(self, states: frozenset[str], *, nothing_seen: bool) -> int:
        """Return the exit code: 1 where one of ``states`` came up, 3 where something could not be observed."""
        if self._states & states:
            return FINDINGS
        return NOT_ANALYSED if nothing_seen or self._failed or self._old_reference else CLEAN

    @property
    def terminal(self) -> Terminal:
        """What can be shown where the result goes."""
        encoding = (getattr(self._stream, "encoding", None) or "").lower()
        color = wants_color(self._options, self._stream)
        return Terminal(max(width_of(self._stream), 60), color, encoding.startswith("utf"))

    @property
    def _uncut(self) -> Terminal:
        """For lines: who reads them in a file or a log wants all of each."""
        found = self.terminal
        return found if self._stream.isatty() else Terminal(_ENDLESS, found.color, found.unicode)

    def _sum(self, session: Session) -> str:
        if not session.monitor.standing():
            source = "--bag FILE" if self._options.bag else "--live 60s"
            return f"Nothing was judged. `roslens reference draft {source}` drafts what to hold it against."
        standing = [one for one in session.monitor.standing() if not one.of_observer]
        never = summary_of(self._judged.never(standing), len(standing))
        if self._alarms:
            raised = "1 alarm was" if self._alarms == 1 else f"{self._alarms} alarms were"
            said = f"{raised} raised; `roslens reference explain FILE… ENTITY` lists the constraints on an entity."
            return f"{said}\n{never}" if never else said
        unknown = [one for one in standing if one.state is State.UNKNOWN]
        if not unknown:
            return "Nothing was wrong."
        one = unknown[0]
        why = f" ({one.evidence})" if one.evidence else ""
        now = f"unknown are {len(unknown)}, such as {one.entity} {one.quantity}{why}."
        return f"Nothing is known to be wrong; {never or now}"
