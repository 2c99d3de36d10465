"""Actions of launch files that this process read before: a file is included by many, and started in several ways.

The same content has the same actions as long as what it read of other files is the same. A file whose actions are made
when they are visited is read each time, as what is made then may depend on what was made before.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable

from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.noted_files import Asked, FileAnswers, NotedFiles
from roslens.source.extract.launch_python.launch_action import Action

MOST_BYTES = 1_000_000
"""Content of the files that are known together; those that were not asked for lately are forgotten."""

_Known = tuple[tuple[Asked, ...], tuple[Action, ...]]


class KnownActions:
    """The actions of files by path and content."""

    def __init__(self, most_bytes: int = MOST_BYTES) -> None:
        """Know nothing yet."""
        self._most_bytes = most_bytes
        self._bytes = 0
        self._known: OrderedDict[tuple[str, bytes], _Known] = OrderedDict()

    def of(
        self, path: str, content: bytes, files: Files | None, read: Callable[[Files | None], tuple[Action, ...]]
    ) -> tuple[Action, ...]:
        """Return the actions of a file; they are read where they are not known.

        Args:
            path: of the file.
            content: of it.
            files: of the workspace; None finds none.
            read: reads the file with files.
        """
        key = (path, content)
        known = self._known.get(key)
        # Whoever notes what is asked of the files is asked again.
        if known is not None and (not known[0] or (files is not None and FileAnswers(files).same(known[0]))):
            self._known.move_to_end(key)
            return known[1]
        noted = None if files is None else NotedFiles(files)
        found = read(noted)
        if noted is not None and all(map(_is_made, found)):
            self._keep(key, (noted.asked, found))
        return found

    def _keep(self, key: tuple[str, bytes], found: _Known) -> None:
        if key not in self._known:
            self._bytes += len(key[1])
        self._known[key] = found
        while self._bytes > self._most_bytes:
            (_, gone), _ = self._known.popitem(last=False)
            self._bytes -= len(gone)


def _is_made(action: Action) -> bool:
    """Whether an action is all there; one that is unknown may be so because its file was read where much was open."""
    return action.make is None and action.kind != "unknown" and all(map(_is_made, action.children))
