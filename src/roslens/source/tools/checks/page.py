"""The reference pages of foreign tools, generated from their declarations: one of all, and one for each."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.source.tools.checks.tool_checks import Check, checks_of, rule_id
from roslens.source.tools.table import tool_named
from roslens.source.tools.tool import Tool
from roslens.source.tools.used import TOOLS
from roslens.source.tools.witnesses import equivalents

_HEAD = """\
# Foreign tools

Established analysers as part of a run: their findings are reported together with those of roslens, in every format,
with severity, tags and the related clauses of standards. None runs unless it is requested:

```sh
roslens check --tools cpplint,ruff           # these
roslens check --tools all                    # all that are installed
roslens check --import result.sarif          # the result of another tool
roslens plugins                              # list installed tools, and how to install the others
```

or permanently, in `roslens.toml`:

```toml
[tools]
use = ["cpplint", "ruff"]

[options.cpplint]
line_length = 120
```

`pip install 'roslens[tools]'` installs those that are available as wheels. `make docs` generates this page from
`src/roslens/source/tools/`.

- A tool receives files in batches, in as many processes as there are processors. Its findings in a file are cached by
  a hash of the file, the version of the tool, its options, and the settings files in the parent folders; a second run
  starts no process.
- A tool that is requested by name but missing, too old, of an unknown version, or unable to process the workspace is a
  failure that states the reason and the remedy: "not run, because …". If it was requested by `all`, it is a remark.
- If a tool crashes, hangs, or prints too much or unreadable output, the findings of the others are kept. The files
  that it failed on are found by bisection, reported, and tried again by the next run.
- Tools check own code and tests, not generated and vendored code. Suppression comments of the tool apply, and so do
  those of roslens: `NOLINT(runtime/int)`, `noqa: F401`, `roslens: ignore[cpplint.runtime/int] reason`.
- What a workspace configures starts no program before `roslens trust`: until then, `use`, `[tools.NAME]`, `options`
  and models that need a program (`paper2016`) of its `roslens.toml` are not used, which is reported. A tool that you
  name by `--tools` runs, but without settings files of the workspace (`.clang-tidy`, `pyproject.toml` …).
  `roslens trust` lists what would run or be read; a change of any of it asks again.
- Of a `compile_commands.json`, only flags that shape what code means are used (`-I -D -std -include -f[no-]rtti` …).
- A tool imports no module of the workspace and runs in a sandbox where there is one: Landlock of the kernel, with
  sockets refused, else bubblewrap (`roslens doctor` reports which). It reads the workspace, packages that are linked
  into it, `build`, `install` and `devel` beside `src`, the system, and what `PYTHONPATH`, `AMENT_PREFIX_PATH` and the
  like name; it writes to a folder of its own, which is its home. It reads nothing else of your home, uses no network
  (`ament_xmllint` excepted), and starts no program of the workspace.
- If several tools report the same place by [equivalent checks](#one-finding), it is one finding. Findings about layout
  are combined into one per package: "214 layout findings in 12 files: run clang-format"; `layout = "each"` below
  `[tools]` reports each.

| tool | checks | languages | installation |
| --- | --- | --- | --- |
"""

_SARIF = """
## Anything that writes SARIF

`--import FILE` (again for more), or `imports = ["result.sarif"]` below `[tools]`, takes the results of a SARIF 2.1.0
file as findings: of semgrep, CodeQL, bandit, Infer, MSVC, GCC. Results that are marked as suppressed, have no
location, or point outside the workspace are left out, and their number is reported. A file of more than 128 MB or
200,000 results is rejected.

A program that writes SARIF is configured by a table. It runs once you trust it, see `roslens trust`, and again when a
file of the workspace changed:

```toml
[tools.semgrep]
command = ["semgrep", "scan", "--sarif", "--quiet", "{root}"]

[tools.bandit]
command = ["bandit", "-r", "{root}", "-f", "sarif", "-o", "{output}"]
```

The command runs in the [sandbox of tools](#foreign-tools). Of the workspace, it reads what you trusted (files that its
words name, and those below `reads`), and the source that is checked, as data. A `Makefile` or a folder of scripts that
it needs is listed, `reads = ["Makefile", "scripts"]`, and a change of it asks again.

`{root}` is the folder of the workspace, its working directory; `{output}` a file to write to, without which standard
output is read. Its exit code is ignored if it writes SARIF.

## One finding

The rules of a row find the same mistake. If they report the same line (or the same file, for rows marked so), they are
one finding: that of the first rule, with the ids of the others as its `witnesses`. A suppression of any of them
applies. The rows are `src/roslens/source/tools/equivalent.toml`, and the checks of tools that native rules list as
clauses.

| mistake | rules |
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
            f"- **Installation**: {_code(tool.get)}\n",
            f"- **Reads**: {', '.join(tool.languages)}; one call gets at most {tool.at_once:,} files\n",
            *_facts(tool),
            _options(tool),
            "\n## Its checks\n\nThe id of a check here is the name of the tool, a dot, and its own name: ",
            f"`{rule_id(name, 'CHECK')}`.",
            " Without a severity, that of the tool applies. Checks that are not listed are notes.\n\n",
            "| check | consequence | severity | tags | clauses | what it finds |\n",
            "| --- | --- | --- | --- | --- | --- |\n",
            *(_row(f"`{check}`", checks.of(check)) for check in sorted(checks.checks)),
            *(_row(f"`{family.match}`", family) for family in checks.family if family.match != "*"),
            *(_row("all others", family) for family in checks.family if family.match == "*"),
            _levels(checks.levels),
        )
    )


def _facts(tool: Tool) -> Iterable[str]:
    if tool.oldest:
        yield f"- **Oldest version** tested: {'.'.join(map(str, tool.oldest))}\n"
    if tool.settings_files:
        names = ", ".join(f"`{name}`" for name in tool.settings_files)
        yield f"- **Project settings** that it reads, in the folder of a file and its parents: {names}\n"
    if tool.whole_packages:
        where = "any package" if tool.across_packages else "the package"
        yield f"- **Checks a file again** if a file that it may depend on changed, in {where}\n"
    if tool.asks_the_net:
        yield "- **Uses the network**, so it runs only if named: `all` does not include it\n"


def _options(tool: Tool) -> str:
    if not tool.options:
        return ""
    lines = "".join(
        f"| `{one.name}` | {one.type} | {_default(one.default)} | {one.text} |\n"
        for one in sorted(tool.options, key=_name)
    )
    head = f"\n## Options\n\nBelow `[options.{tool.name}]` in `roslens.toml`.\n\n"
    return f"{head}| option | type | default | meaning |\n| --- | --- | --- | --- |\n{lines}"


def _name(option: object) -> str:
    return str(getattr(option, "name", ""))


def _default(value: object) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(f"`{one}`" for one in value) or "none"
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def _row(shown: str, check: Check) -> str:
    tags = ", ".join(check.tags)
    weight = f"{check.consequence.value}, {check.certainty.value}" if check.consequence and check.certainty else ""
    severity = check.severity.value if check.severity else ""
    return f"| {shown} | {weight} | {severity} | {tags} | {', '.join(check.clauses)} | {check.title} |\n"


def _levels(levels: dict[str, str]) -> str:
    if not levels:
        return ""
    reported = ", ".join(f"{theirs} → {ours}" for theirs, ours in levels.items())
    return f"\nSeverities of the tool: {reported}.\n"


def _code(text: str) -> str:
    """Return the way to get a program with its commands marked as code."""
    parts = text.replace(", or ", ", ").split(", ")
    return ", or ".join(f"`{part}`" if part.startswith(("pip ", "apt ")) else part for part in parts)
