"""Files of a workspace, of which is noted what was asked: the same answers mean the same result."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from hashlib import blake2b

import msgspec

from roslens.source.extract.facts.files import Files


class Asked(msgspec.Struct, frozen=True, array_like=True):
    """A question about files and a key of its answer: ``package``, ``content`` or ``listing``, of a name or path."""

    what: str
    of: str
    answer: str


class FileAnswers:
    """Keys of what files answer, each asked once."""

    def __init__(self, files: Files) -> None:
        """Ask nothing yet."""
        self._known: dict[tuple[str, str], str] = {}
        self._ask: dict[str, Callable[[str], str]] = {
            "package": lambda name: package_key(files.package(name)),
            "content": lambda path: content_key(files.content(path)),
            "listing": lambda folder: listing_key(files.listing(folder)),
        }

    def same(self, asked: Iterable[Asked]) -> bool:
        """Return whether all of that has the same answer still."""
        return all(one.what in self._ask and self._answer(one.what, one.of) == one.answer for one in asked)

    def _answer(self, what: str, of: str) -> str:
        key = (what, of)
        if key not in self._known:
            self._known[key] = self._ask[what](of)
        return self._known[key]


class NotedFiles:
    """Files as somebody else has them, noting what is asked; see :class:`Files`."""

    def __init__(self, files: Files) -> None:
        """Begin with nothing noted."""
        self._files = files
        self._noted: dict[tuple[str, str], str] = {}

    @property
    def asked(self) -> tuple[Asked, ...]:
        """What was asked, in order."""
        return tuple(Asked(what, of, answer) for (what, of), answer in self._noted.items())

    def package(self, name: str) -> str | None:
        """Return the folder of a package; None where the workspace has none of that name."""
        found = self._files.package(name)
        self._noted["package", name] = package_key(found)
        return found

    def content(self, path: str) -> bytes | None:
        """Return the bytes of a file; None where there is none, or it cannot be read."""
        found = self._files.content(path)
        if ("content", path) not in self._noted:
            self._noted["content", path] = content_key(found)
        return found

    def listing(self, folder: str) -> tuple[str, ...]:
        """Return the paths of the files below a folder, those in folders of it too; none where there is no folder."""
        found = self._files.listing(folder)
        self._noted["listing", folder] = listing_key(found)
        return found


def package_key(folder: str | None) -> str:
    """Return a key of the folder of a package."""
    return "" if folder is None else f"={folder}"


def content_key(content: bytes | None) -> str:
    """Return a key of the content of a file."""
    return "" if content is None else blake2b(content, digest_size=16).hexdigest()


def listing_key(paths: Iterable[str]) -> str:
    """Return a key of the files below a folder."""
    return blake2b("\0".join(paths).encode(errors="surrogateescape"), digest_size=16).hexdigest()
