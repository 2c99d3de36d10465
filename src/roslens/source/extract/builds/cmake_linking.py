"""From what CMake files say to targets: sources that exist, libraries of the package followed, what is installed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from posixpath import basename, splitext

import msgspec

from roslens.source.extract.builds.cmake_evaluation import BUILD, SOURCE, Evaluation
from roslens.source.extract.builds.cmake_made import Installed, Item, Made
from roslens.source.extract.builds.cmake_targets import Collected
from roslens.source.extract.builds.cmake_value import is_made, is_unknown, reason_of
from roslens.source.extract.facts.files import joined
from roslens.source.extract.facts.node_facts import Generated, Sure, Target, TargetKind

INSTALL = "/=install"
"""Stands for the folder that is installed to."""

_OBJECTS = re.compile(r"\$<TARGET_OBJECTS:([^<>]+)>")
_INTERFACE = re.compile(r"\$<(?:BUILD_INTERFACE|LINK_ONLY|BUILD_LOCAL_INTERFACE):([^<>]+)>")
_ENDS = (".cpp", ".c", ".cc", ".cxx")
_SCRIPTS = ("", ".py", ".sh", ".bash", ".pl", ".rb")


class Parts(msgspec.Struct):
    """The files a target is made of, the libraries of others that it links, and whether all that is certain."""

    sources: dict[str, None]
    links: dict[str, None]
    certain: bool = True


class Linking:
    """Turns what was collected from the CMake files of a package into targets."""

    def __init__(self, package: str, catkin: bool, run: Evaluation, collected: Collected) -> None:
        """Prepare for a package; ``catkin`` is whether it is built with catkin."""
        self._package = package
        self._catkin = catkin
        self._run = run
        self._collected = collected
        self._known: dict[int, tuple[list[str], list[str], bool]] = {}

    def targets(self) -> list[Target]:
        """Return executables, libraries, components and scripts in the order in which they are made."""
        found = [self._target(made) for group in self._collected.made.values() for made in group]
        found.extend(self._components())
        found.extend(self._scripts())
        return merged(found)

    def file(self, item: Item, what: str) -> str | None:
        """Return the path of a file that is given; None, reported as unresolved, where it is none of the workspace."""
        text, run = item.text, self._run
        if is_unknown(text):
            run.fail(text, item.evidence, f"{what} is unknown: {reason_of(text)}")
            return None
        if "$<" in text:
            inner = _INTERFACE.fullmatch(text)
            if inner is None:
                run.fail(text, item.evidence, f"{what} depends on a generator expression")
                return None
            text = inner[1]
        if text.startswith(BUILD):
            run.fail(text[len(BUILD) + 1 :], item.evidence, f"{what} is made by the build")
            return None
        path = run.relative(text, item.folder)
        for end in ("", *_ENDS):
            if path is not None and path + end in run.listing:
                return path + end
        if path is not None and not self._inside(path) and run.files.content(path) is not None:
            return path
        run.fail(text.replace(f"{SOURCE}/", ""), item.evidence, f"{what} is not among the files of the package")
        return None

    def _inside(self, path: str) -> bool:
        return not self._run.folder or path.startswith(f"{self._run.folder}/")

    def own(self, name: str) -> list[Made]:
        """Return the targets of the package that a name of a library means."""
        inner = _INTERFACE.fullmatch(name)
        name = inner[1] if inner else name
        made, aliases = self._collected.made, self._collected.aliases
        for _ in range(5):
            if name in made or name not in aliases:
                break
            name = aliases[name]
        if name not in made and "::" in name:
            project, _, rest = name.partition("::")
            name = rest if project == self._package else name
        return made.get(name, [])

    def named_file(self, name: str) -> list[Made]:
        """Return the libraries whose file has a name (without ``lib`` and its end)."""
        return [
            made
            for group in self._collected.made.values()
            for made in group
            if not made.executable
            and name in (made.output or made.name, (made.output or made.name).removeprefix("lib"))
        ]

    def _own_parts(self, made: Made) -> tuple[list[str], list[str], bool]:
        sources: list[str] = []
        linked: list[str] = [item.text for item in made.links if not is_unknown(item.text)]
        perhaps = [item for item in made.links if len(item.conditions) > len(made.conditions)]
        certain = not any(self.own(item.text) for item in perhaps)
        for item in made.sources:
            objects = _OBJECTS.fullmatch(item.text)
            if objects:
                linked.append(objects[1])
            elif path := self.file(item, "a source"):
                sources.append(path)
                certain = certain and len(item.conditions) <= len(made.conditions)
            elif not item.text.startswith(BUILD) and not is_made(item.text):
                certain = False
        return sources, linked, certain

    def parts(self, made: Sequence[Made]) -> Parts:
        """Return what targets are made of, with the libraries of the package that they link."""
        parts = Parts({}, {})
        waiting = list(made)
        seen = {id(one) for one in waiting}
        while waiting:
            one = waiting.pop(0)
            sources, linked, certain = self._cached(one)
            parts.sources.update(dict.fromkeys(sources))
            if one not in made:
                parts.sources.update((path, None) for item in one.given if (path := self.file(item, "a source")))
            parts.certain = parts.certain and certain
            for name in linked:
                own = self.own(name)
                if not own and not name.startswith(("-", "$")):
                    parts.links[name] = None
                fresh = [more for more in own if id(more) not in seen]
                seen.update(map(id, fresh))
                waiting.extend(fresh)
        return parts

    def _cached(self, made: Made) -> tuple[list[str], list[str], bool]:
        if id(made) not in self._known:
            self._known[id(made)] = self._own_parts(made)
        return self._known[id(made)]

    def _target(self, made: Made) -> Target:
        parts = self.parts([made])
        kind = TargetKind.EXECUTABLE if made.executable else TargetKind.LIBRARY
        found = bool(made.installed) if not made.executable else any(map(self._is_found, made.installed))
        evidence = made.evidence
        if not parts.certain:
            evidence = msgspec.structs.replace(evidence, sure=Sure.LIKELY)
        if self._catkin and made.executable and not made.installed and not made.test:
            evidence = msgspec.structs.replace(evidence, how=_joined(evidence.how, "in the devel space alone"))
        return Target(
            kind, self._package, made.output or made.name, tuple(parts.sources), evidence,
            installed=found, conditions=made.conditions,
        )  # fmt: skip

    def _is_found(self, destination: str) -> bool:
        """Return whether ``ros2 run`` and ``rosrun`` look into a folder."""
        if is_unknown(destination):
            return True
        return joined("", destination.removeprefix(INSTALL)) == f"lib/{self._package}"

    def _components(self) -> Iterable[Target]:
        for one in self._collected.components:
            made = self.own(one.library)
            parts = self.parts(made)
            sure = Sure.CERTAIN if parts.certain and made else Sure.LIKELY
            evidence = msgspec.structs.replace(one.evidence, sure=sure)
            if not made:
                self._run.fail(one.library, one.evidence, "the library of a component is not made by the package")
            component = Target(
                TargetKind.COMPONENT, self._package, one.name, tuple(parts.sources), evidence,
                entry=one.name, library=one.library, conditions=one.conditions,
            )  # fmt: skip
            yield component
            if one.executable:
                yield msgspec.structs.replace(component, kind=TargetKind.EXECUTABLE, name=one.executable)

    def _scripts(self) -> Iterable[Target]:
        for one in self._collected.installed:
            if one.kind == "programs" and (path := self.file(one.item, "a program")):
                yield self._script(one, path, one.rename or basename(path))
            elif one.kind == "directory" and self._is_found(one.destination) and not is_unknown(one.destination):
                for path in self._below(one):
                    if splitext(path)[1] in _SCRIPTS:
                        yield self._script(one, path, basename(path))

    def _script(self, one: Installed, path: str, name: str) -> Target:
        evidence, conditions = one.item.evidence, tuple(dict.fromkeys(one.item.conditions))
        found = self._is_found(one.destination)
        return Target(TargetKind.SCRIPT, self._package, name, (path,), evidence, installed=found, conditions=conditions)

    def _below(self, one: Installed) -> list[str]:
        folder = None if "$<" in one.item.text else self._run.relative(one.item.text, one.item.folder)
        if folder is None:
            return []
        prefix = f"{folder}/" if folder else ""
        expressions = [re.compile(re.escape(pattern[:200]).replace(r"\*", "[^/]*")) for pattern in one.only]
        return [
            path
            for path in sorted(self._run.listing)
            if path.startswith(prefix)
            and (not expressions or any(each.fullmatch(basename(path)) for each in expressions))
        ]

    def installs(self) -> list[tuple[str, str]]:
        """Return files and folders of the workspace that are installed, each with where it is then."""
        found: list[tuple[str, str]] = []
        for one in self._collected.installed:
            if is_unknown(one.destination) or is_unknown(one.item.text) or "$<" in one.item.text:
                continue
            path = self._run.relative(one.item.text, one.item.folder)
            if path is None or (path not in self._run.listing and path not in self._run.folders):
                continue
            destination = joined("", one.destination.removeprefix(INSTALL))
            inside = one.kind == "directory" and one.item.text.endswith("/")
            found.append((path, destination if inside else joined(destination, one.rename or basename(path))))
        return found

    def parameters(self) -> list[Generated]:
        """Return the files that declare parameters of which the package generates code."""
        found = (
            (name, self.file(item, "a file of parameters"), python) for name, python, item in self._collected.parameters
        )
        return list(dict.fromkeys(Generated(name, path, python) for name, path, python in found if path))

    def interfaces(self) -> list[str]:
        """Return the files of messages, services and actions that the package generates code of."""
        found = (self.file(item, "an interface") for item in self._collected.interfaces)
        return list(dict.fromkeys(path for path in found if path))


def _joined(how: str, more: str) -> str:
    return more if how == "written" else f"{how}, {more}"


def merged(targets: Iterable[Target]) -> list[Target]:
    """Return targets without those that differ from another in nothing but on which side of a condition they are."""
    found: dict[tuple[object, ...], list[Target]] = {}
    for target in targets:
        group = found.setdefault((target.kind, target.name, target.sources, target.entry, target.library), [])
        for at, other in enumerate(group):
            conditions = _without_choice(other.conditions, target.conditions)
            if conditions is not None:
                installed = other.installed or target.installed
                group[at] = msgspec.structs.replace(other, conditions=conditions, installed=installed)
                break
        else:
            group.append(target)
    return [target for group in found.values() for target in group]


def _without_choice(one: tuple[str, ...], other: tuple[str, ...]) -> tuple[str, ...] | None:
    if one == other:
        return one
    if len(one) == len(other):
        differing = [at for at in range(len(one)) if one[at] != other[at]]
        at = differing[0]
        if len(differing) == 1 and (one[at] == f"NOT ({other[at]})" or other[at] == f"NOT ({one[at]})"):
            return (*one[:at], *one[at + 1 :])
    return None
