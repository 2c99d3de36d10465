"""Configurations as an earlier run assembled and judged them, where nothing changed since that they depend on.

A look at graphs that is not known as a whole, because a launch file or a file of parameters changed, has to look again
only at the configurations that read it. All that is read otherwise has to be the same: code, builds, manifests, and
which files there are.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.graph.kept_shape import changes_names, shape_of
from roslens.cli.graph.reads import Reads
from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.source import Language
from roslens.source.extract.facts.noted_files import Asked, FileAnswers, NotedFiles
from roslens.source.extract.ir.program_codec import plain, squeezed
from roslens.source.extract.workspace.known_launches import launch_key
from roslens.source.keys import analyser_version, key_of
from roslens.source.rules.graph.private_data import Mention, words_of
from roslens.source.workspace.suppress import suppressions

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.source.extract.facts.launched import Launch
    from roslens.source.run_inputs import Seen
    from roslens.store.cache import Cache

_ASKED_FOR = frozenset(
    {Language.LAUNCH_XML, Language.LAUNCH_PYTHON, Language.LAUNCH_YAML, Language.YAML, Language.URDF, Language.XACRO}
)
"""Languages of files of which is noted who reads them."""


class Looked(msgspec.Struct, frozen=True, array_like=True):
    """Configurations, and what the rules of the graph find in them."""

    configurations: tuple[Configuration, ...]
    findings: tuple[Finding, ...] = ()


class _Kept(msgspec.Struct, frozen=True, array_like=True):
    """A configuration as it is kept.

    Attributes:
        state: a key of all that it depends on besides the content of files that are asked for.
        launch: a key of what its launch file came to.
        hashes: of the content of files that are asked for, by path.
        asked: what was asked about files.
        comments: keys of the comments that set findings aside, of the files with findings.
        names: that were looked for in files.
        looked: what came of it.
    """

    state: str
    launch: str
    hashes: dict[str, str]
    asked: tuple[Asked, ...]
    comments: dict[str, str]
    names: tuple[Mention, ...]
    looked: Looked


_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(_Kept).decode


class KeptConfigurations:
    """The configurations of a workspace, by name."""

    def __init__(self, source: GraphSource, cache: Cache, seen: Seen, hinted_in: str) -> None:
        """Look nothing up yet.

        Args:
            source: that assembles them.
            cache: what earlier runs learned.
            seen: the workspace and its files.
            hinted_in: the file with the hints.
        """
        self._source = source
        self._cache = cache
        self._files = source.facts.files
        self._answers = FileAnswers(self._files)
        every = [file for files in seen.inventory.files.values() for file in files]
        self._hashes = {file.path: file.content_hash for file in every if file.language in _ASKED_FOR}
        others = sorted((file.path, file.content_hash) for file in every if file.language not in _ASKED_FOR)
        here = os.getcwd()  # noqa: PTH109 - a text
        self._state = key_of(source.settings, hinted_in, here, shape_of(seen), others, source.facts.code_key)
        self._start = f"graph:configuration:{key_of(analyser_version(), str(source.root))}"
        self._new: dict[str, bytes] = {}

    def looked(self, what: str, given: Mapping[str, str], launch: Launch | None, look: Callable[[], Looked]) -> Looked:
        """Return what an earlier look at a configuration found, or what this one does.

        Args:
            what: the name and the launch file, which tell it from others.
            given: arguments of the launch file.
            launch: what the launch file comes to; None where it is made of something else.
            look: assembles and judges it.
        """
        slot = f"{self._start}:{key_of(what, sorted(given.items()))}"
        started = "" if launch is None else launch_key(launch)
        kept = self._known(slot, started)
        if kept is not None:
            self._source.reads.take(kept.asked, kept.comments, kept.names)
            return kept.looked
        outer = self._source.reads
        reads = self._source.reads = Reads(NotedFiles(self._files))
        try:
            found = look()
        finally:
            self._source.reads = outer
            outer.take(reads.asked, reads.comments, reads.names)
        names = tuple(dict.fromkeys(reads.names))
        kept = _Kept(self._state, started, self._hashes, reads.asked, reads.comments, names, found)
        with suppress(UnicodeEncodeError):  # What is no text is looked at again.
            self._new[slot] = squeezed(_encode(kept))
        return found

    def _known(self, slot: str, started: str) -> _Kept | None:
        packed = self._cache.get((slot,)).get(slot)
        try:
            kept = None if packed is None else _decode(plain(packed))
        except msgspec.DecodeError:
            return None  # What a damaged cache holds is made again.
        if kept is None or (kept.state, kept.launch) != (self._state, started) or not self._answers.same(kept.asked):
            return None
        changed = (path for path, content in self._hashes.items() if kept.hashes.get(path) != content)
        return None if any(self._is_seen(path, kept) for path in changed) else kept

    def _is_seen(self, path: str, kept: _Kept) -> bool:
        """Whether a file that nobody read as a whole has another comment or name that counts."""
        text = self._files.content(path)
        if path in kept.comments and kept.comments[path] != key_of(suppressions(text or b"")):
            return True
        return changes_names(path, words_of(text), kept.names)

    def keep(self) -> None:
        """Write what is new."""
        self._cache.replace(self._new)
        self._new = {}
