"""What the builds of all packages make, as long as all that was read for it is the same.

Builds may read any file that is no code. What was read is noted, so that another one may change.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress

import msgspec

from roslens.model.failure import Failure
from roslens.source.extract.builds.targets import Build, build_of
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.noted_files import Asked, FileAnswers, NotedFiles
from roslens.source.extract.ir.program_codec import plain, squeezed
from roslens.source.extract.workspace.broken_build import broken_build
from roslens.source.extract.workspace.build_versions import joined_builds
from roslens.source.extract.workspace.package_versions import build_type_for
from roslens.source.keys import analyser_version, key_of
from roslens.source.progress import Progress
from roslens.source.workspace.find import FoundPackage
from roslens.store.cache import Cache


class Builds(msgspec.Struct, frozen=True, array_like=True):
    """What the build of each package makes, by name, and what broke the reading of one."""

    builds: dict[str, Build]
    failures: tuple[Failure, ...]
    lasting: bool = True


class _KeptBuilds(msgspec.Struct, frozen=True, array_like=True):
    asked: tuple[Asked, ...]
    builds: Builds


def known_builds(
    cache: Cache,
    files: Files,
    packages: Sequence[FoundPackage],
    same: Mapping[str, Sequence[FoundPackage]],
    versions: Mapping[str, tuple[str, ...]],
    watch: Progress,
) -> Builds:
    """Return what builds make; they are read where a file that was read before is another.

    Args:
        cache: what earlier runs learned.
        files: that may be read.
        packages: of the workspace.
        same: packages by name, those of one name that are for different versions of ROS together.
        versions: of ROS that each package is built for, by id.
        watch: who watches.
    """
    names = [(one.package, versions[one.package.id], [file.path for file in one.files]) for one in packages]
    slot = f"graph:builds read:{key_of(analyser_version(), names)}"
    if (packed := cache.get((slot,)).get(slot)) is not None:
        with suppress(msgspec.DecodeError):  # What a damaged cache holds is made again.
            known = msgspec.msgpack.decode(plain(packed), type=_KeptBuilds)
            if FileAnswers(files).same(known.asked):
                return known.builds
    noted = NotedFiles(files)
    found = _builds(noted, same, versions, watch)
    if not found.failures:
        cache.replace({slot: squeezed(msgspec.msgpack.encode(_KeptBuilds(noted.asked, found)))})
    return found


def _builds(
    files: Files, same: Mapping[str, Sequence[FoundPackage]], versions: Mapping[str, tuple[str, ...]], watch: Progress
) -> Builds:
    watch.step("Reading builds", len(same))
    builds: dict[str, Build] = {}
    failures: list[Failure] = []
    for name in sorted(same):
        try:
            builds[name] = _build(name, files, same[name], versions)
        except Exception as error:  # noqa: BLE001 - one package must not lose the others
            failures.append(broken_build(same[name][0].package, error))
            builds[name] = Build()
        watch.advance(item=name)
    return Builds(builds, tuple(failures))


def _build(name: str, files: Files, same: Sequence[FoundPackage], versions: Mapping[str, tuple[str, ...]]) -> Build:
    made = []
    for found in same:
        package, paths = found.package, [file.path for file in found.files]
        folder = "" if package.path == "." else package.path
        for version in versions[package.id]:
            build_type = build_type_for(package, version)
            made.append((version, build_of(name, folder, build_type, files, paths)))
    return joined_builds(made)
