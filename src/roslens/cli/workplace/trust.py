"""What a workspace may start: what the user trusts, for its folder and content.

A ``roslens.toml`` comes with the source that is looked at, so a plug-in that it names by a path is a stranger's code,
and a tool that it switches on reads what strangers wrote. Nothing of it starts a program before the user has said so,
for this folder and this content: after any change the question is asked again.
"""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from hashlib import sha256
from pathlib import Path

import msgspec

from roslens.cli.workplace.configuration import Configuration
from roslens.intake.user_folder import user_folder, write_private
from roslens.model.errors import UsageError
from roslens.plugins.hashed_modules import files_of
from roslens.source.settings import ToolCommand
from roslens.source.tools.used import plain

_FILE = "trusted.json"


class Trusted(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a user trusts, by the folder of the configuration: hashes of what would run, and of settings of tools."""

    folders: dict[str, str] = {}
    settings: dict[str, str] = {}


OWN_OPTIONS = frozenset({"graph"})
"""Tables of ``[options]`` that reach no foreign program and no plug-in."""

STARTED_BY_MODEL = {"paper2016": "cccc"}
"""Quality models whose quantities a foreign program measures."""


def code_of(configuration: Configuration) -> tuple[str, ...]:
    """Return what the configuration would have run: plug-ins, commands, tools with their options, servers."""
    tools = configuration.source.tools.commands
    commands = (f"[tools.{name}] {shlex.join(one.command)}" for name, one in sorted(tools.items()))
    return (*configuration.source.plugins, *commands, *switches_of(configuration), *servers_of(configuration))


def switches_of(configuration: Configuration) -> tuple[str, ...]:
    """Return by what it starts installed programs, and what it passes to them."""
    source = configuration.source
    use = (f"[tools] use = {', '.join(source.tools.use)}",) if source.tools.use else ()
    options = tuple(
        f"[options.{name}] {json.dumps(table, sort_keys=True, default=str)}"
        for name, table in sorted(source.options.items())
        if name not in OWN_OPTIONS
    )
    models = tuple(f"models = {name}, which starts {STARTED_BY_MODEL[name]}" for name in _starting(source.models))
    return (*use, *options, *models)


def _starting(models: Iterable[str]) -> list[str]:
    return [name for name in models if name in STARTED_BY_MODEL]


def servers_of(configuration: Configuration) -> tuple[str, ...]:
    """Return the servers that it names, as it names them: what is found would go there, and what they say is taken."""
    named = (("store", configuration.store), ("engine", configuration.engine))
    return tuple(f"{key} = {value}" for key, value in named if "://" in value)


def hash_of(configuration: Configuration) -> str:
    """Return the hash of all files that would run, with their names."""
    digest = sha256()
    base = Path(configuration.base or ".")
    for name in configuration.source.plugins:
        digest.update(f"plug-in {name}\0".encode("utf-8", "surrogateescape"))
        for file in files_of(base / name):
            digest.update(os.fsencode(file) + b"\0" + content_of(file))
    for name, tool in sorted(configuration.source.tools.commands.items()):
        for part in _parts_of(name, tool, base):
            digest.update(part)
    for switch in switches_of(configuration):
        digest.update(f"switch {switch}\0".encode("utf-8", "surrogateescape"))
    for server in servers_of(configuration):
        digest.update(f"server {server}\0".encode("utf-8", "surrogateescape"))
    return digest.hexdigest()


def _parts_of(name: str, tool: ToolCommand, base: Path) -> Iterator[bytes]:
    """Yield the words of a command, and the contents of files that it may read of the workspace."""
    for word in (name, *tool.command):
        yield f"command {word}\0".encode("utf-8", "surrogateescape")
        # A script of the workspace is what would run, whether it comes first or behind an interpreter.
        if (base / word).is_file():
            yield content_of(base / word)
    for word in tool.reads:
        yield f"reads {word}\0".encode("utf-8", "surrogateescape")
        yield from (os.fsencode(file) + b"\0" + content_of(file) for file in files_of(base / word))


def content_of(file: Path) -> bytes:
    """Return the hash of a file's content, or that it cannot be read."""
    try:
        with file.open("rb") as stream:
            digest = sha256()
            while piece := stream.read(1 << 20):
                digest.update(piece)
    except OSError:
        return b"unreadable"
    return digest.digest()


def read_trusted(environment: Mapping[str, str]) -> Trusted:
    """Return what the user trusts.

    Raises:
        UsageError: the file with it is damaged.
    """
    path = user_folder(environment) / _FILE
    try:
        return msgspec.json.decode(path.read_bytes(), type=Trusted)
    except FileNotFoundError:
        return Trusted()
    except (OSError, msgspec.DecodeError) as error:
        raise UsageError(
            f"{path} cannot be read: {error}", expected="folders and hashes", advice="Remove it, then trust again"
        ) from error


def write_trusted(trusted: Trusted, environment: Mapping[str, str]) -> None:
    """Keep what the user trusts.

    Raises:
        OSError: it cannot be written.
    """
    write_private(user_folder(environment) / _FILE, msgspec.json.format(msgspec.json.encode(trusted)) + b"\n")


def is_trusted(configuration: Configuration, environment: Mapping[str, str]) -> bool:
    """Return whether the user trusts what this configuration would have run, as it is now."""
    return read_trusted(environment).folders.get(folder_of(configuration)) == hash_of(configuration)


def trust(configuration: Configuration, environment: Mapping[str, str]) -> None:
    """Trust what this configuration would have run, as it is now."""
    trusted = read_trusted(environment)
    folders = {**trusted.folders, folder_of(configuration): hash_of(configuration)}
    write_trusted(msgspec.structs.replace(trusted, folders=folders), environment)


def revoke(configuration: Configuration, environment: Mapping[str, str], root: Path) -> bool:
    """Trust it no more; return whether it was trusted in any state."""
    trusted = read_trusted(environment)
    folders, settings = dict(trusted.folders), dict(trusted.settings)
    known = [folders.pop(folder_of(configuration), ""), settings.pop(place_of(configuration, root), "")]
    write_trusted(Trusted(folders, settings), environment)
    return any(known)


def folder_of(configuration: Configuration) -> str:
    """Return the folder that trust in a configuration is given for."""
    return os.path.realpath(configuration.base or ".")


def place_of(configuration: Configuration, root: Path) -> str:
    """Return the folder that trust in settings of tools is given for, where ``root`` is looked at.

    It is that of the configuration, unless this is one of the user's own that lies elsewhere.
    """
    folder, real = folder_of(configuration), os.path.realpath(root)
    return folder if (real + os.sep).startswith(folder.rstrip(os.sep) + os.sep) else real


def admitted(
    configuration: Configuration,
    *,
    given: bool,
    environment: Mapping[str, str],
    ask: Callable[[str], bool] | None = None,
) -> Configuration:
    """Return the configuration with only the plug-ins that may run; the others are named in it as not trusted.

    Args:
        configuration: as it was read.
        given: whether the command line declares it trusted.
        environment: of this process, for where the user's own files are.
        ask: asks the user; None if there is no one to ask.

    Raises:
        UsageError: what the user trusts cannot be read.
    """
    code = code_of(configuration)
    if not code or given or is_trusted(configuration, environment):
        return configuration
    if ask is not None and ask(_question(configuration)):
        trust(configuration, environment)
        return configuration
    return withheld(configuration)


def withheld(configuration: Configuration) -> Configuration:
    """Return the configuration without servers, plug-ins, commands, tools, their options and models that start one.

    Plug-ins, commands and tools are named as not trusted.
    """
    source = configuration.source
    tools = msgspec.structs.replace(
        source.tools,
        commands={},
        untrusted=tuple(sorted(source.tools.commands)),
        use=(),
        not_used=(
            *(name for name in source.tools.use if plain(name) not in source.disable),
            *(STARTED_BY_MODEL[name] for name in _starting(source.models)),
        ),
    )
    source = msgspec.structs.replace(
        source,
        plugins=(),
        untrusted=source.plugins,
        tools=tools,
        options={name: table for name, table in source.options.items() if name in OWN_OPTIONS},
        models=tuple(name for name in source.models if name not in STARTED_BY_MODEL),
    )
    engine = "" if "://" in configuration.engine else configuration.engine
    return msgspec.structs.replace(configuration, source=source, store="", engine=engine)


def _question(configuration: Configuration) -> str:
    listed = "".join(f"  {name}\n" for name in code_of(configuration))
    return (
        f"{configuration.path} names plug-ins, commands or tools, which would run as you, or servers:\n"
        f"{listed}"
        f"Trust them as they are now? [y/N] "
    )


def asked_on_terminal(*, quiet: bool) -> Callable[[str], bool] | None:
    """Return what asks on the terminal; None where there is none, or the user wants no questions."""
    if quiet or not (sys.stdin.isatty() and sys.stderr.isatty()):
        return None

    def ask(question: str) -> bool:
        print(question, end="", file=sys.stderr, flush=True)
        return sys.stdin.readline().strip().lower() in {"y", "yes"}

    return ask
