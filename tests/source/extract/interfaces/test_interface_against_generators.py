"""Mutated interface files: what has a sum or hash here has the same one by ROS' own generators, and never another."""

import json
import os
import random
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from roslens.source.extract.interfaces.interface import Interface
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_of
from roslens.source.extract.interfaces.type_hash import type_hash

ROS1 = Path("/usr/share/std_msgs")
ROS1_PYTHON = Path("/usr/bin/python3")
ROS2 = Path(__file__).parents[4] / "build" / "ros2"
FIXTURES = Path(__file__).parents[3] / "fixtures" / "extract" / "interfaces"
NESTED = ("Nested", "Empty")
PIECES = [
    "#", "=", "---", "[]", "[3]", "[<=3]", "<=5", "int32", "string", "wstring", "float64", "Header", "Nested", "a/B",
    "time", "bool", "x", "NAME", "1", "-1", "1.5", "true", "'a'", "é", "uint8", "X=1", "[1]", "Nested[]",
    "", "", "", " ", "  ", "\t", "\n", "\n#", "\r\n", "\r", "\f", "\u2028",
]  # fmt: skip

ASK_GENMSG = """
import json, sys
from genmsg import MsgContext, compute_md5, load_depends
from genmsg.msg_loader import load_msg_from_string, load_srv_from_string
own, std = sys.argv[1:]
search = {"m": [own], "test_interfaces1": [own], "std_msgs": [std + "/msg"]}
answers = []
for name, text in json.load(sys.stdin):
    text = text.replace("\\r\\n", "\\n").replace("\\r", "\\n")
    context = MsgContext.create_default()
    try:
        load = load_msg_from_string if name.endswith("msg") else load_srv_from_string
        spec = load(context, text, "m/" + name.split(".")[0])
        load_depends(context, spec, search)
        answers.append(compute_md5(context, spec))
    except Exception:
        answers.append(None)
json.dump(answers, sys.stdout)
"""
ASK_ROSIDL = """
import contextlib, io, json, sys, tempfile
from pathlib import Path
from rosidl_adapter import convert_to_idl
from rosidl_generator_type_description import (
    add_action, add_msg, add_srv, calculate_type_hash, extract_full_type_description,
    serialize_individual_type_description,
)
from rosidl_parser.definition import Action, IdlLocator, Message, Service
from rosidl_parser.parser import parse_idl_file
own, share = map(Path, sys.argv[1:])
known = {}
for path in share.glob("*/msg/*.json"):
    one = json.loads(path.read_text())["type_description_msg"]["type_description"]
    known[one["type_name"]] = one
def described(package, folder, name):
    with tempfile.TemporaryDirectory() as output:
        stem, kind = name.split(".")
        convert_to_idl(folder, package, Path(name), Path(output))
        content = parse_idl_file(IdlLocator(Path(output), Path(kind) / (stem + ".idl"))).content
    found = {}
    for add, type_ in ((add_msg, Message), (add_srv, Service), (add_action, Action)):
        for one in content.get_elements_of_type(type_):
            add(one, found)
    describe = serialize_individual_type_description
    return {name: describe(one.namespaced_type, one.members) for name, one in found.items()}
answers = []
with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
    for package in ("m", "test_interfaces"):
        known.update(described(package, own, "Nested.msg"))
        known.update(described(package, own, "Empty.msg"))
    for name, text in json.load(sys.stdin):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / name).write_bytes(text.encode())
            try:
                found = {**known, **described("m", Path(folder), name)}
                full_name = "m/{1}/{0}".format(*name.split("."))
                answers.append(calculate_type_hash(extract_full_type_description(full_name, found)))
            except Exception:
                answers.append(None)
json.dump(answers, sys.stdout)
"""


def mutated(folder: str, number: int, kinds: tuple[str, ...]) -> list[tuple[str, str]]:
    """Return names and texts: some lines of a fixture with some pieces put in or taken out."""
    chance = random.Random(5)
    seeds = [path for path in sorted((FIXTURES / folder).iterdir()) if path.suffix in kinds and path.stem not in NESTED]
    found = []
    for _ in range(number):
        path = chance.choice(seeds)
        lines = path.read_text().split("\n")
        if path.suffix == ".msg":
            start = chance.randrange(len(lines) - 3)
            lines = lines[start : start + 4]
        text = "\n".join(lines)
        for _ in range(chance.choice([1, 1, 1, 2, 3])):
            place, length = chance.randrange(len(text) + 1), chance.choice([0, 0, 1, 2, 5])
            text = text[:place] + chance.choice(PIECES) + text[place + length :]
        found.append((path.name, text))
    return found


def answers_of(python: Path, program: str, files: list[tuple[str, str]], *arguments: Path) -> list[str | None]:
    """Return what the generators say of ``files``."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    command = [python, "-c", program, *arguments]
    done = subprocess.run(
        command, input=json.dumps(files), capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def known(generation: int, *folders: tuple[str, Path]) -> dict[str, Interface]:
    """Return the messages in ``folders``, each with the package that they are taken for."""
    found = {}
    for package, folder in folders:
        for path in folder.glob("*.msg"):
            interface, _ = read_interface(path.read_bytes(), path.name, package, generation)
            found[interface.full_name] = interface
    return found


@pytest.mark.real
@pytest.mark.skipif(not ROS1.exists(), reason="no interface of ROS 1 is installed")
def test_genmsg():
    own = FIXTURES / "ros1"
    files = mutated("ros1", 4000, (".msg", ".srv"))
    lookup = known(1, ("m", own), ("test_interfaces1", own), ("std_msgs", ROS1 / "msg")).get
    outcomes = Counter()
    for (name, text), expected in zip(files, answers_of(ROS1_PYTHON, ASK_GENMSG, files, own, ROS1), strict=True):
        interface, failures = read_interface(text.encode(), name, "m", 1)
        found = md5_of(interface, lookup)
        assert not found or found.text == expected, (name, text, expected)
        if expected and not found:
            # genmsg lets constants pass whose names no language can take.
            assert all(failure.what.startswith("name ") for failure in failures), (name, text)
        outcomes[bool(found), bool(expected)] += 1
    assert outcomes[True, True] > 1000
    assert outcomes[False, True] < 50


@pytest.mark.real
@pytest.mark.skipif(not (ROS2 / "share").exists(), reason="no interface of ROS 2 is installed: make parts")
def test_rosidl():
    own = FIXTURES / "ros2"
    files = mutated("ros2", 250, (".msg", ".srv", ".action"))
    needed = ("builtin_interfaces", "service_msgs", "unique_identifier_msgs")
    folders = [(package, ROS2 / "share" / package / "msg") for package in needed]
    lookup = known(2, ("m", own), ("test_interfaces", own), *folders).get
    answers = answers_of(ROS2 / "bin" / "python", ASK_ROSIDL, files, own, ROS2 / "share")
    outcomes = Counter()
    for (name, text), expected in zip(files, answers, strict=True):
        found = type_hash(read_interface(text.encode(), name, "m", 2)[0], lookup)
        assert found.text == (expected or ""), (name, text, found.unknown)
        outcomes[bool(found)] += 1
    assert outcomes[True] > 25
    assert outcomes[False] > 50
