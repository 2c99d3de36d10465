"""Evidence on one package as one HTML file that loads nothing."""

from __future__ import annotations

from markupsafe import Markup

from roslens.dashboard.render import environment
from roslens.dashboard.single_file import inlined
from roslens.model.requirement import Evidence, Met
from roslens.report.run.evidence_text import SIGNS, verdict


def evidence_page(evidence: Evidence) -> str:
    """Return the text of the page."""
    templates = environment("file", help_keys={})
    levels = [
        (level, *(len(evidence.required(level, met)) for met in (Met.MET, Met.NOT_MET, Met.NOT_KNOWN)))
        for level in (1, 2, 3, 4)
    ]
    shown = templates.get_template("evidence_content.html").render(
        evidence=evidence, verdict=verdict(evidence), levels=levels, signs=SIGNS
    )
    title = f"Evidence: {evidence.package}"
    page = templates.get_template("study.html").render(title=title, sections=Markup("\0"), index=[], **inlined())
    return page.replace("\0", shown, 1)
