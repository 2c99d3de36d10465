"""``roslens init``: write a commented ``roslens.toml`` with all options."""

from __future__ import annotations

import argparse
from pathlib import Path

TEXT = "Write a commented roslens.toml into a folder."
EXAMPLES = """\
  roslens init
  roslens init ~/robot_ws --force"""

TEMPLATE = """\
# Configuration of roslens. Every line is optional; the values shown are the defaults.

# The distribution of ROS that the workspace is for, such as "jazzy"; default: what continuous integration, containers
# and .repos files say.
distro = ""

# Quality models: extreme, ros, nasa-satc, his, kth, akureyri, verifysoft, microsoft, paper2016, or a path to your own
# YAML; NAME:note makes all limits of a model notes.
models = ["extreme:note", "ros:note"]

# Exit with 1 on findings of at least this severity: note, warning, error or never.
fail_on = "error"

# Exit with 0 instead of 3 if only parts of files could not be parsed.
accept_partial = false

# Findings in files of these roles count for the gate: own, test, generated, vendored.
gate_roles = ["own"]

# Plug-ins by path (installed ones are found automatically), and plug-ins to disable, by name.
plugins = []
disable = []

# Time limit of one call of a plug-in, in seconds.
time_limit_s = 60

# Worker processes; 0 means one per processor.
jobs = 0

[workspace]
# Globs on paths below the workspace root; ** matches any depth.
ignore = []
# Files to treat as test, generated, vendored or own code, in addition to automatic detection.
test = []
generated = []
vendored = []
own = []

[workspace.environment]
# Variables for conditions in package.xml; default: ROS_VERSION, ROS_DISTRO, ROS_PYTHON_VERSION of the shell.
# ROS_VERSION = "2"

[counting]
# Decisions inside lambdas count for the enclosing function.
lambdas = true
# Decisions in every arm of #if count, not only those of the first.
alternatives = true
# A block of at least this many equal code lines is a duplicate.
duplicate_lines = 10

[macros]
# Regular expressions of C++ macros that the parser should ignore (export and visibility macros).
blank = []
# Macros that expand to a whole statement or declaration without a semicolon.
statement = []

[rules]
# Which coding rules are on: auto (ros2 or ros1, by package), google, misra-cpp-2008 … (docs/reference/rules.md).
profiles = ["auto"]
# Additional rules, by id or pattern (cpp.*), and rules to disable.
enable = []
disable = []
# Severity of single rules: { "node.console_output" = "note" }
severity = {}

[process]
# Metrics of the git history: revisions, contributors, churn, hotspots … (docs/reference/metrics/process.md).
metrics = false
# Ages are relative to the date of each repository's head, or to this date: "2026-01-31"
as_of = ""

[tools]
# Foreign tools to run: cpplint, ruff … or all (docs/reference/tools.md).
use = []
# Findings about white space and line breaks are combined into one per package (fold), or reported singly (each).
layout = "fold"
# Time limit of one process of a tool, in seconds.
time_limit_s = 600
# SARIF files whose findings are added.
imports = []
# Any other program that writes SARIF; it runs once you trust it (`roslens trust`):
# [tools.semgrep]
# command = ["semgrep", "scan", "--sarif", "--quiet", "{root}"]

# Accepted findings, with a reason; `roslens accept` is for single ones (docs/reference/silencing.md).
# [[ignore]]
# paths = ["src/legacy/**"]
# rules = ["ros.calls.max"]
# reason = "frozen until the drive is replaced"

# Conditions under which a check passes, besides fail_on (docs/reference/new_findings.md).
# [gate]
# new_errors = 0                   # with --baseline
# comment_ratio_of_new_code = 20

# Systems that run together, by name: `roslens check` reports mismatches within them, and pages show them.
# [graph.configurations.robot]
# launch = "my_bringup/robot.launch.py"
# arguments = { simulation = false }
# whole = true    # nothing else runs: a node that waits for something not provided within it waits for ever
[graph.configurations]

# Facts about a node that its source does not contain, for `roslens graph`; by its name, or by package/executable:
# [graph.hints."/driver"]
# publishes = ["odom nav_msgs/msg/Odometry 10"]
# names = { "src/driver/src/driver.cpp:31" = "cmd_vel" }
# loads = ["driver_plugins/Filter"]    # workspace code that it loads: plug-ins, classes, functions, files
[graph.hints]
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the folder and ``--force``."""
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="folder to write into (default: .)")
    parser.add_argument("--force", action="store_true", help="replace an existing roslens.toml")


def run(options: argparse.Namespace) -> int:
    """Write the file.

    Raises:
        UsageError: the folder does not exist, or the file does and ``--force`` was not given.
    """
    from roslens.cli.workplace.configuration import FILE_NAME
    from roslens.model.errors import UsageError

    folder = Path(options.path)
    if not folder.is_dir():
        raise UsageError(f"no folder {options.path!r}", expected="the root of a workspace")
    path = folder / FILE_NAME
    if path.exists() and not options.force:
        raise UsageError(f"{str(path)!r} exists", advice="Use --force to replace it")
    path.write_text(TEMPLATE, "utf-8")
    print(f"{path} written; every line in it is optional")
    return 0
