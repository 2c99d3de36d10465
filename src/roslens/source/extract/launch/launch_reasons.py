"""What launch files name: conditions as they are written, files, and why these are not known."""

from __future__ import annotations

from roslens.model.configuration import Standing
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.files import joined
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Value
from roslens.source.extract.launch_python.launch_action import Condition
from roslens.source.extract.symbolic.reason import is_outside
from roslens.source.extract.symbolic.text import Not, Text, Written


def standing_of(text: Text) -> Standing:
    """Return what is known of a file whose path is not, or is not below the workspace."""
    return Standing.OUTSIDE if not text.holes or is_outside(text.holes[0].reason) else Standing.UNDECIDABLE


def why_unread(file: Text) -> str:
    """Return why a file that is named is not read."""
    return str(file.holes[0].reason) if file.holes else "an absolute path"


def place_and_reason(error: DocumentError, path: str, evidence: Evidence) -> tuple[Evidence, str]:
    """Return where to look for what cannot be read, and why: in the file, or where another one includes it."""
    reason = f"{error.what}; expected {error.expected}"
    if evidence.line:
        return evidence, f"{error.where}: {reason}"
    line, _, column = error.where.removeprefix(f"{path}:").partition(":")
    return Evidence(path, int(line), int(column)) if line.isdigit() and column.isdigit() else evidence, reason


def written_condition(condition: Condition) -> Written | Not:
    """Return a condition as it is written."""
    text = Written(condition.written or _shown(condition.value))
    return text if condition.wanted else Not(text)


def _shown(value: Value) -> str:
    match value:
        case str() | Text():
            return str(value)
    inside = ", ".join(_shown(part) for part in value.parts)
    return inside if value.kind in ("configuration", "text", "unknown") else f"{value.kind}({inside})"


def place_of(path: str) -> str:
    """Return a path without detours; one from the root of the machine stays one."""
    return f"{'/' * path.startswith('/')}{joined('', path)}"
