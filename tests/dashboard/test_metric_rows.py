"""The metrics of a package: where it stands in the field."""

from roslens.dashboard.tables.metric_rows import metrics_table
from roslens.judge.quality.field import load_field
from roslens.model.entity import Entity, EntityKind


def test_each_quantity_stands_once_in_the_field(site):
    entities = [
        Entity("package:p", EntityKind.PACKAGE, "p", values={"loc": 400.0, "dependents": 3.0}),
        Entity("file:a", EntityKind.FILE, "a", path="a", values={"loc": 300.0}),
        Entity("file:b", EntityKind.FILE, "b", path="b", values={"loc": 100.0}),
        Entity("function:f", EntityKind.FUNCTION, "f", path="a", values={"loc": 20.0}),
    ]
    table = metrics_table(site, entities)
    place = [column.key for column in table.columns].index("field")
    of = [column.key for column in table.columns].index("of")
    rows = {(row[0].text or row[0].value, row[of].value): row[place] for row in table.rows}
    percentile = load_field().find("loc", EntityKind.PACKAGE).percentile(400)
    assert rows["Lines of code", "2 files"].value == round(percentile, 1)
    assert rows["Lines of code", "2 files"].text == f"{percentile:.0f} %"
    assert rows["Lines of code", "1 functions"].value is None
    assert "400 for the package" in rows["Lines of code", "2 files"].hint
