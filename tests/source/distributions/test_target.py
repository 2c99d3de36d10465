"""Which distribution a package is for: said by the user, or by the nearest file that builds it."""

import pytest

from roslens.source.distributions.target import Target, targets_of
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.find import find_workspace


@pytest.fixture
def target(tmp_path):
    """What the package in a folder of a workspace of given files is for."""

    def look(files, folder="arm", given="", environment=None):
        (tmp_path / ".git").mkdir(exist_ok=True)
        for path, text in {f"{folder}/package.xml": "<package/>", **files}.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(text)
        packages = [one.package for one in find_workspace([tmp_path], WorkspaceSettings()).packages]
        (one,) = [one for one in packages if one.path == folder]
        return targets_of(tmp_path, packages, given, environment)[one.id]

    return look


def test_nothing_is_known_where_nothing_says_it(target):
    assert target({}) == Target()
    assert target({}).note() == ""


@pytest.mark.parametrize(
    ("month", "earlier"),
    [
        ("2018-07", ("indigo", "foxy")),
        ("2021-03", ("kinetic", "foxy")),
        ("2023-06", ("melodic", "foxy")),
        ("2024-06", ("melodic", "foxy")),
        ("2024-07", ()),
        ("2026-11", ()),
        ("", ()),
        ("fatal: no month", ()),
    ],
)
def test_where_nothing_says_it_the_last_commit_tells_what_it_may_be_for(tmp_path, month, earlier):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm/package.xml").write_text("<package/>")
    packages = [one.package for one in find_workspace([tmp_path], WorkspaceSettings()).packages]
    (found,) = targets_of(tmp_path, packages, last_change=lambda: month).values()
    assert found == Target(earlier=earlier)
    assert found.oldest(2) == ("foxy" if earlier else "humble")
    (said,) = targets_of(tmp_path, packages, "jazzy", last_change=lambda: month).values()
    assert said.earlier == ()


def test_the_user_has_the_last_word(target):
    said = target({".github/workflows/ci.yml": "container: ros:humble\n"}, given="jazzy")
    assert said.distros == ("jazzy",)
    assert said.given
    assert said.note() == "for Jazzy, as `distro` says"


@pytest.mark.parametrize(
    ("text", "distros"),
    [
        ("        ros_distro: [humble, jazzy]\n", ("humble", "jazzy")),
        ("        ros_distribution:\n          - jazzy\n          - rolling\n", ("jazzy", "rolling")),
        ("env:\n  ROS_DISTRO: 'noetic'\n", ("noetic",)),
        ("    container: osrf/ros:kilted-desktop\n", ("kilted",)),
        ("          required-ros-distributions: iron\n", ("iron",)),
        ("      - run: source /opt/ros/lyrical/setup.bash\n", ("lyrical",)),
        ("          target-ros2-distro: ${{ matrix.ros }}\n", ()),
        ("name: humble beginnings\non: push\n", ()),
        ("    # ROS_DISTRO: humble\n", ()),
    ],
)
def test_continuous_integration_says_it(target, text, distros):
    said = target({".github/workflows/ci.yml": text})
    assert said.distros == distros
    if distros:
        assert said.said_by == ".github/workflows/ci.yml"
        assert not said.given


@pytest.mark.parametrize(
    ("path", "text", "distros"),
    [
        ("Dockerfile", "FROM ros:humble-ros-base\n", ("humble",)),
        ("docker/robot.Dockerfile", "FROM osrf/ros:jazzy-desktop AS build\n", ("jazzy",)),
        ("Dockerfile", "ARG ROS_DISTRO=iron\nFROM ros:${ROS_DISTRO}\n", ("iron",)),
        ("Dockerfile", "FROM ubuntu:22.04\nRUN apt install ros-humble-nav2-bringup\n", ("humble",)),
        ("Dockerfile", "FROM ubuntu:22.04\nRUN echo rolling stones\n", ()),
        ("robot.repos", "repositories:\n  a:\n    version: humble\n  b:\n    version: main\n", ("humble",)),
        ("robot.repos", "repositories:\n  humble:\n    version: 1.0.0\n", ()),
    ],
)
def test_containers_and_lists_of_repositories_say_it(target, path, text, distros):
    assert target({path: text}).distros == distros


