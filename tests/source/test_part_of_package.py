"""A look at the files of a package that changed finds in them what a look at all of it finds."""

from contextlib import ExitStack
from functools import partial
from pathlib import Path

import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.changed_packages import left_out_of
from roslens.source.pipeline import Clock, analyse
from roslens.source.settings import SourceSettings
from roslens.store.cache import Cache
from roslens.store.runs import Store

MANIFEST = """\
<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><depend>rclcpp</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
FILES = {
    "package.xml": MANIFEST,
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.16)\nproject(arm)\nfind_package(rclcpp REQUIRED)\n",
    "include/arm/arm.hpp": "#pragma once\n#include <vector>\nclass Arm { void turn(); std::vector<int> all_; };\n",
    "src/arm.cpp": '#include "arm/arm.hpp"\n#include <rclcpp/rclcpp.hpp>\n'
    "// roslens: ignore[ros.cbo.max] a hub\n"
    "void Arm::turn() { register std::vector<int> x; std::this_thread::sleep_for(1s); }\n",
    "src/main.cpp": "#include <rclcpp/rclcpp.hpp>\nstruct Main { int a; };\n"
    "void run() { node->create_wall_timer(1s, std::bind(&Arm::turn, &arm)); register int b; }\n",
    "src/other.cpp": "struct Other { void f(); };\nvoid Other::f() { register int c; }\n",
}


@pytest.fixture
def arm(tmp_path):
    for path, text in FILES.items():
        (tmp_path / "arm" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "arm" / path).write_text(text)
    return tmp_path


@pytest.fixture
def look():
    """Return a function that returns the view of a run in which files changed; of a whole run without any."""
    with ExitStack() as opened:
        yield partial(_look, opened)


def _look(opened: ExitStack, root: Path, *changed: str):
    def analysed(**chosen):
        store, cache = opened.enter_context(Store.open(None)), opened.enter_context(Cache.open(None))
        answer = analyse([root], settings, store=store, cache=cache, clock=clock, base=root, jobs=1, **chosen)
        return answer, store.view(answer.run)

    settings, clock = SourceSettings(models=("ros",)), Clock("2026-01-01T00:00:00+00:00", 0.0)
    answer, view = analysed()
    if not changed:
        return answer, view
    hashes = {file.path: file.content_hash for _, file in view.files()}
    unchanged = {path: hash_ for path, hash_ in hashes.items() if path.removeprefix("arm/") not in changed}
    return analysed(unchanged=unchanged)


def found_in(view, path):
    return {(one.rule, one.line, one.message) for one in view.findings() if one.path == f"arm/{path}"}


def test_rules_say_of_a_changed_file_what_they_always_say(arm, look):
    _, whole = look(arm)
    answer, part = look(arm, "src/arm.cpp")
    assert answer.left_out == 2
    assert "node.sleep_in_callback" in {rule for rule, *_ in found_in(part, "src/arm.cpp")}, "registered in main.cpp"
    silenced = {one for one in found_in(whole, "src/arm.cpp") if one[0] == "roslens.suppression_unused"}
    assert found_in(part, "src/arm.cpp") == found_in(whole, "src/arm.cpp") - silenced
    assert not found_in(part, "src/other.cpp")


def test_what_needs_the_whole_package_has_no_value(arm, look):
    _, part = look(arm, "src/arm.cpp")
    values = {one.id: one.values for one in part.entities()}
    assert not {"loc", "functions", "duplicated_lines"} & set(values["package:arm"])
    assert values["class:arm/include/arm/arm.hpp#Arm"] == {}
    assert values["file:arm/src/arm.cpp"]["loc"] > 0
    assert "duplicated_lines" not in values["file:arm/src/arm.cpp"]
    assert "file:arm/src/other.cpp" not in values


@pytest.mark.parametrize("path", ["package.xml", "CMakeLists.txt"])
def test_where_no_source_changed_all_of_the_package_is_looked_at(arm, look, path):
    _, whole = look(arm)
    answer, part = look(arm, path)
    assert answer.left_out == 0
    assert found_in(part, path) == found_in(whole, path)
    assert found_in(part, "src/other.cpp") == found_in(whole, "src/other.cpp")


def test_a_source_is_looked_at_with_its_header():
    def file(path, language=Language.CPP):
        return SourceFile(path, language, size=1, content_hash="same")

    files = [file("a/x.cpp"), file("b/x.hpp"), file("a/y.cpp"), file("a/n.py", Language.PYTHON)]
    known = {one.path: "same" for one in files}
    assert left_out_of(files, {**known, "a/x.cpp": "other"}) == {"a/y.cpp", "a/n.py"}
    assert left_out_of([*files, file("a/new.cpp")], known) == set(known)
    assert left_out_of([*files, file("setup.py", Language.PYTHON)], known) == set()
    assert left_out_of([*files, file("m.msg", Language.MSG)], known) == set()
