"""What of the text of files a look at computation graphs depends on, besides what launch files are evaluated with."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from roslens.source.extract.facts.noted_files import Asked, NotedFiles
from roslens.source.keys import key_of
from roslens.source.rules.graph.private_data import Mention
from roslens.source.workspace.suppress import Suppression, suppressions


class Reads:
    """What was read.

    Attributes:
        files: that are read as a whole: another content may mean another result.
        comments: keys of the comments that set findings aside, by path of the files with findings.
        names: that were looked for in files.
    """

    def __init__(self, files: NotedFiles) -> None:
        """Begin with nothing read."""
        self.files = files
        self.comments: dict[str, str] = {}
        self.names: list[Mention] = []
        self._taken: dict[Asked, None] = {}

    @property
    def asked(self) -> tuple[Asked, ...]:
        """What was asked about files."""
        return (*self.files.asked, *self._taken)

    def take(self, asked: Iterable[Asked], comments: Mapping[str, str], names: Iterable[Mention]) -> None:
        """Add what was read for a part of the look."""
        self._taken.update(dict.fromkeys(asked))
        self.comments.update(comments)
        self.names.extend(names)

    def suppressions(self, path: str, content: bytes | None) -> tuple[Suppression, ...]:
        """Return the comments of a file that set findings aside."""
        found = suppressions(content or b"")
        self.comments[path] = key_of(found)
        return found
