"""The report that a hook writes into: checks each entry as it comes, where its author can be given the line."""

from __future__ import annotations

import math
import operator
import traceback
from collections.abc import Callable
from typing import Protocol, SupportsFloat, SupportsIndex

from roslens.model.entity import EntityId
from roslens.model.failure import Failure
from roslens.model.quantity import Measurement, Quantity
from roslens.model.source import Location
from roslens.plugins.contract_failures import Violation, breaks_contract
from roslens.plugins.frames import Began, Step
from roslens.plugins.grounds import Grounds
from roslens.plugins.nearest import did_you_mean
from roslens.plugins.outcome import RawFinding
from roslens.plugins.points import Manifest


class Parts(Protocol):
    """Runs a part of a hook as a step of its own."""

    def attempt(self, recorder: Recorder, name: str, call: Callable[[], object], began: Began, *, always: bool) -> bool:
        """Run the part; return whether it ran to its end."""


class Recorder:
    """Implements :class:`roslens.plugins.points.Report` for one call of one hook."""

    def __init__(self, manifest: Manifest, grounds: Grounds, parts: Parts) -> None:
        """Take what the plug-in declares, what it may report on, and what runs a part of a hook."""
        self.grounds = grounds
        self.findings: list[RawFinding] = []
        self.measurements: list[Measurement] = []
        self.failures: list[Failure] = []
        self._tool = manifest.name
        self._rules = {rule.id for rule in manifest.rules}
        self._quantities = {quantity.key: quantity for quantity in manifest.quantities}
        self._parts = parts

    def finding(
        self,
        rule: str,
        message: str,
        *,
        path: str = "",
        line: int = 0,
        column: int = 0,
        end_line: int = 0,
        end_column: int = 0,
        entity: str = "",
        context: str = "",
    ) -> None:
        """Report one occurrence of ``rule``; see :meth:`roslens.plugins.points.Report.finding`."""
        try:
            if rule not in self._rules:
                raise _unknown("rule", rule, self._rules)
            where = _Numbers(line, column, end_line, end_column)
            place = self._path(path, entity)
            self._check_entity(entity)
            text = self._context(place, where.line, context)
        except _BreachError as error:
            self._breach(error.breach, path, line, entity, f"; it said {message!r}")
            return
        if not entity:
            around = self.grounds.around(place, where.line) if where.line else ()
            entity = around[0].id if around else (f"file:{place}" if place else self.grounds.default_entity)
        self.findings.append(
            RawFinding(
                place, where.line, where.column, rule, entity, _text(message), where.end_line, where.end_column, text
            )
        )

    def measurement(self, quantity: str, value: float, *, entity: str = "") -> None:
        """Report a value; see :meth:`roslens.plugins.points.Report.measurement`."""
        try:
            known = self._quantities.get(quantity)
            if known is None:
                raise _unknown("quantity", quantity, self._quantities)
            self._check_entity(entity)
            target = entity or self.grounds.default_entity
            _check_kind(known, target)
            number = _number(known, value)
        except _BreachError as error:
            self._breach(error.breach, "", 0, entity)
            return
        self.measurements.append(Measurement(target, quantity, number))

    def failure(self, what: str, *, expected: str = "", advice: str = "", line: int = 0) -> None:
        """Report what could not be analysed; see :meth:`roslens.plugins.points.Report.failure`."""
        path = self.grounds.default_path
        self.failures.append(
            Failure(
                tool=self._tool,
                what=_text(what),
                expected=_text(expected),
                advice=_text(advice),
                location=Location(path, _line(line)) if path else None,
                entity=self.grounds.default_entity,
                package=self.grounds.package,
                partial=True,
            )
        )

    def attempt(
        self, step: str, call: Callable[[], object], *, path: str = "", package: str = "", always: bool = False
    ) -> bool:
        """Run a part of the hook; see :meth:`roslens.plugins.points.Report.attempt`."""
        began = Began(Step(self._tool, _text(step)), path, package)
        return self._parts.attempt(self, _text(step), call, began, always=always)

    def drain(self) -> tuple[tuple[RawFinding, ...], tuple[Measurement, ...], tuple[Failure, ...]]:
        """Return what was reported since the last call."""
        drained = (tuple(self.findings), tuple(self.measurements), tuple(self.failures))
        self.findings, self.measurements, self.failures = [], [], []
        return drained

    def _path(self, path: str, entity: str) -> str:
        if not path:
            inside = entity.partition(":")[2].partition("#")[0] if entity else ""
            return inside if inside in self.grounds.paths else self.grounds.default_path
        found = self.grounds.resolve(str(path))
        if found is None:
            raise _BreachError(f"path {str(path)!r} is not one of the files it was given", "a path of one of its files")
        return found

    def _check_entity(self, entity: str) -> None:
        if entity and entity not in self.grounds.ids:
            expected = "the id of an entity that it was given"
            raise _BreachError(f"entity {entity!r} is not here", expected, did_you_mean(entity, self.grounds.ids))

    def _context(self, path: str, line: int, context: str) -> str:
        if not path or not line:
            return _text(context)
        text = self.grounds.line_text(path, line)
        if text is None:
            raise _BreachError(f"line {line} is behind the end of {path}", "a line of the file")
        return _text(context) or text

    def _breach(self, breach: Violation, path: object, line: object, entity: object, more: str = "") -> None:
        place = (self.grounds.resolve(str(path)) if path else None) or self.grounds.default_path
        caller = traceback.extract_stack(limit=3)[0]
        self.failures.append(
            breaks_contract(
                self._tool,
                breach,
                tool=self._tool,
                location=Location(place, _line(line)) if place else None,
                entity=str(entity) if str(entity) in self.grounds.ids else self.grounds.default_entity,
                package=self.grounds.package,
                detail=f"reported in {caller.name}, line {caller.lineno} of {caller.filename}{_text(more)}",
            )
        )


