"""``roslens check --watch``: after the check, each file that is saved is answered at once."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import RoslensError, UsageError
from roslens.model.words.plural import plural

if TYPE_CHECKING:
    from roslens.cli.check.saved_files import SavedFiles
    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.finding import Finding
    from roslens.source.measure.fresh_package import Fresh, FreshPackages

PERIOD_S = 0.1
"""How often time stamps are looked at."""


def add_watch_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--watch``."""
    parser.add_argument(
        "--watch",
        action="store_true",
        help="keep running: whenever a file is saved, report the findings in it (rules and limits; tools, "
        "plug-ins and graphs are left to the next check); Ctrl-C ends it",
    )


def refuse_others(options: argparse.Namespace) -> None:
    """Refuse options that a watch has no use for.

    Raises:
        UsageError: one is given.
    """
    given = {
        "--baseline": options.baseline,
        "--changed": options.changed,
        "-o": options.output,
        "--format": options.format,
    }
    if options.watch and (wrong := [name for name, value in given.items() if value is not None]):
        raise UsageError(f"--watch with {wrong[0]}", expected="--watch alone: it shows each file as it is saved")


def watch_files(options: argparse.Namespace, root: Path, configuration: Configuration) -> None:
    """Answer saved files until Ctrl-C.

    Raises:
        RoslensError: the workspace cannot be looked for.
    """
    import os

    from roslens.cli.check.analysed import settings_of
    from roslens.cli.check.saved_files import SavedFiles
    from roslens.cli.workplace.workplace import CACHE, own_folder
    from roslens.source.measure.fresh_package import FreshPackages
    from roslens.store.cache import Cache

    settings = settings_of(options, configuration, dict(os.environ))
    kept = None if options.no_cache else own_folder(root) / CACHE
    with Cache.open(kept) as cache:
        fresh = FreshPackages(options.paths, settings, Path(configuration.base or "."), cache)
        warm(fresh)
        print(f"roslens: watching {plural(len(fresh.files), 'file')}; Ctrl-C ends", file=sys.stderr, flush=True)
        files = SavedFiles(fresh.root, fresh.files)
        try:
            while True:
                for line in answers(fresh, files, time.monotonic):
                    print(line, flush=True)
                pause()
        except KeyboardInterrupt:
            return


def pause() -> None:
    """Wait until time stamps are looked at again."""
    time.sleep(PERIOD_S)


def warm(fresh: FreshPackages) -> None:
    """Look at one file of each language once, so that the first one that is saved is answered as quickly as others."""
    for ending in (".cpp", ".py"):
        for path in (path for path in fresh.files if path.endswith(ending)):
            look(fresh, path)
            break


def answers(fresh: FreshPackages, files: SavedFiles, now: Callable[[], float]) -> Iterator[str]:
    """Yield lines about what was saved since the last time.

    Args:
        fresh: the packages.
        files: of them, as they were known.
        now: a clock in seconds.
    """
    begun = now()
    saved = files.poll()
    if saved.other_files or any(path.endswith("package.xml") for path in saved.paths):
        fresh.find()
        before = set(saved.paths)
        files.know(fresh.files)
        yield f"roslens: looked for packages again, {plural(len(fresh.files), 'file')}"
        saved_paths = sorted(before & set(fresh.files))
    else:
        saved_paths = list(saved.paths)
    for path in saved_paths:
        found = look(fresh, path)
        if isinstance(found, str):
            yield found
        elif found is not None:
            yield from _reported(path, found, now() - begun)


def look(fresh: FreshPackages, path: str) -> Fresh | str | None:
    """Return what is found in a file, a line about why not, or None where it is not of the workspace."""
    try:
        return fresh.look(path)
    except (OSError, RoslensError) as error:
        return f"{path}: cannot be looked at: {error}"


def _reported(path: str, found: Fresh, took_s: float) -> Iterator[str]:
    from roslens.report.run.fix_first import by_urgency

    counting = [one for one in found.findings if one.gated]
    count = f"{len(counting)} finding{'s' * (len(counting) != 1)}"
    aside = f", {len(found.set_aside)} set aside" if found.set_aside else ""
    yield f"{path}: {count}{aside} ({took_s * 1000:.0f} ms)"
    yield from (f"  not analysed: {failure}" for failure in found.failures)
    yield from (f"  {_line(one)}" for one in by_urgency(counting))


def _line(finding: Finding) -> str:
    place = ":".join([finding.path, *(str(number) for number in (finding.line, finding.column) if number)])
    return f"{place}: {finding.severity.value}: {' '.join(finding.message.split())} [{finding.rule}]"
