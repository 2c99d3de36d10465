"""What is read of ``.cfg`` files beside what the generator of dynamic_reconfigure makes of them."""

import json
import subprocess
from pathlib import Path

import pytest

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.overlays.ros.reconfigure_file import read_reconfigure_file

ROOT = Path(__file__).parents[5]
PYTHON, GENERATOR = Path("/usr/bin/python3"), Path("/usr/lib/python3/dist-packages/dynamic_reconfigure")
SOURCE = ROOT / "build" / "ros_source"
GENERATE = """
import json, runpy, sys
import dynamic_reconfigure.parameter_generator_catkin as made
def generate(self, package, node, name):
    fields = ("name", "type", "default", "min", "max", "description")
    print(json.dumps([package, name, [[one[field] for field in fields] for one in self.group.get_parameters()]]))
    return 0
made.ParameterGenerator.generate = generate
path = sys.argv[1]
sys.argv = [path, *[""] * 4]
runpy.run_path(path, run_name="__main__")
"""
TYPES = {"str": "string"}
OWN = """
from dynamic_reconfigure.parameter_generator_catkin import *
from math import pi
gen = ParameterGenerator()
speeds = gen.enum([gen.const("slow", int_t, 0, "a"), gen.const("fast", int_t, 1, "b")], "c")
tab = gen.add_group("Outer", type="tab")
inner = tab.add_group("Inner", state=False)
for number, side in enumerate(("left", "right")):
    inner.add("%s_%d" % (side, number), double_t, number, "The " + side, pi / (number + 1), -pi, 2 * pi)
tab.add("speed", int_t, 1 << 2, "Of it", default=1, max=1, edit_method=speeds)
gen.add("name", str_t, 0, "A name")
gen.add("on", bool_t, 0, "Whether", default=True)
gen.add("nothing", double_t, 0, "No default")
exit(gen.generate("pkg", "node", "Own"))
"""

pytestmark = [
    pytest.mark.real,
    pytest.mark.skipif(not GENERATOR.is_dir(), reason="dynamic_reconfigure of ROS 1 is not installed"),
]


def made_of(path):
    done = subprocess.run([PYTHON, "-c", GENERATE, path], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    package, name, parameters = json.loads(done.stdout)
    return package, name, sorted(map(as_said, parameters))


def as_said(parameter):
    """Return a parameter of the generator in the words of ours."""
    name, kind, default, least, most, description = parameter
    text = {"bool": str(default).lower(), "double": repr(float(default)) if kind == "double" else ""}.get(
        kind, str(default)
    )
    ends = [end_as_said(one, kind) for one in (least, most)]
    return name, TYPES.get(kind, kind), text, "..".join(ends) if any(ends) else "", description


def end_as_said(end, kind):
    none = kind not in ("int", "double") or "infinity" in str(end) or end in (-0x80000000, 0x7FFFFFFF)
    return "" if none else repr(float(end)) if kind == "double" else str(end)


def read(content):
    index = indexed({"pkg/cfg/A.cfg": program_of_python(content)})
    (file,) = read_reconfigure_file(index, "pkg/cfg/A.cfg")
    assert file.whole
    found = [(one.name.known, one.type, one.default.known, one.range, one.description) for one in file.declarations]
    return file.package, file.name, sorted(found)


def test_groups_loops_and_what_is_left_out(tmp_path):
    path = tmp_path / "Own.cfg"
    path.write_text(OWN)
    assert read(OWN.encode()) == made_of(path)


@pytest.mark.skipif(not SOURCE.is_dir(), reason="no source of ROS 1 from Debian: make parts")
def test_files_of_debian():
    files = sorted(SOURCE.rglob("cfg/*.cfg"))
    for path in files:
        assert read(path.read_bytes()) == made_of(path), path
