"""Where starting a launch file of a package ends with an error. No code of nodes is evaluated."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from posixpath import basename
from typing import TYPE_CHECKING

import msgspec

from roslens.model.source import Language
from roslens.source.rules.views.launch_sources import LaunchSource, is_template, launch_sources

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Failed, Launch, ParameterFileUse
    from roslens.source.rules.views.launch_evaluations import LaunchEvaluations
    from roslens.source.rules.views.package_files import PackageFiles

_GIVEN = re.compile(rb"\$\((?:arg|eval|env|optenv)\b")
_LINES = 6
"""Of a start tag."""
MOST_ROOTS = 300
"""Launch files of a package that are started; one with more has them made by a program."""


class Outcome(msgspec.Struct, frozen=True):
    """A failure of a launch file.

    Attributes:
        failed: what fails and where.
        source: the file that is started.
        by_default: whether it depends on defaults of arguments.
        is_included: whether another launch file names the one that is started: it may set what this one does not.
        declared: names of the arguments that are declared where the file is started, wherever in it.
    """

    failed: Failed
    source: LaunchSource
    by_default: bool
    is_included: bool
    declared: frozenset[str] = frozenset()


class LaunchOutcome:
    """What comes of starting the launch files of a package."""

    def __init__(self, package: PackageFiles, evaluations: LaunchEvaluations) -> None:
        """Take a package and what its launch files come to; nothing is read before it is asked for."""
        self._package = package
        self._evaluations = evaluations

    @cached_property
    def failures(self) -> tuple[Outcome, ...]:
        """Where starting a launch file ends with an error, each place once."""
        found: dict[tuple[object, ...], Outcome] = {}
        for source, default, every in self._evaluated:
            declared = frozenset(one.name for launch in (default, every) for one in launch.arguments)
            lasting = {_key(one) for one in every.failed}
            for one in (*every.failed, *default.failed):
                key = _key(one)
                if key not in found or (found[key].is_included and not self._is_included(source)):
                    by_default = key not in lasting if source.is_ros2 else self._has_argument(one)
                    found[key] = Outcome(one, source, by_default, self._is_included(source), declared)
        return tuple(found.values())

    def _has_argument(self, failed: Failed) -> bool:
        """Return whether an element of a file of ROS 1 depends on what may be given: its file is evaluated once."""
        lines = self._package.read(failed.evidence.path).splitlines()[failed.evidence.line - 1 :]
        element = b" ".join(lines[:_LINES]).partition(b">")[0]
        return any(_GIVEN.search(text) for text in (element, failed.text.encode()))

    @cached_property
    def raw_files(self) -> tuple[ParameterFileUse, ...]:
        """Files of parameters that nodes are given as they are, each place once."""
        return tuple(dict.fromkeys(one for _, default, _ in self._evaluated for one in default.raw_files))

    @cached_property
    def _evaluated(self) -> tuple[tuple[LaunchSource, Launch, Launch], ...]:
        return tuple(self._evaluate())

    def _evaluate(self) -> Iterator[tuple[LaunchSource, Launch, Launch]]:
        languages = (Language.LAUNCH_XML, Language.LAUNCH_PYTHON, Language.LAUNCH_YAML)
        for source in [*launch_sources(self._package, *languages)][:MOST_ROOTS]:
            if is_template(source.content) and not source.path.endswith(".py"):
                continue
            if source.is_ros2 or 1 in self._package.ros:
                default = self._evaluations.by_default(source.path, source.version)
                yield source, default, self._evaluations.failing(source.path) if source.is_ros2 else default

    def _is_included(self, source: LaunchSource) -> bool:
        return self._names.get(basename(source.path), set()) - {source.path} != set()

    @cached_property
    def _names(self) -> dict[str, set[str]]:
        """By the name of a launch file, the paths of the launch files of the workspace that mention it."""
        names = {basename(path).encode() for path in self._package.around.started.paths}
        found: dict[str, set[str]] = {}
        for path in self._package.around.started.paths:
            content = self._package.read(path)
            for name in names:
                if name in content:
                    found.setdefault(name.decode(), set()).add(path)
        return found


def _key(failed: Failed) -> tuple[object, ...]:
    return failed.fault, failed.text, failed.evidence.path, failed.evidence.line
