"""Calls that look as if they made an endpoint, counted by the text of a workspace alone: nothing of roslens is asked.

C++ and Python, ROS 1 and 2; tests, comments and folders that an ignore marker leaves out are none. Crude on purpose: a
few per cent of what is counted are something else, as a function of a library that is called ``subscribe``. Lines that
declare or define a function of such a name are none: there nothing is called.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

import msgspec

_CALL = re.compile(
    r"(?:\.|->|\b)(?:template\s+)?(?:advertise|subscribe|advertiseService|serviceClient|create_publisher"
    r"|create_subscription|create_service|create_client|create_generic_publisher|create_generic_subscription"
    r"|create_server)\s*(?:<.*)?\("
    r"|rospy\.(?:Publisher|Subscriber|Service|ServiceProxy)\s*\("
    r"|\b(?:Simple)?Action(?:Server|Client)(?:Base)?\s*(?:<[^;]*>)?\s*\("
    r"|(?<![\w.])(?:Publisher|Subscriber|ServiceProxy)\(|RealtimePublisher<[^>]*>\s*\("
)
_NOT_CALLED = re.compile(r"\s*(from|import|#include|def |class |using |typedef )")
_DECLARED = re.compile(
    r"\s*(?:(?:virtual|static|inline|explicit|constexpr|friend)\s+)*"
    r"(?!(?:return|new|throw|else|co_return|case|delete|auto\s*[*&]?\s*\w+\s*=)\b)"
    r"(?:(?:[\w:]+(?:<[^()]*>)?[\s*&]+)+(?:\w+::)*(?:advertise|subscribe|advertiseService|serviceClient|create_\w+)"
    r"|(?:[\w:]+(?:<[^()]*>)?[\s*&]+)*(?:\w+::)*~?(?:Publisher|Subscriber|ServiceProxy|(?:Simple)?Action(?:Server|Client)))"
    r"\s*\((?:[^;]*(?:\)\s*(?:const)?\s*(?:override|= 0|= default|= delete)?\s*(?:[;{:]?|\{\s*\})|,))?\s*\\?\s*$"
)
_CPP = (".cpp", ".h", ".hpp", ".cc", ".cxx")
_LEFT_OUT = re.compile(r"/(tests?|testing|[^/]*_tests?|RxCpp[^/]*|build|install|\.git)/")
_BLOCK, _LINE = re.compile(r"/\*.*?\*/", re.DOTALL), re.compile(r"//[^\n]*")
_TEXTS, _HASH = re.compile(r"(\"\"\"|''').*?\1", re.DOTALL), re.compile(r"#[^\n]*")
_MARKERS = frozenset(("CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"))
_HEAD = 80


class TextCall(msgspec.Struct, frozen=True, order=True):
    """A line that looks like a call: path below the workspace, line from 1 on, its text."""

    path: str
    line: int
    text: str


def text_calls(root: Path, *, definitions: bool = False) -> list[TextCall]:
    """Return the calls below a folder, in order of their files.

    Args:
        root: of the workspace.
        definitions: whether to take lines of C++ that declare or define a function of such a name for calls too.
    """
    return sorted(one for path in _sources(root) for one in _calls(root, path, definitions=definitions))


def _sources(root: Path) -> Iterator[Path]:
    for folder, below, names in os.walk(root):
        if not _MARKERS.isdisjoint(names):
            below.clear()
            continue
        for name in sorted(names):
            path = Path(folder, name)
            if _LEFT_OUT.search(f"/{path.relative_to(root)}") or not path.is_file():
                continue
            if name.endswith((*_CPP, ".py")) or ("." not in name and _is_python(path)):
                yield path


def _is_python(path: Path) -> bool:
    with path.open("rb") as file:
        head = file.readline(_HEAD)
    return head.startswith(b"#!") and b"python" in head


def _calls(root: Path, path: Path, *, definitions: bool) -> Iterator[TextCall]:
    text = path.read_text(errors="replace")
    cpp = path.suffix in _CPP
    text = _LINE.sub(_blank, _BLOCK.sub(_blank, text)) if cpp else _HASH.sub(_blank, _TEXTS.sub(_blank, text))
    for number, line in enumerate(text.split("\n"), 1):
        declared = cpp and not definitions and _DECLARED.match(line)
        if _CALL.search(line) and not _NOT_CALLED.match(line) and not declared:
            yield TextCall(path.relative_to(root).as_posix(), number, line.strip())


def _blank(match: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", match.group(0))
