"""What the 2016 study measured of a package, the way it measured it."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity

_STUDY = "Santos, Cunha, Macedo and Lourenço, A Framework for Quality Assessment of ROS Repositories, IROS 2016"
_ALONE = (
    "cccc looks at each file alone: what other files hold is not seen, and a class whose methods stand in several "
    "files counts in each of them"
)
_FILE = (EntityKind.FILE, EntityKind.PACKAGE)
_FUNCTION = (EntityKind.FUNCTION, EntityKind.PACKAGE)
_CLASS = (EntityKind.CLASS, EntityKind.PACKAGE)


def _of_class(key: str, title: str, unit: str, text: str, element: str) -> Quantity:
    return Quantity(
        key=f"paper2016.{key}",
        title=f"{title} (2016)",
        unit=unit,
        kinds=_CLASS,
        text=text,
        better=Better.LOWER,
        formula=f"`{element}` of cccc; of a class the largest in any file, of a package the mean over all classes in "
        "all files whose value is above 0 (0 where there is none)",
        source=_STUDY,
        limits=f"{_ALONE}. Classes with 0 are left out of the mean, so it is never below 1 but where it is 0.",
        decimals=2,
    )


LOC = Quantity(
    key="paper2016.loc",
    title="Lines of code (2016)",
    unit="lines",
    kinds=_FILE,
    text="Lines of code as cccc counts them, over all C and C++ files of a package, its tests included.",
    better=Better.NEITHER,
    formula="`lines_of_code` of cccc; of a package the sum over its files",
    source=_STUDY,
    limits="Files for which cccc reports 0 are left out, with their comments.",
)

COMMENT_LINES = Quantity(
    key="paper2016.comment_lines",
    title="Comment lines (2016)",
    unit="lines",
    kinds=_FILE,
    text="Lines of comment as cccc counts them.",
    better=Better.NEITHER,
    formula="`lines_of_comment` of cccc; of a package the sum over its files",
    source=_STUDY,
    limits="Files without a line of code are left out.",
)

COMMENT_RATIO = Quantity(
    key="paper2016.comment_ratio",
    title="Comment ratio (2016)",
    unit="%",
    kinds=_FILE,
    text="Comment lines for every hundred lines of code, as cccc counts both.",
    better=Better.HIGHER,
    formula="100 * paper2016.comment_lines / paper2016.loc; of a file rounded down to a whole number, as the study "
    "held it against its threshold",
    source=_STUDY,
    limits="The study prints it as a ratio. Above 100 where there is more comment than code.",
    decimals=1,
)

CYCLOMATIC_COMPLEXITY = Quantity(
    key="paper2016.cyclomatic_complexity",
    title="Cyclomatic complexity (2016)",
    unit="1",
    kinds=_FUNCTION,
    text="Cyclomatic complexity as cccc counts it.",
    formula="`McCabes_cyclomatic_complexity` of cccc; of a package the mean over all functions whose value is at least "
    "1 (0 where there is none)",
    source=_STUDY,
    limits="cccc counts decisions and `return`, without McCabe's 1: a function with neither has 0 and is left out like "
    "a declaration.",
    decimals=2,
)

CBO = _of_class(
    "cbo",
    "Coupling between classes",
    "classes",
    "How many classes a class uses or is used by, inside one file.",
    "coupling_between_objects",
)
NOC = _of_class(
    "noc", "Number of children", "classes", "How many classes of the same file inherit from it.", "number_of_children"
)
WMC = _of_class(
    "wmc",
    "Weighted methods per class",
    "methods",
    "How many methods a class has (each with the weight 1).",
    "weighted_methods_per_class_unity",
)
DIT = _of_class(
    "dit",
    "Depth of inheritance",
    "levels",
    "How many ancestors it has in the same file.",
    "depth_of_inheritance_tree",
)
MAC = _of_class(
    "mac",
    "Methods available",
    "methods",
    "How many methods of a class are not private.",
    "weighted_methods_per_class_visibility",
)

HALSTEAD_VOLUME = Quantity(
    key="paper2016.halstead_volume",
    title="Halstead volume (2016)",
    unit="bits",
    kinds=_FILE,
    text="The volume that the study's own tokens give.",
    formula="N log2 n over words and operator characters, comments left out; in single precision; of a package the "
    "mean over its files, empty ones included",
    source=_STUDY,
    limits="Two-character operators whose first character is one too count as two, the insides of strings as words "
    "and `//` inside a string as a comment.",
    decimals=1,
)

MAINTAINABILITY_INDEX = Quantity(
    key="paper2016.maintainability_index",
    title="Maintainability index (2016)",
    unit="1",
    kinds=(EntityKind.PACKAGE,),
    text="The maintainability index of the study.",
    better=Better.HIGHER,
    formula="max(0, (171 - 5.2 ln V - 0.23 CC - 16.2 ln L) * 100 / 171 + 50 sin(sqrt(2.4 C))); V and L are the means "
    "over the files of the package of paper2016.halstead_volume and (where it is above 0) of paper2016.loc, CC is "
    "paper2016.cyclomatic_complexity, C the comment lines for each line of code",
    source=_STUDY,
    limits="The comment term is not scaled with the rest and is not capped: above 100 is possible.",
    decimals=1,
)

RQV = Quantity(
    key="paper2016.rqv",
    title="ROS model violations (2016)",
    unit="findings",
    kinds=_FILE,
    text="How often the values of cccc violate the ROS model: #RQV.",
    formula="number of files, functions and classes outside a range of the model paper2016; of a class once for every "
    "file that it occurs in",
    source=_STUDY,
    limits="Of the 13 rules of the ROS model the study measured those on comments, CC, CBO, NOC, DIT and the maxima of "
    "WMC and MAC. Classes that a file only uses count too, so it can be above the number of findings. The study's "
    "#RCV needs its other tools and is not measured.",
)

CCCC_QUANTITIES = (
    LOC,
    COMMENT_LINES,
    COMMENT_RATIO,
    CYCLOMATIC_COMPLEXITY,
    CBO,
    WMC,
    MAC,
    NOC,
    DIT,
    HALSTEAD_VOLUME,
    MAINTAINABILITY_INDEX,
    RQV,
)
