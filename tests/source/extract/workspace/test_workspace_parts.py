"""A part of a workspace is kept when it will last, and made again when what is kept is no use."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest

from roslens.model.failure import Failure
from roslens.source.extract.workspace import workspace_builds
from roslens.source.extract.workspace.workspace_parts import Builds, LaunchFile, WorkspaceParts
from roslens.source.inventory import take_inventory
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache

MANIFEST = '<package format="2"><name>{}</name><version>1.0.0</version></package>'


def parts_of(root: Path, cache: Cache) -> WorkspaceParts:
    chosen = SourceSettings()
    workspace = find_workspace([root], chosen.workspace)
    return WorkspaceParts(workspace, take_inventory(workspace, chosen.workspace, {}), chosen, cache=cache, jobs=1)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    for folder, name in (("a", "arm"), ("b", "arm"), ("c", "eye")):
        (tmp_path / "ws" / folder / "launch").mkdir(parents=True)
        (tmp_path / "ws" / folder / "package.xml").write_text(MANIFEST.format(name))
        (tmp_path / "ws" / folder / "CMakeLists.txt").write_text(f"project({name})\nadd_executable({folder} x.cpp)\n")
        (tmp_path / "ws" / folder / "launch" / "all.launch").write_text("<launch/>")
    return tmp_path / "ws"


@pytest.fixture
def cache() -> Iterator[Cache]:
    with Cache.open(None) as opened:
        yield opened


def test_of_two_packages_of_one_name_the_first_is_meant(root: Path, cache: Cache):
    parts = parts_of(root, cache)
    assert parts.folders == {"arm": "a", "eye": "c"}
    assert {name: [one.name for one in build.targets] for name, build in parts.builds.builds.items()} == {
        "arm": ["a"],
        "eye": ["c"],
    }
    assert parts.launch_files() == (
        LaunchFile("a/launch/all.launch", "arm@a", 1),
        LaunchFile("b/launch/all.launch", "arm@b", 1),
        LaunchFile("c/launch/all.launch", "eye", 1),
    )


def test_one_build_that_breaks_does_not_lose_the_others(root: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch):
    build_of = workspace_builds.build_of

    def breaking(name: str, *rest: object) -> object:
        if name == "arm":
            raise ValueError("no")
        return build_of(name, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(workspace_builds, "build_of", breaking)
    found = parts_of(root, cache).builds
    assert [(one.package, one.what) for one in found.failures] == [("arm@a", "ValueError: no")]
    assert (len(found.builds["arm"].targets), len(found.builds["eye"].targets)) == (0, 1)


def test_what_will_not_last_is_not_kept(root: Path, tmp_path: Path):
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        passing, lasting = Builds({}, (), lasting=False), Builds({}, ())
        # Each looks at a workspace for one run, which asks once.
        assert parts_of(root, cache).kept("x", "1", Builds, lambda: passing) == passing
        assert parts_of(root, cache).kept("x", "1", Builds, lambda: lasting) == lasting
        parts = parts_of(root, cache)
        assert parts.kept("x", "1", Builds, lambda: passing) == lasting
        assert parts.kept("x", "2", Builds, lambda: passing) == passing
        assert parts.kept("x", "2", Builds, lambda: lasting) == passing


def test_what_says_the_same_often_is_kept_small(root: Path, tmp_path: Path):
    why = "a condition of which the words are long, " * 20
    failures = tuple(Failure("graph", why, f"what {number}", "", package="a") for number in range(200))
    large = Builds({}, failures)
    with Cache.open(tmp_path / "c.sqlite") as cache:
        parts = parts_of(root, cache)
        parts.kept("x", "1", Builds, lambda: large)
        assert parts.kept("x", "1", Builds, lambda: Builds({}, ())) == large
        kept = cache.get(("graph:x:1",))["graph:x:1"]
    assert len(kept) * 10 < len(msgspec.msgpack.encode(large))


@pytest.mark.parametrize("kept", [b"", b"\xc1", b"\x78\x01", msgspec.msgpack.encode({"a": 1})])
def test_what_cannot_be_read_is_made_again(root: Path, tmp_path: Path, kept: bytes):
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        cache.put({"graph:x:1": kept})
        assert parts_of(root, cache).kept("x", "1", Builds, lambda: Builds({}, ())) == Builds({}, ())


def test_what_is_declared_beside_code_changes_the_key_of_units(root: Path, cache: Cache):
    cmake = root / "c" / "CMakeLists.txt"
    cmake.write_text(cmake.read_text() + "generate_parameter_library(eye_parameters eye.yaml)\n")
    (root / "c" / "eye.yaml").write_text("eye: {rate: {type: double}}\n")
    parts = parts_of(root, cache)
    (library,) = parts.libraries
    assert (library.namespace, library.package, [one.name for one in library.declarations]) == (
        "eye",
        parts.found["eye"].package.id,
        ["rate"],
    )
    assert parts.index().parameter_libraries == parts.libraries
    (root / "c" / "eye.yaml").write_text("eye: {rate: {type: int}}\n")
    assert parts_of(root, cache).programs_key != parts.programs_key
