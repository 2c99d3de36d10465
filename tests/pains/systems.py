"""Systems in which no data arrives: what source, a running system and recordings say of them."""

from __future__ import annotations

import contextlib
import io
import shutil
from collections.abc import Sequence
from pathlib import Path

from cli.commands import test_why as recorded
from cli.commands import test_why_transform as transforms

from roslens.cli.main import main, parser
from roslens.cli.why.declared_evidence import declared_evidence
from roslens.compare.why.answered import answer
from roslens.compare.why.declared import Declared
from roslens.compare.why.observed import Ended, Observed
from roslens.compare.why.question import Question
from roslens.model.answers.ros_process import RosProcess
from roslens.model.graph import Endpoint, Graph, Instance, Node, Role
from roslens.model.qos import Qos
from roslens.report.why.answer_text import to_answer_text

ROOT = Path(__file__).parents[2]
WIDTH = 110
SCAN, ODOM, TWIST = "sensor_msgs/msg/LaserScan", "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/TwistStamped"
RELIABLE, BEST_EFFORT = Qos("reliable", "volatile"), Qos("best_effort", "volatile")
LIDAR = Endpoint("/lidar", Role.PUBLISHER, "/scan", SCAN, qos=BEST_EFFORT)
PLANNER = Endpoint("/planner", Role.SUBSCRIPTION, "/scan", SCAN, qos=BEST_EFFORT)


def head(text: str) -> str:
    """Return the first cause of an answer with what to do about it."""
    return text.partition("\n\n")[2].partition("\n\n")[0].rstrip()


def demo_robot(folder: Path) -> Declared:
    """Return what the source of the demo robot says."""
    workspace = folder / "broken"
    if not workspace.exists():
        shutil.copytree(ROOT / "examples/broken", workspace, ignore=shutil.ignore_patterns(".roslens"))
    options = parser().parse_args(["why", "/scan", str(workspace), "--no-cache", "-q"])
    found = declared_evidence(options, lambda _: True)
    assert found is not None
    return found


def live(
    folder: Path, asked: str, ends: Sequence[Endpoint], *, nodes: Sequence[Node] = (), source: bool = True,
    **more: object,
) -> str:  # fmt: skip
    """Return what is said of an entity of a system that runs, beside the source of the demo robot."""
    kind, _, name = asked.rpartition(":")
    named = {one.name for one in nodes}
    there = (*nodes, *(Node(one, "robot", 100 + number) for number, one in
                       enumerate(sorted({end.node for end in ends} - named))))  # fmt: skip
    graph = Graph("ros2", tuple(sorted(there)), tuple(sorted(ends, key=lambda end: (end.name, end.role, end.node))))
    seen = Observed("what runs here, domain 0", graph, seconds=2.0, **more)  # type: ignore[arg-type]
    declared = demo_robot(folder) if source else None
    return head(to_answer_text(answer(Question(kind or "topic", name), declared, None, seen), WIDTH))


def from_source(folder: Path, workspace: str, asked: str, *words: str, change: bool = False) -> str:
    """Return what is said of an entity of an example workspace, which is copied."""
    copy = folder / f"{workspace}{'_changed' if change else ''}"
    if not copy.exists():
        shutil.copytree(ROOT / "examples" / workspace, copy, ignore=shutil.ignore_patterns(".roslens"))
        if change:
            shutil.copytree(ROOT / "examples/change", copy, dirs_exist_ok=True)
    return _said(folder, [asked, str(copy), "--no-cache", *words])


def of_recording(folder: Path, asked: str, streams: dict[str, list[float]], errors: Sequence[object] = ()) -> str:
    """Return what is said of a topic of a recording of the example workspace that ends after a minute."""
    bag = recorded.recording(folder / "drive", streams, errors)
    return from_source(folder, "workspace", asked, "--launch", "rover", "--bag", str(bag))


def of_transforms(folder: Path, asked: str, streams: Sequence[object], static: Sequence[object] = ()) -> str:
    """Return what is said of a transform of a recording that ends after 20 s."""
    bag = transforms.recording(folder / "drive", streams, static)
    return _said(folder, [asked, "--bag", str(bag)])


def _said(folder: Path, words: list[str]) -> str:
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
        code = main(["why", *words, "-q"])
    assert code == 1, out.getvalue()
    # Folders are those of a user.
    return head(out.getvalue()).replace(f"{folder}/", "")


__all__ = ["Ended", "Instance", "RosProcess"]
