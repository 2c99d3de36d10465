"""The code of a workspace as units from which configurations are assembled; evaluated when it is asked for.

Programs of all packages are read once, since a node may be made of classes of other packages. What is evaluated is only
what a configuration starts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from roslens.model.source import OUTSIDE_PACKAGES, Language, Package
from roslens.source.extract.files import FolderFiles
from roslens.source.extract.launched import Unresolved
from roslens.source.extract.node_facts import NodeFacts, Target
from roslens.source.extract.node_units import facts_of_class, facts_of_main, facts_of_module, node_classes
from roslens.source.extract.program import Program
from roslens.source.extract.workspace_index import Index
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import FoundPackage, Workspace
from roslens.source.workspace.languages import classify, header_language

_PARSED = frozenset({Language.C, Language.CPP, Language.PYTHON})
_MOST_BYTES = 2_000_000


class WorkspaceFacts:
    """The nodes that code of a workspace becomes, see :class:`~roslens.source.extract.assemble_units.Units`."""

    def __init__(self, workspace: Workspace, settings: SourceSettings) -> None:
        """Look at the packages of a workspace; nothing is read yet.

        Args:
            workspace: its packages and files.
            settings: how files are told apart, and macros.
        """
        self._settings = settings
        self._root = Path(workspace.root)
        self._found = {one.package.name: one for one in reversed(workspace.packages) if _named(one)}
        self._packages = workspace.packages
        folders = {name: "" if one.package.path == "." else one.package.path for name, one in self._found.items()}
        self.files = FolderFiles(self._root, folders)
        self.unresolved: list[Unresolved] = []
        self._targets: dict[str, tuple[Target, ...]] = {}
        self._index: Index | None = None
        self._facts: dict[tuple[str, str], tuple[NodeFacts, ...]] = {}
        self._classes: dict[str, tuple[NodeFacts, ...]] = {}

    @property
    def packages(self) -> tuple[Package, ...]:
        """The packages of the workspace, sorted by name."""
        return tuple(self._found[name].package for name in sorted(self._found))

    def paths(self, package: str) -> tuple[str, ...]:
        """Return the files of a package."""
        found = self._found.get(package)
        return () if found is None else tuple(file.path for file in found.files)

    def has(self, package: str) -> bool:
        """Return whether the workspace has a package of that name."""
        return package in self._found

    def targets(self, package: str) -> Sequence[Target]:
        """Return what the build of a package makes."""
        if package not in self._found:
            return ()
        if package not in self._targets:
            from roslens.source.extract.targets import targets_of

            about = self._found[package].package
            folder = "" if about.path == "." else about.path
            targets, unresolved = targets_of(package, folder, about.build_type, self.files, self.paths(package))
            self._targets[package] = targets
            self.unresolved += unresolved
        return self._targets[package]

    def program(self, path: str, function: str = "") -> Sequence[NodeFacts]:
        """Return the nodes that a file becomes when it is started."""
        key = (path, function)
        if key not in self._facts:
            program = self.index.programs.get(path)
            if program is None:
                self._facts[key] = ()
            elif program.language == "python":
                self._facts[key] = tuple(facts_of_module(self.index, path, function))
            else:
                self._facts[key] = tuple(facts_of_main(self.index, path))
        return self._facts[key]

    def of_class(self, name: str) -> Sequence[NodeFacts]:
        """Return the nodes that an object of a class becomes."""
        if name not in self._classes:
            self._classes[name] = tuple(
                one
                for defined, generation, kind in node_classes(self.index)
                if self.index.key(defined) == name
                for one in facts_of_class(self.index, defined, generation, kind)
            )
        return self._classes[name]

    @property
    def index(self) -> Index:
        """What the programs of the workspace define."""
        if self._index is None:
            self._index = Index(self._programs())
        return self._index

    def _programs(self) -> Mapping[str, Program]:
        from roslens.source.parsed_file import parse_file

        programs: dict[str, Program] = {}
        for found in self._packages:
            headers = header_language(file.path for file in found.files)
            for file in found.files:
                language = self._language(file.path, file.size, headers)
                if language is not None and (content := self.files.content(file.path)) is not None:
                    programs[file.path] = parse_file(content, language, self._settings.macros).program()
        return programs

    def _language(self, path: str, size: int, headers: Language) -> Language | None:
        """Return the language of a file that may have to do with nodes; tests have not."""
        from roslens.model.source import Role
        from roslens.source.workspace.languages import language_by_name

        named = language_by_name(path)
        if (named is not None and named not in _PARSED) or size > _MOST_BYTES:
            return None
        content = self.files.content(path)
        if content is None:
            return None
        found = classify(path, content, self._settings.workspace)
        if found.language not in _PARSED or found.role is Role.TEST:
            return None
        return headers if path.endswith(".h") and found.language is not Language.PYTHON else found.language


def _named(found: FoundPackage) -> bool:
    return found.package.id != OUTSIDE_PACKAGES
