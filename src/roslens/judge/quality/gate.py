"""The conditions under which a check passes: a closed list, each with a bound, and whether it holds."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.words.plural import plural


class GateConditions(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """What ``[gate]`` of a configuration may ask for; None asks for nothing.

    ``errors``, ``warnings`` and ``notes`` are how many findings there may be at most, ``new_…`` how many that the
    baseline does not have. ``comment_ratio`` is the least ratio of comment lines to lines of code, in per cent, of the
    packages' own code, ``comment_ratio_of_new_code`` that of its files that the baseline does not have as they are.
    ``new_breaking_interfaces`` is how many messages, services and actions may break what was built or recorded before.
    """

    errors: int | None = None
    warnings: int | None = None
    notes: int | None = None
    new_errors: int | None = None
    new_warnings: int | None = None
    new_notes: int | None = None
    comment_ratio: float | None = None
    comment_ratio_of_new_code: float | None = None
    new_breaking_interfaces: int | None = None

    @property
    def needs_baseline(self) -> bool:
        """Whether a condition is about what is new."""
        return any("new" in name and getattr(self, name) is not None for name in self.__struct_fields__)


class Lines(msgspec.Struct, frozen=True):
    """Lines of code and lines of comment."""

    code: float = 0
    comment: float = 0


class GateFacts(msgspec.Struct, frozen=True):
    """What the conditions are held against; None is what is not known without a baseline.

    ``counts`` and ``new_counts`` are findings by ``errors``, ``warnings`` and ``notes``, ``breaking_interfaces`` names.
    """

    counts: dict[str, int]
    lines: Lines
    new_counts: dict[str, int] | None = None
    new_lines: Lines | None = None
    breaking_interfaces: tuple[str, ...] | None = None


class GateResult(msgspec.Struct, frozen=True):
    """A condition and whether it holds, None where that cannot be determined; ``text`` describes it."""

    condition: str
    holds: bool | None
    text: str


def evaluate(conditions: GateConditions, facts: GateFacts) -> Iterator[GateResult]:
    """Yield each condition that is asked for, in their order."""
    for key in ("errors", "warnings", "notes"):
        yield from _at_most(key, getattr(conditions, key), facts.counts.get(key, 0))
    for key in ("errors", "warnings", "notes"):
        count = None if facts.new_counts is None else facts.new_counts.get(key, 0)
        yield from _at_most(f"new_{key}", getattr(conditions, f"new_{key}"), count)
    yield from _ratio("comment_ratio", conditions.comment_ratio, facts.lines)
    yield from _ratio("comment_ratio_of_new_code", conditions.comment_ratio_of_new_code, facts.new_lines)
    broken = facts.breaking_interfaces
    count = None if broken is None else len(broken)
    for one in _at_most("new_breaking_interfaces", conditions.new_breaking_interfaces, count):
        yield GateResult(one.condition, one.holds, f"{one.text}: {', '.join(broken)}" if broken else one.text)


def _at_most(name: str, bound: int | None, count: int | None) -> Iterator[GateResult]:
    if bound is None:
        return
    words = name.replace("_", " ")
    if count is None:
        yield _unknown(name, words)
    else:
        yield GateResult(name, count <= bound, f"{plural(count, words.removesuffix('s'))}, at most {bound:,}")


def _ratio(name: str, bound: float | None, lines: Lines | None) -> Iterator[GateResult]:
    if bound is None:
        return
    words = name.replace("_", " ")
    if lines is None:
        yield _unknown(name, words)
    elif not lines.code:
        yield GateResult(name, True, f"{words}: there is no such code")
    else:
        value = 100 * lines.comment / lines.code
        yield GateResult(name, value >= bound, f"{words} {value:.3g} %, at least {bound:g} %")


def _unknown(name: str, words: str) -> GateResult:
    return GateResult(name, None, f"{words}: not known without --baseline")
