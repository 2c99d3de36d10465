"""What ``roslens graph`` says of calls that look as if they made an endpoint: shown, named as unresolved, or nothing.

A call is shown where an endpoint of the answer is made within three lines of it, or a helper on the way to it is called
there; it is named where something unresolved is. The command is asked as a user asks it, for all packages.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import msgspec

from endpoint_sites.text_calls import TextCall, text_calls

NEAR = 3
"""Lines that a call may lie away, as calls go over several lines."""
Places = dict[str, set[int]]


class Told(msgspec.Struct, frozen=True):
    """What the command says of the calls of a repository.

    Attributes:
        commit: of the checkout, shortened; empty where it is none.
        calls: how many there are.
        shown: how many an endpoint is shown for.
        named: how many more are named as unresolved.
        lost: the others.
    """

    commit: str
    calls: int
    shown: int
    named: int
    lost: tuple[TextCall, ...]


def told_of(root: Path) -> Told:
    """Return what the command says of a checkout."""
    return judged(text_calls(root), asked(root), commit_of(root))


def judged(calls: list[TextCall], answer: Mapping[str, Any], commit: str = "") -> Told:
    """Return what an answer says of calls."""
    shown: Places = {}
    named: Places = {}
    for one in answer.get("configurations", ()):
        _collect(one.get("nodes", ()), shown)
        _collect([value for key, value in one.items() if key != "nodes"], named)
    here = [one for one in calls if _is_near(one, shown)]
    said = [one for one in calls if one not in here and _is_near(one, named)]
    lost = tuple(one for one in calls if one not in here and one not in said)
    return Told(commit, len(calls), len(here), len(said), lost)


def asked(root: Path) -> dict[str, Any]:
    """Return the answer of ``roslens graph`` for a folder, which is left as it is."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "graph.json")
        words = ["graph", str(root), "--no-cache", "-q", "--format", "json", "-o", str(target)]
        subprocess.run([Path(sys.executable).with_name("roslens"), *words], capture_output=True, check=False)
        text = target.read_text() if target.is_file() else ""
    found: dict[str, Any] = json.loads(text) if text.strip() else {}
    return found


def commit_of(root: Path) -> str:
    """Return the commit of a checkout, shortened to seven digits; empty where it is none."""
    command = ["git", "-C", str(root), "rev-parse", "--short=7", "HEAD"]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def checkouts(folder: Path) -> Iterator[tuple[str, Path]]:
    """Yield the folders in a folder by name; ``owner+name`` is shown as ``owner/name``."""
    for path in sorted(folder.iterdir()):
        if path.is_dir() and not path.name.startswith("."):
            yield path.name.replace("+", "/"), path


def _collect(value: object, found: Places) -> None:
    if isinstance(value, Mapping):
        path, line = value.get("path"), value.get("line")
        if isinstance(path, str) and isinstance(line, int):
            found.setdefault(path, set()).add(line)
        for one in value.values():
            _collect(one, found)
    elif isinstance(value, list | tuple):
        for one in value:
            _collect(one, found)


def _is_near(call: TextCall, places: Places) -> bool:
    return any(abs(line - call.line) <= NEAR for line in places.get(call.path, ()))
