"""Evidence of packages made for it: each requirement met, not met and not known where the source shows it."""

import os
import subprocess
from pathlib import Path

import pytest

from roslens.model.entity import Entity, EntityKind
from roslens.model.requirement import Met
from roslens.model.result import PackageResult
from roslens.model.source import Dependency, Language, License, Location, Package, Role, SourceFile
from roslens.source.evidence.change_log import read_changes
from roslens.source.evidence.changes import Change
from roslens.source.evidence.gather import gather
from roslens.source.evidence.package_folder import PackageFolder
from roslens.source.evidence.requirements import REQUIREMENTS

HEADER = """\
// Copyright 2026 Somebody
#pragma once

/// What it is.
class Documented {};

class Bare {};

/**
 * Does it.
 */
ROBOT_PUBLIC
inline int
done() { return 1; }
"""
DECLARATION = """\
This document is a declaration of quality for `arm`, based on [REP-2004](https://ros.org).
The package claims to be in **Quality Level 2**.
### Version Policy [1.i]
### API Stability Policy [1.iv]
### Coverage [4.iii]: at least 95 % coverage
"""
WORKFLOW = "on: [push, pull_request]\njobs:\n  lint:\n    run: clang-tidy\n  cover:\n    uses: codecov/codecov-action\n"
GOOD = {
    "LICENSE": "Apache",
    "CONTRIBUTING.md": "Sign off your commits: Developer Certificate of Origin\n",
    ".github/workflows/ci.yml": WORKFLOW,
    "SECURITY.md": "Tell us.\n",
    "arm/README.md": "# arm\nSee the [quality declaration](QUALITY_DECLARATION.md).\n",
    "arm/QUALITY_DECLARATION.md": DECLARATION,
    "arm/include/arm/arm.hpp": HEADER,
    "arm/test/test_arm.cpp": "// Copyright\nint main() {}\n",
}


def made(root: Path, files: dict[str, str], version="1.2.3", depends=(), licence="Apache-2.0") -> PackageFolder:
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    manifest = Location("arm/package.xml", 3)
    (root / "arm").mkdir(exist_ok=True)
    package = Package(
        "arm", "arm", "arm", manifest, version=version, licenses=(License(licence),) if licence else (),
        dependencies=tuple(Dependency(name, kind, manifest) for name, kind in depends),
    )  # fmt: skip
    code = [path for path in files if path.endswith((".hpp", ".cpp"))]
    sources = tuple(
        SourceFile(path, Language.CPP, Role.TEST if "/test/" in path else Role.OWN, size=len(files[path]))
        for path in code
    )
    header = "arm/include/arm/arm.hpp"
    entities = tuple(
        Entity(f"{kind.value}:{name}", kind, name, header, line)
        for name, kind, line in (
            ("Documented", EntityKind.CLASS, 5), ("Bare", EntityKind.CLASS, 7), ("done", EntityKind.FUNCTION, 13),
        )
        if header in files
    )  # fmt: skip
    return PackageFolder(PackageResult(package, sources, entities), root)


def states(folder: PackageFolder, log=None, claimed=None):
    evidence = gather(folder, log, claimed or {})
    return evidence, {one.requirement.number: one for one in evidence.items}


def test_a_package_that_shows_much(tmp_path):
    (tmp_path / ".git").mkdir()
    needs = (("ament_lint_common", "test"), ("other", "exec"))
    log = [Change(f"Do it (#{n})", 1, signed=True) for n in range(100)]
    evidence, found = states(made(tmp_path, GOOD, depends=needs), log, {"other": 1})
    assert [one.requirement for one in evidence.items] == list(REQUIREMENTS)
    assert evidence.claimed == 2
    met = {number for number, one in found.items() if one.met is Met.MET}
    assert met == {
        "1.i", "1.ii", "1.iii", "1.iv", "2.i", "2.ii", "2.iv", "3.iii", "3.iv", "3.v", "3.v.a", "3.v.c", "4.iii.a",
        "4.iii.b", "4.v.a", "4.v.b", "5.i", "7.i",
    }  # fmt: skip
    assert {number for number, one in found.items() if one.met is Met.NOT_MET} == {"3.ii", "4.iv.a"}
    assert found["3.ii"].shown.startswith("2 of 3 classes and functions")
    assert found["3.ii"].where == (Location("arm/include/arm/arm.hpp", 7),)
    assert found["2.iv"].where == (Location(".github/workflows/ci.yml", 1),)
    assert found["1.i"].where == (Location("arm/QUALITY_DECLARATION.md", 3),)
    assert (evidence.highest_open, evidence.highest_shown) == (2, 4)


