"""What the launch files of a package for ROS 2 come to: their actions, and what they would start.

Nothing is executed. What they include of other packages of the workspace is followed.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from roslens.intake.file_budget import file_budget
from roslens.model.errors import DocumentError
from roslens.model.source import Language, Role
from roslens.source.rules.views.package_files import PackageFiles

if TYPE_CHECKING:
    from collections.abc import Iterator

    from roslens.source.extract.facts.launched import Launch
    from roslens.source.extract.launch_python.launch_action import Action
    from roslens.source.rules.views.launch_evaluations import LaunchEvaluations

MOST_FILES = 60
"""Of a package that are evaluated; one that has more is a collection."""
_LANGUAGES = (Language.LAUNCH_PYTHON, Language.LAUNCH_XML, Language.LAUNCH_YAML)


class LaunchRun:
    """A launch file, read and evaluated when somebody asks."""

    def __init__(self, package: PackageFiles, evaluations: LaunchEvaluations, path: str) -> None:
        """Take a file of a package."""
        self._evaluations = evaluations
        self._files = evaluations.files
        self.path = path
        self.content = package.read(path)

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        """Its actions, those inside of others too; none where it cannot be read, which is told elsewhere."""
        from roslens.source.extract.launch.launch_markup import actions_of

        try:
            with file_budget(self.path, size=len(self.content)):
                return tuple(_all(actions_of(self.path, self.content, self._files)))
        except (DocumentError, RecursionError):
            return ()

    @cached_property
    def declared(self) -> tuple[str, ...]:
        """The names of the arguments that it declares, as far as they are written out."""
        names = (one.values.get("name") for one in self.actions if one.kind == "argument")
        return tuple(name for name in names if isinstance(name, str))

    def included(self, action: Action) -> str | None:
        """Return the path of the file that an action includes; None where that depends on something."""
        from roslens.source.extract.facts.files import joined
        from roslens.source.extract.launch_python.deferred import Scope, resolve

        path = resolve(action.values["file"], Scope(self._files, {}, {}, self.path, set())).known
        return None if path is None else joined("", path)

    @cached_property
    def launch(self) -> Launch:
        """What it starts with the defaults of its arguments."""
        return self._evaluations.by_default(self.path, "ros2")


def launch_runs(package: PackageFiles, evaluations: LaunchEvaluations) -> list[LaunchRun]:
    """Return the own launch files of a package for ROS 2; none where it has too many to be one robot's."""
    files = package.of_language(*_LANGUAGES, roles=(Role.OWN,))
    if package.ros != frozenset({2}) or len(files) > MOST_FILES:
        return []
    return [LaunchRun(package, evaluations, file.path) for file in files]


def _all(actions: tuple[Action, ...]) -> Iterator[Action]:
    waiting = list(reversed(actions))
    while waiting:
        one = waiting.pop()
        yield one
        waiting.extend(reversed(one.children))
