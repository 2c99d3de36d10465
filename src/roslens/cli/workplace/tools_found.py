"""Which foreign tools are there, for ``roslens plugins`` and ``roslens doctor``."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec


class FoundTool(msgspec.Struct, frozen=True):
    """A tool that roslens knows; ``path`` and ``version`` are empty where it is not there, ``trouble`` says why."""

    name: str
    text: str
    languages: tuple[str, ...]
    get: str
    path: str = ""
    version: str = ""
    trouble: str = ""
    options: tuple[tuple[str, str, str], ...] = ()


def found_tools(root: str, *, ask: bool) -> Iterator[FoundTool]:
    """Yield all tools.

    Args:
        root: of the workspace, in which no program is looked for.
        ask: whether each is started to report its version.
    """
    from roslens.source.tools.running.programs import check_age, find_program, version_of
    from roslens.source.tools.running.run_tool import ToolError, ToolRunner
    from roslens.source.tools.table import tool_named
    from roslens.source.tools.used import TOOLS

    runner = ToolRunner()
    for name in sorted(TOOLS):
        tool = tool_named(name)
        options = tuple((one.name, one.type, one.text) for one in tool.options)
        reported = FoundTool(name, tool.text, tool.languages, tool.get, options=options)
        program = find_program(tool.program, root)
        if program is None:
            yield msgspec.structs.replace(reported, trouble="it is not installed")
            continue
        version, trouble = "", ""
        if ask and tool.version_words:
            try:
                version = version_of(tool, program, runner)
                check_age(tool, version)
            except ToolError as error:
                trouble = f"it {error}"
        yield msgspec.structs.replace(reported, path=program.path, version=version, trouble=trouble)
