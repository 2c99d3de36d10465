"""Every interface that is installed: sums and hashes against those that ROS itself made of them.

What no installed interface holds (actions of ROS 2, bounded texts, defaults) is held against ROS' own generators.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from roslens.source.extract.interfaces.interface import Interface
from roslens.source.extract.interfaces.interface_derived import ros1_messages
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_of, md5_sums
from roslens.source.extract.interfaces.type_hash import type_hashes

ROS1 = Path("/usr/share")
ROS1_PYTHON = Path("/usr/bin/python3")
ROS2 = Path(__file__).parents[4] / "build" / "ros2"
FIXTURES = Path(__file__).parents[3] / "fixtures" / "extract" / "interfaces"
KINDS = ("msg", "srv", "action")

ASK_CLASSES = """
import importlib, json, sys
import genpy
found = {}
for package in sys.argv[1:]:
    for kind in ("msg", "srv"):
        try:
            module = importlib.import_module(package + "." + kind)
        except ImportError:
            continue
        for value in vars(module).values():
            if hasattr(value, "_md5sum") and hasattr(value, "_type"):
                place = "msg" if issubclass(value, genpy.Message) else "srv"
                found[value._type.replace("/", "/" + place + "/")] = value._md5sum
json.dump(found, sys.stdout)
"""
ASK_GENMSG = """
import json, sys
from genmsg import MsgContext, compute_md5, load_depends, load_msg_by_type, load_srv_by_type
package, folder, *files = sys.argv[1:]
search = {package: [folder], "std_msgs": ["/usr/share/std_msgs/msg"]}
found = {}
for name in files:
    name, _, kind = name.partition(".")
    context = MsgContext.create_default()
    spec = (load_msg_by_type if kind == "msg" else load_srv_by_type)(context, package + "/" + name, search)
    load_depends(context, spec, search)
    found["%s/%s/%s" % (package, kind, name)] = compute_md5(context, spec)
json.dump(found, sys.stdout)
"""
ASK_ROSIDL = """
import contextlib, io, json, pathlib, sys
from rosidl_adapter import convert_to_idl
from rosidl_generator_type_description import generate_type_hash
package, source, output, share, *files = sys.argv[1:]
output = pathlib.Path(output)
tuples = []
with contextlib.redirect_stdout(io.StringIO()):
    for name in files:
        name = pathlib.Path(name)
        kind = name.suffix[1:]
        convert_to_idl(pathlib.Path(source), package, name, output / "idl")
        tuples.append("%s:%s" % (output / "idl", pathlib.Path(kind) / (name.stem + ".idl")))
    arguments = output / "arguments.json"
    needed = ["builtin_interfaces", "service_msgs", "unique_identifier_msgs"]
    arguments.write_text(json.dumps({
        "package_name": package, "output_dir": str(output), "idl_tuples": tuples,
        "include_paths": ["%s:%s/%s" % (one, share, one) for one in needed],
    }))
    generated = generate_type_hash(str(arguments))
found = {}
for path in generated:
    for one in json.loads(path.read_text())["type_hashes"]:
        found[one["type_name"]] = one["hash_string"]
json.dump(found, sys.stdout)
"""


def answer_of(python: Path, program: str, *arguments: str) -> dict[str, str]:
    """Return what a program that runs where ROS is prints."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run(
        [python, "-c", program, *arguments], capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def read(path: Path, package: str, generation: int) -> Interface:
    """Return the interface in a file that has no fault."""
    interface, failures = read_interface(path.read_bytes(), path.name, package, generation)
    assert not failures, [str(failure) for failure in failures]
    return interface


def installed(share: Path, generation: int) -> dict[str, Interface]:
    """Return all interfaces below ``share`` by full name."""
    paths = [path for kind in KINDS for path in sorted(share.glob(f"*/{kind}/*.{kind}"))]
    found = [read(path, path.parts[-3], generation) for path in paths]
    return {interface.full_name: interface for interface in found}


@pytest.fixture(scope="module")
def ros1() -> dict[str, Interface]:
    found = installed(ROS1, 1)
    if not found:
        pytest.skip("no interface of ROS 1 is installed")
    return found


@pytest.fixture(scope="module")
def ros2() -> dict[str, Interface]:
    found = installed(ROS2 / "share", 2)
    if not found:
        pytest.skip("no interface of ROS 2 is installed: make parts")
    return found


@pytest.mark.real
def test_every_sum_of_ros_1(ros1, capsys):
    expected = answer_of(ROS1_PYTHON, ASK_CLASSES, *sorted({interface.package for interface in ros1.values()}))
    sums = {}
    for interface in ros1.values():
        for name, checksum in md5_sums(interface, ros1.get).items():
            assert checksum, checksum.unknown
            assert sums.setdefault(name, checksum.text) == checksum.text
    assert len(expected) >= 200
    assert {name: sums.get(name) for name in expected} == expected
    with capsys.disabled():
        sys.stdout.write(f"\n{len(expected)} sums of ROS 1 agree, of {len(ros1)} files\n")


@pytest.mark.real
def test_messages_of_actions_are_those_that_were_generated(ros1):
    for interface in [one for one in ros1.values() if one.kind == "action"]:
        derived = ros1_messages(interface)
        assert len(derived) == 7
        for message in derived:
            assert md5_of(message, ros1.get) == md5_of(ros1[message.full_name], ros1.get)


@pytest.mark.real
def test_every_hash_of_ros_2(ros2, capsys):
    expected = {}
    for path in sorted((ROS2 / "share").glob("*/*/*.json")):
        if path.parts[-2] in KINDS:
            for one in json.loads(path.read_bytes())["type_hashes"]:
                expected[one["type_name"]] = one["hash_string"]
    found = {}
    for interface in ros2.values():
        for name, checksum in type_hashes(interface, ros2.get).items():
            assert checksum, checksum.unknown
            found[name] = checksum.text
    assert len(found) >= 150
    assert found == expected
    with capsys.disabled():
        sys.stdout.write(f"\n{len(found)} hashes of ROS 2 agree, of {len(ros2)} files\n")


@pytest.mark.real
def test_sums_of_what_can_be_written_in_ros_1(ros1):
    paths = [path for path in sorted((FIXTURES / "ros1").iterdir()) if path.suffix != ".action"]
    expected = answer_of(
        ROS1_PYTHON, ASK_GENMSG, "test_interfaces1", str(FIXTURES / "ros1"), *(path.name for path in paths)
    )
    own = {one.full_name: one for one in (read(path, "test_interfaces1", 1) for path in paths)}
    assert {name: md5_of(one, {**ros1, **own}.get).text for name, one in own.items()} == expected


@pytest.mark.real
def test_hashes_of_what_can_be_written_in_ros_2(ros2, tmp_path):
    paths = sorted((FIXTURES / "ros2").iterdir())
    expected = answer_of(
        ROS2 / "bin" / "python",
        ASK_ROSIDL,
        "test_interfaces",
        str(FIXTURES / "ros2"),
        str(tmp_path),
        str(ROS2 / "share"),
        *(path.name for path in paths),
    )
    own = {one.full_name: one for one in (read(path, "test_interfaces", 2) for path in paths)}
    found = {}
    for interface in own.values():
        for name, checksum in type_hashes(interface, {**ros2, **own}.get).items():
            assert checksum, checksum.unknown
            found[name] = checksum.text
    assert len(found) > 30
    assert found == {name: text for name, text in expected.items() if name.startswith("test_interfaces/")}
