"""The contract test kit: what every plug-in must do, as one call in a plug-in's own tests.

::

    from roslens.plugins.contract import assert_plugin

    def test_contract():
        assert_plugin("my_checks.plugin", fixtures=Path(__file__).parent / "fixtures")

The folder of fixtures holds, for each rule (its id without the prefix), a folder with one or more files
or folders whose names begin with ``triggers`` and one or more that begin with ``clean``. A folder ``values``
may hold more files, for quantities that the others do not measure.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path

from roslens.children.scratch_folder import ScratchFolder
from roslens.model.errors import PluginError
from roslens.model.failure import Failure
from roslens.plugins.contract_failures import BREACH
from roslens.plugins.discovery import load_reference
from roslens.plugins.isolation import run_package, run_plugins
from roslens.plugins.member import Member
from roslens.plugins.order import order
from roslens.plugins.outcome import Outcome
from roslens.plugins.points import Manifest
from roslens.plugins.pool import ProcessWorkers
from roslens.plugins.sample import ENDINGS, SUFFIXES, sample_workspace

TRIGGERS = "triggers"
CLEAN = "clean"
VALUES = "values"
CONFIGURATION = "configuration"
STRANGE = {
    "empty": b"",
    "binary": bytes(range(256)) * 8,
    "no_end_of_line": b"x",
    "latin_1": "caf\u00e9 \u00fc\n".encode("latin-1"),
    "crlf": b"\xef\xbb\xbfa\r\n\r\nb\r\n",
    "long_line": b"(" * 20000,
}
"""Contents that occur in real workspaces and that no plug-in may fall over."""


def assert_plugin(
    plugin: str | Path | Member,
    fixtures: Path | None = None,
    *,
    options: Mapping[str, object] | None = None,
    time_limit_s: float = 60.0,
) -> None:
    """Fail with everything that a plug-in lacks, and what to add.

    Args:
        plugin: ``module``, ``module:attribute``, or the path of a file or folder.
        fixtures: the folder of fixtures, see this module.
        options: options of the plug-in for all runs of the test.
        time_limit_s: seconds that one call of a hook may take.

    Raises:
        AssertionError: the plug-in does not keep the contract.
    """
    problems = check_plugin(plugin, fixtures, options=options, time_limit_s=time_limit_s)
    if problems:
        name = plugin.name if isinstance(plugin, Member) else plugin
        lines = "\n".join(f"- {problem}" for problem in problems)
        raise AssertionError(f"{name} does not keep the contract:\n{lines}")


def check_plugin(
    plugin: str | Path | Member,
    fixtures: Path | None = None,
    *,
    options: Mapping[str, object] | None = None,
    time_limit_s: float = 60.0,
) -> tuple[str, ...]:
    """Return everything that a plug-in lacks; see :func:`assert_plugin`."""
    member = plugin if isinstance(plugin, Member) else load_reference(str(plugin))
    if isinstance(member, Failure):
        return (str(member),)
    lacking = tuple(lacking_text(member.manifest))
    if unable := order([member], _foreign_needs(member)).failures:
        return (*lacking, *(str(failure) for failure in unable))
    if member.manifest.scopes == (CONFIGURATION,):
        # Its hook sees no files: nothing calls it with a sample of any.
        return lacking
    with _Bench(member, options or {}, time_limit_s) as bench:
        return (*lacking, *_falls_over(bench), *_misses(bench, fixtures))


def look_at(
    plugin: str | Path | Member,
    path: Path,
    *,
    options: Mapping[str, object] | None = None,
    time_limit_s: float = 60.0,
) -> Outcome:
    """Return what all hooks of a plug-in say of a file or a folder: for tests of single values.

    Raises:
        PluginError: the plug-in cannot be loaded.
    """
    member = plugin if isinstance(plugin, Member) else load_reference(str(plugin))
    if isinstance(member, Failure):
        raise PluginError(member.what, expected=member.expected, advice=member.advice)
    with _Bench(member, options or {}, time_limit_s) as bench:
        return bench.run(path)


class _Bench(ExitStack):
    """A plug-in under test, with workers of two kinds: what differs between them is not deterministic."""

    def __init__(self, member: Member, options: Mapping[str, object], time_limit_s: float) -> None:
        super().__init__()
        self.member = member
        self.measured: set[str] = set()
        self._options = {member.name: options}
        self._workers = [
            self.enter_context(ProcessWorkers(1, time_limit_s=time_limit_s, hash_seed=seed)) for seed in ("0", "1")
        ]

    def __enter__(self) -> _Bench:
        return self

    def run(self, path: Path, kind: int = 0) -> Outcome:
        """Call all hooks for a file or a folder."""
        workspace = sample_workspace(path)
        workers, members = self._workers[kind], [self.member]
        outcome = Outcome()
        for package in workspace.packages:
            outcome += run_package(members, package, root=workspace.root, options=self._options, workers=workers)
        outcome += run_plugins(
            members,
            workspace,
            options=self._options,
            workers=workers,
            findings=outcome.findings,
            measurements=outcome.measurements,
        )
        self.measured.update(measurement.quantity for measurement in outcome.measurements)
        return outcome


def _foreign_needs(member: Member) -> list[str]:
    return [need for need in member.manifest.needs if not need.startswith("program:")]


def lacking_text(manifest: Manifest) -> Iterator[str]:
    """Yield which texts a reader of reports would miss."""
    if not manifest.text.strip():
        yield "manifest has no text: state the purpose of the plug-in in one line"
    for rule in manifest.rules:
        yield from _blank(rule, f"rule {rule.id}", _RULE_TEXTS)
        if rule.title.strip() and rule.description.strip() == rule.title.strip():
            yield f"rule {rule.id} only repeats its title as description: state what it reports and what to do instead"
    for quantity in manifest.quantities:
        yield from _blank(quantity, f"quantity {quantity.key}", _QUANTITY_TEXTS)
    for option in manifest.options:
        yield from _blank(option, f"option {option.name}", {"text": "what it changes"})


_RULE_TEXTS = {
    "title": "a heading of a few words",
    "description": "what the rule reports, in full sentences",
    "rationale": "why it matters to a robot's code",
}
_QUANTITY_TEXTS = {
    "title": "a heading of a few words",
    "text": "its meaning, in full sentences",
    "unit": "its unit, `1` for a ratio",
    "formula": "how it is counted",
}


def _blank(owner: object, name: str, texts: Mapping[str, str]) -> Iterator[str]:
    for part, purpose in texts.items():
        if not getattr(owner, part).strip():
            yield f"{name} has no {part}: add {purpose}"


def _falls_over(bench: _Bench) -> Iterator[str]:
    """Run the plug-in on files that are empty, binary, of another encoding."""
    ends = {language.value: end for end, language in (*ENDINGS.items(), *SUFFIXES.items())}
    wanted = bench.member.manifest.languages or ("cpp", "python")
    with ScratchFolder("contract") as folder:
        for language in wanted:
            for kind, content in STRANGE.items():
                Path(folder, f"{kind}{ends.get(language, '.txt')}").write_bytes(content)
        for failure in bench.run(Path(folder)).failures:
            if not failure.partial or BREACH in failure.what:
                yield f"on a strange file: {failure}; report content that cannot be read by `report.failure`"


def _misses(bench: _Bench, fixtures: Path | None) -> Iterator[str]:
    """Hold what the plug-in finds in the fixtures against what they say it must."""
    manifest = bench.member.manifest
    if fixtures is None or not fixtures.is_dir():
        if manifest.rules or manifest.quantities:
            yield f"no fixtures: give a folder with {TRIGGERS}… and {CLEAN}… below the name of each rule"
        return
    for rule in manifest.rules:
        yield from _misses_of_rule(bench, rule.id, fixtures / rule.id.removeprefix(f"{manifest.name}."))
    for sample in sorted((fixtures / VALUES).glob("*")):
        yield from (f"in {VALUES}/{sample.name}: {failure}" for failure in bench.run(sample).failures)
    for quantity in manifest.quantities:
        if quantity.key not in bench.measured:
            yield f"quantity {quantity.key} is never measured: add {VALUES}/… for which it has a value"


def _misses_of_rule(bench: _Bench, rule: str, home: Path) -> Iterator[str]:
    """Hold what a rule finds against the fixtures in a folder."""
    for kind, what in ((TRIGGERS, "occurs"), (CLEAN, "does not occur")):
        samples = sorted(home.glob(f"{kind}*"))
        if not samples:
            yield f"rule {rule} has no {kind} fixture: add {home.name}/{kind}… in which it {what}"
        for sample in samples:
            yield from _misjudges(bench, rule, kind, sample)


def _misjudges(bench: _Bench, rule: str, kind: str, sample: Path) -> Iterator[str]:
    outcome = bench.run(sample)
    found = [finding for finding in outcome.findings if finding.rule == rule]
    shown = f"{sample.parent.name}/{sample.name}"
    if kind == TRIGGERS and not found:
        yield f"rule {rule} finds nothing in {shown}: it must find what the fixture shows"
    if kind == CLEAN and found:
        yield f"rule {rule} finds {found[0].message!r} in {shown}: it must find nothing there"
    yield from (f"in {shown}: {failure}" for failure in outcome.failures)
    if outcome != bench.run(sample, kind=1):
        yield f"two runs over {shown} differ: sort what comes out of sets, leave times out"
