"""The statements of section V of the 2016 paper about its corpus, each compared with its own raw data.

Constraints that claim something hold or do not; where the section gives figures, the figures of the data stand here and
nothing is claimed. All are reported in our words; Santos, Cunha, Macedo and Lourenço, A Framework for Quality
Assessment of ROS Repositories, IROS 2016, section V.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from roslens.model.study import Corpus, Correlation, RuleTotal, Statement
from roslens.source.study.paper_tables import METRIC_RULES

_SECTION = "V"
_SMALL = 300
_LOW = 0.5
_DOZEN = 12
_MOST_CODING = 5
_NO_RULES = "no table of rules was given"


def paper_statements(
    corpus: Corpus, rules: Sequence[RuleTotal], correlations: Sequence[Correlation]
) -> tuple[Statement, ...]:
    """Return the statements; those about rules are undecided without a table of rules."""
    return (
        _scope(corpus),
        _roles(corpus),
        _sizes(corpus),
        _findings(corpus, rules),
        _order(corpus, rules),
        *(
            _less_than_a_dozen(rules, rule, title)
            for rule, title in (("MAX_AVAILABLE_METHODS", "MAC"), ("MAX_WEIGHT_METHODS", "WMC"))
        ),
        *(_by_role(rules, rule) for rule in ("MIN_COM_RATIO", "MAX_COUPLING", "MAX_CC")),
        _coding(rules),
        _without_findings(corpus),
        _correlations(corpus, correlations),
    )


def _scope(corpus: Corpus) -> Statement:
    found = f"{len(corpus.packages)} packages with code in {len(corpus.repositories)} repositories"
    return Statement(_SECTION, "How many packages and repositories are looked at.", found, None)


def _sizes(corpus: Corpus) -> Statement:
    lines, comments = (int(sum(one.values.get(key, 0) for one in corpus.packages)) for key in ("loc", "comment_lines"))
    found = f"{lines:,} lines of code, {comments:,} of comments"
    return Statement(_SECTION, "How much code there is in all.", found, None)


def _findings(corpus: Corpus, rules: Sequence[RuleTotal]) -> Statement:
    """The corpus counts breaches of the model, and all others as coding rules, other models' limits among them."""
    model, others = (int(sum(one.values.get(key, 0) for one in corpus.packages)) for key in ("rqv", "rcv"))
    found = f"{model:,} of the quality model, {others:,} of all other rules, {model + others:,} together"
    reported = sum(one.count for one in rules if one.kind == "metric")
    if rules and reported != model:
        found += f"; the table of rules has {reported:,} of the quality model"
    return Statement(_SECTION, "How often rules are broken in all.", found, None)


def _roles(corpus: Corpus) -> Statement:
    roles = Counter(one.role for one in corpus.packages)
    found = ", ".join(f"{count} {role}" for role, count in roles.most_common())
    return Statement(_SECTION, "How packages divide among roles.", f"{len(corpus.packages)} packages: {found}", None)


def _order(corpus: Corpus, rules: Sequence[RuleTotal]) -> Statement:
    counted = int(sum(one.values.get("rqv", 0) for one in corpus.packages))
    reported = ", ".join(
        f"{METRIC_RULES[one.rule]} {one.count} (in {one.packages})" for one in rules if one.kind == "metric"
    )
    return Statement(
        _SECTION,
        "How the findings of the quality model divide among its rules, and in how many packages.",
        f"{counted:,} findings: {reported or _NO_RULES}",
        None,
    )


def _less_than_a_dozen(rules: Sequence[RuleTotal], rule: str, title: str) -> Statement:
    total = next((one for one in rules if one.rule == rule), None)
    return Statement(
        _SECTION,
        f"Findings of {title} are below a dozen.",
        f"{total.count} in {total.packages} packages" if total else _NO_RULES,
        total.count < _DOZEN if total else None,
    )


def _by_role(rules: Sequence[RuleTotal], rule: str) -> Statement:
    says = f"Whose findings of «{METRIC_RULES[rule]}» are."
    total = next((one for one in rules if one.rule == rule), None)
    if total is None:
        return Statement(_SECTION, says, _NO_RULES, None)
    parts = sorted(total.by_role.items(), key=lambda one: (-one[1], one[0]))
    return Statement(_SECTION, says, f"of {total.count}: " + ", ".join(f"{role} {n}" for role, n in parts), None)


def _coding(rules: Sequence[RuleTotal]) -> Statement:
    says = "Which coding rules are broken most."
    coding = [one for one in rules if one.kind == "coding"][:_MOST_CODING]
    reported = ", ".join(f"{one.rule} {one.count:,} (in {one.packages})" for one in coding)
    return Statement(_SECTION, says, reported or "no table of coding rules was given", None)


def _without_findings(corpus: Corpus) -> Statement:
    clean = [one for one in corpus.packages if one.values.get("rqv") == 0]
    larger = sorted(one.values["loc"] for one in clean if one.values.get("loc", 0) >= _SMALL)
    found = f"{len(clean)} packages, {len(clean) - len(larger)} of them with fewer"
    if larger:
        found += f", {len(larger)} with {larger[0]:,.0f} to {larger[-1]:,.0f}"
    says = f"Packages in which no limit of the quality model is broken have fewer than {_SMALL} lines of code."
    return Statement(_SECTION, says, found, not larger)


def _correlations(corpus: Corpus, correlations: Sequence[Correlation]) -> Statement:
    pairs = [one for one in correlations if abs(one.pearson.value) >= _LOW]
    titles = {column.key: column.title for column in corpus.columns}
    strong = sorted(pairs, key=lambda one: (-abs(one.pearson.value), one.one, one.other))
    found = f"{len(strong)} of {len(correlations)} pairs have |r| of {_LOW} or more"
    if strong:
        found += ": " + ", ".join(
            f"{titles[one.one]} and {titles[one.other]} {one.pearson.value:.2f}" for one in strong
        )
    says = "Correlations between the quantities are very low in general."
    return Statement(_SECTION, says, found, not strong if correlations else None)
