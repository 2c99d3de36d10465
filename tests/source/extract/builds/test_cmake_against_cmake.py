"""CMake projects written by chance: values, targets and what is installed are what cmake itself comes to.

What is told as unknown may be left out; what is stated, or dropped without a word, may not differ.
"""

import shutil

import pytest
from oracles.cmake_answers import Cmake, own_answers
from oracles.generated_cmake import Project

KINDS = {
    "EXECUTABLE": "EXECUTABLE", "STATIC": "STATIC_LIBRARY", "SHARED": "SHARED_LIBRARY", "MODULE": "MODULE_LIBRARY",
    "OBJECT": "OBJECT_LIBRARY", "INTERFACE": "INTERFACE_LIBRARY", "": "SHARED_LIBRARY",
}  # fmt: skip
FIRST, OTHERS = 2000, range(3030, 3062, 4)


@pytest.fixture(scope="module")
def cmake(tmp_path_factory):
    if not shutil.which("cmake") or not shutil.which("c++"):
        pytest.skip("needs cmake and a compiler of C++")
    return Cmake(tmp_path_factory.mktemp("cmake"))


def differences(real, own):
    """Return what is stated otherwise than by cmake."""
    found = []
    for label in sorted(real.told.keys() | own.told.keys()):
        values, stated = real.told.get(label, []), own.told.get(label, [])
        if None not in stated and stated != values and (stated or not own.unresolved):
            found.append(f"{label}: {stated} but cmake {values}")
    for name, target in real.targets.items():
        stated = own.targets.get(name)
        if stated is None:
            if not own.unresolved:
                found.append(f"{name} is missing")
            continue
        found.extend(_of_target(name, target, stated))
    for name, stated in own.targets.items():
        # cmake does not list interfaces that have no sources.
        if name not in real.targets and stated.certain and stated.kind != "INTERFACE":
            found.append(f"{name} is not there")
    if real.installed != own.installed:
        found.append(f"installed: {sorted(real.installed ^ own.installed)}")
    return found


def _of_target(name, target, stated):
    if KINDS[stated.kind] != target.kind:
        yield f"{name} is {stated.kind} but of cmake {target.kind}"
    if not stated.certain:
        return
    if stated.all_sources != target.all_sources:
        yield f"{name} has {sorted(stated.all_sources)} but of cmake {sorted(target.all_sources)}"
    if {one.strip("/") for one in stated.installed} != {one.removeprefix("/=install/") for one in target.installed}:
        yield f"{name} goes to {stated.installed} but of cmake to {target.installed}"
    file = target.output.removesuffix(".a").removesuffix(".so")
    if file and stated.output not in (file, file.removeprefix("lib")):
        yield f"the file of {name} is {stated.output} but of cmake {target.output}"


@pytest.mark.heavy
@pytest.mark.timeout(280)
@pytest.mark.parametrize("first", [FIRST, *(pytest.param(first, marks=pytest.mark.nightly) for first in OTHERS)])
def test_projects_come_to_what_cmake_says(cmake, first):
    read = unknown = 0
    for seed in range(first, first + 4):
        files = Project(seed, 14).files
        real = cmake.answers(files)
        if real.error:
            continue
        own = own_answers(files)
        assert not differences(real, own), f"Project({seed}, 14)"
        read += len(real.told)
        unknown += sum(None in own.told.get(label, [None]) for label in real.told)
    assert read > 60, "cmake has refused most projects"
    assert unknown < read / 3, "most is said to be unknown"


def test_the_same_seed_writes_the_same_project():
    assert Project(7, 10).files == Project(7, 10).files
    assert Project(7, 10).files != Project(8, 10).files
