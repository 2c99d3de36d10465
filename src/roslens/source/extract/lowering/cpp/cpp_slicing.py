"""Which functions and statements of C++ may affect the graph, judged by text before any node is read.

Most functions compute. What names an interface of ROS, makes an object or is short is lowered whole, and so is what
makes texts or options of nodes of what it is given, and what may keep a handle that it is given: names are made there.
Of the others only statements stay that call what may lead to such an interface (``initPublishers();``,
``costmap->configure(node)``), with the returns and the control structure around them; those without such calls have no
body in the program. A test (``TEST``, ``TEST_F``) is lowered whole where it names an endpoint or a parameter, else it
has no body.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from enum import IntEnum

_SHORT = 120
_CREATED = rb"publisher|subscription|generic_\w+|service|client|server|timer|wall_timer|callback_group|sub_node|rate"
_ENDPOINTS = rb"create_(?:%s)|advertise|subscribe|[sS]erviceClient|service::call|waitForMessage" % _CREATED
_ENDPOINT = re.compile(rb"(?:%s|[pP]aram|declare_)\w*\s*[<(]" % _ENDPOINTS)
_WORDS = {
    b"aram": rb"\b(?:get_param|set_param|has_param|[gs]etParam|hasParam|searchParam|param(?:Cached)?\s*[<(]|param::)",
    b"new": rb"new(?<!\wnew)\s+(?:\(|[A-Za-z_:][\w:]*\s*[<({;,)]|(?:\w*::)*[A-Z]\w*\s*\[)",
    b"init": rb"init(?<!\winit)\s*\(",
    b"create": rb"create(?<!\wcreate)(?:_(?:%s)|\w*Timer|\w*(?:Instance|Server|Client))" % _CREATED,
    b"ubscri": rb"\bsubscribe|Subscri(?:ber|ption)",
    b"ublisher": rb"Publisher",
    b"make_": rb"\bmake_(?:shared|unique)",
    b"NodeHandle": rb"\bNodeHandle",
    b"Timer": rb"Timer\b",
    b"declare_": rb"\bdeclare_",
    b"advertise": rb"\badvertise",
    b"ervice": rb"\b(?:[sS]erviceClient|service::call)|Service(?:Server|Client)",
    b"Action": rb"Action(?:Server|Client)",
    b"QoS": rb"QoS",
    b"Transform": rb"Transform(?:Listener|Broadcaster)",
    b"registerCallback": rb"\bregisterCallback",
    b"resolve": rb"\bresolve_?[nN]ame",
    b"get_node_": rb"\bget_node_\w+_interface",
    b"async": rb"\bstd::async\b",
    b"::thread": rb"::thread\s*(?:\w+\s*)?[({]",
    b"add_node": rb"\badd_node",
    b"waitForMessage": rb"\bwaitForMessage",
    b"]->": rb"\]->(?:on_?)?(?:[cC]onfigure|[iI]nit(?:ialize)?)\s*\(",
    b"this_node": rb"=\s*(?:::)?ros::this_node::get",
    b"return": rb"return\s+(?:std::string\s*\(\s*)?\"",
}
_WHOLE = tuple((letters, re.compile(written)) for letters, written in _WORDS.items())
"""What makes a function matter as a whole, each behind letters of it: to find letters takes a fiftieth of a pattern."""
_MAKES_NAMES = re.compile(rb"\b(?:string|NodeOptions|SubscribeOptions|AdvertiseOptions)\b[\s&*>]*(?:[\w:]+\s*)?[(,)]")
"""A head of a function that returns a text or options, or takes them."""
_MOST_OF_TEXT = 1500
_TAKES_NODES = re.compile(
    rb"\b(?:NodeHandle|rclcpp(?:_lifecycle)?::(?:Lifecycle)?Node)(?:Ptr|::\w*Ptr)?[\s&*>]+\w*\s*[,)=]"
)
"""A head of a function that takes a handle or a node: it may keep it."""
_CALLED = re.compile(rb"\(\s*(?:>[^;(){}]{0,80}?<\s*)?(\w+)")
"""Finds the names of calls in a text that runs backwards: a pattern that begins with one fixed byte is fast."""
_SET = re.compile(rb"=(?<!==)[-+*/|&^%]?\s*(\w+)(?!\w)(?!\s*(?!esle\b)(?:[\w.&*]|>(?!-siht)))")
"""Finds names set in a text that runs backwards, declarations aside: ``count_ =``, ``m_count +=``, ``on =``."""
_OTHER_NAME = re.compile(rb"[&*]\s*(\w+)\s*=\s*&?\s*(?:this\s*->\s*)?([A-Za-z_]\w*)\s*;")
_LEADING = re.compile(
    rb"(?:on_|do_?)?(?:init|setup|set_?[uU]p|configure|create|add|register|load|start|activate|advertise|connect|open|spawn|enable"
    rb"|declare|make|build|publish|read_?[pP]ar|get_?[pP]ar|update_?[pP]ar|reconfigure|run|on[A-Z_]"
    rb"|async_send|send_?(?:goal|request)|(?:get|read|load)\w*_?param)",
    re.IGNORECASE,
)
_CALL_STATEMENT = re.compile(rb"(?:this\s*->\s*)?(?:[A-Za-z_]\w*(?:::|\.|->))*([A-Za-z_]\w*)\s*\(")
_STATEMENT_BEGINS = re.compile(
    rb"[;{}\n][ \t]*(?:this->)?(?:[A-Za-z_]\w*(?:::|\.|->)){0,3}"
    rb"(?!if\b|for\b|while\b|return\b|switch\b)[A-Za-z_]\w*\("
)
_TEXT_ASSIGNED = re.compile(rb"=\s*(?:std::string\s*\(\s*)?\"")
_ASSIGNED = re.compile(
    rb"(?:this\s*->\s*)?(?:[\w.>-]*\w\s*\+?=\s*(?:std::string\s*\(\s*)?\"|\w*(?:topic|name|frame|service|action|prefix)\w*\s*\+?=[^=])",
    re.IGNORECASE,
)
_VALUE_RETURNED = re.compile(rb"return(?<!\wreturn)\s*[^\s;]")
_LOGGING = re.compile(
    rb"(?:EXPECT|ASSERT|BOOST_CHECK)_\w+\s*\(|(?:ROS|RCLCPP|RCUTILS|NODELET|RTT|CONSOLE_BRIDGE)_(?:DEBUG|INFO|WARN|ERROR|FATAL|LOG|ASSERT|BREAK|STATIC)\w*\s*\("
    rb"|(?:log(?:Debug|Inform|Warn|Error)|f?printf|puts)\s*\(|std::c(?:out|err)\b|c(?:out|err)\s*<<"
)
_DULL = (
    b"if for while switch catch return sizeof static_cast dynamic_cast reinterpret_cast const_cast decltype "
    b"defined throw new delete assert abs fabs sqrt pow sin cos tan asin acos atan atan2 hypot floor ceil round "
    b"lround fmod min max clamp exp log swap move forward get lock unlock try_lock size empty begin end rbegin "
    b"rend cbegin cend front back push_back emplace_back pop_back push pop emplace insert erase find count at "
    b"clear resize reserve assign fill sort copy c_str str data length substr reset release what now seconds "
    b"nanoseconds toSec toNSec fromSec Duration Time stamp sleep sleep_for norm normalize dot cross inverse "
    b"transpose setZero getX getY getZ getW x y z w getOrigin getRotation setOrigin setRotation setRPY getRPY "
    b"getYaw createQuaternionMsgFromYaw lookupTransform transform canTransform doTransform toMsg fromMsg "
    b"distance get_logger get_clock ok make_pair make_tuple tie isnan isinf isfinite numeric_limits infinity "
    b"epsilon memcpy memset memcmp strcmp strlen free malloc first second load store notify_one notify_all wait "
    b"wait_for join lock_guard unique_lock scoped_lock mutex recursive_mutex string vector pair shared_lock "
    b"static_pointer_cast dynamic_pointer_cast to_string stoi stod int double float bool char unsigned size_t "
    b"uint8_t set value has_value compare exit abort getIndex getCost setCost mapToWorld worldToMap "
).split()
_COMPUTING = frozenset(name[::-1] for name in _DULL)
_KIND_OF: dict[bytes, int] = {}
_MOST_REMEMBERED = 20_000


class Level(IntEnum):
    """How much of a function is lowered."""

    NOTHING = 0
    CALLS = 1
    WHOLE = 2


class Relevance:
    """What of a function may matter.

    Attributes:
        level: how much of it is lowered.
        sets: members that it sets, as far as that is left out.
    """

    sets: tuple[str, ...] = ()

    def __init__(self, source: bytes, start: int, end: int, test: bool = False, head: int = -1) -> None:
        """Judge the body that stands from ``start`` to ``end``; of a ``test`` only one with an interface matters.

        The function begins at ``head``; -1 is unknown.
        """
        self._source = source
        self._leading: list[int] = []
        self._others: list[int] = []
        self._returns: list[int] = []
        if test:
            self.level = Level.WHOLE if _ENDPOINT.search(source, start, end) else Level.NOTHING
            return
        if end - start < _SHORT or _whole(source, start, end) or (head >= 0 and _headed(source, head, start, end)):
            self.level = Level.WHOLE
            return
        body = source[start:end]
        backwards = body[::-1]
        names = {match[1][::-1] for match in _SET.finditer(backwards)}
        if b"&" in body:
            names |= _set_under_other_names(body, names)
        self.sets = tuple(sorted(map(bytes.decode, names)))
        self._find_calls(backwards, end)
        texts = [start + match.start() for match in _TEXT_ASSIGNED.finditer(body)] if b'"' in body else []
        if self._leading or texts or (self._others and _STATEMENT_BEGINS.search(body)):
            self.level = Level.CALLS
            self._others = sorted([*self._others, *texts])
            self._returns = [start + match.start() for match in _VALUE_RETURNED.finditer(body)]
        else:
            self.level = Level.NOTHING

    def _find_calls(self, backwards: bytes, end: int) -> None:
        """Find the calls in a text that runs backwards from ``end``, those that only compute aside."""
        known = _KIND_OF.get
        for match in _CALLED.finditer(backwards):
            name = match[1]
            kind = known(name)
            if kind is None:
                kind = _kind(name)
            if kind:
                (self._leading if kind == _LEADS else self._others).append(end - match.end())
        self._leading.reverse()
        self._others.reverse()

    def may_lead(self, start: int, end: int) -> bool:
        """Return whether a simple statement or expression may lead to an interface."""
        if self.level is Level.WHOLE or _any_within(self._leading, start, end):
            return True
        if _any_within(self._others, start, end):
            call = _CALL_STATEMENT.match(self._source, start, end)
            if call and _kind(call[1][::-1]):
                return True
        return self._source.find(b"=", start, end) >= 0 and _ASSIGNED.match(self._source, start, end) is not None

    def may_hold(self, start: int, end: int) -> bool:
        """Return whether a block or control statement may hold something that stays."""
        return (
            self.level is Level.WHOLE
            or _any_within(self._leading, start, end)
            or _any_within(self._others, start, end)
            or _any_within(self._returns, start, end)
        )


def _set_under_other_names(body: bytes, names: set[bytes]) -> set[bytes]:
    """Return what other names lead to that are set: ``auto & topic = topic_;``, ``auto * topic = &topic_;``."""
    return {
        match[2]
        for match in _OTHER_NAME.finditer(body)
        if match[1] in names or len(re.findall(rb"\*\s*%s\s*[-+*/|&^%%]?=(?!=)" % match[1], body)) > 1
    }


def _headed(source: bytes, head: int, start: int, end: int) -> bool:
    """Return whether the head of a function makes all of its body matter: nodes, names to make, or that it is main."""
    return (
        _takes_nodes(source, head, start, end)
        or _makes_names(source, head, start, end)
        or source.find(b" main(", head, start) >= 0
    )


def _takes_nodes(source: bytes, head: int, start: int, end: int) -> bool:
    if end - start >= _MOST_OF_TEXT or source.find(b"Node", head, start) < 0:
        return False
    return _TAKES_NODES.search(source, head, start) is not None


def _makes_names(source: bytes, head: int, start: int, end: int) -> bool:
    if end - start >= _MOST_OF_TEXT or (source.find(b"string", head, start) < 0 > source.find(b"Options", head, start)):
        return False
    return _MAKES_NAMES.search(source, head, start) is not None


def _whole(source: bytes, start: int, end: int) -> bool:
    find = source.find
    for letters, word in _WHOLE:  # noqa: SIM110 - a generator costs more than the search
        if find(letters, start, end) >= 0 and word.search(source, start, end):
            return True
    return False


def is_logging(source: bytes, start: int, end: int) -> bool:
    """Return whether a statement only writes output; it counts if an interface is created in its arguments."""
    return _LOGGING.match(source, start, end) is not None and not _ENDPOINT.search(source, start, end)


def is_filling(source: bytes, start: int, end: int) -> bool:
    """Return whether a statement computes a number of a message, by its look: ``msg->pose.position.x = y * 2;``."""
    return _FILLING.match(source, start, end) is not None


_FILLING = re.compile(
    rb"[\w\[\]]+(?:(?:\.|->)[\w\[\]]+)*(?:\.|->)(?:[xyzw]|theta|stamp|covariance\[[^\]]*\]|range_m(?:in|ax)"
    rb"|(?:time|angle)_\w+)\s*[-+*/]?=[^=\"(){}][^\"(){};]*;"
)
_LEADS = 2


def _kind(name: bytes) -> int:
    """Return whether a called function may lead to an interface by its name (2), may hold (1) or computes (0).

    The name runs backwards.
    """
    kind = _KIND_OF.get(name)
    if kind is None:
        kind = _LEADS if _LEADING.match(name[::-1]) else 1
        if name in _COMPUTING or name.isupper():
            kind = 0
        if len(_KIND_OF) < _MOST_REMEMBERED:
            _KIND_OF[name] = kind
    return kind


def _any_within(positions: list[int], start: int, end: int) -> bool:
    place = bisect_left(positions, start)
    return place < len(positions) and positions[place] < end
