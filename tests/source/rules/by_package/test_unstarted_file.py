"""What is wrong in a file that nothing starts, imports or loads is a note."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.unstarted_file import as_notes_where_nothing_starts
from roslens.source.rules.hit import Hit

ROS1 = "<package format='2'><name>p</name><buildtool_depend>catkin</buildtool_depend></package>"
ROS2 = "<package format='3'><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
MAIN = "if __name__ == '__main__':\n    serve()\n"


def weighed(files, path, rule, package_view, folder, mode=0o644):
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    (folder / path).chmod(mode)
    hits = [Hit(rule, "m", 1), Hit("python.syntax", "m", 1)]
    ((first, second),) = as_notes_where_nothing_starts({path: hits}, package_view(folder)).values()
    assert second == hits[1]
    return first


@pytest.mark.parametrize(
    ("manifest", "script", "mode", "more", "is_note"),
    [
        (ROS1, MAIN, 0o644, {}, True),
        (ROS1, f"#!/usr/bin/env python3\n{MAIN}", 0o644, {}, True),
        (ROS1, f"#!/usr/bin/env python3\n{MAIN}", 0o755, {}, False),
        (ROS2, MAIN, 0o644, {}, False),
        (ROS2, "class Server:\n    pass\n", 0o644, {}, True),
        (ROS1, MAIN, 0o644, {"launch/a.launch": "<launch><node pkg='p' type='serve.py' name='s'/></launch>"}, False),
        (ROS1, MAIN, 0o644, {"scripts/other.py": "from serve import serve\n"}, False),
        (ROS1, MAIN, 0o644, {"scripts/other.py": "observe = 1\n"}, True),
        (ROS1, MAIN, 0o644, {"README.md": "Run `python scripts/serve.py`.\n"}, False),
    ],
)
def test_a_script(manifest, script, mode, more, is_note, package_view, tmp_path):
    files = {"package.xml": manifest, "scripts/serve.py": script, **more}
    hit = weighed(files, "scripts/serve.py", "python.undefined_name", package_view, tmp_path, mode)
    assert (hit.certainty is Certainty.HEURISTIC) is is_note
    assert hit.message.endswith("no other file names this one") is is_note


@pytest.mark.parametrize(
    ("launch", "is_note"),
    [
        ("<launch/>", True),
        ("<launch><param name='d' textfile='$(find p)/urdf/two.urdf'/></launch>", False),
        ("<launch><param name='d' textfile='$(find p)/urdf/$(arg model).urdf'/></launch>", False),
    ],
)
def test_a_robot(launch, is_note, package_view, tmp_path):
    files = {"package.xml": ROS1, "urdf/two.urdf": "<robot name='two'/>", "launch/a.launch": launch}
    hit = weighed(files, "urdf/two.urdf", "package.robot_tree", package_view, tmp_path)
    assert (hit.certainty is Certainty.HEURISTIC) is is_note


def test_what_another_package_may_load_is_left(package_view, tmp_path):
    files = {
        "p/package.xml": ROS1,
        "p/urdf/two.urdf": "<robot name='two'/>",
        "q/package.xml": ROS1.replace("<name>p</name>", "<name>q</name><depend>p</depend>"),
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    hits = {"p/urdf/two.urdf": [Hit("package.robot_tree", "m", 1)]}
    assert as_notes_where_nothing_starts(hits, package_view(tmp_path, "p")) == hits
