"""The reference page of process metrics, written from their declarations."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

from roslens.source.forge.quantities import FORGE_QUANTITIES
from roslens.source.metrics.describe import section

_HEAD = """\
# Process metrics

Metrics of repositories, packages and files from their git history. `make docs` generates this page from the
declarations in `src/roslens/source/history/metrics/`.

`roslens check --process-metrics` (or `metrics = true` below `[process]` in `roslens.toml`) measures them for every
repository that contains the workspace or is part of it, with two `git log` each, one of them for renames; nothing is
fetched, checked out or executed. The log of each commit is cached, so that a second run need not read it again. They
are off by default: a check of `rclcpp` takes 1.24 times the processor time with them (`python
benchmarks/history_speed.py CLONE`), and the history that a clone contains differs from machine to machine: continuous
integration mostly has a single commit.

- For a repository, every ancestor of its head counts; for a package or file, every commit that is **not a merge** and
  changes it. Merges, including octopus merges, only combine changes that are already counted.
- A package is everything below its folder, except for nested packages.
- **Renamed files are followed**, by git's rename detection (`git log --find-renames`: contents that are at least half
  identical; at most 1,000 added files against 1,000 deleted ones in a commit): a file keeps its commits, people and
  lines under its previous names. A copied file starts a new history, unlike in `git log --follow` (`C` in its
  `--name-status`). Where a commit split one file into several, the one that git detects as the rename keeps the
  history, and the others start a new one; for each of them alone, `git log --follow` reports the whole history. In a
  partial clone, only files that were renamed without a change are followed.
- **Moved packages are followed**, too: where git finds a manifest (`package.xml`, of rosbuild `manifest.xml`) under
  another folder, and the folder kept its name or most files that were renamed into it moved with the manifest, commits
  that are not descendants of this move count for the previous folder of the package, including those of parallel
  branches. A package that uses that folder today got it later. The history of a package that came from another
  repository starts there.
- **Ages are relative to the date of the head**, not to today: the same commit has the same ages on every day.
  `--as-of 2026-01-31` (or `as_of` below `[process]`) selects another date, which is stored with the run.
- Dates are those of the committers' clocks. Commits dated before one of their parents are counted as `skewed`, with
  the largest difference, in the JSON report and on the history page; no age is below 0.
- In a **shallow** clone nothing is measured, in a **partial** one nothing that requires file contents; both are
  reported as a failure, and the check exits with code 3 unless `--accept-partial` is given. The same applies to a
  repository without commits.
- Names of people are compared but not stored: neither reports nor the stored data contain any.

Each metric lists an equivalent git **command**, for a repository, and for a file or package as `PATH` (for a package
with nested packages, followed by `':(exclude)PATH/INNER'` for each; in a repository where packages were moved, for the
commits with the same moves among their ancestors and the folders before these moves, as
`tests/process_metrics/git_packages.py` does). `tests/process_metrics` compares all of them with git:

```sh
PYTHONPATH=tests python -m process_metrics FOLDER...   # clones with all commits; exits with 1 if one differs
```

Of ros/diagnostics, ros/ros_tutorials, ros2/demos, yujinrobot/kobuki and yujinrobot/yujin_ocs, with 3,940 commits and 60
packages, nine of which were moved, all 1,529 values equal those of git (2026-11-23): of the repositories, all packages,
the 40 files with most commits, and pairs that change together.

"""


_FORGE = """\
# On the forge

`roslens check --process-metrics --forge` also queries the forge of each repository, which is the host of its remote
`origin`: GitHub, GitLab, Codeberg, gitea.com, and hosts given by `--forge-host git.example.org=gitlab`. No forge is
contacted without `--forge`.

- Tokens are read from `GITHUB_TOKEN` or `GH_TOKEN`, `GITLAB_TOKEN`, `GITEA_TOKEN`, and for codeberg.org
  `CODEBERG_TOKEN`. They are sent to these forges only, never to another host that a remote or a redirect names.
- Responses are cached with their ETag: unchanged data does not count towards the rate limit. `--offline` uses the
  cache only.
- If a forge asks for a delay of a minute or less, the request is repeated after it; server errors (500, 502, 503, 504)
  are tried three times. Values that remain unknown are a failure of that repository alone, which states when the rate
  limit ends or which token is missing.
- These numbers are those at the time of the run: they are the only ones here that differ for the same commit.

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
