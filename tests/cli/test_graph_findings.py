from pathlib import Path

import pytest

from roslens.cli.graph.graph_findings import findings_of
from roslens.cli.graph.graph_source import GraphSource
from roslens.source.settings import SourceSettings


def found(root: Path, launch: str = "talk/robot.launch.xml"):
    with GraphSource(str(root), SourceSettings(), "roslens.toml", {}) as source:
        return findings_of(source, source.launched(launch, {}), launch)


def test_what_does_not_fit_stands_at_its_line(talking):
    (one,) = found(talking)
    assert (one.rule, one.path, one.line, one.gated) == ("graph.qos", "talk/talk/nodes.py", 16, True)


@pytest.mark.parametrize(
    ("comment", "left"), [("roslens: ignore[graph.qos]", 0), ("noqa", 0), ("roslens: ignore[graph.type]", 1)]
)
def test_comments_leave_findings_out(talking, comment, left):
    path = talking / "talk/talk/nodes.py"
    path.write_text(path.read_text().replace("print, 10)", f"print, 10)  # {comment}"))
    assert len(found(talking)) == left


def test_findings_in_tests_count_for_no_gate(talking):
    launch = talking / "talk/test/only.launch.xml"
    launch.write_text('<launch><node pkg="talk" exec="talkr"/></launch>')
    (one,) = found(talking, "talk/test/only.launch.xml")
    assert (one.rule, one.gated) == ("graph.executable", False)
