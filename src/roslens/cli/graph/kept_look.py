"""What an earlier run found in computation graphs, where nothing changed since that it depends on.

Graphs are made of programs, not of their text: as long as the lines stay where they are, other comments change nothing,
nor does code of tests. What of the text counts besides are comments that set findings aside, and names that only one
node uses. All other files have to be the same, and whatever was read while launch files were evaluated.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.graph.kept_configurations import KeptConfigurations
from roslens.cli.graph.kept_shape import changes_names, shape_of
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.graphs.graph_scope import GraphScope
from roslens.model.source import OUTSIDE_PACKAGES, Language, SourceFile
from roslens.plugins.outcome import Outcome
from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.facts.noted_files import Asked, FileAnswers
from roslens.source.extract.ir.program_codec import becomes_nodes, program_keys
from roslens.source.extract.workspace.workspace_programs import content_of
from roslens.source.keys import analyser_version, key_of
from roslens.source.rules.graph.private_data import Mention, words_of
from roslens.source.run_inputs import Seen, Sight
from roslens.source.workspace.suppress import suppressions
from roslens.store.cache import Cache
from roslens.store.configurations import PackedConfiguration

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.source.settings import SourceSettings

_CODE = frozenset({Language.C, Language.CPP, Language.PYTHON})
"""Languages of which programs are read, and of which builds read no file but ``setup.py``."""


class _Kept(msgspec.Struct, frozen=True, array_like=True):
    """A look.

    Attributes:
        shape: a key of all that it depends on besides the content of files.
        hashes: of the content of files with a language, by path.
        programs: keys of the programs of files, by path.
        asked: what was asked about files that are read as a whole.
        comments: keys of the comments that set findings aside, of the files with findings.
        names: that were looked for in files.
        findings: that it found.
        failures: what it could not look at.
        graphs: that it looked at, as a run keeps them.
        scope: which these are.
    """

    shape: str
    hashes: dict[str, str]
    programs: dict[str, str]
    asked: tuple[Asked, ...]
    comments: dict[str, str]
    names: tuple[Mention, ...]
    findings: tuple[Finding, ...]
    failures: tuple[Failure, ...]
    graphs: tuple[PackedConfiguration, ...]
    scope: GraphScope | None


_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(_Kept).decode


class KeptLook:
    """The last look at a workspace."""

    def __init__(
        self, cache: Path, seen: Seen, settings: SourceSettings, root: str, hinted_in: str, *, every: bool
    ) -> None:
        """Know nothing yet.

        Args:
            cache: the file in which it is kept.
            seen: the workspace and its files.
            settings: of the run.
            root: of the workspace.
            hinted_in: the file with the hints.
            every: whether all launch files are looked at.
        """
        self._cache = cache
        self._seen = seen
        self._macros = settings.macros
        self._files = {file.path: file for files in seen.inventory.files.values() for file in files}
        folders: dict[str, str] = {}
        for one in seen.workspace.packages:
            if one.package.id != OUTSIDE_PACKAGES:
                folders.setdefault(one.package.name, "" if one.package.path == "." else one.package.path)
        self._reading = FolderFiles(Path(seen.workspace.root), folders)
        self._slot = f"graph:look:{key_of(analyser_version(), root, every)}"
        self._shape = key_of(settings, hinted_in, os.getcwd(), shape_of(seen))  # noqa: PTH109 - a text

    def known(self) -> Sight | None:
        """Return the last look, where this one would find the same."""
        with Cache.open(self._cache) as cache:
            packed = cache.get((self._slot,)).get(self._slot)
            try:
                kept = None if packed is None else _decode(packed)
            except msgspec.DecodeError:
                return None  # What a damaged cache holds is made again.
            if kept is None or kept.shape != self._shape or kept.hashes.keys() != self._files.keys():
                return None
            changed = [file for path, file in self._files.items() if file.content_hash != kept.hashes[path]]
            programs = cache.get(program_keys(changed, self._macros).values())
            cache.touch((self._slot,))
        if not all(self._is_unseen(file, kept, programs) for file in changed):
            return None
        if not FileAnswers(self._reading).same(kept.asked):
            return None
        return Sight(Outcome(findings=kept.findings, failures=kept.failures), kept.graphs, kept.scope)

    def _is_unseen(self, file: SourceFile, kept: _Kept, programs: dict[str, bytes]) -> bool:
        """Whether what changed in a file is nothing that the look depends on."""
        if file.language not in _CODE or file.path.rpartition("/")[2] == "setup.py":
            return False
        if becomes_nodes(file):
            packed = programs.get(program_keys((file,), self._macros)[file.path])
            if packed is None or content_of(packed) != kept.programs.get(file.path):
                return False
        text = self._reading.content(file.path)
        if file.path in kept.comments and kept.comments[file.path] != key_of(suppressions(text or b"")):
            return False
        return not changes_names(file.path, words_of(text), kept.names)

    def parts(self, source: GraphSource) -> KeptConfigurations:
        """Return the parts of the last look, which may be known where all of it is not."""
        return KeptConfigurations(source, source.cache, self._seen, source.hinted_in)

    def keep(self, source: GraphSource, sight: Sight, parts: KeptConfigurations | None = None) -> None:
        """Keep a look and its parts for the next run, unless that may find something else in the same files."""
        if not source.is_lasting:
            return
        if parts is not None:
            parts.keep()
        asked = dict.fromkeys((*source.launches.asked, *source.reads.asked))
        kept = _Kept(
            self._shape,
            {path: file.content_hash for path, file in self._files.items()},
            source.facts.program_contents(),
            tuple(asked),
            source.reads.comments,
            tuple(dict.fromkeys(source.reads.names)),
            sight.outcome.findings,
            sight.outcome.failures,
            sight.configurations,
            sight.graphs,
        )
        with Cache.open(self._cache) as cache:
            cache.replace({self._slot: _encode(kept)})
