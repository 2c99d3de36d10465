"""Packages that were copied into a repository: which they are, and which only look so."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from roslens.model.source import Role
from roslens.source.inventory import take_inventory
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.find import find_workspace

Tree = Callable[[Mapping[str, str | bytes]], Path]


def manifest(
    name: str, version: str = "0.0.0", who: str = "Ada|ada@uni.edu", url: str = "", kind: str = "repository"
) -> str:
    person, _, email = who.partition("|")
    link = f'<url type="{kind}">{url}</url>' if url else ""
    return (
        f"<package><name>{name}</name><version>{version}</version><description>What {name} does.</description>"
        f'<maintainer email="{email}">{person}</maintainer><license>MIT</license>{link}</package>'
    )


def log(name: str, version: str = "0.3.6", day: str = "2020-02-03") -> str:
    title = f"Changelog for package {name}"
    return f"{'^' * len(title)}\n{title}\n{'^' * len(title)}\n\n{version} ({day})\n------------------\n* fix\n"


CAMERA = "https://github.com/ros-drivers/usb_cam"
STRANGER = "Ben Bot|ben@drivers.org"
OWN = {
    ".git/HEAD": "",
    "src/robot/package.xml": manifest("robot", who="Ada L|ada@gmail.com"),
    "src/robot/src/a.cpp": "int a;",
    "src/base/package.xml": manifest("base"),
}


def copied(root: Path) -> dict[str, str]:
    found = find_workspace([root], WorkspaceSettings()).packages
    return {one.package.name: one.package.copy_of for one in found if one.package.copy_of}


def test_a_released_package_of_strangers_is_a_copy(tree: Tree) -> None:
    root = tree(
        {
            **OWN,
            "src/usb_cam/package.xml": manifest("usb_cam", "0.3.6", STRANGER),
            "src/usb_cam/CHANGELOG.rst": log("usb_cam"),
        }
    )
    assert copied(root) == {"usb_cam": "usb_cam 0.3.6"}


def test_a_package_that_names_another_repository_of_its_name_is_a_copy(tree: Tree) -> None:
    root = tree({**OWN, "src/usb_cam/package.xml": manifest("usb_cam", "0.3.6", STRANGER, f"{CAMERA}.git")})
    assert copied(root) == {"usb_cam": "ros-drivers/usb_cam 0.3.6"}


def test_a_package_in_a_folder_named_as_the_repository_is_a_copy(tree: Tree) -> None:
    url = "https://github.com/stereolabs/zed-ros-wrapper/issues"
    path = "src/zed-ros-wrapper/zed_node/package.xml"
    root = tree({**OWN, path: manifest("zed_node", "2.7.0", STRANGER, url, "bugtracker")})
    assert copied(root) == {"zed_node": "stereolabs/zed-ros-wrapper 2.7.0"}


def test_a_package_of_a_maker_of_drivers_is_a_copy(tree: Tree) -> None:
    root = tree({**OWN, "src/laser/package.xml": manifest("laser", "2.1.4", "ROS Maintainer|ros@slamtec.com")})
    assert copied(root) == {"laser": "laser 2.1.4"}


@pytest.fixture
def committed(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Make some people those who committed to the repository."""

    def by(*people: str) -> None:
        monkeypatch.setattr("roslens.source.workspace.find.committers_of", lambda _root: frozenset(people))

    return by


PROJECT = {"src/laser-sdk/README.md": "", "src/laser-sdk/LICENSE": ""}
LASER = {"src/laser-noetic-devel/laser/package.xml": manifest("laser", "2.1.4", STRANGER)}
SDK = {**PROJECT, "src/laser-sdk/ros/package.xml": manifest("laser", "2.1.4", STRANGER)}


@pytest.mark.parametrize("files", [LASER, SDK])
def test_a_package_of_strangers_in_a_project_that_was_put_there_is_a_copy(files, tree: Tree, committed) -> None:
    committed("ada l", "ada@gmail.com")
    assert copied(tree({**OWN, **files})) == {"laser": "laser 2.1.4"}


