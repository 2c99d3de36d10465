"""``roslens completion``: a script that teaches a shell to complete roslens' commands and options."""

from __future__ import annotations

import argparse
import re

from roslens.model.errors import UsageError

TEXT = "Print a completion script for a shell."
EXAMPLES = """\
  roslens completion bash > ~/.local/share/bash-completion/completions/roslens
  roslens completion zsh > "${fpath[1]}/_roslens"
  roslens completion tcsh >> ~/.tcshrc"""

_SHELLS = ("bash", "zsh", "tcsh")
_WORDS = ("launches", "arguments", "ids", "quantities", "revisions")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the shell's name; the scripts themselves ask for words that depend on the workspace."""
    shells = "{" + ",".join(_SHELLS) + "}"
    parser.add_argument("shell", choices=(*_SHELLS, *_WORDS), metavar=shells, help="the shell to complete in")
    parser.add_argument("--path", default=".", help=argparse.SUPPRESS)
    parser.add_argument("--launch", default="", help=argparse.SUPPRESS)


def run(options: argparse.Namespace) -> int:
    """Print the script, or the words that it asks for.

    Raises:
        UsageError: a word was asked for of a workspace or a launch file that is not there.
    """
    if options.shell in _WORDS:
        return _print_words(options)
    import shtab

    from roslens.cli.completion_words import PREAMBLE

    script = shtab.complete(options.top_parser, shell=options.shell, preamble=PREAMBLE.get(options.shell, ""))
    if options.shell == "zsh":
        # There a colon ends what stands for a value (``NAME:=VALUE``), unless it is escaped.
        script = re.sub(r":([\w\[\]]+):(=?[\w\]]+):", r":\1\\:\2:", script)
    print(script)
    return 0


def _print_words(options: argparse.Namespace) -> int:
    from roslens.cli.completion_words import arguments, ids, launches, quantities, revisions

    if options.shell == "arguments" and not options.launch:
        raise UsageError("arguments of no launch file", expected="--launch PACKAGE/FILE")
    if options.shell == "arguments":
        found = arguments(options.path, options.launch)
    else:
        asked = {"launches": launches, "ids": ids, "quantities": quantities, "revisions": revisions}
        found = asked[options.shell](options.path)
    for word in found:
        print(word)
    return 0
