"""The nodes of a configuration as an SROS 2 policy: what each may publish, subscribe, call and serve, and nothing else.

The form is that of sros2 (``policy/schemas/policy.xsd``, version 0.2.0), each node in an enclave of its own name. A
name of which a part is unknown is left in a comment: allowing a pattern would allow more than anybody asked for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

from roslens.model.configuration import Configuration, ConfiguredNode
from roslens.model.graph import Role

_RULES = (
    (Role.SUBSCRIPTION, "topics", "topic", "subscribe"),
    (Role.PUBLISHER, "topics", "topic", "publish"),
    (Role.SERVICE_SERVER, "services", "service", "reply"),
    (Role.SERVICE_CLIENT, "services", "service", "request"),
    (Role.ACTION_SERVER, "actions", "action", "execute"),
    (Role.ACTION_CLIENT, "actions", "action", "call"),
)


def to_sros2(configuration: Configuration) -> str:
    """Return a policy for the nodes of a configuration; one without nodes that are known has no enclave."""
    return "".join(f"{line}\n" for line in _lines(configuration))


def _lines(configuration: Configuration) -> Iterator[str]:
    yield '<?xml version="1.0" encoding="UTF-8"?>'
    yield f"<!-- {_comment(configuration.title)} -->"
    if configuration.generation == "ros1":
        yield "<!-- ROS 1 has no policies. -->"
    yield '<policy version="0.2.0">'
    yield "  <enclaves>"
    for node in configuration.nodes if configuration.generation != "ros1" else ():
        if node.resolved and node.name != "/":
            yield from _node(node)
        else:
            yield f"    <!-- {_comment(node.name)}: a part of its name is unknown -->"
    yield "  </enclaves>"
    yield "</policy>"


def _node(node: ConfiguredNode) -> Iterator[str]:
    space, _, name = node.name.rpartition("/")
    yield f"    <enclave path={quoteattr(node.name)}>"
    yield "      <profiles>"
    yield f"        <profile ns={quoteattr(space or '/')} node={quoteattr(name)}>"
    for role, several, single, rule in _RULES:
        ends = [one for one in node.endpoints if one.endpoint.role is role]
        known = sorted({one.endpoint.name for one in ends if one.resolved})
        for one in sorted({one.endpoint.name for one in ends if not one.resolved}):
            yield f"          <!-- {rule} {_comment(one)}: a part of its name is unknown -->"
        if known:
            yield f'          <{several} {rule}="ALLOW">'
            yield from (f"            <{single}>{escape(_within(one, node.name))}</{single}>" for one in known)
            yield f"          </{several}>"
    yield "        </profile>"
    yield "      </profiles>"
    yield "    </enclave>"


def _within(name: str, node: str) -> str:
    """Return a name as sros2 writes it: relative to the node or its namespace where it is below them."""
    space = node.rpartition("/")[0]
    if name.startswith(f"{node}/"):
        return f"~{name.removeprefix(node)}"
    if name.startswith(f"{space}/") and (space or name.count("/") == 1):
        return name.removeprefix(f"{space}/")
    return name


def _comment(text: str) -> str:
    """Return a text as it may stand in a comment of XML."""
    return re.sub(r"-(?=-|$)", "- ", " ".join(text.split()))
