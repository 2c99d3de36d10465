"""The reference pages of foreign tools, made from what declares them: one of all, and one for each."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.source.tools.checks.tool_checks import Check, checks_of, rule_id
from roslens.source.tools.table import tool_named
from roslens.source.tools.tool import Tool
from roslens.source.tools.used import TOOLS
from roslens.source.tools.witnesses import equivalents

_HEAD = """\
# Foreign tools

Tools that a team knows already, as part of a run: their findings stand beside those of roslens, in every format, with
severity, tags and the clauses of standards that they are about. None runs unless it is asked for:

```sh
roslens check --tools cpplint,ruff           # these
roslens check --tools all                    # every one that is installed
roslens check --import result.sarif          # what some other tool wrote
roslens plugins                              # which are there, and how to get the others
```

or for good, in `roslens.toml`:

```toml
[tools]
use = ["cpplint", "ruff"]

[options.cpplint]
line_length = 120
```

`pip install 'roslens[tools]'` brings those that are wheels. This page is made from `src/roslens/source/tools/`; `make
docs` writes it anew.

- A tool gets many files at once, in as many processes as there are processors. What it says of a file is kept under a
  hash of the file, the tool's version, its options, and the settings files in the folders above; a second run starts
  nothing.
- A tool that is named and missing, too old, of an unknown version, or unable to look at the workspace is a failure
  that says why and what to do: "not run, because …". Where `all` asked for it, it is a remark.
- A tool that crashes, hangs, prints too much or what cannot be read loses nothing of the others. The files that it
  failed on are found by halves, reported, and tried again by the next run.
- It looks at own code and tests, not at generated and vendored code. Comments by which its users silence it hold, and
  so do those of roslens: `NOLINT(runtime/int)`, `noqa: F401`, `roslens: ignore[cpplint.runtime/int] reason`.
- Nothing of the workspace runs: settings that would load code (`init-hook` of pylint, plug-ins of the compiler) are
  not taken over. `use` in a stranger's configuration starts only what you have installed.
- What several tools report of one place by [equivalent checks](#one-finding) is one finding. Findings about layout
  are one a package: "214 layout findings in 12 files: run clang-format"; `layout = "each"` below `[tools]` tells
  each.

| tool | looks at | languages | how to get it |
| --- | --- | --- | --- |
"""

_SARIF = """
## Anything that writes SARIF

`--import FILE` (again for more), or `imports = ["result.sarif"]` below `[tools]`, takes the results of a SARIF 2.1.0
file as findings: of semgrep, CodeQL, bandit, Infer, MSVC, GCC. Results that the tool says are suppressed, that have
no place, or that point outside of the workspace are left out, and how many is said. A file of more than 128 MB or
200,000 results is refused.

A program that writes SARIF is named by a table. It runs once you trust it, see `roslens trust`, and again when a file
of the workspace changed:

```toml
[tools.semgrep]
command = ["semgrep", "scan", "--sarif", "--quiet", "{root}"]

[tools.bandit]
command = ["bandit", "-r", "{root}", "-f", "sarif", "-o", "{output}"]
```

`{root}` is the folder of the workspace, in which it is started; `{output}` a file to write to, without which standard
output is read. Its exit code does not matter where it leaves SARIF.

## One finding

Rules of a row look for the same. Where they report the same line (or file, where that is said), one finding stands:
that of the first rule, with the ids of the others as its `witnesses`. A suppression that names any of them holds. The
rows are data: `src/roslens/source/tools/equivalent.toml`, and the checks of tools that native rules name as clauses.

| what they look for | rules |
| --- | --- |
"""


def tools_page() -> str:
    """Return the page of all tools, in Markdown."""
    tools = [tool_named(name) for name in sorted(TOOLS)]
    table = "".join(
        f"| [`{tool.name}`](tools/{tool.name}.md) | {tool.text} | {', '.join(tool.languages)} | {_code(tool.get)} |\n"
        for tool in tools
    )
    rows = "".join(
        f"| {row.about}{' (of a file)' * (row.place == 'file')} | {', '.join(f'`{rule}`' for rule in row.rules)} |\n"
        for row in sorted(equivalents(), key=lambda row: row.about)
    )
    return f"{_HEAD}{table}{_SARIF}{rows}"


def tool_page(name: str) -> str:
    """Return the page of one tool, in Markdown."""
    tool = tool_named(name)
    checks = checks_of(name)
    return "".join(
        (
            f"# {name}\n\n{tool.text} Documented at <{checks.about}>. See [all tools](../tools.md).\n\n",
            f"- **Get it**: {_code(tool.get)}\n",
            f"- **Reads**: {', '.join(tool.languages)}; one call gets at most {tool.at_once:,} files\n",
            *_facts(tool),
            _options(tool),
            "\n## Its checks\n\nThe id of a check here is the name of the tool, a dot, and its own name: ",
            f"`{rule_id(name, 'CHECK')}`.",
            " Where no severity is given, that of the tool counts. Checks that no line names are notes.\n\n",
            "| check | severity | tags | clauses | what it finds |\n| --- | --- | --- | --- | --- |\n",
            *(_row(f"`{check}`", checks.of(check)) for check in sorted(checks.checks)),
            *(_row(f"`{family.match}`", family) for family in checks.family if family.match != "*"),
            *(_row("all others", family) for family in checks.family if family.match == "*"),
            _levels(checks.levels),
        )
    )


def _facts(tool: Tool) -> Iterable[str]:
    if tool.oldest:
        yield f"- **Oldest version** that was tried: {'.'.join(map(str, tool.oldest))}\n"
    if tool.settings_files:
        names = ", ".join(f"`{name}`" for name in tool.settings_files)
        yield f"- **Settings of the project** that it reads, in the folder of a file and above: {names}\n"
    if tool.whole_packages:
        where = "any package" if tool.across_packages else "the package"
        yield f"- **Looks again** at a file when one that it may depend on changed, in {where}\n"
    if tool.asks_the_net:
        yield "- **Asks the net**, so it only runs where it is named: `all` does not stand for it\n"


def _options(tool: Tool) -> str:
    if not tool.options:
        return ""
    lines = "".join(
        f"| `{one.name}` | {one.type} | {_default(one.default)} | {one.text} |\n"
        for one in sorted(tool.options, key=_name)
    )
    head = f"\n## Options\n\nBelow `[options.{tool.name}]` in `roslens.toml`.\n\n"
    return f"{head}| option | type | default | what it says |\n| --- | --- | --- | --- |\n{lines}"


def _name(option: object) -> str:
    return str(getattr(option, "name", ""))


def _default(value: object) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(f"`{one}`" for one in value) or "none"
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def _row(shown: str, check: Check) -> str:
    tags = ", ".join(check.tags)
    return f"| {shown} | {check.severity} | {tags} | {', '.join(check.clauses)} | {check.title} |\n"


def _levels(levels: dict[str, str]) -> str:
    if not levels:
        return ""
    reported = ", ".join(f"{theirs} → {ours}" for theirs, ours in levels.items())
    return f"\nSeverities of the tool: {reported}.\n"


def _code(text: str) -> str:
    """Return the way to get a program with its commands marked as code."""
    parts = text.replace(", or ", ", ").split(", ")
    return ", or ".join(f"`{part}`" if part.startswith(("pip ", "apt ")) else part for part in parts)
