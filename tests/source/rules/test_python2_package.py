"""That no file of a package can be read by Python 3 is how old it is; that one of many cannot is a mistake."""

import pytest

from roslens.model.finding import Severity
from roslens.source.rules.hit import Hit
from roslens.source.rules.python2_package import as_notes_where_all_is_python2

ROS1 = "<package><name>p</name><buildtool_depend>catkin</buildtool_depend></package>"
ROS2 = "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>"


@pytest.mark.parametrize(
    ("manifest", "files", "old", "is_note"),
    [
        (ROS1, 3, 2, True),
        (ROS1, 5, 2, False),
        (ROS1, 1, 1, False),
        (ROS2, 3, 3, False),
    ],
)
def test_a_package_of_python_2_alone_has_notes(manifest, files, old, is_note, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(manifest)
    for index in range(files):
        (tmp_path / f"{index}.py").write_text("pass\n")
    view = package_view(tmp_path)
    placed = {
        f"{index}.py": [Hit("python.python2_syntax", "m", 1), Hit("python.bare_except", "m", 2)] for index in range(old)
    }
    for first, second in as_notes_where_all_is_python2(placed, view).values():
        assert (first.severity is Severity.NOTE) is is_note
        assert second.severity is None
