"""From what setup.py, setup.cfg and pyproject.toml say to targets: programs with the module they start."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from posixpath import basename

import msgspec

from roslens.source.extract.builds.python_setup import (
    EntryPoint,
    Setup,
    read_pyproject,
    read_setup_config,
    read_setup_script,
)
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence, Target, TargetKind


def read_setup(folder: str, files: Files, listing: frozenset[str]) -> Setup:
    """Return what all files of a package say of what it installs.

    Args:
        folder: of the package.
        files: that may be read.
        listing: files of the package.
    """
    found: list[Setup] = []
    for name in ("setup.py", "setup.cfg", "pyproject.toml"):
        path = joined(folder, name)
        content = files.content(path) if path in listing else None
        if content is None:
            continue
        if name == "setup.py":
            found.append(read_setup_script(content, path, listing))
        else:
            found.append((read_setup_config if name == "setup.cfg" else read_pyproject)(content, path))
    programs = {one.name: one for setup in reversed(found) for one in setup.programs}
    ordered = dict.fromkeys(one.name for setup in found for one in setup.programs)
    return Setup(
        tuple(programs[name] for name in ordered),
        tuple(script for setup in found for script in setup.scripts),
        tuple(pair for setup in found for pair in setup.data),
        tuple(pair for setup in found for pair in setup.folders),
        next((setup.script_folder for setup in found if setup.script_folder), ""),
        tuple(one for setup in found for one in setup.unresolved),
        tuple(pair for setup in found for pair in setup.parameters),
    )


def setup_targets(
    package: str, folder: str, setup: Setup, listing: frozenset[str], script_folder: str
) -> tuple[list[Target], list[Unresolved]]:
    """Return the programs that a package installs.

    Args:
        package: its name.
        folder: its folder.
        setup: what it says.
        listing: its files.
        script_folder: where programs are installed, ``lib/<package>`` for ``ros2 run`` to find them.
    """
    unresolved = list(setup.unresolved)
    targets: list[Target] = []
    place = joined("", script_folder.replace("$base", "").replace("$prefix", ""))
    found = place == f"lib/{package}"
    for program in setup.programs:
        path = module_file(folder, program.entry.partition(":")[0], dict(setup.folders), listing)
        if path is None:
            unresolved.append(_missing(program))
        evidence = program.evidence if found else _elsewhere(program.evidence, package)
        sources = (path,) if path else ()
        targets.append(
            Target(
                TargetKind.SCRIPT,
                package,
                program.name,
                sources,
                evidence,
                program.entry,
                installed=found,
                elsewhere=not found,
            )
        )
    for name, evidence in setup.scripts:
        path = joined(folder, name)
        if path not in listing:
            unresolved.append(Unresolved(name, evidence, "a script is not among the files of the package"))
            continue
        where = evidence if found else _elsewhere(evidence, package)
        targets.append(
            Target(TargetKind.SCRIPT, package, basename(name), (path,), where, installed=found, elsewhere=not found)
        )
    targets.extend(_data_targets(package, folder, setup, listing))
    return targets, unresolved


def _data_targets(package: str, folder: str, setup: Setup, listing: frozenset[str]) -> Iterator[Target]:
    """Yield the files that are put where programs are looked for, though they are installed as data."""
    for target_folder, names in setup.data:
        if target_folder == f"lib/{package}":
            for path in (joined(folder, name) for name in names):
                if path in listing:
                    evidence = Evidence(joined(folder, "setup.py"), 0, how="installed as data")
                    yield Target(TargetKind.SCRIPT, package, basename(path), (path,), evidence, installed=True)


def _missing(program: EntryPoint) -> Unresolved:
    return Unresolved(program.entry, program.evidence, "the module of a program is not among the files of the package")


def _elsewhere(evidence: Evidence, package: str) -> Evidence:
    return msgspec.structs.replace(evidence, how=f"not installed to lib/{package}")


def module_file(folder: str, module: str, folders: dict[str, str], listing: Iterable[str]) -> str | None:
    """Return the file of a module; None where it is not among the files of the package.

    Args:
        folder: of the package.
        module: with dots.
        folders: in which packages lie, as ``package_dir`` of setuptools.
        listing: files of the package.
    """
    top, _, rest = module.partition(".")
    tops = [folders[top]] if top in folders else []
    ways = [joined(where, rest.replace(".", "/")) for where in tops]
    ways.extend(joined(where, module.replace(".", "/")) for where in (folders.get("", ""), "", "src"))
    for way in ways:
        for end in (".py", "/__init__.py"):
            path = joined(folder, way + end)
            if path in listing:
                return path
    return None
