"""Layout in one line a package: what a formatter fixes at one stroke is not reported line by line."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Finding, RuleInfo, Severity, fingerprint
from roslens.model.source import Package
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.plural import plural

LAYOUT = "layout"
"""Tag of the findings that are folded."""

FEWEST = 2
"""At least this many are folded; a single one is more informative by itself."""

RULE = RuleInfo(
    "layout.differs",
    "Layout differs from the style",
    "White space, line breaks, braces or the order of includes deviate from the style. All findings of the "
    'package are in this one; `[tools] layout = "each"` reports each separately.',
    Severity.NOTE,
    (LAYOUT,),
    "A formatter fixes it at one stroke; line by line it hides what matters.",
    tool="roslens",
    scope="package",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
)

_FORMATTERS = (
    (
        "clang-format",
        (".c", ".cc", ".cpp", ".cxx", ".c++", ".h", ".hh", ".hpp", ".hxx", ".h++", ".ipp", ".tpp", ".inl"),
    ),
    ("ruff format", (".py",)),
    ("cmake-format", (".cmake", "CMakeLists.txt")),
)


def layout_folded(findings: Sequence[Finding], package: Package) -> tuple[Finding, ...]:
    """Return the findings of a package with those about layout as one, and another for code that no gate counts."""
    apart: dict[bool, list[Finding]] = defaultdict(list)
    for finding in findings:
        if LAYOUT in finding.tags and finding.path and finding.rule != RULE.id:
            apart[finding.gated].append(finding)
    whole = {gated: held for gated, held in apart.items() if len(held) >= FEWEST}
    if not whole:
        return tuple(findings)
    gone = {id(finding) for held in whole.values() for finding in held}
    kept = [finding for finding in findings if id(finding) not in gone]
    return (*kept, *(_one(held, package, gated) for gated, held in sorted(whole.items(), reverse=True)))


def _one(held: Sequence[Finding], package: Package, gated: bool) -> Finding:
    by_file: dict[str, Counter[str]] = defaultdict(Counter)
    for finding in held:
        by_file[finding.path][finding.rule] += 1
    worst = sorted(by_file.items(), key=lambda item: (-sum(item[1].values()), item[0]))
    files = f" in {len(by_file)} files" if len(by_file) > 1 else f" in {worst[0][0]}"
    entity = str(EntityId(EntityKind.PACKAGE, package.id))
    advice = _advice(by_file)
    place = "" if gated else " of code that does not count"
    return Finding(
        RULE.id,
        RULE.severity,
        f"{plural(len(held), 'layout finding')}{place}{files}: run {advice}",
        package.manifest.path,
        entity=entity,
        tags=RULE.tags,
        tool=RULE.tool,
        fingerprint=fingerprint(RULE.id, entity, "" if gated else "apart"),
        gated=gated,
        consequence=RULE.consequence,
        certainty=RULE.certainty,
        others=tuple(
            f"{path}: {sum(rules.values())} ({', '.join(f'{rule} x {n}' for rule, n in rules.most_common())})"
            for path, rules in worst
        ),
    )


def _advice(by_file: dict[str, Counter[str]]) -> str:
    named = [program for program, ends in _FORMATTERS if any(path.endswith(ends) for path in by_file)]
    return " and ".join(named) if named else "a formatter"
