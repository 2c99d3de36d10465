"""What of a package tells its role: marks, each with the reason it gives. Pure; the words are in role_words.toml."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.model.result import TellingInclude
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
    includes: tuple[TellingInclude, ...] = ()


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
    robot = _first(name, known.robots) or (repository[0] if repository and repository[0] in known.robots else "")
    application = _first(name, known.applications) or _first(repository, known.application_repositories)
    told = re.findall(r"[a-z]+", package.description.lower())
    text = _first(told, known.application_texts)
    device, drives = _first(name, known.devices), _first(told, _DRIVERS)
    own = [file for file in facts.files if file.role is Role.OWN]
    headers = sum("/include/" in f"/{file.path}" for file in own if file.language in (Language.C, Language.CPP))
    access = min(needs & known.device_access, default="")
    said = marks_of_graph(facts.spoken)
    written = {kind: _written(facts.includes, kind) for kind in ("devices", "tasks")}
    general = not (robot or application or device or drives or access or said or written["devices"])
    found = {
        "application_name": f'"{application}" in its name or repository' if application else "",
        "application_text": _application_text(application, text),
        "robot": f'made for "{robot}"' if robot else "",
        "robot_repository": _quoted(_first(repository, known.robot_repositories), "in its repository's name"),
        "device_dependency": _quoted(min(needs & known.device_dependencies, default=""), "among its dependencies"),
        "device_access": f'reaches a device through "{access}"' if access else "",
        "device_include": written["devices"],
        "task_include": written["tasks"],
        "device_name": _quoted(device, "in its name"),
        "robot_part": f'made for "{robot}", and no application' if robot and not application else "",
        "robot_application": f'an application for "{robot}"' if robot and application else "",
        "general": "names no robot, no device and no application" if general else "",
        "example": _quoted(_first([*name, *repository], _EXAMPLES), "in its name or repository"),
        "driver_name": _quoted(_first(name, _DRIVERS), "in its name"),
        "driver_text": _quoted(drives, "in its description"),
        "library_name": _quoted(_first(name, known.libraries), "in its name"),
        "no_client": "" if needs & _CLIENTS else "needs no client library of ROS",
        "on_bringup": _quoted(_bringup_among(needs, known.robots), "among its dependencies"),
        "no_node": "" if facts.nodes or _plugins(facts.files) else "starts no node and exports no plug-in",
        "headers": f"{headers} public headers and no node" if headers >= 3 and not facts.nodes else "",
        "launch": "has launch files" if any(file.language in _LAUNCH for file in own) else "",
        **said,
    }  # fmt: skip
    return {key: reason for key, reason in found.items() if reason}


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


def _written(includes: tuple[TellingInclude, ...], kind: str) -> str:
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
