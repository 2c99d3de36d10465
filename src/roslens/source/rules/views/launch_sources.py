"""The launch files and files of parameters of a package as bytes, but for templates, which nobody reads as they are."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from roslens.model.source import Language, Role
from roslens.source.extract.launch.launch_version import launch_version
from roslens.source.rules.hit import Hit

if TYPE_CHECKING:
    from roslens.model.weight.consequence import Certainty
    from roslens.source.extract.facts.refusal import Refusal
    from roslens.source.rules.views.package_files import PackageFiles

_TEMPLATE = re.compile(rb"\{[%#].*?[%#]\}|\{\{.*?\}\}|<%.*?%>|@[A-Za-z_]{2,}@|@\(.*?\)@?|@\[.*?\]|\$\{\w+\}")
"""What Jinja, empy, ERB and CMake replace: a conflict that Git left is none."""
_CONFLICT = re.compile(rb"^(?:<{7}|>{7}) ", re.MULTILINE)
_TEMPLATES = re.compile(
    r"(?:^|/)(?:[\w-]*templates?|cookiecutter[\w-]*|skeletons?)(?:/|$)|\{\{|\.(?:in|em|j2|jinja2?)\."
)


class LaunchSource(msgspec.Struct, frozen=True):
    """A launch file with its content, and the version of ROS that it is for: ``ros1`` or ``ros2``."""

    path: str
    content: bytes
    version: str

    @property
    def is_ros2(self) -> bool:
        """Whether launch starts it, not roslaunch."""
        return self.version == "ros2"


def launch_sources(package: PackageFiles, *languages: Language) -> Iterator[LaunchSource]:
    """Yield the own launch files of a package in some languages."""
    versions = [f"ros{one}" for one in sorted(package.ros)]
    for file in package.of_language(*languages, roles=(Role.OWN,)):
        content = package.read(file.path)
        if not _TEMPLATES.search(file.path):
            yield LaunchSource(file.path, content, launch_version(file.path, content, versions))


def is_template(content: bytes) -> bool:
    """Return whether something fills a text in before it is read; asked of what cannot be read as it is."""
    return _CONFLICT.search(content) is None and _TEMPLATE.search(content) is not None


def refusal_hit(rule: str, path: str, refusal: Refusal, message: str, certainty: Certainty | None = None) -> Hit:
    """Return a hit at what the platform refuses."""
    return Hit(rule, message, refusal.line, refusal.column, context=refusal.what[:100], path=path, certainty=certainty)
