"""C names for the names of a model: readable, and no two alike."""

from __future__ import annotations

import re
from collections.abc import Iterable

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\[-?[0-9]+\]|\.[A-Za-z0-9_]+)*\Z")
_SPELLING = str.maketrans({".": "_", "[": "_", "]": None, "-": "m"})


#: Headers of C99 and POSIX, and those that they include: a file of ours would hide them.
_HEADERS = frozenset(
    (
        *("assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646"),
        *("limits", "locale", "math", "setjmp", "signal", "stdalign", "stdarg", "stdatomic"),
        *("stdbool", "stddef", "stdint", "stdio", "stdlib", "stdnoreturn", "string", "tgmath"),
        *("threads", "time", "uchar", "wchar", "wctype"),
        *("aio", "alloca", "dirent", "dlfcn", "endian", "fcntl", "features", "fmtmsg", "fnmatch"),
        *("ftw", "glob", "grp", "iconv", "langinfo", "libgen", "malloc", "memory", "monetary"),
        *("mqueue", "ndbm", "netdb", "nl_types", "poll", "pthread", "pwd", "regex", "sched"),
        *("search", "semaphore", "spawn", "strings", "stropts", "syslog", "tar", "termios"),
        *("trace", "ulimit", "unistd", "utime", "utmpx", "values", "wordexp"),
    )
)


def file_stem(prefix: str) -> str:
    """Return the prefix, moved aside where ``PREFIX.h`` would hide a header of the system."""
    return f"{prefix}_model" if prefix.lower() in _HEADERS else prefix


def identifier(text: str) -> str:
    """Return ``text`` if it can begin a C name.

    Raises
    ------
    ValueError
        If it cannot.
    """
    if not _IDENTIFIER.match(text):
        raise ValueError(f"`{text}` cannot begin the names of a C program")
    return text


def plain(name: str) -> str:
    """Return the name of a place if it may stand in a string of C.

    Raises
    ------
    ValueError
        If it holds anything but letters, digits, dots, underscores and an index.
    """
    if not _NAME.match(name):
        raise ValueError(f"{name!r} is no name of a model")
    return name


class Mangler(dict[str, str]):
    """Hands out C names under one prefix: ``p.x`` is ``x_p_x``, and a clash is numbered.

    Behind a prefix that no keyword, macro or library name begins with, a user's ``int``
    or ``errno`` is harmless. A dot becomes ``_``, so does a bracket (``q[1]`` is ``x_q_1``);
    where that makes two names equal, the later one gets a number.
    """

    def __init__(self, prefix: str) -> None:
        super().__init__()
        self.prefix = prefix
        self._taken: set[str] = set()

    def __missing__(self, name: str) -> str:
        """Return the C name of a name that is new."""
        self[name] = self._fresh(self.prefix + plain(name).translate(_SPELLING))
        return self[name]

    def _fresh(self, wish: str) -> str:
        text, number = wish, 2
        while text in self._taken:
            text, number = f"{wish}_{number}", number + 1
        self._taken.add(text)
        return text


def mangled(prefix: str, names: Iterable[str]) -> Mangler:
    """Return a mangler that has seen some names in this order."""
    mangler = Mangler(prefix)
    for name in names:
        mangler[name]
    return mangler
