from __future__ import annotations

from pathlib import Path

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.metrics.describe import main, metrics_page
from roslens.source.metrics.table import QUANTITIES

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "metrics" / "quantities.md"


def test_the_page_in_the_documentation_is_fresh():
    command = f"python -m roslens.source.metrics.describe {PAGE.relative_to(Path(__file__).parents[3])}"
    assert PAGE.read_text("utf-8") == metrics_page(QUANTITIES.values()), f"write it anew: {command}"


def test_the_command_writes_the_page(tmp_path):
    main([str(tmp_path / "page.md")])
    assert (tmp_path / "page.md").read_text("utf-8") == metrics_page(QUANTITIES.values())


def test_a_section_says_everything():
    quantity = Quantity(
        key="holes",
        title="Holes",
        unit="holes",
        kinds=(EntityKind.FUNCTION, EntityKind.FILE),
        text="How many holes there are.",
        folds=(Fold.MEAN, Fold.MAX),
        better=Better.NEITHER,
        formula="count",
        source="Lennon 1967",
        limits="Small ones.",
        minimum=0,
        maximum=4000,
    )
    page = metrics_page([quantity])
    assert "| [`holes`](#holes) | Holes | holes | function, file | neither |" in page
    for line in (
        "## holes",
        "How many holes there are.",
        "- **Measured on**: function, file",
        "- **Aggregated as**: mean (`holes`), max (`holes.max`)",
        "- **Range**: 0 to 4,000",
        "- **Formula**: count",
        "- **Source**: Lennon 1967",
        "- **Limits**: Small ones.",
    ):
        assert line in page.splitlines()


def test_what_has_no_upper_bound_and_no_folds_says_so():
    plain = Quantity(key="x", title="X", unit="", kinds=(EntityKind.FILE,), text="x")
    page = metrics_page([plain])
    assert "- **Range**: 0 or more" in page
    assert "Aggregated as**:" not in page
    assert "- **Unit**: dimensionless" in page
