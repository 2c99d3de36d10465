"""Rule ``package.program_shebang``: a script that the system cannot start."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

from roslens.model.edit import Edit, edit_at
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.distributions.known_distributions import OLDEST_SUPPORTED, is_at_least
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.cmake_view import Written
from roslens.source.rules.views.python_tree import python_tree

_ID = "package.program_shebang"
_INSTALLS = ("install", "catkin_install_python")
_EXPECTED = "#!/usr/bin/env python3"
_BLANK = re.compile(rb"(?:\xef\xbb\xbf\s*|\s+)(?=#!\s*/)")
_OLD = re.compile(r"python2|\bpython$")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each Python script that is started as a program and whose first line does not name Python 3."""
    installed = dict(_installed(view))
    for path, one in installed.items():
        if not path.endswith("__init__.py"):
            yield from _hits(path, one, view)
    for file in view.of_language(Language.PYTHON, roles=(Role.OWN,)):
        if file.path not in installed and view.package.build_type != "ament_python":
            yield from _late(file.path, view)


def _installed(view: PackageView) -> Iterator[tuple[str, Written]]:
    """Yield the Python scripts that are installed as programs, each with the command that does so."""
    told: set[str] = set()
    for one in view.cmake.named(*_INSTALLS):
        if one.defined or "PROGRAMS" not in one.words:
            continue
        for word in takewhile(_is_no_option, one.words[one.words.index("PROGRAMS") + 1 :]):
            path = view.cmake.inside(word, one)
            file = view.by_path.get(path or "")
            if path is not None and file is not None and file.language is Language.PYTHON and path not in told:
                told.add(path)
                yield path, one


def _is_no_option(word: str) -> bool:
    return word not in ("DESTINATION", "PERMISSIONS", "RENAME")


def _hits(path: str, one: Written, view: PackageView) -> Iterator[Hit]:
    """Yield what is wrong with the first line of a script that a command installs."""
    text = view.read(path)
    first = text[:200].partition(b"\n")[0].decode("utf-8", "replace").strip()
    if not first.startswith("#!"):
        at = f"{one.path}:{one.command.line}"
        is_read = _is_python_3(text)
        expected = _EXPECTED if is_read else "a #! line (Python 3 cannot read it)"
        message = f"{at} installs it as a program, and its first line is {shortened(first, 40)!r}; expected {expected}"
        # A module among the programs is one too many, and nobody starts it.
        certainty = None if b"__main__" in text else Certainty.HEURISTIC
        edits = _begun(text, b"", path) if is_read else ()
        yield Hit(_ID, message, 1, context="#!", path=path, certainty=certainty, edits=edits)
    elif _OLD.search(first) and one.name == "install" and _lacks_it(view):
        yield _old(first, path, one, view)


def _late(path: str, view: PackageView) -> Iterator[Hit]:
    """Yield that a script which may be executed has its `#!` line too late: the kernel looks at the first bytes."""
    text = view.read(path)
    begun = _BLANK.match(text)
    if begun is None or not _may_be_executed(path, view):
        return
    line = text.count(b"\n", 0, begun.end()) + 1
    what = f"line {line}" if line > 1 else "behind a byte order mark"
    message = f"the `#!` stands in {what}, and only the first two bytes of a file count; expected nothing before it"
    yield Hit(_ID, message, 1, context="#!", path=path, edits=(edit_at(text, 0, begun.end(), "", path),))


def _may_be_executed(path: str, view: PackageView) -> bool:
    try:
        return bool(Path(view.root, path).stat().st_mode & 0o111)
    except OSError:
        return False


def _old(first: str, path: str, one: Written, view: PackageView) -> Hit:
    """Return the hit at a first line that names a Python which the distribution does not have."""
    text = view.read(path)
    is_read = _is_python_3(text)
    expected = _EXPECTED if is_read else f"Python 3, which cannot read this one, and {_EXPECTED}"
    where = "distributions of ROS 2 have"
    if 1 in view.ros:
        where = f"Noetic has (install() keeps the line, {one.path}:{one.command.line})"
        expected += ", or catkin_install_python(), which writes the line" if is_read else ""
    message = f"{where} no program for {first!r}; expected {expected}"
    edits = _begun(text, first.encode(), path) if is_read else ()
    return Hit(_ID, message, 1, context="#!", path=path, edits=edits)


def _lacks_it(view: PackageView) -> bool:
    """Return whether what a package is built for has Python 3 alone; a package for both generations is left."""
    if view.ros == frozenset({1}):
        names = view.around.target.of(1) or (OLDEST_SUPPORTED[1],)
        return all(is_at_least(one, "noetic") for one in names)
    return view.ros == frozenset({2})


def _is_python_3(content: bytes) -> bool:
    """Return whether Python 3 can read a script."""
    return python_tree(content) is not None


def _begun(content: bytes, line: bytes, path: str) -> tuple[Edit, ...]:
    """Return what puts the expected line into the place of the first one, or before it."""
    if not content.startswith(line) or content.startswith(b"\xef\xbb\xbf"):
        return ()
    return (edit_at(content, 0, len(line), _EXPECTED + ("" if line else "\n"), path),)


RULE = PackageRule(
    id=_ID,
    title="Script that the system cannot start",
    finds="A Python file that `install(PROGRAMS …)` or `catkin_install_python` installs and that has no `#!` line; "
    "where `install(PROGRAMS …)` keeps it, also one whose line names `python` or `python2`, in packages for ROS 2 and "
    "for Noetic: what a package for ROS 1 is built for where no file says an earlier distribution. "
    "`catkin_install_python` writes the line anew. Likewise a script that may be executed and has blank lines, or a "
    "byte order mark, before its `#!`.",
    why='The kernel takes it for nothing it can run ("Exec format error"), or a shell reads Python: the node does '
    "not start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("python", "install"),
    fix="Writes the first line, or takes away what stands before it. A script that Python 3 cannot read is left.",
    bad="import rclpy\n\n# CMakeLists.txt: install(PROGRAMS scripts/teleop.py DESTINATION lib/${PROJECT_NAME})",
    good="#!/usr/bin/env python3\nimport rclpy",
    found=found,
)
