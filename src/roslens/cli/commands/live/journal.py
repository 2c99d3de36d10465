"""``roslens journal``: what was decided and done, and whether the record of it is whole."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.store.journals.read_journal import JournalReader

TEXT = "Show what reactions decided and did, follow it, or verify that the journal was not altered."
EXAMPLES = """\
  roslens journal                          what was decided and done here
  roslens journal --follow                 and what comes next, until Ctrl-C
  roslens journal --verify                 is it as it was written? prints the hash to keep elsewhere
  roslens journal --verify --head 3f09c1…  and is nothing cut off behind what was kept?
  roslens journal --export journal.json    all of it for other programs (.csv: a table)"""

_LOOK_EVERY_S = 0.2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add which journal, and what to do with it."""
    parser.add_argument("journal", nargs="?", type=Path, metavar="FILE", help="default: that of `roslens react` here")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--follow", action="store_true", help="keep printing new entries until Ctrl-C")
    what.add_argument("--verify", action="store_true", help="verify every hash; exit with 1 if anything was changed")
    what.add_argument("--export", type=Path, metavar="FILE", help="write it as JSON, or as CSV by the file's ending")
    parser.add_argument("--head", default="", metavar="HASH", help="with --verify: a hash of it kept elsewhere")


def run(options: argparse.Namespace) -> int:
    """Show, verify or export a journal; 1 where it was changed.

    Raises:
        UsageError: the options contradict each other.
        StoreError: there is no journal.
    """
    import os

    from roslens.intake.user_folder import state_folder
    from roslens.model.errors import UsageError
    from roslens.store.journals.read_journal import JournalReader

    path = options.journal or state_folder(os.environ) / "journal.jsonl"
    if options.head and not options.verify:
        raise UsageError("--head without --verify", expected="both")
    if options.verify:
        return _verify(path, options.head.lower())
    reader = JournalReader(path)
    try:
        if options.export is not None:
            return _export(reader, options.export)
        return _show(reader, path, follow=options.follow)
    finally:
        reader.close()


def _verify(path: Path, head: str) -> int:
    import os

    from roslens.cli.workplace.journal_key import journal_signing
    from roslens.store.journals.read_journal import verify

    found = verify(path, head, journal_signing(path, os.environ))
    signed = f", {found.signed} of them signed" if found.signed else "; none is signed by this user in this folder"
    print(f"{path}: {found.entries} entries as they were written{signed}")
    if found.wrong:
        for text in found.wrong[:20]:
            print(f"  {text}")
        if len(found.wrong) > 20:
            print(f"  and {len(found.wrong) - 20} more")
        return 1
    print(f"  hash of the last: {found.head}")
    return 0


def _show(reader: JournalReader, path: Path, *, follow: bool) -> int:
    import time

    from roslens.cli.page.watch_screen import time_of_day
    from roslens.report.history.journal_text import journal_line

    day = ""
    while True:
        for entry in reader.entries():
            if (today := time.strftime("%Y-%m-%d", time.localtime(entry.time))) != day:
                day = today
                print(day)
            print(journal_line(entry, time_of_day))
        if not follow:
            if not day:
                print(f"{path} is empty: nothing has been decided here yet", file=sys.stderr)
            return 0
        sys.stdout.flush()
        time.sleep(_LOOK_EVERY_S)


def _export(reader: JournalReader, target: Path) -> int:
    import csv
    import json

    import msgspec

    from roslens.report.writing.whole_file import whole_file

    entries = list(reader.entries())
    with whole_file(target) as stream:
        if target.suffix == ".csv":
            table = csv.writer(stream, lineterminator="\n")
            table.writerow(("n", "time", "what", "decision", "text", "fields", "hash"))
            for one in entries:
                fields = one.fields
                reported = json.dumps(fields, ensure_ascii=False, sort_keys=True)
                row = (
                    one.n,
                    one.time,
                    one.what,
                    fields.get("decision", ""),
                    fields.get("text", ""),
                    reported,
                    one.hash,
                )
                table.writerow(row)
        else:
            json.dump([msgspec.to_builtins(one) for one in entries], stream, indent=1, ensure_ascii=False)
            stream.write("\n")
    return 0
