"""``roslens doctor``: is everything there, and what is missing for what."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from roslens.cli.terminal.boundary import CLEAN, NOT_ANALYSED
from roslens.cli.workplace.trust_option import add_trust_argument, admitted_by

TEXT = "Check the installation, the configuration and the store of a workspace."
EXAMPLES = """\
  roslens doctor
  roslens doctor ~/robot_ws"""

LIBRARIES = (
    "jinja2",
    "msgspec",
    "pygments",
    "starlette",
    "tree-sitter",
    "tree-sitter-cpp",
    "tree-sitter-python",
    "uvicorn",
)

_VERIFIED = "rmw_fastrtps"
"""What names of the verified middleware begin with."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace."""
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="workspace to look at (default: .)")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    add_trust_argument(parser)


def run(options: argparse.Namespace) -> int:
    """Print one line per check; the exit code is 3 if one failed."""
    failed = False
    for state, text in _checks(options):
        failed |= state == "fail"
        print(f"{state:>4}  {text}")
    return NOT_ANALYSED if failed else CLEAN


def _checks(options: argparse.Namespace) -> Iterator[tuple[str, str]]:
    import platform
    import shutil

    from roslens import __version__
    from roslens.model.errors import RoslensError

    yield "ok", f"roslens {__version__} on Python {platform.python_version()}"
    yield from _libraries()
    yield from _grammars()
    for program, use in (("git", "commits of runs"), ("cccc", "the model paper2016")):
        place = shutil.which(program)
        yield (
            ("ok", f"{program}: {place}") if place else ("note", f"{program} is not installed; it is needed for {use}")
        )
    yield _sandbox()
    yield from _search_paths()
    yield from _middleware()
    yield from _tools(options)
    try:
        yield from _configuration(options)
    except RoslensError as error:
        yield "fail", str(error)
    yield from _store(options)


def _middleware() -> Iterator[tuple[str, str]]:
    """Report the middleware of ROS 2 that is set, and whether the live half is verified with it."""
    import os

    set_ = os.environ.get("RMW_IMPLEMENTATION", "")
    if not set_ and not os.environ.get("ROS_DISTRO", ""):
        return
    name = set_ or "the default of the distribution (RMW_IMPLEMENTATION is not set)"
    if not set_ or set_.startswith(_VERIFIED):
        yield "ok", f"middleware of ROS 2: {name}; the live half is verified with Fast DDS ({_VERIFIED})"
    else:
        yield (
            "note",
            (
                f"middleware of ROS 2: {name}; the live half is verified with Fast DDS ({_VERIFIED}) alone: see "
                f"docs/reference/observing.md#middlewares for what may be unknown"
            ),
        )


def _sandbox() -> tuple[str, str]:
    """Report what confines tools and plug-ins."""
    import os

    from roslens.children.plugin_sandbox import SWITCH
    from roslens.children.sandbox import BUBBLEWRAP, LANDLOCK, sandbox_kind

    kind, switched_off = sandbox_kind(), os.environ.get(SWITCH, "").lower() == "off"
    if kind == LANDLOCK and switched_off:
        return "note", f"sandbox of tools: Landlock; plug-ins run without one (${SWITCH} is off)"
    if kind == LANDLOCK:
        return "ok", "sandbox of tools and plug-ins: Landlock"
    if kind == BUBBLEWRAP:
        return (
            "note",
            "sandbox of tools: bubblewrap; plug-ins run without one: this kernel has no Landlock (Linux 5.13)",
        )
    return "note", (
        "tools and plug-ins run without a sandbox: this kernel has no Landlock (Linux 5.13), and bwrap is not installed"
    )


def _search_paths() -> Iterator[tuple[str, str]]:
    """Report search paths by which a workspace chooses what runs, once it is the current folder."""
    from roslens.children.safe_path import shortened_search_paths

    for name in shortened_search_paths():
        yield (
            "note",
            (
                f"${name} has an empty or relative entry, by which programs started in a workspace take files of it; "
                f"roslens leaves it out. `export {name}=/opt/…${{{name}:+:${name}}}` adds a folder without one"
            ),
        )


def _tools(options: argparse.Namespace) -> Iterator[tuple[str, str]]:
    """Report which foreign tools are installed; none is required."""
    from roslens.cli.workplace.tools_found import found_tools

    absent = []
    for tool in found_tools(str(Path(options.path).resolve()), ask=True):
        if tool.trouble and tool.path:
            yield "note", f"{tool.name} will not be run: {tool.trouble} ({tool.path})"
        elif tool.path:
            yield "ok", f"{tool.name}{f' {tool.version}' if tool.version else ''}: {tool.path}"
        else:
            absent.append(tool.name)
    if absent:
        yield "note", f"not installed: {', '.join(absent)}; `roslens plugins` shows how to get them for --tools"


def _libraries() -> Iterator[tuple[str, str]]:
    from importlib.metadata import PackageNotFoundError, version

    for name in LIBRARIES:
        try:
            yield "ok", f"{name} {version(name)}"
        except PackageNotFoundError:
            yield "fail", f"{name} is missing. Install roslens again: `pip install --force-reinstall roslens`"


def _grammars() -> Iterator[tuple[str, str]]:
    from roslens.model.source import Language
    from roslens.source.measure.analyse_file import analyse_file
    from roslens.source.settings import MacroSettings

    for language, text in ((Language.CPP, b"int f() { return 1; }"), (Language.PYTHON, b"def f():\n    return 1\n")):
        found = len(analyse_file(text, language, MacroSettings()).facts.functions)
        yield ("ok" if found == 1 else "fail"), f"parses {language.value}"


def _configuration(options: argparse.Namespace) -> Iterator[tuple[str, str]]:
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.judge.quality.quality_model import load_model
    from roslens.source.metrics.table import QUANTITIES
    from roslens.source.plugin_stage import discover_plugins

    looked_at = Path(options.path).resolve()
    configuration = admitted_by(options, find_configuration(looked_at, options.config), looked_at)
    yield "ok", f"configuration: {configuration.path or 'defaults (no roslens.toml)'}"
    base = Path(configuration.base or ".")
    found = discover_plugins(configuration.source, base)
    quantities = dict(QUANTITIES)
    for member in found.members:
        quantities.update({quantity.key: quantity for quantity in member.manifest.quantities})
        yield "ok", f"plug-in {member.manifest.name} {member.manifest.version} [{member.origin}]"
    for failure in found.failures:
        yield "fail", str(failure)
    for name in configuration.source.models:
        yield "ok", f"quality model {load_model(name, quantities, base=base).name}"


def _store(options: argparse.Namespace) -> Iterator[tuple[str, str]]:
    from roslens.cli.workplace.workplace import open_store
    from roslens.model.errors import RoslensError, UsageError

    try:
        with open_store(options.path) as store:
            runs = store.runs()
            yield "ok", f"store: {len(runs)} complete runs"
    except UsageError:
        yield "note", "no run yet: `roslens check` makes one"
    except RoslensError as error:
        yield "fail", str(error)
