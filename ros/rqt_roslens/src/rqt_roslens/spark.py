"""A plot of the last values of a signal, as small as a row of a table."""

from python_qt_binding.QtCore import QPointF, QSize
from python_qt_binding.QtGui import QPainter, QPalette, QPen, QPolygonF
from python_qt_binding.QtWidgets import QWidget

_MARGIN = 3


def points(values, width, height):
    """Return where values are drawn, from left to right, the least at the bottom; all alike are in the middle."""
    if not values:
        return []
    least, most = min(values), max(values)
    span = most - least
    step = (width - 2 * _MARGIN) / max(len(values) - 1, 1)
    room = height - 2 * _MARGIN
    return [
        (_MARGIN + place * step, _MARGIN + room * (0.5 if not span else 1 - (value - least) / span))
        for place, value in enumerate(values)
    ]


class Spark(QWidget):
    """Draws a line through values; its words are in its tool tip."""

    def __init__(self, values, words, parent=None):
        super().__init__(parent)
        self._values = values
        self.setToolTip(words)
        self.setAccessibleName(words)
        self.setMinimumSize(QSize(80, 20))

    def paintEvent(self, _):  # noqa: N802 - Qt's name
        """Draw."""
        found = points(self._values, self.width(), self.height())
        if not found:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.Antialiasing)
        painter.setPen(QPen(self.palette().color(QPalette.Highlight), 1.5))
        if len(found) == 1:
            painter.drawPoint(QPointF(*found[0]))
        else:
            painter.drawPolyline(QPolygonF([QPointF(x, y) for x, y in found]))
        painter.end()
