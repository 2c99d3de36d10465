"""Neither colcon nor catkin looks for packages inside of a package."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.nested_package import as_notes_in_nested_package
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='2'><name>{}</name></package>"


@pytest.mark.parametrize(("path", "is_note"), [("src/inner", False), ("test/inner", True)])
def test_a_workspace_that_is_a_package_as_well_has_others_in_src(path, is_note, package_view, tmp_path):
    inner = tmp_path / path
    inner.mkdir(parents=True)
    (inner / "package.xml").write_text(MANIFEST.format("inner"))
    (tmp_path / "package.xml").write_text(MANIFEST.format("whole"))
    placed = {"a": [Hit("package.build_type", "m")]}
    ((only,),) = as_notes_in_nested_package(placed, package_view(tmp_path, "inner")).values()
    assert (only.certainty is Certainty.HEURISTIC) is is_note


@pytest.mark.parametrize(("around", "is_note"), [("outer", True), ("outer/deep", True), ("", False)])
def test_what_a_package_in_another_one_says_of_its_build_is_a_note(around, is_note, package_view, tmp_path):
    inner = tmp_path / around / "inner"
    inner.mkdir(parents=True)
    (inner / "package.xml").write_text(MANIFEST.format("inner"))
    (tmp_path / "beside").mkdir()
    (tmp_path / "beside/package.xml").write_text(MANIFEST.format("beside"))
    if around:
        (tmp_path / "outer/package.xml").write_text(MANIFEST.format("outer"))
    placed = {"a": [Hit("package.build_type", "m"), Hit("cmake.minimum_version", "m"), Hit("cpp.guard", "m")]}
    ((manifest, build, code),) = as_notes_in_nested_package(placed, package_view(tmp_path, "inner")).values()
    assert (manifest.certainty is Certainty.HEURISTIC) is is_note
    assert (build.certainty is Certainty.HEURISTIC) is is_note
    assert code.certainty is None