def test_a_package_that_shows_nothing(tmp_path):
    evidence, found = states(
        made(tmp_path, {"arm/a.cpp": "int a;\n"}, version="0.9.0", licence="", depends=(("x", "exec"),))
    )
    assert evidence.claimed == 0
    wrong = {number for number, one in found.items() if one.met is Met.NOT_MET}
    assert wrong == {
        "1.ii", "3.i", "3.iii", "3.iv", "3.v", "3.v.a", "3.v.c", "4.i", "4.ii", "4.iv.a", "4.v.a", "4.v.b", "7.i",
    }  # fmt: skip
    assert not [one for one in found.values() if one.met is Met.MET]
    assert found["1.ii"].shown == "version 0.9.0"
    assert found["3.iv"].where == (Location("arm/a.cpp", 1),)
    assert (evidence.highest_open, evidence.highest_shown) == (5, 5)


@pytest.mark.parametrize(("through", "met"), [(96, Met.MET), (70, Met.NOT_KNOWN), (20, Met.NOT_MET)])
def test_change_requests(tmp_path, through, met):
    log = [Change("Merge pull request #1" if n < through else "quick fix", 1, signed=False) for n in range(100)]
    _, found = states(made(tmp_path, {}), log)
    assert found["2.i"].met is met
    assert found["2.i"].shown.startswith(f"{through} of the last 100 changes")


@pytest.mark.parametrize(
    ("claimed", "met", "shown"),
    [
        ({"other": 2}, Met.MET, "all 1 are in this workspace"),
        ({"other": 3}, Met.NOT_MET, "other (3)"),
        ({"other": 0}, Met.NOT_MET, "other (none)"),
        ({}, Met.NOT_KNOWN, "not in this workspace: other"),
    ],
)
def test_dependencies_of_the_same_level(tmp_path, claimed, met, shown):
    folder = made(tmp_path, {"arm/QUALITY_DECLARATION.md": DECLARATION}, depends=(("other", "exec"),))
    item = states(folder, claimed=claimed)[1]["5.i"]
    assert item.met is met
    assert shown in item.shown


def test_a_version_that_is_none(tmp_path):
    assert states(made(tmp_path, {}, version="next"))[1]["1.ii"].shown == 'the version is "next"'


def test_what_cannot_be_read_is_not_there(tmp_path):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "README.md").write_bytes(b"\xff quality level 1\n")
    (tmp_path / "arm" / "QUALITY_DECLARATION.md").mkdir()
    _, found = states(made(tmp_path, {}))
    assert found["3.v"].met is Met.NOT_MET
    assert found["3.v.a"].met is Met.MET


def test_changes_come_from_the_main_line(tmp_path):
    environment = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null"}

    def git(*words):
        subprocess.run(["git", "-C", tmp_path, "-c", "user.name=a", "-c", "user.email=a@b", *words], check=True,
                       capture_output=True, env=environment)  # fmt: skip

    assert read_changes(tmp_path) is None
    git("init", "-q", "-b", "main")
    assert read_changes(tmp_path) is None
    git("commit", "-q", "--allow-empty", "-m", "first\n\nSigned-off-by: a <a@b>")
    git("checkout", "-q", "-b", "side")
    git("commit", "-q", "--allow-empty", "-m", "aside")
    git("checkout", "-q", "main")
    git("merge", "-q", "--no-ff", "side", "-m", "Merge it")
    assert read_changes(tmp_path) == (Change("Merge it", 2, signed=False), Change("first", 0, signed=True))
