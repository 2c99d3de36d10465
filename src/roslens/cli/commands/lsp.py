"""``roslens lsp``: a language server for editors, over standard input and output."""

from __future__ import annotations

import argparse

TEXT = "Show findings in an editor: a language server over standard input and output."
EXAMPLES = """\
  roslens lsp                    an editor starts it, see docs/reference/where_teams_work.md
  pip install 'roslens[lsp]'     what it needs"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that shape findings."""
    parser.add_argument(
        "--model", action="append", metavar="NAME", help="quality model, built in or a file; may be given again"
    )
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    parser.add_argument(
        "--keep-nothing", dest="no_cache", action="store_true", help="keep nothing of the files that were read"
    )
    # Editors that know one way to start any server pass it.
    parser.add_argument("--stdio", action="store_true", help=argparse.SUPPRESS)


def run(options: argparse.Namespace) -> int:
    """Serve until the editor ends it.

    Raises:
        UsageError: pygls is not installed.
    """
    from roslens.model.errors import UsageError

    try:
        from roslens.cli.editor.language_server import Server
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in {"pygls", "lsprotocol"}:
            raise
        raise UsageError(
            f"{error.name} is not installed", expected="pygls 2", advice="Install it with `pip install 'roslens[lsp]'`"
        ) from error
    import os

    # pygls closes what it speaks through; what anything else prints goes to standard error, never between messages.
    with os.fdopen(os.dup(0), "rb") as incoming, os.fdopen(os.dup(1), "wb") as outgoing:
        os.dup2(2, 1)
        Server(options).protocol.start_io(incoming, outgoing)
    return 0
