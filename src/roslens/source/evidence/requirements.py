"""The requirements of REP-2004, Package Quality Categories (ros.org/reps/rep-2004.html), in its order."""

from __future__ import annotations

from roslens.model.requirement import Requirement, Weight

_WEIGHTS = {"R": Weight.REQUIRED, "r": Weight.RECOMMENDED, "o": Weight.OPTIONAL, "-": Weight.NONE}

_ROWS = (
    ("1.i", "has a version policy", "RRRr"),
    ("1.ii", "is at a stable version (1.0.0 or above)", "RRR-"),
    ("1.iii", "declares its public API", "RRr-"),
    ("1.iv", "has a policy for the stability of its API", "RRR-"),
    ("1.v", "has a policy for the stability of its ABI", "RRR-"),
    ("1.vi", "keeps API and ABI within a distribution", "RRr-"),
    ("2.i", "makes all changes through change requests", "RRRr"),
    ("2.ii", "confirms the origin of contributions (DCO or CLA)", "RR--"),
    ("2.iii", "has all changes reviewed by peers", "R---"),
    ("2.iv", "runs continuous integration on every change request", "RRR-"),
    ("2.v", "has a policy for documentation of changes", "R---"),
    ("3.i", "documents each feature", "RR--"),
    ("3.ii", "documents each item of its public API", "R---"),
    ("3.iii", "declares its licence", "RRRR"),
    ("3.iv", "states a copyright in each source file", "RRRR"),
    ("3.v", "has a quality declaration", "RRo-"),
    ("3.v.a", "links to the declaration from its README", "RRR-"),
    ("3.v.b", "is registered in the list of packages of its level", "rro-"),
    ("3.v.c", "declares with reference to that list", "RRR-"),
    ("4.i", "has system tests for each feature", "RRrr"),
    ("4.ii", "has tests for each item of its public API", "R---"),
    ("4.iii.a", "tracks the coverage of tests", "RR--"),
    ("4.iii.b", "has and enforces a policy for coverage", "R---"),
    ("4.iv.a", "has performance tests, or states why not", "R---"),
    ("4.iv.b", "has a policy for losses of performance", "R---"),
    ("4.v.a", "enforces a code style", "RR--"),
    ("4.v.b", "uses static analysis", "RR--"),
    ("5.i", "needs only ROS packages of its own level or better at run time", "RR--"),
    ("5.ii", "states which of its dependencies are optional", "ooo-"),
    ("5.iii", "justifies dependencies outside of ROS", "RR--"),
    ("6.i", "supports all tier 1 platforms of REP-2000", "RRRr"),
    ("7.i", "has a policy for vulnerabilities (REP-2006)", "RRr-"),
)

REQUIREMENTS = tuple(
    Requirement(number, asks, (_WEIGHTS[levels[0]], _WEIGHTS[levels[1]], _WEIGHTS[levels[2]], _WEIGHTS[levels[3]]))
    for number, asks, levels in _ROWS
)
BY_NUMBER = {one.number: one for one in REQUIREMENTS}