class _BreachError(Exception):
    def __init__(self, what: str, expected: str, advice: str = "") -> None:
        self.breach = Violation(what, expected, advice)
        super().__init__(what)


class _Numbers:
    """Lines and columns of a finding as numbers from 0."""

    def __init__(self, line: int, column: int, end_line: int, end_column: int) -> None:
        self.line, self.column = _position("line", line), _position("column", column)
        self.end_line, self.end_column = _position("end_line", end_line), _position("end_column", end_column)
        if self.end_line and self.end_line < self.line:
            raise _BreachError(f"end_line {self.end_line} is above line {self.line}", "an end behind the start")


def _position(name: str, value: SupportsIndex) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise _BreachError(f"{name} is {value!r}", "a whole number from 1, or 0 for unknown") from None
    if number < 0:
        raise _BreachError(f"{name} is {number}", "a whole number from 1, or 0 for unknown")
    return number


def _line(value: object) -> int:
    return value if isinstance(value, int) and value > 0 else 0


def _unknown(kind: str, found: object, known: object) -> _BreachError:
    names = sorted(known) if isinstance(known, set | dict) else []
    expected = f"one of {', '.join(names)}" if names else f"none: it declares no {kind}"
    return _BreachError(f"{kind} {found!r} is not declared", expected, did_you_mean(str(found), names))


def _check_kind(quantity: Quantity, entity: str) -> None:
    kind = EntityId.parse(entity).kind
    if kind not in quantity.kinds:
        kinds = " or ".join(known.value for known in quantity.kinds)
        raise _BreachError(f"a value of {quantity.key!r} for a {kind.value}", f"a {kinds}")


def _number(quantity: Quantity, value: SupportsFloat) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise _BreachError(f"{quantity.key} is {value!r}", "a number") from None
    low, high = quantity.minimum, quantity.maximum
    outside = (low is not None and number < low) or (high is not None and number > high)
    if not math.isfinite(number) or outside:
        bounds = f"{'-∞' if low is None else f'{low:g}'} to {'∞' if high is None else f'{high:g}'}"
        raise _BreachError(f"{quantity.key} is {number:g}", f"a number from {bounds}")
    return number


def _text(value: object) -> str:
    """Return a text that any report can hold: plug-ins decode source in ways of their own."""
    return str(value).encode("utf-8", "backslashreplace").decode()
