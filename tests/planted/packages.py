"""Packages that break a rule on packages, written in other ways and with real files beside what is wrong.

What is wrong comes from the fixtures of the rule; its name, the layout of its CMake and XML, the ends of its lines and
the folder it lies in change from variant to variant, and real sources that nothing builds lie in it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from random import Random

_NAMES = ("gripper_driver", "lidar_tools", "base_control", "arm_planner", "dock_server")
_TEXTS = (".xml", ".launch", ".txt", ".cmake", ".py", ".cfg", ".yaml", ".cpp", ".hpp", ".h", ".msg", ".srv", ".md")
_CMAKE = re.compile(r"^([ \t]*)([A-Za-z_]\w*)[ \t]*\(", re.MULTILINE)
_MEAN_SOMETHING = frozenset({"home", "native", "test", "tests", "template", "absolute", "machine", "todo"})


def broken_packages(fixtures: Path) -> list[tuple[Path, int]]:
    """Return the packages of a rule's fixtures that break it, each with how often."""
    found = []
    for marks in sorted(fixtures.glob("*/flagged")):
        count = len(marks.read_text("utf-8").split())
        if count:
            found.append((marks.parent, count))
    return found


def package_variant(package: Path, number: int, spare: Sequence[Path], random: Random) -> Mapping[str, bytes]:
    """Return the files of a package in another form, by their path below the package."""
    name = _name_of(package)
    fresh = f"{_NAMES[number % len(_NAMES)]}_{number}" if number % 2 and name and _is_plain(name, package) else name
    files: dict[str, bytes] = {}
    for path in sorted(package.rglob("*")):
        inside = path.relative_to(package).as_posix()
        if not path.is_file() or inside == "flagged":
            continue
        content = path.read_bytes()
        if path.suffix in _TEXTS and b"\0" not in content:
            text = content.decode("utf-8", "replace")
            if fresh != name:
                text = re.sub(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])", fresh, text)
            content = _layout(text, path, number).encode()
        if fresh != name:
            inside = "/".join(fresh if part == name else part for part in inside.split("/"))
        files[inside] = content
    declared = re.findall(r"depend[^>]*>([\w-]+)<", files.get("package.xml", b"").decode("utf-8", "replace"))
    for one in random.sample(list(spare), min(2, len(spare))):
        # It must use nothing that the package declares: whether that is used may be the question.
        if not any(each in one.read_text("ascii") for each in declared) and "ament_python" not in declared:
            files.setdefault(f"attic/{one.name}", one.read_bytes())
    return files


def _layout(text: str, path: Path, number: int) -> str:
    if path.name == "CMakeLists.txt" or path.suffix == ".cmake":
        if number % 4 == 1:
            text = _CMAKE.sub(lambda match: f"{match[1]}{match[2].upper()}(", text)
        elif number % 4 == 2:
            text = _CMAKE.sub(lambda match: f"{match[1]}{match[2]} (", text)
        if number % 3 == 1:
            text = re.sub(r"^(?=[a-z_A-Z]+ *\()", f"# step {number}\n", text, flags=re.MULTILINE)
    if path.suffix in (".xml", ".launch"):
        if number % 3 == 2:
            text = re.sub(r"^( *)(<(?![?/!]))(?=\w)", r"\1<!-- see below -->\n\1\2", text, count=0, flags=re.MULTILINE)
            text = text.replace("<!-- see below -->\n", "", 1) if text.lstrip().startswith("<!-- see") else text
        if number % 5 == 3:
            text = re.sub(r'(\w)="([^"\'<>]*)"', r"\1='\2'", text)
    if number % 4 == 3:
        text = text.replace("\r\n", "\n").replace("\n", "\r\n") if path.suffix not in (".py", "") else text
    return text


def _name_of(package: Path) -> str:
    match = re.search(r"<name>\s*([^<\s]+)\s*</name>", (package / "package.xml").read_text("utf-8", "replace"))
    return match[1] if match else ""


def _is_plain(name: str, package: Path) -> bool:
    """Return whether a name means nothing else in the package, so that it can be replaced by words."""
    if name in _MEAN_SOMETHING or name != package.name or not re.fullmatch(r"[a-z][a-z0-9_]{2,}", name):
        return False
    texts = [one.read_text("utf-8", "replace") for one in package.rglob("*") if one.is_file() and one.suffix in _TEXTS]
    return sum(len(re.findall(rf"\b{name}\b", text)) for text in texts) > 1
