"""The score of a reference over many trials: which faults it detects, how fast, and at what price."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.live.mutation.fault import FaultKind
from roslens.live.mutation.trial import Trial
from roslens.live.replay.alarms import Alarm


class Cell(msgspec.Struct, frozen=True):
    """How often a kind of fault was tried and seen, and after how many seconds in the middle of all times."""

    tried: int = 0
    seen: int = 0
    after_s: float | None = None


class Score(msgspec.Struct, frozen=True):
    """The score of a reference on a recording.

    Attributes:
        version: of this form.
        recording: files.
        references: files.
        seconds: length of the recording.
        planned: faults that could be tried; fewer are where the time was over.
        topics: by topic, and by kind of fault.
        kinds: by kind of fault, over all topics.
        total: of all.
        false_alarms: alarms that the healthy recording raises, in all.
        false_per_hour: of these.
        beside: trials that raised alarms about what the fault does not concern.
        unseen: kinds of faults of topics of which none was seen, as ``topic: kind``, with the reason where it is known.
    """

    version: int
    recording: tuple[str, ...]
    references: tuple[str, ...]
    seconds: float
    planned: int
    topics: dict[str, dict[str, Cell]]
    kinds: dict[str, Cell]
    total: Cell
    false_alarms: int
    false_per_hour: float
    beside: int
    unseen: tuple[str, ...]

    @property
    def share(self) -> float:
        """The share of the faults that was seen, from 0 to 1; 0 without any."""
        return self.total.seen / self.total.tried if self.total.tried else 0.0


def score(
    trials: Sequence[Trial],
    healthy: Sequence[Alarm],
    *,
    recording: Sequence[str],
    references: Sequence[str],
    seconds: float,
    planned: int,
) -> Score:
    """Return the score of a reference from trials, and from its alarms in the unchanged recording."""
    topics = sorted({one.fault.topic for one in trials})
    by_topic = {
        topic: {
            kind.value: _cell([one for one in trials if one.fault.topic == topic and one.fault.kind is kind])
            for kind in FaultKind
        }
        for topic in topics
    }
    reasons = {(one.fault.topic, one.fault.kind.value): one.why for one in trials if one.why}
    unseen = [
        f"{topic}: {kind}" + (f" ({reasons[topic, kind]})" if (topic, kind) in reasons else "")
        for topic, cells in by_topic.items()
        for kind, cell in cells.items()
        if cell.tried and not cell.seen
    ]
    return Score(
        version=1,
        recording=tuple(recording),
        references=tuple(references),
        seconds=seconds,
        planned=planned,
        topics=by_topic,
        kinds={kind.value: _cell([one for one in trials if one.fault.kind is kind]) for kind in FaultKind},
        total=_cell(trials),
        false_alarms=len(healthy),
        false_per_hour=3600 * len(healthy) / seconds if seconds > 0 else 0.0,
        beside=sum(1 for one in trials if one.beside),
        unseen=tuple(unseen),
    )


def _cell(trials: Sequence[Trial]) -> Cell:
    times = sorted(one.after_s for one in trials if one.after_s is not None)
    middle = times[len(times) // 2] if times else None
    return Cell(len(trials), sum(one.seen for one in trials), middle)
