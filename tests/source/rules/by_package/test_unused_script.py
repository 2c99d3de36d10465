"""What Python 3 cannot read stops nothing in a script that no build installs."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.unused_script import as_notes_of_unused_scripts
from roslens.source.rules.hit import Hit

EXPORT = "<export><build_type>{}</build_type></export>"


@pytest.mark.parametrize(
    ("line", "kind", "is_note"),
    [
        ("install(DIRECTORY launch DESTINATION share/p)", "ament_cmake", True),
        ("install(PROGRAMS scripts/other.py DESTINATION lib/p)", "ament_cmake", True),
        ("install(PROGRAMS scripts/old.py DESTINATION lib/p)", "ament_cmake", False),
        ("install(DIRECTORY scripts DESTINATION lib/p)", "ament_cmake", False),
        ("install(DIRECTORY ./ DESTINATION share/p)", "ament_cmake", False),
        ("ament_python_install_package(scripts)", "ament_cmake", False),
        ("ament_python_install_package(${PROJECT_NAME} PACKAGE_DIR scripts)", "ament_cmake", False),
        ("file(GLOB ALL scripts/*.py)\ninstall(PROGRAMS ${ALL} DESTINATION lib/p)", "ament_cmake", False),
        ("install(PROGRAMS ${FROM_ELSEWHERE} DESTINATION lib/p)", "ament_cmake", False),
        (
            "add_custom_target(made ALL COMMAND python3 ${CMAKE_CURRENT_SOURCE_DIR}/scripts/old.py)",
            "ament_cmake",
            False,
        ),
        ("ament_auto_package()", "ament_cmake", False),
        ("install(DIRECTORY launch DESTINATION share/p)", "catkin", False),
        ("", "ament_python", False),
    ],
)
def test_a_script_that_the_build_does_not_name_is_left_behind(line, kind, is_note, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(f"<package format='3'><name>p</name>{EXPORT.format(kind)}</package>")
    (tmp_path / "CMakeLists.txt").write_text(f"project(p)\nfind_package(rclcpp)\n{line}\n")
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts/old.py").write_text("print 1\n")
    placed = {"scripts/old.py": [Hit("python.python2_syntax", "m", 1), Hit("python.bare_except", "m", 2)]}
    ((first, second),) = as_notes_of_unused_scripts(placed, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert second.certainty is None
