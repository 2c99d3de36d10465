"""The result for a person at a terminal: packages worst first, findings by rule, failures, what to do next.

It shows what matters most and says how much it leaves out and where that is. Made from summaries alone, so that it is
quick for any workspace.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath

from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount, RunHeader
from roslens.model.source import number_of_packages
from roslens.model.tags import TagFilter
from roslens.model.words.plural import plural
from roslens.report.run.finding_text import LINES, Whole, fix_first_lines, place_lines, weight_of, whole_lines
from roslens.report.run.fix_first import counted, first_to_fix, new_before_others
from roslens.report.run.package_table import PackageCounts, count_packages, package_table
from roslens.report.run.rule_groups import RuleGroup, listing, rule_groups
from roslens.report.writing.terminal import Terminal, columns, left, right

PACKAGES = 15
RULES = 10
FAILURES = 6
PLACES = 3
COPIES = 5
RULE_WIDTH = 36
GRAVE = 20
"""Findings with a grave consequence that are printed one by one below their rules."""
LEAST_WIDTH = 60
ALL = "All: roslens report"
_NONE = Whole()


def to_text(
    header: RunHeader,
    packages: Sequence[PackageSummary],
    failures: Sequence[Failure],
    rules: Sequence[RuleInfo],
    *,
    findings: Sequence[Finding] = (),
    set_aside: Mapping[str, int] | None = None,
    since: Sequence[str] = (),
    new: Sequence[RuleCount] = (),
    whole: Whole = _NONE,
    tags: TagFilter | None = None,
    changes: Mapping[str, int] | None = None,
    revision: str = "",
    width: int = 100,
    color: bool = False,
    unicode: bool = True,
) -> str:
    """Return the result as text that ends with a line break.

    Args:
        header: of the run.
        packages: summaries of all packages.
        failures: everything that could not be done.
        rules: what rules are about.
        findings: those of no package.
        set_aside: how many findings count nowhere, by :class:`roslens.model.set_aside.Disposition`.
        since: what is new since a baseline and whether the gate is passed, a line each.
        new: what to mend first of what is new since a baseline; it goes before everything else.
        whole: findings that are printed one by one.
        tags: which findings are meant; all for None.
        changes: in how many commits of the last year files of findings changed, as far as known.
        revision: with which the files were compared, where only those that differ were looked at.
        width: columns of the terminal; less than :data:`LEAST_WIDTH` counts as that.
        color: whether the terminal shows colours.
        unicode: whether its encoding has more than ASCII; without, only ASCII is used.
    """
    terminal = Terminal(max(LEAST_WIDTH, width), color, unicode)
    wanted = tags or TagFilter()
    counts = count_packages(packages, wanted)
    of_workspace = [finding for finding in findings if wanted.matches(finding.tags)]
    about = {rule.id: rule for rule in rules}
    groups = rule_groups(packages, [finding for finding in of_workspace if finding.gated], wanted, about, changes or {})
    others = first_to_fix(packages, of_workspace, about, wanted, changes, whole.grave)
    few = {counted(one).example for one in whole.new or ()}
    first = () if whole.new is not None else new
    chosen = tuple(one for one in new_before_others(first, others) if one.example not in few)
    told = few | {one.example for one in chosen}
    aside = _aside(packages, wanted) + sum(not finding.gated for finding in of_workspace)
    hushed = _set_aside(terminal, set_aside or {})
    sections = [
        list(_head(terminal, header, packages)),
        list(_new(terminal, whole, about, revision)),
        list(fix_first_lines(terminal, chosen, len(first), about, changes or {})),
        list(_packages(terminal, counts, revision)),
        [
            *_findings(terminal, groups, about, wanted, aside, whole, told, analysed=bool(packages)),
            *_fixable(terminal, packages, wanted),
            *hushed,
            *_copies(terminal, packages),
            *(line for text in since for line in _quiet(terminal, text)),
            *(_quiet(terminal, terminal.clean(header.graphs.note())) if header.graphs else ()),
        ],
        list(_failures(terminal, failures)),
        list(_next(terminal, groups, failures, packages, revision)),
    ]
    return "\n\n".join("\n".join(section) for section in sections if section) + "\n"


def _head(terminal: Terminal, header: RunHeader, packages: Sequence[PackageSummary]) -> Iterator[str]:
    facts = [
        plural(number_of_packages(package.id for package in packages), "package"),
        plural(sum(package.files for package in packages), "file"),
    ]
    if lines := sum(package.values.get("loc", 0) for package in packages):
        facts.append(f"{lines:,.0f} lines of code")
    parts = [", ".join(facts)]
    if header.models:
        parts.append(f"{'model' if len(header.models) == 1 else 'models'} {', '.join(header.models)}")
    if target := header.configuration.get("target"):
        parts.append(str(target))
    if header.commit:
        short = header.commit[:10] + ("+" if header.commit.endswith("+") else "")
        parts.append(f"commit {short}")
    parts = [terminal.cut(terminal.clean(part), terminal.width - 2) for part in parts]
    separator = f" {terminal.glyph('dot')} "
    name = terminal.clean(PurePath(header.root).name or header.root)
    name = terminal.cut(name, max(10, terminal.width - columns(separator) - columns(parts[0])))
    line = terminal.paint(name, "title") + separator + parts[0]
    taken = columns(name) + columns(separator) + columns(parts[0])
    for part in parts[1:]:
        taken += columns(separator) + columns(part)
        if taken > terminal.width:
            yield line
            line, taken = f"  {part}", columns(part) + 2
        else:
            line += separator + part
    yield line


def _packages(terminal: Terminal, counted: Sequence[PackageCounts], revision: str) -> Iterator[str]:
    if not counted:
        yield f"No file of a package differs from {revision}." if revision else "No packages were found."
        return
    shown = counted[:PACKAGES]
    yield from package_table(terminal, shown, counted)
    if len(shown) < len(counted):
        rest = sum(package.total for package in counted[PACKAGES:])
        others = plural(rest, "finding") if rest else "no finding"
        text = f"{len(shown)} of {plural(len(counted), 'package')}, worst first; {others} in the others"
        yield from _quiet(terminal, f"{text}. {ALL}")


def _findings(
    terminal: Terminal,
    groups: Sequence[RuleGroup],
    rules: dict[str, RuleInfo],
    tags: TagFilter,
    aside: int,
    whole: Whole,
    told: Collection[str],
    *,
    analysed: bool,
) -> Iterator[str]:
    with_tags = f" with the tags {tags}" if tags else ""
    if groups:
        yield terminal.paint(terminal.cut(f"Findings{with_tags}: {_amounts(groups)}", terminal.width), "title")
    elif analysed:
        fine = terminal.paint(f"{terminal.glyph('fine')} No findings{with_tags}", "fine")
        yield f"{fine} in what was analysed"
    found = listing(groups)
    if not whole.alone:
        yield from _rules(terminal, found.listed, rules, whole, told)
    if found.limits and not whole.alone:
        yield from _quiet(terminal, terminal.clean(f"{_limits_text(found.limits)}. {ALL}"))
    if found.notes and not whole.alone:
        yield from _quiet(terminal, terminal.clean(f"{_notes_text(found.notes)}. {ALL}"))
    if aside:
        verb = "does" if aside == 1 else "do"
        yield from _quiet(
            terminal, f"{plural(aside, 'more finding')} in test, generated or vendored code {verb} not count here"
        )


def _copies(terminal: Terminal, packages: Iterable[PackageSummary]) -> Iterator[str]:
    """Yield which packages are copies of others' projects, and how to count them all the same."""
    copies = [package for package in packages if package.copy_of]
    if not copies:
        return
    names = ", ".join(package.name for package in copies[:COPIES])
    more = f" and {len(copies) - COPIES:,} more" if len(copies) > COPIES else ""
    kind = "copy of another project, and counts" if len(copies) == 1 else "copies of other projects, and count"
    verb = "is a" if len(copies) == 1 else "are"
    yield from _quiet(
        terminal,
        terminal.clean(
            f"{plural(len(copies), 'package')} {verb} {kind} as vendored code: {names}{more}. To count as own code: "
            f'own = ["{copies[0].path}/**"] below [workspace] in roslens.toml'
        ),
    )


