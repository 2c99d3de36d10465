"""Evidence as text, JSON and a Markdown declaration to commit."""

from __future__ import annotations

import textwrap

import msgspec

from roslens.model.requirement import Evidence, Item, Met, Weight

SIGNS = {Met.MET: "✓", Met.NOT_MET: "✗", Met.NOT_KNOWN: "?"}
_LETTERS = {Weight.REQUIRED: "R", Weight.RECOMMENDED: "r", Weight.OPTIONAL: "o", Weight.NONE: "-"}
_WIDTH = 110
REP = "REP-2004 (https://ros.org/reps/rep-2004.html)"


def verdict(evidence: Evidence) -> str:
    """Return a summary of the levels: claimed, shown, and not contradicted."""
    claimed = f"claims level {evidence.claimed}" if evidence.claimed else "claims no level"
    shown, possible = evidence.highest_shown, evidence.highest_open
    text = f"{evidence.package} {evidence.version} {claimed}; all that level {shown} requires is shown to be met"
    if possible < shown:
        unknown = len(evidence.required(possible, Met.NOT_KNOWN))
        text += f", and no evidence contradicts level {possible}, with {unknown} requirements not known"
    if evidence.claimed and evidence.claimed < possible:
        missed = ", ".join(one.requirement.number for one in evidence.required(evidence.claimed, Met.NOT_MET))
        text += f"; of the claimed level this is not met: {missed}"
    return text


def evidence_text(evidence: Evidence) -> str:
    """Return a line or two for each requirement; letters say what the levels 1 to 4 make of it."""
    lines = [textwrap.fill(verdict(evidence), _WIDTH), "", "             1234"]
    for item in evidence.items:
        weights = "".join(_LETTERS[weight] for weight in item.requirement.weights)
        sign = f"{SIGNS[item.met]} {item.met.value:<9}"
        lines.append(f"{sign}  {weights}  {item.requirement.number:<7} {item.requirement.asks}")
        shown = f"{item.shown}{_places(item)}"
        lines.append(textwrap.fill(shown, _WIDTH, initial_indent=" " * 27, subsequent_indent=" " * 27,
                                   break_long_words=False, break_on_hyphens=False))  # fmt: skip
    lines += ["", "R required, r recommended, o optional at this level"]
    return "\n".join(lines) + "\n"


def _places(item: Item) -> str:
    return f" ({', '.join(map(str, item.where))})" if item.where else ""


def evidence_json(evidence: Evidence) -> str:
    """Return everything, with the levels."""
    document = {
        "schema": 1,
        "standard": "REP-2004",
        "highest_shown": evidence.highest_shown,
        "highest_open": evidence.highest_open,
        **msgspec.to_builtins(evidence),
    }
    return msgspec.json.format(msgspec.json.encode(document)).decode() + "\n"


def evidence_markdown(evidence: Evidence) -> str:
    """Return a quality declaration with what shows each requirement, to be committed once people have read it.

    Where nothing is known it says what is to be written; it claims no level that is not shown.
    """
    level = evidence.highest_shown
    lines = [
        f"# Quality declaration of `{evidence.package}`",
        "",
        f"Version {evidence.version or 'not given'}, against {REP}.",
        "",
        f"Evidence in the source shows all that **Quality Level {level}** requires." if level < 5
        else "Evidence in the source shows **Quality Level 5**, which requires nothing.",
        "",
    ]  # fmt: skip
    section = ""
    for item in evidence.items:
        if (chapter := item.requirement.number.partition(".")[0]) != section:
            section = chapter
            lines += [f"## {section} {_CHAPTERS[section]}", ""]
        asks = f"**[{item.requirement.number}]** {item.requirement.asks}"
        asks = f"**[{item.requirement.number}]** {item.requirement.asks}"
        lines.append(f"- {SIGNS[item.met]} {asks}: *{item.met.value}*. {_markdown(item)}")
        if item.requirement.number in _LAST:
            lines.append("")
    return "\n".join(lines).rstrip() + "\n"


_CHAPTERS = {
    "1": "Version policy",
    "2": "Change control process",
    "3": "Documentation",
    "4": "Testing",
    "5": "Dependencies",
    "6": "Platform support",
    "7": "Security",
}
_LAST = frozenset({"1.vi", "2.v", "3.v.c", "4.v.b", "5.iii", "6.i"})


def _markdown(item: Item) -> str:
    text = item.shown[:1].upper() + item.shown[1:] + "."
    places = ", ".join(f"`{place}`" for place in item.where)
    more = " **To be said by the maintainers.**" if item.met is Met.NOT_KNOWN else ""
    return text + (f" See {places}." if places else "") + more
