"""The rules on distributions held against a workspace for two targets, and what is mended of what breaks between."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.model.distributions.port import Port, port_between
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.source import Location
from roslens.source.fix.mended_files import Mended, mended
from roslens.source.keys import content_hash
from roslens.source.measure.fresh_package import FreshPackages
from roslens.source.rules.by_package.for_target import BECAUSE
from roslens.source.settings import RuleSettings, SourceSettings
from roslens.store.cache import Cache

RULES = ("distribution.*",)
"""What tells of distributions."""
_UNREADABLE = ("launch.unreadable", "package.broken_manifest")
"""What tells that a file is not read, so that nothing is known of what breaks in it."""


class Ported(msgspec.Struct, frozen=True):
    """A port, what of the workspace could not be analysed, and the packages as the new target sees them."""

    port: Port
    failures: tuple[Failure, ...]
    fresh: FreshPackages


def ported(
    paths: Sequence[str | Path], settings: SourceSettings, between: tuple[str, str], base: Path, cache: Cache
) -> Ported:
    """Return what breaks in the packages below some folders between two distributions.

    Args:
        paths: the folders.
        settings: of the user; of the rules only those on distributions count.
        between: names of the distributions: that they are for, and that they are to be for.
        base: folder of the configuration.
        cache: of facts.

    Raises:
        UsageError: a path does not exist.
    """
    before, after = (FreshPackages(paths, _for(settings, one), base, cache) for one in between)
    had, _ = _judged(before)
    has, failures = _judged(after)
    return Ported(port_between(*between, had, has), failures, after)


def mended_port(found: Ported, settings: SourceSettings) -> Mended:
    """Return what becomes of what breaks and has a fix; nothing is written."""
    port, fresh = found.port, found.fresh
    files = fresh.by_path
    owner = {path: package for package in fresh.packages for path in fresh.paths_of(package)}
    broken = (*port.breaks, *port.already)

    def again(texts: Mapping[str, bytes]) -> Iterator[Finding]:
        changed = {path: text for path, text in texts.items() if content_hash(text) != files[path].content_hash}
        for package in sorted({owner[path] for path in changed}):
            yield from (one for one in fresh.judged(package, changed).findings if one.weight[0].grave)

    return mended([one for one in broken if one.edits and one.gated], files, fresh.root, settings.macros, again)


def _for(settings: SourceSettings, distro: str) -> SourceSettings:
    given = settings.rules
    enable = (*RULES, *_UNREADABLE)
    rules = RuleSettings(profiles=(), enable=enable, disable=given.disable, severity=given.severity)
    return msgspec.structs.replace(settings, distro=distro, rules=rules, models=())


def _judged(fresh: FreshPackages) -> tuple[list[Finding], tuple[Failure, ...]]:
    results = [fresh.judged(package, {}) for package in fresh.packages]
    findings = [
        # Which distribution it is for is what a port is asked for.
        msgspec.structs.replace(one, message=one.message.partition(BECAUSE)[0])
        for result in results
        for one in result.findings
        if one.rule.startswith("distribution.")
    ]
    failures = [one for result in results for one in result.failures]
    failures += [
        Failure("port", one.message, advice="Fix it, then port again", location=Location(one.path, one.line))
        for result in results
        for one in result.findings
        if one.rule in _UNREADABLE
    ]
    return findings, tuple(dict.fromkeys(failures))