def _amounts(groups: Iterable[RuleGroup]) -> str:
    totals = dict.fromkeys(reversed(Severity), 0)
    for group in groups:
        totals[group.severity] += group.count
    return ", ".join(plural(count, severity.value) for severity, count in totals.items() if count)


def _rules(
    terminal: Terminal,
    groups: Sequence[RuleGroup],
    rules: Mapping[str, RuleInfo],
    whole: Whole,
    told: Collection[str],
) -> Iterator[str]:
    shown = groups[:RULES]
    count_width = max((len(f"{group.count:,}") for group in shown), default=0)
    rule_width = max((columns(terminal.clean(group.rule)) for group in shown), default=0)
    room = GRAVE
    for group in shown:
        every = [
            one
            for one in whole.grave
            if (one.rule, one.severity) == (group.rule, group.severity) and counted(one).example not in told
        ]
        width = min(rule_width, RULE_WIDTH)
        yield from _rule(terminal, group, rules.get(group.rule), count_width, width, every[: max(room, 1)], told)
        room -= len(every)
    if len(shown) < len(groups):
        rest = sum(group.count for group in groups[RULES:])
        others = plural(rest, "finding")
        text = f"{len(shown)} of {plural(len(groups), 'rule')}, worst first; {others} of the others"
        yield from _quiet(terminal, f"{text}. {ALL}")


