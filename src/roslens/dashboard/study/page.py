"""A study as one HTML file that loads nothing."""

from __future__ import annotations

from markupsafe import Markup

from roslens.dashboard.render import environment
from roslens.dashboard.single_file import inlined
from roslens.dashboard.study.heat_map import heat_map
from roslens.dashboard.study.scatter_matrix import CELL, scatter_matrix
from roslens.dashboard.study.violins import WIDTH, violin_plots
from roslens.model.study import Study
from roslens.report.study.study_tables import HOLDS, lead, tables_of


def study_page(study: Study, title: str = "Study") -> str:
    """Return the text of the page."""
    templates = environment("file", help_keys={})
    shown = templates.get_template("study_content.html").render(
        study=study,
        lead=lead(study),
        sources=", ".join(source.rpartition("/")[2] for source in study.corpus.sources),
        tables={table.key: table for table in tables_of(study)},
        violins=violin_plots(study),
        violin_width=WIDTH,
        heat=heat_map(study),
        scatter=scatter_matrix(study),
        cell=CELL,
        holds=HOLDS,
    )
    page = templates.get_template("study.html").render(title=title, sections=Markup("\0"), index=[], **inlined())
    return page.replace("\0", shown, 1)
