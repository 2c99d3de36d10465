"""Folders with projects of others: unpacked archives and libraries for Arduino, told by whom they name."""

from __future__ import annotations

import pytest

from roslens.source.workspace.unpacked_projects import unpacked_project, unpacked_projects

STRANGER = b"# Splines\nCopyright (C) 2010 Institute of Geometry\n"
OURS = b"# Motors\nCopyright (C) 2024 the rover team\n"
NAMELESS = b"# Motors\nHow to wire them.\n"
OWN = frozenset(("rover", "rover_base", "ada lovelace", "ada@uni.edu"))


def found(files: dict[str, bytes], package: str = "p", around: tuple[str, ...] = ()) -> tuple[str, ...]:
    return unpacked_projects(package, [*files, "p/src/a.cpp"], OWN, lambda path: files.get(path, b""), around)


@pytest.mark.parametrize(
    "files",
    [
        {"README.md": STRANGER, "CMakeLists.txt": b"", "src/a.cpp": b""},
        {"readme": STRANGER, "setup.py": b"setup()"},
        {"README": b"# Splines", "LICENSE": b"Copyright 2010 Institute"},
    ],
)
def test_an_archive_with_its_papers_is_of_others(files: dict[str, bytes]) -> None:
    assert found({f"p/utils/SISL-master/{path}": text for path, text in files.items()}) == ("p/utils/SISL-master/",)


@pytest.mark.parametrize(
    ("folder", "files"),
    [
        ("motor-main", {"README.md": OURS, "CMakeLists.txt": b""}),
        ("motor-main", {"README.md": NAMELESS, "CMakeLists.txt": b""}),
        ("motor-main", {"README.md": STRANGER}),
        ("motor-main", {"LICENSE": STRANGER}),
        ("motor-main", {"main.cpp": b"// Copyright 2010 Institute"}),
        ("rover-main", {"README.md": STRANGER, "CMakeLists.txt": b""}),
        ("motor_main", {"README.md": STRANGER, "CMakeLists.txt": b""}),
        ("motor-arm", {"README.md": STRANGER, "CMakeLists.txt": b""}),
    ],
)
def test_a_folder_that_is_merely_named_so_is_own(folder: str, files: dict[str, bytes]) -> None:
    assert found({f"p/{folder}/{path}": text for path, text in files.items()}) == ()


@pytest.mark.parametrize(
    "files",
    [
        {"library.properties": b"name=TimerOne\nauthor=Jesse Tane\n", "TimerOne.h": b""},
        {"keywords.txt": b"", "Omni.h": b"/* Created by Nino Pereira, 2011 */"},
        {"keywords.txt": b"", "src/Omni.h": b"/* Created by Nino Pereira, 2011 */"},
        {"Std.h": b"// Copyright 2004 G. Kajmowicz", "examples/all/all.ino": b""},
    ],
)
def test_a_published_library_for_arduino_is_of_others(files: dict[str, bytes]) -> None:
    assert found({f"p/firmware/lib/x/{path}": text for path, text in files.items()}) == ("p/firmware/lib/x/",)


@pytest.mark.parametrize(
    "files",
    [
        {"library.properties": b"name=Motor\nauthor=Ada Lovelace <ada@uni.edu>\n", "Motor.h": b""},
        {"library.properties": b"name=Motor\nversion=1.0\n", "Motor.h": b""},
        {"keywords.txt": b"", "Motor.h": b"// Author: Ada Lovelace"},
        {"keywords.txt": b"", "Motor.h": b"#pragma once"},
        {"Motor.h": b"// Copyright 2004 G. Kajmowicz"},
        {"examples/all/all.ino": b"// Copyright 2004 G. Kajmowicz"},
    ],
)
def test_a_library_of_the_workspace_or_of_nobody_is_own(files: dict[str, bytes]) -> None:
    assert found({f"p/firmware/lib/x/{path}": text for path, text in files.items()}) == ()


def test_a_name_counts_as_words_of_its_own() -> None:
    files = {"p/x-master/README.md": b"Copyright 2010 Clover and Roverton", "p/x-master/LICENSE": b""}
    assert found(files) == ("p/x-master/",)
    assert found({**files, "p/x-master/README.md": b"Copyright 2010, see github.com/uni/rover_base"}) == ()


def test_the_package_itself_and_what_is_around_packages_are_none() -> None:
    papers = {"p-master/README.md": STRANGER, "p-master/LICENSE": STRANGER}
    assert unpacked_projects("p-master", [*papers], OWN, lambda path: papers[path]) == ()
    assert found(papers, package=".") == ("p-master/",)
    assert found(papers, package=".", around=("p-master/inner",)) == ()


def test_what_lies_below_is_part_of_it() -> None:
    files = {
        "p/x-master/README.md": STRANGER,
        "p/x-master/LICENSE": b"",
        "p/x-master/lib/y/library.properties": STRANGER,
    }
    assert found(files) == ("p/x-master/",)


def test_names_of_archives() -> None:
    assert unpacked_project("SISL-master") == "SISL"
    assert unpacked_project("driver-noetic-devel") == unpacked_project("driver-ros2") == "driver"
    assert unpacked_project("robot") == unpacked_project("robot-mainboard") == unpacked_project("-master") == ""
