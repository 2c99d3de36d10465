"""A workspace of the worst shapes: each in a file of its kind, in packages that read them."""

from __future__ import annotations

from pathlib import Path

from shapes.shapes import SHAPES

MANIFEST = (
    '<package format="3"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license>'
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
PARAMETERS = '<launch><rosparam command="load" file="$(find yaml)/config/a{0}.yaml"/></launch>\n'
ROBOT = (
    "<launch><param name='robot_description' command='$(find xacro)/xacro $(find robot)/urdf/a{0}.xacro'/></launch>\n"
)
FILES = {
    "C++": ("src/a{0}.cpp",),
    "Python": ("scripts/a{0}.py",),
    "launch files": ("launch/a{0}.launch", "launch/a{0}.launch.xml"),
    "robot descriptions": ("urdf/a{0}.xacro",),
    "YAML": ("config/a{0}.yaml", "launch/a{0}.launch.yaml"),
    "messages": ("msg/A{0}.msg", "srv/A{0}.srv", "action/A{0}.action"),
}
"""What the shapes of a grammar are written to, in one package each; the others are one file of a package each."""

PACKAGES = {
    "C++": "cpp", "Python": "python", "launch files": "launch", "robot descriptions": "robot", "YAML": "yaml",
    "messages": "messages",
}  # fmt: skip
SINGLE = {"CMake": "CMakeLists.txt", "package.xml": "package.xml", "documents": "CHANGELOG.rst"}
READ_BY = {"YAML": PARAMETERS, "robot descriptions": ROBOT}


def write_shapes(root: Path, size: int) -> dict[str, dict[str, list[str]]]:
    """Write a workspace with shapes of about so many bytes; return the paths by grammar and shape."""
    written: dict[str, dict[str, list[str]]] = {}
    for grammar, shapes in SHAPES.items():
        names = FILES.get(grammar)
        for number, (shape, make) in enumerate(shapes.items()):
            if names is not None:
                package = PACKAGES[grammar]
                paths = [f"{package}/{name.format(number)}" for name in names]
            elif grammar in SINGLE:
                package = f"{SINGLE[grammar].split('.')[0].lower()}{number}"
                paths = [f"{package}/{SINGLE[grammar]}"]
            else:
                continue
            _write(root / package / "package.xml", MANIFEST.format(package).encode())
            if grammar in READ_BY:
                _write(root / f"{package}/launch/b{number}.launch", READ_BY[grammar].format(number).encode())
            for path in paths:
                _write(root / path, make(size))
            written.setdefault(grammar, {})[shape] = paths
    return written


def _write(path: Path, content: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
