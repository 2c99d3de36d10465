"""Evidence of the role of a package: marks, each with its reason. Pure; the words are in role_words.toml."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.model.result import RoleInclude
from roslens.model.source import Language, Package, Role, SourceFile
from roslens.source.study.role_graph import Spoken, marks_of_graph

_CODE = frozenset({Language.C, Language.CPP, Language.PYTHON})
_LAUNCH = frozenset({Language.LAUNCH_XML, Language.LAUNCH_PYTHON, Language.LAUNCH_YAML})
_INTERFACES = frozenset({Language.MSG, Language.SRV, Language.ACTION})
_CLIENTS = frozenset({"roscpp", "rospy", "rclcpp", "rclpy"})
_EXAMPLES = frozenset({"demo", "demos", "example", "examples", "tutorial", "tutorials"})
_DRIVERS = frozenset({"driver", "drivers"})
_BESIDE_CODE = frozenset({"setup.py", "conf.py", "__init__.py"})


class RoleFacts(msgspec.Struct, frozen=True):
    """What is looked at of a package.

    Attributes:
        package: its manifest.
        files: all that have a language.
        repository: last part of the repository's path.
        nodes: whether it has a ``main``.
        spoken: what its nodes say to others; None where the run has no computation graph with them.
        includes: what its sources include or import that tells its role.
    """

    package: Package
    files: tuple[SourceFile, ...]
    repository: str
    nodes: bool
    spoken: Spoken | None = None
    includes: tuple[RoleInclude, ...] = ()


class Words(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The table of words."""

    robots: frozenset[str]
    devices: frozenset[str]
    robot_repositories: frozenset[str]
    applications: frozenset[str]
    application_repositories: frozenset[str]
    application_texts: frozenset[str]
    libraries: frozenset[str]
    device_dependencies: frozenset[str]
    device_access: frozenset[str]
    simulators: frozenset[str]


@lru_cache(maxsize=1)
def words() -> Words:
    """Return the words that come with roslens."""
    return msgspec.toml.decode(Path(__file__).with_name("role_words.toml").read_bytes(), type=Words)


def marks_of(facts: RoleFacts) -> dict[str, str]:
    """Return the marks that a package has, by key, each with what shows it."""
    known, package = words(), facts.package
    name, repository = parts(package.name), parts(facts.repository)
    needs = {one.name for one in package.dependencies if one.active}
    robot = _first(name, known.robots) or _first(repository[:1], known.robots)
    application = _first(name, known.applications) or _first(repository, known.application_repositories)
    described = re.findall(r"[a-z]+", package.description.lower())
    text = _first(described, known.application_texts)
    device, drives = _first(name, known.devices), _first(described, _DRIVERS)
    own = [file for file in facts.files if file.role is Role.OWN]
    headers = sum("/include/" in f"/{file.path}" for file in own if file.language in (Language.C, Language.CPP))
    access = min(needs & known.device_access, default="")
    said = marks_of_graph(facts.spoken)
    written = {kind: _written(facts.includes, kind) for kind in ("devices", "tasks")}
    general = not any((robot, application, device, drives, access, said, written["devices"]))
    made_for = f'made for "{robot}"'
    found = {
        "application_name": _where(application, f'"{application}" in its name or repository'),
        "application_text": _application_text(application, text),
        "robot": _where(robot, made_for),
        "robot_repository": _quoted(_first(repository, known.robot_repositories), "in its repository's name"),
        "device_dependency": _quoted(min(needs & known.device_dependencies, default=""), "among its dependencies"),
        "device_access": _where(access, f'reaches a device through "{access}"'),
        "device_include": written["devices"],
        "task_include": written["tasks"],
        "device_name": _quoted(device, "in its name"),
        "robot_part": _where(robot and not application, f"{made_for}, and no application"),
        "robot_application": _where(robot and application, f'an application for "{robot}"'),
        "general": _where(general, "names no robot, no device and no application"),
        "example": _quoted(_first([*name, *repository], _EXAMPLES), "in its name or repository"),
        "driver_name": _quoted(_first(name, _DRIVERS), "in its name"),
        "driver_text": _quoted(drives, "in its description"),
        "library_name": _quoted(_first(name, known.libraries), "in its name"),
        "no_client": _where(not needs & _CLIENTS, "needs no client library of ROS"),
        "on_bringup": _quoted(_bringup_among(needs, known.robots), "among its dependencies"),
        "no_node": _where(not (facts.nodes or _plugins(facts.files)), "starts no node and exports no plug-in"),
        "headers": _where(headers >= 3 and not facts.nodes, f"{headers} public headers and no node"),
        "launch": _where(any(file.language in _LAUNCH for file in own), "has launch files"),
        **said,
    }  # fmt: skip
    return {key: reason for key, reason in found.items() if reason}


def _where(holds: object, reason: str) -> str:
    """Return the reason of a mark where what it needs holds, or is named."""
    return reason if holds else ""


def parts(name: str) -> list[str]:
    """Return the words of a name of a package or of a repository."""
    return [part for part in re.split(r"[_\-.+]+", name.lower()) if part]


def has_code(facts: RoleFacts) -> bool:
    """Return whether a package has code of its own, in a file that is more than a build or launch file."""
    return any(
        file.language in _CODE and file.role is Role.OWN and file.path.rpartition("/")[2] not in _BESIDE_CODE
        for file in facts.files
    )


def counts_of(facts: RoleFacts) -> dict[str, int]:
    """Return how many files of interfaces, of robot descriptions and of launches a package has."""
    kinds = {"interfaces": _INTERFACES, "descriptions": {Language.URDF, Language.XACRO}, "launches": _LAUNCH}
    return {name: sum(file.language in languages for file in facts.files) for name, languages in kinds.items()}


def _written(includes: tuple[RoleInclude, ...], kind: str) -> str:
    does = {"devices": "reaches a device through", "tasks": "has a robot do something through"}[kind]
    return next((f'{does} "{one.name}", {one.path}:{one.line}' for one in includes if one.kind == kind), "")


def _application_text(name: str, text: str) -> str:
    if name:
        return f'"{name}" in its name or repository'
    return _quoted(text, "in its description")


def _plugins(files: tuple[SourceFile, ...]) -> bool:
    return any("nodelet" in one.path or ("plugin" in one.path and one.path.endswith(".xml")) for one in files)


def _bringup_among(needs: set[str], robots: frozenset[str]) -> str:
    endings = ("_bringup", "_moveit_config", "_navigation", "_node")
    return min((one for one in needs if one.endswith(endings) and parts(one)[0] in robots), default="")


def _first(among: list[str], wanted: frozenset[str]) -> str:
    return next((one for one in among if one in wanted), "")


def _quoted(word: str, where: str) -> str:
    return f'"{word}" {where}' if word else ""
