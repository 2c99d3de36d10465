"""``roslens port``, as a user meets it."""

import json
import shutil
from pathlib import Path

import pytest

from roslens.cli.main import main

EXAMPLE = Path(__file__).parents[2] / "examples/port"


@pytest.fixture
def rover(tmp_path, monkeypatch):
    """Return a copy of the example workspace, which is for Humble, as the current folder."""
    shutil.copytree(EXAMPLE, tmp_path / "ws", ignore=shutil.ignore_patterns(".roslens"))
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path / "ws"


def document(capsys, *arguments):
    code = main(["port", *arguments, "--format", "json", "-q"])
    return code, json.loads(capsys.readouterr().out)


def places(findings):
    return {(one["rule"].partition(".")[2], one["path"].rpartition("/")[2], one["line"]) for one in findings}


def test_what_a_later_distribution_has_not_is_told_by_consequence(rover, capsys):
    code, found = document(capsys, "humble", "lyrical")
    assert code == 1
    assert (found["schema"], found["from"], found["to"]) == ("roslens-port/1", "humble", "lyrical")
    assert places(found["breaks"]) == {
        ("header", "dock_finder.cpp", 1),
        ("header", "dock_finder.cpp", 2),
        ("cmake_command", "CMakeLists.txt", 13),
        ("package_gone", "package.xml", 12),
        ("plugin_gone", "nav.yaml", 5),
        ("plugin_gone", "nav.yaml", 11),
        ("plugin_gone", "nav.yaml", 13),
        ("parameter_gone", "controllers.yaml", 13),
    }
    order = ["stops the build", "stops the start", "wrong at run time"]
    assert [one["consequence"] for one in found["breaks"]] == sorted(
        (one["consequence"] for one in found["breaks"]), key=order.index
    )
    assert not found["already"]


def test_only_what_the_second_distribution_changes_is_told(rover, capsys):
    code, found = document(capsys, "jazzy", "kilted")
    assert not found["breaks"]
    assert len(found["already"]) == 7
    assert places(found["deprecated"]) == {("cmake_command", "CMakeLists.txt", 13)}
    assert code == 1


def test_nothing_changes_where_nothing_is_used(rover, capsys):
    shutil.rmtree(rover / "rover_drive")
    (rover / "rover_eye/src/dock_finder.cpp").write_text("int main() { return 0; }\n")
    assert main(["port", "humble", "jazzy", "-q"]) == 0
    assert capsys.readouterr().out == "from Humble to Jazzy: nothing that is used is known to change\n"


def test_the_mechanical_part_is_shown_then_made_then_taken_back(rover, capsys):
    before = {path: path.read_bytes() for path in rover.rglob("*.*") if path.is_file() and ".roslens" not in path.parts}
    assert main(["port", "humble", "lyrical", "--diff", "-q"]) == 1
    shown = capsys.readouterr().out
    assert "+#include <cv_bridge/cv_bridge.hpp>" in shown
    assert "+target_link_libraries(dock_finder\n" in shown
    assert "+  ${sensor_msgs_TARGETS}\n" in shown
    assert all(path.read_bytes() == content for path, content in before.items())
    assert main(["port", "humble", "lyrical", "--fix", "-q"]) == 1
    left = capsys.readouterr().out
    assert "2 places to change" in left
    assert "nav2_behaviors::Spin" in (rover / "rover_drive/config/nav.yaml").read_text()
    assert main(["port", "humble", "lyrical", "--undo-fix", "-q"]) == 0
    assert all(path.read_bytes() == content for path, content in before.items())


def test_markdown_is_a_list_to_work_through(rover, capsys):
    assert main(["port", "humble", "jazzy", "--format", "markdown", "-q"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "### from Humble to Jazzy: 7 places to change, 0 deprecated"
    assert "#### stops the build in Jazzy (3)" in lines
    assert any(line.startswith("- [ ] `rover_drive/config/nav.yaml:5`: plug-in ") for line in lines)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["humble", "lyrica"], "'lyrica'"),
        (["jazzy", "humble"], "from jazzy to humble"),
        (["noetic", "jazzy"], "from noetic to jazzy"),
        (["humble", "humble"], "from humble to humble"),
        (["humble", "jazzy", "--fix", "--diff"], "--fix with --diff"),
        (["humble", "jazzy", "--diff", "--format", "json"], "--diff with --format or -o"),
    ],
)
def test_what_contradicts_itself_is_refused(rover, capsys, arguments, said):
    assert main(["port", *arguments]) == 2
    assert said in capsys.readouterr().err


def test_a_launch_file_that_cannot_be_read_does_not_pass_as_clean(rover, capsys):
    launch = next(rover.rglob("launch")) / "broken.launch.xml"
    launch.write_text("<launch>\n  <node\n</launch>\n")
    assert main(["port", "humble", "lyrical"]) == 3
    assert "broken.launch.xml:3: not well-formed" in capsys.readouterr().err
