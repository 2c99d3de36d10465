"""A plug-in of a name that is gone, where somebody reads it, and where nobody does."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.distribution.plugin_gone import found

MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_cmake</build_type></export></package>"


@pytest.mark.parametrize(
    ("node", "certainty"),
    [
        ("behavior_server", None),
        ("recoveries_server", Certainty.HEURISTIC),
        ('"/robot/recoveries_server"', Certainty.HEURISTIC),
    ],
)
def test_below_a_node_that_is_called_otherwise_it_is_a_note(node, certainty, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    text = f"other:\n  a: 1\n{node}:\n  ros__parameters:\n    spin:\n      plugin: nav2_behaviors/Spin\n"
    (tmp_path / "nav.yaml").write_text(text)
    (hit,) = found(package_view(tmp_path))
    assert hit.certainty is certainty
    assert ("nothing reads it" in hit.message) is (certainty is not None)
