"""What is extracted of a workspace does not depend on how it was come by, and one bad file costs only itself."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
from as_anybody import as_anybody
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from roslens.model.errors import UsageError
from roslens.model.graph import Role
from roslens.source.extract.workspace import workspace_programs
from roslens.source.extract.workspace.extraction import Extraction, extract
from roslens.source.keys import analyser_version
from roslens.source.settings import MacroSettings, SourceSettings, WorkspaceSettings
from roslens.store.cache import Cache

LATER_S = 4e9
"""Long after the files of tests were written, so that their time stamps are trusted."""
FILES = {
    "arm/package.xml": '<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>'
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license><depend>rclcpp</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>",
    "arm/CMakeLists.txt": "project(arm)\nadd_executable(arm_node src/arm.cpp)\n"
    "install(TARGETS arm_node DESTINATION lib/${PROJECT_NAME})\n",
    "arm/src/arm.cpp": '#include "rclcpp/rclcpp.hpp"\n#include "arm/name.hpp"\n'
    "class Arm : public rclcpp::Node {\npublic:\n"
    ' Arm() : rclcpp::Node("arm") { p = create_publisher<std_msgs::msg::String>(arm::TOPIC, 10); }\n'
    "rclcpp::Publisher<std_msgs::msg::String>::SharedPtr p;\n};\n"
    "int main() { rclcpp::spin(std::make_shared<Arm>()); }\n",
    "arm/include/arm/name.hpp": 'namespace arm { const std::string TOPIC = "joints"; }\n',
    "arm/msg/Joint.msg": "float64 angle\n",
    "arm/msg/Joints.msg": "Joint[] joints\n",
    "arm/launch/arm.launch.py": "def generate_launch_description():\n    return LaunchDescription([])\n",
    "arm/test/test_arm.cpp": '#include "rclcpp/rclcpp.hpp"\n'
    'int main() { auto n = rclcpp::Node::make_shared("tester"); }\n',
    "eye/package.xml": '<package format="2"><name>eye</name><version>1.0.0</version><description>d</description>'
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license><depend>rospy</depend></package>",
    "eye/setup.py": "from setuptools import setup\nsetup(name='eye', packages=['eye'],"
    " entry_points={'console_scripts': ['look = eye.look:begin']})\n",
    "eye/eye/__init__.py": "",
    "eye/eye/look.py": "import rospy\nfrom std_msgs.msg import String\ndef begin():\n    rospy.init_node('eye')\n"
    "    rospy.Subscriber('joints', String, print)\n",
    "eye/scripts/blink.py": "#!/usr/bin/env python\nimport rospy\nfrom std_msgs.msg import String\n"
    "rospy.init_node('blink')\nrospy.Publisher('lid', String, queue_size=1)\n",
    "eye/srv/Blink.srv": "---\nbool open\n",
}


def write(root: Path, files: dict[str, str]) -> Path:
    for path, content in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(content)
    return root


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    return write(tmp_path / "ws", FILES)


def extracted(root: Path, cache: Path | None = None, jobs: int = 1, chosen: SourceSettings | None = None) -> Extraction:
    with Cache.open(cache) as opened:
        return extract([root], chosen or SourceSettings(), cache=opened, now_s=LATER_S, jobs=jobs)


def names(found: Extraction) -> set[tuple[str, str, str]]:
    return {(str(node.name), one.role.value, str(one.name)) for node in found.nodes for one in node.endpoints}


@pytest.fixture
def lowered(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Paths of the files that are parsed."""
    seen: list[str] = []
    lower = workspace_programs.lower_files

    def counting(task: workspace_programs.LowerTask) -> workspace_programs.LoweredFiles:
        seen.extend(file.path for file in task.files)
        return lower(task)

    monkeypatch.setattr(workspace_programs, "lower_files", counting)
    return seen


