"""JUnit XML, as ``colcon test-result``, ``catkin_test_results``, GitLab and Jenkins read it.

One suite for each package. A finding that fails the check is a failed test, other findings are in the output of the
suite, what could not be analysed is an error, and a package of which nothing fails has one test that passed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import TextIO
from xml.sax.saxutils import escape, quoteattr

from roslens.model.failure import Failure
from roslens.report.run.not_analysed import not_analysed
from roslens.report.run.reported import Reported, Wanted, reported, xml_text
from roslens.store.read import RunView

WORKSPACE = "workspace"
"""Name of the suite of what belongs to no package."""


def write_junit(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write the run as test results.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    findings: dict[str, list[Reported]] = defaultdict(list)
    for one in reported(view, wanted):
        findings[one.package].append(one)
    failures: dict[str, list[Failure]] = defaultdict(list)
    for failure in view.failures():
        failures[failure.package].append(failure)
    lost = not_analysed(view, accept_partial=wanted.accept_partial)
    packages = [package.id for package in view.packages()]
    rest = sorted((findings.keys() | failures.keys()) - set(packages))
    suites = [_Suite(package, findings[package], failures[package], lost, wanted) for package in (*packages, *rest)]
    counts = {name: sum(suite.counts[name] for suite in suites) for name in ("tests", *_BAD)}
    counts["tests"] += len(wanted.gate)
    counts["failures"] += sum(one.holds is False for one in wanted.gate)
    totals = " ".join(f'{name}="{count}"' for name, count in counts.items())
    stream.write(f'<?xml version="1.0" encoding="UTF-8"?>\n<testsuites name="roslens" {totals}>\n')
    for suite in suites:
        stream.writelines(suite.lines())
    stream.writelines(_gate(wanted))
    stream.write("</testsuites>\n")


_BAD = ("failures", "errors")


class _Suite:
    def __init__(
        self, package: str, findings: list[Reported], failures: list[Failure], lost: Sequence[Failure], wanted: Wanted
    ) -> None:
        self._name = package or WORKSPACE
        self._failing = [one for one in findings if wanted.is_failing(one.finding)]
        self._others = [one for one in findings if not wanted.is_failing(one.finding)]
        self._errors = [one for one in failures if one in lost]
        self._partial = [one for one in failures if one not in lost]
        bad = len(self._failing) + len(self._errors)
        self.counts = {"tests": bad or 1, "failures": len(self._failing), "errors": len(self._errors)}

    def lines(self) -> Iterator[str]:
        counts = " ".join(f'{name}="{count}"' for name, count in self.counts.items())
        yield f'  <testsuite name={_attribute(f"roslens.{self._name}")} {counts} skipped="0" time="0">\n'
        for one in self._failing:
            yield self._case(
                one.finding.rule, _place(one), "failure", one.finding.message, str(one.finding.severity.value)
            )
        for failure in self._errors:
            yield self._case(
                failure.tool, str(failure.location or failure.entity), "error", str(failure), "not analysed"
            )
        if not self._failing and not self._errors:
            yield f'    <testcase classname={_attribute(f"roslens.{self._name}")} name="check" time="0"/>\n'
        others = [f"{_place(one)}: {one.finding.severity.value}: {one.finding.message}" for one in self._others]
        others += [f"analysed in part: {failure}" for failure in self._partial]
        if others:
            text = escape(xml_text("\n".join(others)))
            yield f"    <system-out>{text}</system-out>\n"
        yield "  </testsuite>\n"

    def _case(self, what: str, place: str, kind: str, message: str, type_: str) -> str:
        name = f"{what} {place}".rstrip()
        text = f"{place}: {message}" if place and not message.startswith(place) else message
        return (
            f'    <testcase classname={_attribute(f"roslens.{self._name}")} name={_attribute(name)} time="0">'
            f"<{kind} type={_attribute(type_)} message={_attribute(message)}>{escape(xml_text(text))}</{kind}>"
            "</testcase>\n"
        )


def _gate(wanted: Wanted) -> Iterator[str]:
    """Yield the suite of the conditions of the gate: one that cannot be decided is an error of the workspace too."""
    if not wanted.gate:
        return
    broken = sum(one.holds is False for one in wanted.gate)
    counts = f'tests="{len(wanted.gate)}" failures="{broken}" errors="0" skipped="0"'
    yield f'  <testsuite name="roslens.gate" {counts} time="0">\n'
    for one in wanted.gate:
        said = f'<failure type="gate" message={_attribute(one.text)}/>' if one.holds is False else ""
        yield f'    <testcase classname="roslens.gate" name={_attribute(one.condition)} time="0">{said}</testcase>\n'
    yield "  </testsuite>\n"


def _place(one: Reported) -> str:
    if not one.path:
        return one.finding.entity
    return f"{one.path}:{one.finding.line}" if one.finding.line else one.path


def _attribute(text: str) -> str:
    return quoteattr(xml_text(text))
