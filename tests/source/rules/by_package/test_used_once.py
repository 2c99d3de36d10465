"""A header of one source hands nothing on."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.used_once import as_notes_where_used_once
from roslens.source.rules.hit import HEADER, Hit

MANIFEST = "<package format='2'><name>p</name><buildtool_depend>catkin</buildtool_depend></package>"


@pytest.mark.parametrize(
    ("path", "users", "line", "is_note"),
    [
        ("src/a.h", ["src/a.cpp"], "", True),
        ("src/a.h", ["src/a.cpp"], "install(DIRECTORY include/p/ DESTINATION include)", True),
        ("src/a.h", ["src/a.cpp"], "install(TARGETS a DESTINATION lib)", True),
        ("src/a.h", ["src/a.cpp", "src/b.cpp"], "", False),
        ("src/a.h", [], "", False),
        ("include/p/a.h", ["src/a.cpp"], "", False),
        ("src/a.h", ["src/a.cpp"], "install(FILES src/a.h DESTINATION include)", False),
        ("src/a.h", ["src/a.cpp"], "install(DIRECTORY src/ DESTINATION include)", False),
        ("src/a.h", ["src/a.cpp"], "install(FILES ${HEADERS} DESTINATION include)", False),
    ],
)
def test_a_header_below_src_that_one_file_includes(path, users, line, is_note, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text(f"project(p)\nadd_executable(a src/a.cpp)\n{line}\n")
    for name in (path, *users):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text('#include "a.h"\n' if name in users else "using namespace std;\n")
    placed = {path: [Hit("cpp.using_namespace", "m", 1, only=HEADER), Hit("cpp.guard", "m", 1, only=HEADER)]}
    ((first, second),) = as_notes_where_used_once(placed, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert second.certainty is None
