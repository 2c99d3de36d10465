"""Folders are small, and each room says what comes in, what goes out, and where to begin."""

import ast
import re
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "src" / "roslens"
MOST = 25
HOUSES = [SOURCE / name for name in ("source/extract", "source/metrics", "cli", "judge", "live", "report")]
"""Packages that are divided into rooms."""

ENTRANCES = {SOURCE / "cli", SOURCE / "source" / "metrics"}
"""Houses with modules of their own beside their rooms."""

PASSES = (
    r"In comes? .*; out comes? |come in[;,]? .*go out|come in and go out|other rooms fill"
    r"|Lowerings make them, the interpreter follows"
)
ROOMS = sorted(path.parent for house in HOUSES for path in house.rglob("__init__.py"))


def modules(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.glob("*.py") if path.stem != "__init__")


def said_by(folder: Path) -> str:
    return " ".join((ast.get_docstring(ast.parse((folder / "__init__.py").read_text())) or "").split())


def test_no_folder_is_crowded():
    folders = {path.parent for path in SOURCE.rglob("*.py")}
    found = {folder.relative_to(SOURCE).as_posix(): len(modules(folder)) for folder in folders}
    crowded = {name: count for name, count in found.items() if count > MOST}
    assert not crowded, f"at most {MOST} modules a folder: put the new one into a room, or divide the folder"


def test_no_module_stands_outside_of_a_room():
    assert {house: bool(modules(house)) for house in HOUSES} == {house: house in ENTRANCES for house in HOUSES}


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.relative_to(SOURCE).as_posix())
def test_a_room_says_what_it_is(room):
    if not modules(room):
        return
    said = said_by(room)
    assert re.search(PASSES, said), "what comes in, and what goes out"
    begins = re.findall(r"[Bb]egin with (?:``([\w.]+)``)", said)
    assert begins, "where to begin"
    assert [name for name in begins if not (room / name).is_file()] == []


@pytest.mark.parametrize("house", HOUSES, ids=lambda house: house.relative_to(SOURCE).as_posix())
def test_a_package_names_every_room(house):
    rooms = {path.parent.name for path in house.glob("*/__init__.py")}
    assert rooms <= set(re.findall(r"``(\w+)``", ast.get_docstring(ast.parse((house / "__init__.py").read_text()))))
