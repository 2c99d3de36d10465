"""Values of arguments that an included launch file leaves behind, and that the next one takes for its own.

An include opens no scope: what it sets for one file, and what that file declares with a default, holds
for all actions after it (launch/actions/declare_launch_argument.py: a default counts where nothing has the name yet).
"""

from __future__ import annotations

from roslens.source.extract.facts.launched import Shared
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Text

MOST_SHARED = 200
"""Of one evaluation."""


class SharedValues:
    """Knows which file left each value, and collects the defaults that never come into effect."""

    def __init__(self) -> None:
        """Begin with an evaluation."""
        self._left: dict[str, tuple[Text, Evidence, tuple[str, ...]]] = {}
        self._found: dict[Shared, None] = {}

    @property
    def found(self) -> tuple[Shared, ...]:
        """What was met, in order, each once."""
        return tuple(self._found)

    def leave(self, name: str, value: Text, at: Evidence, files: tuple[str, ...]) -> None:
        """Note that a file, the last of those that are open, has an argument with a value of its own."""
        self._left[name] = (value, at, files)

    def give(
        self, configurations: dict[str, Text], name: str, value: Text, at: Evidence, files: tuple[str, ...]
    ) -> None:
        """Set what an include gives to a file; a value that already holds under the name is not of that file alone."""
        before = configurations.get(name)
        configurations[name] = value
        if before is None or before.known is None or before.known != value.known:
            self.leave(name, value, at, files)

    def meet(
        self, name: str, value: Text, default: Text | None, at: Evidence, include: Evidence, files: tuple[str, ...]
    ) -> None:
        """Note an argument of a file that already has a value, where another file beside it left that.

        Args:
            name: of the argument.
            value: that it has.
            default: that it is declared with.
            at: of the declaration.
            include: of the file.
            files: that are open, the one of the declaration last.
        """
        left, by, before = self._left.get(name, (None, at, ()))
        is_beside = bool(before) and files[: len(before)] != before
        if left is not value or not is_beside or default is None or len(self._found) >= MOST_SHARED:
            return
        if value.known is not None and default.known is not None and value.known != default.known:
            self._found[Shared(name, at, default.known, value.known, by, include)] = None
