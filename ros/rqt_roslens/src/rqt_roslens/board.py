"""The widget: address, what is wrong, the tree, and all that is known of what is chosen."""

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtGui import QBrush, QColor
from python_qt_binding.QtWidgets import (
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rqt_roslens.monitor import Past
from rqt_roslens.spark import Spark
from rqt_roslens.words import alert_rows, clean, color_of, detail_rows, head, state_words

ENTITY, KEY = Qt.UserRole, Qt.UserRole + 1
_JUDGED = ("State", "Signal", "Value", "Expected", "Since", "Why")
_VALUES = ("Signal", "Value", "Last 2 min")


class Board(QWidget):
    """Shows the reports of a monitor; ``chosen`` returns the entity selected for details."""

    chosen = Signal(str)
    asked = Signal(str)

    def __init__(self, address, parent=None):
        super().__init__(parent)
        self.setObjectName("RoslensBoard")
        self.setWindowTitle("Roslens")
        self._past = Past()
        self._snapshot = None
        self._items = {}
        self._entity = ""
        self.address = QLineEdit(address)
        self.address.setPlaceholderText("HOST:PORT of `roslens watch --serve`")
        self.address.setAccessibleName("Address of the monitor")
        self.address.returnPressed.connect(lambda: self.asked.emit(self.address.text()))
        self.head = QLabel()
        self.head.setTextInteractionFlags(Qt.TextSelectableByMouse)
        self.alerts = QListWidget()
        self.alerts.setAccessibleName("What is wrong, first causes first")
        self.alerts.itemActivated.connect(self._go_to)
        self.alerts.itemClicked.connect(self._go_to)
        self.tree = QTreeWidget()
        self.tree.setAccessibleName("Hosts, nodes, topics and connections")
        self.tree.currentItemChanged.connect(self._choose)
        self.title = QLabel()
        self.title.setWordWrap(True)
        self.judged = _table(_JUDGED)
        self.values = _table(_VALUES)
        self._lay_out()

    def _lay_out(self):
        about = QWidget()
        column = QVBoxLayout(about)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.title)
        column.addWidget(self.judged, 1)
        column.addWidget(self.values, 2)
        sides = QSplitter(Qt.Horizontal)
        sides.addWidget(self.tree)
        sides.addWidget(about)
        sides.setSizes([600, 400])
        whole = QSplitter(Qt.Vertical)
        whole.addWidget(self.alerts)
        whole.addWidget(sides)
        whole.setSizes([120, 480])
        first = QHBoxLayout()
        first.addWidget(QLabel("Monitor"))
        first.addWidget(self.address, 1)
        first.addWidget(self.head, 3)
        layout = QVBoxLayout(self)
        layout.addLayout(first)
        layout.addWidget(whole, 1)

    def show_look(self, snapshot, detail, problem):
        """Show a report of a monitor, or why there is none; previous content stays."""
        if snapshot is not None:
            self._snapshot = snapshot
            self._past.take(snapshot)
            self._show_alerts(snapshot)
            self._show_tree(snapshot)
        self.head.setText(clean(head(self._snapshot, problem)))
        if detail is not None and detail.get("entity") == self._entity:
            self._show_detail(detail)

    def _show_alerts(self, snapshot):
        rows = alert_rows(snapshot["alerts"])
        if [self.alerts.item(at).text() for at in range(self.alerts.count())] == [text for _, _, text in rows]:
            return
        self.alerts.clear()
        for entity, state, text in rows:
            item = QListWidgetItem(text)
            item.setForeground(QBrush(QColor(color_of(state))))
            item.setData(ENTITY, entity)
            self.alerts.addItem(item)

    def _show_tree(self, snapshot):
        columns = snapshot["columns"]
        headings = ["", "State"] + [heading for _, heading in columns]
        self.tree.setHeaderLabels(headings)
        above, seen = [], set()
        for row in snapshot["rows"]:
            seen.add(row["key"])
            del above[row["depth"] :]
            parent = above[-1] if above else self.tree.invisibleRootItem()
            item = self._items.get(row["key"])
            if item is None:
                item = self._items[row["key"]] = QTreeWidgetItem(parent)
                item.setExpanded(row["depth"] < 2)
            above.append(item)
            _fill(item, row, [key for key, _ in columns])
        for key in [key for key in self._items if key not in seen]:
            item = self._items.pop(key)
            (item.parent() or self.tree.invisibleRootItem()).removeChild(item)
        self.tree.header().setSectionResizeMode(0, QHeaderView.ResizeToContents)

    def _choose(self, item, _):
        if item is not None:
            self._entity = item.data(0, ENTITY)
            self.title.setText(clean(self._entity))
            self.chosen.emit(self._entity)

    def _go_to(self, item):
        entity = item.data(ENTITY)
        for other in self._items.values():
            if other.data(0, ENTITY) == entity:
                self.tree.setCurrentItem(other)
                self.tree.scrollToItem(other)
                return
        self._entity = entity
        self.title.setText(clean(entity))
        self.chosen.emit(entity)

    def _show_detail(self, detail):
        observed = detail.get("observed")
        self.title.setText(clean("{} {}{}".format(
            detail["kind"], detail["name"], ", " + observed if observed else ""
        )))  # fmt: skip
        rows = detail_rows(detail)
        self.judged.setRowCount(len(rows))
        for place, row in enumerate(rows):
            for column, text in enumerate((state_words(row[0]), *row[1:])):
                item = QTableWidgetItem(clean(text) if column < len(row) - 1 else text)
                item.setToolTip(item.text())
                if column == 0:
                    item.setForeground(QBrush(QColor(color_of(row[0]))))
                self.judged.setItem(place, column, item)
        self.judged.resizeColumnsToContents()
        values = detail.get("values", ())
        self.values.setRowCount(len(values))
        for place, one in enumerate(values):
            name = QTableWidgetItem(one["title"])
            name.setToolTip(one["text"])
            self.values.setItem(place, 0, name)
            self.values.setItem(place, 1, QTableWidgetItem(one["shown"]))
            words = "{}: {}".format(one["title"], one["shown"])
            self.values.setCellWidget(place, 2, Spark(self._past.series(detail["entity"], one["key"]), words))


def _fill(item, row, keys):
    below = "  ({})".format(row["below"]) if row.get("below") else ""
    texts = [clean(row["name"] + below), state_words(row["state"])]
    texts += [row.get("shown", {}).get(key, "") for key in keys]
    for column, text in enumerate(texts):
        if item.text(column) != text:
            item.setText(column, text)
    item.setForeground(1, QBrush(QColor(color_of(row["state"]))))
    item.setData(0, ENTITY, row["entity"])
    item.setData(0, KEY, row["key"])


def _table(headings):
    table = QTableWidget(0, len(headings))
    table.setHorizontalHeaderLabels(headings)
    table.verticalHeader().setVisible(False)
    table.setEditTriggers(QTableWidget.NoEditTriggers)
    table.horizontalHeader().setStretchLastSection(True)
    return table
