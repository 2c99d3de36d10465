"""Libraries of Python that sources import, and that only a key of rosdep or a list for pip installs.

The keys are those of rosdep's python.yaml. Libraries that every installation of ROS brings, such as NumPy and PyYAML,
are left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import basename, dirname

import msgspec

from roslens.model.source import Language, Role
from roslens.source.rules.views.package_files import PackageFiles


class Library(msgspec.Struct, frozen=True):
    """A library.

    Attributes:
        key: of rosdep.
        signs: parts of a declared key, or of a line of a list for pip, that say that it is there.
    """

    key: str
    signs: tuple[str, ...]


_KEYS = {
    "serial": ("python3-serial", "serial"),
    "cv2": ("python3-opencv", "opencv", "cv_bridge", "image_pipeline", "image_geometry", "perception"),
    "scipy": ("python3-scipy", "scipy", "sklearn", "scikit"),
    "matplotlib": ("python3-matplotlib", "matplotlib", "rqt_plot", "seaborn"),
    "PIL": ("python3-pil", "pil", "imaging"),
    "requests": ("python3-requests", "requests"),
    "transforms3d": ("python3-transforms3d", "transforms3d", "tf_transformations"),
    "smbus": ("python3-smbus", "smbus"),
    "pandas": ("python3-pandas", "pandas"),
    "sklearn": ("python3-sklearn", "sklearn", "scikit-learn"),
    "networkx": ("python3-networkx", "networkx"),
    "shapely": ("python3-shapely", "shapely"),
    "flask": ("python3-flask", "flask"),
    "websockets": ("python3-websockets", "websockets"),
    "websocket": ("python3-websocket", "websocket"),
    "zmq": ("python3-zmq", "zmq"),
    "paho": ("python3-paho-mqtt", "paho"),
    "usb": ("python3-usb", "usb"),
    "can": ("python3-can", "can"),
    "pygame": ("python3-pygame", "pygame"),
    "sympy": ("python3-sympy", "sympy"),
    "psutil": ("python3-psutil", "psutil"),
    "tkinter": ("python3-tk", "tk"),
    "gpiozero": ("python3-gpiozero", "gpiozero"),
    "evdev": ("python3-evdev", "evdev"),
    "tornado": ("python3-tornado", "tornado", "rosbridge"),
    "pyproj": ("python3-pyproj", "pyproj"),
}
LIBRARIES = {module: Library(key, tuple(signs)) for module, (key, *signs) in _KEYS.items()}
"""By the module that is imported."""

_LISTS = ("requirements.txt", "setup.py", "setup.cfg", "pyproject.toml", "environment.yml", "environment.yaml")
_AROUND = ("requirements.txt", "Dockerfile", "environment.yml", "docker/Dockerfile", ".devcontainer/Dockerfile")
"""Files above a package that install what its imports need."""


def libraries_of(view: PackageFiles) -> Iterator[tuple[str, str, str, int]]:
    """Yield each library that a package imports, wherever it runs: module, key, path and line.

    What stands in a block, such as a ``try``, is not asked for: there the package may do without. Nor is what a list
    for pip has, or a module that the package carries itself.
    """
    wanted = {
        name: (path, line)
        for path, facts in sorted(view.facts.items(), reverse=True)
        if facts.syntax == "python" and _counts(path, view)
        for written, line in reversed(facts.includes)
        if (name := written.partition(".")[0]) in LIBRARIES and _is_at_top(view.read(path), line)
    }
    if not wanted:
        return
    listed = [text for path in _lists(view) if (text := view.read(path).decode("utf-8", "replace").lower())]
    own = {part for path in view.listing for part in path.removesuffix(".py").split("/")}
    for name, (path, line) in sorted(wanted.items(), key=lambda one: one[1]):
        library = LIBRARIES[name]
        if name not in own and not any(sign in text for sign in library.signs for text in listed):
            yield name, library.key, path, line


def _counts(path: str, view: PackageFiles) -> bool:
    file = view.by_path.get(path)
    return file is not None and file.role is Role.OWN and file.language is Language.PYTHON and _is_for_running(path)


def _is_for_running(path: str) -> bool:
    name = basename(path)
    aside = {"test", "tests", "examples", "docs", "doc", "tools", "utils_dev"}
    return name not in ("setup.py", "conf.py") and not aside & set(dirname(path).split("/"))


def _is_at_top(content: bytes, line: int) -> bool:
    lines = content.splitlines()
    return 0 < line <= len(lines) and lines[line - 1].startswith((b"import ", b"from "))


def _lists(view: PackageFiles) -> Iterator[str]:
    for inside in sorted(view.listing):
        if basename(inside) in _LISTS or (basename(inside).startswith("requirements") and inside.endswith(".txt")):
            yield view.path(inside)
    above = view.folder
    while above:
        above = dirname(above)
        yield from (f"{above}/{name}" if above else name for name in _AROUND)
