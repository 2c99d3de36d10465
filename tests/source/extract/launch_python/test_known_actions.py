"""What is known of the actions of launch files is what reading them again comes to, whatever was edited meanwhile."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.launch import launch_markup, launch_parameter_files
from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
from roslens.source.extract.launch_python import launch_sources
from roslens.source.extract.launch_python.known_actions import KnownActions
from roslens.source.extract.launch_python.launch_action import Action

ROBOT = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from nav2_common.launch import RewrittenYaml
from robot.names import NAME

LEFT = ['arm']

def later(context):
    LEFT.append('more')
    return [Node(package='robot', executable=name) for name in LEFT]

def generate_launch_description():
    mode = LaunchConfiguration('mode')
    changed = RewrittenYaml(source_file='robot/base.yaml', param_rewrites={'speed': mode})
    return LaunchDescription([
        DeclareLaunchArgument('mode', default_value='1'),
        Node(package='robot', executable=NAME, parameters=[changed]),
        Node(package='robot', executable='second', parameters=[changed, 'robot/base.yaml']),
        IncludeLaunchDescription('robot/arm.launch.xml'),
        OPAQUE
    ])
"""
FILES = {
    "robot/robot.launch.py": ROBOT.replace("OPAQUE", ""),
    "robot/robot/names.py": "NAME = 'base'\n",
    "robot/arm.launch.xml": '<launch><node pkg="robot" exec="arm" name="$(var mode)"/></launch>\n',
    "robot/base.yaml": "base:\n  ros__parameters:\n    speed: 2\n    gains: [1, 2]\n",
}
EDITS = {
    "opaque": ("robot/robot.launch.py", ROBOT.replace("OPAQUE", "OpaqueFunction(function=later),")),
    "broken": ("robot/robot.launch.py", "def generate_launch_description(:\n"),
    "helper": ("robot/robot/names.py", "NAME = 'other'\n"),
    "no helper": ("robot/robot/names.py", None),
    "included": ("robot/arm.launch.xml", '<launch><node pkg="robot" exec="hand"/></launch>\n'),
    "parameters": ("robot/base.yaml", "base:\n  ros__parameters:\n    speed: 3\n/**:\n  ros__parameters: {a: b}\n"),
    "broken parameters": ("robot/base.yaml", "base:\n\tros__parameters: {\n"),
    "no parameters": ("robot/base.yaml", None),
    "restore": ("", None),
}


class Written:
    def __init__(self, files):
        self.files = files

    def package(self, name):
        return "robot" if name == "robot" else None

    def content(self, path):
        text = self.files.get(path)
        return None if text is None else text.encode()

    def listing(self, folder):
        return tuple(sorted(path for path in self.files if path.startswith(f"{folder}/")))


def forget() -> None:
    launch_markup._KNOWN = KnownActions()
    launch_sources._lowered.cache_clear()
    launch_parameter_files._parsed.cache_clear()


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(sorted(EDITS)), st.sampled_from(["1", "fast"])), min_size=1, max_size=5))
def test_what_is_known_is_what_reading_again_finds(steps):
    forget()
    files, known, fresh = dict(FILES), [], []
    ways = []
    for name, mode in steps:
        path, text = EDITS[name]
        if not path:
            files = dict(FILES)
        elif text is None:
            files.pop(path, None)
        else:
            files[path] = text
        ways += [(dict(files), {"mode": mode}, False), (dict(files), {}, True)]
    for now, given_, every in ways:
        known.append(evaluate_ros2("robot/robot.launch.py", Written(now), given_, any_arguments=every))
    for now, given_, every in ways:
        forget()
        fresh.append(evaluate_ros2("robot/robot.launch.py", Written(now), given_, any_arguments=every))
    assert known == fresh


@pytest.fixture
def read_times():
    return []


def one(read_times, kind="node", **values):
    def read(files):
        read_times.append(kind)
        if files is not None:
            files.content("other")
        return (Action("group", None, children=(Action(kind, None, **values),)),)

    return read


def test_the_same_content_is_read_once(read_times):
    known = KnownActions()
    files = Written({"other": "x"})
    first = known.of("a", b"text", files, one(read_times))
    assert known.of("a", b"text", files, one(read_times)) is first
    assert len(read_times) == 1


@pytest.mark.parametrize(
    ("path", "content", "files"), [("b", b"text", {"other": "x"}), ("a", b"more", {"other": "x"}), ("a", b"text", {})]
)
def test_another_file_or_another_answer_is_read_anew(read_times, path, content, files):
    known = KnownActions()
    known.of("a", b"text", Written({"other": "x"}), one(read_times))
    known.of(path, content, Written(files), one(read_times))
    assert len(read_times) == 2


@pytest.mark.parametrize(("kind", "values"), [("call", {"make": lambda scope: ()}), ("unknown", {})])
def test_what_is_made_later_or_unknown_is_read_anew(read_times, kind, values):
    known = KnownActions()
    for _ in range(2):
        known.of("a", b"text", Written({}), one(read_times, kind, **values))
    assert len(read_times) == 2


def test_what_was_not_asked_for_lately_is_forgotten(read_times):
    known = KnownActions(most_bytes=10)
    for content in (b"four", b"five", b"four", b"three", b"four", b"five"):
        known.of("a", content, Written({}), one(read_times))
    assert len(read_times) == 4
