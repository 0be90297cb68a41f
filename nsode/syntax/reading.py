"""From bytes to a :class:`~nsode.source.Source`: the only place that opens a model file."""

from __future__ import annotations

import os

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.files import open_regular
from nsode.limits import DEFAULT_LIMITS, Limits, either
from nsode.source import Source, Span

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


def read(path: str | os.PathLike[str], limits: Limits = DEFAULT_LIMITS) -> Source:
    """Return the text of a model file.

    Raises
    ------
    ModelError
        NS601 where the file cannot be read or is no regular file, NS012 where it is
        larger than ``limits.size``, NS002 where it is not UTF-8.
    """
    name = os.fspath(path)
    try:
        with open_regular(path) as file:
            content = file.read(limits.size + 1)
    except (OSError, ValueError) as error:
        raise _unreadable(name, _reason(error)) from error
    return decode(name, content, limits)


def decode(name: str, content: bytes, limits: Limits = DEFAULT_LIMITS) -> Source:
    """Return the source ``name`` whose text is ``content`` in UTF-8.

    Raises
    ------
    ModelError
        NS012 where it is larger than ``limits.size``, NS002 where it is not UTF-8.
    """
    if len(content) > limits.size:
        raise too_large(Source(name, ""), limits)
    marked = content.startswith(_BYTE_ORDER_MARK)
    try:
        return Source(name, content[len(_BYTE_ORDER_MARK) * marked :].decode("utf-8"))
    except UnicodeDecodeError as error:
        raise _not_utf8(name, content, error.start + len(_BYTE_ORDER_MARK) * marked) from error


def too_large(source: Source, limits: Limits) -> ModelError:
    """Return the error for a text beyond ``limits.size``."""
    message = f"the model is larger than {limits.size:,} bytes"
    way_out = "use a family (`state x[i in 1..n]`) instead of copies"
    help_ = either(way_out, limits.raised("size"))
    return ModelError([Diagnostic("NS012", message, help=help_)], source)


def _reason(error: OSError | ValueError) -> str:
    if isinstance(error, OSError) and error.strerror:
        return error.strerror.lower()
    return "its name is no file name"


def _unreadable(name: str, why: str) -> ModelError:
    return ModelError([Diagnostic("NS601", f"cannot read `{name}`: {why}")])


def _not_utf8(name: str, content: bytes, offset: int) -> ModelError:
    """Show the place in the text before the offending byte, which is sound."""
    text = content[:offset].decode("utf-8-sig")
    source = Source(name, text + "\N{REPLACEMENT CHARACTER}")
    message = f"byte {offset} (0x{content[offset]:02x}) is not UTF-8"
    label = Label(Span(len(text), len(text) + 1), "this byte")
    help_ = "save the file as UTF-8; the language itself needs only ASCII"
    return ModelError([Diagnostic("NS002", message, (label,), help=help_)], source)
