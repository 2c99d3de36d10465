"""The reference page of process metrics, written from their declarations."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

from roslens.source.forge.quantities import FORGE_QUANTITIES
from roslens.source.metrics.describe import section

_HEAD = """\
# Process metrics

What git's history says of repositories, packages and files. This page is made from the declarations in
`src/roslens/source/history/metrics/`; `make docs` writes it anew.

`roslens check --process-metrics` measures them (or `metrics = true` below `[process]` in `roslens.toml`), for every
repository that the workspace lies in or holds, with two `git log` each, one of them for renames; nothing is fetched,
checked out or started. What the log of a commit says is kept, so that a second run does not ask again. They are not
measured unless asked: a check of `rclcpp` takes 1.24 times the processor with them (`python
benchmarks/history_speed.py CLONE`), and what a clone has of history differs from machine to machine: continuous
integration mostly has one commit of it.

- Of a repository every commit behind its head counts; of a package or file those that are **no merge** and change
  something of it. Merges, octopus merges among them, bring together what is counted already.
- A package is all below its folder, but for packages inside it.
- **Files that were renamed are followed**, by git's own detection (`git log --find-renames`: contents that are alike by
  half; at most 1,000 files that came by 1,000 that went in a commit): a file keeps its commits, people and lines under
  the names that it had before. A file that was copied begins anew, which `git log --follow` sees otherwise (`C` in its
  `--name-status`). Where one file became several in a commit, the one that git takes for it goes on, and the others
  begin anew; asked for one of them alone, `git log --follow` gives each the whole past. In a partial clone only files
  that were renamed without a change are followed.
- **Packages that were moved are followed**, too: where git finds a manifest (`package.xml`, of rosbuild `manifest.xml`)
  again under another folder, and the folder kept its name or most files that came to it by renaming came with it,
  commits that do not have that one behind them count for the folder that the package was in before, also those of
  branches beside it. Whoever has that folder today got it later. A package that came from another repository begins
  there.
- **Ages are taken at the date of the head**, not today's: the same commit has the same ages on every day.
  `--as-of 2026-01-31` (or `as_of` below `[process]`) tells them at another time; the time stands with the run.
- Dates are those of the committers' clocks. Commits dated before a parent of theirs are counted as `skewed`, with the
  worst difference, in the JSON report and on the page of history; no age is below 0.
- In a **shallow** clone nothing is measured, in a **partial** one not what needs contents of files; a failure says so,
  and the check ends with exit code 3 unless `--accept-partial` is given. So it does for a repository without a commit.
- Names of people are compared and not kept: neither reports nor what roslens stores has any.

Each metric has the **command** of git that answers the same, for a repository, and for a file or package as `PATH`
(of a package with packages inside it, behind it `':(exclude)PATH/INNER'` for each; in a repository where packages were
moved, for the commits with the same moves behind them with the folders that these left, as
`tests/process_metrics/git_packages.py` asks git). `tests/process_metrics` holds all of them against git:

```sh
PYTHONPATH=tests python -m process_metrics FOLDER...   # clones with all commits; ends with 1 where one differs
```

Of ros/diagnostics, ros/ros_tutorials, ros2/demos, yujinrobot/kobuki and yujinrobot/yujin_ocs, with 3,940 commits and 60
packages, nine of which were moved, all 1,529 answers are git's (2026-11-23): of the repositories, all packages, the 40
files with most commits, and pairs that change together.

"""


_FORGE = """\
# On the forge

`roslens check --process-metrics --forge` also asks the forge of each repository, which is that of its remote `origin`:
GitHub, GitLab, Codeberg, gitea.com, and hosts that `--forge-host git.example.org=gitlab` names. No forge is contacted
without `--forge`.

- A token comes from `GITHUB_TOKEN` or `GH_TOKEN`, `GITLAB_TOKEN`, `GITEA_TOKEN`, and of codeberg.org `CODEBERG_TOKEN`.
  It is sent to these forges only, never to another host that a remote or a redirection names.
- Answers are kept with their tags (ETag): what did not change costs no limit of rate. `--offline` gives kept answers
  only.
- A forge that asks to wait for a minute or less is waited for; faults (500, 502, 503, 504) are tried three times. What
  then is not known is a failure of that repository alone, and says until when a limit holds, or which token is missing.
- Numbers are those of the moment: they are the only ones here that differ for the same commit.

"""


def process_page(metrics: Sequence[ModuleType]) -> str:
    """Return the page of ``metrics``, modules with a ``QUANTITY`` and ``COMMANDS``, in Markdown."""
    overview = ["| key | metric | unit | measured on |", "| --- | --- | --- | --- |"]
    for metric in metrics:
        one = metric.QUANTITY
        kinds = ", ".join(kind.value for kind in one.kinds)
        overview.append(f"| [`{one.key}`](#{one.key}) | {one.title} | {one.unit} | {kinds} |")
    forge = "\n".join(map(section, FORGE_QUANTITIES.values()))
    return _HEAD + "\n".join([*overview, "", *map(_described, metrics), _FORGE]) + forge


def _described(metric: ModuleType) -> str:
    lines = ["", "```sh"]
    for what, command in metric.COMMANDS.items():
        both = "package" if "file" in metric.COMMANDS else "package or file"
        lines += [f"# of a {both if what == 'path' else what}", command]
    return section(metric.QUANTITY) + "\n".join([*lines, "```", ""])
