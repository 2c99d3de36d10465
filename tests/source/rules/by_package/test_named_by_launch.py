"""A name that roslaunch replaces is refused by nobody."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.named_by_launch import as_notes_where_launch_names
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='3'><name>p</name><export><build_type>{}</build_type></export></package>"
STARTS = '<launch><node pkg="{}" type="a" name="b"/></launch>'


@pytest.mark.parametrize(
    ("kind", "launch", "is_note"),
    [
        ("catkin", STARTS.format("p"), True),
        ("catkin", STARTS.format("q"), False),
        ("catkin", "<launch/>", False),
        ("ament_cmake", STARTS.format("p"), False),
    ],
)
def test_a_launch_file_names_the_node(kind, launch, is_note, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST.format(kind))
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch/a.launch").write_text(launch)
    placed = {"src/a.cpp": [Hit("node.node_name", "m", 1), Hit("cpp.other", "m", 2)]}
    ((first, second),) = as_notes_where_launch_names(placed, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert second.certainty is None
