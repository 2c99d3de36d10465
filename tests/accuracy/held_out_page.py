"""The section of docs/accuracy.md on repositories that nobody had opened when they were measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from graph_findings.judgements import Judgement

from accuracy.held_out import OPEN, RIGHT, WRONG, About, Endpoint, HeldOut

_HEAD = """## Repositories unseen before

Systems above, and the tables of [endpoint_sites.md](endpoint_sites.md), were looked at while the graph was made. What
it is worth on other code is measured on repositories that were held out:

1. They are drawn with a seed from the public index of ROS distributions (the sources and documentation of noetic,
   melodic, humble, jazzy, kilted, rolling and lyrical). Those whose name occurs anywhere in this project, packages of
   messages and tutorials are left out; the rest is shuffled, and taken in order as far as it can be had and has a call
   that makes an endpoint. Nobody opens them, nor runs roslens on them, before the measurement.
2. `roslens graph` is asked about each as a user asks it. Calls that look as if they made an endpoint are counted by
   text ([`text_calls.py`](../tests/endpoint_sites/text_calls.py)) and held against its answer, as in
   endpoint_sites.md: *shown*, *named* as unresolved, or *lost*. A cruder count takes lines that declare or define a
   function of such a name for calls too; it is given beside it.
3. 100 endpoints of all answers are drawn with a seed, at most 8 of a repository, and judged by reading the source:
   *right* (role, name and type are as the code says), *open* (the same, and what is not known of the name is marked as
   such), or *wrong*.
4. Findings of the rules of the graph are drawn with a seed: warnings and errors, at most 20 of a rule, then notes, as
   many of each rule as make 100 together. A finding is true where a maintainer would agree that it is a real problem
   worth acting on; a note, where what it says is so and worth knowing.
5. What failed is mended afterwards. From then on the set is one that was developed on: the next measurement takes
   another set. Tables stay as they were measured.

The tables with each judgement, path and line are in [`tests/fixtures/held_out`](../tests/fixtures/held_out) and
[`tests/fixtures/graph_findings`](../tests/fixtures/graph_findings). Who judged them also works on roslens.
"""
_SURE = ("certain", "likely", "possible")


def section(sets: Iterable[HeldOut]) -> str:
    """Return the section of some sets; empty where there is none."""
    lines = [line for one in sets for line in _of_set(one)]
    return "\n".join([_HEAD, *lines]).rstrip("\n") + "\n" if lines else ""


def _of_set(one: HeldOut) -> list[str]:
    about = one.about
    return [
        f"### {about.title}",
        "",
        (
            f"{len(one.calls)} repositories, {_drawn(about)}, measured at `{about.measured_at}` of roslens. Seeds: "
            f"endpoints {about.endpoints_seed}, findings {about.findings_seed}. "
            f"{about.since}"
        ),
        "",
        *_calls(one),
        "",
        *_endpoints(one),
        "",
        *_findings(one),
        "",
    ]


def _drawn(about: About) -> str:
    seed = about.repositories_seed
    return f"drawn with seed {seed}" if seed else "gathered by search instead of drawn"


def _calls(one: HeldOut) -> list[str]:
    rows = sorted(one.calls, key=lambda row: row.repository.lower())
    lines = [
        "| repository | at | calls | shown | named | lost |",
        "| --- | --- | --: | --: | --: | --: |",
    ]
    for row in rows:
        lost = row.calls - row.shown - row.named
        lines.append(f"| {row.repository} | `{row.commit[:7]}` | {row.calls} | {row.shown} | {row.named} | {lost} |")
    calls, shown, named, every, every_shown, every_named = (
        sum(getattr(row, what) for row in rows)
        for what in ("calls", "shown", "named", "lines", "lines_shown", "lines_named")
    )
    lines.append(f"| **all {len(rows)}** | | {calls} | {shown} | {named} | {calls - shown - named} |")
    return [
        *lines,
        "",
        (
            f"Of {calls} calls {_share(shown, calls)} are shown, {_share(shown + named, calls)} shown or named. By the "
            f"cruder count, of {every} lines {_share(every_shown, every)} and "
            f"{_share(every_shown + every_named, every)}."
        ),
    ]


def _endpoints(one: HeldOut) -> list[str]:
    counts = Counter((row.sure, row.judgement) for row in one.endpoints)
    lines = [
        (
            f"{len(one.endpoints)} of {one.about.endpoints} endpoints "
            f"([`endpoints.csv`](../tests/fixtures/held_out/{one.name}/endpoints.csv)):"
        ),
        "",
        "| shown as | read | right | open | wrong |",
        "| --- | --: | --: | --: | --: |",
    ]
    for sure in (*_SURE, None):
        number = [
            sum(count for (of, told), count in counts.items() if sure in (of, None) and told == judgement)
            for judgement in (RIGHT, OPEN, WRONG)
        ]
        cells = " | ".join(str(value) for value in (sum(number), *number))
        lines.append(f"| {sure or '**all**'} | {cells} |")
    said = [row for row in one.endpoints if row.why]
    return [*lines, *(["", *(_endpoint(row) for row in said)] if said else [])]


def _endpoint(row: Endpoint) -> str:
    return f"- {row.judgement}, {row.sure}, {row.repository}, `{row.path}:{row.line}`, `{row.name}`: {row.why}"


def _findings(one: HeldOut) -> list[str]:
    on, notes = one.warnings.findings, one.notes
    population = sum(one.warnings.population.values())
    lines = [
        (
            f"{len(on)} of {population} warnings and errors "
            f"([`held_out_{one.name}.yaml`](../tests/fixtures/graph_findings/held_out_{one.name}.yaml)), "
            f"{len(notes)} of {one.about.notes} notes "
            f"([`notes.yaml`](../tests/fixtures/held_out/{one.name}/notes.yaml)):"
        ),
        "",
        "| rule | warnings and errors read | true | notes read | true |",
        "| --- | --: | --: | --: | --: |",
    ]
    for rule in sorted({row.rule for row in (*on, *notes)}):
        lines.append(
            f"| `{rule}` | {_counted(row for row in on if row.rule == rule)} | "
            f"{_counted(row for row in notes if row.rule == rule)} |"
        )
    lines.append(f"| **all** | {_counted(on)} | {_counted(notes)} |")
    untrue = [row for row in (*on, *notes) if not row.verdict]
    return [*lines, "", "Not true, and why:", "", *_together(untrue)]


def _counted(rows: Iterable[Judgement]) -> str:
    verdicts = [bool(row.verdict) for row in rows]
    return f"{len(verdicts)} | {sum(verdicts)}" if verdicts else " | "


def _together(rows: Iterable[Judgement]) -> list[str]:
    """Return findings as lines, those of one rule, severity, repository and reason in one."""
    found: dict[tuple[str, str, str, str], list[str]] = {}
    for row in rows:
        key = ("note" if row.severity == "note" else "**on**", row.rule, row.repository, row.why)
        found.setdefault(key, []).append(f"`{row.path}:{row.line}`")
    return [
        f"- {kind}, `{rule}`, {repository}, {', '.join(dict.fromkeys(places))}: {why}"
        for (kind, rule, repository, why), places in found.items()
    ]


def _share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.1f} %" if whole else "-"
