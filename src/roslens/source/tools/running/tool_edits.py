"""Findings of foreign tools with their fixes: requested from the tools on demand, and not stored."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from roslens.children.scratch_folder import ScratchFolder
from roslens.intake.bounded_file import read_bounded
from roslens.model.edit import Edit
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.source import SourceFile
from roslens.plugins.options import resolve_options
from roslens.source.keys import content_hash
from roslens.source.settings import SourceSettings
from roslens.source.tools.checks.tool_checks import rule_id
from roslens.source.tools.running.programs import find_program
from roslens.source.tools.running.run_tool import ToolError, ToolRunner
from roslens.source.tools.running.tool_sandbox import sandbox_of
from roslens.source.tools.table import chosen_tools
from roslens.source.tools.tool import Request, Tool, ToolFix

_Place = tuple[str, str, int, int]


def with_tool_edits(
    findings: Sequence[Finding],
    files: Mapping[str, SourceFile],
    root: str,
    settings: SourceSettings,
    runner: ToolRunner | None = None,
) -> tuple[tuple[Finding, ...], tuple[Failure, ...]]:
    """Return findings, those of tools with the safe fixes that these have for them, and failures of tools.

    Args:
        findings: of a run.
        files: of the run, by path.
        root: of the workspace.
        settings: of the run.
        runner: starts the tools.
    """
    if not settings.tools.use:
        return tuple(findings), ()
    tools = [
        tool
        for tool in chosen_tools(settings.tools.use, settings.disable, tuple(settings.tools.commands))
        if tool.fixes_at_once
    ]
    known: dict[_Place, tuple[Edit, ...]] = {}
    failures: list[Failure] = []
    for tool in tools:
        begin = f"{tool.name}."
        paths = sorted({one.path for one in findings if one.rule.startswith(begin) and one.path in files})
        for some in _parts(paths, tool.fixes_at_once):
            try:
                for fix in _reported(tool, some, files, root, settings, runner or ToolRunner()):
                    known[rule_id(tool.name, fix.check), fix.path, fix.line, fix.column] = _made_for(fix.edits, files)
            except (ToolError, OSError) as error:
                failures.append(_failure(tool, error))
                break
    return tuple(_mended(one, known) for one in findings), tuple(failures)


def _parts(paths: Sequence[str], most: int) -> Iterator[Sequence[str]]:
    for start in range(0, len(paths), most):
        yield paths[start : start + most]


def _reported(
    tool: Tool,
    paths: Sequence[str],
    files: Mapping[str, SourceFile],
    root: str,
    settings: SourceSettings,
    runner: ToolRunner,
) -> Iterator[ToolFix]:
    contents = {path: read_bounded(f"{root}/{path}") for path in paths}
    # A file that changed since the run is left: the findings are of another content.
    contents = {path: text for path, text in contents.items() if content_hash(text) == files[path].content_hash}
    program = find_program(tool.program, root)
    if not contents or program is None:
        return
    with ScratchFolder("tool") as scratch:
        options = resolve_options(tool.manifest, settings.options.get(tool.name, {}))
        paths = tuple(f"./{path}" for path in sorted(contents))
        request = Request(program.path, root, paths, options, scratch, own_settings=settings.tools.own_settings)
        ended = runner.run(
            tool.words_for_fixes(request),
            folder=scratch if tool.in_scratch else root,
            time_limit_s=settings.tools.time_limit_s,
            safe_path=tool.safe_path,
            sandbox=sandbox_of(request, network=tool.asks_the_net),
        )
        yield from tool.read_fixes(tool.checked(ended), request, contents)


def _made_for(edits: Sequence[Edit], files: Mapping[str, SourceFile]) -> tuple[Edit, ...]:
    return tuple(msgspec.structs.replace(edit, made_for=files[edit.path].content_hash) for edit in edits)


def _mended(finding: Finding, known: Mapping[_Place, tuple[Edit, ...]]) -> Finding:
    if finding.edits:
        return finding
    place = (finding.rule, finding.path, finding.line)
    edits = known.get((*place, finding.column)) or known.get((*place, 0), ())
    return msgspec.structs.replace(finding, edits=edits) if edits else finding


def _failure(tool: Tool, error: Exception) -> Failure:
    return Failure(
        tool.name,
        f"{tool.name} provides no fixes: it {error}",
        "the fixes of its findings",
        f"Run {tool.program} by hand",
    )
