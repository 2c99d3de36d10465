"""What a simulated robot makes of topics and services: plug-ins of Gazebo in descriptions that a launch file spawns.

A plug-in runs within the node of Gazebo. What each one makes of the elements it is given is in
``catalogue/gazebo/plugins.yaml``; releases differ, so none of it is certain.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib import resources
from itertools import pairwise

import msgspec

from roslens.judge.documents.yaml_tree import read_tree
from roslens.source.extract.catalogue.catalogue import plain_value
from roslens.source.extract.catalogue.hints import ROLES, endpoint_of
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Launch, Launched, Unresolved
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, Sure
from roslens.source.extract.facts.resolve_name import Place, Rule, absolute, expand, resolve
from roslens.source.extract.launch.robot_description import Described, read_description
from roslens.source.extract.symbolic.text import Conditions, Text

SERVERS = frozenset({"gzserver", "gazebo", "debug", "perf"})
_SPAWNERS = frozenset({"spawn_model", "spawn_model.py"})
_PACKAGE = "gazebo_ros"
_FILES = re.compile(r"\.(urdf|sdf|xacro|world|model)\Z")
_SLASHES = re.compile(r"/{2,}")


class Plugin(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A plug-in of the catalogue.

    Attributes:
        library: file name without ``lib`` and ``.so``.
        source: where its facts can be read.
        spaces: elements that make the namespace of its node handle, joined.
        per_camera: whether it makes all of it for each camera of its sensor, in a namespace ``left`` or ``right``.
    """

    library: str
    source: str
    spaces: tuple[str, ...] = ("robotNamespace",)
    per_camera: bool = False
    publishes: tuple[str, ...] = ()
    subscribes: tuple[str, ...] = ()
    serves: tuple[str, ...] = ()


class _Spawned(msgspec.Struct, frozen=True):
    """A description that comes into the simulation: its file, what it is given, and the usual namespace of plug-ins."""

    path: str
    arguments: dict[str, Text]
    space: Text
    conditions: Conditions = ()


def is_simulator(launched: Launched) -> bool:
    """Return whether a node is Gazebo, of which plug-ins are a part."""
    return launched.package.known == _PACKAGE and launched.executable.known in SERVERS


def with_plugins(launch: Launch, files: Files, environment: Mapping[str, str]) -> Launch:
    """Return a launch in which Gazebo has what the plug-ins make of all that is spawned.

    Args:
        launch: all that is started and set.
        files: that may be read.
        environment: variables that are known.
    """
    nodes, unresolved = [], list(launch.unresolved)
    for node in launch.nodes:
        if is_simulator(node):
            node, missing = _plugged(node, launch, files, environment)
            unresolved += missing
        nodes.append(node)
    return msgspec.structs.replace(launch, nodes=tuple(nodes), unresolved=tuple(dict.fromkeys(unresolved)))


def _plugged(
    gazebo: Launched, launch: Launch, files: Files, environment: Mapping[str, str]
) -> tuple[Launched, list[Unresolved]]:
    endpoints: list[EndpointFact] = []
    unresolved: list[Unresolved] = []
    taken: set[Evidence] = set()
    place = Place(gazebo.namespace, absolute(gazebo.namespace, gazebo.name), "ros1")
    rules = tuple(Rule(one.source, one.target, one.evidence) for one in gazebo.remaps)
    for one in _distinct(_spawned(gazebo, launch)):
        top, missing = read_description(one.path, files, one.arguments, environment)
        unresolved += missing
        for path in top.walk() if top is not None else ():
            if path[-1].tag == "plugin" and "filename" in path[-1].attributes:
                endpoints += _of_plugin(path, one, place, rules, taken)
    used = tuple(one for one in gazebo.remaps if one.evidence in taken)
    return msgspec.structs.replace(gazebo, plugged=tuple(endpoints), taken=used), unresolved


def _distinct(spawned: Iterable[_Spawned]) -> list[_Spawned]:
    found: list[_Spawned] = []
    for one in spawned:
        if one not in found:
            found.append(one)
    return found


def _spawned(gazebo: Launched, launch: Launch) -> Iterator[_Spawned]:
    for word in gazebo.arguments:
        if word.known is not None and _FILES.search(word.known):
            yield _Spawned(joined("", word.known), {}, Text())
    for one in launch.nodes:
        if one.package.known == _PACKAGE and one.executable.known in _SPAWNERS:
            yield from _of_spawner(one, launch)


