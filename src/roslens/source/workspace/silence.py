"""Which findings count, which were set aside, and mistakes in how they were set aside."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec

from roslens.model.finding import Finding, RuleInfo, Severity, fingerprint
from roslens.model.set_aside import Disposition, SetAside
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.settings import IgnoreRule
from roslens.source.workspace.acceptances import Acceptances
from roslens.source.workspace.globs import compiled
from roslens.source.workspace.suppress import Suppression, covering, names

Suppressions = Mapping[str, Sequence[Suppression]]
"""The comments of each file, by its path."""

TAGS = ("suppression",)
UNUSED = RuleInfo(
    "roslens.suppression_unused",
    "Suppression without effect",
    "A comment suppresses findings, and there are none of these at its place.",
    Severity.NOTE,
    TAGS,
    "It hides the next finding there, which has not been reviewed. Remove it.",
    "roslens",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
)
UNKNOWN = RuleInfo(
    "roslens.suppression_unknown",
    "Suppression of an unknown rule",
    "A comment names a rule or a tag that does not exist in this run.",
    Severity.NOTE,
    TAGS,
    "A mistyped id suppresses nothing, and the id of a removed rule is misleading. See `roslens explain ID`.",
    "roslens",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
)
NO_REASON = RuleInfo(
    "roslens.suppression_without_reason",
    "Suppression without a reason",
    "A comment suppresses findings without a reason.",
    Severity.NOTE,
    TAGS,
    "Later readers cannot judge whether the suppression is still justified. Add a reason after the brackets.",
    "roslens",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
)
IGNORE_UNUSED = RuleInfo(
    "roslens.ignore_unused",
    "[[ignore]] without effect",
    "An [[ignore]] of the configuration matches no finding.",
    Severity.NOTE,
    TAGS,
    "It hides the next finding that it happens to match. Remove it, or correct its paths and rules.",
    "roslens",
    scope="workspace",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
)
ACCEPTANCE_UNUSED = RuleInfo(
    "roslens.acceptance_unused",
    "Accepted finding no longer exists",
    "The file of accepted findings has an entry for a finding that no longer exists.",
    Severity.NOTE,
    TAGS,
    "Remove it with `roslens accept --undo`, so that the file is up to date.",
    "roslens",
    scope="workspace",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
)
RULES = (UNUSED, UNKNOWN, NO_REASON, IGNORE_UNUSED, ACCEPTANCE_UNUSED)
"""Rules about setting findings aside."""

_GRAPH = "graph."


class Nameable(msgspec.Struct, frozen=True):
    """Rules that a comment may name, and the ids of those that looked at its package.

    ``tools`` are names of foreign tools, whose rules are not all known.
    """

    known: tuple[RuleInfo, ...] = ()
    ran: frozenset[str] = frozenset()
    tools: frozenset[str] = frozenset()


class Sorted(msgspec.Struct, frozen=True):
    """Findings that count, and those that were set aside."""

    kept: tuple[Finding, ...]
    set_aside: tuple[SetAside, ...] = ()


class Silence:
    """What a workspace sets aside, besides the comments in its files."""

    def __init__(self, ignore: Sequence[IgnoreRule] = (), acceptances: Acceptances | None = None) -> None:
        """``ignore`` are those of the configuration, in its order."""
        self._ignore = [(rule, compiled(rule.paths)) for rule in ignore]
        self.acceptances = acceptances or Acceptances()

    def sorted_out(
        self, findings: Iterable[Finding], suppressions: Suppressions, *, folder: str = "", package: str = ""
    ) -> Sorted:
        """Return which findings count, and which not.

        Args:
            findings: in any order, which is kept.
            suppressions: comments of the files.
            folder: of the package, for findings that have no file.
            package: id that findings which were set aside get.
        """
        kept, aside = [], []
        for finding in findings:
            one = self._comment(finding, suppressions) or self._ignored(finding, folder) or self._accepted(finding)
            if one is None:
                kept.append(finding)
            else:
                aside.append(msgspec.structs.replace(one, package=package))
        return Sorted(tuple(kept), tuple(aside))

    def _comment(self, finding: Finding, suppressions: Suppressions) -> SetAside | None:
        known = suppressions.get(finding.path)
        if not known:
            return None
        for one in covering((finding.rule, *finding.witnesses), finding.tags, finding.line, known):
            return SetAside(finding, Disposition.SUPPRESSED, one.reason, f"{finding.path}:{one.comment}")
        return None

    def _ignored(self, finding: Finding, folder: str) -> SetAside | None:
        place = finding.path or folder
        for number, (rule, paths) in enumerate(self._ignore, 1):
            if rule.paths and not (paths and place and paths.fullmatch(place)):
                continue
            if not rule.rules or any(names(name, finding.rule, finding.tags) for name in rule.rules):
                return SetAside(finding, Disposition.IGNORED, rule.reason, ignore_name(number))
        return None

    def _accepted(self, finding: Finding) -> SetAside | None:
        entry = self.acceptances.of(finding)
        return SetAside(finding, entry.state, entry.reason, entry.fingerprint) if entry else None

    def without_effect(
        self, used: Iterable[str], configuration: str, accepted: str, judged: Iterable[str]
    ) -> tuple[Finding, ...]:
        """Return a note for each ``[[ignore]]`` and each entry of the accepted that set nothing aside.

        Args:
            used: :attr:`SetAside.by` of all that was set aside.
            configuration: path of the configuration.
            accepted: path of the file of accepted findings.
            judged: ids of the rules of the run; an entry of another rule may be of use to another run.
        """
        there, ran = set(used), set(judged)
        found = [
            _note(
                IGNORE_UNUSED,
                configuration,
                0,
                f"{ignore_name(number)} matches no finding: {rule.reason}",
                str(number),
            )
            for number, (rule, _) in enumerate(self._ignore, 1)
            if ignore_name(number) not in there and not _of_graph(rule.rules)
        ]
        found += [
            _note(
                ACCEPTANCE_UNUSED,
                accepted,
                0,
                f"{entry.fingerprint} was accepted and no longer exists: {entry.rule} {entry.path}".rstrip(),
                entry.fingerprint,
            )
            for entry in self.acceptances.entries
            if entry.fingerprint not in there and entry.rule in ran and not _of_graph((entry.rule,))
        ]
        return tuple(found)


def ignore_name(number: int) -> str:
    """Return how an ``[[ignore]]`` of the configuration is named, counted from 1."""
    return f"[[ignore]] {number}"


def about_comments(suppressions: Suppressions, findings: Sequence[Finding], rules: Nameable) -> Iterator[Finding]:
    """Yield mistakes in suppression comments of roslens; those of other tools are not checked.

    Args:
        suppressions: comments of the files.
        findings: all there were before any was set aside.
        rules: that may be named.
    """
    used = {
        (finding.path, one)
        for finding in findings
        if finding.path in suppressions
        for one in covering((finding.rule, *finding.witnesses), finding.tags, finding.line, suppressions[finding.path])
    }
    for path, comments in suppressions.items():
        seen: Counter[tuple[str, str]] = Counter()
        for one in comments:
            if not one.spelled.startswith("ignore"):
                continue
            written = f"{one.spelled}[{', '.join(one.rules)}]" if one.rules else one.spelled
            for rule, message in _wrong(one, written, (path, one) in used, rules):
                yield _note(rule, path, one.comment, message, written, seen[rule.id, written])
                seen[rule.id, written] += 1


def _wrong(one: Suppression, written: str, used: bool, rules: Nameable) -> Iterator[tuple[RuleInfo, str]]:
    known = rules.known
    foreign = [name for name in one.rules if name.partition(".")[0] in rules.tools]
    unknown = [
        name for name in one.rules if name not in foreign and not any(names(name, rule.id, rule.tags) for rule in known)
    ]
    for name in unknown:
        from difflib import get_close_matches

        near = get_close_matches(name, [*(rule.id for rule in known), *{tag for rule in known for tag in rule.tags}], 1)
        meant = f"; did you mean {near[0]}?" if near else ""
        yield UNKNOWN, f'`{written}`: no rule of this run has the id or tag "{name}"{meant}'
    # It may suppress findings of another profile or of computation graphs, which this run does not have.
    meant_rules = [rule for rule in known for name in one.rules if names(name, rule.id, rule.tags)]
    if meant_rules and not used and not unknown and not foreign and all(rule.id in rules.ran for rule in meant_rules):
        yield UNUSED, f"`{written}` suppresses nothing"
    if not one.reason:
        yield NO_REASON, f"`{written}` has no reason"


def _of_graph(rules: Iterable[str]) -> bool:
    return any(name.startswith(("graph", "*")) for name in rules)


def _note(rule: RuleInfo, path: str, line: int, message: str, context: str, ordinal: int = 0) -> Finding:
    entity = f"file:{path}" if path else ""
    return Finding(
        rule.id,
        rule.severity,
        message,
        path,
        line,
        entity=entity,
        tags=rule.tags,
        tool=rule.tool,
        fingerprint=fingerprint(rule.id, entity, context, ordinal),
        consequence=rule.consequence,
        certainty=rule.certainty,
    )
