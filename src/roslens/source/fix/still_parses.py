"""Whether an edited file is understood as far as it was before."""

from __future__ import annotations

from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError, time_budget
from roslens.model.source import SourceFile
from roslens.source.parsed_file import parse_file
from roslens.source.settings import MacroSettings
from roslens.source.workspace.elements import read_elements
from roslens.source.workspace.manifest import MANIFEST_NAME


def new_fault(file: SourceFile, before: bytes, after: bytes, macros: MacroSettings) -> str:
    """Return what of an edited file does not parse that did before; empty where nothing is worse.

    Files without a syntax of their own are taken as they are.

    Args:
        file: which one.
        before: its content.
        after: its content with edits.
        macros: of the run.
    """
    if file.language.parsed_as:
        return _source_fault(file, before, after, macros)
    if file.path.rpartition("/")[2] == MANIFEST_NAME or file.path.endswith((".xml", ".launch")):
        faults = read_elements(after).faults
        return faults[0].what if len(faults) > len(read_elements(before).faults) else ""
    return ""


def _source_fault(file: SourceFile, before: bytes, after: bytes, macros: MacroSettings) -> str:
    try:
        with time_budget(SOURCE_FILE_S):
            known = parse_file(before, file.language, macros).facts().faults
            faults = parse_file(after, file.language, macros).facts().faults
    except OverBudgetError:
        return "it takes too long to parse"
    if len(faults) <= len(known):
        return ""
    texts = {fault.text for fault in known}
    fault = next((one for one in faults if one.text not in texts), faults[0])
    return f"line {fault.line}: `{fault.text}`"
