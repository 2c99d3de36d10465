"""The shipped workspace: what is found in it is what its README says."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from roslens.model.source import Language, Role
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.encoding import encoding_of
from roslens.source.workspace.find import Workspace, find_workspace
from roslens.source.workspace.languages import classify
from roslens.source.workspace.mistakes import mistakes_of

FOLDER = Path(__file__).parents[3] / "examples" / "workspace"
SETTINGS = WorkspaceSettings(environment={"ROS_VERSION": "2"})


@pytest.fixture(scope="module")
def workspace() -> Workspace:
    return find_workspace([FOLDER], SETTINGS)


def test_packages(workspace: Workspace) -> None:
    found = {one.package.name: (one.package.build_type, one.package.repository) for one in workspace.packages}
    assert found == {
        "rover_base": ("ament_cmake", "rover"),
        "rover_bringup": ("ament_cmake", "rover"),
        "rover_docking": ("catkin", "rover_legacy"),
        "rover_legacy": ("catkin", "rover_legacy"),
        "rover_mission": ("ament_python", "rover"),
        "rover_msgs": ("ament_cmake", "rover"),
        "rover_navigation": ("ament_cmake", "rover"),
        "rover_sensors": ("ament_python", "rover"),
        "rover_teleop": ("catkin", "rover_legacy"),
    }
    assert [one.package.name for one in workspace.packages if one.package.metapackage] == ["rover_legacy"]


def test_manifests_are_accepted(workspace: Workspace) -> None:
    assert not workspace.failures
    paths = [one.package.manifest.path for one in workspace.packages]
    assert not [one for path in paths if path for one in mistakes_of(Path(workspace.root, path).read_bytes(), path)]


def test_the_cycle(workspace: Workspace) -> None:
    needs = {one.package.name: {it.name for it in one.package.dependencies} for one in workspace.packages}
    cycles = {tuple(sorted((a, b))) for a in needs for b in needs[a] if a in needs.get(b, ())}
    assert cycles == {("rover_mission", "rover_navigation")}


def test_every_language_and_role(workspace: Workspace) -> None:
    languages: Counter[Language] = Counter()
    roles: dict[Role, set[str]] = {role: set() for role in Role}
    latin = []
    for found in workspace.packages:
        for file in found.files:
            content = Path(workspace.root, file.path).read_bytes()
            classified = classify(file.path, content, SETTINGS)
            languages[classified.language] += 1
            roles[classified.role].add(file.path.rpartition("/")[2])
            if encoding_of(content).name == "latin-1":
                latin.append(file.path)
    assert set(languages) == set(Language) - {Language.XML}
    assert roles[Role.GENERATED] == {"pwm_table.cpp", "battery_curve.py"}
    assert roles[Role.VENDORED] == {"README.md", "crc8.c", "crc8.h"}
    assert len(roles[Role.TEST]) == 11
    assert latin == ["src/rover_legacy/rover_teleop/src/joystick_profile.cpp"]
