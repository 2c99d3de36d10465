"""Which code an executable, component or nodelet means that is started by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import NodeFacts, Target, TargetKind
from roslens.source.extract.symbolic.text import Text, Written

_PROGRAMS = frozenset({TargetKind.EXECUTABLE, TargetKind.SCRIPT})
_LOADED = frozenset({TargetKind.COMPONENT, TargetKind.NODELET, TargetKind.PLUGIN})


class Units(Protocol):
    """What is known of a workspace: its packages, what their builds make, and the nodes that code becomes."""

    def has(self, package: str) -> bool:
        """Return whether the workspace has a package of that name."""

    def targets(self, package: str) -> Sequence[Target]:
        """Return what the build of a package makes."""

    def program(
        self, path: str, function: str = "", words: Sequence[Text] | None = None, chosen: Chosen | None = None
    ) -> Sequence[NodeFacts]:
        """Return the nodes that a file becomes when it is started: by its main function, or a function of a module.

        ``words`` are those of its command line, that of the program first, where they are known; ``chosen`` decides
        which plug-ins it loads.
        """

    def of_class(self, name: str, sources: Sequence[str] = (), chosen: Chosen | None = None) -> Sequence[NodeFacts]:
        """Return the nodes that an object of a class becomes; ``name`` is qualified, joined by ``.``.

        ``sources`` are those of what is loaded: they tell which class is meant where several define one. ``chosen``
        decides which plug-ins it loads.
        """

    def outside_bases(self, name: str) -> Sequence[str]:
        """Return the packages, none of them in the workspace, that have bases of a class; ``name`` is qualified."""

    def plugins(self) -> frozenset[str]:
        """Return the names under which descriptions have plug-ins of the workspace."""

    def parts(self, name: str) -> Sequence[NodeFacts]:
        """Return what code makes, wherever it runs: by the name of a plug-in, a class, a function or a file."""

    def scripts(self, package: str, name: str) -> Sequence[str]:
        """Return the scripts of a package that have a name as their file name."""

    def built_for(self, package: str, name: str) -> Sequence[str]:
        """Return for which versions of ROS the build of a package makes what is started by a name."""

    def checksum(self, interface: str, generation: str, path: str) -> str:
        """Return the checksum of an interface, as ``package/msg/Type``, for code in a file; empty where unknown."""


class KnownUnits:
    """Facts that are there already; for tests, and where all of a workspace was evaluated before."""

    def __init__(self, targets: Mapping[str, Sequence[Target]], facts: Iterable[NodeFacts]) -> None:
        """Keep targets by package, and facts by file and class."""
        self._targets = dict(targets)
        self._programs: dict[tuple[str, str], list[NodeFacts]] = {}
        self._classes: dict[str, list[NodeFacts]] = {}
        for one in facts:
            self._programs.setdefault((one.path, one.unit), []).append(one)
            self._classes.setdefault(one.unit.replace("::", "."), []).append(one)
        for found in self._classes.values():
            # The node that the class itself is comes first.
            found.sort(key=lambda one: (one.number, not one.endpoints))

    def has(self, package: str) -> bool:
        """Return whether the workspace has a package of that name."""
        return package in self._targets

    def targets(self, package: str) -> Sequence[Target]:
        """Return what the build of a package makes."""
        return self._targets.get(package, ())

    def program(
        self, path: str, function: str = "", words: Sequence[Text] | None = None, chosen: Chosen | None = None
    ) -> Sequence[NodeFacts]:
        """Return the nodes that a file becomes when it is started."""
        del words, chosen
        for unit in (function,) if function else ("<module>", "main"):
            if found := self._programs.get((path, unit)):
                return found
        return ()

    def of_class(self, name: str, sources: Sequence[str] = (), chosen: Chosen | None = None) -> Sequence[NodeFacts]:
        """Return the nodes that an object of a class becomes."""
        del sources, chosen
        return self._classes.get(name, ())

    def outside_bases(self, name: str) -> Sequence[str]:
        """Return nothing: no class is known."""
        del name
        return ()

    def plugins(self) -> frozenset[str]:
        """Return the names of the targets that are plug-ins."""
        targets = (one for group in self._targets.values() for one in group)
        return frozenset(one.name for one in targets if one.kind is TargetKind.PLUGIN)

    def parts(self, name: str) -> Sequence[NodeFacts]:
        """Return what a class or function makes."""
        return self._classes.get(name.replace("::", "."), ())

    def scripts(self, package: str, name: str) -> Sequence[str]:
        """Return the scripts whose facts are there, in the folder of the package's name."""
        known = (path for path, _ in self._programs if path.startswith(f"{package}/"))
        return sorted(path for path in set(known) if path.rpartition("/")[2] == name)

    def built_for(self, package: str, name: str) -> Sequence[str]:
        """Return the versions of the targets of a name."""
        made = self._targets.get(package, ())
        return sorted({version for one in made if name in (one.name, one.entry) for version in one.versions})

    def checksum(self, interface: str, generation: str, path: str) -> str:
        """Return nothing: no interface is known."""
        del interface, generation, path
        return ""


