"""The pages that tell how many findings are true: of the graph, and of coding rules."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence

from graph_findings.again import read_again
from graph_findings.first_findings import read_shown, section
from graph_findings.judgements import ROOT, Judgement, Sample
from graph_findings.mendings import read_mendings, since
from graph_findings.standing import BOUND, READ, SPREAD, Standing, standing_of
from graph_findings.tool_findings import read_tools, tool_section
from roslens.model.finding import Severity
from roslens.source.rules.graph.findings import RULES
from roslens.source.rules.table import native_rules

PAGE = ROOT / "docs" / "accuracy_of_graph_rules.md"
RULES_PAGE = ROOT / "docs" / "accuracy_of_rules.md"
MEASURED = ROOT / "src" / "roslens" / "source" / "rules" / "field" / "precision.toml"
GOAL = 0.8
"""A rule of which less is true is a note."""
_FEW = 5
_HEAD = """# How many findings of the graph are true

Written by `make graph-findings` from the tables in
[`tests/fixtures/graph_findings`](../tests/fixtures/graph_findings); do not edit. The command line
(`roslens check --graph` and `roslens graph --check`, without a `roslens.toml`) looked at each repository as it is at
its commit. Of the warnings and errors of each [rule](reference/graph_rules.md) a sample was drawn with a seed, and each
place was read: a finding is *true* where a maintainer would agree that it is a real problem worth acting on. A finding
that is right and of no use is not true.

A rule that is a warning or an error has at least 80 % of them true; one that has not is a note. Where fewer than 5 were
found, the share says little.

To measure on other repositories: `PYTHONPATH=tests python -m graph_findings sample FOLDER --seed N -o FILE.yaml` draws
the sample of the clones below a folder, `verdict` and `why` are filled in by hand, the file goes to the tables, and
`make graph-findings` writes this page. `--developed` says that rules were changed because of these repositories,
`--judged FILE` takes verdicts over that are known of the same commits.
"""


_NATIVE_HEAD = """# How many findings of coding rules are true

Written by `make graph-findings` from the tables in
[`tests/fixtures/rule_findings`](../tests/fixtures/rule_findings); do not edit. `roslens check`, without a
`roslens.toml`, looked at each repository as it is at its commit. Of the warnings and errors of each
[rule](reference/rules.md) in code that counts a sample was drawn with a seed, and each place was read: a finding is
*true* where a maintainer would agree that it is a real problem worth acting on. A finding that is right and of no use
is not true.

A rule that is on by default and a warning or an error has at least 90 % of them true; one that has not is mended, a
note, or off. Where fewer than 5 were found, the share says little.

Each table is of the rules as they were when it was drawn, and stays; what one showed was mended before the next was
drawn, on other repositories. What was read before a rule was mended still counts in its share here and on its own page.

To measure on other repositories: `PYTHONPATH=tests python -m graph_findings sample FOLDER --native --seed N -o FILE`
draws the sample of the clones below a folder, `verdict` and `why` are filled in by hand, the file goes to the tables,
and `make graph-findings` writes this page and what the pages of rules say of it.
"""


_OVERVIEW = """\
What was read of each rule; of one that was below {bound:.0f} %, since the cause was mended. Enough is at least {read}
findings of at least {spread} repositories, drawn with a seed. Where there are fewer, it is every finding of the last
table that has any: how often the rule is true in the repositories that are named is then known, not estimated, although
they may be few, and older tables may hold findings that nobody read. Of a rule of which none was found no share is
known: it rests on its fixtures. The last table on all rules is of {looked_at} repositories, the one before it of
{before}. A rule of which five or more were read and less than {bound:.0f} % are true is a note or off, which a test
sees to."""
_BELOW = """\
Below {:.0f} % over all tables, however few were read, and warnings or errors all the same: each was mended by the cause
of what was not true. What was read before still counts in its share; what was read in tables that were drawn since
measures the rule as it is."""
_WEIGHTED = """\
Each rule weighted by how many warnings and errors there were of it, {:.0f} % of those that a user saw were true."""
_NOTES_BY_NOW = """\
Below {:.0f} % over all tables, with five or more read, and notes by now: whether it is a mistake the code does not say
often enough.

