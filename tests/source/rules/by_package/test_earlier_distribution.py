"""What a later distribution removed is a note where a package is for an earlier one."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.earlier_distribution import as_notes_for_earlier_distribution
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>"
RULE = "launch.unknown_keyword"


@pytest.mark.parametrize(
    ("path", "texts", "certainty", "is_note"),
    [
        ("launch/dashing_start.py", {}, Certainty.LIKELY, True),
        ("launch/start.launch.py", {"Dockerfile": "FROM ros:foxy\n"}, Certainty.LIKELY, True),
        ("launch/start.launch.py", {"README.md": "For Eloquent and Foxy.\n"}, Certainty.LIKELY, True),
        ("launch/start.launch.py", {"README.md": "For Foxy and Humble.\n"}, Certainty.LIKELY, False),
        (
            "launch/start.launch.py",
            {"README.md": "For Foxy.\n", "Dockerfile": "FROM ros:humble\n"},
            Certainty.LIKELY,
            False,
        ),
        ("launch/start.launch.py", {"README.md": "A robot.\n"}, Certainty.LIKELY, False),
        ("launch/foxyglove.launch.py", {}, Certainty.LIKELY, False),
        ("launch/dashing_start.py", {}, None, False),
    ],
)
def test_its_files_say_so(path, texts, certainty, is_note, package_view, tmp_path):
    files = {"src/p/package.xml": MANIFEST, f"src/p/{path}": "import launch\n", **texts}
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    placed = {f"src/p/{path}": [Hit(RULE, "m", 1, certainty=certainty)]}
    (only,) = as_notes_for_earlier_distribution(placed, package_view(tmp_path, "p"))[f"src/p/{path}"]
    assert only.certainty is (Certainty.HEURISTIC if is_note else certainty)