def _new(terminal: Terminal, whole: Whole, rules: Mapping[str, RuleInfo], revision: str) -> Iterator[str]:
    if whole.new:
        count = plural(len(whole.new), "finding" if revision else "new finding")
        yield terminal.paint(f"{count} in changed files" if revision else count, "title")
        yield from whole_lines(terminal, whole.new, rules)


def _set_aside(terminal: Terminal, counts: Mapping[str, int]) -> Iterator[str]:
    if total := sum(counts.values()):
        parts = ", ".join(f"{counts[state]:,} {words}" for state, words in _STATES.items() if counts.get(state))
        verb = "is" if total == 1 else "are"
        yield from _quiet(terminal, f"{plural(total, 'finding')} {verb} set aside: {parts}. List: --format json")


_STATES = {
    "suppressed": "by comments",
    "ignored": "by [[ignore]]",
    "accepted": "accepted",
    "false_positive": "false positives",
}


def _limits_text(limits: Sequence[RuleGroup]) -> str:
    count = sum(group.count for group in limits)
    most = max(limits, key=lambda group: group.count)
    rules = plural(len({group.rule for group in limits}), "rule")
    return f"{plural(count, 'limit')} of metrics of {rules}, none far exceeded, most of {most.rule} ({most.count:,})"


def _notes_text(notes: Sequence[RuleGroup]) -> str:
    count = sum(group.count for group in notes)
    most = max(notes, key=lambda group: group.count)
    rules = plural(len({group.rule for group in notes}), "rule")
    return f"{plural(count, 'note')} of {rules}, most of {most.rule} ({most.count:,})"


def _rule(
    terminal: Terminal,
    group: RuleGroup,
    rule: RuleInfo | None,
    count_width: int,
    rule_width: int,
    every: Sequence[Finding],
    told: Collection[str],
) -> Iterator[str]:
    severity = group.severity.value
    mark = terminal.paint(f"{terminal.glyph(severity)} {left(severity, 7)}", severity)
    count = right(f"{group.count:,}", count_width)
    indent = " " * (2 + 2 + 7 + 2 + count_width + 2)
    room = terminal.width - len(indent)
    name = terminal.cut(terminal.clean(group.rule), room)
    about = terminal.clean(rule.title) if rule else ""
    if group.packages > 1:
        about = f"{about} ({plural(group.packages, 'package')})".lstrip()
    beside = columns(about) <= room - max(rule_width, columns(name)) - 2
    yield f"  {mark}  {count}  {left(name, rule_width)}  {about if beside else ''}".rstrip()
    if not beside:
        yield indent + terminal.shorten(about, room)
    yield indent + terminal.paint(terminal.cut(weight_of(group.weight, rule), room), "quiet")
    for one in every:
        for line in terminal.wrap(terminal.clean(counted(one).example), indent, lines=LINES):
            yield terminal.paint(line, "quiet")
        yield from place_lines(terminal, one, indent)
    if not every and group.example and group.example not in told:
        yield indent + terminal.paint(terminal.shorten(terminal.clean(group.example), room), "quiet")


