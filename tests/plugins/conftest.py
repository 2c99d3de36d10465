"""Packages for plug-ins to look at."""

from collections.abc import Callable
from pathlib import Path

import pytest

from roslens.model.entity import Entity, EntityKind
from roslens.model.source import Language, Location, Package, Role
from roslens.plugins.discovery import discover
from roslens.plugins.member import Member
from roslens.plugins.points import FileInput, PackageInput

FIXTURES = Path(__file__).parents[1] / "fixtures" / "plugins"
LANGUAGES = {
    ".py": Language.PYTHON,
    ".cpp": Language.CPP,
    ".h": Language.CPP,
    ".xml": Language.MANIFEST,
    ".msg": Language.MSG,
}


@pytest.fixture(scope="session")
def fixtures() -> Path:
    return FIXTURES


@pytest.fixture(scope="session")
def member() -> Callable[..., tuple[Member, ...]]:
    """Return a function that loads plug-ins from the fixtures."""
    loaded: dict[tuple[str, ...], tuple[Member, ...]] = {}

    def load(*names: str) -> tuple[Member, ...]:
        if names not in loaded:
            found = discover(names, base=FIXTURES, search=())
            assert not found.failures, [str(failure) for failure in found.failures]
            loaded[names] = found.members
        return loaded[names]

    return load


@pytest.fixture
def make_package(tmp_path: Path) -> Callable[..., PackageInput]:
    """Return a function that writes files into a package below ``tmp_path`` and describes it."""

    def make(files: dict[str, str | bytes], name: str = "pack", repository: str = "") -> PackageInput:
        folder = tmp_path / name
        inputs = []
        entities = [Entity(id=f"package:{name}", kind=EntityKind.PACKAGE, name=name, path=name)]
        for inner, content in sorted(files.items()):
            path = folder / inner
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
            relative = f"{name}/{inner}"
            language = LANGUAGES.get(path.suffix, Language.OTHER)
            inputs.append(FileInput(relative, str(path), language, Role.OWN, name, b""))
            entities.append(Entity(id=f"file:{relative}", kind=EntityKind.FILE, name=path.name, path=relative))
            entities.append(
                Entity(
                    id=f"function:{relative}#f()",
                    kind=EntityKind.FUNCTION,
                    name="f",
                    path=relative,
                    line=2,
                    end_line=3,
                    parent=f"file:{relative}",
                )
            )
        package = Package(name, name, name, Location(f"{name}/package.xml"), repository=repository)
        return PackageInput(package, str(folder), tuple(inputs), tuple(entities))

    return make
