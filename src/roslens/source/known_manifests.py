"""Manifests that were read before need no second reading."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Package
from roslens.source.keys import analyser_version, content_hash, key_of
from roslens.store.cache import Cache


class _Read(msgspec.Struct, frozen=True, array_like=True):
    package: Package | None
    failures: tuple[Failure, ...]


class KnownManifests:
    """Reads manifests as :func:`~roslens.source.workspace.manifest.read_manifest` does, through a cache."""

    def __init__(self, cache: Cache) -> None:
        """Take what ``cache`` remembers; :meth:`keep` adds to it."""
        self._cache = cache
        self._new: dict[str, bytes] = {}
        self._decoder = msgspec.msgpack.Decoder(_Read)

    def read(
        self, content: bytes, path: str, environment: Mapping[str, str]
    ) -> tuple[Package | None, tuple[Failure, ...]]:
        """Return the package that a manifest declares, and what is wrong with it."""
        key = f"manifest:{key_of(analyser_version(), content_hash(content), path, dict(environment))}"
        if blob := self._cache.get((key,)).get(key):
            known = self._decoder.decode(blob)
            return known.package, known.failures
        from roslens.source.workspace.manifest import read_manifest

        package, failures = read_manifest(content, path, environment)
        try:
            blob = msgspec.msgpack.encode(_Read(package, failures))
        except UnicodeEncodeError:
            # A name with bytes that are no text cannot be kept; it is read again each time.
            return package, failures
        self._new[key] = blob
        # The keys of results are of what is encoded, and Python 3.10 has empty tuples that are not the default one.
        known = self._decoder.decode(blob)
        return known.package, known.failures

    def keep(self) -> None:
        """Keep what was read for the next run."""
        self._cache.put(self._new)
        self._new.clear()
