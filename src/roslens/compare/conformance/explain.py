"""Why something is on one side and not on another, and whose word holds."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase

from roslens.compare.conformance.claim import NODE, PARAMETER, TOPIC, Claim
from roslens.compare.conformance.disparity import Reason, Why
from roslens.compare.conformance.plumbing import tool
from roslens.compare.conformance.side import Beside, Origin, Side, SideKind
from roslens.model.finding import Severity

BOTH = "both"
UNDECIDED = "undecided"
SOURCE = "the source"
RUNNING = "what runs"
_NOTE, _WARNING, _ERROR = Severity.NOTE, Severity.WARNING, Severity.ERROR
_NOT_ACTIVE = {
    "unconfigured": "it is unconfigured, and makes this when it is configured",
    "inactive": "it is inactive, and may make this when it is activated",
    "finalized": "it is finalized",
}


def not_in_source(one: Claim, source: Side, same_node: Sequence[Claim]) -> Why:
    """Return why source lacks a claim of another side.

    Args:
        one: what is there.
        source: the side of source.
        same_node: the claim of source on its node.
    """
    if one.kind == NODE and (words := tool(one.node)):
        return Why(Reason.TOOL, BOTH, f"It is {words}, no part of the robot.", _NOTE)
    if (pattern := _pattern(one, source)) is not None:
        given = pattern.given or pattern.name or pattern.node
        text = f'The source knows only a part of the name, "{given}".'
        return Why(Reason.PATTERN, BOTH, text, _NOTE, pattern.place)
    if (known := _beside(one, source.beside)) is not None:
        return known
    if one.kind == NODE:
        if source.open:
            text = f"The source may start more than could be read: {source.open}"
            return Why(Reason.INCOMPLETE, UNDECIDED, text, _NOTE)
    elif one.node in source.unread:
        text = f"The code of its node was understood only in part: {source.unread[one.node]}"
        return Why(Reason.INCOMPLETE, UNDECIDED, text, _NOTE)
    elif one.node and same_node and all(other.kind in (NODE, PARAMETER) or other.implicit for other in same_node):
        # Its package is not in the workspace.
        text = "The code of its node is not in the workspace, so its endpoints are unknown from the source."
        return Why(Reason.INCOMPLETE, RUNNING, text, _NOTE)
    elif one.kind == PARAMETER:
        text = "No code that was read declares it: a library that the node uses may do so."
        return Why(Reason.UNKNOWN_TO_SOURCE, RUNNING, text, _NOTE)
    what = "starts" if one.kind == NODE else "makes"
    text = f"Nothing that was read {what} it: it comes of code outside of the workspace, or was {_by_hand(one)}."
    return Why(Reason.UNKNOWN_TO_SOURCE, RUNNING, text, _WARNING)


def _by_hand(one: Claim) -> str:
    return "started by hand" if one.kind == NODE else "made by hand or by a newer version of it"


def _pattern(one: Claim, source: Side) -> Claim | None:
    for other in source.claims:
        if other.resolved or other.kind != one.kind:
            continue
        says = other.name if other.kind != NODE else other.node
        if set(says) <= {"/", "*"}:
            # It covers everything, and so explains nothing.
            continue
        if fnmatchcase(one.node, other.node or "*") and fnmatchcase(one.name, other.name):
            return other
    return None


def _beside(one: Claim, others: Sequence[Beside]) -> Why | None:
    """Return who else in the workspace makes it: first another launch file, then a build, then loose code."""
    for origin in Origin:
        for beside in others:
            if beside.origin is origin and (known := _known(one, beside)) is not None:
                return _elsewhere(one, known, beside)
    return None


def _known(one: Claim, beside: Beside) -> Claim | None:
    loose = beside.origin is Origin.UNSTARTED
    if loose and one.kind == NODE:
        return None
    named = _name(one)
    for other in beside.claims:
        says = _name(other)
        if other.kind != one.kind or set(says) <= {"/", "*"}:
            continue
        same_node = loose or one.kind in (NODE, TOPIC) or other.node == one.node
        if same_node and (says == named or ("*" in says and loose and fnmatchcase(named, says))):
            return other
    return None


def _name(one: Claim) -> str:
    """Return the name of what is claimed: that of a node, or of what it has."""
    return one.node if one.kind == NODE else one.name


def _elsewhere(one: Claim, known: Claim, beside: Beside) -> Why:
    if beside.origin is Origin.OTHER_LAUNCH:
        text = f"{beside.title} starts it, which is not the launch file compared."
        return Why(Reason.OTHER_LAUNCH, BOTH, text, _NOTE, known.place)
    if beside.origin is Origin.NOT_LAUNCHED:
        text = "The workspace builds it, but the launch file compared does not start it: it was started otherwise."
        return Why(Reason.NOT_LAUNCHED, RUNNING, text, _WARNING if one.kind == NODE else _NOTE, known.place)
    text = "It is made by a library, plug-in or script of the workspace that no known program starts."
    return Why(Reason.UNSTARTED, RUNNING, text, _NOTE, known.place)


def not_running(one: Claim, node: Claim | None) -> Why:
    """Return why a claim of source is not observed in the running system.

    Args:
        one: the claim of source.
        node: the claim of the system on its node; None if the node does not exist.
    """
    if one.conditions:
        text = f"Only a start decides its condition, which was not met: {'; '.join(one.conditions)}"
        return Why(Reason.CONDITION, BOTH, text, _NOTE, one.place)
    if one.ignored:
        text = "A value is set, but its node declares no parameter of this name: the value is ignored."
        return Why(Reason.IGNORED, RUNNING, text, _WARNING, one.place)
    if node is not None and node.lifecycle in _NOT_ACTIVE:
        text = f"Its node does not have it yet: {_NOT_ACTIVE[node.lifecycle]}."
        return Why(Reason.INACTIVE, BOTH, text, _NOTE, one.place)
    if one.sure != "certain":
        return Why(Reason.GUESSED, UNDECIDED, f"The source is not sure of it: {one.sure}.", _NOTE, one.place)
    if one.kind == NODE:
        text = "The launch file starts it without a condition: it ended, never started, or another one was launched."
        return Why(Reason.NOT_RUNNING, SOURCE, text, _ERROR, one.place)
    text = "Its code makes it without a condition: another version runs, or it did not get that far."
    return Why(Reason.NOT_RUNNING, SOURCE, text, _WARNING, one.place)


def not_recorded(one: Claim) -> Why:
    """Return why a recording lacks a claim of another side."""
    text = "A recording holds only what it was asked to record, and topics on which something was sent."
    return Why(Reason.NOT_RECORDED, UNDECIDED, text, _NOTE, one.place)


def only_one_of_a_kind(one: Claim, kind: SideKind, title: str) -> Why:
    """Return why one of two sides of the same kind has something that the other has not."""
    if one.conditions:
        text = f"It is there under a condition: {'; '.join(one.conditions)}"
        return Why(Reason.CONDITION, BOTH, text, _NOTE, one.place)
    if one.kind == NODE and (words := tool(one.node)):
        return Why(Reason.TOOL, BOTH, f"It is {words}, no part of the robot.", _NOTE)
    verb = "says" if kind is SideKind.SOURCE else "has"
    return Why(Reason.CONTRADICTION, UNDECIDED, f"Only {title} {verb} it.", _WARNING, one.place)


def recorded_only(title: str) -> Why:
    """Return why a recording has what a running system has not."""
    text = f"It was there when {title} was recorded, and is not now."
    return Why(Reason.NOT_RUNNING, UNDECIDED, text, _WARNING)


def other_value(aspect: str, source: Claim | None, other: Claim | None) -> Why:
    """Return why a value differs.

    Args:
        aspect: of which.
        source: the side of source; None if no source is compared.
        other: what runs or was recorded; None where nothing is.
    """
    place = source.place if source is not None else ""
    if source is None or other is None:
        severity = _ERROR if aspect == "type" else _WARNING
        return Why(Reason.CONTRADICTION, UNDECIDED, "The two were not made by the same program or launch.", severity)
    if source.uncertain:
        return Why(Reason.GUESSED, RUNNING, f"The source is not sure of it: {source.uncertain}.", _NOTE, place)
    if source.conditions or source.sure != "certain":
        doubt = "; ".join(source.conditions) or source.sure
        return Why(Reason.GUESSED, RUNNING, f"The source is not sure of it: {doubt}.", _NOTE, place)
    if aspect == "value":
        text = "It was set otherwise at the start or since, or another version runs."
        return Why(Reason.SET_OTHERWISE, RUNNING, text, _WARNING, place)
    if aspect == "type":
        text = "The program that runs is not the one that was read, or two programs share the name."
        return Why(Reason.CONTRADICTION, RUNNING, text, _ERROR, place)
    text = "The program that runs is not the one that was read, or an override set it."
    return Why(Reason.CONTRADICTION, RUNNING, text, _WARNING, place)


def other_name(source: Claim | None, *, of_node: bool) -> Why:
    """Return why the same has another name."""
    place = source.place if source is not None else ""
    if source is not None and source.remapped:
        text = f"The source remaps it at {source.remapped}, and what runs was remapped otherwise."
    elif source is not None:
        what = "started under another name" if of_node else "remapped at its start"
        text = f"It was {what}, by something that the source compared does not hold."
    else:
        text = "Its parts are the same, its name is not."
    return Why(Reason.REMAPPED, RUNNING if source is not None else UNDECIDED, text, _WARNING, place)
