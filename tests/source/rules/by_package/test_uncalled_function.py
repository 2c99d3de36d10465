"""A forgotten ``return`` matters where something calls the function."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.uncalled_function import as_notes_where_uncalled
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
DEFINED = "bool Arm::stop(int speed) { engine(speed); }\n"


@pytest.mark.parametrize(
    ("header", "more", "build", "is_note"),
    [
        ("bool stop(int speed);", "", "", True),
        ("bool stop(int speed);", "void f() { arm.stop(1); }", "", False),
        ("bool stop(int speed);", "void f() { bind(&Arm::stop, this); }", "", False),
        ("bool stop(int speed) override;", "", "", False),
        ("virtual bool stop(int speed);", "", "", False),
        ("bool stop(int speed);", "void stopped() {}", "", True),
        ("bool stop(int speed);", "", "install(DIRECTORY include/ DESTINATION include)", False),
    ],
)
def test_a_function_that_nothing_calls(header, more, build, is_note, package_view, tmp_path):
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": f"cmake_minimum_required(VERSION 3.8)\nproject(p)\n{build}\n",
        "include/p/arm.hpp": f"struct Arm {{ {header} }};\n",
        "src/arm.cpp": DEFINED,
        "src/more.cpp": more,
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    hits = [Hit("cpp.missing_return", "m", 1, context="Arm::stop(int speed)"), Hit("cpp.other", "m", 1)]
    ((first, second),) = as_notes_where_uncalled({"src/arm.cpp": hits}, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert second.certainty is None