{}."""


def rules_page(found: Mapping[str, Sample]) -> str:
    """Return the page on coding rules."""
    rules = native_rules()
    on = [rule.id for rule in rules.values() if rule.profiles and rule.severity is not Severity.NOTE]
    errors = {rule.id for rule in rules.values() if rule.profiles and rule.severity is Severity.ERROR}
    by_default = {rule.id for rule in rules.values() if {"ros1", "ros2"} & set(rule.profiles)}
    usual = [one for one in on if one in by_default]
    overview, together = _overview(found, usual, errors), _together(found, usual, errors)
    return _page(
        "\n".join((_NATIVE_HEAD, *overview, *together, *section(read_shown()), *_again(), *tool_section(read_tools()))),
        on,
        found,
    )


def _again() -> list[str]:
    """Return how many of the findings that were read are left after what they showed was mended."""
    lines = ["## After the mending", ""]
    lines.append("Findings that were read, and those of them that the rules as they are now still report:")
    lines += ["", "| table | true | not true | true now | not true now | share now |"]
    lines.append("| --- | --: | --: | --: | --: | --: |")
    for name, (true, false, now_true, now_false) in sorted(read_again().items()):
        share = 100 * now_true / (now_true + now_false)
        lines.append(f"| {name.replace('_', ' ')} | {true} | {false} | {now_true} | {now_false} | {share:.0f} % |")
    return [*lines, "", "The rules were changed because of these repositories: it is no measurement of other ones.", ""]


def _together(found: Mapping[str, Sample], on: Sequence[str], errors: Container[str]) -> list[str]:
    """Return what all tables say of the rules that are on by default."""
    sums = totals(found)
    known, least = [one for one in on if sums.get(one, (0, 0))[1]], 100 * BOUND
    mendings = read_mendings()
    below = [one for one in known if 100 * sums[one][0] < least * sums[one][1]]
    lines = ["## All tables together", ""]
    lines.append(
        f"Of {len(on)} rules that are on by default as warnings or errors, {len(known)} were found in the field; of "
        f"{sum(sums[one][1] >= _FEW for one in known)} five or more findings were read."
    )
    lines += ["", _BELOW.format(least), ""]
    for rule in below:
        true, read = sums[rule]
        mending = mendings[rule]
        later = since(rule, mending, found)
        measured_since = "{} of {}".format(*later) if later[1] else "none read"
        after = mending.after.replace("_", " ")
        lines.append(f"- `{rule}`: {true} of {read}; since mended after {after}: {measured_since} ({mending.cause})")
    notes = [rule.id for rule in native_rules().values() if rule.profiles and rule.severity is Severity.NOTE]
    less = [
        f"`{one}` ({sums[one][0]} of {sums[one][1]})"
        for one in notes
        if one in sums and sums[one][1] >= _FEW and 100 * sums[one][0] < least * sums[one][1]
    ]
    lines += ["", _NOTES_BY_NOW.format(least, ", ".join(less))]
    few = [one for one in on if one in errors and sums.get(one, (0, 0))[1] < _FEW]
    lines += [
        "",
        "Errors of which fewer than five findings were read, so that their severity rests on what they say:",
        "",
    ]
    lines += [f"- `{one}`: {'{} of {} true'.format(*sums[one]) if one in known else 'none read'}" for one in few]
    silent = [f"`{one}`" for one in on if one not in known]
    lines += ["", f"Never found in the field ({len(silent)}): {', '.join(silent)}.", ""]
    return lines


def _overview(found: Mapping[str, Sample], on: Sequence[str], errors: Container[str]) -> list[str]:
    """Return what is known of each rule that is on by default, and whether that is as much as is wanted."""
    mendings = read_mendings()
    known = {rule: standing_of(rule, mendings.get(rule), found) for rule in on}
    complete = (one for one in found.values() if not one.developed_on and not one.only)
    looked_at = [len(one.repositories) - len(one.not_read) for one in sorted(complete, key=lambda one: one.seed)]
    before, last = looked_at[-2:]
    lines = [
        "## Each rule that warns by default", "",
        _OVERVIEW.format(read=READ, spread=SPREAD, bound=100 * BOUND, looked_at=last, before=before), "",
        "| rule | severity | read | repositories | true | enough? |", "| --- | --- | --: | --: | --: | --- |",
    ]  # fmt: skip
    for rule, one in known.items():
        severity = "error" if rule in errors else "warning"
        share = f"{100 * one.true / one.read:.0f} %" if one.read else "-"
        lines.append(f"| `{rule}` | {severity} | {one.read} | {one.repositories} | {share} | {_enough(one)} |")
    sampled = sum(one.sampled for one in known.values())
    counted = sum(one.counted and not one.sampled for one in known.values())
    absent = [rule for rule, one in known.items() if one.absent]
    left = [rule for rule, one in known.items() if not one.met and not one.absent]
    return [
        *lines, "",
        f"Of {len(on)} rules, {sampled} were sampled in full, of {counted} every finding was read, of {len(absent)} "
        f"there was none in the last table on them, and {len(left)} are not measured as wanted"
        + (": " + ", ".join(f"`{rule}`" for rule in left) if left else "") + ".", "",
    ]  # fmt: skip


def _enough(one: Standing) -> str:
    if one.sampled:
        return "yes: sampled"
    if one.counted:
        every = f"all {one.whole} findings" if one.whole > 1 else "the one finding"
        return f"yes: {every} of {one.looked_at} repositories {'were' if one.whole > 1 else 'was'} read"
    if one.absent:
        return f"none found in {one.looked_at} repositories"
    return "no: fewer read although more exist" if one.read else "no: none read since it was mended"


def totals(found: Mapping[str, Sample]) -> dict[str, tuple[int, int]]:
    """Return of each rule how many findings were true and read, over the samples to which nothing was tuned."""
    sums: dict[str, tuple[int, int]] = {}
    for sample in found.values():
        if sample.developed_on:
            continue
        for rule, (true, read) in shares(sample).items():
            held = sums.get(rule, (0, 0))
            sums[rule] = held[0] + true, held[1] + read
    return sums


def measured(*every: Mapping[str, Sample]) -> str:
    """Return the data of rules: how many findings were true of how many read, where nothing was tuned to them.

    Args:
        every: the samples of coding rules, and those of rules of the graph.
    """
    counts = {rule: count for found in every for rule, count in totals(found).items()}
    lines = [f'"{rule}" = [{true}, {read}]' for rule, (true, read) in sorted(counts.items()) if read]
    return "\n".join(("# Findings that were true, and that were read: `make graph-findings` writes it.", *lines)) + "\n"


def page(found: Mapping[str, Sample]) -> str:
    """Return the page of some samples, those of repositories that nothing was tuned to first."""
    return _page(_HEAD, [one.id for one, _ in RULES if one.severity is not Severity.NOTE], found)


def _page(head: str, on: Sequence[str], found: Mapping[str, Sample]) -> str:
    lines = [head]
    for name, one in sorted(found.items(), key=lambda item: (item[1].developed_on, item[1].seed, item[0])):
        lines += _section(name, one, on)
    return "\n".join(lines).rstrip("\n") + "\n"


def shares(sample: Sample) -> dict[str, tuple[int, int]]:
    """Return of each rule how many are true, and how many were judged."""
    found: dict[str, list[bool]] = {rule: [] for rule in sample.population}
    for one in sample.findings:
        if one.verdict is not None:
            found.setdefault(one.rule, []).append(one.verdict)
    return {rule: (sum(verdicts), len(verdicts)) for rule, verdicts in sorted(found.items())}


def _weighted(sample: Sample) -> float:
    """Return the share of findings that are true in percent, each rule weighted by how many there were of it."""
    known = {rule: true / judged for rule, (true, judged) in shares(sample).items() if judged}
    number = sum(sample.population.get(rule, 0) for rule in known)
    return 100 * sum(sample.population.get(rule, 0) * share for rule, share in known.items()) / number


def _section(name: str, sample: Sample, on: Sequence[str]) -> list[str]:
    tuned = "rules were changed because of what they found here" if sample.developed_on else "no rule was tuned to them"
    read = len(sample.repositories) - len(sample.not_read)
    spread = f", {sample.per_repository} of one repository" if sample.per_repository else ""
    drawing = f"Seed {sample.seed}, at most {sample.per_rule} of each rule{spread}"
    if sample.whole:
        drawing += f"; all of a rule of which there are at most {sample.per_rule}"
    if sample.only:
        drawing += f"; only of {len(sample.only)} rules that were mended before"
    if sample.spared:
        named = ", ".join(f"`{rule}` ({most})" for rule, most in sample.spared.items())
        drawing += f"; fewer where enough was read before: {named}"
    lines = [
        f"## {name.replace('_', ' ').capitalize()}",
        "",
        f"{read} repositories; {tuned}. {drawing}.",
        "",
        "| rule | warnings and errors | read | true | share | notes besides |",
        "| --- | --: | --: | --: | --: | --: |",
    ]
    every = shares(sample)
    for rule, (true, judged) in every.items():
        lines.append(
            f"| `{rule}` | {_row(sample.population.get(rule, 0), true, judged)} | {sample.notes.get(rule, 0)} |"
        )
    total = sum(true for true, _ in every.values()), sum(judged for _, judged in every.values())
    lines.append(f"| all | {_row(sum(sample.population.values()), *total)} | {sum(sample.notes.values())} |")
    if total[1]:
        lines += ["", _WEIGHTED.format(_weighted(sample))]
    silent = sorted(one for one in on if one not in every and sample.looks_at(one))
    if silent:
        named = ", ".join(f"`{rule}`" for rule in silent)
        lines += ["", f"Nothing is known of these, of which no warning or error was found here: {named}."]
    quiet = sorted(set(sample.notes) - set(every))
    if quiet:
        lines += ["", "Notes only: " + ", ".join(f"`{rule}` ({sample.notes[rule]})" for rule in quiet) + "."]
    for title, verdict in (("Not true, and why", False), ("True", True)):
        rows = [one for one in sample.findings if one.verdict is verdict]
        if rows:
            lines += ["", f"### {title}: {name.replace('_', ' ')}", "", *(_judged(one) for one in rows)]
    lines += ["", f"### Repositories: {name.replace('_', ' ')}", ""]
    lines += [_repository(each, commit, sample) for each, commit in sorted(sample.repositories.items())]
    return [*lines, ""]


def _row(population: int, true: int, judged: int) -> str:
    share = f"{100 * true / judged:.0f} %" if judged else "-"
    few = " (few)" if 0 < judged < _FEW else ""
    return f"{population} | {judged} | {true} | {share}{few}"


def _judged(one: Judgement) -> str:
    place = f"{one.path}:{one.line}" if one.line else one.path
    return f"- `{one.rule}`, {one.repository}, `{place}`: {one.why}"


def _repository(name: str, commit: str, sample: Sample) -> str:
    reason = f": not read, {sample.not_read[name]}" if name in sample.not_read else ""
    return f"- {name} at `{commit[:9]}`{reason}"
