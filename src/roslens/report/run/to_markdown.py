"""A summary in Markdown, for a pull request or the summary page of a job."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from typing import TextIO

from roslens.model.finding import Severity
from roslens.model.source import number_of_packages
from roslens.model.weight.consequence import weight_text
from roslens.model.words.plural import plural
from roslens.report.run.reported import Reported, Wanted, aside, reported, rules_by_id
from roslens.report.writing.control_characters import shown_controls
from roslens.store.read import RunView

FINDINGS = 20
"""Findings that are shown one by one."""
RULES = 15
PACKAGES = 15
FAILURES = 10


def write_markdown(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write how many findings there are, the worst of them, rules, packages and failures.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    findings = reported(view, wanted)
    sections = (
        _head(view, findings, wanted),
        _worst(findings),
        _rules(view, findings),
        _packages(findings),
        _failures(view),
    )
    stream.write("\n\n".join("\n".join(lines) for section in sections if (lines := list(section))) + "\n")


def _head(view: RunView, findings: list[Reported], wanted: Wanted) -> Iterator[str]:
    counts = Counter(one.finding.severity for one in findings)
    amounts = ", ".join(plural(counts[severity], severity.value) for severity in reversed(Severity) if counts[severity])
    yield f"## roslens: {amounts or 'no findings'}"
    if wanted.new is not None:
        yield ""
        new = sum(wanted.is_new(one.finding) for one in findings)
        yield f"**{plural(new, 'new finding')} since {_code(wanted.baseline)}, {wanted.gone:,} gone.**"
    yield ""
    packages = view.packages()
    commit = f", commit {view.header.commit[:10]}" if view.header.commit else ""
    models = f", models {', '.join(view.header.models)}" if view.header.models else ""
    count = number_of_packages(package.id for package in packages)
    yield f"{plural(count, 'package')}, {plural(sum(package.files for package in packages), 'file')}{models}{commit}."
    if others := aside(view, wanted.tags):
        yield f"{plural(others, 'more finding')} in test, generated or vendored code do not count here."
    if view.header.graphs and (note := view.header.graphs.note()):
        yield f"{_cell(note)}."
    for one in wanted.gate:
        state = {True: "holds", False: "is broken", None: "cannot be determined"}[one.holds]
        yield f"- gate {state}: {_cell(one.text)}"
    if set_aside := Counter(one.state.value.replace("_", " ") for one in view.set_aside(tags=wanted.tags)):
        parts = ", ".join(f"{count:,} {state}" for state, count in sorted(set_aside.items()))
        yield f"{plural(set_aside.total(), 'finding')} set aside: {parts}."


def _worst(findings: list[Reported]) -> Iterator[str]:
    if not findings:
        return
    yield "| | where | finding |"
    yield "| --- | --- | --- |"
    for one in findings[:FINDINGS]:
        place = (f"{one.path}:{one.line}" if one.finding.line else one.path) or one.finding.entity
        said = f"{_prose(one.finding.message)} ({_code(one.finding.rule)}: {weight_text(*one.finding.weight)})"
        yield f"| {one.finding.severity.value} | {_code(place)} | {said} |"
    if len(findings) > FINDINGS:
        yield ""
        yield f"{FINDINGS} of {len(findings):,} findings, worst first."


def _rules(view: RunView, findings: list[Reported]) -> Iterator[str]:
    counts = Counter((one.finding.severity, one.finding.rule) for one in findings)
    if len(counts) < 2:
        return
    about = rules_by_id(view)
    yield "| rule | findings | |"
    yield "| --- | ---: | --- |"
    order = sorted(counts.items(), key=lambda item: (-item[0][0].rank, -item[1], item[0][1]))
    for (severity, rule), count in order[:RULES]:
        title = about[rule].title if rule in about else ""
        yield f"| {_code(rule)} | {plural(count, severity.value)} | {_cell(title)} |"
    if len(order) > RULES:
        yield ""
        yield f"{RULES} of {len(order)} rules."


def _packages(findings: list[Reported]) -> Iterator[str]:
    counts: dict[str, Counter[Severity]] = defaultdict(Counter)
    for one in findings:
        counts[one.package or "(workspace)"][one.finding.severity] += 1
    if len(counts) < 2:
        return
    yield "| package | errors | warnings | notes |"
    yield "| --- | ---: | ---: | ---: |"
    order = sorted(counts, key=lambda name: (*(-counts[name][severity] for severity in reversed(Severity)), name))
    for name in order[:PACKAGES]:
        numbers = " | ".join(f"{counts[name][severity]:,}" for severity in reversed(Severity))
        yield f"| {_cell(name)} | {numbers} |"
    if len(order) > PACKAGES:
        yield ""
        yield f"{PACKAGES} of {len(order)} packages with findings, worst first."


def _failures(view: RunView) -> Iterator[str]:
    failures = sorted(view.failures(), key=lambda failure: failure.partial)
    if not failures:
        return
    yield f"**Not analysed, or only in part: {len(failures):,}**"
    yield ""
    for failure in failures[:FAILURES]:
        yield f"- {_prose(str(failure))} ({_code(failure.tool)})"
    if len(failures) > FAILURES:
        yield f"- and {len(failures) - FAILURES:,} more"


def _prose(text: str) -> str:
    """Return a message with the code in it, between back-ticks, as code."""
    # Pairs of back-ticks around something; one without its pair is a character like any other.
    return re.sub(r"`([^`]+)`|([^`]+|`)", lambda match: _code(match[1]) if match[1] else _cell(match[2]), text)


def _cell(text: str) -> str:
    # Names and messages come from the source that is analysed: none of them is markup, a link or a mention.
    flat = shown_controls(re.sub(r"\s+", " ", text))
    escaped = re.sub(r"([\\`*_\[\]<>|#~])", r"\\\1", flat)
    return escaped.replace("@", "@\N{ZERO WIDTH SPACE}").replace("&", "&amp;")


def _code(text: str) -> str:
    return "`" + shown_controls(" ".join(text.split())).replace("`", "'").replace("|", "\\|") + "`"
