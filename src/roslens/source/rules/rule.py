"""What a native rule declares: the page of whoever writes one.

A rule is a module below ``source/rules/<family>`` with a constant ``RULE``; nothing else names it. Its id is the
family and the name of the module. A :class:`FileRule` reads one file through the tree of the one parse; what it finds
is kept by content, so it must not depend on any other file nor on the name of its own. A :class:`PackageRule` reads
what is known of a package: manifest, files, facts.

Beside the module stands a fixture, ``tests/fixtures/rules/<family>/<module>…``; the contract test
``tests/source/rules/test_every_rule.py`` says what is missing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

import msgspec

from roslens.model.finding import RuleInfo, Severity
from roslens.model.weight.consequence import Certainty, Consequence, severity_of
from roslens.source.rules.field.precision import is_confirmed, precision_of, read_samples

if TYPE_CHECKING:
    from tree_sitter import Node

    from roslens.source.rules.file_view import FileView
    from roslens.source.rules.hit import Hit
    from roslens.source.rules.package_view import PackageView

TOOL = "roslens"
"""Tool of the findings of native rules."""

ROSCPP = ("ros/ros.h", "ros::")
RCLCPP = ("rclcpp",)
ROS_CPP = (*ROSCPP, *RCLCPP)
FIRMWARE = (b"<ros.h>", b'"ros.h"', b"ros_lib", b"NodeHandle_<")
"""What files for microcontrollers mention, whose `ros::` is that of rosserial."""
ROSPY = ("rospy",)
RCLPY = ("rclpy",)
TESTS = (b"gtest", b"gmock", b"unittest", b"pytest", b"rostest", b"launch_testing", b"catch2", b"catch.hpp")
"""What files of tests mention."""
TESTS_HINTS = (b"test", b"mock", b"catch")
"""Each of :data:`TESTS` holds one of these: looking for few is quicker."""
ROS_PYTHON = (*ROSPY, *RCLPY)
"""Values of ``mentions``: what code of nodes cannot do without."""


class Rule(msgspec.Struct, frozen=True, kw_only=True):
    """What any native rule says of itself.

    Attributes:
        id: ``family.module``.
        title: a heading of a few words.
        finds: what is reported, and what to do instead, in sentences.
        why: why it matters on a robot.
        consequence: what follows if a finding is left as it is.
        certainty: how certain it is that a finding is true and has that consequence; a hit may be less certain. With
            the consequence it gives the severity (:func:`~roslens.model.weight.consequence.severity_of`).
        profiles: in which it is on (:mod:`~roslens.source.rules.profiles`); in none it is on only where it is named.
        tags: what readers filter by, beside the family and the profiles.
        clauses: of published standards and checks of peers that it covers: ``misra-cpp-2008 6-4-1``,
            ``cpplint readability/braces``, ``hicpp 5.1.2``.
        bad: an example that it reports.
        good: the same, as it should be.
        unlike: ids of rules that require the opposite: no profile may have both.
        fix: what its edits do, and where it has none, in sentences; empty for a rule whose findings take a person.
            Edits keep what the code does, but for what the rule is about.
    """

    id: str
    title: str
    finds: str
    why: str
    consequence: Consequence
    certainty: Certainty
    profiles: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    clauses: tuple[str, ...] = ()
    bad: str = ""
    good: str = ""
    unlike: tuple[str, ...] = ()
    fix: str = ""

    @property
    def unproven(self) -> bool:
        """Whether it is heuristic and nobody has confirmed it on repositories that it was not written for."""
        return self.certainty is Certainty.HEURISTIC and not is_confirmed(self.id)

    @property
    def severity(self) -> Severity:
        """Of its findings, unless one is less certain."""
        return severity_of(self.consequence, self.certainty, unproven=self.unproven)

    @property
    def family(self) -> str:
        """The first part of the id."""
        return self.id.partition(".")[0]

    @property
    def languages(self) -> tuple[str, ...]:
        """Names of the syntaxes whose files it reads; none where it reads packages."""
        return ()

    @property
    def info(self) -> RuleInfo:
        """What travels with a run and is shown to readers."""
        return RuleInfo(
            self.id,
            self.title,
            self.finds,
            self.severity,
            tuple(dict.fromkeys((self.family, *self.tags, *self.profiles))),
            self.why,
            tool=TOOL,
            languages=self.languages,
            scope="file" if self.languages else "package",
            precision=precision_of(self.id),
            read=read_samples().get(self.id, (0, 0))[1],
            fix=self.fix,
            bad=self.bad.strip("\n"),
            good=self.good.strip("\n"),
            consequence=self.consequence,
            certainty=self.certainty,
            unproven=self.unproven,
        )


def _nothing(_node: Node, _view: FileView) -> Iterable[Hit]:
    return ()


class FileRule(Rule, frozen=True, kw_only=True):
    """A rule on one file. It is asked about the nodes that it names, and about nothing where there are none.

    Attributes:
        syntax: ``cpp`` (C and C++), ``python``.
        anchors: words or parts of code; ``found`` is called with the smallest node around each place, outside of
            comments and strings, where one stands. One that begins or ends with a letter, digit or ``_`` is a whole
            word there.
        kinds: types of nodes of the grammar, or shapes (:mod:`~roslens.source.syntax.query.asked_nodes`) where most
            nodes of a type are of no use; ``found`` is called with each.
        quoted: parts of texts; ``found`` is called with the smallest node around each place inside of a string.
        whole: call ``found`` once with the root.
        gathers: types and shapes that the rule goes through itself besides, by :meth:`FileView.nodes`.
        spares_tests: it looks at nothing in a file that uses a framework for tests.
        mentions: the rule looks at nothing in a file that holds none of these anywhere; none is every file.
        in_c: it counts in files of C as well, which have no other casts, null pointers or memory.
        words: with ``whole``, the rule looks at nothing in a file whose code, without its comments, has none of these
            as a whole word; none is every file.
        found: yields what it finds; see :meth:`roslens.source.rules.file_view.FileView.hit`.
        found_among: is called instead, once with all nodes of a kind: for kinds of which a file has many, where a look
            at its text rules most of them out.
    """

    syntax: str
    anchors: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    quoted: tuple[str, ...] = ()
    whole: bool = False
    gathers: tuple[str, ...] = ()
    mentions: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    in_c: bool = True
    spares_tests: bool = False
    found: Callable[[Node, FileView], Iterable[Hit]] = _nothing
    found_among: Callable[[Sequence[Node], FileView], Iterable[Hit]] | None = None

    @property
    def languages(self) -> tuple[str, ...]:
        """Names of the syntaxes whose files it reads."""
        return (self.syntax,)


class PackageRule(Rule, frozen=True, kw_only=True):
    """A rule on a package as a whole; ``found`` yields what it finds, each with its path."""

    found: Callable[[PackageView], Iterable[Hit]]
