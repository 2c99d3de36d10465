"""An answer as lines: the first cause, then each step with its evidence and what to try."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

import msgspec

from roslens.model.answers.answer import Answer, Step, StepState
from roslens.report.writing.terminal import printable

_SIGNS = {StepState.OK: "✔", StepState.NOT: "✖", StepState.UNSEEN: "?"}
_INDENT = " " * 6
_LEAST_WIDTH = 40


def to_answer_text(found: Answer, width: int = 100) -> str:
    """Return an answer as text: what is asked, the first cause with what to do, and all steps in order."""
    lines = [f"{found.entity}  ({'; '.join(found.looked_at)})", ""]
    cause = found.cause
    if cause is not None:
        lines += _wrapped(f"First cause: {cause.says}.", "", width)
        lines += [*_next_steps(cause, width, "")]
    else:
        unseen = sum(one.state is StepState.UNSEEN for one in found.steps)
        more = f"; {unseen} question{'s' * (unseen > 1)} could not be answered by what was looked at" if unseen else ""
        lines += _wrapped(f"No cause was found{more}.", "", width)
    lines.append("")
    for one in found.steps:
        lines += _step(one, width) if one.of else ()
    lines += _not_looked_at([one for one in found.steps if not one.of], width)
    for note in found.notes:
        lines += _wrapped(f"Note: {note}", "", width)
    return "".join(f"{printable(line)}\n" for line in lines)


def _step(one: Step, width: int) -> Iterator[str]:
    yield from _wrapped(f"{_SIGNS[one.state]} {one.asks.value}: {one.says} [{one.of}]", "  ", width)
    for line in one.evidence:
        yield from _wrapped(line, _INDENT, width)
    if one.state is not StepState.OK:
        yield from _next_steps(one, width, _INDENT)


def _not_looked_at(steps: Sequence[Step], width: int) -> Iterator[str]:
    """Yield the questions that nothing here could answer, as one step: what would answer them is the same."""
    if steps:
        asked = ", ".join(one.asks.value for one in steps)
        yield from _wrapped(f"{_SIGNS[StepState.UNSEEN]} {asked}: not in what was looked at", "  ", width)
        yield from _next_steps(steps[0], width, _INDENT)


def _next_steps(one: Step, width: int, indent: str) -> Iterator[str]:
    if one.how:
        yield from _wrapped(f"→ {one.how}", indent, width)
    if one.command:
        # A command is copied, so it stays in one line.
        yield f"{indent}→ try: {one.command}"


def _wrapped(text: str, indent: str, width: int) -> list[str]:
    return textwrap.wrap(
        text, max(width, _LEAST_WIDTH), initial_indent=indent, subsequent_indent=f"{indent}  ",
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


def to_answer_json(found: Answer) -> str:
    """Return an answer as a document, with its first cause."""
    content = {"cause": found.cause, **msgspec.structs.asdict(found)}
    return msgspec.json.format(msgspec.json.encode(content), indent=1).decode() + "\n"
