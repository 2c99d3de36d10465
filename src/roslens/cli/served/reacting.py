"""`roslens serve --live --react`: the reactions of a reference to faults; approval is requested on the pages."""

from __future__ import annotations

import argparse
import contextlib
import platform
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, NamedTuple

from roslens.cli.react.react_options import add_hand_arguments, add_limit_arguments
from roslens.model.errors import RoslensError, UsageError
from roslens.model.failure import Failure

if TYPE_CHECKING:
    from roslens.cli.page.watch_page import PageSource
    from roslens.dashboard.access.audit import Entry
    from roslens.dashboard.journal.questions import Questions
    from roslens.dashboard.live.further import Further

MODES = ("dry-run", "ask", "act")
_REFUSED = 400
_END_S = 10.0


def add_reacting_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is done about faults while pages are served."""
    group = parser.add_argument_group("reactions to faults")
    group.add_argument(
        "--react", choices=MODES, metavar="MODE",
        help="with --live, carry out the reactions of the reference: dry-run only reports them; ask waits for who may "
        "operate to allow it on a page; act does it",
    )  # fmt: skip
    add_hand_arguments(group)
    add_limit_arguments(parser)


def checked(options: argparse.Namespace) -> None:
    """Check that options go together.

    Raises:
        UsageError: something is to be done about what does not run, or without a reference.
    """
    if options.react and not options.live:
        raise UsageError("--react without --live", expected="both", advice="Only a running system can be acted on")
    if options.react and not options.reference:
        raise UsageError("--react without --reference", expected="both")
    for name in ("allow", "enrolled", "agents"):
        if getattr(options, name) is not None and not options.react:
            raise UsageError(f"--{name} without --react", expected="both")


def refusals_to(questions: Questions | None, entry: Entry) -> None:
    """Tell the questions of an answer that the guard of the pages did not let through."""
    if questions is not None and entry.method == "POST" and entry.status >= _REFUSED:
        questions.refused(entry.peer, f"{entry.path}: {entry.why or entry.status}")


class Beside(NamedTuple):
    """What is shown beside the pages of a run: a live page, and further pages."""

    page: PageSource
    further: Further | None = None


@contextlib.contextmanager
def reacting_beside(options: argparse.Namespace, title: str, questions: Questions | None) -> Iterator[Beside]:
    """Watch and react in a thread until the context is left; give the live page, the plan, journal and questions.

    Raises:
        UsageError: the options make no sense, or no ROS is observed in which anything could be done.
        DocumentError: the reference calls for what cannot be done.
    """
    import os

    from roslens.cli.page.board_page import notes_beside
    from roslens.cli.page.watch_screen import time_of_day
    from roslens.cli.react.react_live import Reacting, files_with_reactions, limits_of
    from roslens.cli.react.react_page import journal_pages
    from roslens.cli.watch.stretch import Stretch
    from roslens.cli.watch.watch_serve import page_of
    from roslens.intake.user_folder import state_folder
    from roslens.live.join.session import Step
    from roslens.store.journals.journal import Journal

    given = options.journal
    path = given if given is not None and given != Path() else state_folder(os.environ) / "journal.jsonl"
    asked = {"mode": options.react, "journal": path, "json": False, "publish_journal": None}
    reacting_options = argparse.Namespace(**{**vars(options), **asked})
    limits, files = limits_of(reacting_options), files_with_reactions(reacting_options)
    ended: list[int] = []
    with contextlib.ExitStack() as stack:
        journal = stack.enter_context(Journal(path))
        reacting = Reacting(reacting_options, files, limits, journal, stack, questions)
        reacting.prepare()
        handled = notes_beside(None, platform.node(), os.environ)
        page, shown = page_of(reacting.session, platform.node(), time_of_day, handled=handled)
        reacting.show("", shown)

        def react() -> None:
            try:
                reacting.run(Stretch(reacting.session, None, ended))
            except RoslensError as error:
                print(f"roslens: nothing is done any more: {error}", file=sys.stderr, flush=True)
                page.take(Step(time.time(), failures=(Failure("reactions", f"nothing is done any more: {error}"),)))

        thread = Thread(target=react, name="react", daemon=True)
        thread.start()
        try:
            yield Beside(page, journal_pages(path, title, questions, lambda: page.reactions, base="/"))
        finally:
            ended.append(0)
            thread.join(_END_S)