@pytest.mark.parametrize("files", [LASER, SDK])
@pytest.mark.parametrize("people", [(), ("bbot", "bot@users.noreply.github.com"), ("ada", "ben@uni.edu")])
def test_it_is_at_home_where_its_people_may_have_committed_it(files, people, tree: Tree, committed) -> None:
    committed(*people)
    assert copied(tree({**OWN, **files})) == {}


@pytest.mark.parametrize(
    "files",
    [
        {"src/laser-master/package.xml": manifest("laser", who="Ada L|ada@gmail.com")},
        {"src/laser-master/package.xml": manifest("laser", who="TODO|todo@todo.todo")},
        {"src/laser-sdk/README.md": "", "src/laser-sdk/ros/package.xml": manifest("laser", who=STRANGER)},
        {"src/laser/README": "", "src/laser/LICENSE": "", "src/laser/package.xml": manifest("laser", who=STRANGER)},
        {"README.md": "", "LICENSE": "", "src/laser/package.xml": manifest("laser", who=STRANGER)},
    ],
)
def test_what_merely_looks_like_a_project_that_was_put_there_is_at_home(files, tree: Tree, committed) -> None:
    committed("ada l", "ada@gmail.com")
    assert copied(tree({**OWN, **files})) == {}


def test_an_archive_of_the_repository_itself_is_at_home(tree: Tree, committed) -> None:
    committed("ada l")
    config = '[remote "origin"]\n\turl = https://github.com/uni/laser.git\n'
    theirs = {"src/laser-master/package.xml": manifest("laser", who=STRANGER), ".git/config": config}
    assert copied(tree({**OWN, **theirs})) == {}


def test_packages_that_a_project_of_others_published_are_copies_however_many(tree: Tree) -> None:
    names = ("nav2_core", "nav2_util", "nav2_planner", "nav2_controller")
    copies = {f"navigation2/{name}/package.xml": manifest(name, "1.3.7", STRANGER) for name in names}
    logs = {f"navigation2/{name}/CHANGELOG.rst": log(name, "1.3.7") for name in names}
    assert copied(tree({**OWN, **copies, **logs})) == dict.fromkeys(names, "navigation2 1.3.7")


def test_one_of_the_names_of_a_project_may_be_chance(tree: Tree) -> None:
    others = {
        "src/map_server/package.xml": manifest("map_server", "1.0.0", "Cy|cy@lab.edu"),
        "src/usb_cam/package.xml": manifest("usb_cam", "1.0.0", STRANGER),
    }
    assert copied(tree({**OWN, **others})) == {"usb_cam": "usb_cam 1.0.0"}


def test_a_project_is_at_home_in_its_repository_with_what_else_lies_there(tree: Tree) -> None:
    names = ("nav2_core", "nav2_util", "nav2_new")
    packages = {f"{name}/package.xml": manifest(name, "1.3.7", STRANGER) for name in names}
    config = '[remote "origin"]\n\turl = https://github.com/ros-navigation/navigation2.git\n'
    assert copied(tree({".git/HEAD": "", ".git/config": config, **packages})) == {}
    assert copied(tree({".git/HEAD": "", **packages})) == {}, "its people maintain another package there"


def test_its_files_are_vendored_unless_the_user_says_otherwise(tree: Tree) -> None:
    root = tree(
        {
            **OWN,
            "src/usb_cam/package.xml": manifest("usb_cam", "0.3.6", STRANGER, CAMERA),
            "src/usb_cam/src/b.cpp": "int b;",
        }
    )

    def roles(settings: WorkspaceSettings) -> dict[str, Role]:
        files = take_inventory(find_workspace([root], settings), settings, {}).files
        return {file.path: file.role for group in files.values() for file in group}

    found = roles(WorkspaceSettings())
    assert found["src/usb_cam/src/b.cpp"] is found["src/usb_cam/package.xml"] is Role.VENDORED
    assert found["src/robot/src/a.cpp"] is Role.OWN
    assert roles(WorkspaceSettings(own=("src/usb_cam/**",)))["src/usb_cam/src/b.cpp"] is Role.OWN


