"""An order in which every item comes behind what it reads."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Container, Hashable, Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

Key = TypeVar("Key", bound=Hashable)


def order(keys: Sequence[Key], reads: Mapping[Key, Iterable[Key]]) -> list[Key]:
    """Return the keys sorted so that each stands behind those that it reads.

    Of those that could come next, the first in ``keys`` does. Keys on or behind a loop
    are left out.
    """
    rank = {key: k for k, key in enumerate(keys)}
    waiting: dict[Key, int] = {}
    readers: dict[Key, list[Key]] = {}
    for key in keys:
        needed = {other for other in reads[key] if other in rank}
        waiting[key] = len(needed)
        for other in needed:
            readers.setdefault(other, []).append(key)
    ready = [rank[key] for key in keys if not waiting[key]]
    heapq.heapify(ready)
    found: list[Key] = []
    while ready:
        key = keys[heapq.heappop(ready)]
        found.append(key)
        for reader in readers.get(key, ()):
            waiting[reader] -= 1
            if not waiting[reader]:
                heapq.heappush(ready, rank[reader])
    return found


def loop(keys: Sequence[Key], reads: Mapping[Key, Iterable[Key]]) -> list[Key]:
    """Return one loop among the keys that :func:`order` left out, in reading order."""
    sorted_out: list[Key] = order(keys, reads)
    left = set(keys).difference(sorted_out)
    key = next(k for k in keys if k in left)
    path: dict[Key, int] = {}
    while key not in path:
        path[key] = len(path)
        key = next(other for other in reads[key] if other in left)
    return list(path)[path[key] :]


def deepest_first(
    wanted: Iterable[Key], reads: Callable[[Key], Iterable[Key]], known: Container[Key]
) -> Iterator[Key]:
    """Yield what is wanted and all that it rests on, each behind what it reads.

    The caller makes each key known before it asks for the next. Nothing recurses, so
    the depth of the definitions does not matter; there must be no loop.
    """
    waiting = list(wanted)
    while waiting:
        key = waiting[-1]
        below = [] if key in known else [other for other in reads(key) if other not in known]
        if below:
            waiting.extend(below)
            continue
        waiting.pop()
        if key not in known:
            yield key
