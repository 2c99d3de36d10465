"""Databases of all build folders become one, in which nothing loads code into the compiler."""

import json

import pytest

from roslens.source.tools.clang_tidy import loaded_by
from roslens.source.tools.compile_commands import Command, as_json, find_databases, harmless, merged


def database(path, *entries):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(entries))
    return path


def test_those_of_all_packages_are_found_and_joined(tmp_path):
    root = tmp_path
    one = {"directory": str(root / "src"), "command": "c++ -DX='a b' -c a.cpp", "file": "a.cpp"}
    two = {"directory": str(root / "build"), "arguments": ["c++", "-c", "../src/b.cpp"], "file": "../src/b.cpp"}
    database(root / "build" / "arm" / "compile_commands.json", one)
    database(root / "build" / "leg" / "compile_commands.json", two, {**one, "command": "other"})
    database(root / "build" / "bad" / "compile_commands.json")
    (root / "build" / "bad" / "compile_commands.json").write_text("{")
    found = merged(find_databases(str(root)))
    assert sorted(found.commands) == [str(root / "src" / "a.cpp"), str(root / "src" / "b.cpp")]
    assert found.commands[str(root / "src" / "a.cpp")].arguments == ("c++", "-DX=a b", "-c", "a.cpp")
    assert len(found.unread) == 1
    written = json.loads(as_json(found.commands, [str(root / "src" / "b.cpp"), "elsewhere"]))
    assert [entry["file"] for entry in written] == [str(root / "src" / "b.cpp")]


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ("c++ -fplugin=./evil.so -c a.cpp", "c++ -c a.cpp"),
        ("c++ -Xclang -load -Xclang ./evil.so -c a.cpp", "c++ -c a.cpp"),
        ("c++ -fpass-plugin=evil.so -specs=evil.specs -c a.cpp", "c++ -c a.cpp"),
        ("c++ @response -c a.cpp", "c++ -c a.cpp"),
        ("c++ -B ./tools -c a.cpp", "c++ -c a.cpp"),
        ("c++ -Xclang -Wall -O2 -I/opt/ros -c a.cpp", "c++ -Xclang -Wall -O2 -I/opt/ros -c a.cpp"),
    ],
)
def test_what_loads_code_is_left_out(given, kept):
    assert " ".join(harmless(Command("/", "a.cpp", command=given), "/a.cpp").arguments) == kept


def test_a_command_with_an_open_quote_is_empty():
    assert harmless(Command("/", "a.cpp", command='c++ "'), "/a.cpp").arguments == ()


@pytest.mark.parametrize(
    ("text", "loads"),
    [
        ("Checks: '*'\n", ""),
        ("ExtraArgs: ['-std=c++17']\n", ""),
        ('ExtraArgs: ["\\x2dfplugin=./evil.so"]\n', "-fplugin=./evil.so"),
        ("ExtraArgsBefore:\n  - -load\n", "-load"),
    ],
)
def test_settings_that_load_code_are_told(tmp_path, text, loads):
    path = tmp_path / ".clang-tidy"
    path.write_text(text)
    assert loaded_by(path) == loads


def test_settings_that_cannot_be_read_are_not_trusted(tmp_path):
    path = tmp_path / ".clang-tidy"
    path.write_text("Checks: [")
    assert loaded_by(path)
