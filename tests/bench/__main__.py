"""How fast nsode and what it writes are: ``python tests/bench [steps|runs|scenes|families|start]``.

Never part of the tests: a number measured on a busy machine proves nothing.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1]))  # for `support`, as pytest has it

import families
import runs
import scenes
import start
import steps

PARTS = {
    "steps": steps.main,
    "runs": runs.main,
    "scenes": scenes.main,
    "families": families.main,
    "start": start.main,
}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python tests/bench", description=__doc__)
    parser.add_argument("parts", nargs="*", choices=[[], *PARTS], help="all, unless some are named")
    for part in parser.parse_args().parts or PARTS:
        PARTS[part]()
