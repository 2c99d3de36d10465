"""``roslens completion``: a script that teaches a shell to complete roslens' commands and options."""

from __future__ import annotations

import argparse

TEXT = "Print a completion script for a shell."
EXAMPLES = """\
  roslens completion bash > ~/.local/share/bash-completion/completions/roslens
  roslens completion zsh > "${fpath[1]}/_roslens"
  roslens completion tcsh >> ~/.tcshrc"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the shell's name."""
    parser.add_argument("shell", choices=("bash", "zsh", "tcsh"), help="the shell to complete in")


def run(options: argparse.Namespace) -> int:
    """Print the script."""
    import shtab

    from roslens.cli.main import parser

    print(shtab.complete(parser(), shell=options.shell))
    return 0
