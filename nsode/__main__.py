"""``python -m nsode``."""

from nsode.cli import main

main()
