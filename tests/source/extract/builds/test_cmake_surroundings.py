"""Variables that others may set, and folders of files."""

import pytest

from roslens.source.extract.builds.cmake_surroundings import folders_of, may_be_foreign


@pytest.mark.parametrize(
    ("name", "foreign"),
    [("Foo_LIBS", True), ("my_pkg_X", True), ("named", True), ("CMAKE_BUILD_TYPE", True), ("bar_FOUND", True),
     ("plain", False), ("WIN32", False)],
)  # fmt: skip
def test_variables(name, foreign):
    assert may_be_foreign(name, {"named"}, {"Foo", "my_pkg"}) is foreign


def test_folders():
    assert folders_of(["a/b/c.cpp", "d.cpp"]) == {"a", "a/b"}
