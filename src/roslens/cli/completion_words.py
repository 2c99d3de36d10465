"""What a shell offers where a launch file, one of its arguments or an id is asked for, and how it asks roslens."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

LAUNCHES = {"bash": "_roslens_launches", "zsh": "_roslens_launches"}
"""The functions of the shells that complete a launch file, as shtab wants them."""

ARGUMENTS = {"bash": "_roslens_arguments", "zsh": "_roslens_arguments"}
"""Those that complete an argument of the launch file that stands in the line."""

IDS = {"bash": "_roslens_ids", "zsh": "_roslens_ids"}
"""Those that complete the id of what can be explained."""

QUANTITIES = {"bash": "_roslens_quantities", "zsh": "_roslens_quantities"}
"""Those that complete what can be followed over past revisions."""

SIDES = {"bash": "_roslens_sides", "zsh": "_roslens_sides"}
"""Those that complete a side of a comparison: a run, `live`, a file or a folder."""

PREAMBLE = {
    "bash": """\
_roslens_asked() {
  # Options of the line that select the workspace and the launch file.
  local place
  asked=(--path .)
  for ((place = 2; place < COMP_CWORD; place++)); do
    [[ ${COMP_WORDS[place]} == --launch ]] && asked+=(--launch "${COMP_WORDS[place + 1]}")
    [[ ${COMP_WORDS[place]} != -* && ${COMP_WORDS[place - 1]} != -* && -d ${COMP_WORDS[place]} ]] &&
      asked+=(--path "${COMP_WORDS[place]}")
  done
}
_roslens_launches() {
  local asked
  _roslens_asked
  compgen -W "$(roslens completion launches "${asked[@]}" 2>/dev/null)" -- "$1"
}
_roslens_arguments() {
  local asked
  _roslens_asked
  compgen -W "$(roslens completion arguments "${asked[@]}" 2>/dev/null)" -- "$1"
}
_roslens_ids() {
  compgen -W "$(roslens completion ids 2>/dev/null)" -- "$1"
}
_roslens_quantities() {
  compgen -W "$(roslens completion quantities 2>/dev/null)" -- "$1"
}
_roslens_sides() {
  compgen -W "live $(roslens completion revisions 2>/dev/null)" -- "$1"
  compgen -f -- "$1"
}
""",
    "zsh": """\
_roslens_asked() {
  local place
  asked=(--path .)
  for ((place = 2; place < CURRENT; place++)); do
    [[ ${words[place]} == --launch ]] && asked+=(--launch "${words[place + 1]}")
    [[ ${words[place]} != -* && ${words[place - 1]} != -* && -d ${words[place]} ]] && asked+=(--path "${words[place]}")
  done
}
_roslens_launches() {
  local -a asked found
  _roslens_asked
  found=(${(f)"$(roslens completion launches "${asked[@]}" 2>/dev/null)"})
  compadd -a found
}
_roslens_arguments() {
  local -a asked found
  _roslens_asked
  found=(${(f)"$(roslens completion arguments "${asked[@]}" 2>/dev/null)"})
  compadd -S '' -a found
}
_roslens_ids() {
  local -a found
  found=(${(f)"$(roslens completion ids 2>/dev/null)"})
  compadd -a found
}
_roslens_quantities() {
  local -a found
  found=(${(f)"$(roslens completion quantities 2>/dev/null)"})
  compadd -a found
}
_roslens_sides() {
  local -a found
  found=(live ${(f)"$(roslens completion revisions 2>/dev/null)"})
  compadd -a found
  _files
}
""",
}
"""Definitions of these functions, by shell."""

_TRUTHS = (("true", "false"), ("True", "False"), ("1", "0"))


def launches(path: str) -> Iterator[str]:
    """Yield the configurations that a workspace declares, and its launch files as PACKAGE/FILE.

    Raises:
        UsageError: there is no such folder, or its configuration file is wrong.
    """
    from roslens.cli.graph.graph_opened import open_source

    with open_source(_options(path)) as source:
        yield from source.settings.graph.configurations
        yield from sorted(set(source.launch_files()))


def ids(path: str) -> Iterator[str]:
    """Yield what can be explained: names of models, keys of quantities, ids of rules.

    Those of plug-ins that the workspace names are left out, trusted or not: nobody who presses TAB wants them to run.
    """
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.explainable import known
    from roslens.cli.workplace.trust import withheld

    for kind in known(withheld(find_configuration(Path(path).resolve(), None))):
        yield from sorted(kind)


def quantities(path: str) -> Iterator[str]:
    """Yield the keys of what can be followed over past revisions.

    Raises:
        UsageError: none were analysed.
    """
    from roslens.cli.past.past_points import trends_of

    with trends_of(path) as trends:
        yield from trends.keys


def revisions(path: str) -> Iterator[str]:
    """Yield what runs are called that can be compared: the newest, the last release, branches and tags.

    Raises:
        UsageError: the folder is in no repository.
    """
    import os

    from roslens.cli.git.git_repository import repository_of
    from roslens.cli.past.named_run import NOW, RELEASE

    yield from (NOW[0], RELEASE)
    done = repository_of(path).git(
        "for-each-ref", "--format=%(refname:short)", "refs/heads", "refs/remotes", "refs/tags"
    )
    yield from os.fsdecode(done.stdout).split()


def arguments(path: str, launch: str) -> Iterator[str]:
    """Yield ``name:=`` for the arguments of a launch file, with values where it names some or the default is a truth.

    Raises:
        UsageError: there is no such folder or launch file.
    """
    from roslens.cli.graph.graph_opened import open_source

    with open_source(_options(path)) as source:
        for one in source.evaluated(launch, {})[1].arguments:
            default = (one.default.known if one.default else None) or ""
            values = one.choices or next((pair for pair in _TRUTHS if default in pair), ("", default))
            for value in dict.fromkeys(values):
                # A shell takes words apart at some characters, and paths here are not those of the running system.
                if not set(value) & set(" \t\n\"'$`\\{}/"):
                    yield f"{one.name}:={value}"


def _options(path: str) -> argparse.Namespace:
    return argparse.Namespace(
        path=str(Path(path).expanduser()), config=None, jobs=1, no_cache=False, verbose=False, quiet=True
    )
