"""Names of the languages' own libraries, which do not count as coupling."""

from __future__ import annotations

import re

_CPP_SCOPES = frozenset({"std", "__gnu_cxx", "gsl"})

_BOOST_TWINS_WORDS = (
    "any array atomic bind condition_variable condition_variable_any enable_shared_from_this function "
    "integral_constant lock_guard make_shared mutex noncopyable optional recursive_mutex ref reference_wrapper "
    "scoped_array scoped_lock scoped_ptr shared_array shared_lock shared_mutex shared_ptr string_ref string_view "
    "thread timed_mutex tuple unique_lock unique_ptr unordered_map unordered_set upgrade_lock "
    "upgrade_to_unique_lock variant weak_ptr"
)
_BOOST_TWINS = frozenset(_BOOST_TWINS_WORDS.split())

_CPP_NAMES_WORDS = (
    "FILE allocator array atomic bitset complex condition_variable condition_variable_any deque duration "
    "enable_shared_from_this exception false_type filesystem forward_list function future ifstream initializer_list "
    "iostream istream istringstream list lock_guard map mt19937 multimap multiset mutex numeric_limits ofstream "
    "optional ostream ostringstream pair priority_queue promise queue recursive_mutex reference_wrapper "
    "runtime_error set shared_future shared_ptr stack string string_view stringstream system_clock thread true_type "
    "tuple type_info u16string u32string unique_lock unique_ptr unordered_map unordered_multimap unordered_multiset "
    "unordered_set va_list valarray variant vector weak_ptr wstring"
)
_CPP_NAMES = frozenset(_CPP_NAMES_WORDS.split())

_CPP_PARAMETER = re.compile(r"[A-Z]\d?")

_PYTHON_MODULES = frozenset({"typing", "typing_extensions", "builtins", "__builtin__"})

_PYTHON_NAMES_WORDS = (
    "Any Callable ClassVar Dict Final Generic Iterable Iterator List Mapping NamedTuple Optional Protocol Sequence "
    "Set Tuple Type TypeVar TypedDict Union bool bytearray bytes classmethod complex dict enumerate filter float "
    "frozenset int list map memoryview object property range reversed set slice staticmethod str super tuple type "
    "zip ArithmeticError AssertionError AttributeError BaseException BaseExceptionGroup BufferError "
    "DeprecationWarning EOFError Exception ExceptionGroup FileExistsError FileNotFoundError FutureWarning "
    "GeneratorExit IOError ImportError IndexError InterruptedError IsADirectoryError KeyError KeyboardInterrupt "
    "LookupError MemoryError ModuleNotFoundError NameError NotADirectoryError NotImplementedError OSError "
    "OverflowError PermissionError RecursionError ReferenceError ResourceWarning RuntimeError RuntimeWarning "
    "StandardError StopAsyncIteration StopIteration SyntaxError SystemError SystemExit TimeoutError TypeError "
    "UnicodeDecodeError UnicodeEncodeError UnicodeError UserWarning ValueError Warning ZeroDivisionError "
    "BrokenPipeError ChildProcessError ConnectionAbortedError ConnectionError ConnectionRefusedError "
    "ConnectionResetError BlockingIOError ProcessLookupError BytesWarning EncodingWarning ImportWarning "
    "IndentationError FloatingPointError PendingDeprecationWarning PythonFinalizationError SyntaxWarning TabError "
    "UnboundLocalError UnicodeTranslateError UnicodeWarning WindowsError EnvironmentError"
)
_PYTHON_NAMES = frozenset(_PYTHON_NAMES_WORDS.split())


def in_cpp_library(name: str) -> bool:
    """Whether a type's name belongs to C++ itself, as far as its spelling shows.

    True for everything in ``std``, for names of ``boost`` that ``std`` took over, for what is usually
    written without ``std::`` after a ``using``, for scalars in the convention of C (``size_t``) and
    for template parameters of one letter.
    """
    first, scoped, rest = name.partition("::")
    if scoped:
        return first in _CPP_SCOPES or (first == "boost" and rest.rpartition("::")[2] in _BOOST_TWINS)
    return name in _CPP_NAMES or name.endswith("_t") or _CPP_PARAMETER.fullmatch(name) is not None


def in_python_library(name: str) -> bool:
    """Whether a class's name is built into Python or belongs to ``typing``."""
    first, dotted, _ = name.partition(".")
    return first in _PYTHON_MODULES if dotted else name in _PYTHON_NAMES
