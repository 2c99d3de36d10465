"""``roslens serve``: the pages of the last run in a browser."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.check.analysed import add_kept_arguments
from roslens.cli.conformance.shown_sides import add_against_argument
from roslens.cli.graph.shown_graphs import add_shown_argument
from roslens.cli.page.door import add_door_arguments, door_of
from roslens.cli.served.reacting import add_reacting_arguments, checked, refusals_to
from roslens.cli.terminal.streams import add_stream_arguments, progress_for
from roslens.cli.watch.observers import add_observer_arguments, given
from roslens.cli.watch.param_reference import add_reference_argument
from roslens.cli.workplace.workplace import add_workspace_argument
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.page.watch_page import PageSource
    from roslens.dashboard.journal.questions import Questions
    from roslens.dashboard.live.further import Further
    from roslens.dashboard.site import Site

_SYSTEM = "the running system"
PATIENCE_S = 1.0
"""How long a page waits for a process that holds the store alone."""
TEXT = "Serve the pages of the last run on this machine."
EXAMPLES = """\
  roslens serve
  roslens serve ~/robot_ws --port 8081
  roslens serve --live --reference robot.yaml      with a page of the robot that runs
  roslens serve --new-token operate otto --tokens people.txt
                                                   once for each person
  roslens serve --live --reference robot.yaml --react ask --tokens people.txt
                                                   and ask who may operate before anything is done about faults
  roslens serve --bag drive.bag --reference robot.yaml
                                                   or of a recording of it; alone where no source was checked
  roslens serve --history robot.sqlite --journal   or of what a watch kept of it, and of what was done about faults
  roslens serve --against drive.mcap               with a page of what a recording has otherwise than the source"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace and the address."""
    add_workspace_argument(parser)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine only)")
    parser.add_argument("--port", type=int, default=8080, help="port (default: 8080; 0 takes a free one)")
    parser.add_argument("--run", type=int, metavar="N", dest="number", help="a run other than the last")
    add_door_arguments(parser)
    parser.add_argument(
        "--new-token", nargs=2, metavar=("ROLE", "NAME"),
        help="print a new token of 256 random bits, add it to the file of --tokens, and end",
    )  # fmt: skip
    parser.add_argument(
        "--accept", action="store_true",
        help="who opens the address that is printed may accept findings there (in roslens.accepted.toml)",
    )  # fmt: skip
    add_shown_argument(parser)
    add_kept_arguments(parser)
    live = parser.add_argument_group("the robot that runs")
    live.add_argument("--live", action="store_true", help="also watch the running system, on additional pages")
    live.add_argument("--bag", type=Path, nargs="+", metavar="FILE", help="show a recording there instead")
    live.add_argument("--history", type=Path, metavar="FILE", help="show what `roslens watch --history` kept instead")
    live.add_argument(
        "--journal", type=Path, nargs="?", const=Path(), metavar="FILE",
        help="with pages of what reactions decided and did (default: the journal of `roslens react` here)",
    )  # fmt: skip
    add_reference_argument(live)
    add_observer_arguments(live)
    add_reacting_arguments(parser)
    add_against_argument(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Serve until interrupted.

    Raises:
        UsageError: there is no run and nothing else to show, the port is taken, what to watch is not there, or tokens
            or certificates are wrong.
        StoreError: the store cannot be read.
        DocumentError: a reference is wrong.
    """
    if options.new_token is not None:
        role, name = options.new_token
        return _new_token(role, name, options.tokens)
    _refuse_contradictions(options)
    checked(options)
    return _serve(options)


def _serve(options: argparse.Namespace) -> int:
    from roslens.cli.check.kept_changes import shown_changes
    from roslens.cli.check.kept_new import shown_new
    from roslens.cli.check.shown_run import shown_run
    from roslens.cli.conformance.shown_sides import against, shown_sides
    from roslens.cli.graph.read_beside import site_at_once
    from roslens.cli.past.shown_past import shown_past
    from roslens.cli.served.last_change import last_change_in
    from roslens.cli.served.reviewing import reviewing_of
    from roslens.cli.served.standing import gate_of, kept_runs
    from roslens.cli.served.without_run import needs_no_run, serve_alone
    from roslens.dashboard.live.app import no_graph, nothing
    from roslens.dashboard.server import serve

    questions = _questions(options)
    door = door_of(
        options, options.host, acting=options.live or options.accept, report=lambda entry: refusals_to(questions, entry)
    )
    if needs_no_run(options):
        with _beside(options, _SYSTEM, questions) as (page, further):
            serve_alone(options, page, door, further or _journal(options, _SYSTEM, page))
        return 0
    progress = progress_for(options)
    with (
        shown_run(options, progress) as view,
        shown_past(options, view) as past,
        kept_runs(options, view) as kept,
    ):
        site, read_graphs = site_at_once(view, options, progress)
        site.past = past
        site.new_first = shown_new(options, view)
        site.changes = shown_changes(options, view)
        site.runs, site.since = kept.runs, kept.since
        site.gate = gate_of(site)
        site.review = reviewing_of(Path(view.header.root), view.findings)
        site.last_change = last_change_in(view.header.root)

        def ready(url: str) -> None:
            print(f"roslens: {door.address(url)} (Ctrl-C ends it)", file=sys.stderr, flush=True)
            read_graphs()

        with _beside(options, site.name, questions) as (page, further):
            _join(page, site, options.path)
            # A page that waited for minutes would show nothing, and block all others.
            view.wait_at_most(PATIENCE_S)
            sides = shown_sides(options.against, (lambda: page.whole) if page else None, recorded=options.bag or ())
            site.against = against(site, sides) if sides else None
            serve(
                site,
                host=options.host,
                port=options.port,
                ready=ready,
                snapshot=page.newest if page else None,
                detail=page.detail if page else nothing,
                why=page.why.page if page else nothing,
                graph=page.graph if page else no_graph,
                past=page.past if page else None,
                board=page.board if page else None,
                state=page.state if page else None,
                sight=page.sight if page else None,
                further=further or _journal(options, site.name, page),
                access=door.access,
                tls=door.tls,
            )
    return 0


def _join(page: PageSource | None, site: Site, path: str) -> None:
    """Let what runs be drawn and explained with its source."""
    from roslens.cli.served.declared_beside import declared_beside
    from roslens.cli.served.source_grounds import source_grounds

    if page is not None:
        page.draw_on(source_grounds(site))
        page.why.declared = declared_beside(site, path)


def _new_token(role: str, name: str, path: Path | None) -> int:
    from roslens.dashboard.access.tokens import add_token

    try:
        token = add_token(role, name, path)
    except OSError as error:
        raise UsageError(
            f"the token cannot be written: {error.strerror or error}", where=str(path), expected="a file of tokens"
        ) from None
    print(token)
    line = f"{name} ({role})" if path is not None else f"the line `{role} {name} TOKEN` in the file of --tokens"
    print(f"roslens: the token above is for {line}", file=sys.stderr)
    return 0


def _refuse_contradictions(options: argparse.Namespace) -> None:
    several = [f"--{name}" for name in ("live", "bag", "history") if getattr(options, name)]
    if len(several) > 1:
        raise UsageError(" with ".join(several), expected="one of them")
    if options.live:
        return
    option = "--reference" if options.reference and not options.bag else given(options)
    if option:
        raise UsageError(
            f"{option} without --live",
            expected="both",
            advice="A reference is compared with a running system: add --live",
        )


def _questions(options: argparse.Namespace) -> Questions | None:
    if not options.react:
        return None
    from roslens.cli.react.react_live import questions_of

    return questions_of(options.react)


@contextmanager
def _beside(
    options: argparse.Namespace, title: str, questions: Questions | None
) -> Iterator[tuple[PageSource | None, Further | None]]:
    if options.react:
        from roslens.cli.served.reacting import reacting_beside

        with reacting_beside(options, title, questions) as beside:
            yield beside
        return
    with _shown_beside(options) as page:
        if page is not None and options.bag:
            from functools import cache

            from roslens.cli.why.recorded_evidence import recorded_evidence

            # Read when it is asked for the first time.
            page.why.recorded = cache(lambda: recorded_evidence(options, ()))
        yield page, None


def _shown_beside(options: argparse.Namespace) -> AbstractContextManager[PageSource | None]:
    if options.bag:
        from roslens.cli.served.recording import recording_beside

        return recording_beside(options)
    if options.live:
        from roslens.cli.watch.live_beside import live_beside

        return live_beside(options)
    if options.history:
        from roslens.cli.served.kept_history import history_beside

        return history_beside(options.history)
    return nullcontext()


def _journal(options: argparse.Namespace, title: str, page: PageSource | None) -> Further | None:
    if options.journal is None:
        return None
    import os

    from roslens.cli.react.react_page import journal_pages
    from roslens.intake.user_folder import state_folder

    path = options.journal if options.journal != Path() else state_folder(os.environ) / "journal.jsonl"
    return journal_pages(path, title, reactions=(lambda: page.reactions) if page else (lambda: None), base="/")
