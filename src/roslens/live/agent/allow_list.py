"""What may be done on a host: a file of that host, which no monitor can change."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path

import msgspec

from roslens.judge.documents.document import Section, parse_document
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
    "program": "pattern that the command line of their process has to have as well; needed where nothing else on the "
    "host shows which node a process is",
}
_COMMAND_KEYS = {"name": "by which a monitor asks for it", "run": "the program and its arguments", "timeout": "`20 s`"}
_OF_NODES = tuple(
    one.key for one in ACTION_KINDS if one.by is By.HOST and one.targets == (EntityKind.NODE,)
)  # fmt: skip
_LONGEST_COMMAND_S = 300.0
_DEFAULT_TIMEOUT_S = 20.0
_MOST_BYTES = 1_000_000

EXAMPLE = """\
# What a roslens monitor may do on this host. Only its owner may be able to write it.
nodes:
  - name: /camera*                # pattern of names
    actions: [restart, start]     # of stop, restart, start, kill
    program: "**camera_node**"    # what their command line has to match as well
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

    def refusal(self, request: HostRequest, command_line: str, *, shown: bool = True) -> str:
        """Return why a request is refused, empty where it is allowed.

        Args:
            request: what is asked for.
            command_line: of the process that it is about, empty where there is none.
            shown: whether this host itself saw that it is the process of the node, or it has ended.
        """
        if request.kind == "command":
            name = request.arguments.get("name")
            known = isinstance(name, str) and name in self.commands
            return "" if known else f"the command {str(name)[:60]!r} is not on the allow-list"
        if request.kind not in _OF_NODES:
            return f"{request.kind[:60]!r} is nothing that a host does"
        unshown = False
        for one in self.nodes:
            fits = one.program is None or one.program.matches(command_line)
            if fits and request.kind in one.actions and one.names.matches(request.node):
                if shown or one.program is not None:
                    return ""
                unshown = True
        if unshown:
            return (
                f"nothing on this host shows that process {request.pid} ({command_line[:100]!r}) is "
                f"{request.node[:200]}; expected a node that counts its traffic (`roslens run`), `__node:=` in the "
                f"command line, or `program` in the allow-list"
            )
        return f"`{request.kind}` of {request.node[:200]} is not on the allow-list"


def read_allow_list(path: Path) -> AllowList:
    """Read an allow-list.

    It is opened once: what is looked at is what is read. Folders above it, and links on the way, count as well: who can
    write one of them can put another file in its place.

    Raises:
        DocumentError: it cannot be read, is none, or others than its owner can write it or replace it.
    """
    content = _own_content(path)
    document = parse_document(content, "allow-list", KEYS, shown=str(path))
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


def _own_content(path: Path) -> bytes:
    """Return the content of a file that only root and this user can write and replace.

    Raises:
        DocumentError: it cannot be read, or others can.
    """
    try:
        opened = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
    except OSError as error:
        raise _unreadable(path, error) from None
    try:
        found = os.fstat(opened)
        if not stat.S_ISREG(found.st_mode):
            raise DocumentError("it is no plain file", where=str(path), expected="an allow-list in YAML")
        if _others_write(found):
            raise _refused("others can write it", path, path)
        for place in _way_to(path):
            above = place.lstat()
            if _others_write(above):
                what = "the link" if stat.S_ISLNK(above.st_mode) else "the folder"
                raise _refused(f"others can replace it: they can write {what} {str(place)!r}", path, place)
        with os.fdopen(os.dup(opened), "rb") as stream:
            content = stream.read(_MOST_BYTES + 1)
    except OSError as error:
        raise _unreadable(path, error) from None
    finally:
        os.close(opened)
    if len(content) > _MOST_BYTES:
        raise DocumentError(
            f"it has more than {_MOST_BYTES:,} bytes", where=str(path), expected="an allow-list in YAML"
        )
    return content


def _way_to(path: Path) -> Iterator[Path]:
    """Yield the folders and links that lead to a file, those behind links too."""
    waiting = [path.absolute()]
    seen: set[Path] = set()
    while waiting:
        one = waiting.pop()
        for place in (one, *one.parents):
            if place in seen:
                continue
            seen.add(place)
            if place.is_symlink():
                yield place
                waiting.append(place.parent / os.readlink(place))  # noqa: PTH115 - relative to its folder
            elif place != one:
                yield place


def _others_write(found: os.stat_result) -> bool:
    """Return whether others than root and this user can change a file, or replace one in a folder.

    In a folder with the sticky bit, as ``/tmp``, nobody replaces what belongs to somebody else. The mode of a link is
    without meaning, its owner is not. A folder that the group can write is the user's if the group has no other member.
    """
    if found.st_uid not in (0, os.geteuid()):
        return True
    if stat.S_ISLNK(found.st_mode) or (stat.S_ISDIR(found.st_mode) and found.st_mode & stat.S_ISVTX):
        return False
    if found.st_mode & stat.S_IWOTH:
        return True
    return bool(found.st_mode & stat.S_IWGRP) and not (stat.S_ISDIR(found.st_mode) and _is_alone_in(found.st_gid))


def _is_alone_in(group: int) -> bool:
    """Return whether a group is that of this user alone, as many systems make one for each user."""
    import grp
    import pwd

    try:
        user, found = pwd.getpwuid(os.geteuid()), grp.getgrgid(group)
    except KeyError:
        return False
    return found.gr_name == user.pw_name and not {*found.gr_mem} - {user.pw_name}


def _refused(what: str, path: Path, place: Path) -> DocumentError:
    return DocumentError(
        what, where=str(path), expected="a file that only root and the user of the agent can write or replace",
        advice=f"chmod go-w {place}, if you own it; else keep the allow-list elsewhere, as in ~/.config/roslens",
    )  # fmt: skip


def _unreadable(path: Path, error: OSError) -> DocumentError:
    return DocumentError(
        f"cannot read it: {error.strerror or error}", where=str(path), expected="an allow-list in YAML",
        advice="`roslens agent --enrol` writes an example",
    )  # fmt: skip
