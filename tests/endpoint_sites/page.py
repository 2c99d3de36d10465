"""The page that tells what was measured: ``docs/endpoint_sites.md``."""

from __future__ import annotations

from collections.abc import Mapping

from endpoint_sites.measuring import Measured
from endpoint_sites.of_command import Told

RIVAL = (
    ("publishers", ("publisher",), 26),
    ("subscriptions", ("subscription",), 12),
    ("servers of services", ("service_server",), 12),
    ("clients of services and actions", ("service_client", "action_client"), 2),
)
"""What ros2inspector 0.1.5 finds of the rows of navigation2."""
_MOST_TOLD = 160
_HEAD = """# Call sites of real code that are shown

Written by `make sites CLONES=folder`; do not edit. `roslens graph` is asked about each repository, for all its packages
and as a user asks it. Beside it, calls that look as if they made a publisher, subscription, service, action or a client
of one are counted by text alone, outside of tests and comments
([`text_calls.py`](../tests/endpoint_sites/text_calls.py)). A few per cent of these are something else, as a function of
another library that is called `subscribe`.

| word | means |
| --- | --- |
| calls | lines that look like such a call |
| shown | an endpoint of the answer is made within three lines of it, or a helper that makes it is called there |
| named | it is not shown, and is named there as unresolved, with the reason |
| lost | neither |
"""
_TUNED = "The evaluation was developed on these repositories: other code may fare worse."
_LABELLED = """## Endpoints with their names and types

Each call outside of tests that makes an endpoint was labelled by reading the source: file and line, what it makes, its
type, its name as written or what decides it (a parameter, an argument of a helper, the port of a behaviour tree). The
tables are in [`tests/fixtures/extract`](../tests/fixtures/extract); here is what the same answers of the command say of
these places.

| word | means |
| --- | --- |
| found | something of that kind is shown for that line |
| type | its type is the one of the table |
| name | its name is the one of the table, or the parameter, argument or port that decides it is told |
| messages | what a message that arrives decides, which source cannot tell; they count as missed |
| wrong | said to be certain, and not so |

Listeners and broadcasters of transforms, servers of dynamic_reconfigure and what every node has are not counted. In the
table of navigation2 are the calls of `create_publisher`, `create_subscription`, `create_service` and `create_client`.
The evaluation was mended until the goals were met on these tables (type 95 %, name 85 %): other code may fare worse.

| repository | at | sites | found | type | name | messages | wrong |
| --- | --- | --: | --: | --: | --: | --: | --: |
"""


def page(told: Mapping[str, Told], labelled: Mapping[str, tuple[str, Measured]], *, tuned: bool = False) -> str:
    """Return the page for repositories, and for labelled ones with their commits.

    Args:
        told: what is said of the calls of each repository.
        labelled: what is said of the rows of tables.
        tuned: whether the evaluation was developed on the repositories.
    """
    lines = [_HEAD.rstrip("\n"), *(["", _TUNED] if tuned else []), "", *_told(told)]
    if labelled:
        lines += ["", _LABELLED.rstrip("\n")]
    for name, (commit, one) in labelled.items():
        shares = " | ".join(_percent(one.share(what)) for what in ("found", "typed", "named"))
        counts = one.counts["all", "sites"], one.counts["all", "message"]
        lines.append(f"| {name} | `{commit}` | {counts[0]} | {shares} | {counts[1]} | {len(one.wrong)} |")
    if "navigation2" in labelled:
        lines += _rival(labelled["navigation2"][1])
    if labelled:
        lines += _missed(labelled)
    return "\n".join(lines) + "\n"


def _told(told: Mapping[str, Told]) -> list[str]:
    lines = [
        "| repository | at | calls | shown | named | lost | shown | shown or named |",
        "| --- | --- | --: | --: | --: | --: | --: | --: |",
    ]
    for name, one in sorted(told.items()):
        commit = f"`{one.commit}`" if one.commit else ""
        lines.append(f"| {name} | {commit} | {_row(one.calls, one.shown, one.named)} |")
    calls, shown, named = (sum(getattr(one, what) for one in told.values()) for what in ("calls", "shown", "named"))
    lines.append(f"| all {len(told)} | | {_row(calls, shown, named)} |")
    return lines


def _row(calls: int, shown: int, named: int) -> str:
    shares = (f"{_percent(one / calls)}" if calls else "" for one in (shown, shown + named))
    return " | ".join((str(calls), str(shown), str(named), str(calls - shown - named), *shares))


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
