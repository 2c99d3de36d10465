"""Databases of all build folders become one, whose commands only shape what code means."""

import json

import pytest

from roslens.source.tools.clang_tidy import refused_by
from roslens.source.tools.compiling.compile_commands import Command, as_json, find_databases, harmless, merged


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
    path = str(root / "src" / "a.cpp")
    assert found.commands[path].arguments == ("clang++", "-DX=a b", path)
    assert len(found.unread) == 1
    written = json.loads(as_json(found.commands, [str(root / "src" / "b.cpp"), "elsewhere"]))
    assert [entry["file"] for entry in written] == [str(root / "src" / "b.cpp")]


def test_a_command_with_an_open_quote_has_no_flags():
    assert harmless(Command("/", "a.cpp", command='c++ "'), "/a.cpp").arguments == ("clang++", "/a.cpp")


@pytest.mark.parametrize(
    ("text", "refused"),
    [
        ("Checks: '*'\n", ""),
        ("ExtraArgs: ['-std=c++17']\n", ""),
        ('ExtraArgs: ["\\x2dfplugin=./evil.so"]\n', "-fplugin=./evil.so"),
        ("ExtraArgsBefore:\n  - -load\n", "-load"),
        ("ExtraArgs: ['-std=c++17', '--amdgpu-arch-tool=./tool.sh', '-Wall']\n", "--amdgpu-arch-tool=./tool.sh"),
        ("ExtraArgs: ['-Wall', '-I']\n", "-I"),
    ],
)
def test_settings_that_do_more_than_shape_code_are_refused(tmp_path, text, refused):
    path = tmp_path / ".clang-tidy"
    path.write_text(text)
    assert refused_by(path) == refused


def test_settings_that_cannot_be_read_are_refused(tmp_path):
    path = tmp_path / ".clang-tidy"
    path.write_text("Checks: [")
    assert refused_by(path)
