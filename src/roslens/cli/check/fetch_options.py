"""Options for which repositories are fetched and how: of ``roslens fetch``, and of ``roslens check --fetch``."""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.failure import Failure
    from roslens.source.fetch.distribution import Distribution
    from roslens.source.fetch.document import Read
    from roslens.source.fetch.filter_file import Filter
    from roslens.source.fetch.retry import Retry
    from roslens.source.fetch.taken import Taken
    from roslens.source.fetch.wanted import Wanted
    from roslens.source.progress import Progress

_OWN = (
    "distribution",
    "filter",
    "package",
    "repository",
    "depth",
    "at",
    "whole",
    "submodules",
    "update",
    "into",
)


def add_fetch_arguments(parser: argparse.ArgumentParser, title: str) -> None:
    """Add the options in a group of their own.

    Args:
        parser: of the command.
        title: of the group in ``--help``.
    """
    group = parser.add_argument_group(title)
    where = group.add_mutually_exclusive_group()
    where.add_argument(
        "--distro",
        metavar="NAME",
        help="a distribution of the ROS index, such as jazzy"
        + ("; without --fetch, that which the workspace is for" if title else ""),
    )
    where.add_argument(
        "--distribution",
        metavar="FILE|URL",
        help="a distribution file, a .repos file, or the lock of an earlier fetch (default: the lock in --into)",
    )
    group.add_argument(
        "--filter", metavar="FILE", help="packages by repository, as the filter files of the study of 2016 have them"
    )
    group.add_argument("--package", action="append", metavar="P", help="only this package; may be given again")
    group.add_argument("--repository", action="append", metavar="R", help="only this repository; may be given again")
    group.add_argument("--depth", type=int, metavar="N", help="only the last N commits of history")
    group.add_argument(
        "--at",
        metavar="WHEN",
        help="the revision as of a date (2015-10-16), a commit, a number of commits, or `count`: that which the "
        "filter gives for each",
    )
    group.add_argument(
        "--whole", action="store_true", help="also the content of past revisions, for churn and `roslens history`"
    )
    group.add_argument(
        "--submodules", action="store_true", help="also submodules, each at the commit that its repository records"
    )
    group.add_argument(
        "--update", action="store_true", help="fetch the current heads of branches instead of the locked commits"
    )
    group.add_argument("--into", metavar="DIR", help="folder that the repositories come to (default: .)")
    group.add_argument("--offline", action="store_true", help="contact no server; use local copies only")


def refuse_without_fetch(options: argparse.Namespace) -> None:
    """Refuse options about fetching where nothing is fetched.

    Raises:
        UsageError: one is given.
    """
    # Without a forge to query, nothing else uses the network.
    for name in (*_OWN, *(() if getattr(options, "forge", False) else ("offline",))):
        if getattr(options, name, None):
            raise UsageError(f"--{name} is an option of fetching", expected="--fetch beside it")


def fetched(
    options: argparse.Namespace, configuration: Configuration, *, jobs: int, progress: Progress
) -> tuple[list[Taken], list[Failure]]:
    """Fetch by the options; return the outcome of each repository, and the requested names that are none.

    Raises:
        UsageError: an option or a document is wrong.
    """
    from threading import Event

    from roslens.cli.workplace.workplace import own_folder
    from roslens.source.fetch.at import At, parse_at
    from roslens.source.fetch.choose import choose
    from roslens.source.fetch.document import reader
    from roslens.source.fetch.fetch_all import FetchOptions, fetch_all
    from roslens.source.fetch.retry import Retry

    at = parse_at(options.at) if options.at else At()
    _check(options, at.counted)
    over = Event()
    retry = Retry(partial(_pause, over), end=over.set)
    read = reader(retry, offline=options.offline)
    into = Path(options.into or ".")
    distribution = _distribution(options, read, into)
    chosen = _filter(options, retry)
    wanted, failures = choose(distribution, chosen, options.package or (), options.repository or ())
    wanted = [_with_version(one, configuration.fetch.version) for one in wanted]
    into.mkdir(parents=True, exist_ok=True)
    how = FetchOptions(
        at=at,
        depth=options.depth or 0,
        whole=options.whole,
        update=options.update,
        offline=options.offline,
        files=not distribution.remote,
        rewrites=configuration.fetch.rewrite,
        jobs=jobs or configuration.fetch.jobs,
        submodules=options.submodules,
    )
    concerned = {str(one.entity) for one in distribution.failures}
    failures = [
        *_concerning(distribution.failures, options, chosen),
        *(f for f in failures if f.entity not in concerned),
    ]
    taken = fetch_all(_once(wanted), into, own_folder(into.resolve()) / "fetch", how, retry=retry, progress=progress)
    return taken, failures


def _pause(over: Event, seconds: float) -> None:
    """Wait, until all waits are ended."""
    over.wait(seconds)


def _check(options: argparse.Namespace, counted: bool) -> None:
    if options.depth is not None and options.depth < 1:
        raise UsageError(f"--depth {options.depth}", expected="at least 1")
    if options.depth and options.at:
        raise UsageError("--depth with --at", expected="one of them: a shallow history has no past revisions")
    if counted and not options.filter:
        raise UsageError("--at count", expected="--filter FILE with the number of commits of each repository")


def _distribution(options: argparse.Namespace, read: Read, into: Path) -> Distribution:
    from roslens.source.fetch.distribution import distribution_of, index_url, read_distribution, read_mapping
    from roslens.source.fetch.document import is_url
    from roslens.source.fetch.repos_file import is_repos_file, repositories_of
    from roslens.source.fetch.taken import LOCK

    if options.distro:
        return read_distribution(read, options.distro, index_url())
    lock = into / LOCK
    place = options.distribution or (str(lock) if lock.is_file() else "")
    if not place:
        raise UsageError(
            "nothing to fetch was specified",
            expected="--distro NAME, --distribution FILE or URL, or an --into with a lock",
            advice="`roslens fetch --help` has examples",
        )
    data = read_mapping(read, place)
    remote = is_url(place) and not place.startswith("file://")
    if is_repos_file(data):
        again = not options.distribution
        return _as_asked(data) if again else repositories_of(data, place, remote=remote)
    return distribution_of(data, place)


def _as_asked(data: dict[str, object]) -> Distribution:
    """Return what the lock of the folder itself was asked for: the branches, and not the commits that they had."""
    from roslens.source.fetch.distribution import Distribution
    from roslens.source.fetch.repos_file import taken_of

    return Distribution("", tuple(one.wanted for one in taken_of(data)), chosen=True)


def _filter(options: argparse.Namespace, retry: Retry) -> Filter | None:
    from roslens.source.fetch.distribution import read_mapping
    from roslens.source.fetch.document import reader
    from roslens.source.fetch.filter_file import filter_of

    if not options.filter:
        return None
    return filter_of(read_mapping(reader(retry, offline=True), options.filter), options.filter)


def _concerning(failures: Sequence[Failure], options: argparse.Namespace, chosen: Filter | None) -> list[Failure]:
    """Return the failures of the document that are about something wanted."""
    if chosen is None and not options.package and not options.repository:
        return list(failures)
    names = {*(chosen.packages if chosen else ()), *(options.repository or ()), *(options.package or ())}
    return [one for one in failures if one.entity.partition(":")[2] in names]


def _with_version(wanted: Wanted, versions: Mapping[str, str]) -> Wanted:
    import msgspec

    return msgspec.structs.replace(wanted, version=versions.get(wanted.name, wanted.version))


def _once(wanted: list[Wanted]) -> list[Wanted]:
    return list({one.name: one for one in wanted}.values())
