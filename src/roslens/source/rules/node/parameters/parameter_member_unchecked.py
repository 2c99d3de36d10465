"""Rule ``node.parameter_member_unchecked``: members that keep what was in memory where a parameter is not set."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.syntax.comments import blank_comments

_READ = re.compile(
    rb"(?:^|[;{}])[ \t\r\n]*(?:this\s*->\s*)?[\w.>()-]*?\bgetParam(?:Cached)?\s*\(\s*"
    rb"[^,;()]*,\s*(?:this\s*->\s*)?(\w+)\s*\)\s*(?=;)"
)
"""A statement that reads a parameter into a variable, and drops whether it is set."""
_PLAIN = rb"(?:bool|int|unsigned(?:[ \t]+int)?|double|float|u?int\d+_t|std::u?int\d+_t|size_t|long)"
_MEMBER = rb"^[ \t]*(?:mutable[ \t]+)?%s[ \t]+(?:\w+[ \t]*,\s*)*%s[ \t]*(?:,[^;={}()]*)?;"
_GIVEN = rb"(?<![\w.])(?:\w+[ \t]*(?:\.|->)[ \t]*)?%s[ \t\r\n]*(?:=(?!=)|\{|\((?!\s*\)))|>>\s*%s\b|&\s*%s\b"
"""What gives a member a value: an assignment, a constructor, a stream, or who gets its address."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield, once for each source, the members that nothing else gives a value."""
    files = view.of_language(Language.CPP, Language.C, roles=(Role.OWN,))
    texts = {file.path: blank_comments(view.read(file.path), "cpp") for file in files}
    members = {field.name.encode() for facts in view.facts.values() for one in facts.classes for field in one.fields}
    for path, text in texts.items():
        if b"getParam" not in text or b"hasParam" in text:
            continue
        headers = [other for where, other in texts.items() if where == path or _is_header(where)]
        reads = [match for match in _READ.finditer(text) if match[1] in members]
        unset = [match for match in reads if _is_unset(match[1], text, headers)]
        if unset:
            yield _hit(path, text, unset)


def _is_header(path: str) -> bool:
    return path.rpartition(".")[2] in ("h", "hpp", "hh", "hxx")


def _is_unset(name: bytes, text: bytes, headers: list[bytes]) -> bool:
    """Return whether a name is that of a member without a value of its own, which only one parameter is read into."""
    member = re.compile(_MEMBER % (_PLAIN, name), re.MULTILINE)
    if not any(member.search(one) for one in headers):
        return False
    given = re.compile(_GIVEN % (name, name, name))
    reads = [match for match in _READ.finditer(text) if match[1] == name]
    return len(reads) == 1 and not any(given.search(one) for one in {*headers, text})


def _hit(path: str, text: bytes, unset: list[re.Match[bytes]]) -> Hit:
    names = list(dict.fromkeys(one[1].decode() for one in unset))
    at = unset[0].start(1)
    line = text.count(b"\n", 0, at) + 1
    shown = ", ".join(f"`{one}`" for one in names)
    keep = "keeps" if len(names) == 1 else "keep"
    message = (
        f"{shown} {keep} what was in memory where the parameter that getParam reads is not set, and nothing asks; "
        "expected `param(name, member, default)`, or `if (!…)`"
    )
    return Hit("node.parameter_member_unchecked", message, line, context=" ".join(names), path=path)


RULE = PackageRule(
    id="node.parameter_member_unchecked",
    title="Member that has a value only if a parameter is set",
    finds="`getParam` into a member that is a number, as a statement of its own, where neither its declaration nor a "
    "constructor nor any other line gives it a value, and the file asks for no parameter with `hasParam`. Members of a "
    "source are one finding. Use `param` with a default, or end with a message where it is missing.",
    why="Where a launch file does not set it, the wheel is as wide as what was in memory: the robot drives curves, or "
    "at its full speed.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros1",),
    tags=("parameters",),
    bad='class Drive { double base_; };\nDrive::Drive() { nh.getParam("wheel_base", base_); }',
    good='class Drive { double base_; };\nDrive::Drive() { nh.param("wheel_base", base_, 0.16); }',
    found=found,
)