def test_all_parts_of_a_workspace(robot: Path):
    found = extracted(robot)
    assert names(found) == {
        ("arm", Role.PUBLISHER.value, "joints"),
        ("eye", Role.SUBSCRIPTION.value, "joints"),
        ("blink", Role.PUBLISHER.value, "lid"),
    }
    assert [package.name for package in found.packages] == ["arm", "eye"]
    assert {target.name for target in found.targets} >= {"arm_node", "look"}
    assert list(found.builds) == ["arm", "eye"]
    assert [(one.interface.full_name, one.interface.generation, bool(one.checksum)) for one in found.interfaces] == [
        ("eye/srv/Blink", 1, True),
        ("arm/msg/Joint", 2, True),
        ("arm/msg/Joints", 2, True),
    ]
    assert [(one.path, one.package, one.generation) for one in found.launch_files] == [
        ("arm/launch/arm.launch.py", "arm", 2)
    ]
    assert found.failures == ()
    assert found.root == str(robot)


def test_an_interface_of_a_package_that_is_not_there_has_no_checksum(robot: Path):
    write(robot, {"arm/msg/Pose.msg": "geometry_msgs/Pose pose\n"})
    pose = next(one for one in extracted(robot).interfaces if one.interface.name == "Pose")
    assert not pose.checksum
    assert "geometry_msgs/msg/Pose" in pose.checksum.unknown


