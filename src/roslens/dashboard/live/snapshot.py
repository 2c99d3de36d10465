"""What the live page shows at one instant: the document between who watches and who looks.

Who watches makes it once a second; the page, its scripts and anybody else read it from ``/snapshot.json``.
"""

from __future__ import annotations

import msgspec

from roslens.dashboard.live.causes import CausePicture
from roslens.dashboard.plan.ground import Box

VERSION = 2
"""Of the document; it rises when something in it changes its meaning or goes away."""


UNJUDGED = "unjudged"
"""In place of a state, of what no constraint judges."""


class Row(msgspec.Struct, frozen=True, omit_defaults=True):
    """A line of the tree; lines stand in order, each after the one it is part of.

    Attributes:
        key: of the line, the same in every snapshot; a topic with two publishers has two lines.
        entity: text form of the id of the entity.
        name: to show.
        kind: ``host``, ``node``, ``process``, ``topic`` or ``connection``.
        depth: 0 of a host, one more for each level below.
        state: worst state of what is said of it alone; ``unjudged`` where nothing judges it.
        counts: how many verdicts of it and everything below are in which state.
        values: latest values by key of the signal, in the unit of the signal.
        shown: the same values as people read them.
        observer: how these were observed.
        worst: worst state of it and everything below, ``unjudged`` where nothing of that is judged.
        below: what is wrong below, in words: ``1 absent, 2 unknown below``.
    """

    key: str
    entity: str
    name: str
    kind: str
    depth: int
    state: str
    counts: dict[str, int] = {}
    values: dict[str, float] = {}
    shown: dict[str, str] = {}
    observer: str = ""
    worst: str = UNJUDGED
    below: str = ""


class Named(msgspec.Struct, frozen=True):
    """What is watched, by id, the name that is shown and its kind."""

    entity: str
    name: str
    kind: str


class _Names(msgspec.Struct, frozen=True):
    rows: tuple[Named, ...]


def names_in(snapshot: bytes) -> tuple[Named, ...]:
    """Return what the rows of a snapshot, as JSON, are about; each once."""
    found = msgspec.json.decode(snapshot, type=_Names).rows if snapshot else ()
    return tuple({one.entity: one for one in found}.values())


class Alert(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that is wrong now.

    Attributes:
        key: of the alert, the same in every snapshot while it lasts.
        entity: text form of the id of the entity.
        name: of the entity, to show.
        kind: of the entity.
        state: ``low``, ``high`` or ``absent``.
        severity: ``note``, ``warning`` or ``error``.
        message: what is wrong, in one line.
        since: when it began, in seconds on the monitor's clock.
        when: the same as people read it.
        cause: text form of the id of the entity whose fault explains this one; empty for a first cause.
        group: under which operators see it.
        where: ``file:line`` of what is expected.
        evidence: what shows it.
        follows: what this one explains.
        handled: ``acknowledged`` or ``muted``, if that was noted.
        by: who did.
        until: when muting ends, as people read it.
        why: the first cause, as `roslens why` tells it; empty where none is known.
    """

    key: str
    entity: str
    name: str
    kind: str
    state: str
    severity: str
    message: str
    since: float
    when: str
    cause: str = ""
    group: str = ""
    where: str = ""
    evidence: str = ""
    follows: tuple[Alert, ...] = ()
    handled: str = ""
    by: str = ""
    until: str = ""
    why: str = ""


class Item(msgspec.Struct, frozen=True, omit_defaults=True):
    """A node or a topic in the picture of the graph; ``x`` and ``y`` are its middle, in pixels.

    ``label`` is its name as it stands in its box, ``w`` and ``h`` the size of that.
    """

    entity: str
    name: str
    kind: str
    x: float
    y: float
    state: str = UNJUDGED
    label: str = ""
    w: float = 0.0
    h: float = 0.0


class Link(msgspec.Struct, frozen=True, omit_defaults=True):
    """A line of the picture, from one item to another, both by their place in the list of items.

    Attributes:
        start: where it begins.
        end: where it ends.
        state: the worst of what it stands for.
        rate: as people read it, as are latency and bandwidth; empty of several topics.
        latency: mean time from publishing to receipt.
        bandwidth: of the topic or connection.
        age: mean seconds from the stamp in the header to receipt, of the oldest where it stands for several.
        lag: mean seconds from publishing to receipt, likewise.
        by: ids of the topics that a line between two nodes stands for.
        path: of the line, as SVG has it.
        word: where a word about it stands.
    """

    start: int
    end: int
    state: str = UNJUDGED
    rate: str = ""
    latency: str = ""
    bandwidth: str = ""
    age: float | None = None
    lag: float | None = None
    by: tuple[str, ...] = ()
    path: str = ""
    word: tuple[float, float] = (0.0, 0.0)


class Picture(msgspec.Struct, frozen=True, omit_defaults=True):
    """The graph with the places of its parts; ``version`` changes when a place or a line does.

    ``left_out`` describes what is not in it; ``as_lines`` is whether topics are lines between nodes.
    """

    version: int = 0
    width: float = 0.0
    height: float = 0.0
    items: tuple[Item, ...] = ()
    links: tuple[Link, ...] = ()
    left_out: str = ""
    boxes: tuple[Box, ...] = ()
    as_lines: bool = False


class Happening(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that happened: a change of the graph, or of what is held of it."""

    time: float
    when: str
    what: str
    entity: str
    name: str
    state: str = ""
    detail: str = ""


class Snapshot(msgspec.Struct, frozen=True, omit_defaults=True):
    """A system at one instant.

    Attributes:
        version: of the form of this document.
        time: of the instant, in seconds on the monitor's clock.
        when: the same as people read it.
        title: what is watched.
        live: whether more will come; false of a recording that was read to its end.
        state: worst state of all; ``unjudged`` where nothing is judged.
        counts: how many verdicts are in which state.
        unjudged: how many rows nothing judges.
        causes: why what is wrong is wrong, as far as something else explains it.
        cost: what watching costs, in words.
        columns: key and heading of the values in the tree, in order.
        rows: the tree.
        alerts: what is wrong, first causes only; what follows from them is in them. Of very many the first ones.
        muted: first causes that are muted for a while; their states are unchanged.
        wrong: how many first causes there are, muted ones apart.
        follow: how many alerts follow from those.
        picture: the graph.
        happened: the latest changes, newest first.
        failures: what could not be observed, newest first.
    """

    version: int
    time: float
    when: str
    title: str
    live: bool
    state: str
    counts: dict[str, int]
    cost: str
    columns: tuple[tuple[str, str], ...]
    rows: tuple[Row, ...]
    alerts: tuple[Alert, ...]
    picture: Picture
    happened: tuple[Happening, ...]
    failures: tuple[str, ...]
    unjudged: int = 0
    causes: CausePicture = CausePicture()
    muted: tuple[Alert, ...] = ()
    wrong: int = 0
    follow: int = 0
