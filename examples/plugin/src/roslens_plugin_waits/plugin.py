"""The plug-in: what it declares, and the hook that roslens calls for each file."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.finding import RuleInfo, Severity
from roslens.model.quantity import Fold, Quantity
from roslens.plugins.points import FileInput, Manifest, Option, Report
from roslens_plugin_waits.find_waits import find_waits

manifest = Manifest(
    name="waits",
    interface="1.0",
    version="1.0.0",
    text="Finds fixed waits, and adds up how long the code waits.",
    scopes=("file",),
    languages=("c", "cpp", "python", "launch_python"),
    rules=(
        RuleInfo(
            id="waits.fixed_wait",
            title="A fixed wait",
            description=(
                "The code waits for a fixed time. Wait for the event instead: a message, a service, "
                "a transform, a timer, with a time limit."
            ),
            rationale=(
                "A fixed wait is too short on a loaded robot and too long on all others; while a callback "
                "waits, no other callback of its thread runs."
            ),
            severity=Severity.WARNING,
            tags=("timing", "callbacks"),
        ),
    ),
    quantities=(
        Quantity(
            key="waits.waiting",
            title="Waiting",
            unit="s",
            kinds=(EntityKind.FILE,),
            text="Sum of the fixed waits written in a file.",
            folds=(Fold.SUM,),
            formula="sum of the arguments of all calls that wait for a fixed time",
            limits="a wait in a loop counts once; waits whose time is not a number are left out",
            decimals=2,
        ),
    ),
    options=(Option("longest_s", "float", "the longest fixed wait that is no finding, in seconds", default=0.05),),
)


def analyse_file(file: FileInput, report: Report) -> None:
    """Report each fixed wait that is too long, and the sum of all."""
    total = 0.0
    for wait in find_waits(file.content.decode("utf-8", "replace"), file.language.value):
        total += wait.seconds
        if wait.seconds > file.options["longest_s"]:
            report.finding(
                "waits.fixed_wait",
                f"waits for {wait.seconds:g} s",
                line=wait.line,
                column=wait.column,
                context=wait.text,
            )
    report.measurement("waits.waiting", total)