AT_HOME: dict[str, dict[str, str]] = {
    "a log without a release": {
        "src/arm/package.xml": manifest("arm", "1.2.0", STRANGER),
        "src/arm/CHANGELOG.rst": "Changelog for package arm\n\nForthcoming\n-----\n",
    },
    "the log of another package": {
        "src/arm/package.xml": manifest("arm", "1.2.0", STRANGER),
        "src/arm/CHANGELOG.rst": log("robot", "1.2.0"),
    },
    "a URL that a template wrote": {
        "src/arm/package.xml": manifest("arm", "1.2.0", STRANGER, "https://github.com/ros-planning/moveit2"),
    },
    "people of the same organisation": {
        "src/arm/package.xml": manifest("arm", "1.2.0", "Bo|bo@uni.edu"),
        "src/arm/CHANGELOG.rst": log("arm", "1.2.0"),
    },
    "the same person with another address": {
        "src/arm/package.xml": manifest("arm", "1.2.0", "Ada L|ada@arms.org"),
        "src/arm/CHANGELOG.rst": log("arm", "1.2.0"),
    },
    "a package of a maker and of others": {
        "src/laser/package.xml": manifest("laser", who="A B|ros@slamtec.com").replace(
            "<license>", '<maintainer email="c@gmail.com">C D</maintainer><license>'
        ),
    },
    "half of all packages of a maker": {
        "src/laser/package.xml": manifest("laser", who="A B|ros@slamtec.com"),
        "src/laser_msgs/package.xml": manifest("laser_msgs", who="A B|ros@slamtec.com"),
    },
    "a version of which one package is at home": {
        "src/arm/package.xml": manifest("arm", "1.2.0", "Bo|bo@uni.edu"),
        "src/arm/CHANGELOG.rst": log("arm", "1.2.0"),
        "src/leg/package.xml": manifest("leg", "1.2.0", STRANGER),
        "src/leg/CHANGELOG.rst": log("leg", "1.2.0"),
    },
    "half of all packages": {
        "src/arm/package.xml": manifest("arm", "1.2.0", STRANGER),
        "src/arm/CHANGELOG.rst": log("arm", "1.2.0"),
        "src/leg/package.xml": manifest("leg", "1.2.0", STRANGER),
        "src/leg/CHANGELOG.rst": log("leg", "1.2.0"),
    },
    "a checkout of its own": {
        "src/arm/package.xml": manifest("arm", "1.2.0", STRANGER, "https://github.com/a/arm"),
        "src/arm/.git/HEAD": "",
    },
    "a remote of that name": {
        "src/arm/package.xml": manifest("arm", "1.2.0", STRANGER, "https://github.com/a/arm"),
        ".git/config": '[remote "origin"]\n\turl = git@github.com:fork/arm.git\n',
    },
}


@pytest.mark.parametrize("case", AT_HOME)
def test_at_home(case: str, tree: Tree) -> None:
    assert copied(tree({**OWN, **AT_HOME[case]})) == {}


def test_a_workspace_of_nothing_but_projects_is_at_home(tree: Tree) -> None:
    root = tree(
        {
            ".git/HEAD": "",
            "src/usb_cam/package.xml": manifest("usb_cam", "0.3.6", STRANGER, CAMERA),
            "src/arm/package.xml": manifest("arm", "1.2.0", "C D|c@arms.org", "https://github.com/a/arm"),
            "src/leg/package.xml": manifest("leg", "1.3.0", "E F|e@legs.org", "https://github.com/a/leg"),
        }
    )
    assert copied(root) == {}


def test_without_a_repository_nothing_was_copied_into_it(tree: Tree) -> None:
    files = {**OWN, "src/usb_cam/package.xml": manifest("usb_cam", "0.3.6", STRANGER, CAMERA)}
    del files[".git/HEAD"]
    assert copied(tree(files)) == {}


def test_the_most_packages_may_be_of_others(tree: Tree) -> None:
    files = dict(OWN)
    for name in ("cam_node", "cam_tools", "cam"):
        files[f"src/cams/{name}/package.xml"] = manifest(name, "0.3.6", STRANGER, "https://github.com/d/cams")
        files[f"src/cams/{name}/CHANGELOG.rst"] = log(name)
    files["src/cams/cam_msgs/package.xml"] = manifest("cam_msgs", "0.3.6", STRANGER)
    files["src/cams/cam_msgs/CHANGELOG.rst"] = log("cam_msgs")
    assert sorted(copied(tree(files))) == ["cam", "cam_msgs", "cam_node", "cam_tools"]
