"""What is known of launch files is what evaluating them again comes to, whatever was edited meanwhile."""

import tempfile
from contextlib import contextmanager
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.intake.time_budget import OverBudgetError
from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch import launch_budget
from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
from roslens.source.extract.workspace.known_launches import KnownLaunches
from roslens.store.cache import Cache

ROBOT = """<launch>
  <arg name="mode" default="slow"/>
  <include file="$(find-pkg-share robot)/launch/arm.launch.xml"/>
  <node pkg="robot" exec="base"><param from="$(find-pkg-share robot)/config/base.yaml"/></node>
  <include file="$(find-pkg-share eye)/launch/$(var mode).launch.xml"/>
</launch>
"""
FILES = {
    "robot/launch/robot.launch.xml": ROBOT,
    "robot/launch/arm.launch.xml": '<launch><node pkg="robot" exec="arm"/></launch>\n',
    "robot/config/base.yaml": "base:\n  ros__parameters:\n    speed: 1.0\n    gains: [1, 2]\n",
    "eye/launch/slow.launch.xml": '<launch><node pkg="eye" exec="look" name="slow"/></launch>\n',
    "eye/launch/fast.launch.xml": '<launch><node pkg="eye" exec="look" name="fast"/></launch>\n',
}
WRITTEN = {
    "included": ("robot/launch/arm.launch.xml", '<launch><node pkg="robot" exec="arm" name="left"/></launch>\n'),
    "parameters": ("robot/config/base.yaml", "base:\n  ros__parameters:\n    speed: 2.0\n"),
    "broken parameters": ("robot/config/base.yaml", "base:\n\tros__parameters: {\n"),
    "broken": ("robot/launch/robot.launch.xml", "<launch><node></launch>\n"),
    "other": ("robot/launch/robot.launch.xml", ROBOT.replace('"slow"', '"fast"')),
    "not read": ("robot/README.md", "words\n"),
}
PACKAGES = {"robot": "robot", "eye": "eye"}
EDITS = st.lists(
    st.one_of(
        st.sampled_from(sorted(WRITTEN)),
        st.sampled_from(sorted(FILES)).map(lambda path: f"remove {path}"),
        st.sampled_from(sorted(FILES)).map(lambda path: f"restore {path}"),
        st.just("no package eye"),
    ),
    min_size=1,
    max_size=6,
)


def write(root: Path, path: str, text: str) -> None:
    place = root / path
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(text)


def look(root: Path, cache: Cache, packages: dict[str, str], mode: str, evaluated: list[str] | None = None):
    """Return what the launch file comes to, and note that it had to be evaluated."""
    path = "robot/launch/robot.launch.xml"

    def evaluate(files, environment):
        if evaluated is not None:
            evaluated.append(mode)
        return evaluate_ros2(path, files, {"mode": mode}, environment)

    known = KnownLaunches(cache, FolderFiles(root, packages))
    found = known.launch((path, mode), {}, evaluate)
    known.keep()
    return found


@settings(max_examples=60, deadline=None)
@given(EDITS)
def test_what_is_known_after_edits_is_what_a_fresh_look_says(edits):
    with tempfile.TemporaryDirectory() as folder, Cache.open(Path(folder, "cache.sqlite")) as cache:
        root, packages = Path(folder, "ws"), dict(PACKAGES)
        for path, text in FILES.items():
            write(root, path, text)
        for what in ("", *edits):
            verb, _, path = what.partition(" ")
            if what in WRITTEN:
                write(root, *WRITTEN[what])
            elif verb == "remove":
                (root / path).unlink(missing_ok=True)
            elif verb == "restore":
                write(root, path, FILES[path])
            elif what:
                packages.pop("eye", None)
            for mode in ("slow", "fast"):
                with Cache.open(None) as nothing:
                    assert look(root, cache, packages, mode) == look(root, nothing, packages, mode), what


def test_only_what_was_read_makes_it_evaluated_again(tmp_path):
    for path, text in FILES.items():
        write(tmp_path, path, text)
    evaluated: list[str] = []
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        first = look(tmp_path, cache, PACKAGES, "slow", evaluated)
        assert [setting.value.known for setting in first.nodes[1].settings] == ["1.0", "[1, 2]"]
        write(tmp_path, *WRITTEN["not read"])
        write(tmp_path, "eye/launch/fast.launch.xml", "<launch/>\n")
        assert look(tmp_path, cache, PACKAGES, "slow", evaluated) == first
        assert evaluated == ["slow"]
        write(tmp_path, *WRITTEN["parameters"])
        assert look(tmp_path, cache, PACKAGES, "slow", evaluated) != first
        assert evaluated == ["slow", "slow"]


def test_the_environment_counts_where_it_is_asked_for(tmp_path):
    path, evaluated = "robot/launch/robot.launch.xml", []

    def look(cache, environment):
        def evaluate(files, variables):
            evaluated.append(environment)
            return evaluate_ros2(path, files, {}, variables)

        known = KnownLaunches(cache, FolderFiles(tmp_path, PACKAGES))
        found = known.launch((path,), environment, evaluate)
        known.keep()
        return found.nodes[0].name.known

    here, there = {"ROBOT": "here"}, {"ROBOT": "there"}
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        write(tmp_path, path, '<launch><node pkg="robot" exec="arm" name="arm"/></launch>\n')
        assert [look(cache, one) for one in (here, there, {})] == ["arm"] * 3
        assert evaluated == [here]
        write(tmp_path, path, '<launch><node pkg="robot" exec="arm" name="$(env ROBOT)"/></launch>\n')
        assert [look(cache, one) for one in (here, there, {}) * 2] == ["here", "there", None] * 2
        assert evaluated == [here, here, there, {}]
        write(tmp_path, path, '<launch><node pkg="robot" exec="arm" name="arm"/></launch>\n')
        assert [look(cache, one) for one in (here, there, {})] == ["arm"] * 3
        assert evaluated == [here, here, there, {}]


def test_a_damaged_launch_is_evaluated_again(tmp_path):
    for path, text in FILES.items():
        write(tmp_path, path, text)
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        first = look(tmp_path, cache, PACKAGES, "slow")
        for damage in (b"\x93", b"\x94\x90\x81\xaageneration\xa4ros2\x90\x91\x91\x05"):
            keys = [key for (key,) in cache._connection.execute("SELECT key FROM facts")]
            cache.replace(dict.fromkeys(keys, damage))
            assert look(tmp_path, cache, PACKAGES, "slow") == first


def test_what_a_budget_ended_is_evaluated_again(tmp_path, monkeypatch):
    @contextmanager
    def spent(path, *, size):
        yield
        raise OverBudgetError("takes more than 10 s", path)

    for path, text in FILES.items():
        write(tmp_path, path, text)
    evaluated: list[str] = []
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        with monkeypatch.context() as patched:
            patched.setattr(launch_budget, "file_budget", spent)
            assert look(tmp_path, cache, PACKAGES, "slow", evaluated).cut
            assert evaluate_ros1("robot/launch/robot.launch.xml", FolderFiles(tmp_path, PACKAGES)).cut
        assert not look(tmp_path, cache, PACKAGES, "slow", evaluated).cut
        assert not look(tmp_path, cache, PACKAGES, "slow", evaluated).cut
    assert evaluated == ["slow", "slow"]
