"""Rooms of extraction are small, and each says what comes in, what goes out, and where to begin."""

import ast
import re
from pathlib import Path

import pytest

EXTRACT = Path(__file__).parents[2] / "src" / "roslens" / "source" / "extract"
MOST = 25
PASSES = r"In comes? .*; out comes? |come in and go out|other rooms fill|Lowerings make them, the interpreter follows"
ROOMS = sorted(path.parent for path in EXTRACT.rglob("__init__.py") if path.parent != EXTRACT)


def test_no_module_stands_outside_of_a_room():
    assert [path.name for path in EXTRACT.glob("*.py")] == ["__init__.py"]
    assert len(ROOMS) > 15


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.relative_to(EXTRACT).as_posix())
def test_a_room_is_small_and_says_what_it_is(room):
    modules = [path for path in room.glob("*.py") if path.stem != "__init__"]
    assert len(modules) <= MOST
    said = " ".join((ast.get_docstring(ast.parse((room / "__init__.py").read_text())) or "").split())
    if not modules:
        return
    assert re.search(PASSES, said), "what comes in, and what goes out"
    begins = re.findall(r"[Bb]egin with (?:``([\w.]+)``)", said)
    assert begins, "where to begin"
    assert [name for name in begins if not (room / name).is_file()] == []


def test_the_package_names_every_room():
    said = ast.get_docstring(ast.parse((EXTRACT / "__init__.py").read_text()))
    assert {room.name for room in ROOMS if room.parent == EXTRACT} <= set(re.findall(r"``(\w+)``", said))
