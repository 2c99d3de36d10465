"""Build a package of interfaces with the wheels of rosidl and a C compiler, where no ROS 2 with ament is.

Run by the Python in which the wheels are: ``python build_messages.py PACKAGE TARGET [HELD ...]``, with the packages
whose messages the interfaces hold, if they are others than those of ``HELD``. Afterwards ``TARGET/python`` holds the
Python package, whose libraries are found from there. The generators are those that ament calls; what ament itself does,
installing and telling CMake of it, is left out.
"""

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
from rosidl_adapter.action import convert_action_to_idl
from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_adapter.srv import convert_srv_to_idl
from rosidl_generator_c.cli import GenerateC
from rosidl_generator_py.cli import GeneratePython
from rosidl_generator_type_description.cli import HashTypeDescription
from rosidl_typesupport_c.cli import GenerateCTypesupport
from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport

PREFIX = Path(sys.prefix)
HELD = ("std_msgs", "builtin_interfaces")
"""Packages whose messages the messages hold."""
FORMS = {"msg": convert_msg_to_idl, "srv": convert_srv_to_idl, "action": convert_action_to_idl}
C, PYTHON = "rosidl_generator_c", "rosidl_generator_py"
ANY, FAST = "rosidl_typesupport_c", "rosidl_typesupport_fastrtps_c"
FLAGS = ["-O0", "-fPIC", "-shared", "-w", "-Wl,-rpath,$ORIGIN:$ORIGIN/../../lib"]


def generate(package: Path, target: Path, held: tuple[str, ...] = HELD) -> None:
    """Write C and Python of every interface of a package."""
    name = package.name
    code, python, idl = target / "code" / name, target / "python" / name, target / "idl" / name
    names = [file.relative_to(package) for form in FORMS for file in sorted(package.glob(f"{form}/*.{form}"))]
    for file in names:
        FORMS[file.parent.name](package, name, file, idl / file.parent)
    given = {
        "package_name": name,
        "interface_files": [f"{idl}:{file.with_suffix('.idl')}" for file in names],
        "include_paths": [f"{PREFIX / 'share' / one}" for one in held],
    }
    hashes = HashTypeDescription("hash").generate_type_hashes(**given, output_path=code)
    GenerateC("c").generate(**given, output_path=code, type_description_files=hashes)
    GenerateFastRTPSCTypesupport("fast").generate(**given, output_path=code)
    GenerateCTypesupport("any", typesupport_implementations=[FAST]).generate(**given, output_path=code)
    GeneratePython("python", typesupport_implementations=[ANY]).generate(**given, output_path=python)
    (python / "__init__.py").touch()


def compile_all(name: str, target: Path, held: tuple[str, ...] = HELD) -> None:
    """Make the libraries that the Python package loads."""
    code, python, lib = target / "code" / name, target / "python" / name, target / "lib"
    lib.mkdir()
    folders = [target / "code", sysconfig.get_paths()["include"], np.get_include()]
    folders += [*sorted((PREFIX / "include").iterdir()), PREFIX / "include"]
    around = [*(f"-I{folder}" for folder in folders), f"-L{lib}", f"-L{PREFIX / 'lib'}"]

    def link(out: Path, sources: list[Path], *needs: str) -> None:
        words = ["g++" if any(one.suffix == ".cpp" for one in sources) else "gcc", *FLAGS, *around, "-o", str(out)]
        subprocess.run([*words, *map(str, sources), *(f"-l{one}" for one in needs)], check=True)

    def of_held(part: str) -> list[str]:
        return [f"{one}__{part}" for one in held]

    def own(part: str) -> Path:
        return lib / f"lib{name}__{part}.so"

    link(own(C), sorted(code.glob("*/detail/*.c")), "rosidl_runtime_c", "rcutils", *of_held(C), *of_held(ANY))
    fast = sorted(code.glob("*/detail/*__type_support_c.cpp"))
    link(own(FAST), fast, f"{name}__{C}", *of_held(FAST), FAST, "rosidl_typesupport_fastrtps_cpp", "fastcdr")
    link(own(ANY), sorted(code.glob("*/*__type_support.cpp")), f"{name}__{C}", f"{name}__{FAST}", ANY)
    link(own(PYTHON), sorted(python.glob("*/*_s.c")), f"{name}__{C}", *of_held(PYTHON))
    module = python / f"{name}_s__{ANY}.so"
    link(module, sorted(python.glob("_*.c")), f"{name}__{PYTHON}", f"{name}__{ANY}", f"{name}__{C}", *of_held(ANY))


if __name__ == "__main__":
    os.environ["AMENT_PREFIX_PATH"] = str(PREFIX)
    package, target = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    held = tuple(sys.argv[3:]) or HELD
    generate(package, target, held)
    compile_all(package.name, target, held)
