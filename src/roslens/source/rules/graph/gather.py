"""What is around a configuration, put together from the workspace that it was assembled from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.source import Package
from roslens.source.extract.facts.launched import Launch, Unresolved
from roslens.source.extract.facts.node_facts import Target
from roslens.source.extract.ir.program import Program
from roslens.source.rules.graph.parameters.ignored_files import ignored_files
from roslens.source.rules.graph.parameters.stamped_command import controllers
from roslens.source.rules.graph.private_data import Content, Mention, mentions
from roslens.source.rules.graph.static_transforms import static_transforms
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.timing.waits import waits

_SOURCES = (".cpp", ".cc", ".cxx", ".c++")


def surroundings_of(
    configuration: Configuration,
    *,
    launch: Launch | None = None,
    given: Mapping[str, str] | None = None,
    packages: Sequence[Package] = (),
    targets: Mapping[str, Sequence[Target]] | None = None,
    unresolved: Iterable[Unresolved] = (),
    paths: Mapping[str, Sequence[str]] | None = None,
    programs: Mapping[str, Program] | None = None,
    options: Mapping[str, Any] | None = None,
    together: bool = True,
    started: bool = False,
    whole: bool = False,
    content: Content | None = None,
    words: Content | None = None,
    noted: list[Mention] | None = None,
) -> Surroundings:
    """Return what the rules of the graph know besides a configuration; what is not given, rules do without.

    Args:
        configuration: what would run together.
        launch: that it was assembled from.
        given: arguments of the launch file.
        packages: of the workspace.
        targets: by package what its build makes.
        unresolved: what of builds could not be evaluated; packages that have such a part are not held to their targets.
        paths: by package its files.
        programs: by path.
        options: what users set in ``[options.graph]``.
        together: whether a launch file says that the nodes run together.
        started: whether somebody says with which arguments the launch file is started.
        whole: whether the user says that nothing else runs beside it.
        content: of a file by its path.
        words: the same where it only counts which words a file has; ``content`` by default.
        noted: is filled with the names that were looked for in files.
    """
    from roslens.source.rules.graph import with_options

    missed = [one.evidence.path for one in unresolved]
    open_packages = {one.name for one in packages if any(_is_in(path, one) for path in missed)}
    installed = {
        package: _names(made, (paths or {}).get(package, ()), configuration.generation)
        for package, made in sorted((targets or {}).items())
        if package not in open_packages
    }
    made_of = {path for every in (targets or {}).values() for one in every for path in one.sources}
    unbuilt = {package: _left((paths or {}).get(package, ()), made_of) for package in installed}
    found = Surroundings(
        tuple(packages),
        installed,
        {package: left for package, left in unbuilt.items() if left},
        dict(given or {}),
        tuple(ignored_files(configuration, launch)) if launch is not None else (),
        tuple(static_transforms(configuration, launch)) if launch is not None else (),
        tuple(waits(programs)) if programs and configuration.generation == "ros2" else (),
        together=together,
        started=started,
        whole=whole,
    )
    found = with_options(found, dict(options or {}))
    if content is None:
        return found
    every = sorted({path for named in (paths or {}).values() for path in named})
    names = mentions(configuration, found, every, content if words is None else words)
    if noted is not None:
        noted.extend(names)
    return msgspec.structs.replace(
        found,
        mentioned=frozenset(one.name for one in names if one.found_in),
        controllers=tuple(controllers(configuration, every, content)),
    )


def _is_in(path: str, package: Package) -> bool:
    return package.path in ("", ".") or path.startswith(f"{package.path}/")


def _left(paths: Sequence[str], made_of: set[str]) -> tuple[str, ...]:
    """Return the sources of C++ that no target is made of."""
    return tuple(sorted(path for path in paths if path.endswith(_SOURCES) and path not in made_of))


def _names(targets: Sequence[Target], paths: Sequence[str], generation: str) -> tuple[str, ...]:
    """Return the names by which something of a package is started or loaded."""
    names = set()
    for one in targets:
        # What catkin builds is found in its development space too, installed or not.
        if one.installed or generation == "ros1":
            names |= {one.name, one.entry, one.name.rpartition("/")[2]}
    if generation == "ros1":
        # roslaunch also finds what lies anywhere in the sources of a package.
        names |= {path.rpartition("/")[2] for path in paths}
    return tuple(sorted(names - {""}))