def test_the_nearest_file_counts_and_continuous_integration_before_containers(target):
    files = {
        ".github/workflows/ci.yml": "ROS_DISTRO: humble\n",
        "Dockerfile": "FROM ros:iron\n",
        "arm/Dockerfile": "FROM ros:jazzy\n",
    }
    assert target(files).said_by == "arm/Dockerfile"
    assert target({}, folder="other").said_by == ".github/workflows/ci.yml"


def test_another_repository_above_is_not_asked(target):
    files = {".github/workflows/ci.yml": "ROS_DISTRO: humble\n", "arm/.git": "gitdir: elsewhere\n"}
    assert target(files) == Target()


def test_the_environment_counts_where_no_file_says_anything(target):
    assert target({}, environment={"ROS_DISTRO": "jazzy"}).said_by == "$ROS_DISTRO"
    assert target({}, environment={"ROS_DISTRO": "unheard"}) == Target()
    files = {"Dockerfile": "FROM ros:humble\n"}
    assert target(files, environment={"ROS_DISTRO": "jazzy"}).distros == ("humble",)


def test_all_files_of_a_kind_count_but_those_for_documentation(target):
    files = {
        ".github/workflows/humble.yml": "ROS_DISTRO: humble\n",
        ".github/workflows/main.yml": "ROS_DISTRO: jazzy\n",
        ".github/workflows/deploy_docs.yml": "ROS_DISTRO: iron\n",
    }
    assert target(files).note() == "for Humble, Jazzy, as .github/workflows/humble.yml says"


@pytest.mark.parametrize(
    ("path", "text", "distros"),
    [
        ("README.md", "    sudo apt install ros-foxy-navigation2\n", ("foxy",)),
        ("README.md", "rosdep install --from-paths src --rosdistro=kinetic -y\n", ("kinetic",)),
        ("README.rst", "source /opt/ros/jazzy/setup.bash\n", ("jazzy",)),
        ("arm/README.md", "## Tested with ROS 2 Humble and `ROS2 Iron`\n", ("humble", "iron")),
        ("README.md", "ROS Noetic (Ubuntu 20.04)\n", ("noetic",)),
        (".vscode/c_cpp_properties.json", '{"includePath": ["/opt/ros/foxy/include/**"]}\n', ("foxy",)),
        ("README.md", "A humble robot with a jazzy arm.\n", ()),
        ("README.md", "For ROS 2 Humble. It does not work on ROS 2 Jazzy yet.\n", ("humble",)),
        ("README.md", "ROS 2 Humble (ROS 2 Jazzy is untested)\n", ()),
        ("README.md", "This isn't compatible with ROS Noetic.\n", ()),
        ("README.md", "Use ROS 2 Jazzy.\nFor ROS 2 Humble, see the `humble` branch.\n", ("jazzy",)),
        ("README.md", "This branch is for ROS 2 Iron.\n", ("iron",)),
        ("README.md", "Do not forget `source /opt/ros/humble/setup.bash`\n", ("humble",)),
        ("CHANGELOG.rst", "* Drop ROS Kinetic\n", ()),
    ],
)
def test_what_people_are_told_to_install_says_it(target, path, text, distros):
    said = target({path: text})
    assert said.distros == distros
    if distros:
        assert said.told
        assert said.said_by == path


def test_what_builds_says_more_than_what_people_are_told(target):
    said = target({"arm/README.md": "ROS 2 Foxy\n", ".github/workflows/ci.yml": "container: ros:humble\n"})
    assert said.distros == ("humble",)
    assert not said.told