def _of_spawner(spawner: Launched, launch: Launch) -> Iterator[_Spawned]:
    """Yield the description that a node spawns: of a file, or of the command that a parameter is the output of."""
    options = {word.known: after for word, after in pairwise(spawner.arguments) if word.known}
    space = options.get("-robot_namespace") or options.get("-namespace") or spawner.namespace
    if "-file" in options and (path := options["-file"].known):
        yield _Spawned(joined("", path), {}, space, spawner.conditions)
    elif "-param" in options:
        name = expand(options["-param"], Place(spawner.namespace, absolute(spawner.namespace, spawner.name), "ros1"))
        command = next((s.words for s in reversed(launch.settings) if s.name == name and s.words), ())
        if (found := _of_command(command)) is not None:
            yield msgspec.structs.replace(found, space=space, conditions=spawner.conditions)


def _of_command(words: tuple[Text, ...]) -> _Spawned | None:
    """Return the description that a command line writes out: the first word that is such a file, with ``a:=b``."""
    found, given = "", {}
    for word in words[1:]:
        name, sign, rest = word.head.partition(":=")
        if sign:
            given[name.strip("'\"")] = Text.of(rest, *word.parts[1:])
        elif word.known is not None and not found and _FILES.search(word.known.strip("'\"")):
            found = word.known.strip("'\"")
    return _Spawned(joined("", found), given, Text()) if found else None


def _of_plugin(
    path: tuple[Described, ...], spawned: _Spawned, place: Place, rules: tuple[Rule, ...], taken: set[Evidence]
) -> Iterator[EndpointFact]:
    element = path[-1]
    plugin = plugins().get((element.attributes["filename"].known or "").removeprefix("lib").removesuffix(".so"))
    if plugin is None:
        return
    values = {child.tag: child.text for child in element.children if child.text.parts}
    values.setdefault("robotNamespace", spawned.space)
    conditions = (*spawned.conditions, *element.conditions)
    how = f"plug-in {plugin.library} of Gazebo creates it; differs between releases"
    evidence = Evidence(element.evidence.path, element.evidence.line, element.evidence.column, how, Sure.LIKELY)
    for camera in _cameras(path) if plugin.per_camera else ("",):
        spaces = [values.get(name, Text()) for name in plugin.spaces]
        # roscpp remaps the namespace of a node handle before names are put below it.
        space, by = resolve(_below(*spaces, Text.of(camera)), place, rules)
        if by is not None:
            taken.add(by.evidence)
        for key, role in ROLES.items():
            for line in getattr(plugin, key, ()):
                pattern, _, rest = line.partition(" ")
                name = _filled(pattern, values)
                if name is None:
                    continue
                fact = endpoint_of(f"x {rest}", role, "ros1", evidence)
                yield msgspec.structs.replace(fact, name=_below(space, name), conditions=conditions)


def _cameras(path: tuple[Described, ...]) -> list[str]:
    """Return the sides of the cameras that the sensor of a plug-in has; those without a side are not published."""
    sensor = next((one for one in reversed(path) if one.tag == "sensor"), None)
    names = [
        one.attributes.get("name", Text()).pattern for one in (sensor.children if sensor else ()) if one.tag == "camera"
    ]
    return [side for name in names for side in ("left", "right") if side in name]


def _below(*pieces: Text) -> Text:
    """Return names joined; a last one that is global stands below nothing."""
    given = [one for one in pieces if one.parts]
    whole = Text()
    for number, piece in enumerate(given, 1):
        if number == len(given) > 1 and piece.is_global:
            return piece
        whole = Text.of(whole, "/" if whole.parts else "", piece)
    return whole.with_known(lambda part: _SLASHES.sub("/", part))


def _filled(pattern: str, values: Mapping[str, Text]) -> Text | None:
    """Return a pattern with the elements that a plug-in is given; None where one without a default is missing."""
    begin = pattern.find("{")
    if begin < 0:
        return Text.of(pattern)
    depth, end = 0, begin
    for end in range(begin, len(pattern)):
        depth += (pattern[end] == "{") - (pattern[end] == "}")
        if not depth:
            break
    name, sign, default = pattern[begin + 1 : end].partition("=")
    value = values.get(name)
    if value is None:
        value = _filled(default, values) if sign else None
    rest = _filled(pattern[end + 1 :], values)
    return None if value is None or rest is None else Text.of(pattern[:begin], value, rest)


@cache
def plugins() -> Mapping[str, Plugin]:
    """Return the plug-ins of the catalogue by library."""

    class File(msgspec.Struct, forbid_unknown_fields=True):
        plugins: tuple[Plugin, ...]

    file = resources.files("roslens.source.extract").joinpath("catalogue").joinpath("gazebo").joinpath("plugins.yaml")
    tree = read_tree(file.read_bytes(), "plugins.yaml")
    return {one.library: one for one in msgspec.convert(plain_value(tree.root), File, strict=False).plugins}
