"""A study: how what was measured of many packages is distributed, depends on each other, and breaks limits."""

from __future__ import annotations

import msgspec

PACKAGE = "package"
REPOSITORY = "repository"
GROUPINGS = ("role", "distribution", "repository", "language")
"""What subjects can be put into groups by; each is a field of :class:`Subject`."""


class Column(msgspec.Struct, frozen=True, omit_defaults=True):
    """A quantity of a study.

    ``of`` is :data:`PACKAGE` or :data:`REPOSITORY`: what has a value of it, and so how many values there are. What
    lies outside of ``minimum`` and ``maximum`` is beyond the threshold; ``threshold`` is how its source writes it.
    ``size`` says that it grows with the amount of code, so that it has a density; ``mean_of`` that its value for a
    package is a mean over parts that may break the threshold one by one.
    """

    key: str
    title: str
    unit: str = ""
    of: str = PACKAGE
    minimum: float | None = None
    maximum: float | None = None
    threshold: str = ""
    decimals: int = 2
    size: bool = False


class Subject(msgspec.Struct, frozen=True, omit_defaults=True):
    """A package or a repository with its values by key, and the groups that it belongs to."""

    name: str
    repository: str = ""
    role: str = ""
    distribution: str = ""
    language: str = ""
    values: dict[str, float] = {}


class Broken(msgspec.Struct, frozen=True):
    """How often a package breaks a rule; ``kind`` is metric or coding."""

    rule: str
    package: str
    role: str
    count: int
    kind: str = "metric"


class Corpus(msgspec.Struct, frozen=True):
    """What a study is about. ``kind`` names the form that it was read from, ``sources`` what was read.

    ``size_key`` is the column by which sizes are taken out of correlations and densities.
    """

    kind: str
    sources: tuple[str, ...]
    columns: tuple[Column, ...]
    packages: tuple[Subject, ...]
    repositories: tuple[Subject, ...] = ()
    broken: tuple[Broken, ...] = ()
    size_key: str = ""

    def subjects(self, column: Column) -> tuple[Subject, ...]:
        """Return what has a value of the column."""
        among = self.repositories if column.of == REPOSITORY else self.packages
        return tuple(one for one in among if column.key in one.values)


class Figures(msgspec.Struct, frozen=True):
    """Key figures of a quantity in a group (``""``: all).

    ``deviation`` is the sample standard deviation (n - 1), None for one value. Quartiles are interpolated linearly
    between the values next to them. ``beyond`` is how many lie outside the threshold, None where there is none.
    """

    key: str
    group: str
    n: int
    median: float
    mean: float
    deviation: float | None
    least: float
    lower: float
    upper: float
    most: float
    beyond: int | None = None

    @property
    def share_beyond(self) -> float | None:
        """Part of the values outside the threshold, from 0 to 1."""
        return None if self.beyond is None else self.beyond / self.n


class Estimate(msgspec.Struct, frozen=True):
    """A coefficient of correlation with its 95 % confidence interval.

    ``p`` is the two-sided probability of as strong a one by chance; ``adjusted`` the same after correction for all
    coefficients of its kind in the study (Benjamini and Hochberg: the expected share of false ones among those that
    are at most as large).
    """

    value: float
    low: float
    high: float
    p: float
    adjusted: float


class Correlation(msgspec.Struct, frozen=True):
    """How two quantities go together over ``n`` packages.

    ``partial`` is the correlation of ranks with the size of packages held fixed; ``density`` that of ranks of both per
    line of code, where both grow with code. None where it does not exist.
    """

    one: str
    other: str
    n: int
    pearson: Estimate
    spearman: Estimate
    partial: Estimate | None = None
    density: Estimate | None = None


class Shape(msgspec.Struct, frozen=True):
    """How values of a quantity lie in a group: at each place the estimated density, the highest of a shape being 1.

    Places are values; they are evenly spaced in value, or in ``log(1 + value)`` where ``logarithmic``.
    """

    key: str
    group: str
    places: tuple[float, ...]
    heights: tuple[float, ...]
    logarithmic: bool = False


class RuleTotal(msgspec.Struct, frozen=True):
    """How often a rule is broken, in how many packages, and by role."""

    rule: str
    kind: str
    count: int
    packages: int
    by_role: dict[str, int] = {}


class Statement(msgspec.Struct, frozen=True):
    """A published statement about a corpus, and the result from the corpus.

    ``holds`` is None where it cannot be decided from what is there.
    """

    section: str
    says: str
    found: str
    holds: bool | None


class Study(msgspec.Struct, frozen=True):
    """The results of a study of a corpus; ``by`` is what groups are made by, ``""`` for none."""

    corpus: Corpus
    by: str
    figures: tuple[Figures, ...]
    groups: tuple[Figures, ...]
    shapes: tuple[Shape, ...]
    rules: tuple[RuleTotal, ...]
    correlations: tuple[Correlation, ...]
    statements: tuple[Statement, ...]

    def column(self, key: str) -> Column:
        """Return a column by its key."""
        return next(one for one in self.corpus.columns if one.key == key)
