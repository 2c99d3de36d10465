"""What the launch files of a package come to when each is started, evaluated once for all rules and for graphs.

Each file is evaluated with the defaults of its arguments, and with all of these open, so that every way that they may
choose is followed. What a run before evaluated is known as long as all that was read for it is the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.workspace.known_launches import KnownLaunches
from roslens.store.cache import Cache

if TYPE_CHECKING:
    from roslens.source.extract.facts.files import Files
    from roslens.source.extract.facts.launched import Launch
    from roslens.source.rules.views.package_files import PackageFiles


class PackageRoots:
    """The files of a workspace, those of a package as they are given; see :class:`Files`."""

    def __init__(self, package: PackageFiles) -> None:
        """Take a package."""
        self._texts = package.texts
        folders = {name: "" if folder == "." else folder for name, folder in package.around.folders}
        self._files = FolderFiles(Path(package.root), folders)

    def package(self, name: str) -> str | None:
        """Return the folder of a package; None where the workspace has none of that name."""
        return self._files.package(name)

    def listing(self, folder: str) -> tuple[str, ...]:
        """Return the paths of the files below a folder, those in folders of it too; none where there is no folder."""
        return self._files.listing(folder)

    def content(self, path: str) -> bytes | None:
        """Return the bytes of a file; None where there is none, or it cannot be read."""
        known = self._texts.get(path)
        return known if known is not None else self._files.content(path)


class LaunchEvaluations:
    """The launch files of a package, evaluated when a rule first asks; variables of the environment are not known."""

    def __init__(self, package: PackageFiles, cache: Cache) -> None:
        """Evaluate nothing yet.

        Args:
            package: whose launch files are started.
            cache: what earlier runs learned; it is only read.
        """
        self.files: Files = PackageRoots(package)
        self._known = KnownLaunches(cache, self.files)
        self._made: dict[tuple[str, str], Launch] = {}

    @property
    def new(self) -> Mapping[str, bytes]:
        """What was evaluated and is to be kept for the next run."""
        return self._known.new

    def by_default(self, path: str, version: str) -> Launch:
        """Return what a launch file comes to with the defaults of its arguments; ``version`` is ros1 or ros2."""
        from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
        from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

        key = (version, path)
        if key not in self._made:
            evaluate = evaluate_ros1 if version == "ros1" else evaluate_ros2
            self._made[key] = self._known.launch(
                (version, path, ()), {}, lambda files, variables: evaluate(path, files, {}, variables)
            )
        return self._made[key]

    def failing(self, path: str) -> Launch:
        """Return where a launch file for ROS 2 ends with an error when all its arguments are open; no more of it."""
        from roslens.source.extract.facts.launched import Launch
        from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

        def ends(files: Files, variables: Mapping[str, str]) -> Launch:
            every = evaluate_ros2(path, files, {}, variables, any_arguments=True)
            return Launch(every.generation, failed=every.failed, cut=every.cut)

        key = ("any arguments", path)
        if key not in self._made:
            self._made[key] = self._known.launch(("ros2", path, "any arguments"), {}, ends)
        return self._made[key]
