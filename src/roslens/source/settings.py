"""What a user may choose about an analysis; the command line fills it from options and ``roslens.toml``."""

from __future__ import annotations

from typing import Literal

import msgspec


class WorkspaceSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Where packages are looked for and how files are distinguished.

    Patterns are globs on the path below the workspace root, with ``**`` for any depth; one without ``/`` matches at
    any depth. A pattern that matches a folder matches all below. ``own`` wins over the other roles.
    ``environment`` is what conditions of manifests (REP-149) and launch files (``$(env X)``) see.
    """

    ignore: tuple[str, ...] = ()
    generated: tuple[str, ...] = ()
    vendored: tuple[str, ...] = ()
    test: tuple[str, ...] = ()
    own: tuple[str, ...] = ()
    environment: dict[str, str] = {}


class CountingSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """How decisions are counted; each choice is documented with the metric it changes."""

    lambdas: bool = True
    alternatives: bool = True
    duplicate_lines: int = 10


class MacroSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Macros of the project that the C++ syntax blanks besides those of the preset.

    ``blank`` names macros that disappear with their arguments if they have any; ``statement`` those that stand for a
    whole statement or declaration without a semicolon. Names are regular expressions of whole words, without
    look-around and references to groups.
    """

    blank: tuple[str, ...] = ()
    statement: tuple[str, ...] = ()


class NodeHint(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """Facts about a node beyond its source: endpoints, a line each (``name package/msg/Type``), and names at places.

    ``names`` maps ``path:line`` of an endpoint whose name is unresolved to that name. ``loads`` names code that is in
    it: plug-ins, classes or functions with their namespaces, or files.
    """

    publishes: tuple[str, ...] = ()
    subscribes: tuple[str, ...] = ()
    serves: tuple[str, ...] = ()
    calls: tuple[str, ...] = ()
    serves_actions: tuple[str, ...] = ()
    calls_actions: tuple[str, ...] = ()
    names: dict[str, str] = {}
    loads: tuple[str, ...] = ()


class DeclaredConfiguration(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """A system that runs together: a launch file (``package/file`` or a path) and its arguments.

    ``whole`` says that nothing else runs beside it: who waits for what nothing in it provides waits for ever.
    """

    launch: str
    arguments: dict[str, str | bool | int | float] = {}
    whole: bool = False

    def given(self) -> dict[str, str]:
        """Return the arguments as a launch file sees them: as text."""
        return {
            name: str(value).lower() if isinstance(value, bool) else str(value)
            for name, value in self.arguments.items()
        }


class GraphSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """What is known of the computation graph besides code.

    ``configurations`` are the systems whose graphs are checked and shown, by the name that they are shown under.
    ``hints`` complete nodes, by resolved name of a node or ``package/executable``.
    """

    configurations: dict[str, DeclaredConfiguration] = {}
    hints: dict[str, NodeHint] = {}


class RuleSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Which native rules are on, and how much their findings matter.

    ``profiles`` are names of :mod:`roslens.source.rules.profiles`; ``auto`` is ``ros2`` or ``ros1``, by package.
    ``enable`` and ``disable`` are ids or globs of them, ``severity`` gives a rule another one.
    """

    profiles: tuple[str, ...] = ("auto",)
    enable: tuple[str, ...] = ()
    disable: tuple[str, ...] = ()
    severity: dict[str, str] = {}


class ToolCommand(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """A program of the user's that writes SARIF: to standard output, or to where ``{output}`` stands among its words.

    ``{root}`` stands for the workspace, which is also the folder that it is started in. ``reads`` are files and folders
    that it needs besides the source that is checked: they are trusted with it.
    """

    command: tuple[str, ...]
    reads: tuple[str, ...] = ()


class ToolSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Which foreign tools check the source, and how their findings are treated.

    ``use`` are names of tools, ``all`` for every one that is installed. ``layout`` says whether findings about white
    space and line breaks become one a package (``fold``) or stay as they are (``each``). ``time_limit_s`` is how long
    one process of a tool may take. ``imports`` are SARIF files, ``commands`` tools of the user's by name;
    ``untrusted`` are names of commands, and ``not_used`` of tools, that do not run because the user did not say that
    they may. ``own_settings`` tells whether tools read their settings files in the workspace and above it.
    """

    use: tuple[str, ...] = ()
    layout: Literal["fold", "each"] = "fold"
    time_limit_s: float = 600.0
    imports: tuple[str, ...] = ()
    commands: dict[str, ToolCommand] = {}
    untrusted: tuple[str, ...] = ()
    not_used: tuple[str, ...] = ()
    own_settings: bool = False


class IgnoreRule(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """Findings that do not count, and why: those in files that match ``paths`` and of rules that ``rules`` name.

    ``paths`` are globs as in :class:`WorkspaceSettings`; ``rules`` are ids, ends of ids, tags or globs. One of them may
    be left out, which means all.
    """

    reason: str
    paths: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()


class ProcessSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Whether the histories of repositories are looked at.

    ``metrics`` asks for process metrics. ``as_of`` is the date or time (ISO 8601, UTC where it names no zone) at which
    ages are taken; empty for that of each repository's head, so that a commit has the same ages on every day.
    """

    metrics: bool = False
    as_of: str = ""


DEFAULT_MODELS = ("extreme:note", "ros:note")
"""Limits to look at: of rows about them that were read as maintainers would, none made anyone act."""


class SourceSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Everything that shapes the result of the source half.

    ``untrusted`` are plug-ins that a configuration names and that do not run, because the user did not say that they
    may. ``distro`` is the distribution of ROS that the workspace is for; empty where files that build it tell.
    """

    workspace: WorkspaceSettings = WorkspaceSettings()
    counting: CountingSettings = CountingSettings()
    macros: MacroSettings = MacroSettings()
    graph: GraphSettings = GraphSettings()
    rules: RuleSettings = RuleSettings()
    tools: ToolSettings = ToolSettings()
    process: ProcessSettings = ProcessSettings()
    models: tuple[str, ...] = DEFAULT_MODELS
    gate_roles: tuple[str, ...] = ("own",)
    plugins: tuple[str, ...] = ()
    disable: tuple[str, ...] = ()
    options: dict[str, dict[str, object]] = {}
    time_limit_s: float = 60.0
    untrusted: tuple[str, ...] = ()
    ignore: tuple[IgnoreRule, ...] = ()
    distro: str = ""
