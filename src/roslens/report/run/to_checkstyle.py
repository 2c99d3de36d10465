"""Checkstyle XML, which Jenkins, reviewdog and many editors read."""

from __future__ import annotations

from collections import defaultdict
from typing import TextIO
from xml.sax.saxutils import quoteattr

from roslens.model.finding import Severity
from roslens.report.run.reported import Reported, Wanted, reported, xml_text
from roslens.store.read import RunView

_SEVERITIES = {Severity.NOTE: "info", Severity.WARNING: "warning", Severity.ERROR: "error"}


def write_checkstyle(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write the findings that count by file, in the order of files and lines.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    files: dict[str, list[Reported]] = defaultdict(list)
    for one in reported(view, wanted):
        files[one.path or "."].append(one)
    stream.write('<?xml version="1.0" encoding="UTF-8"?>\n<checkstyle version="4.3">\n')
    for path in sorted(files):
        stream.write(f"  <file name={quoteattr(xml_text(path))}>\n")
        for one in sorted(files[path], key=lambda one: (one.line, one.finding.column, one.finding.rule)):
            column = f' column="{one.finding.column}"' if one.finding.column else ""
            stream.write(
                f'    <error line="{one.line}"{column} severity="{_SEVERITIES[one.finding.severity]}" '
                f"message={quoteattr(xml_text(one.finding.message))} "
                f"source={quoteattr(xml_text(f'roslens.{one.finding.rule}'))}/>\n"
            )
        stream.write("  </file>\n")
    stream.write("</checkstyle>\n")
