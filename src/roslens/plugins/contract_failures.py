"""What a plug-in did against its contract, and the three ways in which a plug-in can fail."""

from __future__ import annotations

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Location

TOOL = "plugins"
"""The ``tool`` of failures to find, load or order plug-ins."""


BREACH = "breaks the contract"
"""What failures say of a plug-in that declares or reports what it may not."""


class Violation(msgspec.Struct, frozen=True, omit_defaults=True):
    """One thing that is against the contract, in the parts of a message."""

    what: str
    expected: str = ""
    advice: str = ""


def would_not_load(plugin: str, what: str, *, expected: str = "", advice: str = "", detail: str = "") -> Failure:
    """Return the failure of a plug-in that could not be found, imported or asked for its manifest."""
    return Failure(
        tool=TOOL, what=f"plug-in {plugin!r} would not load: {what}", expected=expected, advice=advice, detail=detail
    )


def not_trusted(plugin: str) -> Failure:
    """Return the failure of a plug-in that a configuration names and that the user has not said may run."""
    return Failure(
        tool=TOOL,
        what=f"plug-in {plugin!r} was not run: it is not trusted",
        expected="a plug-in that is installed, or whose folder and content you trust",
        advice="Review it, then run `roslens trust`; use --trust for a single run, for example in CI",
    )


def breaks_contract(
    plugin: str,
    breach: Violation,
    *,
    tool: str = "",
    location: Location | None = None,
    entity: str = "",
    package: str = "",
    detail: str = "",
) -> Failure:
    """Return the failure of a plug-in that declares or reports what it may not.

    Where it reported (and not only declared) it, ``tool`` is the plug-in and the rest of what it
    reported stands.
    """
    return Failure(
        tool=tool or TOOL,
        what=f"plug-in {plugin!r} {BREACH}: {breach.what}",
        expected=breach.expected,
        advice=breach.advice,
        location=location,
        entity=entity,
        package=package,
        partial=bool(tool),
        detail=detail,
    )


RAISED_ADVICE = "The traceback is in the log; other files and plug-ins are not affected"


def failed_running(
    plugin: str,
    step: str,
    what: str,
    *,
    location: Location | None = None,
    entity: str = "",
    package: str = "",
    detail: str = "",
    partial: bool = False,
    advice: str = RAISED_ADVICE,
) -> Failure:
    """Return the failure of a plug-in that raised, exited, crashed or hung in a step of its work."""
    return Failure(
        tool=plugin,
        what=f"plug-in {plugin!r} failed while running {step}: {what}",
        advice=advice,
        location=location,
        entity=entity,
        package=package,
        partial=partial,
        detail=detail,
    )
