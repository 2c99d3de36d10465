"""Which entity a HAROS plug-in means that names a line, a function or a class."""

from __future__ import annotations

import re
from collections import defaultdict

from roslens.model.entity import Entity, EntityKind
from roslens.plugins.haros.scopes import Package, Project, SourceFile

_SEPARATORS = re.compile(r"::|\.")


class Places:
    """The classes and functions of a workspace, by file and by package."""

    def __init__(self, project: Project) -> None:
        """Sort what roslens knows of each package."""
        self._in_file: dict[str, list[Entity]] = defaultdict(list)
        self._classes: dict[str, dict[str, list[Entity]]] = defaultdict(lambda: defaultdict(list))
        for package in project.packages:
            for entity in package.given.entities:
                if entity.kind in (EntityKind.FUNCTION, EntityKind.CLASS):
                    self._in_file[entity.path].append(entity)
                if entity.kind is EntityKind.CLASS:
                    self._classes[package.id][_last(entity.name)].append(entity)

    def find(self, scope: SourceFile | Package, line: int, function: str | None, class_: str | None) -> str | None:
        """Return the id of what a report is about, None when it names something that is not known.

        A function is one of that name that begins at, or lies around, the line; without a line it
        must be the only one of its name. Without function and class it is the file or the package.
        """
        if not function and not class_:
            return _own_id(scope)
        if isinstance(scope, Package):
            return _only(self._classes[scope.id][_last(class_)]) if class_ and not function else None
        kind, wanted = (EntityKind.FUNCTION, function) if function else (EntityKind.CLASS, class_)
        named = [
            entity
            for entity in self._in_file[scope.given.path]
            if entity.kind is kind and _last(entity.name) == _last(wanted or "")
        ]
        if not line:
            return _only(named)
        around = [entity for entity in named if entity.line <= line <= entity.end_line]
        around.sort(key=lambda entity: (entity.line != line, entity.end_line - entity.line, entity.id))
        return around[0].id if around else None


def _own_id(scope: SourceFile | Package) -> str:
    return f"file:{scope.given.path}" if isinstance(scope, SourceFile) else f"package:{scope.given.package.id}"


def _only(entities: list[Entity]) -> str | None:
    return entities[0].id if len(entities) == 1 else None


def _last(name: str) -> str:
    """Return the last part of a qualified name, without parameters."""
    return _SEPARATORS.split(name.partition("(")[0].strip())[-1]
