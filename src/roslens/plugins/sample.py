"""A file or a folder as plug-ins would see it in a run: for the tests of plug-ins.

Files are classified by names alone: what a real run learns from contents (roles, functions, classes) is
left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.model.source import Dependency, Language, Location, Package, Role
from roslens.plugins.points import FileInput, PackageInput, WorkspaceInput

SUFFIXES = {
    ".c": Language.C,
    ".h": Language.CPP,
    ".hh": Language.CPP,
    ".hpp": Language.CPP,
    ".cc": Language.CPP,
    ".cpp": Language.CPP,
    ".cxx": Language.CPP,
    ".py": Language.PYTHON,
    ".cmake": Language.CMAKE,
    ".launch": Language.LAUNCH_XML,
    ".test": Language.LAUNCH_XML,
    ".msg": Language.MSG,
    ".srv": Language.SRV,
    ".action": Language.ACTION,
    ".yaml": Language.YAML,
    ".yml": Language.YAML,
    ".urdf": Language.URDF,
    ".xacro": Language.XACRO,
    ".xml": Language.XML,
}
"""What a file is, by the end of its name."""

ENDINGS = {
    ".launch.py": Language.LAUNCH_PYTHON,
    ".launch.xml": Language.LAUNCH_XML,
    ".launch.yaml": Language.LAUNCH_YAML,
    "package.xml": Language.MANIFEST,
    "CMakeLists.txt": Language.CMAKE,
}
"""Longer ends of names, which count first."""


def language_of(name: str) -> Language:
    """Return what a file is, by its name."""
    for ending, language in ENDINGS.items():
        if name.endswith(ending):
            return language
    return SUFFIXES.get(Path(name).suffix, Language.OTHER)


def sample_workspace(path: Path) -> WorkspaceInput:
    """Return a workspace of one file, or of a folder and the packages in it.

    Folders with ``package.xml`` are packages; a folder without any is one package as a whole.
    """
    if path.is_file():
        return WorkspaceInput(str(path.parent), (_package(path.parent, path.parent, [path]),))
    files = [file for file in sorted(path.rglob("*")) if file.is_file() and "__pycache__" not in file.parts]
    homes = [file.parent for file in files if file.name == "package.xml"] or [path]
    inside: dict[Path, list[Path]] = {home: [] for home in homes}
    for file in files:
        home = next((folder for folder in (file.parent, *file.parents) if folder in inside), None)
        if home is not None:
            inside[home].append(file)
    return WorkspaceInput(str(path), tuple(_package(path, home, found) for home, found in sorted(inside.items())))


def _package(root: Path, home: Path, files: list[Path]) -> PackageInput:
    package = _described(root, home)
    inputs = tuple(
        FileInput(file.relative_to(root).as_posix(), str(file), language_of(file.name), Role.OWN, package.id, b"")
        for file in files
    )
    own = str(EntityId(EntityKind.PACKAGE, package.id))
    entities = (
        Entity(id=own, kind=EntityKind.PACKAGE, name=package.name, path=package.path),
        *(
            Entity(
                id=str(EntityId(EntityKind.FILE, file.path)),
                kind=EntityKind.FILE,
                name=Path(file.path).name,
                path=file.path,
                parent=own,
            )
            for file in inputs
        ),
    )
    return PackageInput(package, str(home), inputs, entities)


def _described(root: Path, home: Path) -> Package:
    path = home.relative_to(root).as_posix()
    manifest = home / "package.xml"
    place = Location((manifest.relative_to(root)).as_posix())
    if not manifest.is_file():
        return Package(home.name or "sample", home.name or "sample", path, place)
    from xml.etree import ElementTree as ET

    try:
        tree = ET.parse(manifest).getroot()  # noqa: S314 - the fixtures of whoever runs the test
    except ET.ParseError:
        return Package(home.name, home.name, path, place)
    name = (tree.findtext("name") or home.name).strip()
    version = (tree.findtext("version") or "").strip()
    return Package(name, name, path, place, version=version, dependencies=tuple(_dependencies(tree, place)))


def _dependencies(tree: object, place: Location) -> Iterator[Dependency]:
    for child in tree:  # type: ignore[attr-defined]
        kind = child.tag.removesuffix("_depend")
        if child.tag == "depend" or kind != child.tag:
            yield Dependency((child.text or "").strip(), kind, place)
