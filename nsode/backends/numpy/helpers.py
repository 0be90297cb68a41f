"""Functions that a generated module defines where it calls them."""

from __future__ import annotations

_VECTORS = '''\
def vectors(x, u, p):
    """Return the arguments as arrays of the right length."""
    x, u, p = (np.asarray(v, dtype=real) for v in (x, u, p))
    if (x.shape, u.shape, p.shape) != ((NX,), (NU,), (NP,)):
        raise ValueError(f"x, u and p need {NX}, {NU} and {NP} elements")
    return x, u, p
'''

_SAT = '''\
def sat(Z, x):
    """Return x, cut off at the level Z on both sides."""
    return np.maximum(-Z, np.minimum(x, Z))
'''

_SHRINK = '''\
def shrink(Z, n):
    """Return the factor by which a vector of norm n is shortened to Z; 0 where both are 0."""
    return np.where(n < Z, real(1.0), np.where(n > 0, Z / n, Z + n))
'''

_NORM = '''\
def norm(*v):
    """Return the Euclidean norm of a vector, given by its components."""
    return np.sqrt(sum(component * component for component in v))
'''

_ADD = '''\
def add(*terms):
    """Return a long sum, added from the left."""
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total
'''

_INDICES = '''\
def indices(first, last):
    """Return the numbers of the elements of a family, both ends included."""
    return np.arange(first, last + 1, dtype=real)
'''

_TOTAL = '''\
def total(terms, n):
    """Return the sum over the last of the indices, which takes n values, in rising order."""
    terms = np.asarray(terms, dtype=real)
    terms = np.broadcast_to(terms, (*terms.shape[:-1], n))
    return np.cumsum(terms, axis=-1)[..., -1]
'''

_SOLVE = '''\
def solve(matrix, right):
    """Return the solution of a linear system; entries may be arrays over a family."""
    n = len(right)
    entries = np.broadcast_arrays(*(entry for row in matrix for entry in row), *right)
    table = np.moveaxis(np.array(entries, dtype=real), 0, -1)
    rows = table[..., : n * n].reshape(*table.shape[:-1], n, n)
    return np.moveaxis(np.linalg.solve(rows, table[..., n * n :, None])[..., 0], -1, 0)
'''

_FLUSH = '''\
def flush(x):
    """Return x without the magnitudes that are too small to do anything but slow it down."""
    return np.where(np.abs(x) < tiny, real(0.0), x)
'''

#: By name, in the order in which they stand in the module.
_BAND = '''\
def band(row, column, shape=(), row_axes=(), column_axes=(), first=0, after=NX):
    """Return where values stand that begin at a place and move on along some axes.

    Columns that are not in first, ..., after - 1 are -1: there is no such element.
    """
    steps = np.indices((np.size(row), *shape)).reshape(1 + len(shape), -1)
    rows, columns = (
        np.ravel(start)[steps[0]] + sum(steps[1 + axis] for axis in axes)
        for start, axes in ((row, row_axes), (column, column_axes))
    )
    return rows, np.where((first <= columns) & (columns < after), columns, -1)
'''

_COMPRESSED = '''\
def compressed(*bands):
    """Return rows, starts of columns, and for each value its place, the last if it has none."""
    rows, columns = (np.concatenate(parts).astype(int) for parts in zip(*bands))
    found, inverse = np.unique((columns * NX + rows)[columns >= 0], return_inverse=True)
    places = np.full(len(rows), len(found))
    places[columns >= 0] = inverse
    return found % NX, np.searchsorted(found, NX * np.arange(NX + 1)), places
'''

HELPERS = {
    "vectors": _VECTORS.rstrip(),
    "sat": _SAT.rstrip(),
    "shrink": _SHRINK.rstrip(),
    "norm": _NORM.rstrip(),
    "add": _ADD.rstrip(),
    "indices": _INDICES.rstrip(),
    "total": _TOTAL.rstrip(),
    "solve": _SOLVE.rstrip(),
    "flush": _FLUSH.rstrip(),
    "band": _BAND.rstrip(),
    "compressed": _COMPRESSED.rstrip(),
}
