"""An action that is not launched matters where nothing else starts its program."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.launched_elsewhere import as_notes_where_launched_elsewhere
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
MADE = "state = Node(\n    package='p', executable='{}')\n"
SPAWNED = "Node(package='c', executable='spawner', arguments=['joint_state_broadcaster'])"


@pytest.mark.parametrize(
    ("program", "other", "is_note"),
    [
        ("state_pub", "Node(package='p', executable='state_pub')", True),
        ("state_pub", "Node(package='p', executable='drive')", False),
        ("state_pub", "Node(package='p', executable='state_pub_2')", False),
        (
            "joint_state_publisher",
            SPAWNED,
            True,
        ),
        ("state_pub", SPAWNED, False),
    ],
)
def test_another_launch_file_starts_the_program(program, other, is_note, package_view, tmp_path):
    files = {"package.xml": MANIFEST, "launch/a.launch.py": MADE.format(program), "launch/b.launch.py": other}
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    hits = [Hit("launch.unlaunched_action", "m", 1, end_line=2), Hit("launch.other", "m", 1, end_line=2)]
    path = "launch/a.launch.py"
    ((first, second),) = as_notes_where_launched_elsewhere({path: hits}, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert ("launch/b.launch.py starts" in first.message) is is_note
    assert second == hits[1]