@pytest.mark.heavy
def test_processes_and_cache_do_not_change_a_byte(robot: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(workspace_programs, "_BATCH_BYTES", 100)
    cache = tmp_path / "cache.sqlite"
    results = [
        extracted(robot),
        extracted(robot, jobs=2),
        extracted(robot, cache, jobs=2),
        extracted(robot, cache, jobs=2),
        extracted(robot, cache),
    ]
    assert len({msgspec.msgpack.encode(one) for one in results}) == 1


def test_nothing_is_parsed_twice(robot: Path, tmp_path: Path, lowered: list[str]):
    cache = tmp_path / "cache.sqlite"
    first = extracted(robot, cache)
    assert sorted(lowered) == sorted(
        path for path in FILES if path.endswith((".cpp", ".hpp", ".py")) and "test" not in path and "launch" not in path
    )
    lowered.clear()
    assert extracted(robot, cache) == first
    assert lowered == []


@pytest.mark.parametrize("programs", [False, True])
def test_after_a_run_that_kept_programs_nothing_is_parsed(
    robot: Path, tmp_path: Path, lowered: list[str], programs: bool
):
    from roslens.source.pipeline import Clock, analyse
    from roslens.store.runs import Store

    cache = tmp_path / "cache.sqlite"
    with Cache.open(cache) as opened, Store.open(tmp_path / "store.sqlite") as store:
        analyse(
            [robot],
            SourceSettings(),
            store=store,
            cache=opened,
            clock=Clock("", LATER_S),
            base=robot,
            jobs=1,
            programs=programs,
        )
    found = extracted(robot, cache)
    assert bool(lowered) is not programs
    assert found == extracted(robot)


def test_a_changed_file_changes_what_it_must(robot: Path, tmp_path: Path, lowered: list[str]):
    cache = tmp_path / "cache.sqlite"
    before = extracted(robot, cache)
    lowered.clear()
    write(robot, {"arm/include/arm/name.hpp": 'namespace arm { const std::string TOPIC = "angles"; }\n'})
    after = extracted(robot, cache)
    assert lowered == ["arm/include/arm/name.hpp"]
    assert names(after) - names(before) == {("arm", Role.PUBLISHER.value, "angles")}
    assert [one for one in after.nodes if one.path.startswith("eye/")] == [
        one for one in before.nodes if one.path.startswith("eye/")
    ]
    assert (after.builds, after.interfaces) == (before.builds, before.interfaces)
    assert after == extracted(robot)


@pytest.mark.parametrize(
    ("path", "content"),
    [
        ("arm/CMakeLists.txt", "project(arm)\nadd_executable(other src/arm.cpp)\n"),
        ("arm/src/more.cpp", "int more() { return 1; }\n"),
        ("arm/package.xml", FILES["arm/package.xml"].replace("ament_cmake", "catkin")),
        ("eye/setup.py", FILES["eye/setup.py"].replace("look = eye", "see = eye")),
        ("eye/setup.cfg", "[options.entry_points]\nconsole_scripts =\n    stare = eye.look:begin\n"),
        ("arm/msg/Joint.msg", "float32 angle\n"),
        ("arm/test/test_arm.cpp", "int main() {}\n"),
        ("eye/launch/eye.launch", "<launch/>"),
        ("eye/eye/look.py", FILES["eye/eye/look.py"].replace("begin", "start")),
    ],
)
def test_any_change_gives_what_a_new_look_gives(robot: Path, tmp_path: Path, path: str, content: str):
    cache = tmp_path / "cache.sqlite"
    extracted(robot, cache)
    write(robot, {path: content})
    assert extracted(robot, cache) == extracted(robot)


def test_what_is_gone_is_gone(robot: Path, tmp_path: Path):
    cache = tmp_path / "cache.sqlite"
    extracted(robot, cache)
    (robot / "eye/scripts/blink.py").unlink()
    assert ("blink", Role.PUBLISHER.value, "lid") not in names(extracted(robot, cache))


def test_macros_are_part_of_the_question(robot: Path, tmp_path: Path):
    write(robot, {"arm/src/arm.cpp": FILES["arm/src/arm.cpp"].replace("class Arm", "class HOT(1) Arm")})
    cache = tmp_path / "cache.sqlite"
    chosen = SourceSettings(macros=MacroSettings(blank=("HOT",)))
    extracted(robot, cache)
    assert extracted(robot, cache, chosen=chosen) == extracted(robot, chosen=chosen)
    ignoring = SourceSettings(workspace=WorkspaceSettings(ignore=("eye/scripts/**",)))
    assert extracted(robot, cache, chosen=ignoring) == extracted(robot, chosen=ignoring)


BROKEN = {
    "arm/src/broken.cpp": "template<<<>>> }}}} class : { #if\n" * 3,
    "eye/eye/broken.py": "def (:\n\tclass ][\n" * 3,
    "arm/msg/Broken.msg": "no such thing at all\n",
    "arm/CMakeLists.txt": "add_executable(arm_node src/arm.cpp\nif(\n",
    "eye/setup.py": "setup(((((",
    "eye/package.xml": "<package><name>",
}


@pytest.mark.parametrize("path", BROKEN)
def test_a_broken_file_does_not_lose_the_others(robot: Path, path: str):
    write(robot, {path: BROKEN[path]})
    found = extracted(robot)
    assert ("arm", Role.PUBLISHER.value, "joints") in names(found)
    assert ("blink", Role.PUBLISHER.value, "lid") in names(found)
    told = [one.evidence.path for one in found.unresolved]
    told += [one.location.path for one in found.failures if one.location is not None]
    assert path in told


def test_random_bytes_in_every_place(robot: Path):
    noise = random.Random(4)
    for name in ("arm/src/a.cpp", "eye/eye/a.py", "arm/msg/A.msg", "arm/a.cmake", "eye/launch/a.launch"):
        (robot / name).parent.mkdir(exist_ok=True)
        (robot / name).write_bytes(noise.randbytes(2_000))
    assert ("arm", Role.PUBLISHER.value, "joints") in names(extracted(robot))


def test_a_fault_of_lowering_costs_one_file_and_is_told(robot: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    parse = workspace_programs.parse_file

    def breaking(content: bytes, *rest: object) -> object:
        if b"blink" in content:
            raise RuntimeError("no way")
        return parse(content, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(workspace_programs, "parse_file", breaking)
    found = extracted(robot, tmp_path / "cache.sqlite")
    assert [str(one).split(";")[0] for one in found.failures] == ["eye/scripts/blink.py: RuntimeError: no way"]
    assert found.failures[0].package == "eye"
    assert names(found) == names(extracted(robot)) != set()
    assert extracted(robot, tmp_path / "cache.sqlite") == found


def test_a_file_that_cannot_be_read_is_read_the_next_time(robot: Path, tmp_path: Path):
    cache = tmp_path / "cache.sqlite"
    (robot / "arm/src/arm.cpp").chmod(0)
    with as_anybody():
        assert any(one.tool == "read" for one in extracted(robot, cache).failures)
    (robot / "arm/src/arm.cpp").chmod(0o644)
    assert extracted(robot, cache) == extracted(robot)


def test_a_file_that_changes_meanwhile_is_not_kept_as_what_it_was(
    robot: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    lower = workspace_programs.lower_files
    cache = tmp_path / "cache.sqlite"
    path = robot / "eye/scripts/blink.py"

    def changing(task: workspace_programs.LowerTask) -> workspace_programs.LoweredFiles:
        path.write_text(path.read_text().replace("'lid'", "'brow'"))
        return lower(task)

    before = path.read_text()
    monkeypatch.setattr(workspace_programs, "lower_files", changing)
    extracted(robot, cache)
    monkeypatch.undo()
    path.write_text(before)
    assert ("blink", Role.PUBLISHER.value, "lid") in names(extracted(robot, cache))


def test_a_damaged_cache_costs_time_only(robot: Path, tmp_path: Path):
    import sqlite3
    from contextlib import closing

    cache = tmp_path / "cache.sqlite"
    expected = extracted(robot, cache)
    with closing(sqlite3.connect(cache)) as connection:
        connection.execute(
            "UPDATE blob SET content = x'00ff' WHERE number IN"
            " (SELECT number FROM facts WHERE key GLOB 'graph:*' OR key GLOB '*:program:*')"
        )
        connection.commit()
    assert extracted(robot, cache) == expected


def test_a_folder_that_is_none_is_told(tmp_path: Path):
    with pytest.raises(UsageError, match="does not exist"):
        extracted(tmp_path / "nowhere")


def test_an_empty_folder_is_told(tmp_path: Path):
    found = extracted(tmp_path)
    assert (found.nodes, found.packages) == ((), ())
    assert found.failures


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.randoms(use_true_random=False), st.integers(1, 400))
def test_the_order_of_files_does_not_matter(tmp_path_factory: pytest.TempPathFactory, chance: random.Random, size: int):
    from roslens.source.extract.workspace.extraction import extract_found
    from roslens.source.inventory import Inventory, take_inventory
    from roslens.source.workspace.find import find_workspace

    root = write(tmp_path_factory.mktemp("ws"), FILES)
    chosen = SourceSettings()
    workspace = find_workspace([root], chosen.workspace)
    inventory = take_inventory(workspace, chosen.workspace, {})
    mixed = {key: tuple(chance.sample(files, len(files))) for key, files in inventory.files.items()}
    mixed = dict(chance.sample(list(mixed.items()), len(mixed)))
    with pytest.MonkeyPatch.context() as patch, Cache.open(None) as nothing:
        straight = extract_found(workspace, inventory, chosen, cache=nothing, jobs=1)
        patch.setattr(workspace_programs, "_BATCH_BYTES", size)
        other = extract_found(workspace, Inventory(mixed, (), {}), chosen, cache=nothing, jobs=1)
    assert msgspec.msgpack.encode(other) == msgspec.msgpack.encode(straight)


_KILLED = """
import sys
from pathlib import Path
from roslens.source.extract.ir import program_codec
from roslens.source.extract.workspace import workspace_programs
from roslens.source.extract.workspace.extraction import extract
from roslens.source.settings import SourceSettings
from roslens.store.cache import Cache
import os, signal

class Watch:
    def step(self, title, total): pass
    def advance(self, count=1, item=""):
        if item.endswith((".cpp", ".py", ".hpp")): os.kill(os.getpid(), signal.SIGKILL)

workspace_programs._BATCH_BYTES = 1
program_codec.analyser_version = lambda: sys.argv[3]
with Cache.open(Path(sys.argv[2])) as cache:
    extract([sys.argv[1]], SourceSettings(), cache=cache, now_s=4e9, jobs=1, progress=Watch())
"""


@pytest.mark.heavy
@pytest.mark.timed
def test_a_killed_run_keeps_what_it_had(robot: Path, tmp_path: Path, lowered: list[str]):
    cache = tmp_path / "cache.sqlite"
    done = subprocess.run([sys.executable, "-c", _KILLED, robot, cache, analyser_version()], check=False, timeout=60)
    assert done.returncode == -signal.SIGKILL
    found = extracted(robot, cache)
    every = [path for path in FILES if path.endswith((".cpp", ".hpp", ".py"))]
    assert len(lowered) == len([path for path in every if "test" not in path and "launch" not in path]) - 1
    assert found == extracted(robot)
