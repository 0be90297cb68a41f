"""The Jacobian as lines of Python: places from bands, values in one array."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from nsode.backends.jacobian import Piece, SparseJacobian
from nsode.backends.numpy.functions import Writer
from nsode.backends.numpy.lower import lower
from nsode.backends.numpy.tables import WIDTH
from nsode.expr import Index, IndexRange, Name
from nsode.ode import Slot, layout

HEAD = '''\
def jac(t, x, u=u0, p=p0):
    """Return d(rhs)/dx, the values of compressed columns."""'''


def table(sparse: SparseJacobian) -> str:
    """Return the lines that place the values, at the length of the pieces."""
    singles, bands = _sorted(sparse)
    states = layout(sparse.ode.states)
    spots = [
        (_start(piece.row, piece, states)[0], _start(piece.column, piece, states)[0])
        for piece in singles
    ]
    rows, columns = ([spot[k] for spot in spots] for k in (0, 1))
    lines = [f"band({rows}, {columns}),"]
    lines += [_band(piece, states) for piece in bands]
    inner = "\n".join(f"    {part}" for line in lines for part in _wrapped(line))
    return f"""\
# Column j of the Jacobian has the rows jac_rows[jac_columns[j]:jac_columns[j + 1]].
jac_rows, jac_columns, jac_places = compressed(
{inner}
)"""


def body(writer: Writer, sparse: SparseJacobian) -> list[str]:
    """Return the lines that fill ``J``."""
    singles, bands = _sorted(sparse)
    pieces = [*singles, *bands]
    entries = [f"    {lower(piece.value, writer.env)}," for piece in singles]
    return [
        *writer.prepare(piece.value for piece in pieces),
        "own = np.array([",
        *entries,
        "], dtype=real)",
        "J = np.bincount(jac_places, np.concatenate([",
        "    own,",
        *(f"    {_values(piece, writer)}," for piece in bands),
        "]), len(jac_rows) + 1)[:-1].astype(real)",
    ]


def _sorted(sparse: SparseJacobian) -> tuple[list[Piece], list[Piece]]:
    return (
        [piece for piece in sparse.pieces if not piece.ranges],
        [piece for piece in sparse.pieces if piece.ranges],
    )


def _values(piece: Piece, writer: Writer) -> str:
    env = writer.env
    for over in piece.ranges:
        env = env.inside(over)
    return f"np.broadcast_to({lower(piece.value, env)}, {_shape(piece.ranges)}).ravel()"


def _shape(ranges: Sequence[IndexRange]) -> str:
    return _tuple([len(over) for over in ranges])


def _band(piece: Piece, states: dict[str, Slot]) -> str:
    row, row_axes = _start(piece.row, piece, states)
    column, column_axes = _start(piece.column, piece, states)
    offset, whole = states[piece.column.id]
    limits = f", {offset}, {offset + len(whole)}" if whole is not None and column_axes else ""
    axes = f"{_tuple(row_axes)}, {_tuple(column_axes)}"
    return f"band({row}, {column}, {_shape(piece.ranges)}, {axes}{limits}),"


def _tuple(values: Sequence[int]) -> str:
    return f"({', '.join(map(str, values))}{',' if len(values) == 1 else ''})"


def _start(name: Name, piece: Piece, states: dict[str, Slot]) -> tuple[int, tuple[int, ...]]:
    """Return the place of the first element, and the axes along which it moves on."""
    offset, whole = states[name.id]
    if whole is None or name.at is None:
        return offset, ()
    match name.at:
        case Index(None, constant):
            return offset + constant - whole.first, ()
        case Index(variable, shift):
            variables = [over.variable for over in piece.ranges]
            axis = variables.index(variable or "")
            return offset + piece.ranges[axis].first + shift - whole.first, (axis,)


def _wrapped(line: str) -> Iterator[str]:
    """Yield a line broken at its spaces."""
    room = WIDTH - 8
    while len(line) > room:
        cut = line.rfind(" ", 0, room)
        if cut < 0:
            break
        yield line[:cut]
        line = "    " + line[cut + 1 :]
    yield line
