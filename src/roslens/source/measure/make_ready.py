"""What all packages need, imported and made before there is one: by workers that wait for work anyway."""

from __future__ import annotations

from pathlib import Path

import msgspec

from roslens.model.source import Language, Location, Package, SourceFile
from roslens.source.keys import content_hash
from roslens.source.measure.finished_package import Finishing, finish_packed
from roslens.source.measure.package_task import package_task
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import FoundPackage

_MANIFEST = b"""\
<package format="3"><name>a</name><version>1.0.0</version><description>a</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>
"""
_LAUNCH = b"""\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package="a", executable="a")])
"""
_CMAKE = b"""\
project(a)
find_package(b)
rosidl_generate_interfaces(a msg/A.msg)
add_executable(a a.cpp)
install(TARGETS a DESTINATION a)
ament_package()
"""
_FILES = {
    "a.cpp": (Language.CPP, b"#include <vector>\nclass A { public: int a(int b) { return b ? 1 : 2; } };\n"),
    "a.py": (Language.PYTHON, b"class A:\n    def a(self, b):\n        return 1 if b else 2\n"),
    "CMakeLists.txt": (Language.CMAKE, _CMAKE),
    "launch/a.launch.py": (Language.PYTHON, _LAUNCH),
    "launch/a.launch": (Language.LAUNCH_XML, b'<launch><node pkg="a" exec="a" name="a"/></launch>\n'),
    "msg/A.msg": (Language.MSG, b"int32 a\n"),
    "package.xml": (Language.MANIFEST, _MANIFEST),
}


_SETUP = b"from setuptools import setup\nsetup(name='a', entry_points={'console_scripts': ['a = a.a:main']})\n"


def make_ready() -> None:
    """Measure and finish a package that is no file: what that needs is there for those that come."""
    from roslens.source.extract.builds.python_setup import read_setup_script
    from roslens.source.extract.builds.python_setup_targets import read_setup
    from roslens.source.extract.facts.files import FolderFiles
    from roslens.source.extract.launch.launch_markup import actions_of

    read_setup("", FolderFiles(Path(), {}), frozenset())
    actions_of("a.launch.py", _LAUNCH, FolderFiles(Path(), {}))
    read_setup_script(_SETUP, "setup.py", frozenset())
    settings = SourceSettings()
    package = Package("a", "a", ".", Location("package.xml"), build_type="ament_cmake")
    files = tuple(
        SourceFile(path, language, size=len(content), content_hash=content_hash(content))
        for path, (language, content) in _FILES.items()
    )
    texts = {path: content for path, (_, content) in _FILES.items()}
    task = package_task(FoundPackage(package, "", ()), files, (), root="", settings=settings, kept="", texts=texts)
    pack = msgspec.msgpack.encode
    finish_packed(pack(Finishing(settings, ())), pack(()), pack(task))
