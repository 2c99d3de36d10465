"""Rule ``node.credential``: a password or key in the source."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_WORDS = rb"(?:passw(?:or)?d|passphrase|secret_?key|api_?key|access_?key|auth_?token|secret)"
_NAMED = re.compile(rb"(?i)" + _WORDS)
_NAME = rb"[\w.]*" + _WORDS
_VALUE = rb"""["']([^"'\s$<{%*]{6,80})["']"""
_ASSIGNED = re.compile(rb"""(?i)(?<![\w.])(""" + _NAME + rb""")["']?\]?\s*(?::\s*\w+\s*)?(?:=|:|\()\s*""" + _VALUE)
_SET = re.compile(rb"""(?i)\(\s*["'](""" + _NAME + rb""")["']\s*,\s*""" + _VALUE)
_KNOWN = re.compile(
    rb"(-----BEGIN (?:RSA |EC |OPENSSH |DSA )?PRIVATE KEY-----|\bAKIA[0-9A-Z]{16}\b|\bghp_[A-Za-z0-9]{36}\b|"
    rb"\bxox[bp]-[0-9A-Za-z-]{20,}|\bAIza[0-9A-Za-z_-]{35}\b|\bglpat-[0-9A-Za-z_-]{20})"
)
NAMES = (
    *("assw", "ASSW", "assphrase", "ecret", "ECRET", "_key", "piKey", "PI_KEY"),
    *("auth_token", "AUTH_TOKEN", "PRIVATE KEY", "AKIA", "ghp_", "AIza", "glpat-", "xox"),
)
"""What a file with a secret mentions: looking for these few is quicker than for the patterns."""

_SHOWN = 100
"""So many bytes behind the beginning of a key there are dots where it is an example."""

_NO_SECRET = re.compile(
    rb"(?i)^(password|passwd|secret|changeme|example|your|default|none|null|true|false|test|xxx+|\.+)|_|/"
)


def found(_node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each place of a file that looks like a key, or gives a password a literal value."""
    return secrets_of(view, "node.credential")


def secrets_of(view: FileView, rule: str) -> Iterator[Hit]:
    """Yield the secrets of a file in any language; the message shows none of them."""
    for match in _KNOWN.finditer(view.content):
        if b"..." in view.content[match.end() : match.end() + _SHOWN]:
            # An example: the key is left out.
            continue
        line, column = view.place(match.start())
        message = f"`{match[1][:8].decode()}…`, the beginning of a key, in the source; {_EXPECTED}"
        yield _without_text(view.hit_at(rule, line, message, column=column), "key")
    if not _NAMED.search(view.content):
        # It takes a fraction of the time that the patterns below take.
        return
    for match in (*_ASSIGNED.finditer(view.content), *_SET.finditer(view.content)):
        if _NO_SECRET.search(match[2]) or view.code[match.start(1)] in b" \t\n":
            continue
        line, column = view.place(match.start(1))
        name = match[1].decode("utf-8", "replace")
        message = f"`{name}` has a literal value of {len(match[2])} characters in the source; {_EXPECTED}"
        hit = view.hit_at(rule, line, message, column=column)
        yield _without_text(msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC), name)


_EXPECTED = "expected it from the environment or a file outside of the repository, and this one changed"


def _without_text(hit: Hit, context: str) -> Hit:
    return msgspec.structs.replace(hit, context=context)


RULE = FileRule(
    id="node.credential",
    title="Password or key in the source",
    finds="A variable or argument named as a password, secret or key that is given a literal value, or the beginning "
    "of a known "
    "kind of key. Read it from the environment, and change it: it is in the history. A literal value by itself is a "
    "note: it may be what the vendor publishes for every device.",
    why="Every clone and every robot has it, and whoever reads the repository can log in to all of them.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("security",),
    clauses=("cwe 798",),
    bad='const char * password = "r0bot-4711";\n',
    good='const char * password = std::getenv("ARM_PASSWORD");\n',
    syntax="cpp",
    whole=True,
    mentions=NAMES,
    spares_tests=True,
    found=found,
)