def _failures(terminal: Terminal, failures: Sequence[Failure]) -> Iterator[str]:
    if not failures:
        return
    alike: dict[tuple[bool, str, str], list[Failure]] = {}
    for failure in sorted(failures, key=lambda failure: failure.partial):
        alike.setdefault((failure.partial, failure.tool, failure.advice), []).append(failure)
    whole = sum(not failure.partial for failure in failures)
    parts = [f"{whole:,}" if whole else "", f"{len(failures) - whole:,} in part" if len(failures) > whole else ""]
    yield terminal.paint(f"Not analysed: {', '.join(filter(None, parts))}", "title")
    groups = list(alike.values())
    for group in groups[:FAILURES]:
        yield from _failure(terminal, group)
    if len(groups) > FAILURES:
        rest = sum(map(len, groups[FAILURES:]))
        yield from _quiet(terminal, f"{rest:,} more. {ALL}")


def _failure(terminal: Terminal, alike: Sequence[Failure]) -> Iterator[str]:
    """Yield the first of failures that ask for the same remedy in full, a few more in a line each, and the remedy."""
    first = alike[0]
    state = "partly" if first.partial else "failed"
    indent = " " * (2 + 2 + 6 + 2)
    expected = f"; expected {first.expected}" if first.expected else ""
    lines = terminal.wrap(terminal.clean(f"{_what(first)}{expected} [{first.tool}]"), indent)
    mark = terminal.paint(f"{terminal.glyph(state)} {state}", state)
    yield f"  {mark}  {lines[0].lstrip()}"
    yield from lines[1:]
    for failure in alike[1:PLACES]:
        yield indent + terminal.cut(terminal.clean(_what(failure)), terminal.width - len(indent))
    if len(alike) > PLACES:
        yield f"{indent}and {len(alike) - PLACES:,} more like it"
    for line in terminal.wrap(terminal.clean(first.advice), indent):
        yield terminal.paint(line, "quiet")


def _what(failure: Failure) -> str:
    place = str(failure.location or failure.entity)
    return f"{place}: {failure.what}" if place else failure.what


def _next(
    terminal: Terminal,
    groups: Sequence[RuleGroup],
    failures: Sequence[Failure],
    packages: Sequence[PackageSummary],
    revision: str,
) -> Iterator[str]:
    steps = []
    if not packages and revision:
        steps.append(("roslens check", "analyse the whole workspace"))
        steps.append(("roslens check --changed REV", "compare with another revision, such as the branch to merge into"))
    elif not packages:
        steps.append(("roslens check PATH", "name a folder with a package.xml somewhere below it"))
    if groups:
        steps.append((f"roslens explain {terminal.clean(groups[0].rule)}", "what the rule requires, and why"))
    if packages:
        which = " --changed" if revision else ""
        steps.append((f"roslens serve{which}", "package graph, findings and metrics in a browser"))
        steps.append((f"roslens report{which} --single-file report.html", "the same in one file to pass on"))
    if any(not failure.partial for failure in failures):
        steps.append(("roslens doctor", "see what may be missing on this machine"))
    width = max(len(command) for command, _why in steps)
    yield terminal.paint("Next", "title")
    for command, why in steps:
        fits = 2 + width + 2 + len(why) <= terminal.width
        yield f"  {left(command, width)}  {terminal.paint(why, 'quiet') if fits else ''}".rstrip()


def _fixable(terminal: Terminal, packages: Iterable[PackageSummary], tags: TagFilter) -> Iterator[str]:
    """Yield how many of the findings that count have a fix, where any has."""
    count = sum(rule.fixable for package in packages for rule in package.rules if tags.matches(rule.tags))
    if count:
        of_these = "1 of these" if count == 1 else f"{count:,} of these"
        yield from _quiet(terminal, f"{of_these} can be fixed safely: roslens check --fix, or --diff to see it first")


def _aside(packages: Iterable[PackageSummary], tags: TagFilter) -> int:
    """Return how many findings do not count."""
    return sum(rule.count - rule.gated for package in packages for rule in package.rules if tags.matches(rule.tags))


def _quiet(terminal: Terminal, text: str) -> Iterator[str]:
    yield from (terminal.paint(line, "quiet") for line in terminal.wrap(text, "  "))
