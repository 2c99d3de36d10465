"""Why one frame cannot be looked up in another: the steps that recorded transforms give."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
import numpy as np

from roslens.compare.why.observed import Observed
from roslens.compare.why.question import ARROW, Question, near_names
from roslens.compare.why.recorded import Recorded, RecordedTransforms
from roslens.compare.why.time_line import BreakKind, TimeLine, time_line
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.transforms.probe import EVERY_S, Stretch
from roslens.model.transforms.tree import FrameLine

_MOST = 8
_OF_WHAT_RUNS = (
    ("is not in the recording, and may have it", "is not there, and may have it"),
    ("which node said which transform is not recorded", "which node said which transform is not known"),
    ("`made by` names it where the recording does", "`made by` has the nodes that publish any"),
    ("of another clock than the recording", "of another clock than that of this host"),
    ("record /clock, or with --use-sim-time", "look whether use_sim_time is set alike on all nodes"),
)
"""How the steps of a recording read where what runs was listened to."""
_DATED_S = 1.0
"""AMCL and others date transforms forward on purpose, by up to a second as a rule."""


def steps_of_transforms(question: Question, recorded: Recorded) -> Iterator[Step]:
    """Yield what the transforms of a recording say of a frame, or of the way from one to another."""
    said = recorded.transforms
    if said is None or not said.topics:
        yield Step(
            Asks.EXISTS, StepState.UNSEEN, f"{recorded.title} has neither /tf nor /tf_static", "recording",
            how="record both: `ros2 bag record /tf /tf_static`, or `rosbag record /tf /tf_static`",
        )  # fmt: skip
        return
    names = question.name.split(ARROW)
    unknown = [one for one in names if one not in said.tree.frames]
    if unknown:
        yield _unknown(unknown, said)
        return
    yield Step(
        Asks.EXISTS, StepState.OK, f"{' and '.join(names)} {'are frames' if len(names) > 1 else 'is a frame'} of "
        f"{len(said.tree.frames)}", "recording",
    )  # fmt: skip
    target, source = names[0], names[-1]
    lines = said.tree.between(target, source) or _above(names, said)
    yield from _made(lines, said)
    yield from _tree(names, lines, said)
    yield from _sent(lines, recorded)
    yield from _ages(lines)
    yield from _tried(said, recorded, lines)
    yield from _ignored(lines)


def steps_of_heard(question: Question, observed: Observed) -> Iterator[Step]:
    """Yield what the transforms of a running system say, as of a recording of the time in which it was listened."""
    heard = observed.transforms
    if heard is None:
        says, how = "the transforms of what runs were not heard", "record /tf and /tf_static, and give --bag"
        yield Step(Asks.EXISTS, StepState.UNSEEN, says, "live", observed.failures, how)
        return
    if not heard.said.topics:
        says = "nobody publishes transforms: there is neither /tf nor /tf_static"
        how = "start what publishes them, such as robot_state_publisher"
        yield Step(Asks.EXISTS, StepState.NOT, says, "live", how=how)
        return
    as_recorded = Recorded(observed.title, heard.start, heard.end, {}, observed.graph, transforms=heard.said)
    for one in steps_of_transforms(question, as_recorded):
        yield msgspec.structs.replace(
            one, of="live", says=_live_words(one.says), how=_live_words(one.how),
        )  # fmt: skip


def _live_words(text: str) -> str:
    """Return a sentence about a recording as one about what runs."""
    for words, other in _OF_WHAT_RUNS:
        text = text.replace(words, other)
    return text


def _above(names: Sequence[str], said: RecordedTransforms) -> tuple[FrameLine, ...]:
    """Return the lines of some frames and of all above them, where nothing lies between them."""
    frames = dict.fromkeys(one for name in names for one in said.tree.above(name))
    return tuple(said.tree.lines[one] for one in frames if one in said.tree.lines)


def _unknown(names: Sequence[str], said: RecordedTransforms) -> Step:
    near = [f"{other} for {one}" for one in names for other in near_names(one, said.tree.frames, 2)]
    words = " and ".join(f'"{one}"' for one in names)
    how = f"nearest names: {', '.join(near)}" if near else "start what publishes it"
    if "/tf_static" not in said.topics:
        how += "; /tf_static is not in the recording, and may have it"
    elif "/tf" not in said.topics:
        how += "; /tf is not in the recording, and may have it"
    return Step(
        Asks.EXISTS, StepState.NOT, f"{words} {'is no frame' if len(names) == 1 else 'are no frames'} that was said",
        "recording", (f"frames: {', '.join(sorted(said.tree.frames)[:30])}",) if said.tree.frames else (), how,
    )  # fmt: skip


def _made(lines: Sequence[FrameLine], said: RecordedTransforms) -> Iterator[Step]:
    authorities = sorted({name for one in lines for name in one.authorities})
    if authorities:
        told = tuple(f"{one.parent} → {one.child}: {', '.join(one.authorities)}" for one in lines if one.authorities)
        yield Step(Asks.MADE, StepState.OK, f"said by {', '.join(authorities)}", "recording", told[:_MOST])
    elif said.publishers:
        yield Step(
            Asks.MADE, StepState.UNSEEN, "which node said which transform is not recorded; those publish any: "
            f"{', '.join(said.publishers)}", "recording",
        )  # fmt: skip


def _tree(names: Sequence[str], lines: Sequence[FrameLine], said: RecordedTransforms) -> Iterator[Step]:
    tree = said.tree
    target, source = names[0], names[-1]
    for name in dict.fromkeys(names):
        if loop := tree.loop(name):
            says = f"the frames above {name} are a loop: {' → '.join((*loop, loop[0]))}"
            yield Step(Asks.TREE, StepState.NOT, says, "recording", how="one of them has the wrong parent")
            return
    several = [one for one in lines if len(one.parents) > 1]
    for one in several:
        counted = ", ".join(f"{parent} ({count} times)" for parent, count in one.parents)
        says = f"{one.child} has {len(one.parents)} parents, and each message moves it: {counted}"
        by = (f"said by {', '.join(one.authorities)}",) if one.authorities else ()
        yield Step(Asks.TREE, StepState.NOT, says, "recording", by, "let one node alone say where it is")
    way = tree.way(target, source)
    if len(names) > 1 and not way:
        tops = {name: tree.root(name) for name in names}
        sizes = tree.trees()
        says = f"{target} and {source} are in two trees: nothing says where {tops[source]} is in that of {target}"
        told = tuple(f"{name} is below {top}, with {sizes[top]} frames" for name, top in tops.items())
        how = f"publish a transform between the two trees, as from {tops[target]} to {tops[source]}"
        if "/tf_static" not in said.topics:
            how += "; /tf_static is not in the recording, and may have it"
        yield Step(Asks.TREE, StepState.NOT, says, "recording", told, how)
    elif not several:
        yield Step(Asks.TREE, StepState.OK, f"the way is {' → '.join(way)}" if len(names) > 1 else
                   f"it is below {tree.root(source)}: {' → '.join(tree.above(source))}", "recording")  # fmt: skip


def _sent(lines: Sequence[FrameLine], recorded: Recorded) -> Iterator[Step]:
    told = []
    broken = False
    for one in lines:
        name = f"{one.parent} → {one.child}"
        if one.static:
            told.append(f"{name}: static, said {len(one.received)} time{'s' * (len(one.received) != 1)}")
            continue
        line = _line(one, recorded)
        told.append(f"{name}: {len(one.received):,} at {line.rate:.3g} Hz" if line.rate else
                    f"{name}: {len(one.received)}, too few to tell a rate")  # fmt: skip
        for found in line.breaks:
            if found.kind is BreakKind.SLOW:
                continue
            broken = True
            says = f"{name} stopped" if found.kind is BreakKind.STOP else f"{name} was not said"
            says += f" for {found.until - found.since:.1f} s from {recorded.clock(found.since)} on"
            yield Step(
                Asks.SENT,
                StepState.NOT,
                f"{says}, where it came every {line.usual:.3g} s",
                "recording",
                how=f"look at what publishes {name}: `made by` names it where the recording does",
            )
    if told and not broken:
        yield Step(Asks.SENT, StepState.OK, "each transform on the way was said again and again, or is static",
                   "recording", tuple(told[:_MOST]))  # fmt: skip


def _line(one: FrameLine, recorded: Recorded) -> TimeLine:
    return time_line(np.asarray(one.received), recorded.end)


def _ages(lines: Sequence[FrameLine]) -> Iterator[Step]:
    moving = [one for one in lines if not one.static and one.received]
    for one in moving:
        if one.ahead > _DATED_S:
            says = f"{one.child} has stamps up to {one.ahead:.2f} s in the future"
            yield Step(Asks.AGE, StepState.NOT, says, "recording",
                       how="the clocks of two hosts differ, or its publisher adds to the stamp")  # fmt: skip
    kinds = {one.is_of_another_clock for one in moving}
    if len(kinds) > 1:
        names = ", ".join(one.child for one in moving if one.is_of_another_clock)
        says = f"the stamps of {names} are of another clock than those of the rest of the way"
        yield Step(Asks.AGE, StepState.NOT, says, "recording", how="set use_sim_time alike on all nodes")
    elif kinds == {False} and not any(one.ahead > _DATED_S for one in moving):
        told = tuple(f"{one.child}: stamps up to {one.ahead:.2f} s ahead" for one in moving[:_MOST] if one.ahead)
        told += tuple(f"{one.child}: {one.age:.3f} s at receipt, {one.oldest:.3f} s at most" for one in moving[:_MOST])
        yield Step(
            Asks.AGE,
            StepState.OK,
            "no stamp lies more than a second in the future",
            "recording",
            told,
        )
    elif kinds == {True}:
        yield Step(Asks.AGE, StepState.UNSEEN, "the stamps are of another clock than the recording", "recording",
                   how="record /clock, or with --use-sim-time")  # fmt: skip


def _tried(said: RecordedTransforms, recorded: Recorded, lines: Sequence[FrameLine]) -> Iterator[Step]:
    if said.probed is None or not said.probed.stretches:
        return
    found = said.probed
    failed = [one for one in found.stretches if one.error]
    good = [one for one in found.stretches if not one.error]
    if not good:
        yield Step(Asks.LAST_GOOD, StepState.NOT, f"a look-up never succeeded: {failed[-1].words}", "recording",
                   (f"{failed[-1].error}Exception of tf2",))  # fmt: skip
        return
    other_clock = any(one.is_of_another_clock for one in lines)
    moving = any(not one.static for one in lines)
    told = [_stretch(one, recorded) for one in failed[:_MOST]]
    if moving and not other_clock:
        told.append(
            f"extrapolation margin: the newest transform of all was {found.margin:.3f} s old in the median, and "
            f"{found.widest:.3f} s at most, at {recorded.clock(found.widest_at)}"
        )
    late = [one for one in failed if one.since > good[0].since + EVERY_S]
    if late:
        says = f"last good at {recorded.clock(_before(late[0], good))}, then: {late[0].words}"
        yield Step(Asks.LAST_GOOD, StepState.NOT, says, "recording", tuple(told))
    elif failed:
        says = f"a look-up succeeds from {recorded.clock(good[0].since)} on; before: {failed[-1].words}"
        yield Step(Asks.LAST_GOOD, StepState.OK, says, "recording", tuple(told))
    else:
        yield Step(Asks.LAST_GOOD, StepState.OK, "each look-up of the newest transform succeeds", "recording",
                   tuple(told))  # fmt: skip


def _before(late: Stretch, good: Sequence[Stretch]) -> float:
    return max(one.until for one in good if one.until <= late.since)


def _stretch(one: Stretch, recorded: Recorded) -> str:
    return f"{recorded.clock(one.since)} to {recorded.clock(one.until)}: {one.words} ({one.error}Exception)"


def _ignored(lines: Sequence[FrameLine]) -> Iterator[Step]:
    flaws = [(words, count) for one in lines for words, count in one.flaws]
    back = [one for one in lines if one.back]
    if flaws:
        says = f"tf2 ignores {sum(count for _, count in flaws)} transforms"
        told = tuple(f"{words}: {count} times" for words, count in flaws[:_MOST])
        yield Step(Asks.RULES, StepState.NOT, says, "recording", told, "correct what publishes them")
    for one in back[:_MOST]:
        says = f"{one.back} stamps of {one.child} are before the one that came before"
        several = len(one.authorities) > 1
        how = "two nodes say it: let one alone do so" if several else "several publishers, or a clock that jumped back"
        yield Step(Asks.RULES, StepState.NOT, says, "recording", how=how)
