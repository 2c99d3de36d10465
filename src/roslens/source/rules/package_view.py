"""A package as rules see it: its manifest, its files, what the one parse found in them."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.intake.file_budget import file_budget
from roslens.source.over_budget import in_rules
from roslens.source.rules.views.package_files import PackageFiles
from roslens.source.rules.views.python_tree import python_tree

if TYPE_CHECKING:
    from roslens.source.extract.builds.python_setup import Setup
    from roslens.source.rules.edits.manifest_edits import ManifestEdits
    from roslens.source.rules.views.cmake_view import CmakeView
    from roslens.source.rules.views.dependency_uses import Use
    from roslens.source.rules.views.launch_evaluations import LaunchEvaluations
    from roslens.source.rules.views.launch_outcome import LaunchOutcome
    from roslens.source.rules.views.launch_runs import LaunchRun
    from roslens.source.rules.views.launch_view import LaunchXml
    from roslens.source.rules.views.registered_classes import Registered
    from roslens.source.workspace.mistakes import Mistake


class PackageView(PackageFiles, frozen=True, dict=True):
    """What is known of a package: its files, and what views make of them when a rule first asks."""

    @cached_property
    def setup(self) -> Setup:
        """What setup.py, setup.cfg and pyproject.toml install."""
        from roslens.source.extract.builds.python_setup import Setup
        from roslens.source.extract.builds.python_setup_targets import read_setup
        from roslens.source.extract.facts.files import FolderFiles

        if not {"setup.py", "setup.cfg", "pyproject.toml"} & self.listing:
            return Setup()
        listing = frozenset(self.path(one) for one in self.listing)
        with file_budget(self.path("setup.py")):
            return read_setup(self.folder, FolderFiles(Path(self.root), {}), listing)

    @cached_property
    def setup_tree(self) -> ast.Module | None:
        """The syntax tree of setup.py; nothing where there is none, or where it cannot be read."""
        if "setup.py" not in self.listing:
            return None
        with file_budget(self.path("setup.py")):
            return python_tree(self.read(self.path("setup.py")))

    @cached_property
    def setup_call(self) -> ast.Call | None:
        """The call of ``setup`` in setup.py; nothing where it cannot be read."""
        calls = (one for one in ast.walk(self.setup_tree or ast.Module([], [])) if isinstance(one, ast.Call))
        return next((one for one in calls if getattr(one.func, "id", getattr(one.func, "attr", "")) == "setup"), None)

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """Where it uses other packages."""
        from roslens.source.rules.views.dependency_uses import uses_of

        return uses_of(self, self.cmake, self.launch)

    @cached_property
    def named(self) -> frozenset[str]:
        """The packages that it uses or declares, in lower case."""
        names = (*(use.name for use in self.uses), *(one.name for one in self.package.dependencies))
        return frozenset(name.lower() for name in names)

    @cached_property
    def launch(self) -> tuple[LaunchXml, ...]:
        """The launch files in XML."""
        from roslens.source.rules.views.launch_view import launch_files

        return launch_files(self)

    @cached_property
    def evaluations(self) -> LaunchEvaluations:
        """What its launch files come to, evaluated when a rule first asks."""
        from roslens.source.rules.views.launch_evaluations import LaunchEvaluations
        from roslens.store.cache import Cache

        return LaunchEvaluations(self, self.cache or Cache.open(None))

    @property
    def new(self) -> Mapping[str, bytes]:
        """What views learned of its files and keep for the next run; nothing of texts that are no files."""
        return {} if self.texts or "evaluations" not in self.__dict__ else self.evaluations.new

    @cached_property
    def outcome(self) -> LaunchOutcome:
        """What comes of starting its launch files."""
        from roslens.source.rules.views.launch_outcome import LaunchOutcome

        return LaunchOutcome(self, self.evaluations)

    @cached_property
    def launch_runs(self) -> tuple[LaunchRun, ...]:
        """The launch files for ROS 2, evaluated when a rule first asks."""
        from roslens.source.rules.views.launch_runs import launch_runs

        return tuple(launch_runs(self, self.evaluations))

    @cached_property
    def registered(self) -> tuple[tuple[Registered, ...], bool]:
        """The plug-ins and components that its sources register, and whether these are all."""
        from roslens.source.rules.views.registered_classes import registered_classes

        return registered_classes(self)

    @cached_property
    def mistakes(self) -> tuple[Mistake, ...]:
        """What the manifest should say otherwise, but for what a template leaves open."""
        from roslens.source.workspace.mistakes import mistakes_of

        path = self.package.manifest.path
        content = self.read(path) if path else b""
        with file_budget(in_rules(path), size=len(content)):
            found = mistakes_of(content, path) if path else ()
        return tuple(one for one in found if not one.left_open)

    @cached_property
    def manifest_edits(self) -> ManifestEdits:
        """What can be done about its package.xml."""
        from roslens.source.rules.edits.manifest_edits import ManifestEdits

        path = self.package.manifest.path
        return ManifestEdits(self.read(path) if path else b"", path)

    @cached_property
    def cmake(self) -> CmakeView:
        """The CMake files, parsed."""
        from roslens.source.rules.views.cmake_view import CmakeView

        return CmakeView(self)
