"""What may be done on a host: a file of that host, which no monitor can change."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import msgspec

from roslens.judge.documents.document import Section, read_document
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.amount import parse_amount
from roslens.model.acting.action_kind import ACTION_KINDS, By
from roslens.model.acting.host_request import HostRequest
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError

KEYS = {"nodes": "what may be done to which nodes", "commands": "programs that may be run, by name"}
_NODE_KEYS = {
    "name": "pattern of names of nodes",
    "actions": "what may be done to them",
    "program": "pattern that the command line of their process has to have as well",
}
_COMMAND_KEYS = {"name": "by which a monitor asks for it", "run": "the program and its arguments", "timeout": "`20 s`"}
_OF_NODES = tuple(
    one.key for one in ACTION_KINDS if one.by is By.HOST and one.targets == (EntityKind.NODE,)
)  # fmt: skip
_LONGEST_COMMAND_S = 300.0
_DEFAULT_TIMEOUT_S = 20.0

EXAMPLE = """\
# What a roslens monitor may do on this host. Only its owner may be able to write it.
nodes:
  - name: /camera*                # pattern of names
    actions: [restart, start]     # of stop, restart, start, kill
    program: "**camera_node**"    # what their command line has to match as well (optional)
commands:
  - name: power_cycle
    run: [/usr/bin/uhubctl, -a, cycle]   # no shell; nothing of it comes from the monitor
    timeout: 20 s
"""


class AllowedNodes(msgspec.Struct, frozen=True):
    """What may be done to nodes of some names; an empty ``program`` is any."""

    names: Pattern
    actions: frozenset[str]
    program: Pattern | None = None


class AllowedCommand(msgspec.Struct, frozen=True):
    """A program with its arguments, and how long it may take."""

    words: tuple[str, ...]
    timeout_s: float


class AllowList(msgspec.Struct, frozen=True):
    """What may be done; nothing that is not in it."""

    nodes: tuple[AllowedNodes, ...] = ()
    commands: dict[str, AllowedCommand] = {}

    def refusal(self, request: HostRequest, command_line: str) -> str:
        """Return why a request is refused, empty where it is allowed.

        Args:
            request: what is asked for.
            command_line: of the process that it is about, empty where there is none.
        """
        if request.kind == "command":
            name = request.arguments.get("name")
            known = isinstance(name, str) and name in self.commands
            return "" if known else f"the command {str(name)[:60]!r} is not on the allow-list"
        if request.kind not in _OF_NODES:
            return f"{request.kind[:60]!r} is nothing that a host does"
        for one in self.nodes:
            fits = one.program is None or one.program.matches(command_line)
            if fits and request.kind in one.actions and one.names.matches(request.node):
                return ""
        return f"`{request.kind}` of {request.node[:200]} is not on the allow-list"


def read_allow_list(path: Path) -> AllowList:
    """Read an allow-list.

    Raises:
        DocumentError: it cannot be read, is none, or others than its owner can write it.
    """
    _refuse_writable(path)
    document = read_document(path, "allow-list", KEYS)
    nodes = tuple(_nodes(one) for one in document.sections("nodes", "permission", _NODE_KEYS))
    commands: dict[str, AllowedCommand] = {}
    for section in document.sections("commands", "command", _COMMAND_KEYS):
        name = section.text("name")
        if name in commands:
            raise section.fault("name", f"the command {name!r} for the second time", expected="each name once")
        commands[name] = _command(section)
    return AllowList(nodes, commands)


def _nodes(section: Section) -> AllowedNodes:
    actions = section.texts("actions")
    if not actions:
        raise section.fault("actions", "no actions", expected=f"some of {', '.join(_OF_NODES)}")
    for one in actions:
        if one not in _OF_NODES:
            raise section.fault("actions", f"the action {one!r}", expected=f"one of {', '.join(_OF_NODES)}")
    names = _pattern(section, "name")
    if names is None:
        raise section.fault("", "a permission without a name", expected="`name: /camera*`")
    return AllowedNodes(names, frozenset(actions), _pattern(section, "program"))


def _pattern(section: Section, key: str) -> Pattern | None:
    if key not in section:
        return None
    try:
        return Pattern.parse(section.text(key))
    except ValueError as error:
        raise section.fault(key, f"{key}: {error}", expected="a pattern of names") from None


def _command(section: Section) -> AllowedCommand:
    words = section.texts("run")
    if not words or not os.path.isabs(words[0]):  # noqa: PTH117 - a text of the document
        found = words[0] if words else "nothing"
        raise section.fault(
            "run", f"run begins with {found!r}", expected="a program by its whole path, then its arguments"
        )
    timeout_s = _DEFAULT_TIMEOUT_S
    if "timeout" in section:
        try:
            timeout_s = parse_amount(section.text("timeout"), "s", bare=False)
        except ValueError as error:
            raise section.fault("timeout", f"timeout: {error}") from None
    if not 0 < timeout_s <= _LONGEST_COMMAND_S:
        raise section.fault("timeout", f"a timeout of {timeout_s:g} s", expected=f"up to {_LONGEST_COMMAND_S:g} s")
    return AllowedCommand(words, timeout_s)


def _refuse_writable(path: Path) -> None:
    try:
        found = path.stat()
    except OSError as error:
        raise DocumentError(
            f"cannot read it: {error.strerror or error}", where=str(path), expected="an allow-list in YAML",
            advice="`roslens agent --enrol` writes an example",
        ) from None  # fmt: skip
    if found.st_mode & (stat.S_IWGRP | stat.S_IWOTH) or found.st_uid not in (0, os.geteuid()):
        raise DocumentError(
            "others can write it", where=str(path), expected="a file that only root and the user of the agent can "
            "write",
            advice=f"chmod go-w {path}",
        )  # fmt: skip
