"""A source that is in no target runs on no robot."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.unbuilt_source import as_notes_of_unbuilt_sources
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='2'><name>p</name><buildtool_depend>catkin</buildtool_depend></package>"


@pytest.mark.parametrize(
    ("path", "cmake", "beside", "is_note"),
    [
        ("src/old.cpp", "add_executable(a src/a.cpp)", {}, True),
        ("src/old.cpp", "add_executable(a src/a.cpp)\n# add_executable(old src/old.cpp)", {}, True),
        ("src/old.cpp", "set(SOURCES src/a.cpp)\nadd_executable(a ${SOURCES})", {}, True),
        ("src/old.cpp", "add_executable(a src/a.cpp src/old.cpp)", {}, False),
        ("src/p_node.cpp", "add_executable(a src/${PROJECT_NAME}_node.cpp)", {}, False),
        ("src/old.cpp", "foreach(n a old)\nadd_executable(${n} src/${n}.cpp)\nendforeach()", {}, False),
        ("src/old.cpp", "file(GLOB SOURCES src/*.cpp)\nadd_executable(a ${SOURCES})", {}, False),
        ("src/old.cpp", "aux_source_directory(src SOURCES)\nadd_executable(a ${SOURCES})", {}, False),
        ("src/old.cpp", "add_executable(a src/a.cpp ${MORE})", {}, False),
        ("src/old.cpp", "add_executable(a src/a.cpp)\nament_auto_add_library(b DIRECTORY src)", {}, False),
        ("src/old.cpp", "add_executable(a src/a.cpp)", {"src/a.cpp": '#include "old.cpp"\n'}, False),
        ("src/old.cpp", "add_executable(a src/a.cpp)", {"src/CMakeLists.txt": "add_executable(old old.cpp)"}, False),
        ("firmware/old.cpp", "add_executable(a src/a.cpp)", {"firmware/platformio.ini": ""}, False),
        ("firmware/old.cpp", "add_executable(a src/a.cpp)", {"firmware/firmware.ino": ""}, False),
        ("src/old.cpp", "add_executable(a src/a.cpp)", {"setup.py": "setup(packages=['p'])"}, True),
        ("src/old.cpp", "add_executable(a src/a.cpp)", {"setup.py": "setup(ext_modules=[Extension('old')])"}, False),
        ("src/old.cpp", "catkin_python_setup()", {}, False),
        ("include/p/old.h", "add_executable(a src/a.cpp)", {}, False),
    ],
)
def test_a_source_in_no_target(path, cmake, beside, is_note, package_view, tmp_path):
    texts = {"package.xml": MANIFEST, "CMakeLists.txt": f"project(p)\n{cmake}\n", path: "int a;\n", **beside}
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    placed = {path: [Hit("node.publish_too_early", "m", 1), Hit("cpp.guard", "m", 1), Hit("other.rule", "m", 1)]}
    ((node, cpp, other),) = as_notes_of_unbuilt_sources(placed, package_view(tmp_path)).values()
    assert [one.certainty for one in (node, cpp, other)] == [*([Certainty.HEURISTIC if is_note else None] * 2), None]
