"""What a package is measured with: its files, their keys in the cache, and the settings that shape the result."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import msgspec

from roslens.model.source import Package, SourceFile
from roslens.source.keys import analyser_version, key_of
from roslens.source.settings import CountingSettings, MacroSettings, RuleSettings, SourceSettings
from roslens.source.workspace.find import FoundPackage
from roslens.source.workspace.surroundings import Surroundings


class PackageTask(msgspec.Struct, frozen=True):
    """What a worker needs: the package, its files, where they are, and what is already known.

    ``facts_keys`` names the cached analysis of each file that has a syntax; ``cache`` is the path
    of the cache, empty for none. ``program_keys`` names the cached programs likewise, where they are wanted:
    those that are missing are taken from the same parse. ``others`` are paths of files that have no language.
    ``texts`` are contents that count instead of what files hold, by path. ``left_out`` are paths of sources that are
    not looked at, because only what is found in the others is wanted. ``around`` is what other packages are to it.
    """

    package: Package
    root: str
    files: tuple[SourceFile, ...]
    facts_keys: dict[str, str]
    counting: CountingSettings
    macros: MacroSettings
    cache: str = ""
    program_keys: dict[str, str] = {}
    rules: RuleSettings = RuleSettings()
    wanted: frozenset[str] | None = None
    others: tuple[str, ...] = ()
    texts: dict[str, bytes] = {}
    left_out: frozenset[str] = frozenset()
    around: Surroundings = Surroundings()

    @property
    def known_in(self) -> Path | None:
        """The file of the cache; None for none."""
        return Path(self.cache) if self.cache else None


def package_task(
    found: FoundPackage,
    files: tuple[SourceFile, ...],
    others: Sequence[str],
    *,
    root: str,
    settings: SourceSettings,
    kept: str,
    program_keys: Mapping[str, str] | None = None,
    texts: Mapping[str, bytes] | None = None,
    left_out: frozenset[str] = frozenset(),
    around: Surroundings | None = None,
) -> PackageTask:
    """Return the task of measuring a package.

    Args:
        found: the package.
        files: of it that have a language.
        others: paths of its other files.
        root: of the workspace.
        settings: of the run.
        kept: path of the cache; empty for none.
        program_keys: names of cached programs, where they are wanted.
        texts: contents that count instead of what files hold, by path.
        left_out: paths of sources that are not looked at.
        around: what other packages are to it.
    """
    wanted = wanted_rules_of(settings.rules)
    syntax = key_of(analyser_version(), settings.macros, sorted(wanted))
    return PackageTask(
        package=found.package,
        root=root,
        files=files,
        facts_keys={
            file.path: f"{file.content_hash}:{file.language.value}:{syntax}"
            for file in files
            if file.language.parsed_as and file.path not in left_out
        },
        counting=settings.counting,
        macros=settings.macros,
        rules=settings.rules,
        wanted=wanted,
        others=tuple(others),
        cache=kept,
        program_keys=dict(program_keys or {}),
        texts=dict(texts or {}),
        left_out=left_out,
        around=around or Surroundings(),
    )


def wanted_rules_of(settings: RuleSettings) -> frozenset[str]:
    """Return the rules that files are held against; a severity changes nothing of that."""
    return _wanted_of(settings.profiles, settings.enable, settings.disable)


@cache
def _wanted_of(profiles: tuple[str, ...], enable: tuple[str, ...], disable: tuple[str, ...]) -> frozenset[str]:
    from roslens.source.rules.selection import wanted_rules
    from roslens.source.rules.table import native_rules

    return wanted_rules(RuleSettings(profiles, enable, disable), native_rules())
