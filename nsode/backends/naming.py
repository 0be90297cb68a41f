"""Names of a model as another language spells them: readable, and never two alike."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable


def distinct(
    names: Iterable[str],
    spell: Callable[[str], str],
    *,
    reserved: Collection[str] = (),
    vary: Callable[[str], str] = lambda spelling: spelling + "_",
) -> dict[str, str]:
    """Return a spelling for each name, one to one, clear of ``reserved``.

    Parameters
    ----------
    names
        Names as nsode has them; those that are spelt as they stand are served first.
    spell
        The preferred spelling of a name.
    vary
        The next spelling to try where one is taken.
    """
    unique = dict.fromkeys(names)
    taken = set(reserved)
    spellings: dict[str, str] = {}
    for name in sorted(unique, key=lambda name: spell(name) != name):
        spelling = spell(name)
        while spelling in taken:
            spelling = vary(spelling)
        taken.add(spelling)
        spellings[name] = spelling
    return {name: spellings[name] for name in unique}
