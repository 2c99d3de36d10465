"""Rule ``launch.absolute_path``: a path of one machine."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import msgspec

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_OF_BUILDS = (".", "snapcraft", "docker", "compose", "circle", "appveyor", "azure", "travis", "mkdocs", "bitbucket")
"""How files begin that say how a machine of its own builds or documents the package."""
_OF_CONTAINERS = ("/home/user", "/home/ros", "/root")
"""Home folders of the users that containers have: whoever starts it there finds the path."""
_HOMES = (b"/home/", b"/root/", b"/Users/")
_HOME = re.compile(r"(?:^|[\s'\"=:(\[,])((?:file://)?/(?:home|Users|root)/[\w.@+-]+(?:/[^\s'\"<>,)\]]*)?)")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first path below a home folder in each attribute, line of YAML or text of a launch file in Python."""
    for file in view.launch:
        for element, _ in file.elements:
            match = _first_home((*element.attributes.values(), element.text()))
            if match:
                hit = file.hit("launch.absolute_path", element, _message(match[1]), match[1])
                yield msgspec.structs.replace(hit, certainty=_certainty(match[1]))
    others = view.of_language(Language.YAML, Language.LAUNCH_YAML, Language.LAUNCH_PYTHON, roles=(Role.OWN,))
    for one in others:
        text = view.read(one.path)
        if not one.path.rpartition("/")[2].startswith(_OF_BUILDS) and any(home in text for home in _HOMES):
            yield from _hits(one.path, text.decode("utf-8", "replace"))


def _first_home(values: Iterable[str]) -> re.Match[str] | None:
    for value in values:
        if match := _HOME.search(value):
            return match
    return None


def _hits(path: str, text: str) -> Iterator[Hit]:
    """Yield each line that names a path below a home folder, comments aside."""
    for number, line in enumerate(text.splitlines(), 1):
        match = _HOME.search(re.sub(r"(?:^|\s)#.*", "", line))
        if match:
            yield Hit(
                "launch.absolute_path",
                _message(match[1]),
                number,
                context=match[1],
                path=path,
                certainty=_certainty(match[1]),
            )


def _certainty(path: str) -> Certainty | None:
    return (
        Certainty.HEURISTIC if f"{path.rstrip('/')}/".startswith(tuple(f"{one}/" for one in _OF_CONTAINERS)) else None
    )


def _message(path: str) -> str:
    return f"{path!r} is on one machine; expected $(find …), an argument, or a path below the package"


RULE = PackageRule(
    id="launch.absolute_path",
    title="Path of one machine in a configuration",
    finds="A path below `/home`, `/Users` or `/root` in a launch file (XML, YAML, Python) or a file of parameters. "
    "Use `$(find PACKAGE)`, `$(find-pkg-share PACKAGE)`, an argument, or `$(env HOME)`. "
    "Homes of the usual users of containers (`/home/user`, `/root`) are notes.",
    why="The robot has another user: the map, model or calibration is not found there.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<arg name="map" default="/home/ada/maps/office.yaml"/>',
    good='<arg name="map" default="$(find office_maps)/maps/office.yaml"/>',
    found=found,
)
