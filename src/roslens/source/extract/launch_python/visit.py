"""The action that is visited while a launch file is evaluated."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Value
from roslens.source.extract.facts.files import Files
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.symbolic.text import Text


class Visit:
    """What is known while a launch file is evaluated.

    Attributes:
        path: of the file.
        files: of the workspace that it may read.
        scope: of the action that is visited, where a function is called by one; None while the file is read.
        reporting: the same, for what is certain to be resolved: ``scope`` is asked about much that is not.
    """

    __slots__ = ("files", "path", "reporting", "scope")

    def __init__(self, path: str, files: Files | None) -> None:
        """Begin to read a file."""
        self.path = path
        self.files = files
        self.scope: Scope | None = None
        self.reporting: Scope | None = None

    def performed(self, value: Value) -> Value:
        """Return a substitution as what it comes to for the action that is visited, where that is known."""
        if not isinstance(value, Deferred | Text) or self.scope is None:
            return value
        return resolve(value, self.scope)

    def at_once(self, value: Value) -> Value:
        """Return a path that is made of texts as what it comes to when the file is read."""
        match value:
            case Deferred() if self.files is not None and not any(type(part) is Deferred for part in value.parts):
                return resolve(value, Scope(self.files, {}, {}, self.path))
        return value
