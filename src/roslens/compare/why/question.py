"""What a word such as ``/scan``, ``node:/planner`` or ``map->base_link`` asks about."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Mapping

import msgspec

from roslens.model.errors import UsageError

ARROW = "->"
TRANSFORM = "transform"
KINDS = ("topic", "service", "action", "node", "frame", TRANSFORM, "host")
_LIKE = 0.7
_SHOWN = 5

Known = Mapping[str, Collection[str]]
"""Names that are known, by kind."""


class Question(msgspec.Struct, frozen=True):
    """An entity: its kind, one of ``KINDS``, and its name; of a transform ``target->source``."""

    kind: str
    name: str

    @property
    def entity(self) -> str:
        """Return its id as text."""
        return f"{self.kind}:{self.name}"


def frames_of(word: str) -> tuple[str, ...]:
    """Return the frames that a word asks about, target and source of a transform; nothing of any other word."""
    if ARROW in word:
        return tuple(part.strip().removeprefix("/") for part in word.removeprefix(f"{TRANSFORM}:").split(ARROW, 1))
    return (word.removeprefix("frame:").removeprefix("/"),) if word.startswith("frame:") else ()


def question_of(word: str, known: Known) -> Question:
    """Return what a word asks about.

    A word without a kind is the first of a topic, service, action, node, frame and host that is known by that name.

    Raises:
        UsageError: nothing is known by that name; the message has the nearest names.
    """
    if ARROW in word or word.startswith("frame:"):
        return _of_frames(word)
    kind, separator, name = word.partition(":")
    if not separator or kind not in KINDS:
        kind, name = "", word
    for one in (kind,) if kind else KINDS:
        for spelt in _spellings(name, one):
            if spelt in known.get(one, ()):
                return Question(one, spelt)
    raise _unknown(word, name, {one: known.get(one, ()) for one in ((kind,) if kind else KINDS)})


def _of_frames(word: str) -> Question:
    frames = frames_of(word)
    if not all(frames):
        raise UsageError(f'"{word}"', expected=f"the name of a frame, or two as in `map{ARROW}base_link`")
    return Question(TRANSFORM if ARROW in word else "frame", ARROW.join(frames))


def _spellings(name: str, kind: str) -> tuple[str, ...]:
    if kind in ("frame", "host"):
        return (name, name.lstrip("/"))
    return (name if name.startswith("/") else f"/{name}",)


def near_names(name: str, known: Collection[str], most: int = _SHOWN) -> list[str]:
    """Return the names that are most like one: with the same last part, or spelt alike."""
    last = name.rpartition("/")[2]
    same_end = sorted(one for one in known if one != name and one.rpartition("/")[2] == last)
    alike = difflib.get_close_matches(name, [one for one in known if one != name], most, _LIKE)
    return list(dict.fromkeys((*same_end, *alike)))[:most]


def _unknown(word: str, name: str, known: Known) -> UsageError:
    near = [f"{one} ({kind})" for kind, names in known.items() for one in near_names(_whole(name, kind), names, 3)]
    counted = ", ".join(f"{len(names)} {kind}s" for kind, names in known.items() if names)
    return UsageError(
        f'nothing that was looked at is called "{word}"',
        expected=f"one of {counted}" if counted else "a workspace, a recording or a running system that has it",
        advice=f"Did you mean {', '.join(near[:_SHOWN])}?" if near else "",
    )


def _whole(name: str, kind: str) -> str:
    return _spellings(name, kind)[0]