def meant_by(
    launched: Launched, units: Units, words: Sequence[Text] | None = None, chosen: Chosen | None = None
) -> Meant:
    """Return the code that is started, with the words of its command line; where there is none, the reason.

    ``chosen`` decides which plug-ins are loaded.
    """
    package = launched.package.known
    if package is None:
        return Meant(reason=f"the package is unknown: {launched.package}")
    if launched.kind in ("component", "nodelet"):
        return _loaded(launched, package, units, chosen)
    name = launched.executable.known
    if name is None:
        return Meant(reason=f"the executable is unknown: {launched.executable}")
    if not units.has(package):
        return Meant(reason=f"package {package} is not in the workspace", outside=(package,))
    target = _best(units.targets(package), name, _PROGRAMS)
    if target is None:
        return Meant(reason=f"no build of package {package} creates {name}{_elsewhere(units, package, name)}")
    return facts_of_target(target, units, words, chosen)


def as_script(launched: Launched, units: Units, words: Sequence[Text] | None = None) -> Meant | None:
    """Return what a script becomes that no build installs: in ROS 1 it is found where it lies in its package.

    Of several of one name roslaunch starts none (roslib, packages.py, ``find_node``).
    """
    package, name = launched.package.known or "", launched.executable.known or ""
    if launched.kind not in ("node", "test") or not name or not units.has(package):
        return None
    found = units.scripts(package, name)
    facts = units.program(found[0], "", words) if len(found) == 1 else ()
    return Meant(tuple(facts)) if facts else None


def facts_of_target(
    target: Target, units: Units, words: Sequence[Text] | None = None, chosen: Chosen | None = None
) -> Meant:
    """Return the nodes that a target becomes."""
    if target.kind in _LOADED or (target.entry and ":" not in target.entry.replace("::", "")):
        name = (target.entry or target.name).replace("::", ".")
        found = units.of_class(name, target.sources, chosen)
        outside = () if found else units.outside_bases(name)
        bases = f", a base of which is in {' and '.join(outside)}, which is not in the workspace" if outside else ""
        what = f"class {target.entry or target.name}{bases}"
    else:
        found, outside = _of_program(target, units, words, chosen), ()
        what = target.entry or f"a main function in {', '.join(target.sources) or 'its sources'}"
    conditions = tuple(map(Written, target.conditions))
    if not found:
        reason = f"{target.name}: no node was found in {what}"
        return Meant(reason=reason, conditions=conditions, outside=tuple(outside))
    return Meant(tuple(found), conditions=conditions)


def _of_program(
    target: Target, units: Units, words: Sequence[Text] | None, chosen: Chosen | None
) -> Sequence[NodeFacts]:
    module, _, function = target.entry.partition(":")
    if function:
        ends = (module.replace(".", "/") + ".py", module.replace(".", "/") + "/__init__.py")
        paths = [path for path in target.sources if path.endswith(ends)] or list(target.sources)
        for path in paths:
            if found := units.program(path, function, words, chosen):
                return found
    for path in target.sources:
        if found := units.program(path, "", words, chosen):
            return found
    return ()


def _loaded(launched: Launched, package: str, units: Units, chosen: Chosen | None) -> Meant:
    name = launched.plugin.known
    if name is None:
        return Meant(reason=f"the class is unknown: {launched.plugin}")
    # A nodelet is loaded by package/Class; its package is nodelet itself.
    owner = name.partition("/")[0] if launched.kind == "nodelet" and "/" in name else package
    target = _best(units.targets(owner), name, _LOADED) if units.has(owner) else None
    if target is not None:
        return facts_of_target(target, units, None, chosen)
    if not units.has(owner):
        return Meant(reason=f"package {owner} is not in the workspace", outside=(owner,))
    whole = (name.partition("/")[2] if "/" in name else name).replace("::", ".")
    found = units.of_class(whole, (), chosen)
    reason = f"package {owner} registers no {name}{_elsewhere(units, owner, name)}"
    return Meant(tuple(found)) if found else Meant(reason=reason)


def _elsewhere(units: Units, package: str, name: str) -> str:
    """Return the end of a reason: for which other version of ROS a build makes what is missing."""
    versions = units.built_for(package, name)
    return (
        f" for this ROS: it is for {', '.join(one.upper().replace('ROS', 'ROS ') for one in versions)}"
        if versions
        else ""
    )


def _best(targets: Sequence[Target], name: str, kinds: frozenset[TargetKind]) -> Target | None:
    fit = [one for one in targets if one.kind in kinds and _named(one, name)]
    return min(fit, key=lambda one: (not one.installed, bool(one.conditions)), default=None)


def _named(target: Target, name: str) -> bool:
    return name in (target.name, target.entry) or (
        target.kind is TargetKind.SCRIPT and target.name.endswith(f"/{name}")
    )
